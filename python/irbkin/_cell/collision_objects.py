"""Shapes of a CollisionObject of MoveIt, and its fields: poses, lists, names with numbers."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from irbkin._arrays import Floats
from irbkin._cell.entries import Entry
from irbkin._core import Shape, pose
from irbkin._mesh_files import mesh
from irbkin.errors import IrbkinError

# In the order of their numbers.
_PRIMITIVES = ("", "box", "sphere", "cylinder", "cone", "prism")


def shapes_of(entry: Entry) -> list[Shape]:
    shapes = []
    for kind, poses, make in [
        ("primitives", "primitive_poses", _primitive),
        ("meshes", "mesh_poses", _mesh),
        ("planes", "plane_poses", _plane),
    ]:
        items, placed = items_of(entry, kind), items_of(entry, poses)
        if len(placed) != len(items) and (placed or "pose" not in entry.table):
            entry.refuse(f"has {len(items)} {kind} and {len(placed)} {poses}")
        at = [pose_of(own, "position", "orientation") for own in placed] or [np.eye(4)] * len(items)
        shapes += [make(item).moved(T) for item, T in zip(items, at, strict=True)]
    if not shapes:
        entry.refuse("has no shape: neither primitives, meshes nor planes")
    return shapes


def _primitive(entry: Entry) -> Shape:
    entry.check("type", "dimensions", "polygon")
    kind = named(entry, "type", _PRIMITIVES, "")
    if kind == "box":
        return Shape.box(entry.numbers("dimensions", 3))
    if kind == "sphere":
        return Shape.sphere(float(entry.numbers("dimensions", 1)[0]), np.zeros(3))
    if kind == "cylinder":
        height, radius = map(float, entry.numbers("dimensions", 2))
        return Shape.cylinder(radius, height)
    entry.refuse(
        f"is {kind!r}; known: box (1), sphere (2), cylinder (3); give others as meshes", "type"
    )


def _mesh(entry: Entry) -> Shape:
    entry.check("vertices", "triangles")
    try:
        corners = [_values(own, "x", "y", "z") for own in list_of(entry, "vertices")]
        rows = [_values(own, "vertex_indices") for own in list_of(entry, "triangles")]
        faces = np.array(rows).reshape(len(rows), 3)
        if faces.dtype.kind not in "iu" or faces.min() < 0:
            raise ValueError
        return mesh(np.array(corners, float).reshape(len(corners), 3)[faces], entry.solid)
    except IrbkinError:
        raise
    except (IndexError, KeyError, OverflowError, TypeError, ValueError):
        entry.refuse("must have vertices of three numbers, and triangles of three of their numbers")


def _values(value: Any, *names: str) -> Any:
    """The values of a table, or a list of them."""
    if not isinstance(value, Mapping):
        return value
    values = [value[name] for name in names]
    return values[0] if len(names) == 1 else values


def _plane(entry: Entry) -> Shape:
    """The half-space behind a plane a x + b y + c z + d = 0."""
    entry.check("coef")
    *normal, offset = entry.numbers("coef", 4)
    square = float(np.dot(normal, normal)) or 1.0
    return Shape.half_space(normal, [-float(offset) / square * float(own) for own in normal])


def pose_of(entry: Entry, xyz: str, turn: str) -> Floats:
    """A pose or a transform. Messages in which none was set have a quaternion of zeros."""
    entry.check(xyz, turn)
    wxyz = np.roll(_vector(entry, turn, "xyzw"), 1)
    try:
        return pose(_vector(entry, xyz, "xyz"), wxyz=wxyz if wxyz.any() else [1.0, 0, 0, 0])
    except IrbkinError as error:
        entry.refuse(error)


def _vector(entry: Entry, key: str, names: str) -> Floats:
    """Numbers that are a list or a table of them; zeros, as in a message, if not given."""
    if key in entry.table and not isinstance(entry.table[key], Mapping):
        return entry.numbers(key, len(names))
    own = entry.sub(key)
    own.check(*names)
    return np.array([own.number(name, 0.0) for name in names])


def named(entry: Entry, key: str, names: Sequence[str], default: Any) -> Any:
    """The lower-case name of a value that is one or the number of one, else the value."""
    value = entry.table.get(key, default)
    # A byte of ROS 2, and how it is printed.
    if isinstance(value, bytes | str) and len(value) == 1 and ord(value) < len(names):
        value = ord(value)
    if isinstance(value, str):
        return value.lower()
    return names[value] if isinstance(value, int) and 0 <= value < len(names) else value


def list_of(entry: Entry, key: str) -> list[Any]:
    value = entry.table.get(key)
    if value is not None and not isinstance(value, list):
        entry.refuse(f"is {value!r}, it must be a list", key)
    return value or []


def items_of(entry: Entry, key: str) -> list[Entry]:
    """The tables in a list."""
    items = []
    for number, value in enumerate(list_of(entry, key)):
        keys = (*entry.keys, f"{key}[{number}]")
        if not isinstance(value, Mapping):
            entry.refuse(f"{key}[{number}] is {value!r}, it must be a table")
        items.append(Entry("", entry.folder, keys, value, entry.solid))
    return items
