"""Seeds, limits, turns and paths at singular poses: any combination of them keeps the laws."""

import irbkin
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from irbkin import Reach, SingularityKind

ARM = irbkin.Robot("IRB 2600-12/1.65")
STRETCHED = np.arctan2(0.115, 0.795) - np.pi / 2
NEAR = [0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4]
# A seeded solve may keep the seed's free joint where the pose is within 1e-12 of a singularity.
SEEDED = 2e-12


def over_the_base(q3):
    """Axis 2 with the wrist center on axis 1."""
    along, across = (
        0.7 - 0.795 * np.sin(q3) + 0.115 * np.cos(q3),
        0.795 * np.cos(q3) + 0.115 * np.sin(q3),
    )
    return np.arcsin(-0.15 / np.hypot(along, across)) - np.arctan2(across, along)


@st.composite
def singular_joints(draw):
    """Joint vectors at or next to one singularity, or to none."""
    q = np.array(
        [
            draw(st.floats(low, high))
            for low, high in [(-3, 3), (-0.5, 0.6), (-0.8, 0.5), (-6, 6), (0.3, 1.8), (-6, 6)]
        ]
    )
    near = draw(st.sampled_from(NEAR)) * draw(st.sampled_from([-1, 1]))
    kind = draw(st.sampled_from(["none", "wrist", "elbow", "shoulder"]))
    if kind == "wrist":
        q[4] = near
    elif kind == "elbow":
        q[2] = STRETCHED + near
    elif kind == "shoulder":
        q[1] = over_the_base(q[2]) + near
    return q


@st.composite
def limits_around(draw, q):
    """Limits that hold `q` in, from less than a turn to several."""
    below, above = (np.array([draw(st.floats(0.1, 7)) for _ in range(6)]) for _ in range(2))
    return np.stack([q - below, q + above], axis=1)


@given(
    data=st.data(),
    q=singular_joints(),
    seed=st.lists(st.floats(-9, 9), min_size=6, max_size=6).map(np.array),
)
def test_the_nearest_is_inside_closes_and_is_the_nearest(data, q, seed):
    robot = ARM.with_limits(data.draw(limits_around(q)))
    pose = robot.fk(q)
    found = robot.ik_nearest(pose, seed)
    assert np.all(found >= robot.limits[:, 0] - 1e-9)
    assert np.all(found <= robot.limits[:, 1] + 1e-9)
    # If the seed's free joint is outside the limits, another member of the self-motion is inside,
    # to twice the distance from the singularity.
    distances = robot.singularity(q)
    off = sum(distance for distance in (distances.wrist, distances.shoulder) if distance <= 1.5e-9)
    assert np.abs(robot.fk(found) - pose).max() <= SEEDED + 2 * off + 1e-14
    turns = robot.ik(pose).turns()
    cost = np.linalg.norm(np.asarray(turns) - seed, axis=1)
    # At a singularity another member of a self-motion may be nearer than its representative;
    # none is farther.
    if len(turns):
        assert np.linalg.norm(found - seed) <= cost.min() + 1e-9


@given(q=singular_joints(), seed=st.lists(st.floats(-9, 9), min_size=6, max_size=6).map(np.array))
def test_the_nearest_of_a_singular_wrist_shares_the_way_between_axes_4_and_6(q, seed):
    q[4] = 0.0
    robot = ARM.with_limits([[-np.inf, np.inf]] * 6)
    pose = robot.fk(q)
    assume(SingularityKind.SHOULDER not in robot.ik(pose)[0].singularities)
    found = robot.ik_nearest(pose, seed)
    assume(abs(np.sin(found[4])) < 1e-13)
    # At the least cost angles that are off by 1e-5 change it by their square.
    assert abs(abs(found[3] - seed[3]) - abs(found[5] - seed[5])) < 1e-5
    assert abs(found[3] - seed[3]) <= np.pi / 2 + 1e-5


@given(q=singular_joints(), value=st.floats(-6, 6))
def test_the_tool_stays_where_the_free_joint_goes(q, value):
    pose = ARM.fk(q)
    for solution in ARM.ik(pose):
        if solution.free_joint is None:
            with pytest.raises(irbkin.InvalidJointsError, match="no joint is free"):
                solution.with_free_joint(value)
            continue
        moved = solution.with_free_joint(value)
        assert moved.q[solution.free_joint.joint - 1] == value
        # To rounding at the singularity, by the distance from it next to it: that of joint 5, or
        # that of the wrist center of the pose, which a solution on the singularity does not have.
        is_wrist = solution.free_joint.joint == 4
        off = ARM.singularity(solution.q).wrist if is_wrist else ARM.singularity(q).shoulder
        assert moved.residual <= 2 * off + 1e-14
        if solution.free_joint.fixed == "q4 + q6":
            turned = moved.q[3] + moved.q[5] - solution.q[3] - solution.q[5]
            assert abs(turned - 2 * np.pi * np.round(turned / (2 * np.pi))) <= 1e-14 + 4 * off


@given(
    q=singular_joints(), rates=st.lists(st.floats(-0.3, 0.3), min_size=6, max_size=6).map(np.array)
)
def test_a_smooth_path_through_a_singularity_is_followed(q, rates):
    """The middle pose is the singular one."""
    path = q + rates * np.linspace(-1, 1, 41)[:, None]
    robot = ARM.with_limits([[-8, 8]] * 6)
    own = np.abs(np.diff(path, axis=0)).max()
    assume(own > 1e-3)
    # The mirror branch of an elbow that is passed is as good, and may lead elsewhere.
    elbow = path[:, 2] - STRETCHED
    assume(elbow.min() > 1e-3 or elbow.max() < -1e-3)
    poses = robot.fk(path)
    followed = robot.follow(poses, path[0])
    assert followed.breaks == ()
    # A path that stays on axis 1 leaves J1 open all along: other joints than those that made it may
    # follow it.
    steps = np.abs(np.diff(followed.q, axis=0)).max()
    assert steps <= 1.5 * own
    assert np.abs(robot.fk(followed.q) - poses).max() <= SEEDED
    assert followed.orientation_error.max() <= SEEDED


def test_an_elbow_that_is_stretched_and_bent_again_is_followed():
    t = np.linspace(-1, 1, 41)[:, None]
    path = (
        np.array([0.1, 0.4, STRETCHED, 0.3, 0.8, 0.2])
        + np.array([0.3, 0, 0, 0, 0.1, 0]) * t
        + [0, 0, 0.4, 0, 0, 0] * t * t
    )
    followed = ARM.follow(ARM.fk(path), path[0])
    assert followed.breaks == ()
    assert np.abs(np.diff(followed.q, axis=0)).max() <= 1.5 * np.abs(np.diff(path, axis=0)).max()


@pytest.mark.parametrize("mode", ["through", "error", "wrist", "lock_axis4"])
def test_a_singularity_mode_keeps_the_position(mode):
    line = np.repeat(ARM.fk([0.3, 0.2, 0.1, 0.0, 0.0, 0.2])[None], 101, axis=0)
    line[:, 1, 3] += np.linspace(-0.15, 0.15, 101)
    seed = ARM.ik(line[0]).nearest([0.3, 0.2, 0.1, 0, 0.1, 0.2]).q
    followed = ARM.follow(line, seed, singularity_mode=mode)
    met = ~np.isnan(followed.q[:, 0])
    reached = ARM.fk(followed.q[met])
    assert np.abs(reached[:, :3, 3] - line[met, :3, 3]).max() < 1e-14
    if mode == "error":
        (stop,) = followed.breaks
        assert stop.pose_index == met.sum() < len(line)
        assert stop.reason.startswith(
            f"pose {stop.pose_index}: stopped at the wrist singularity, J5 is "
        )
    else:
        assert met.all()
        assert followed.breaks == ()
    if mode == "lock_axis4":
        np.testing.assert_array_equal(followed.q[:, 3], 0.0)


def test_a_path_with_a_bad_pose_names_it():
    path = np.repeat(np.eye(4)[None], 3, axis=0)
    path[1, 0, 0] = np.nan
    with pytest.raises(irbkin.InvalidPoseError, match=r"T\[1\]: pose\[0, 0\] is NaN"):
        ARM.follow(path, np.zeros(6))


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        (
            {"T": np.eye(4)},
            irbkin.InvalidPoseError,
            r"T must have shape \(\.\.\., m, 4, 4\), got \(4, 4\)",
        ),
        (
            {"seed": np.zeros(5)},
            irbkin.InvalidJointsError,
            r"seed must have shape \(\.\.\., 6\), got \(5,\)",
        ),
        ({"seed": [np.inf] * 6}, irbkin.InvalidJointsError, "seed: joint 1 is inf"),
        ({"weights": -np.ones(6)}, irbkin.InvalidJointsError, "weights: joint 1 is -1"),
        ({"singularity_mode": "wrists"}, ValueError, 'got "wrists"'),
        ({"zone": -1.0}, irbkin.InvalidJointsError, "zone is -1, it must be 0 to 1"),
        ({"zone": 5.0}, irbkin.InvalidJointsError, "zone is 5, it must be 0 to 1"),
        ({"zone": np.inf}, irbkin.InvalidJointsError, "zone is inf"),
        ({"zone": np.nan}, irbkin.InvalidJointsError, "zone is NaN"),
    ],
)
def test_arguments_of_follow_are_checked(arguments, error, words):
    arguments = {"T": np.eye(4)[None], "seed": np.zeros(6)} | arguments
    with pytest.raises(error, match=words):
        ARM.follow(**arguments)


def test_an_empty_path_has_an_empty_answer():
    followed = ARM.follow(np.empty((0, 4, 4)), np.zeros(6))
    assert followed.q.shape == (0, 6)
    assert followed.orientation_error.shape == (0,)


def test_a_pose_out_of_reach_is_a_break_and_a_row_of_nan():
    path = np.repeat(ARM.fk(np.full(6, 0.3))[None], 3, axis=0)
    path[1, 0, 3] += 5
    assert ARM.ik(path[1]).reach is Reach.TOO_FAR
    followed = ARM.follow(path, np.full(6, 0.3))
    assert [broken.pose_index for broken in followed.breaks] == [1]
    assert "beyond reach" in followed.breaks[0].reason
    np.testing.assert_array_equal(np.isnan(followed.q).all(axis=1), [False, True, False])
