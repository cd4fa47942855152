"""The catalog arm of a type string, with the limits in force."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from irbkin import Robot
from irbkin.abb.units import LimitDifference
from irbkin.errors import IrbkinError

SAME_LIMIT = math.radians(0.06)
"""Limits that differ by less are one figure, printed with other digits [rad]."""
ROUNDING = 1e-5
"""Rounding of a limit that the configuration prints with six digits [rad]."""
MOST_LIMIT = 1e5
"""Largest limit of a joint [rad]; axes 4 and 6 of a controller may turn as if endlessly."""
CHAIN_OF_SEVEN = (0, 1, 6, 2, 3, 4, 5)
"""ABB's axes 1 to 7 in the order of the chain: 1, 2, 7, 3, 4, 5, 6."""


@dataclass(frozen=True, eq=False)
class Fitted:
    """An arm of the catalog with limits of a configuration."""

    arm: str | None = None
    """Name in the catalog."""
    robot: Robot | None = None
    """The robot with the limits in force."""
    reason: str = ""
    by_wording: bool = False
    """Whether the arm is known by the wording of backinfo.txt alone."""
    differences: tuple[LimitDifference, ...] = ()
    without_limits: tuple[int, ...] = ()
    """ABB's axes without usable limits in the configuration."""


def fitted(
    names: Sequence[str],
    wording: Sequence[str],
    limits: Sequence[tuple[float, float]],
    linkage: tuple[float, float] | None,
) -> Fitted:
    """Return the robot that one of the names means, with the limits in force.

    Args:
        names: Type strings, the most likely first.
        wording: Names to take if the catalog has none of them.
        limits: (lower, upper) of ABB's axes, axis 1 first [rad]; NaN where not given.
        linkage: Limits of the linkage [rad].
    """
    robot, reason = _named(names)
    by_wording = False
    if robot is None and len(set(wording)) == 1:
        robot, _ = _named(wording)
        by_wording = robot is not None
    if robot is None:
        return Fitted(reason=reason)
    own, differences, without = _in_force(robot, limits)
    try:
        robot = robot.with_limits(own)
    except IrbkinError:
        # Most are no limits in radians.
        differences, without = (), tuple(range(1, robot.dof + 1))
    if linkage is not None and robot.is_coupled:
        differences += _differing("linkage", linkage, robot.linkage_limits)
        robot = robot.with_linkage_limits(linkage)
    return Fitted(robot.name, robot, "", by_wording, differences, without)


def _named(names: Sequence[str]) -> tuple[Robot | None, str]:
    """Return the robot of the first name of the catalog, or the reason if no name is in it."""
    reason = "its type is not given"
    for name in filter(None, names):
        try:
            return Robot(name), ""
        except IrbkinError as error:
            reason = str(error) if reason.startswith("its type") else reason
    return None, reason


def _in_force(
    robot: Robot, limits: Sequence[tuple[float, float]]
) -> tuple[Any, tuple[LimitDifference, ...], tuple[int, ...]]:
    """Return the limits of each joint of the chain, what differs, and the axes without limits."""
    own = robot.limits.copy()
    chain = CHAIN_OF_SEVEN if robot.dof == 7 else range(6)
    differences: tuple[LimitDifference, ...] = ()
    without = []
    for joint, axis in sorted(enumerate(chain), key=lambda pair: pair[1]):
        lower, upper = limits[axis] if axis < len(limits) else (math.nan, math.nan)
        if not (lower < upper and abs(lower) <= MOST_LIMIT and abs(upper) <= MOST_LIMIT):
            without.append(axis + 1)
            continue
        differences += _differing(f"J{axis + 1}", (lower, upper), own[joint])
        for side, bound in enumerate((lower, upper)):
            if abs(bound - own[joint, side]) > ROUNDING:
                own[joint, side] = bound
    return own, differences, tuple(without)


def _differing(joint: str, own: tuple[float, float], catalog: Any) -> tuple[LimitDifference, ...]:
    lower, upper = (math.nan, math.nan) if catalog is None else map(float, catalog)
    if abs(own[0] - lower) <= SAME_LIMIT and abs(own[1] - upper) <= SAME_LIMIT:
        return ()
    return (LimitDifference(joint, *own, lower, upper),)
