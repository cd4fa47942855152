"""Trajectories of joints: against roboticstoolbox and toppra, and by laws."""

import copy
import pickle

import irbkin
import numpy as np
import pytest
from irbkin import InvalidJointsError, InvalidMotionError, IrbkinError, trajectory

# The article's example, as axis angles of the Denavit-Hartenberg table.
START = np.radians([0, -90, 0, 0, 90, -180])
END = np.radians([90, -100, 40, 10, 60, -120])


def test_the_article_s_quintic_is_that_of_roboticstoolbox():
    toolbox = pytest.importorskip("roboticstoolbox")
    reference = toolbox.jtraj(START, END, np.linspace(0, 1, 50))
    move = trajectory.joint(START, END, steps=50)
    np.testing.assert_allclose(move.t, np.linspace(0, 1, 50), rtol=0, atol=1e-15)
    np.testing.assert_allclose(move.q, reference.q, rtol=0, atol=1e-12)
    np.testing.assert_allclose(move.dq, reference.qd, rtol=0, atol=1e-12)
    np.testing.assert_allclose(move.ddq, reference.qdd, rtol=0, atol=1e-12)


def test_given_ends_are_met():
    rng = np.random.default_rng(1)
    ends = rng.uniform(-2, 2, (6, 4))
    move = trajectory.joint(
        ends[0],
        ends[1],
        duration=1.7,
        start_velocity=ends[2],
        end_velocity=ends[3],
        start_acceleration=ends[4],
        end_acceleration=ends[5],
    )
    for found, wanted in zip(
        [move.q[0], move.q[-1], move.dq[0], move.dq[-1], move.ddq[0], move.ddq[-1]],
        ends,
        strict=True,
    ):
        np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-12)


def duration_of_toppra(path, velocity, acceleration):
    """Of a path on the same spline, with 1,000 points of its grid."""
    toppra = pytest.importorskip("toppra")
    from toppra import algorithm, constraint

    toppra.setup_logging("ERROR")
    lengths = np.r_[0, np.cumsum(np.linalg.norm(np.diff(path, axis=0), axis=1))]
    limits = [
        constraint.JointVelocityConstraint(np.c_[-velocity, velocity]),
        constraint.JointAccelerationConstraint(np.c_[-acceleration, acceleration]),
    ]
    solver = algorithm.TOPPRA(
        limits,
        toppra.SplineInterpolator(lengths, path),
        gridpoints=np.linspace(0, lengths[-1], 1000),
        parametrizer="ParametrizeConstAccel",
    )
    return solver.compute_trajectory().duration


def test_a_line_retimed_is_as_fast_as_toppra():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    start = irbkin.pose([0.85, -0.4, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
    end = irbkin.pose([0.85, 0.4, 0.64], wxyz=[0.5, 0.1, 0.8602325267, 0])
    path = robot.follow(irbkin.paths.line(start, end, steps=1000), np.zeros(6)).q
    velocity, acceleration = robot.max_velocity, 5 * robot.max_velocity
    move = trajectory.retime(path, velocity, acceleration)
    assert move.duration <= 1.01 * duration_of_toppra(path, velocity, acceleration)


@pytest.mark.parametrize("count", [5, 20, 100])
def test_random_waypoints_retimed_are_as_fast_as_toppra_which_exceeds_limits(count):
    robot = irbkin.Robot("IRB 2600-12/1.65")
    path = np.random.default_rng(count).uniform(-2, 2, (count, 6))
    velocity, acceleration = robot.max_velocity, 5 * robot.max_velocity
    move = trajectory.retime(path, velocity, acceleration)
    assert move.duration <= 1.01 * duration_of_toppra(path, velocity, acceleration)
    peaks = move.peaks()
    assert (peaks.velocity <= velocity * (1 + 1e-9)).all()
    assert (peaks.acceleration <= acceleration * (1 + 1e-9)).all()


def test_a_trajectory_is_a_value():
    move = trajectory.joint(START, END, steps=20, duration=2.0)
    for other in (pickle.loads(pickle.dumps(move)), copy.copy(move), copy.deepcopy(move)):
        assert other == move
        assert hash(other) == hash(move)
        np.testing.assert_array_equal(other.ddq, move.ddq)
    assert move != move.stretched(2.0)
    assert repr(move) == "Trajectory(20 samples of 6 joints, 2.000000 s)"
    with pytest.raises(ValueError, match="read-only"):
        move.q[0, 0] = 1


def test_parts_join_to_the_whole():
    move = trajectory.joint(START, END, steps=21, duration=2.0)
    joined = move.slice(0, 0.73) + move.slice(0.73, 2.0)
    times = np.linspace(0, 2, 50)
    np.testing.assert_allclose(joined.sample(times).q, move.sample(times).q, rtol=0, atol=1e-13)
    assert (np.diff(joined.t) > 0).all()
    there_and_back = move + trajectory.joint(END, START)
    np.testing.assert_allclose(there_and_back.q[-1], START, rtol=0, atol=1e-13)
    slow = move.stretched(2.0)
    assert slow.duration == 4.0
    np.testing.assert_allclose(slow.dq, move.dq / 2, rtol=0, atol=1e-14)
    assert len(move.resampled(101)) == 101


NAN = [np.nan] * 6


@pytest.mark.parametrize(
    ("call", "error", "words"),
    [
        (
            lambda: trajectory.joint(START, END[:5]),
            InvalidJointsError,
            r"q1 must have shape \(6,\)",
        ),
        (lambda: trajectory.joint([START], END), InvalidJointsError, r"q0 must have shape \(n,\)"),
        (lambda: trajectory.joint([], []), InvalidMotionError, "q0 has no joints"),
        (
            lambda: trajectory.joint(START, NAN),
            InvalidJointsError,
            "q1: joint 1 is NaN, every angle",
        ),
        (
            lambda: trajectory.joint([1e300], [0]),
            InvalidJointsError,
            "q0: joint 1 is 1e300 rad, .* 1e5",
        ),
        (
            lambda: trajectory.joint(START, END, duration=1e-100),
            InvalidMotionError,
            "takes 1e-100 s, it must take 1e-9 to 1e9 s",
        ),
        (
            lambda: trajectory.joint(START, END, duration=1e300),
            InvalidMotionError,
            "takes 1e300 s, it must take 1e-9 to 1e9 s",
        ),
        (
            lambda: trajectory.joint(START, END, max_velocity=1e-300),
            InvalidMotionError,
            "it must take 1e-9 to 1e9 s",
        ),
        (
            lambda: trajectory.joint(START, END, duration=1, max_velocity=np.nan),
            InvalidMotionError,
            r"max_velocity\[0\] is NaN, it must be positive",
        ),
        (
            lambda: trajectory.joint(START, END, duration=1, max_jerk=-1),
            InvalidMotionError,
            r"max_jerk\[0\] is -1.0, it must be positive",
        ),
        (
            lambda: trajectory.joint(START, END, start_velocity=np.nan),
            InvalidMotionError,
            r"start_velocity\[0\] is NaN",
        ),
        (lambda: trajectory.joint(START, END, duration=0), InvalidMotionError, "must be positive"),
        (lambda: trajectory.joint(START, END, duration=-1), InvalidMotionError, "duration is -1"),
        (
            lambda: trajectory.joint(START, END, steps=1),
            InvalidMotionError,
            "steps must be 2 to 10000000, got 1$",
        ),
        (
            lambda: trajectory.joint(START, END, steps=-1),
            InvalidMotionError,
            "steps must be 2 to 10000000, got -1",
        ),
        (
            lambda: trajectory.joint(START, END, steps=10**30),
            InvalidMotionError,
            f"steps must be 2 to 10000000, got {10**30}",
        ),
        (
            lambda: trajectory.joint(START, END).resampled(10**18),
            InvalidMotionError,
            f"steps must be 2 to 10000000, got {10**18}",
        ),
        (lambda: trajectory.joint(START, END, steps=5.5), TypeError, "float"),
        (
            lambda: trajectory.joint(START, END, profile="sine"),
            ValueError,
            'profile must be "quintic", .* got "sine"',
        ),
        (
            lambda: trajectory.joint(START, END, max_velocity=[1, 1]),
            InvalidMotionError,
            r"max_velocity must be a number or have shape \(6,\), got \(2,\)",
        ),
        (
            lambda: trajectory.joint(START, END, max_velocity=0),
            InvalidMotionError,
            r"max_velocity\[0\] is 0.0, it must be positive",
        ),
        (
            lambda: trajectory.joint(START, END, max_velocity=np.inf),
            InvalidMotionError,
            "joint 1 moves and has no limit",
        ),
        (
            lambda: trajectory.joint(START, END, duration=0.1, max_velocity=3),
            InvalidMotionError,
            "joint 1 reaches a velocity of 29.45",
        ),
        (
            lambda: trajectory.joint(START, END, profile="trapezoid", end_velocity=1),
            InvalidMotionError,
            "a trapezoid profile takes no velocity at an end",
        ),
        (lambda: trajectory.spline([START]), InvalidMotionError, "q has 1 rows, .* at least 2"),
        (
            lambda: trajectory.spline([START, END], t=[1, 1]),
            InvalidMotionError,
            r"t\[1\] is 1 s, it must be later than 1 s",
        ),
        (
            lambda: trajectory.spline([START, START, END]),
            InvalidMotionError,
            r"q\[1\] repeats the waypoint before it",
        ),
        (
            lambda: trajectory.spline([[0], [1], [2]], t=[0, 1e-320, 1]),
            InvalidMotionError,
            "the motion is not finite",
        ),
        (lambda: trajectory.spline([START, NAN]), InvalidJointsError, "row 1 of q: joint 1 is NaN"),
        (lambda: trajectory.retime(np.zeros((0, 6)), 1, 1), InvalidMotionError, "q has 0 rows"),
        (
            lambda: trajectory.retime(np.zeros((3, 0)), 1, 1),
            InvalidJointsError,
            r"q must have shape \(m, n\), got \(3, 0\)",
        ),
        (lambda: trajectory.retime([START, NAN], 1, 1), InvalidJointsError, "row 1 of q: joint 1"),
        (
            lambda: trajectory.retime([START, END], 1e300, 1e300),
            InvalidMotionError,
            "it must take 1e-9 to 1e9 s",
        ),
        (
            lambda: trajectory.retime([START, END], np.inf, np.inf),
            InvalidMotionError,
            "joint 1 moves and has no limit",
        ),
        (
            lambda: trajectory.joint(START, END) + trajectory.joint(START, END),
            InvalidMotionError,
            "joint 1 would jump by -1.571e0 rad",
        ),
        (lambda: trajectory.joint(START, END).slice(0.5, 0.5), InvalidMotionError, "a slice from"),
        (lambda: trajectory.joint(START, END).sample(np.nan), InvalidMotionError, r"t\[0\] is NaN"),
    ],
)
def test_what_makes_no_trajectory_is_refused(call, error, words):
    with pytest.raises(error, match=words):
        call()


def test_a_damaged_pickle_is_refused():
    motion = trajectory.joint(START, END)
    restore, (kind, state) = motion.__reduce__()
    assert restore(kind, state) == motion
    for size in range(len(state)):
        with pytest.raises(IrbkinError, match="the pickled Trajectory is damaged"):
            restore(kind, state[:size])
    with pytest.raises(IrbkinError, match="the pickled Trajectory is damaged"):
        restore(kind, b"\x00" + state[1:])
