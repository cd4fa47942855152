"""Trajectories of joints: against roboticstoolbox and toppra, and by laws."""

import copy
import pickle
import re
import subprocess
import sys

import irbkin
import numpy as np
import pytest
from irbkin import InvalidJointsError, InvalidMotionError, IrbkinError, trajectory

# The article's example, as axis angles of the Denavit-Hartenberg table.
START = np.radians([0, -90, 0, 0, 90, -180])
END = np.radians([90, -100, 40, 10, 60, -120])


@pytest.mark.extra
def test_the_article_s_quintic_is_that_of_roboticstoolbox():
    import roboticstoolbox as toolbox

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
    import toppra
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


@pytest.mark.extra
def test_a_line_retimed_is_as_fast_as_toppra():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    start = irbkin.pose([0.85, -0.4, 0.64], wxyz=[0.2588190, 0, 0.9659258, 0])
    end = irbkin.pose([0.85, 0.4, 0.64], wxyz=[0.5, 0.1, 0.8602325267, 0])
    path = robot.follow(irbkin.paths.line(start, end, steps=1000), np.zeros(6)).q
    velocity, acceleration = robot.max_velocity, 5 * robot.max_velocity
    move = trajectory.retime(path, velocity, acceleration)
    assert move.duration <= 1.01 * duration_of_toppra(path, velocity, acceleration)


@pytest.mark.extra
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


# Two joints that swing out between waypoints that are inside, by every function.
LIMITS = np.array([[-1.0, 1.0], [-0.5, 1.0]])
INSIDE = np.array([[0, -0.5], [1, -0.5], [1, 0.2], [1, 0.9]])
TOOL = np.repeat(np.eye(4)[None], 4, axis=0)
TOOL[:, 0, 3] = np.arange(4)
_SWINGING = trajectory.spline(INSIDE)
FINE = _SWINGING.sample(np.linspace(0, _SWINGING.duration, 200)).q
FINE_TOOL = np.repeat(np.eye(4)[None], 200, axis=0)
FINE_TOOL[:, 0, 3] = np.linspace(0, 3, 200)
MAKERS = {
    "joint": lambda limits: trajectory.joint(
        [0, 0], [0, 0.1], start_velocity=[0, -3], limits=limits
    ),
    "spline": lambda limits: trajectory.spline(INSIDE, limits=limits),
    "spline within limits": lambda limits: trajectory.spline(
        INSIDE, max_velocity=2.0, profile="cubic", limits=limits
    ),
    "retime": lambda limits: trajectory.retime(INSIDE, 2.0, 8.0, limits=limits),
    "retime with a tool": lambda limits: trajectory.retime(
        FINE, 2.0, 8.0, T=FINE_TOOL, max_tool_speed=0.1, limits=limits
    ),
    "at_tool_speed": lambda limits: trajectory.at_tool_speed(INSIDE, TOOL, 0.1, 2.0, limits=limits),
}


@pytest.mark.parametrize("name", MAKERS)
def test_a_joint_that_leaves_its_limits_between_waypoints_is_named(name):
    make = MAKERS[name]
    move = make(None)
    least, most = move.range().T
    dense = move.sample(np.linspace(0, move.duration, 5001)).q
    np.testing.assert_allclose(dense.min(axis=0), least, rtol=0, atol=1e-5)
    np.testing.assert_allclose(dense.max(axis=0), most, rtol=0, atol=1e-5)
    # The range is inside itself, and limits that are open are no limits.
    assert make(move.range()) == make([[-np.inf, np.inf]] * 2) == move
    with pytest.raises(InvalidMotionError) as refused:
        make(LIMITS)
    words = r"joint (\d) is at (\S+) rad at (\S+) s, its limit is (\S+) rad \(excess (\S+) rad\)"
    joint, value, time, limit, excess = map(float, re.match(words, str(refused.value)).groups())
    beyond = np.maximum(LIMITS[:, 0] - least, most - LIMITS[:, 1])
    assert joint == 1 + np.argmax(beyond)
    assert excess == pytest.approx(beyond.max(), rel=1e-2)
    assert abs(value - limit) == pytest.approx(beyond.max(), abs=1e-8)
    assert move.sample(time).q[int(joint) - 1] == pytest.approx(value, abs=1e-5)
    with pytest.raises(InvalidMotionError, match="its limit is"):
        move.check_limits(LIMITS)
    with pytest.raises(InvalidMotionError, match=r"limits must have shape \(2, 2\), got \(2,\)"):
        make([0, 1])
    with pytest.raises(InvalidMotionError, match=r"limits of joint 2 are 1\.0 and -1\.0, lower"):
        make([[0, 1], [1, -1]])
    with pytest.raises(InvalidMotionError, match=r"limits of joint 1 are NaN and 1\.0"):
        make([[np.nan, 1], [1, 1]])


def test_a_path_is_retimed_from_and_to_its_own_velocities():
    rng = np.random.default_rng(1)
    robot = irbkin.Robot("IRB 2600-12/1.65")
    for _ in range(10):
        row = np.outer(np.linspace(0, 1, 41), rng.uniform(-2, 2, 6))
        whole = trajectory.retime(row, robot.max_velocity, 8.0)
        index = rng.integers(1, 40)
        low, high = 0.0, whole.duration
        for _ in range(60):
            cut = 0.5 * (low + high)
            is_before = abs(whole.sample(cut).q[0]) < abs(row[index, 0])
            low, high = (cut, high) if is_before else (low, cut)
        dq = whole.sample(cut).dq
        first = trajectory.retime(row[: index + 1], robot.max_velocity, 8.0, end_velocity=dq)
        # What a motion ends with is where the next one begins.
        rest = trajectory.retime(
            row[index:], robot.max_velocity, 8.0, start_velocity=first.dq[-1], limits=None
        )
        joined = first + rest
        np.testing.assert_allclose(joined.duration, whole.duration, rtol=2e-3)
        assert (joined.peaks().velocity <= robot.max_velocity * (1 + 1e-9)).all()
        assert (joined.peaks().acceleration <= 8.0 * (1 + 1e-9)).all()


@pytest.mark.parametrize(
    ("velocity", "words"),
    [
        ([1, -2.1], r"joint 1 has 1\.0 rad/s, in the direction of the path it would have 1\.04"),
        ([-1, 2], "joint 1 has -1.0 rad/s, in the direction of the path it would have 0.0"),
        ([2, -4], "is too fast for the path and its limits, 0.75[0-9]* of it is possible"),
        ([np.nan, 0], r"\[0\] is NaN: every element must be finite"),
        ([1, 2, 3], r" must be a number or have shape \(2,\), got \(3,\)"),
    ],
)
@pytest.mark.parametrize("end", ["start_velocity", "end_velocity"])
def test_a_velocity_that_the_path_cannot_have_is_refused(end, velocity, words):
    path = np.outer(np.linspace(0, 1, 20), [1, -2])
    with pytest.raises(InvalidMotionError, match=end + ".*" + words):
        trajectory.retime(path, 3.0, 100.0, **{end: velocity})


def test_rest_and_times_of_a_trajectory_are_taken_back():
    move = trajectory.joint(START, END, profile="s_curve", max_velocity=2, max_jerk=900)
    end = move.sample(move.duration)
    back = trajectory.joint(
        end.q,
        START,
        start_velocity=end.dq,
        start_acceleration=end.ddq,
        profile="s_curve",
        max_velocity=2,
        max_jerk=900,
    )
    assert (move + back).slice(move.duration, move.duration + back.duration).duration > 0
    assert move.slice(0, move.duration * (1 + 1e-15)).duration == move.duration


def test_the_memory_of_a_long_rough_path_is_two_kilobytes_a_sample():
    program = """
import resource
import numpy as np
from irbkin import trajectory

walk = np.cumsum(np.random.default_rng(1).uniform(-0.1, 0.1, (60_000, 6)), axis=0)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
trajectory.retime(walk, 3.0, 10.0)
print((resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024 / len(walk))
"""
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert float(run.stdout) < 2048


def test_a_path_is_retimed_with_limits_of_jerk():
    q = np.array([[0.0, 0.0], [1.0, 0.2], [1.5, 1.0], [0.8, 1.2]])
    fastest, smooth = (trajectory.retime(q, 2.0, 8.0, max_jerk=it) for it in (None, [60.0, 90.0]))
    assert (smooth.peaks().jerk <= np.array([60.0, 90.0]) * (1 + 1e-12)).all()
    assert fastest.duration < smooth.duration < 1.5 * fastest.duration
    np.testing.assert_allclose(smooth.q[[0, -1]], q[[0, -1]], rtol=0, atol=1e-9)
    np.testing.assert_allclose(smooth.ddq[[0, -1]], 0, atol=1e-9)
    with pytest.raises(irbkin.InvalidMotionError, match="end_velocity must be zero with max_jerk"):
        trajectory.retime(q, 2.0, 8.0, max_jerk=60.0, end_velocity=[-0.1, 0.0])


OPEN = [[-np.inf, np.inf]] * 6
SCREW = [*START[:5], 45.0]


@pytest.mark.parametrize("turned", [[90.0, 1e-15, 0, 0, -2e-14, 0], [12.5, -20.1, 0, 1.0, 35.5, 0]])
@pytest.mark.parametrize(
    "call",
    [
        lambda q, **limits: trajectory.joint([0] * 6, q, **limits),
        lambda q, **limits: trajectory.joint(q, START, max_velocity=1.0, **limits),
        lambda q, **limits: trajectory.spline([[0] * 6, q, [1] * 6], **limits),
        lambda q, **limits: trajectory.retime([[0] * 6, [1] * 6, q], 1.0, 1.0, **limits),
    ],
)
def test_a_motion_in_degrees_is_asked_back_unless_limits_answer(call, turned):
    with pytest.raises(InvalidJointsError, match=r"q[01]?: joint [15] is .* pass degrees\?"):
        call(turned)
    assert call(turned, limits=OPEN).duration > 0.0


@pytest.mark.parametrize(
    "q", [[90.0], [0.5, 40.0], SCREW, [0, 0, 0, 0, 0, 20 * np.pi], [0, 6, 0, 0, 0, 40]]
)
def test_motions_of_many_turns_need_no_limits(q):
    assert trajectory.joint([0] * len(q), q).duration == 1.0
    assert trajectory.spline([[0] * len(q), q]).duration == 1.0
    assert trajectory.retime(np.linspace([0] * 6, [90, 8, 8, 8, 0, 0], 100), 1.0, 1.0).duration > 0
