"""Phases of constant jerk of several joints, and the trajectory that they are."""

from __future__ import annotations

import math

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Trajectory, _trajectory_of

# When the phases of a joint begin [s], shape (k,), and its position, velocity, acceleration and
# jerk there, shape (k, 4). The last one has no end.
Phases = tuple[Floats, Floats]
# What is no miss of the end [rad]: some rounding of angles. To spread it over a short motion would
# take more jerk than it is worth.
MET = 1e-12
# Coefficients of a piece, from the constant upwards: the extension's polynomials.
TERMS = 7


def stop(state: Floats, max_acceleration: float, max_jerk: float) -> Phases:
    """Bring the acceleration of a joint to zero, then its velocity, each at full jerk."""
    position, velocity, acceleration = state.tolist()
    ease = abs(acceleration) / max_jerk
    speed = velocity + 0.5 * acceleration * ease
    most = min(max_acceleration, math.sqrt(abs(speed) * max_jerk))
    ramp, hold = most / max_jerk, abs(speed) / most - most / max_jerk if most else 0.0
    against = -math.copysign(max_jerk, speed)
    steps = [
        (ease, -math.copysign(max_jerk, acceleration)),
        (ramp, against),
        (max(hold, 0.0), 0.0),
        (ramp, -against),
    ]
    begins, states = [0.0], []
    for duration, jerk in steps:
        states.append([position, velocity, acceleration, jerk])
        begins.append(begins[-1] + duration)
        position += duration * (velocity + duration * (acceleration / 2 + duration * jerk / 6))
        velocity += duration * (acceleration + duration * jerk / 2)
        acceleration += duration * jerk
    return np.array(begins), np.array([*states, [position, 0.0, 0.0, 0.0]])


def reverse(phases: Phases, duration: float) -> Phases:
    """The phases passed the other way, from a time on or behind their last one."""
    begins, states = phases
    ends = np.r_[begins[1:], duration]
    since = ends - begins
    p, v, a, j = states.T
    at_end = [
        p + since * (v + since * (a / 2 + since * j / 6)),
        -(v + since * (a + since * j / 2)),
        a + since * j,
        -j,
    ]
    return (duration - ends)[::-1], np.column_stack(at_end)[::-1]


def trajectory_of(phases: list[Phases], duration: float, end: Floats) -> Trajectory:
    """The trajectory of the phases of all joints, which ends at given joint angles [rad].

    What the phases miss of the end is spread over the motion by a quintic from 0 to 1, which
    changes no velocity or acceleration at the ends.
    """
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
        missing = end - terms[-1] @ (duration - begins[-1]) ** np.arange(TERMS)
        if (np.abs(missing) > MET).any():
            quintic = np.polynomial.Polynomial([0, 0, 0, 10, -15, 6], [0, duration], [0, 1])
            for degree in range(6):
                around = quintic.deriv(degree)(begins) / math.factorial(degree)
                terms[:, :, degree] += np.outer(around, missing)
    knots = np.r_[begins, duration].tolist()
    pieces = terms.reshape(-1, TERMS).tolist()
    return _trajectory_of(len(phases), knots, pieces, [0.0, duration])
