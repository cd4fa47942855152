"""Joints of a URDF that are where they are given: doors, drawers, lifts, fingers."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from xml.etree import ElementTree

import numpy as np
import numpy.typing as npt

from irbkin._arguments import close
from irbkin._core import pose, to_xyz_euler_zyx
from irbkin._urdf_elements import attribute_of, number_of, numbers_of, origin_of
from irbkin.errors import InvalidModelError

_UNITS = {"revolute": "rad", "continuous": "rad", "prismatic": "m"}
# How far over a limit a position may be by rounding [rad or m].
_ROUNDING = 1e-9


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
