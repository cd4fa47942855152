"""Cells from TOML files."""

import os
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from irbkin._arguments import close
from irbkin._arrays import Floats
from irbkin._cell.entries import Entry, parsed
from irbkin._core import Cell, Robot, Shape, pose
from irbkin._mesh_files import mesh
from irbkin.errors import InvalidModelError, IrbkinError

_TURNS = ("wxyz", "euler_zyx", "euler_zyx_deg")


class Frames:
    """The frames of a file, each in another one or in the world."""

    def __init__(self, entries: Mapping[str, Entry]) -> None:
        self._entries = entries
        self._known: dict[str, Floats] = {}
        for name in entries:
            self._of(name, ())

    def pose_of(self, entry: Entry) -> Floats:
        """The pose of an entry in the world, by its key `pose`; the world's own without it."""
        return self._placed(entry.sub("pose"), ())

    def _of(self, name: str, inner: tuple[str, ...]) -> Floats:
        if name not in self._known:
            self._known[name] = self._placed(self._entries[name], (*inner, name))
        return self._known[name]

    def _placed(self, entry: Entry, inner: tuple[str, ...]) -> Floats:
        """The pose of a table in the world; `inner`: the frames that hang on it."""
        own = _pose(entry)
        if "frame" not in entry.table:
            return own
        name = entry.name("frame")
        if name in inner:
            circle = " in ".join([*inner[inner.index(name) :], name])
            entry.refuse(f"frames form a circle: {circle}", "frame")
        if name not in self._entries:
            entry.refuse(f"there is no frame {name}; {close(name, self._entries)}", "frame")
        return self._of(name, inner) @ own


def _pose(entry: Entry) -> Floats:
    entry.check("xyz", *_TURNS, "frame")
    turns = [key for key in _TURNS if key in entry.table]
    if len(turns) > 1:
        entry.refuse(f"{' and '.join(turns)} are given: give one of them")
    xyz = entry.numbers("xyz", 3) if "xyz" in entry.table else np.zeros(3)
    try:
        if not turns:
            return pose(xyz)
        if turns == ["wxyz"]:
            return pose(xyz, wxyz=entry.numbers("wxyz", 4))
        angles = entry.numbers(turns[0], 3)
        return pose(xyz, euler_zyx=np.radians(angles) if turns == ["euler_zyx_deg"] else angles)
    except IrbkinError as error:
        entry.refuse(error)


def cell_of(content: bytes, folder: str, solid: bool) -> tuple[Cell, dict[str, list[Shape]]]:
    """The cell of a TOML text, and shapes that are carried; its files are in a folder."""
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InvalidModelError(f"is not UTF-8: {error}") from None
    root = Entry(text, folder, (), parsed(text), solid)
    root.check("margin", "may_touch", "frames", "obstacles", "robots", "tool", "part")
    frames = Frames(root.subs("frames"))
    obstacles = {name: _shape(entry, frames) for name, entry in root.subs("obstacles").items()}
    margin = root.number("margin", 0.0)
    try:
        cell = Cell(obstacles, margin)
    except IrbkinError as error:
        root.refuse(error, "margin")
    for name, entry in root.subs("robots").items():
        cell = _with_robot(cell, name, entry, frames)
    pairs = _pairs(root, cell)
    try:
        return Cell(cell.obstacles, margin, pairs), _carried(root)
    except IrbkinError as error:
        root.refuse(error, "may_touch")


def _carried(root: Entry) -> dict[str, list[Shape]]:
    """The shapes of tools and parts by their names: one a table, or one for each table in it."""
    found: dict[str, list[Shape]] = {}
    for kind in ("tool", "part"):
        for name, entry in root.subs(kind).items():
            parts = entry.table
            is_one = not parts or not all(isinstance(own, Mapping) for own in parts.values())
            is_one = is_one or not parts.keys().isdisjoint((*_SHAPES, "pose"))
            entries = [entry] if is_one else [entry.sub(key) for key in parts]
            if name.lower() in found:
                entry.refuse(f"{name} is given twice: RAPID does not know case")
            # The world's frames are not the flange's.
            found[name.lower()] = [_shape(own, Frames({})) for own in entries]
    return found


def _pairs(root: Entry, cell: Cell) -> list[tuple[str, int]]:
    pairs = root.table.get("may_touch", [])
    if not isinstance(pairs, list) or not all(map(_is_pair, pairs)):
        root.refuse('must be pairs of an obstacle and a link, as [["table", 1]]', "may_touch")
    obstacles = cell.obstacles
    for name, _ in pairs:
        if name not in obstacles:
            hint = close(name, obstacles)
            root.refuse(f"there is no obstacle {name}; {hint}", "may_touch")
    return [(name, link) for name, link in pairs]


def _is_pair(pair: object) -> bool:
    if not isinstance(pair, list) or len(pair) != 2:
        return False
    return isinstance(pair[0], str) and type(pair[1]) is int and pair[1] >= 0


def _with_robot(cell: Cell, name: str, entry: Entry, frames: Frames) -> Cell:
    entry.check("name", "pose", "q", "q_deg")
    angles = [key for key in ("q", "q_deg") if key in entry.table]
    if len(angles) != 1:
        entry.refuse("its joint angles must be given by one of q [rad] and q_deg")
    try:
        robot = Robot(entry.name("name")).with_base(frames.pose_of(entry))
        q = entry.numbers(angles[0], robot.dof)
        return cell.with_robot(name, robot, np.radians(q) if angles == ["q_deg"] else q)
    except IrbkinError as error:
        entry.refuse(error)


def _shape(entry: Entry, frames: Frames) -> Shape:
    kinds = [kind for kind in _SHAPES if kind in entry.table]
    make, beside = _SHAPES[kinds[0]] if len(kinds) == 1 else (None, ("scale", "solid", "radius"))
    entry.check(*_SHAPES, "pose", *beside)
    if make is None:
        entry.refuse(f"has {' and '.join(kinds) or 'no shape'}, give one of {', '.join(_SHAPES)}")
    try:
        return make(entry).moved(frames.pose_of(entry))
    except IrbkinError as error:
        entry.refuse(error)


def _capsule(entry: Entry) -> Shape:
    own = entry.sub("capsule")
    own.check("a", "b", "radius")
    return Shape.capsule(own.numbers("a", 3), own.numbers("b", 3), own.number("radius"))


def _cylinder(entry: Entry) -> Shape:
    own = entry.sub("cylinder")
    own.check("radius", "length")
    return Shape.cylinder(own.number("radius"), own.number("length"))


def _convex(entry: Entry) -> Shape:
    return Shape.convex(_file_or_rows(entry, "convex"), scale=entry.number("scale", 1.0))


def _mesh(entry: Entry) -> Shape:
    given, scale = _file_or_rows(entry, "mesh"), entry.number("scale", 1.0)
    if "solid" in entry.table:
        return Shape.mesh(given, scale=scale, solid=entry.truth("solid", True))
    return mesh(given, entry.solid, scale=scale)


_SHAPES: dict[str, tuple[Callable[[Entry], Shape], tuple[str, ...]]] = {
    "box": (lambda entry: Shape.box(entry.numbers("box", 3)), ()),
    "sphere": (lambda entry: Shape.sphere(entry.number("sphere"), np.zeros(3)), ()),
    "capsule": (_capsule, ()),
    "cylinder": (_cylinder, ()),
    "half_space": (lambda entry: Shape.half_space(entry.numbers("half_space", 3), np.zeros(3)), ()),
    "convex": (_convex, ("scale",)),
    "mesh": (_mesh, ("scale", "solid")),
    "points": (
        lambda entry: Shape.points(_file_or_rows(entry, "points"), entry.number("radius")),
        ("radius",),
    ),
}
"""The maker of the shape of each key, and the keys beside it."""


def _file_or_rows(entry: Entry, key: str) -> Any:
    value = entry.table[key]
    try:
        if not isinstance(value, str):
            return np.array(value, dtype=float)
        path = os.path.join(entry.folder, value)
        if not os.path.isfile(path):
            entry.refuse(f"there is no file {path}", key)
        if not path.endswith(".npy"):
            return path
        # A map is not larger than its file, whatever its header says.
        return np.array(np.load(path, mmap_mode="r"), dtype=float)
    except (EOFError, OverflowError, TypeError, ValueError) as error:
        if isinstance(error, IrbkinError):
            raise
        entry.refuse("must be rows of numbers, or the name of a file", key)
