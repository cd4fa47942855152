"""Elements of a URDF: their attributes, checked, and joints that are where they are given: doors,
drawers, lifts, fingers.
"""

from __future__ import annotations

import math
import os
from collections.abc import Collection, Mapping
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from irbkin._arguments import close
from irbkin._core import pose, to_xyz_euler_zyx
from irbkin.errors import InvalidModelError

_UNITS = {"revolute": "rad", "continuous": "rad", "prismatic": "m"}
# How far over a limit a position may be by rounding [rad or m].
_ROUNDING = 1e-9


def attribute_of(element: ElementTree.Element, key: str) -> str:
    """An attribute that must be there."""
    value = element.get(key)
    if value is None:
        raise InvalidModelError(f"{element.tag} has no {key}")
    return value


def number_of(element: ElementTree.Element, key: str, default: float | None = None) -> float:
    return float(numbers_of(element, key, 1, default)[0])


def numbers_of(
    element: ElementTree.Element, key: str, count: int, default: float | None = None
) -> npt.NDArray[np.float64]:
    """So many numbers; the default for each if the attribute is not there."""
    if default is not None and key not in element.attrib:
        return np.full(count, default)
    text = attribute_of(element, key)
    try:
        numbers = np.array([float(word) for word in text.split()])
    except ValueError:
        numbers = np.empty(0)
    if len(numbers) != count or not np.isfinite(numbers).all():
        many = f"{count} numbers" if count > 1 else "a number"
        raise InvalidModelError(f"{key} of {element.tag} is {text!r}, it must be {many}")
    return numbers


def mesh_path(
    name: str, folder: Path | None, packages: Mapping[str, str | os.PathLike[str]]
) -> Path | None:
    """The file of a mesh or None: `package://` of `packages`, else beside the URDF or above it."""
    if not name.startswith("package://"):
        paths = [(folder or Path()) / name.removeprefix("file://")]
    else:
        package, _, rest = name.removeprefix("package://").partition("/")
        above = [] if folder is None else [folder, *folder.parents]
        paths = [at / part for at in above for part in (f"{package}/{rest}", rest)]
        if package in packages:
            paths = [Path(packages[package]) / rest]
    return next(filter(os.path.isfile, paths), None)


def origin_of(element: ElementTree.Element) -> npt.NDArray[np.float64]:
    """The pose of an element in the one that it is in, by `rpy` or by URDF 1.1's `quat_xyzw`."""
    origin = element.find("origin")
    if origin is None:
        return np.eye(4)
    xyz = numbers_of(origin, "xyz", 3, 0.0)
    if "quat_xyzw" not in origin.attrib:
        return pose(xyz, euler_zyx=numbers_of(origin, "rpy", 3, 0.0)[::-1])
    if "rpy" in origin.attrib:
        raise InvalidModelError("origin has rpy and quat_xyzw, it must have one of them")
    return pose(xyz, wxyz=np.roll(numbers_of(origin, "quat_xyzw", 4), 1))


def _positions(
    joints: Mapping[str, ElementTree.Element], given: Mapping[str, float]
) -> dict[str, float]:
    """The positions that are given, checked, and where the joints are that follow them."""
    at = {}
    for name, value in given.items():
        if name not in joints:
            raise InvalidModelError(f"there is no joint {name} that moves; {close(name, joints)}")
        if first := follows(joints[name], joints):
            raise InvalidModelError(f"the joint {name} follows {first}: give where that is")
        low, high = _limits(joints[name])
        if not low - _ROUNDING <= value <= high + _ROUNDING or not math.isfinite(value):
            raise InvalidModelError(f"the joint {described(joints[name])} cannot be at {value}")
        at[name] = float(value)
    count = -1
    while count != len(at):
        count = len(at)
        for name, joint in joints.items():
            mimic = joint.find("mimic")
            if mimic is not None and (first := follows(joint, joints)) in at:
                multiplier = number_of(mimic, "multiplier", 1.0)
                at[name] = multiplier * at[first] + number_of(mimic, "offset", 0.0)
    return at


def fix(
    joints: Mapping[str, ElementTree.Element], given: Mapping[str, float], moving: Collection[str]
) -> None:
    """Fix joints where they are given, and those that follow them; none of `moving` may be."""
    joints = {name: it for name, it in joints.items() if attribute_of(it, "type") != "fixed"}
    for name in given:
        if name in moving:
            raise InvalidModelError(f"the joint {name} is of the arm, and moves: leave it out")
    for name, position in _positions(joints, given).items():
        joint = joints[name]
        xyz, zyx = to_xyz_euler_zyx(origin_of(joint) @ _motion(joint, position))
        for origin in joint.findall("origin"):
            joint.remove(origin)
        rows = {"xyz": xyz, "rpy": zyx[::-1]}
        words = {key: " ".join(map(repr, row.tolist())) for key, row in rows.items()}
        ElementTree.SubElement(joint, "origin", words)
        joint.set("type", "fixed")


def follows(joint: ElementTree.Element, joints: Mapping[str, ElementTree.Element]) -> str:
    """The name of the joint that moves another one, empty without one."""
    mimic = joint.find("mimic")
    first = "" if mimic is None else attribute_of(mimic, "joint")
    return first if first in joints else ""


def described(joint: ElementTree.Element) -> str:
    """The name of a joint and where it may be."""
    name, kind = attribute_of(joint, "name"), attribute_of(joint, "type")
    low, high = _limits(joint)
    if kind not in _UNITS:
        return f"{name} ({kind}: make it fixed)"
    if math.isinf(high):
        return f"{name} (any {_UNITS[kind]})"
    return f"{name} ({low:.10g} to {high:.10g} {_UNITS[kind]})"


def _limits(joint: ElementTree.Element) -> tuple[float, float]:
    """Where a joint may be: nowhere if that is not one number."""
    kind, limit = attribute_of(joint, "type"), joint.find("limit")
    if kind not in _UNITS:
        return math.inf, -math.inf
    if kind == "continuous" or limit is None:
        return -math.inf, math.inf
    return number_of(limit, "lower", 0.0), number_of(limit, "upper", 0.0)


def _motion(joint: ElementTree.Element, position: float) -> npt.NDArray[np.float64]:
    """The pose of a joint's child in its frame."""
    element = joint.find("axis")
    axis = np.array([1.0, 0, 0]) if element is None else numbers_of(element, "xyz", 3)
    length = float(np.linalg.norm(axis))
    if length < _ROUNDING:
        raise InvalidModelError(f"the axis of the joint {attribute_of(joint, 'name')} is zero")
    axis /= length
    if attribute_of(joint, "type") == "prismatic":
        return pose(position * axis)
    half = 0.5 * position
    return pose(np.zeros(3), wxyz=[math.cos(half), *(math.sin(half) * axis)])
