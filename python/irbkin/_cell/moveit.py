"""Cells from PlanningScene messages of ROS, as objects or as tables.

Nothing of ROS is imported. The messages are in docs.ros.org under moveit_msgs and shape_msgs.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from irbkin._arrays import Floats
from irbkin._cell.collision_objects import items_of, list_of, named, pose_of, shapes_of
from irbkin._cell.entries import Entry
from irbkin._core import Cell, Shape
from irbkin.errors import InvalidModelError, IrbkinError

_SCENE = """name robot_model_name robot_state fixed_frame_transforms allowed_collision_matrix
link_padding link_scale object_colors world is_diff""".split()  # noqa: SIM905
_OBJECT = """header id type pose primitives primitive_poses meshes mesh_poses planes plane_poses
subframe_names subframe_poses operation""".split()  # noqa: SIM905
# In the order of their numbers.
_OPERATIONS = ("add", "remove", "append", "move")


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
    """Refuse octomaps, and objects that are attached to the arm."""
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
    """Refuse what changes the robot for collisions."""
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
