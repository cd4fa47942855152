"""`irbkin.trajectory.state_to_state`: jerk-limited motion between any two states, by ruckig."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from irbkin._arrays import as_array, finite, limit_of_each
from irbkin._jerk_limited import ROUNDING, Problem
from irbkin._phases import trajectory_of
from irbkin.errors import InvalidJointsError, InvalidMotionError

if TYPE_CHECKING:
    import numpy.typing as npt

    from irbkin._arrays import Floats
    from irbkin._core import Trajectory

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
    """Move from any state to any other in the shortest time that limits of velocity, acceleration
    and jerk allow. It needs ruckig: `pip install 'irbkin[time]'`.

    All joints arrive together. A joint that starts above a limit, or that cannot but exceed it,
    brakes first. A state that is at the goal, within 1e-9 rad and 1e-9 of the limits, stays there.
    From rest to rest, `joint` with `profile="s_curve"` needs no extra.

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

    Returns:
        The trajectory, whose limits and ends are checked. Where ruckig finds none, the joints stop
        and start again, which takes longer.

    Raises:
        ImportError: ruckig is not installed.
        InvalidJointsError: `q0` or `q1` has a wrong shape or is not finite.
        InvalidMotionError: Another argument has a wrong shape or is not finite, a limit is not
            positive, the end exceeds a limit or is reached only by exceeding it, a joint leaves
            `limits`, or the motion takes longer than 1e9 s.
    """
    try:
        import ruckig  # type: ignore[import-not-found]
    except ImportError as missing:
        raise ImportError(
            "irbkin.trajectory.state_to_state needs ruckig: pip install 'irbkin[time]'",
            name="ruckig",
        ) from missing
    start = finite(q0, "q0", (None,), InvalidJointsError)
    dof = len(start)
    end = finite(q1, "q1", (dof,), InvalidJointsError)

    def rate(value: npt.ArrayLike | None, name: str) -> Floats:
        return finite(np.zeros(dof) if value is None else value, name, (dof,), InvalidMotionError)

    def limit(value: npt.ArrayLike, name: str) -> Floats:
        return finite(limit_of_each(value, name, dof), name, (dof,), InvalidMotionError)

    problem = Problem(
        np.stack(
            [
                start,
                rate(start_velocity, "start_velocity"),
                rate(start_acceleration, "start_acceleration"),
            ]
        ),
        np.stack(
            [end, rate(end_velocity, "end_velocity"), rate(end_acceleration, "end_acceleration")]
        ),
        limit(max_velocity, "max_velocity"),
        limit(max_acceleration, "max_acceleration"),
        limit(max_jerk, "max_jerk"),
    )
    _check_end(problem)
    motion = _still(problem) if problem.is_there() else problem.fastest(ruckig)
    if motion.duration > LONGEST:
        raise InvalidMotionError(
            f"the motion takes {motion.duration:g} s, it must take at most {LONGEST:g} s: are the "
            "limits in rad and s?"
        )
    if limits is not None:
        motion.check_limits(as_array(limits, "limits", (dof, 2), InvalidMotionError))
    return motion.resampled(steps)


def _check_end(problem: Problem) -> None:
    """Refuse an end above a limit, or one that is reached from above it only."""
    before = problem.before_end()
    for name, values, limit, limits in (
        ("end_velocity", problem.end[1], "max_velocity", problem.velocity),
        ("end_acceleration", problem.end[2], "max_acceleration", problem.acceleration),
        ("velocity before end_acceleration", before, "max_velocity", problem.velocity),
    ):
        for index in np.flatnonzero(np.abs(values) > limits * (1 + ROUNDING)):
            excess = abs(values[index]) - limits[index]
            raise InvalidMotionError(
                f"{name}[{index}] is {values[index]:g}, {limit}[{index}] is {limits[index]:g} "
                f"(excess {excess:.2g}): lower the one or raise the other"
            )


def _still(problem: Problem) -> Trajectory:
    """The end, over no time."""
    phases = [(np.zeros(1), np.array([[*state, 0.0]])) for state in problem.end.T]
    return trajectory_of(phases, 0.0, problem.end[0])
