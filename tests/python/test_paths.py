"""A path of poses as one joint path: continuous, inside the limits, with its breaks reported."""

import irbkin
import numpy as np
import pytest
from arms import ABB
from irbkin import FollowResult, InvalidJointsError, InvalidPoseError
from irbkin.records import Break
from reference import apart, move, rotation_apart
from strategies import subjects

NAME = "IRB 2600-12/1.65"
TIMES = np.linspace(-1, 1, 201)
# Distances from q5 = 0, also around 1e-12, below which a pose does not determine axis 4.
NEAR = [0.0, 1e-13, 1e-12, 2e-12, 3e-12, 1e-11, 1e-10, 1e-9, 1e-7, 1e-4]


@pytest.fixture(scope="module")
def robot():
    return irbkin.Robot(NAME)


def check_smooth(robot, made, reach, sin_5=1.0):
    """Every pose is met inside the limits, and no joint steps further than one and a half times the
    path's own step.

    Where the pose still tells J4, it tells it as exactly as the rounding of a rotation over `sin_5`
    says.
    """
    blurred = 2 * 4e-15 * (1 + reach) / sin_5
    poses = robot.fk(made)
    result = robot.follow(poses, made[0])
    assert isinstance(result, FollowResult)
    assert result.breaks == ()
    assert result.q.shape == made.shape
    errors = [
        np.abs(found - wanted)[:3, 3].max()
        for found, wanted in zip(robot.fk(result.q), poses, strict=True)
    ]
    # A pose within 1e-12 of a singularity keeps the joint that the path had.
    assert max(errors) <= 2e-12 * (1 + reach)
    assert result.orientation_error.max() <= 2e-12
    assert (
        np.abs(np.diff(result.q, axis=0)).max()
        <= 1.5 * np.abs(np.diff(made, axis=0)).max() + blurred
    )
    low, high = robot.limits.T
    assert ((result.q >= low - 1e-9) & (result.q <= high + 1e-9)).all()
    return result


@pytest.mark.parametrize("name", ABB)
def test_an_ordinary_path_is_the_one_that_made_the_poses(name):
    robot = irbkin.Robot(name)
    made = np.array([0.3, 0.2, 0.1, 0.4, 0.8, -0.3]) + np.outer(
        TIMES, [0.4, 0.2, -0.3, 0.5, 0.3, 0.9]
    )
    result = check_smooth(robot, made, subjects()[name].reach)
    sigma = robot.singularity(made).min_singular_value.min()
    assert np.abs(result.q - made).max() <= 1e-14 * (1 + subjects()[name].reach) / sigma


@pytest.mark.parametrize("near", NEAR)
@pytest.mark.parametrize("name", ABB)
def test_the_wrist_is_passed_without_a_jump(name, near):
    through = np.array([0.3, 0.2, 0.1, 0.7, near, -0.4]) + np.outer(
        TIMES, [0.1, 0, 0.1, 0.3, 0.5, 0]
    )
    check_smooth(irbkin.Robot(name), through, subjects()[name].reach)


@pytest.mark.parametrize("near", NEAR)
@pytest.mark.parametrize("name", ABB)
def test_a_path_along_the_wrist_singularity_has_no_jump(name, near):
    """Below 1e-12 the pose does not determine J4, which is extrapolated; above, the pose determines
    it.
    """
    along = np.array([0.3, 0.2, 0.1, 0.7, near, -0.4]) + np.outer(TIMES, [0.3, 0, 0.1, 0.4, 0, 0])
    check_smooth(
        irbkin.Robot(name), along, subjects()[name].reach, sin_5=near if near >= 1e-12 else 1.0
    )


@pytest.mark.parametrize("name", ["IRB 120-3/0.58", "IRB 2600-12/1.65"])
def test_the_elbow_is_passed_without_a_jump(name):
    _, elbow, _, _, forearm, _ = ABB[name].lengths
    robot, stretched = irbkin.Robot(name), np.arctan2(elbow, forearm) - np.pi / 2
    made = np.array([0, 0.4, stretched, 0.3, 0.8, 0.2]) + np.outer(TIMES, [0.3, 0.3, 0.2, 0, 0, 0])
    check_smooth(robot, made, subjects()[name].reach)


def test_turns_are_counted_on(robot):
    made = np.array([0.3, 0.2, 0.1, 0, 0.8, 0]) + np.outer(
        TIMES, np.deg2rad([0, 0, 0, 390, 0, -390])
    )
    result = check_smooth(robot, made, subjects()[NAME].reach)
    np.testing.assert_allclose(result.q, made, rtol=0, atol=1e-9)


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


def test_a_corner_in_the_wrist_singularity_is_a_break_that_names_the_joint(robot):
    turned = np.where(TIMES < 0, 0, np.pi / 3)
    made = np.column_stack([
        np.full(201, 0.3), np.full(201, 0.2), np.full(201, 0.1),
        0.2 + turned, 0.5 * TIMES, 0.1 - turned,
    ])  # fmt: skip
    (broken,) = robot.follow(robot.fk(made), made[0]).breaks
    assert broken.pose_index == 101
    assert broken.reason.startswith("pose 101: J4 must turn by ")
    assert broken.reason.endswith(" deg on the spot, at the wrist singularity")


def path_past_the_wrist(robot, off):
    """A straight line of the tool past the wrist singularity by `off` [rad], its orientation
    kept.
    """
    middle = robot.fk([0.3, 0.2, 0.1, np.pi / 2 if off else 0, off, 0.2])
    line = np.array([move(0, 0.15 * t, 0.02 * t) @ middle for t in TIMES])
    return line, robot.ik_nearest(line[0], [0.3, 0.2, 0.1, 0, 0.3, 0.2])


@pytest.mark.parametrize("off", [0.0, 1e-4, 2e-3])
@pytest.mark.parametrize("mode", ["through", "wrist", "lock_axis4"])
def test_a_singularity_mode_keeps_the_position_and_reports_the_orientation(robot, mode, off):
    path, seed = path_past_the_wrist(robot, off)
    result = robot.follow(path, seed, singularity_mode=mode)
    assert result.breaks == ()
    found = robot.fk(result.q)
    assert np.linalg.norm(found[:, :3, 3] - path[:, :3, 3], axis=1).max() <= 1e-14
    errors = [rotation_apart(one, other) for one, other in zip(found, path, strict=True)]
    np.testing.assert_allclose(result.orientation_error, errors, rtol=0, atol=1e-14)
    if mode == "through":
        assert max(errors) <= 1e-14
    else:
        # Two samples are 1.5 mm apart: without the crossing of J4 no joint moves by a degree.
        assert np.abs(np.diff(result.q, axis=0)).max() <= 0.02
    if mode == "wrist":
        assert max(errors) <= 2 * 0.0175
    if mode == "lock_axis4":
        np.testing.assert_array_equal(result.q[:, 3] % np.pi, 0)


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


def test_the_path_starts_at_the_solution_nearest_to_the_seed(robot):
    pose = robot.fk([0.1, -0.2, 0.3, 0.4, 0.5, 0.6])
    for solution in robot.ik(pose).within_limits():
        np.testing.assert_allclose(
            robot.follow(pose[None], solution.q).q[0], solution.q, rtol=0, atol=1e-12
        )


def test_weights_choose_where_the_path_starts(robot):
    pose, rng = robot.fk([0.1, -0.2, 0.3, 0.4, 0.5, 0.6]), np.random.default_rng(1)
    differ = 0
    for seed in rng.uniform(-3, 3, (20, 6)):
        weights = [1, 1, 1, 0.01, 0.01, 0.01]
        start = robot.follow(pose[None], seed, weights=weights).q[0]
        assert apart(start, robot.ik(pose).nearest(seed, weights=weights).q) <= 1e-12
        differ += np.abs(start - robot.follow(pose[None], seed).q[0]).max() > 0.1
    assert differ > 0


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


def test_an_arm_of_seven_joints_cannot_follow():
    with pytest.raises(irbkin.InvalidModelError, match="follow is for arms of six joints"):
        irbkin.Robot("Panda").follow(np.zeros((2, 4, 4)), np.zeros(6))
