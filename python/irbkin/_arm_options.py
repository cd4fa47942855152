"""An arm as commands and files of options give it: a name, frames in mm and deg, limits in deg."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from irbkin.errors import InvalidPoseError, IrbkinError

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin._arrays import Floats

MOST_TURN = 360.0
"""The largest Euler angle that the library takes [deg]."""
ROBOTSTUDIO = re.compile(r"(.+\.(?:rslib|rsstnx?|rspag))(?::(.+))?", re.IGNORECASE)
"""A file of RobotStudio, and behind a colon an arm in it."""
LEAST_LENGTH = 5.0
"""Coordinates that are all below it may be in meters [mm]."""


def robot_of(options: Mapping[str, Any], say: Callable[[str], object]) -> Robot:
    """Return the robot of options, with its tool, base and limits.

    Args:
        options: `robot`, a name in the catalog, a .urdf file, of which `tip`, `base_link` and
            `snap` are, or one of `ROBOTSTUDIO`; `tool` and `base`, 3, 6 or 7 numbers; `limits`,
            rows of an axis and its bounds; `linkage_limits`.
        say: Takes a message on a .urdf file that another option would read better.
    """
    import numpy as np

    from irbkin import Robot

    given = options.get
    if given("robot") is None:
        raise IrbkinError('no robot: give --robot NAME, such as --robot "IRB 2600-12/1.65"')
    name = options["robot"].strip()
    base, tip, snap = (given(key) for key in ("base_link", "tip", "snap"))
    if name.lower().endswith(".urdf"):
        robot = Robot.from_urdf(name, base, tip, snap=snap)
        if helpful := re.search(r"snap=(\S+ gives [^)]*)\)", repr(robot)):
            say(f"{name}: its angles are rounded, --snap {helpful[1]}")
    elif (base, tip, snap) == (None, None, None):
        found = ROBOTSTUDIO.fullmatch(name)
        robot = Robot.from_robotstudio(*found.groups()) if found else Robot(name)
    else:
        raise IrbkinError(f"--tip, --base-link and --snap go with a .urdf file, not with {name!r}")
    if given("base") is not None:
        robot = robot.with_base(frame(options["base"], "--base"))
    if given("tool") is not None:
        tool = frame(options["tool"], "--tool")
        try:
            robot = robot.with_tool(tool)
        except InvalidPoseError:
            length = math.hypot(*options["tool"][:3])
            raise IrbkinError(
                f"--tool is {length:g} mm from the flange, more than ten times the size of the arm"
            ) from None
    if given("limits"):
        limits = robot.limits.copy()
        for axis, *bounds in options["limits"]:
            if axis not in range(1, robot.dof + 1):
                raise IrbkinError(
                    f"--limits: axis {axis:g} must be a whole number from 1 to {robot.dof}"
                )
            limits[int(axis) - 1] = np.radians(bounds)
        robot = robot.with_limits(limits)
    if given("linkage_limits") is not None:
        robot = robot.with_linkage_limits(np.radians(options["linkage_limits"]))
    return robot


def is_arm_file(name: str) -> bool:
    return name.lower().endswith(".urdf") or ROBOTSTUDIO.fullmatch(name) is not None


def frame(numbers: Sequence[float], name: str) -> Floats:
    """A frame of 3, 6 or 7 numbers, shape (4, 4) [m]."""
    import numpy as np

    from irbkin import pose

    if name == "--tool":
        check_millimeters(numbers[:3], name, 1.0)
    xyz = np.asarray(numbers[:3], dtype=float) / 1e3
    turn = list(numbers[3:])
    if len(numbers) == 3:
        return pose(xyz)
    if len(numbers) == 6:
        check_euler(turn, name)
        return pose(xyz, euler_zyx=np.radians(turn))
    if len(numbers) == 7:
        return pose(xyz, wxyz=turn)
    raise IrbkinError(
        f"{name} takes 3 numbers (x y z [mm]), 6 (with rz ry rx [deg]) or 7 (with w x y z), "
        f"got {len(numbers)}"
    )


def check_euler(angles: Sequence[float], name: str) -> None:
    """Refuse Euler angles rz, ry, rx [deg] that the library does not take."""
    for axis, value in zip(("rz", "ry", "rx"), angles, strict=True):
        if abs(value) > MOST_TURN:
            raise IrbkinError(
                f"{name}: {axis} is {value:g} deg, its size must be at most {MOST_TURN:g} deg"
            )


def check_millimeters(lengths: Sequence[float], name: str, least: float = LEAST_LENGTH) -> None:
    """Refuse lengths [mm] that are in meters: not all zero, and all of them below `least`."""
    if 0.0 < max(abs(length) for length in lengths) < least:
        raise IrbkinError(
            f"{name}: {' '.join(f'{length:g}' for length in lengths)} mm is below {least:g} mm "
            "(are these meters? millimeters are wanted; in a file, name the columns x_m, y_m, z_m "
            "or x_mm, y_mm, z_mm)"
        )
