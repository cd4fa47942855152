"""Doubles and models of the tests of EGM."""

from typing import Any, NamedTuple

import irbkin
import numpy as np

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
START = np.array([0.1, 0.2, 0.1, 0.3, 0.5, 0.2])


class PassedThrough(NamedTuple):
    """As a `Step`."""

    q: Any
    dq: Any
    accepted: bool
    state: str
    reason: str | None


class PassThrough:
    """No guard: a reference is the set point, NaN is refused; without one it stands still."""

    def __init__(self, robot=ROBOT, cycle=0.004032, start=START):
        self.robot, self.cycle, self.q, self.state = robot, cycle, np.array(start), "holding"
        self.steps = 0
        self.set_points = []

    def step(self, reference):
        self.steps += 1
        is_none = reference is None or np.isnan(reference).any()
        q = self.q if is_none else np.asarray(reference, float)
        q = self.robot.ik_nearest(q, self.q) if q.shape == (4, 4) else q
        dq, self.q = (q - self.q) / self.cycle, q
        self.state = "holding" if is_none else "following"
        self.set_points.append(q)
        return PassedThrough(q, dq, not is_none, self.state, "no reference" if is_none else None)


def swing(feedback):
    """A reference that begins and goes on smoothly."""
    return START + 0.1 * (1 - np.cos(feedback.t)) * np.array([1, 0.5, -0.5, 1, 1, -1])
