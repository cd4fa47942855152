"""Mechanisms of a file, the choice of one, and the robot that it is."""

from collections.abc import Callable, Hashable
from typing import NamedTuple
from xml.sax.saxutils import quoteattr

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot, to_xyz_euler_zyx
from irbkin._robotstudio.chains import MOST_NUMBER, Arm, check_pose, poses_of
from irbkin._words import listed
from irbkin.errors import InvalidModelError

SNAP = 1e-6
"""Angles within it of a multiple of 90 deg are made exact [rad]: all of six decimals."""
DECIMALS = 12
"""Of lengths [m]: files have 0.0300000000000276."""
CLOSE = 1e-5
"""How far a robot may be from its file for these two [m, 1]."""
PROBES = np.array([[0.9, 0.7, -0.8, 1.1, 0.6, -1.2, 0.5], [-0.4, 1.3, 0.2, -2.0, -1.1, 0.8, 1.7]])
"""Joints at which it is compared with it [rad]."""


class Mechanism(NamedTuple):
    """A mechanism of a file: an arm, a positioner, a gripper, a tool."""

    names: list[str]
    """Its own, and its model's."""
    joints: int
    same: Hashable
    """Equal for two of one definition."""
    read: Callable[[], Arm]


def chosen(mechanisms: list[Mechanism], name: str | None) -> Mechanism:
    """The mechanism of a name; the only arm when not given."""
    arms = [it for it in mechanisms if it.joints in (6, 7)]
    if name is not None:
        arms = [it for it in arms if name.lower() in (own.lower() for own in it.names)]
    if len({(it.names[0].lower(), it.same) for it in arms}) == 1:
        return arms[0]
    words = listed(f'"{it.names[0]}" of {it.joints} joints' for it in arms or mechanisms)
    if arms:
        raise InvalidModelError(f"has several arms, pass name= to choose one: {words}")
    what = "arm" if name is None else f"arm {name!r}"
    raise InvalidModelError(f"has no {what} of 6 or 7 joints; it has {words or 'no mechanism'}")


def robot_of_arm(arm: Arm, name: str, coupled_limits: bool) -> Robot:
    """The robot of an arm. Its name says what the file does not have."""
    if lacks := [what for what in ("limits", "flange") if getattr(arm, what) is None]:
        name += f" (without {' and '.join(lacks)})"
    end = arm.frames[-1] if arm.flange is None else arm.flange
    if not (far := np.abs([*arm.frames[:, :3, 3], end[:3, 3]]).max()) <= MOST_NUMBER:
        where = f"an axis or its flange {far:.3g} m from its base, at most {MOST_NUMBER:g} m"
        raise InvalidModelError(f"has {where} (is it in millimeters?)")
    robot = Robot.from_urdf(_urdf([*arm.frames, end], name), snap=SNAP)
    if arm.linkage:
        robot = robot.coupled()
    for q in PROBES[:, : robot.dof]:
        flange = poses_of(arm, q)[-1] @ np.linalg.inv(arm.frames[-1]) @ end
        check_pose("the flange of the robot", robot.fk(q), flange, CLOSE)
    return robot if arm.limits is None else _limited(robot, arm, coupled_limits)


def _urdf(frames: list[Floats], name: str) -> str:
    """A URDF of axes and flange: at zero joints its links are parallel to the base."""
    text, parent, at = [f'<robot name={quoteattr(name)}><link name="base"/>'], "base", np.zeros(3)
    for index, frame in enumerate(frames, 1):
        link, kind, turn = f"link_{index}", "continuous", np.zeros(3)
        if index == len(frames):
            link, kind, turn = "tool0", "fixed", to_xyz_euler_zyx(frame)[1][::-1]
        step = np.round(frame[:3, 3] - at, DECIMALS)
        text.append(
            f'<link name="{link}"/><joint name="joint_{index}" type="{kind}">'
            f'<parent link="{parent}"/><child link="{link}"/><origin xyz="{_words(step)}" '
            f'rpy="{_words(turn)}"/><axis xyz="{_words(frame[:3, 2])}"/></joint>'
        )
        parent, at = link, frame[:3, 3]
    return "".join([*text, "</robot>"])


def _words(values: Floats) -> str:
    return " ".join(repr(float(value)) for value in values)


def _limited(robot: Robot, arm: Arm, coupled_limits: bool) -> Robot:
    """The robot with limits: of joints, and of a linkage of axes 2 and 3."""
    assert arm.limits is not None
    limits = np.tile([-np.inf, np.inf], (robot.dof + 1, 1))
    for row, bound in zip(*arm.limits, strict=True):
        joints = np.flatnonzero(row)
        is_linkage = arm.linkage and [*joints] == [1, 2]
        if len(joints) == 1:
            _narrow(limits[joints[0]], row[joints[0]], bound)
        elif is_linkage and np.isclose(row[1], arm.linkage * row[2]):
            _narrow(limits[-1], row[2], bound)
        elif coupled_limits:
            terms = " + ".join(f"{row[joint]:g} q{joint + 1}" for joint in joints)
            raise InvalidModelError(
                f"its limit {terms} <= {np.degrees(bound):.6g} deg couples axes, which only a "
                "linkage of axes 2 and 3 can: pass coupled_limits=False to leave such limits out, "
                "and check them yourself"
            )
    robot = robot.with_limits(limits[:-1])
    return robot.with_linkage_limits(limits[-1]) if np.isfinite(limits[-1]).any() else robot


def _narrow(limits: Floats, factor: float, bound: float) -> None:
    """Narrow limits to factor * q <= bound, to 1e-10 deg: files carry noise."""
    value = np.radians(np.round(np.degrees(bound / factor), 10))
    if factor > 0.0:
        limits[1] = min(limits[1], value)
    else:
        limits[0] = max(limits[0], value)
