"""A path of poses as one joint path: continuous, inside the limits, with its breaks reported."""

import irbkin
import numpy as np
import pytest
from irbkin import InvalidJointsError, InvalidPoseError
from irbkin.records import Break
from reference import move

NAME = "IRB 2600-12/1.65"
TIMES = np.linspace(-1, 1, 201)


@pytest.fixture(scope="module")
def robot():
    return irbkin.Robot(NAME)


def test_a_pose_out_of_reach_is_a_break_and_the_path_goes_on(robot):
    made = np.array([0.3, 0.2, 0.1, 0.4, 0.8, -0.3]) + np.outer(TIMES, [0.4, 0, 0, 0, 0, 0])
    poses = robot.fk(made)
    poses[50, 0, 3] += 5
    result = robot.follow(poses, made[0])
    assert [broken.pose_index for broken in result.breaks] == [50]
    assert isinstance(result.breaks[0], Break)
    assert result.breaks[0].reason.startswith("pose 50: wrist center ")
    assert np.isnan(result.q[50]).all()
    assert np.isnan(result.orientation_error[50])
    others = np.arange(len(made)) != 50
    np.testing.assert_allclose(result.q[others], made[others], rtol=0, atol=1e-9)


def path_past_the_wrist(robot, off):
    """A straight line of the tool past the wrist singularity by `off` [rad], its orientation
    kept.
    """
    middle = robot.fk([0.3, 0.2, 0.1, np.pi / 2 if off else 0, off, 0.2])
    line = np.array([move(0, 0.15 * t, 0.02 * t) @ middle for t in TIMES])
    return line, robot.ik_nearest(line[0], [0.3, 0.2, 0.1, 0, 0.3, 0.2])


def test_the_error_mode_stops_at_the_singularity(robot):
    path, seed = path_past_the_wrist(robot, 0.0)
    result = robot.follow(path, seed, singularity_mode="error", zone=0.05)
    (broken,) = result.breaks
    assert "stopped at the wrist singularity, J5 is " in broken.reason
    assert not np.isnan(result.q[: broken.pose_index]).any()
    assert np.isnan(result.q[broken.pose_index :]).all()
    assert (np.abs(np.sin(result.q[: broken.pose_index, 4])) >= 0.05).all()
    wider = robot.follow(path, seed, singularity_mode="error", zone=0.1)
    assert wider.breaks[0].pose_index < broken.pose_index


@pytest.mark.parametrize("lead", [(3,), (2, 3), (0,)])
def test_several_paths_are_each_followed_alone(robot, lead):
    rng = np.random.default_rng(3)
    made = rng.uniform(-0.5, 0.5, (*lead, 1, 6)) + 0.3 * np.sin(
        np.arange(20)[:, None] * np.linspace(0.05, 0.1, 6)
    )
    poses = robot.fk(made)
    # A pose that no arm reaches breaks the path that it belongs to, and no other.
    if poses.size:
        poses[(*(size - 1 for size in lead), 7, 0, 3)] += 10.0
    seeds = made[..., 0, :]
    together = robot.follow(poses, seeds)
    assert (together.q.shape, together.orientation_error.shape) == ((*lead, 20, 6), (*lead, 20))
    breaks = []
    for path in np.ndindex(lead):
        alone = robot.follow(poses[path], seeds[path])
        np.testing.assert_array_equal(together.q[path], alone.q)
        np.testing.assert_array_equal(together.orientation_error[path], alone.orientation_error)
        breaks += [Break(*broken[:2], path, broken.kind) for broken in alone.breaks]
    assert together.breaks == tuple(breaks)
    assert bool(breaks) == bool(poses.size)


def test_one_seed_serves_several_paths(robot):
    poses = robot.fk(np.linspace([0.1] * 6, [0.3] * 6, 10))
    together = robot.follow(np.stack([poses, poses]), np.full(6, 0.1))
    np.testing.assert_array_equal(together.q[0], together.q[1])


def test_bad_seed_among_several_is_named(robot):
    seeds = np.zeros((2, 6))
    seeds[1, 2] = np.nan
    with pytest.raises(InvalidJointsError, match=r"seed\[1\]: seed: joint 3 is NaN"):
        robot.follow(robot.fk(np.zeros((2, 3, 6))), seeds)
    with pytest.raises(
        InvalidJointsError,
        match=r"seed of shape \(3, 6\) cannot be broadcast with T of shape \(2, 3, 4, 4\): leading",
    ):
        robot.follow(robot.fk(np.zeros((2, 3, 6))), np.zeros((3, 6)))


def test_an_empty_path_has_an_empty_answer(robot):
    result = robot.follow(np.zeros((0, 4, 4)), np.zeros(6))
    assert (result.q.shape, result.orientation_error.shape, result.breaks) == ((0, 6), (0,), ())


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        (
            {"T": np.eye(4)},
            InvalidPoseError,
            r"T must have shape \(\.\.\., m, 4, 4\), got \(4, 4\)",
        ),
        ({"T": np.zeros((1, 2, 4, 4))}, InvalidPoseError, r"T\[0, 0\]: pose row 3 must be"),
        (
            {"T": np.zeros((2, 1, 4, 4)), "seed": np.zeros((3, 6))},
            InvalidJointsError,
            r"seed of shape \(3, 6\) cannot be broadcast with T of shape \(2, 1, 4, 4\)",
        ),
        ({"T": [np.eye(4), np.eye(4) * np.nan]}, InvalidPoseError, r"T\[1\]: pose\[0, 0\] is NaN"),
        ({"T": [np.eye(4), 2 * np.eye(4)]}, InvalidPoseError, r"T\[1\]: pose row 3 must be"),
        ({"seed": [np.nan] * 6}, InvalidJointsError, "seed: joint 1 is NaN"),
        (
            {"seed": [0.0] * 5},
            InvalidJointsError,
            r"seed must have shape \(\.\.\., 6\), got \(5,\)",
        ),
        ({"weights": [-1] * 6}, InvalidJointsError, "weights: joint 1 is -1"),
        ({"zone": np.nan}, InvalidJointsError, "zone is NaN, it must be 0 to 1"),
        ({"zone": 5.0}, InvalidJointsError, "zone is 5, it must be 0 to 1"),
        ({"zone": -1}, InvalidJointsError, "zone is -1, it must be 0 to 1"),
        ({"zone": "x"}, TypeError, "real number"),
        (
            {"singularity_mode": "wrists"},
            ValueError,
            'singularity_mode must be "through", "error", "wrist" or "lock_axis4", got "wrists"',
        ),
        ({"singularity_mode": None}, TypeError, "str"),
    ],
)
def test_bad_input_is_named(robot, change, error, words):
    given = {"T": robot.fk(np.zeros((2, 6))), "seed": np.zeros(6)} | change
    with pytest.raises(error, match=words):
        robot.follow(**given)


def test_seven_joints_follow_by_the_smallest_steps():
    panda = irbkin.Robot("Panda")
    start = np.array([0.1, -0.6, 0.2, -2.2, 0.1, 1.7, 0.6])
    made = start + np.linspace(0, 1, 41)[:, None] * [0.3, 0.1, -0.2, 0.1, 0.2, -0.1, 0.1]
    T = panda.fk(made)
    followed = panda.follow(T, start)
    assert followed.q.shape == (41, 7)
    assert followed.breaks == ()
    assert np.abs(panda.fk(followed.q) - T).max() < 1e-11
    lengths = [np.linalg.norm(np.diff(q, axis=0), axis=1).sum() for q in (followed.q, made)]
    assert lengths[0] < lengths[1]
    many = panda.follow(T, np.stack([start, start + 0.01]), threads=2)
    assert many.q.shape == (2, 41, 7)
    assert np.array_equal(many.q[0], followed.q)
    assert panda.follow(np.zeros((0, 4, 4)), start).q.shape == (0, 7)
    with pytest.raises(irbkin.InvalidJointsError, match="seed: joint 1 is NaN"):
        panda.follow(T, start * np.nan)
    with pytest.raises(irbkin.InvalidPoseError, match=r"T\[0\]: pose\[0, 0\] is NaN"):
        panda.follow(T * np.nan, start)
    # Joint 2 passes zero, where axes 1 and 3 are one line.
    through = np.linspace([0, -0.3, 0, -1.5, 0, 1.5, 0], [0, 0.3, 0, -1.5, 0, 1.5, 0], 21)
    followed = panda.follow(panda.fk(through), through[0])
    assert followed.breaks == ()
    assert np.abs(np.diff(followed.q, axis=0)).max() < 0.1
    with pytest.raises(irbkin.InvalidModelError, match=r"wrist.*locked"):
        panda.follow(T, start, singularity_mode="wrist")
