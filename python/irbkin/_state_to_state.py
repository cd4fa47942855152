"""`irbkin.trajectory.state_to_state`: jerk-limited motion between any two states, by ruckig."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

import numpy as np

from irbkin._arrays import finite, limit_of_each
from irbkin._core import Trajectory, _trajectory_of
from irbkin.errors import InvalidJointsError, InvalidMotionError

if TYPE_CHECKING:
    import numpy.typing as npt

    from irbkin._arrays import Floats

# Coefficients of a piece, from the constant upwards: the extension's polynomials.
TERMS = 7


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
    steps: int = 50,
) -> Trajectory:
    """Move from any state to any other in the shortest time that limits of velocity, acceleration
    and jerk allow. It needs ruckig: `pip install 'irbkin[time]'`.

    All joints arrive together. The pieces are ruckig's own phases of constant jerk, not samples of
    them. From rest to rest, `joint` with `profile="s_curve"` needs no extra.

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
        steps: Number of samples, both ends included.

    Returns:
        The trajectory.

    Raises:
        ImportError: ruckig is not installed.
        InvalidJointsError: `q0` or `q1` has a wrong shape or is not finite.
        InvalidMotionError: Another argument has a wrong shape or is not finite, a limit is not
            positive, or a state is outside the limits, or cannot stay inside; the message is
            ruckig's.
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

    problem = ruckig.InputParameter(dof)
    problem.current_position, problem.target_position = start, end
    problem.current_velocity = rate(start_velocity, "start_velocity")
    problem.target_velocity = rate(end_velocity, "end_velocity")
    problem.current_acceleration = rate(start_acceleration, "start_acceleration")
    problem.target_acceleration = rate(end_acceleration, "end_acceleration")
    problem.max_velocity = limit(max_velocity, "max_velocity")
    problem.max_acceleration = limit(max_acceleration, "max_acceleration")
    problem.max_jerk = limit(max_jerk, "max_jerk")
    solved = ruckig.Trajectory(dof)
    try:
        problem.validate(True, True)
        result = ruckig.Ruckig(dof).calculate(problem, solved)
    except ruckig.RuckigError as fault:
        raise InvalidMotionError(f"ruckig: {_in_our_words(str(fault))}") from None
    if result not in (ruckig.Result.Working, ruckig.Result.Finished):
        raise InvalidMotionError(f"ruckig finds no motion: {result}")
    phases = [_phases(profile) for profile in solved.profiles[0]]
    knots, terms = _pieces(phases, solved.duration, end)
    times = [0.0, solved.duration]
    pieces = terms.reshape(-1, TERMS).tolist()
    return _trajectory_of(dof, knots.tolist(), pieces, times).resampled(steps)


def _in_our_words(message: str) -> str:
    """The message of ruckig without its mark, joints counted from 1."""
    plain = message.replace("[ruckig]", "").strip()
    return re.sub(r"DoF (\d+)", lambda found: f"joint {int(found[1]) + 1}", plain)


def _phases(profile: Any) -> tuple[Floats, Floats]:
    """When the phases of a joint begin, shape (k,), and their position, velocity, acceleration and
    jerk there, shape (k, 4): two that brake, seven that move, and rest or what is left of it.
    """
    brake = profile.brake
    lengths = np.r_[brake.t, profile.t]
    begins = np.r_[0.0, np.cumsum(lengths)]
    moving = np.column_stack([profile.p, profile.v, profile.a, [*profile.j, 0.0]])
    braking = np.column_stack([brake.p, brake.v, brake.a, brake.j])
    states = np.vstack([braking, moving])
    # A phase of no length has nothing to say; the last one has no end.
    lasts = np.r_[lengths > 0.0, True]
    return begins[lasts], states[lasts]


def _pieces(
    phases: list[tuple[Floats, Floats]], duration: float, end: Floats
) -> tuple[Floats, Floats]:
    """The knots of all joints, shape (k + 1,), and the coefficients between them, (k, n, 7)."""
    begins = np.unique(np.concatenate([own for own, _ in phases]))
    begins = np.r_[0.0, begins[(begins > 0.0) & (begins < duration)]]
    terms = np.zeros((len(begins), len(phases), TERMS))
    for joint, (own, states) in enumerate(phases):
        phase = np.searchsorted(own, begins, side="right") - 1
        since, (p, v, a, j) = begins - own[phase], states[phase].T
        terms[:, joint, 0] = p + since * (v + since * (a / 2 + since * j / 6))
        terms[:, joint, 1] = v + since * (a + since * j / 2)
        terms[:, joint, 2] = (a + since * j) / 2
        terms[:, joint, 3] = j / 6
    if duration > 0.0:
        # ruckig ends within 1e-8: the rest is spread over the motion by a quintic from 0 to 1,
        # which changes no velocity or acceleration at the ends.
        missing = end - _value(terms[-1], duration - begins[-1])
        quintic = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6], [0, duration], [0, 1])
        for degree in range(6):
            around = quintic.deriv(degree)(begins) / math.factorial(degree)
            terms[:, :, degree] += np.outer(around, missing)
    return np.r_[begins, duration], terms


def _value(terms: Floats, since: float) -> Floats:
    """The positions of polynomials, shape (n, 7), at a time since their beginning."""
    value: Floats = terms @ since ** np.arange(TERMS)
    return value
