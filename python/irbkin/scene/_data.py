"""The parts of a scene, its JSON, and its files."""

from __future__ import annotations

import json
import os
import sys
import types
from collections.abc import Callable
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, Union, get_args, get_origin, get_type_hints

from irbkin._core import Shape
from irbkin._files import replaced
from irbkin.errors import IrbkinError

if TYPE_CHECKING:
    from irbkin.scene._widget import View

FORMAT, VERSION = "irbkin scene", 1
KINDS = ("sphere", "capsule", "box", "cylinder", "half_space", "convex", "mesh", "points")
FACES: dict[str, Callable[..., str]] = {}
"""Makers of a scene's files, by their endings: `irbkin.scene` enters them."""
Vector = tuple[float, ...]
Rows = tuple[Vector, ...]


class _Part:
    """A part of a scene, which is shown by its lengths where it is long."""

    def __repr__(self) -> str:
        """The fields that differ from their defaults; of more than three things their number."""
        own = ((it, getattr(self, it.name)) for it in fields(self))  # type: ignore[arg-type]
        words = (f"{it.name}={_short(value)}" for it, value in own if value != it.default)
        return f"{type(self).__name__}({', '.join(words)})"


def _short(value: Any) -> str:
    if isinstance(value, dict):
        return f"<{value.get('kind')}>"
    return f"<{len(value)}>" if isinstance(value, tuple) and len(value) > 3 else repr(value)


@dataclass(frozen=True, repr=False)
class LinkShape(_Part):
    """A part of an arm's body."""

    link: int
    """The link that it moves with: 0 is the base, link i moves with joint i, and the flange carries
    the link behind the last."""
    a: Vector
    """One end of a capsule's axis in the frame of the link [m]."""
    b: Vector
    """The other end [m]."""
    radius: float
    """Its radius [m]."""


@dataclass(frozen=True, repr=False)
class LinkHull(_Part):
    """A part of an arm's body: all points within a radius of the convex hull of points."""

    link: int
    """The link that it moves with, as of a `LinkShape`."""
    points: Rows
    """The points in the frame of the link [m], to 0.1 mm."""
    faces: tuple[tuple[int, ...], ...]
    """Triangles of the surface by the numbers of the points, counterclockwise seen from outside."""
    radius: float
    """The radius [m]."""


@dataclass(frozen=True, repr=False)
class Posture(_Part):
    """Joint angles at which an arm is drawn."""

    q: Vector
    """Joint angles [rad]."""
    label: str = ""
    """Words for it: "slot 3"."""
    is_ghost: bool = False
    """Whether it is drawn faintly, behind the others."""


@dataclass(frozen=True, repr=False)
class Motion(_Part):
    """Joint angles over time, even between two times."""

    t: Vector
    """Times [s], ascending."""
    q: Rows
    """Joint angles at them [rad]."""
    lines: tuple[int, ...] = ()
    """The line of the program that each belongs to, from 1; empty without a program."""
    source: str = ""
    """The text of the program."""
    routine: str = ""
    """Its routine that moves."""


@dataclass(frozen=True, repr=False)
class Arm(_Part):
    """An arm: enough to draw it at any joint angles.

    The frame of link i in the world is `base @ joints[0] @ Rz(q[0]) @ .. @ joints[i - 1] @ Rz(q[i -
    1])`, the tool's is the frame of the last link times `tool`; joint 3 turns by `q[2] + coupling *
    q[1]`.
    """

    name: str
    base: Rows
    """Pose of the base, four rows."""
    joints: tuple[Rows, ...]
    """The frame of each joint at zero, in the frame of the joint before it or of the base."""
    tool: Rows
    """Pose of the tool in the frame of the last joint."""
    coupling: float = 0.0
    """Factor of joint 2 in the turn of joint 3: -1 of a parallelogram linkage."""
    limits: Rows = ()
    """Least and greatest angle of each joint [rad]; 1e9 of a joint without limits."""
    body: tuple[LinkShape, ...] = ()
    """Its capsules."""
    is_approximate: bool = False
    """Whether the capsules are made of the lengths of the kinematic table alone."""
    postures: tuple[Posture, ...] = ()
    """Where it is drawn."""
    motion: Motion | None = None
    """How it moves."""
    hulls: tuple[LinkHull, ...] = ()
    """Hulls, which are drawn in place of the capsules of their links."""
    urdf: str = ""
    """The URDF of an arm that is not as the catalog has it, without its base and tool."""


@dataclass(frozen=True, repr=False)
class Frame(_Part):
    """A frame, drawn as axes: x red, y green, z blue."""

    name: str
    pose: Rows
    """Four rows."""


@dataclass(frozen=True, repr=False)
class Path(_Part):
    """A way of the tool."""

    name: str
    points: Rows
    """Positions [m]."""


@dataclass(frozen=True, repr=False)
class Cloud(_Part):
    """Points with a value each: a map."""

    name: str
    points: Rows
    """Positions [m]."""
    values: Vector
    """A number for each."""
    unit: str = ""
    """The quantity, in words."""


@dataclass(frozen=True, repr=False)
class Obstacle(_Part):
    """A shape that stands still."""

    name: str
    shape: dict[str, Any]
    """As `irbkin.body.Shape.data` has it."""


@dataclass(frozen=True, repr=False)
class Mark(_Part):
    """A finding with its place."""

    point: Vector
    """Position [m]."""
    text: str
    severity: str = "note"
    """"error", "warning" or "note"."""
    place: str = ""
    """File and line, as "cell.mod:12"."""


@dataclass(frozen=True, repr=False)
class Scene(_Part):
    """Everything that is looked at."""

    title: str = ""
    arms: tuple[Arm, ...] = ()
    frames: tuple[Frame, ...] = ()
    paths: tuple[Path, ...] = ()
    clouds: tuple[Cloud, ...] = ()
    obstacles: tuple[Obstacle, ...] = ()
    marks: tuple[Mark, ...] = ()

    def __add__(self, other: Scene) -> Scene:
        """Return both in one, with the title of the first that has one."""
        if not isinstance(other, Scene):
            return NotImplemented
        parts = {
            field.name: getattr(self, field.name) + getattr(other, field.name)
            for field in fields(self)
            if field.name != "title"
        }
        return Scene(self.title or other.title, **parts)

    @property
    def duration(self) -> float:
        ends = (arm.motion.t[-1] for arm in self.arms if arm.motion and arm.motion.t)
        return max(ends, default=0.0)

    def to_dict(self) -> dict[str, Any]:
        """Return the scene as dicts, lists, numbers and texts."""
        return {"format": FORMAT, "version": VERSION, **plain(self)}

    def to_json(self) -> str:
        """Return the scene as JSON.

        Raises:
            ValueError: A number is not finite: the message has its place.
        """
        data = self.to_dict()
        try:
            return json.dumps(data, allow_nan=False, separators=(",", ":"))
        except ValueError:
            self.from_dict(data)
            raise

    def view(self, height: int = 560) -> View:
        """Return the scene as a widget of a notebook: `irbkin.scene.View`, which needs `pip install
        'irbkin[widget]'`.

        Args:
            height: Its height [pixels].
        """
        from irbkin.scene._widget import View

        return View(self, height=height)

    @classmethod
    def from_dict(cls, data: Any) -> Scene:
        """Make a scene of dicts and lists.

        Raises:
            IrbkinError: A field is missing, unknown or of another type: the message has its place.
        """
        if not isinstance(data, dict) or data.get("format") != FORMAT:
            raise IrbkinError(f'not a scene: it has no "format": "{FORMAT}"')
        if data.get("version") != VERSION:
            raise IrbkinError(f"version is {data.get('version')!r}, this irbkin reads {VERSION}")
        own = {key: value for key, value in data.items() if key not in ("format", "version")}
        scene: Scene = read(cls, own, "scene")
        for at, arm in enumerate(scene.arms):
            for index, it in enumerate(arm.hulls):
                _check_hull(it, f"scene.arms[{at}].hulls[{index}]")
        for index, obstacle in enumerate(scene.obstacles):
            try:
                _shape(obstacle.shape)
            except (AttributeError, KeyError, TypeError, ValueError) as error:
                raise IrbkinError(f"scene.obstacles[{index}].shape: {error}") from None
        return scene

    @classmethod
    def from_json(cls, text: str | bytes) -> Scene:
        """Make a scene of JSON.

        Raises:
            IrbkinError: The text is not JSON, or as `from_dict`.
        """
        try:
            return cls.from_dict(json.loads(text))
        except RecursionError:
            raise IrbkinError("not a scene: it is nested too deeply") from None
        except IrbkinError:
            raise
        except ValueError as error:
            raise IrbkinError(f"not a scene: {error}") from None

    def to_html(self) -> str:
        """Return the scene as a page that opens in any browser without a network, draws and plays.
        It solves, too, where irbkin was built with the engine of such files: `make page`.
        """
        return FACES[".html"](self)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the scene to a file, by its ending: a page (.html), JSON, or a picture of its arms
        and paths (.svg).

        Raises:
            ValueError: Another ending; no arm, of a .svg.
        """
        ending = os.path.splitext(path)[1].lower()
        faces = {".json": Scene.to_json, **FACES}
        if ending not in faces:
            raise ValueError(f"{os.fspath(path)}: must end in {', '.join(faces)}")
        text = faces[ending](self)
        with replaced(path) as file:
            file.write(text.encode())

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Read a scene from a file.

        Raises:
            IrbkinError: As `from_json`.
            OSError: The file cannot be read.
        """
        with open(path, "rb") as file:
            return cls.from_json(file.read())


def _check_hull(hull: LinkHull, place: str) -> None:
    count = len(hull.points)
    if not count or any(len(it) != 3 for it in hull.points):
        raise IrbkinError(f"{place}.points must be one or more of three numbers")
    for face in hull.faces:
        if len(face) != 3 or not 0 <= min(face) <= max(face) < count:
            raise IrbkinError(
                f"{place}.faces has {list(face)}, it must be three of the {count} points, from 0"
            )


def _shape(data: dict[str, Any]) -> Shape:
    own = {key: value for key, value in data.items() if key != "kind"}
    if data.get("kind") == "union":
        return Shape.union([_shape(part) for part in own["shapes"]])
    if data.get("kind") not in KINDS:
        raise IrbkinError(f"kind is {data.get('kind')!r}, it must be one of {', '.join(KINDS)}")
    shape: Shape = getattr(Shape, data["kind"])(**own)
    return shape


def plain(value: Any) -> Any:
    """Return a value as plain data; fields with their defaults are left out."""
    if is_dataclass(value):
        own = {field: getattr(value, field.name) for field in fields(value)}
        return {
            field.name: plain(it)
            for field, it in own.items()
            if field.default is MISSING or it != field.default
        }
    if isinstance(value, tuple | list):
        return [plain(it) for it in value]
    if isinstance(value, dict):
        return {key: plain(it) for key, it in value.items()}
    return value


_hints = cache(get_type_hints)


def read(of: Any, data: Any, place: str) -> Any:
    """Make a value of a type from plain data; an IrbkinError begins with the place."""
    if is_dataclass(of):
        return _read_fields(of, data, place)
    origin = get_origin(of)
    if origin in (Union, types.UnionType):
        if data is None:
            return None
        (only,) = (it for it in get_args(of) if it is not type(None))
        return read(only, data, place)
    if origin is tuple:
        if not isinstance(data, list):
            raise _wrong(place, data, "a list")
        (each, *_) = get_args(of)
        return tuple(read(each, it, f"{place}[{index}]") for index, it in enumerate(data))
    if of is float:
        is_number = isinstance(data, int | float) and not isinstance(data, bool)
        # A whole number may be larger than any float.
        if not (is_number and abs(data) <= sys.float_info.max):
            raise _wrong(place, data, "a finite number")
        return float(data)
    kind = origin or of
    if (of is int and isinstance(data, bool)) or not isinstance(data, kind):
        names = {str: "a text", int: "a whole number", bool: "true or false", dict: "an object"}
        raise _wrong(place, data, names[kind])
    return data


def _read_fields(of: Any, data: Any, place: str) -> Any:
    if not isinstance(data, dict):
        raise _wrong(place, data, "an object")
    own = {field.name: field for field in fields(of)}
    for key in data:
        if key not in own:
            raise IrbkinError(f"{place}: has no field {key!r}, its fields are {', '.join(own)}")
    hints = _hints(of)
    values = {}
    for name, field in own.items():
        if name in data:
            values[name] = read(hints[name], data[name], f"{place}.{name}")
        elif field.default is MISSING:
            raise IrbkinError(f"{place}: lacks the field {name!r}")
    return of(**values)


def _wrong(place: str, data: Any, wanted: str) -> IrbkinError:
    text = repr(data)
    return IrbkinError(f"{place} is {text[:60]}{'..' * (len(text) > 60)}, it must be {wanted}")
