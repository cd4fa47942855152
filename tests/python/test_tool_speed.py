"""The speed of the tool along a path of joints."""

import irbkin
import numpy as np
import pytest
from irbkin import InvalidJointsError, InvalidMotionError, InvalidPoseError, paths, trajectory

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
# A line past the wrist singularity, where joint 4 is the slowest for the way.
START = irbkin.pose([0.85, -0.4, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
END = irbkin.pose([0.85, 0.4, 0.64], wxyz=[0.5, 0.1, 0.8602325267, 0])
LINE = paths.line(START, END, steps=1000)
Q = ROBOT.follow(LINE, np.zeros(6)).q
VELOCITY = ROBOT.max_velocity
ACCELERATION = 5 * VELOCITY


def tool_speeds(move):
    """The speed of the tool at the samples [m/s], by the Jacobian."""
    twist = ROBOT.jacobian(move.q) @ move.dq[..., None]
    return np.linalg.norm(twist[:, :3, 0], axis=1)


def test_the_limits_at_the_samples_are_those_of_the_jacobian():
    limits = trajectory.tool_speed_limits(Q, LINE, VELOCITY)
    # dq for a tool that moves along the line at 1 m/s, turning evenly.
    relative = START[:3, :3].T @ END[:3, :3]
    angle = np.arccos((np.trace(relative) - 1) / 2)
    skew = (relative - relative.T) / (2 * np.sin(angle))
    turn = START[:3, :3] @ [skew[2, 1], skew[0, 2], skew[1, 0]] * angle
    way = (END - START)[:3, 3]
    twist = np.r_[way, turn] / np.linalg.norm(way)
    slopes = np.linalg.solve(ROBOT.jacobian(Q), np.tile(twist, (1000, 1))[..., None])[..., 0]
    wanted = VELOCITY / abs(slopes)
    np.testing.assert_allclose(limits.speed, wanted.min(axis=1), rtol=1e-4)
    np.testing.assert_array_equal(limits.joint, wanted.argmin(axis=1) + 1)
    assert limits.fastest <= limits.speed.min()
    # Its least lies between two samples.
    assert limits.fastest == pytest.approx(limits.speed.min(), rel=1e-5)
    assert (limits.fastest_joint, limits.fastest_index) == (4, 495)
    assert limits == trajectory.tool_speed_limits(Q, LINE, VELOCITY)


def test_a_speed_that_is_too_fast_names_the_joint_and_the_sample():
    with pytest.raises(
        InvalidMotionError,
        match=r"joint 4 allows 0\.3522399\d* m/s at row 495 of q, 0\.4 m/s is asked",
    ):
        trajectory.at_tool_speed(Q, LINE, 0.4, VELOCITY)


@pytest.mark.parametrize("speed", [0.1, 0.25, 0.5, 2.0])
def test_retiming_keeps_the_speed_of_the_tool_and_the_limits(speed):
    move = trajectory.retime(Q, VELOCITY, ACCELERATION, T=LINE, max_tool_speed=speed, steps=10_000)
    peaks = move.peaks()
    assert (peaks.velocity <= VELOCITY * (1 + 1e-9)).all()
    assert (peaks.acceleration <= ACCELERATION * (1 + 1e-9)).all()
    speeds = tool_speeds(move)
    assert speeds.max() <= speed * (1 + 1e-6)
    assert speeds[[0, -1]] == pytest.approx(0, abs=1e-9)
    if speed <= 0.25:
        assert (speeds > speed * (1 - 1e-6)).mean() > 0.9
    assert move.duration >= trajectory.retime(Q, VELOCITY, ACCELERATION).duration * 0.999


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (
            lambda: trajectory.at_tool_speed(Q, LINE[:3], 0.1, VELOCITY),
            InvalidPoseError,
            r"T must have shape \(1000, 4, 4\), a pose for each row of q, got 3",
        ),
        (
            lambda: trajectory.tool_speed_limits(Q, START, VELOCITY),
            InvalidPoseError,
            r"T must have shape \(m, 4, 4\), got \(4, 4\)",
        ),
        (
            lambda: trajectory.tool_speed_limits(Q, LINE * np.nan, VELOCITY),
            InvalidPoseError,
            r"T\[0\]: pose\[0, 0\] is NaN",
        ),
        (
            lambda: trajectory.tool_speed_limits(Q * np.nan, LINE, VELOCITY),
            InvalidJointsError,
            "row 0 of q: joint 1 is NaN",
        ),
        (
            lambda: trajectory.tool_speed_limits(Q[:0], LINE[:0], VELOCITY),
            InvalidMotionError,
            "q has 0 rows",
        ),
        (
            lambda: trajectory.tool_speed_limits(Q, LINE, [1, 2]),
            InvalidMotionError,
            r"max_velocity must be a number or have shape \(6,\)",
        ),
        (
            lambda: trajectory.tool_speed_limits(Q, LINE, -1.0),
            InvalidMotionError,
            r"max_velocity\[0\] is -1.0, it must be positive",
        ),
        (
            lambda: trajectory.at_tool_speed(Q, LINE, 0, VELOCITY),
            InvalidMotionError,
            "speed is 0.0, it must be positive",
        ),
        (
            lambda: trajectory.at_tool_speed(Q, LINE, np.nan, VELOCITY),
            InvalidMotionError,
            "speed is NaN",
        ),
        (
            lambda: trajectory.retime(Q[::60], VELOCITY, 1.0, T=LINE[::60], max_tool_speed=0.1),
            InvalidMotionError,
            r"joint \d steps by -?0\.\d+ rad to row \d+ of q, more than 0\.1 rad: .*nearer",
        ),
        (
            lambda: trajectory.retime(Q, VELOCITY, 1.0, T=LINE, max_tool_speed=-0.1),
            InvalidMotionError,
            "max_tool_speed is -0.1",
        ),
        (
            lambda: trajectory.retime(Q, VELOCITY, 1.0, T=LINE),
            ValueError,
            "give T and max_tool_speed together",
        ),
        (
            lambda: trajectory.retime(Q, VELOCITY, 1.0, max_tool_speed=0.1),
            ValueError,
            "give T and max_tool_speed together",
        ),
    ],
)
def test_what_is_no_path_of_a_tool_is_refused(call, error, words):
    with pytest.raises(error, match=words):
        call()
