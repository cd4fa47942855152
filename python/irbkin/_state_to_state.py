"""`irbkin.trajectory.state_to_state`: jerk-limited motion between any two states, by ruckig."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from irbkin._arrays import as_array, finite, limit_of_each
from irbkin._core import _between, _trajectory_of, joint
from irbkin.errors import InvalidJointsError, InvalidMotionError

if TYPE_CHECKING:
    import numpy.typing as npt

    from irbkin._arrays import Floats
    from irbkin._core import Trajectory

# Tolerance of joint angles at the goal [rad], as at the joints of trajectories.
AT_GOAL = 1e-9
# Tolerance of limits, and of velocities and accelerations at the ends, relative to the limit [1].
ROUNDING = 1e-9
# Relative widening of the limits in a second search [1]: a state on a limit is inside despite
# rounding, and the limits are kept within ROUNDING.
WIDER = 1e-10
# Shortest motion that is tried as one polynomial [s]: a thousand times the shortest of all.
SHORT = 1e-6
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
        The trajectory, whose limits and ends are checked. Where ruckig finds none, the joints come
        to rest where the way to the end begins, which takes longer unless the end is at rest.

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

    problem = _Problem(
        start=np.stack(
            [
                start,
                rate(start_velocity, "start_velocity"),
                rate(start_acceleration, "start_acceleration"),
            ]
        ),
        end=np.stack(
            [end, rate(end_velocity, "end_velocity"), rate(end_acceleration, "end_acceleration")]
        ),
        limits=np.stack(
            [
                limit(max_velocity, "max_velocity"),
                limit(max_acceleration, "max_acceleration"),
                limit(max_jerk, "max_jerk"),
            ]
        ),
    )
    problem.check_end()
    motion = problem.fastest(ruckig)
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


class _Problem(NamedTuple):
    """Positions, velocities and accelerations at both ends, and limits of velocity, acceleration
    and jerk, each of shape (3, n).
    """

    start: Floats
    end: Floats
    limits: Floats

    def _eased(self, state: Floats, sign: float) -> Floats:
        """The velocities after the accelerations of a state are brought to zero, or before they
        are reached from zero (sign -1) [rad/s].
        """
        _, velocity, acceleration = state
        eased: Floats = velocity + sign * 0.5 * acceleration * np.abs(acceleration) / self.limits[2]
        return eased

    def check_end(self) -> None:
        """Refuse an end above a limit, or one that is reached from above it only."""
        velocity, acceleration, _ = self.limits
        for name, values, limit, limits in (
            ("end_velocity", self.end[1], "max_velocity", velocity),
            ("end_acceleration", self.end[2], "max_acceleration", acceleration),
            (
                "velocity before end_acceleration",
                self._eased(self.end, -1.0),
                "max_velocity",
                velocity,
            ),
        ):
            for index in np.flatnonzero(np.abs(values) > limits * (1 + ROUNDING)):
                excess = abs(values[index]) - limits[index]
                raise InvalidMotionError(
                    f"{name}[{index}] is {values[index]:g}, {limit}[{index}] is {limits[index]:g} "
                    f"(excess {excess:.2g}): lower the one or raise the other"
                )

    def fastest(self, ruckig: Any) -> Trajectory:
        """The shortest motion of ruckig that keeps limits and ends, else one of our own."""
        (q0, *start), (q1, *end), limits = self
        apart, none = np.abs(self.end - self.start), np.zeros_like(self.start[:1])
        bounds = np.vstack([none + AT_GOAL, ROUNDING * limits[:2]])
        if (apart <= bounds).all():
            still = np.vstack([none, self.end, none]).T
            return _trajectory_of([[own] * 10 for own in still.tolist()], 0.0, q1.tolist())
        # The change of acceleration at the jerk limit bounds the duration from below.
        shortest = float(np.max(apart[2] / limits[2]))
        if shortest > SHORT:
            motion = joint(
                q0,
                q1,
                duration=shortest,
                start_velocity=start[0],
                start_acceleration=start[1],
                end_velocity=end[0],
                end_acceleration=end[1],
                limits=np.full((len(q0), 2), [-np.inf, np.inf]),
            )
            if self._is_kept_by(motion):
                return motion
        with np.errstate(all="ignore"):
            for _, duration, phases in sorted(self._solutions(ruckig), key=lambda own: own[0]):
                motion = _trajectory_of(phases, duration, q1.tolist())
                if self._is_kept_by(motion):
                    return motion
        return _between(*(own.T.tolist() for own in self))

    def _is_kept_by(self, motion: Trajectory) -> bool:
        """Whether a motion keeps the limits, or brakes to them, and meets the ends."""
        ends = np.abs([self.start, self.end])
        most = self.limits.copy()
        most[0] = np.max([most[0], *ends[:, 1], np.abs(self._eased(self.start, 1.0))], axis=0)
        most[1] = np.max([most[1], *ends[:, 2]], axis=0)
        state = motion.sample([0.0, motion.duration])
        rates = np.stack([state.dq, state.ddq], axis=1)
        apart = np.abs(rates - [self.start[1:], self.end[1:]])
        return bool(
            (np.stack([*motion.peaks()]) <= most * (1 + ROUNDING)).all()
            and (apart <= most[:2] * ROUNDING).all()
        )

    def _solutions(self, ruckig: Any) -> Iterator[tuple[float, float, list[Any]]]:
        """The motions of ruckig in units of the motion and in rad and s, within the limits and
        wider ones: the duration that counts, the duration [s], and the phases of each joint.
        """
        v, a, j = self.limits
        way, change, turn = np.abs(self.end - self.start)
        times = (
            way / v,
            np.sqrt(way / a),
            np.cbrt(way / j),
            change / a,
            np.sqrt(change / j),
            turn / j,
        )
        # Estimates of the duration and of the travel of each joint: ruckig's tolerances assume
        # numbers near 1.
        time = float(np.max(times))
        near_one = time, np.min([v * time, a * time**2, j * time**3], axis=0)
        for wider in (0.0, WIDER):
            for unit, ways in (near_one, (1.0, np.ones_like(v))):
                solved = self._solved(ruckig, wider, unit, ways)
                if solved is not None and np.isfinite(solved.duration * unit):
                    duration = solved.duration * unit
                    profiles = zip(solved.profiles[0], ways, self.end[0], strict=True)
                    phases = [_phases(*own, unit, duration) for own in profiles]
                    yield duration * (1 + 2 * wider), duration, phases

    def _solved(self, ruckig: Any, wider: float, time: float, ways: Floats) -> Any:
        """The motion of ruckig within limits widened by a factor 1 + `wider`; None without one."""
        dof, goal = len(ways), self.end[0]
        rates = np.array([[1.0], [time], [time**2]]) / ways
        at_end = np.maximum(np.abs(self.end[1]), np.abs(self._eased(self.end, -1.0))) * (1 + WIDER)
        velocity, acceleration, jerk = self.limits * (1 + wider)
        inputs = ruckig.InputParameter(dof)
        start = np.stack([self.start[0] - goal, *self.start[1:]]) * rates
        inputs.current_position, inputs.current_velocity, inputs.current_acceleration = start
        inputs.target_position = np.zeros(dof)
        inputs.target_velocity, inputs.target_acceleration = (self.end * rates)[1:]
        inputs.max_velocity = np.maximum(velocity, at_end) * rates[1]
        inputs.max_acceleration = np.maximum(acceleration, np.abs(self.end[2])) * rates[2]
        inputs.max_jerk = jerk * rates[2] * time
        solved = ruckig.Trajectory(dof)
        try:
            result = ruckig.Ruckig(dof).calculate(inputs, solved)
        except (ruckig.RuckigError, ValueError):  # ValueError: a result that its Python lacks
            return None
        is_found = result in (ruckig.Result.Working, ruckig.Result.Finished)
        return solved if is_found else None


def _phases(profile: Any, way: float, angle: float, time: float, duration: float) -> list[Any]:
    """The phases of ruckig's profile: two that brake, seven that move, and rest or what is left."""
    brake = profile.brake
    lengths = np.r_[brake.t, profile.t] * time
    moving = np.column_stack([profile.p, profile.v, profile.a, [*profile.j, 0.0]])
    braking = np.column_stack([brake.p, brake.v, brake.a, brake.j])
    states = np.vstack([braking, moving]) * way / time ** np.arange(4) + [angle, 0.0, 0.0, 0.0]
    rest = max(duration - lengths.sum(), 0.0)
    phases: list[Any] = np.column_stack([np.r_[lengths, rest], states]).tolist()
    return phases
