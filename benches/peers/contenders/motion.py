"""Motions over time: joints from rest to rest, a line of the tool, a path within limits."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..arms import IRB2600, Arm, Floats
from .contender import Contender, from_both, from_joints, from_pose

# The velocities of an IRB 2600's data sheet [rad/s]; no source has accelerations and jerks.
VELOCITY = np.radians([175.0, 175, 175, 360, 360, 500])
ACCELERATION = 5 * VELOCITY
JERK = np.full(6, 100.0)
# Samples of the short and of the long row, and poses of a line.
FEW, MANY = 50, 1000
# Times at which an answer is looked at: ten times as many as it is asked for.
FINE = 10 * MANY


def fine(duration: float) -> Floats:
    """Times over a motion [s]."""
    return np.linspace(0, duration, FINE)


def own_motions(robot: Any) -> list[Contender]:
    """`irbkin.trajectory` and `irbkin.paths`."""
    from irbkin import paths, trajectory

    def quintic(steps: int) -> Callable[..., Any]:
        return lambda joints: trajectory.joint(joints[0], joints[1], steps=steps)

    def s_curve(joints: Floats) -> Any:
        return trajectory.joint(
            joints[0],
            joints[1],
            steps=2,
            profile="s_curve",
            max_velocity=VELOCITY,
            max_acceleration=ACCELERATION,
            max_jerk=JERK,
        )

    def states(move: Any) -> Floats:
        return np.stack([move.q, move.dq, move.ddq])

    def timed(move: Any) -> tuple[float, Floats, Floats]:
        samples = move.sample(fine(move.duration))
        return move.duration, samples.dq, samples.ddq

    def followed(poses: Floats, joints: Floats) -> Floats:
        return robot.follow(poses, joints[0]).q

    return [
        Contender("quintic", "irbkin", quintic(FEW), from_joints, read=states),
        Contender("long_quintic", "irbkin", quintic(MANY), from_joints, read=states),
        Contender("s_curve", "irbkin", s_curve, from_joints, read=timed),
        Contender(
            "line", "irbkin", lambda poses: paths.line(poses[0], poses[1], steps=MANY), from_pose
        ),
        Contender(
            "follow", "irbkin", followed, from_both, read=lambda q: (q, robot.fk(q)), bound=1e-9
        ),
        Contender(
            "retime",
            "irbkin",
            lambda q: trajectory.retime(q, VELOCITY, ACCELERATION),
            from_joints,
            read=timed,
        ),
    ]


def roboticstoolbox(arm: Arm) -> list[Contender]:
    """`jtraj` and `ctraj`."""
    if arm is not IRB2600:
        return []
    import roboticstoolbox as rtb
    from spatialmath import SE3

    def over(steps: int) -> Callable[[Floats, Floats], tuple[Any, ...]]:
        return lambda poses, joints: (joints[0], joints[1], np.linspace(0, 1, steps))

    def states(move: Any) -> Floats:
        return np.stack([move.q, move.qd, move.qdd])

    def ends(poses: Floats, joints: Floats) -> tuple[Any, ...]:
        return SE3(poses[0], check=False), SE3(poses[1], check=False), np.linspace(0, 1, MANY)

    jtraj = "roboticstoolbox, jtraj"
    return [
        Contender("quintic", jtraj, rtb.jtraj, over(FEW), read=states),
        Contender("long_quintic", jtraj, rtb.jtraj, over(MANY), read=states),
        Contender(
            "line",
            "roboticstoolbox, ctraj",
            lambda start, end, s: rtb.ctraj(start, end, s=s),
            ends,
            read=lambda poses: np.stack(poses.A),
        ),
    ]


def toppra(arm: Arm) -> list[Contender]:
    """Its solver on the same spline, over as many pieces."""
    if arm is not IRB2600:
        return []
    import toppra
    from toppra import algorithm, constraint

    toppra.setup_logging("ERROR")

    def timed(move: Any) -> tuple[float, Floats, Floats]:
        times = fine(move.duration)
        return move.duration, move(times, 1), move(times, 2)

    def retime(q: Floats) -> Any:
        lengths = np.r_[0, np.cumsum(np.linalg.norm(np.diff(q, axis=0), axis=1))]
        limits = [
            constraint.JointVelocityConstraint(np.c_[-VELOCITY, VELOCITY]),
            constraint.JointAccelerationConstraint(np.c_[-ACCELERATION, ACCELERATION]),
        ]
        return algorithm.TOPPRA(
            limits,
            toppra.SplineInterpolator(lengths, q),
            gridpoints=np.linspace(0, lengths[-1], MANY),
            parametrizer="ParametrizeConstAccel",
        ).compute_trajectory()

    return [Contender("retime", "toppra", retime, from_joints, read=timed)]


def ruckig(arm: Arm) -> list[Contender]:
    """`calculate`, which sets its input in the same call."""
    if arm is not IRB2600:
        return []
    import ruckig

    solver = ruckig.Ruckig(6)
    limits = [limit.tolist() for limit in (VELOCITY, ACCELERATION, JERK)]

    def move(start: list[float], end: list[float]) -> Any:
        asked, found = ruckig.InputParameter(6), ruckig.Trajectory(6)
        asked.current_position, asked.target_position = start, end
        asked.max_velocity, asked.max_acceleration, asked.max_jerk = limits
        solver.calculate(asked, found)
        return found

    def timed(found: Any) -> tuple[float, Floats, Floats]:
        samples = np.array([found.at_time(time) for time in fine(found.duration)])
        return found.duration, samples[:, 1], samples[:, 2]

    return [
        Contender(
            "s_curve",
            "ruckig",
            move,
            lambda poses, joints: (joints[0].tolist(), joints[1].tolist()),
            read=timed,
        )
    ]
