"""Motions of joints over time: from one joint vector to another, through many, along a path.

>>> from irbkin import trajectory
>>> move = trajectory.joint([0, 0], [1, -2], duration=2.0)
>>> move.q[-1]
array([ 1., -2.])
>>> move.sample(1.0).dq
array([ 0.9375, -1.875 ])
"""

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats, as_array, finite, limit_of_each
from irbkin._core import (
    Trajectory,
    _between,
    at_tool_speed,
    joint,
    retime,
    spline,
    tool_speed_limits,
)
from irbkin.errors import InvalidJointsError, InvalidMotionError
from irbkin.records import MotionPeaks, ToolSpeedLimits, TrajectorySample

__all__ = [
    "MotionPeaks",
    "ToolSpeedLimits",
    "Trajectory",
    "TrajectorySample",
    "at_tool_speed",
    "joint",
    "retime",
    "spline",
    "state_to_state",
    "tool_speed_limits",
]

# How far rounding may exceed a limit at the end, as a part of the limit [1].
ROUNDING = 1e-9
# Longest motion [s], 30 years, as of every trajectory.
LONGEST = 1e9


def state_to_state(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    *,
    max_velocity: npt.ArrayLike,
    max_acceleration: npt.ArrayLike,
    max_jerk: npt.ArrayLike,
    start_velocity: npt.ArrayLike | None = None,
    end_velocity: npt.ArrayLike | None = None,
    start_acceleration: npt.ArrayLike | None = None,
    end_acceleration: npt.ArrayLike | None = None,
    limits: npt.ArrayLike | None = None,
    steps: int = 50,
) -> Trajectory:
    """Move from any state to any other within limits of velocity, acceleration and jerk.

    To an end at rest it is the shortest motion. To an end that moves the joints come to rest where
    the way to it begins, which takes longer. All joints arrive together. A joint that starts above
    a limit, or that cannot but exceed it, brakes first. A state that is at the goal, within 1e-9
    rad and 1e-9 of the limits, stays there.

    Args:
        q0: Joint angles at the start [rad], shape (n,).
        q1: Joint angles at the end [rad], shape (n,).
        max_velocity: Limits [rad/s], a number or shape (n,).
        max_acceleration: Limits [rad/s^2], a number or shape (n,).
        max_jerk: Limits [rad/s^3], a number or shape (n,).
        start_velocity: Velocities at the start [rad/s], shape (n,); zero if not given.
        end_velocity: Velocities at the end, in the same way.
        start_acceleration: Accelerations at the start [rad/s^2], shape (n,); zero if not given.
        end_acceleration: Accelerations at the end, in the same way.
        limits: Lower and upper limits of the joint angles [rad], shape (n, 2), `robot.limits` for
            instance: the motion must stay inside.
        steps: Number of samples, both ends included.

    Raises:
        InvalidJointsError: `q0` or `q1` has a wrong shape or is not finite.
        InvalidMotionError: Another argument has a wrong shape or is not finite, a limit is not
            positive, the end exceeds a limit or is reached only by exceeding it, a joint leaves
            `limits`, or the motion takes longer than 1e9 s.
    """
    start = finite(q0, "q0", (None,), InvalidJointsError)
    dof = len(start)
    end = finite(q1, "q1", (dof,), InvalidJointsError)

    def rate(value: npt.ArrayLike | None, name: str) -> Floats:
        return finite(np.zeros(dof) if value is None else value, name, (dof,), InvalidMotionError)

    def limit(value: npt.ArrayLike, name: str) -> Floats:
        return finite(limit_of_each(value, name, dof), name, (dof,), InvalidMotionError)

    velocity = rate(start_velocity, "start_velocity")
    acceleration = rate(start_acceleration, "start_acceleration")
    start_states = np.column_stack([start, velocity, acceleration])
    velocity = rate(end_velocity, "end_velocity")
    acceleration = rate(end_acceleration, "end_acceleration")
    end_states = np.column_stack([end, velocity, acceleration])
    most_velocity = limit(max_velocity, "max_velocity")
    most_acceleration = limit(max_acceleration, "max_acceleration")
    most_jerk = limit(max_jerk, "max_jerk")
    most = np.column_stack([most_velocity, most_acceleration, most_jerk])
    _check_end(end_states, most)
    motion = _between(start_states.tolist(), end_states.tolist(), most.tolist())
    if motion.duration > LONGEST:
        raise InvalidMotionError(
            f"the motion takes {motion.duration:g} s, it must take at most {LONGEST:g} s: are the "
            "limits in rad and s?"
        )
    if limits is None:
        # It asks back for degrees.
        joint(start, end)
    else:
        motion.check_limits(as_array(limits, "limits", (dof, 2), InvalidMotionError))
    return motion.resampled(steps)


def _check_end(end: Floats, limits: Floats) -> None:
    """Refuse an end above a limit, or one that is reached from above it only. Rows have position,
    velocity and acceleration, and limits of velocity, acceleration and jerk.
    """
    _, velocity, acceleration = end.T
    max_velocity, max_acceleration, max_jerk = limits.T
    before = velocity - 0.5 * acceleration * np.abs(acceleration) / max_jerk
    for name, values, limit, most in (
        ("end_velocity", velocity, "max_velocity", max_velocity),
        ("end_acceleration", acceleration, "max_acceleration", max_acceleration),
        ("velocity before end_acceleration", before, "max_velocity", max_velocity),
    ):
        for index in np.flatnonzero(np.abs(values) > most * (1 + ROUNDING)):
            excess = abs(values[index]) - most[index]
            raise InvalidMotionError(
                f"{name}[{index}] is {values[index]:g}, {limit}[{index}] is {most[index]:g} "
                f"(excess {excess:.2g}): lower the one or raise the other"
            )
