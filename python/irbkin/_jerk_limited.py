"""The fastest jerk-limited motion between two states: ruckig's, checked, or one of our own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from irbkin._core import joint
from irbkin._phases import reverse, stop, trajectory_of

if TYPE_CHECKING:
    from irbkin._arrays import Floats
    from irbkin._core import Trajectory
    from irbkin._phases import Phases

# How far joints may be from the goal and are there [rad], as where trajectories are joined.
AT_GOAL = 1e-9
# How far rounding may exceed a limit, and a velocity or an acceleration differ from that of the
# goal, as a part of the limit [1].
ROUNDING = 1e-9
# By how much limits are wider in a second search [1]: a state on a limit is inside it, whatever
# rounding does, and limits are kept within ROUNDING.
WIDER = 1e-10
# Shortest motion that is tried as one polynomial [s]: a thousand times the shortest of all.
SHORT = 1e-6


@dataclass(frozen=True)
class Problem:
    """Positions, velocities and accelerations at both ends, shape (3, n), and limits, (n,)."""

    start: Floats
    end: Floats
    velocity: Floats
    acceleration: Floats
    jerk: Floats

    def is_there(self) -> bool:
        """Whether the start is the goal."""
        apart = np.abs(self.end - self.start)
        bounds = [
            np.full_like(self.velocity, AT_GOAL),
            ROUNDING * self.velocity,
            ROUNDING * self.acceleration,
        ]
        return bool((apart <= bounds).all())

    def after_start(self) -> Floats:
        """The velocities when the accelerations of the start are brought to zero [rad/s]."""
        _, velocity, acceleration = self.start
        after: Floats = velocity + 0.5 * acceleration * np.abs(acceleration) / self.jerk
        return after

    def before_end(self) -> Floats:
        """The velocities from which the accelerations of the end are reached [rad/s]."""
        _, velocity, acceleration = self.end
        before: Floats = velocity - 0.5 * acceleration * np.abs(acceleration) / self.jerk
        return before

    def fastest(self, ruckig: Any) -> Trajectory:
        """The shortest of ruckig's motions that keep what is promised, or one of our own."""
        # No motion is shorter than the acceleration takes to change.
        shortest = float(np.max(np.abs(self.end[2] - self.start[2]) / self.jerk))
        if shortest > SHORT:
            motion = self._quintic(shortest)
            if self._is_kept_by(motion):
                return motion
        with np.errstate(all="ignore"):
            units = [self._units(), (1.0, np.ones_like(self.velocity))]
            found = [
                (solution.duration * (1 + 2 * wider), solution)
                for wider in (0.0, WIDER)
                for own in units
                if (solution := _solved(self, ruckig, wider, *own)) is not None
            ]
            for _, solution in sorted(found, key=lambda own: own[0]):
                motion = solution.motion(self.end[0])
                if self._is_kept_by(motion):
                    return motion
            return self._stop_and_go()

    def _quintic(self, duration: float) -> Trajectory:
        (q0, *start), (q1, *end) = self.start, self.end
        return joint(
            q0,
            q1,
            duration=duration,
            start_velocity=start[0],
            start_acceleration=start[1],
            end_velocity=end[0],
            end_acceleration=end[1],
        )

    def _units(self) -> tuple[float, Floats]:
        """The unit of time, about the duration [s], and of the way of each joint, as far as it
        gets in that time [rad]: ruckig's tolerances are of numbers near 1.
        """
        v, a, j = self.velocity, self.acceleration, self.jerk
        way, change, turn = np.abs(self.end - self.start)
        times = (
            way / v,
            np.sqrt(way / a),
            np.cbrt(way / j),
            change / a,
            np.sqrt(change / j),
            turn / j,
        )
        time = float(np.max(times))
        return time, np.min([v * time, a * time**2, j * time**3], axis=0)

    def _is_kept_by(self, motion: Trajectory) -> bool:
        """Whether a motion keeps the limits, or brakes to them, and meets the ends."""
        ends = np.abs([self.start, self.end])
        most = [
            np.max([self.velocity, *ends[:, 1], np.abs(self.after_start())], axis=0),
            np.max([self.acceleration, *ends[:, 2]], axis=0),
            self.jerk,
        ]
        peaks = np.stack([*motion.peaks()])
        state = motion.sample([0.0, motion.duration])
        rates = np.stack([state.dq, state.ddq], axis=1)
        apart = np.abs(rates - [self.start[1:], self.end[1:]])
        return bool(
            (peaks <= np.multiply(most, 1 + ROUNDING)).all()
            and (apart <= np.multiply(most[:2], ROUNDING)).all()
        )

    def _stop_and_go(self) -> Trajectory:
        """Stop, move to where the way to the end begins, and go on to the end."""
        limits = list(zip(self.acceleration, self.jerk, strict=True))
        begin, end = (
            [stop(state, *own) for state, own in zip(states.T, limits, strict=True)]
            for states in (self.start, self.end * [[1], [-1], [1]])
        )
        stopped, starts = (np.array([states[-1, 0] for _, states in own]) for own in (begin, end))
        whole = joint(
            stopped,
            starts,
            profile="s_curve",
            max_velocity=self.velocity,
            max_acceleration=self.acceleration,
            max_jerk=self.jerk,
        )
        duration = max(own[-1] for own, _ in begin)
        if duration > 0.0:
            whole = trajectory_of(begin, duration, stopped) + whole
        duration = max(own[-1] for own, _ in end)
        if duration > 0.0:
            back = [reverse(own, duration) for own in end]
            whole = whole + trajectory_of(back, duration, self.end[0])
        return whole


@dataclass(frozen=True)
class _Solution:
    """ruckig's motion, in units of its own."""

    duration: float
    profiles: Any
    time: float
    ways: Floats
    goal: Floats

    def motion(self, end: Floats) -> Trajectory:
        """The trajectory."""
        rates = self.time ** np.arange(4)
        phases = []
        for way, angle, profile in zip(self.ways, self.goal, self.profiles, strict=True):
            begins, states = _phases(profile)
            phases.append((begins * self.time, states * way / rates + [angle, 0.0, 0.0, 0.0]))
        return trajectory_of(phases, self.duration, end)


def _solved(
    problem: Problem, ruckig: Any, wider: float, time: float, ways: Floats
) -> _Solution | None:
    """The motion of ruckig within limits that are so much wider, if it finds one."""
    dof, goal = len(ways), problem.end[0]
    rates = np.array([[1.0], [time], [time**2]]) / ways
    at_end = np.maximum(np.abs(problem.end[1]), np.abs(problem.before_end())) * (1 + WIDER)
    is_on_limit = at_end > problem.velocity
    velocity = np.maximum(problem.velocity * (1 + wider), np.where(is_on_limit, at_end, 0.0))
    acceleration = np.maximum(problem.acceleration * (1 + wider), np.abs(problem.end[2]))
    asked = ruckig.InputParameter(dof)
    start = np.stack([problem.start[0] - goal, *problem.start[1:]]) * rates
    asked.current_position, asked.current_velocity, asked.current_acceleration = start
    asked.target_position = np.zeros(dof)
    asked.target_velocity, asked.target_acceleration = (problem.end * rates)[1:]
    asked.max_velocity, asked.max_acceleration = velocity * rates[1], acceleration * rates[2]
    asked.max_jerk = problem.jerk * (1 + wider) * rates[2] * time
    solved = ruckig.Trajectory(dof)
    try:
        result = ruckig.Ruckig(dof).calculate(asked, solved)
    except (ruckig.RuckigError, ValueError):  # ValueError: a result that its Python lacks
        return None
    if result not in (ruckig.Result.Working, ruckig.Result.Finished):
        return None
    duration = solved.duration * time
    if not np.isfinite(duration):
        return None
    return _Solution(duration, solved.profiles[0], time, ways, goal)


def _phases(profile: Any) -> Phases:
    """The phases of ruckig's profile: two that brake, seven that move, and rest or what is left."""
    brake = profile.brake
    lengths = np.r_[brake.t, profile.t]
    begins = np.r_[0.0, np.cumsum(lengths)]
    moving = np.column_stack([profile.p, profile.v, profile.a, [*profile.j, 0.0]])
    braking = np.column_stack([brake.p, brake.v, brake.a, brake.j])
    states = np.vstack([braking, moving])
    # A phase of no length has nothing to say; the last one has no end.
    lasts = np.r_[lengths > 0.0, True]
    return begins[lasts], states[lasts]
