"""The Panda and the FR3: every solution for a given joint 7, the nearest one along the redundancy,
frankik's answers.
"""

import irbkin
import numpy as np
import pytest
from arms import CATALOG
from irbkin import Status

NAMES = ("Panda", "FR3")


@pytest.fixture(params=NAMES, scope="module")
def robot(request):
    return irbkin.Robot(request.param)


def inside(robot, count, seed=3):
    low, high = robot.limits.T
    return np.random.default_rng(seed).uniform(low, high, (count, 7))


def wrapped(angles):
    return np.abs((np.asarray(angles) + np.pi) % (2 * np.pi) - np.pi)


def test_the_structure_is_recognized_by_name_and_by_table(robot):
    again = irbkin.Robot.from_mdh(CATALOG[robot.name].rows)
    assert robot.structure == again.structure == "spherical shoulder"
    q = inside(robot, 1)[0]
    np.testing.assert_allclose(
        again.ik(robot.fk(q), q7=q[6]).q, robot.ik(robot.fk(q), q7=q[6]).q, rtol=0, atol=1e-12
    )


def test_a_batch_has_the_single_answers(robot):
    q = inside(robot, 300)
    poses, q7 = robot.fk(q), q[:, 6]
    batch = robot.ik_batch(poses, q7)
    assert batch.q.shape == (300, 8, 7)
    for i in range(300):
        solutions = robot.ik(poses[i], q7=q7[i])
        np.testing.assert_array_equal(batch.q[i], solutions.q_by_slot)
        np.testing.assert_array_equal(batch.status[i], solutions.status)
    np.testing.assert_array_equal(
        robot.ik_batch(poses[:5], 0.3).q, robot.ik_batch(poses[:5], np.full(5, 0.3)).q
    )
    swept = robot.ik_batch(poses[0], q7[:7])
    np.testing.assert_array_equal(
        swept.q, robot.ik_batch(np.repeat(poses[:1], 7, axis=0), q7[:7]).q
    )
    crossed = robot.ik_batch(poses[:6].reshape(2, 3, 4, 4), q7[:2, None])
    assert crossed.q.shape == (2, 3, 8, 7)
    np.testing.assert_array_equal(crossed.q[1, 2], robot.ik(poses[5], q7=q7[1]).q_by_slot)
    out = irbkin.IkBatch(np.empty((300, 8, 7)), np.empty((300, 8), np.uint8))
    assert robot.ik_batch(poses, q7, out=out, threads=2).q is out.q
    np.testing.assert_array_equal(out.q, batch.q)


def test_an_empty_batch_is_empty(robot):
    none = np.empty((0, 4, 4))
    for batch in (
        robot.ik_batch(none, np.empty(0)),
        robot.ik_batch(none, 0.3),
        robot.ik_batch(np.eye(4), np.empty(0)),
    ):
        assert (batch.q.shape, batch.status.shape) == ((0, 8, 7), (0, 8))
    assert robot.ik_nearest(none, np.zeros(7)).shape == (0, 7)


def test_an_invalid_row_of_a_batch_is_flagged_and_the_others_are_solved(robot):
    q = inside(robot, 20)
    poses, q7 = robot.fk(q), q[:, 6].copy()
    good = robot.ik_batch(poses, q7)
    q7[3] = np.nan
    q7[4] = np.inf
    poses[7, 0, 0] = np.nan
    found = robot.ik_batch(poses, q7)
    for row in range(20):
        if row in (3, 4, 7):
            assert (found.status[row] == Status.INVALID).all()
            assert np.isnan(found.q[row]).all()
        else:
            np.testing.assert_array_equal(found.q[row], good.q[row])


def test_joint_7_is_needed_by_seven_joints_and_refused_by_six(robot):
    pose = robot.fk(np.zeros(7))
    for call in (lambda: robot.ik(pose), lambda: robot.ik_batch(pose[None])):
        with pytest.raises(TypeError, match="needs q7, the angle of joint 7"):
            call()
    with pytest.raises(TypeError, match="this one has six"):
        irbkin.Robot("UR3").ik(pose, q7=0.1)
    with pytest.raises(irbkin.InvalidJointsError, match="q7: joint 7 is NaN"):
        robot.ik(pose, q7=np.nan)
    with pytest.raises(
        irbkin.InvalidJointsError,
        match=r"q7 of shape \(3,\) cannot be broadcast with T of shape \(2, 4, 4\)",
    ):
        robot.ik_batch(np.stack([pose, pose]), np.zeros(3))


def test_joint_7_keeps_its_given_value_and_is_checked_against_its_limits(robot):
    q = inside(robot, 1)[0]
    beyond = robot.limits[6, 1] + 0.5
    solutions = robot.ik(robot.fk([*q[:6], beyond]), q7=beyond)
    assert (solutions.q[:, 6] == beyond).all()
    assert not any(solution.is_within_limits for solution in solutions)


@pytest.mark.parametrize(
    ("q", "seed"),
    [
        # Slot 3 is inside the limits for joint 7 between 1.2528 and 1.2651 only.
        (
            [-1.36, 0.83, -0.26, -0.07, -2.17, 1.63, 1.26],
            [-1.13, 0.86, -0.21, -0.2, -2.13, 1.62, 1.14],
        ),
        # Joint 6 is next to its limit.
        (
            [-0.4074, -0.9391, -2.8126, -1.2658, -1.5946, 0.0007, -0.7242],
            [-0.5, -1.125, -2.766, -1.389, -1.688, -0.018, -1.185],
        ),
        # A valley 1e-5 rad wide in joint 7, next to q2 = 0.
        (
            [-0.4421365, -0.0020093, 0.502814, -2.0948726, 1.4011852, 1.7055283, -0.9175759],
            [-0.4417741, -0.0008555, 0.5045441, -2.0943622, 1.3988604, 1.7069522, -0.9168968],
        ),
    ],
)
def test_narrow_windows_and_valleys_are_found(q, seed):
    panda = irbkin.Robot("Panda")
    nearest = panda.ik_nearest(panda.fk(q), seed)
    assert np.linalg.norm(np.subtract(nearest, seed)) <= np.linalg.norm(np.subtract(q, seed)) + 1e-9


def test_ik_nearest_of_the_current_pose_returns_the_current_joints(robot):
    q = inside(robot, 50)
    np.testing.assert_allclose(robot.ik_nearest(robot.fk(q), q), q, rtol=0, atol=1e-7)


def test_weights_move_the_choice(robot):
    q, seed = inside(robot, 2)
    pose = robot.fk(q)
    free, held = (
        robot.ik_nearest(pose, seed),
        robot.ik_nearest(pose, seed, weights=[1, 1, 1, 1, 1, 1, 1e6]),
    )
    assert abs(held[6] - seed[6]) < abs(free[6] - seed[6])
    with pytest.raises(irbkin.InvalidJointsError, match="weights must have shape"):
        robot.ik_nearest(pose, seed, weights=np.ones(6))


def test_an_unreachable_pose_is_reported(robot):
    far = irbkin.pose([2, 0, 0.5])
    with pytest.raises(irbkin.UnreachableError, match="beyond reach"):
        robot.ik_nearest(far, np.zeros(7))
    assert robot.ik(far, q7=0.1).shortfall > 0.5
    check = robot.check_pose(far)
    assert not check.reachable
    q = inside(robot, 1)[0]
    assert robot.check_pose(robot.fk(q))[:2] == (True, True)
    assert np.isnan(robot.ik_nearest(far[None], np.zeros(7))).all()


@pytest.mark.extra
def test_frankik_finds_no_further_solution():
    """It lists solutions inside its limits, and not all of them."""
    frankik = pytest.importorskip("frankik")
    panda = irbkin.Robot("Panda")
    found = 0
    for q in inside(panda, 300):
        pose = panda.fk(q)
        ours = panda.ik(pose, q7=q[6]).q
        for theirs in np.atleast_2d(np.array(frankik.ik_full(pose, q7=q[6]))):
            if (
                theirs.size
                and np.isfinite(theirs).all()
                and np.abs(panda.fk(theirs) - pose).max() < 1e-9
            ):
                assert wrapped(ours - theirs).max(axis=1).min() < 1e-5
                found += 1
    assert found > 300
