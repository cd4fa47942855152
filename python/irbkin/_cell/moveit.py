"""Cells from PlanningScene messages of ROS, as objects or as tables.

Nothing of ROS is imported. The messages are in docs.ros.org under moveit_msgs and shape_msgs.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from irbkin._arrays import Floats
from irbkin._cell.entries import Entry
from irbkin._core import Cell, Shape, pose
from irbkin._mesh_files import mesh
from irbkin.errors import InvalidModelError, IrbkinError

# In the order of their numbers.
_PRIMITIVES = ("", "box", "sphere", "cylinder", "cone", "prism")
_SCENE = """name robot_model_name robot_state fixed_frame_transforms allowed_collision_matrix
link_padding link_scale object_colors world is_diff""".split()  # noqa: SIM905
_OBJECT = """header id type pose primitives primitive_poses meshes mesh_poses planes plane_poses
subframe_names subframe_poses operation""".split()  # noqa: SIM905
# In the order of their numbers.
_OPERATIONS = ("add", "remove", "append", "move")


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
    items = []
    for number, value in enumerate(list_of(entry, key)):
        keys = (*entry.keys, f"{key}[{number}]")
        if not isinstance(value, Mapping):
            entry.refuse(f"{key}[{number}] is {value!r}, it must be a table")
        items.append(Entry("", entry.folder, keys, value, entry.solid))
    return items


def cell_of_message(message: Any, solid: bool) -> Cell:
    """The cell of a PlanningScene, a PlanningSceneWorld or the dict of one."""
    scene = _plain(message)
    if not isinstance(scene, Mapping):
        kind = type(message).__name__
        raise TypeError(f"a cell is loaded from a path, a PlanningScene or its dict, not {kind}")
    if scene.keys().isdisjoint(("world", "collision_objects")):
        raise InvalidModelError("is no PlanningScene: it has no world with collision_objects")
    root = Entry("", "", (), scene if "world" in scene else {"world": scene}, solid)
    root.check(*_SCENE)
    _check_world(root)
    frames = _frames(root)
    found: dict[str, list[Shape]] = {}
    for number, item in enumerate(items_of(root.sub("world"), "collision_objects")):
        name = str(item.table.get("id") or "")
        entry = Entry("", "", (name or f"collision_objects[{number}]",), item.table, solid)
        entry.check(*_OBJECT)
        _apply(found, name, entry, frames)
    _check_robot(root, found)
    return Cell({name: Shape.union(shapes) for name, shapes in found.items()})


def _plain(value: Any) -> Any:
    if value is None or isinstance(value, str | bytes | int | float):
        return value
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, Mapping):
        return {str(key): _plain(own) for key, own in value.items()}
    if isinstance(value, Sequence):
        return [_plain(own) for own in value]
    # ROS 2 lists the fields, ROS 1 has them in slots.
    fields = getattr(value, "get_fields_and_field_types", None)
    names = fields() if fields else getattr(value, "__slots__", getattr(value, "__dict__", ()))
    return {name: _plain(getattr(value, name)) for name in names}


def _check_world(root: Entry) -> None:
    world = root.sub("world")
    world.check("collision_objects", "octomap")
    octomap = world.sub("octomap")
    if octomap.table.get("data") or octomap.sub("octomap").table.get("data"):
        world.refuse("is not read: give its points by Shape.points", "octomap")
    for item in items_of(root.sub("robot_state"), "attached_collision_objects"):
        name = item.sub("object").table.get("id")
        item.refuse(
            f"{name} is attached to {item.table.get('link_name')} and moves with the arm: take it "
            "out of the scene, and give it to robot.with_attached"
        )


def _apply(
    found: dict[str, list[Shape]], name: str, entry: Entry, frames: dict[str, Floats]
) -> None:
    operation = named(entry, "operation", _OPERATIONS, 0)
    if operation == "remove":
        if name and name not in found:
            entry.refuse("is removed, but was not added before")
        for own in [name] if name else list(found):
            del found[own]
        return
    if not name:
        entry.refuse("has no id")
    if operation not in ("add", "append"):
        entry.refuse(f"is {operation!r}: give the object with its shapes, by add (0)", "operation")
    if operation == "add" and name in found:
        entry.refuse("is added twice: append the second, or give it another id")
    placed = pose_of(entry.sub("pose"), "position", "orientation")
    try:
        shapes = [own.moved(_in_frame(entry, frames) @ placed) for own in shapes_of(entry)]
    except IrbkinError as error:
        entry.refuse(error)
    found.setdefault(name, []).extend(shapes)


def _frames(root: Entry) -> dict[str, Floats]:
    """The poses of the frames that objects may be in; "" is the planning frame."""
    frames = {"": np.eye(4)}
    planning = ""
    for item in items_of(root, "fixed_frame_transforms"):
        # MoveIt writes the planning frame as the child of all others.
        child = _frame(item.table.get("child_frame_id"))
        if planning not in ("", child):
            item.refuse(f"is in {child}, another one in {planning}: the planning frame is one")
        planning = child
        frame = _frame(item.sub("header").table.get("frame_id"))
        if frame not in ("", planning):
            frames[frame] = pose_of(item.sub("transform"), "translation", "rotation")
    if not planning:
        header = root.sub("robot_state").sub("joint_state").sub("header")
        planning = _frame(header.table.get("frame_id"))
    if not planning:
        headers = [it.sub("header") for it in items_of(root.sub("world"), "collision_objects")]
        names = {_frame(header.table.get("frame_id")) for header in headers}
        planning = names.pop() if len(names) == 1 else ""
    return {planning: np.eye(4), **frames}


def _frame(name: Any) -> str:
    return str(name or "").removeprefix("/")


def _in_frame(entry: Entry, frames: dict[str, Floats]) -> Floats:
    frame = _frame(entry.sub("header").table.get("frame_id"))
    if frame not in frames:
        known = ", ".join(name for name in frames if name) or "not known"
        entry.refuse(
            f"is in the frame {frame}; the planning frame and those fixed in it are {known}: give "
            "its pose there, or the frame in fixed_frame_transforms"
        )
    return frames[frame]


def _check_robot(root: Entry, obstacles: Mapping[str, Any]) -> None:
    for key, field, neutral in [("link_padding", "padding", 0.0), ("link_scale", "scale", 1.0)]:
        for item in items_of(root, key):
            if item.number(field, neutral) != neutral:
                link = item.table.get("link_name")
                item.refuse(f"of {link} is {item.number(field)}: a cell has a margin", field)
    allowed = root.sub("allowed_collision_matrix")
    for prefix in ("", "default_"):
        names = list_of(allowed, f"{prefix}entry_names")
        for one, row in zip(names, list_of(allowed, f"{prefix}entry_values"), strict=False):
            if str(one) in obstacles and np.any(
                row.get("enabled") if isinstance(row, Mapping) else row
            ):
                allowed.refuse(
                    f"lets {one} be touched: take it out, and give numbers of links, as "
                    f'Cell(cell.obstacles, may_touch=[("{one}", 1)])'
                )
