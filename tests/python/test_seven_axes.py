"""The Panda and the FR3: every solution for a given joint 7, the nearest one along the redundancy,
frankik's answers.
"""

import irbkin
import numpy as np
import pytest
from arms import CATALOG
from irbkin import SingularityKind, Status
from reference import fk, move, reach, turn

NAMES = ("Panda", "FR3")
# The hand as Franka mounts it.
HAND = turn("z", -np.pi / 4) @ move(0, 0, 0.1034)


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


def test_every_solution_closes_and_the_generating_one_is_among_them(robot):
    most = 0
    for q in inside(robot, 1000):
        solutions = robot.ik(robot.fk(q), q7=q[6])
        assert max(solution.residual for solution in solutions) <= 1e-14
        assert np.abs(solutions.q - q).max(axis=1).min() <= 1e-9
        assert (solutions.q[:, 6] == q[6]).all()
        assert len(np.unique(solutions.q.round(6), axis=0)) == len(solutions)
        most = max(most, len(solutions))
    assert most == 8


def test_the_slot_is_the_sign_of_q2_the_elbow_and_the_cosine_of_q5():
    panda = irbkin.Robot("Panda")
    # The stretched arm: axis 4 is 82.5 mm off the lines of 316 mm and 384 mm.
    stretched = -np.arctan2(0.0825, 0.316) - np.arctan2(0.0825, 0.384)
    seen = set()
    for q in inside(panda, 300):
        for solution in panda.ik(panda.fk(q), q7=q[6]):
            _, q2, _, q4, q5, _, _ = solution.q
            backwards = np.sin(q4 - stretched) > 0
            assert solution.slot == 4 * (q2 < 0) + 2 * backwards + (np.cos(q5) < 0)
            seen.add(solution.slot)
    assert seen == set(range(8))
    ready = [0, -np.pi / 4, 0, -3 * np.pi / 4, 0, np.pi / 2, np.pi / 4]
    assert [s.slot for s in panda.ik(panda.fk(ready), q7=ready[6]) if np.allclose(s.q, ready)] == [
        4
    ]


def test_the_hand_is_a_tool(robot):
    q = inside(robot, 1)[0]
    with_hand = robot.with_tool(HAND)
    rows = CATALOG[robot.name].rows
    np.testing.assert_allclose(
        with_hand.fk(q), fk(rows, q) @ HAND, rtol=0, atol=4e-15 * reach(rows)
    )
    np.testing.assert_allclose(
        with_hand.ik(with_hand.fk(q), q7=q[6]).q,
        robot.ik(robot.fk(q), q7=q[6]).q,
        rtol=0,
        atol=1e-9,
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
    with pytest.raises(
        irbkin.InvalidModelError, match="pass the joints of the pose before to ik_nearest"
    ):
        robot.follow(np.stack([pose, pose]), np.zeros(7))


def test_joint_7_keeps_its_given_value_and_is_checked_against_its_limits(robot):
    q = inside(robot, 1)[0]
    beyond = robot.limits[6, 1] + 0.5
    solutions = robot.ik(robot.fk([*q[:6], beyond]), q7=beyond)
    assert (solutions.q[:, 6] == beyond).all()
    assert not any(solution.is_within_limits for solution in solutions)


@pytest.mark.parametrize("q2", [0.0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-4])
def test_near_q2_zero_no_solution_is_missed(q2):
    panda = irbkin.Robot("Panda")
    rng = np.random.default_rng(11)
    for _ in range(50):
        q = inside(panda, 1, rng.integers(1 << 30))[0]
        q[1] = q2 * rng.choice([-1, 1])
        solutions = panda.ik(panda.fk(q), q7=q[6])
        assert max(solution.residual for solution in solutions) <= 1e-14
        if q2 < 1.5e-9:
            found = [s for s in solutions if s.free_joint and np.abs(s.q[3:] - q[3:]).max() < 1e-6]
            assert found
            assert all(
                (s.free_joint.joint, s.free_joint.fixed) == (1, "q1 + q3")
                and s.singularities & SingularityKind.SHOULDER
                for s in found
            )
            assert min(wrapped(s.with_free_joint(q[0]).q - q).max() for s in found) < 1e-6
        else:
            # Rounding of the pose, over the least singular value with joint 7 standing still.
            off = 4e-15 * (1 + 1.2) / np.linalg.svd(panda.jacobian(q)[:, :6], compute_uv=False)[-1]
            assert np.abs(solutions.q - q).max(axis=1).min() <= 1e-9 + off


@pytest.mark.parametrize("off", [1e-12, 1e-9, 2e-9, 1e-8])
def test_a_stretched_arm_near_q2_zero_closes_to_rounding_with_any_limits(robot, off):
    a3, c3, c5 = 0.0825, 0.316, 0.384
    stretched = -np.arctan2(a3, c3) - np.arctan2(a3, c5)
    rng = np.random.default_rng(12)
    for q in inside(robot, 1500):
        q[1], q[3] = off * rng.choice([-1, 1]), stretched + off * rng.choice([-1, 1])
        solutions = robot.ik(robot.fk(q), q7=q[6])
        assert max(solution.residual for solution in solutions) <= 1e-12


def brute_force(robot, pose, seed, count=2001):
    """The least distance from the seed inside the limits, on a grid of angles of joint 7."""
    q7 = np.linspace(*robot.limits[6], count)
    found = robot.ik_batch(np.broadcast_to(pose, (count, 4, 4)), q7)
    good = (found.status & Status.WITHIN_LIMITS) != 0
    return np.linalg.norm(found.q - seed, axis=2)[good].min(initial=np.inf)


def test_ik_nearest_chooses_joint_7_too(robot):
    q, seeds = inside(robot, 40), inside(robot, 40, seed=4)
    for pose, seed in zip(robot.fk(q), seeds, strict=True):
        nearest = robot.ik_nearest(pose, seed)
        assert np.abs(robot.fk(nearest) - pose).max() <= 1e-14
        assert (nearest >= robot.limits[:, 0] - 1e-9).all()
        assert (nearest <= robot.limits[:, 1] + 1e-9).all()
        assert np.linalg.norm(nearest - seed) <= brute_force(robot, pose, seed) + 1e-9


@pytest.mark.parametrize("spread", [0.01, 0.3, 9.0])
def test_ik_nearest_is_no_farther_than_the_joints_that_made_the_pose(robot, spread):
    rng, (low, high) = np.random.default_rng(6), robot.limits.T
    q = inside(robot, 300)
    seeds = np.clip(q + rng.normal(0, spread, q.shape), low, high)
    nearest = robot.ik_nearest(robot.fk(q), seeds)
    assert (
        np.linalg.norm(nearest - seeds, axis=1) <= np.linalg.norm(q - seeds, axis=1) + 1e-9
    ).all()


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


def test_ik_nearest_goes_through_q2_zero(robot):
    rng = np.random.default_rng(8)
    for _ in range(20):
        middle = inside(robot, 1, rng.integers(1 << 30))[0] * 0.5 + 0.5 * robot.limits.mean(axis=1)
        change = rng.uniform(-0.05, 0.05, 7)
        middle[1], change[1] = 0.0, 0.05
        joints = middle + np.linspace(-1, 1, 101)[:, None] * change
        q = joints[0]
        for pose, wanted in zip(robot.fk(joints), joints, strict=True):
            before, q = q, robot.ik_nearest(pose, q)
            assert np.linalg.norm(q - before) <= np.linalg.norm(wanted - before) + 1e-9


def test_ik_nearest_of_the_current_pose_returns_the_current_joints(robot):
    q = inside(robot, 50)
    np.testing.assert_allclose(robot.ik_nearest(robot.fk(q), q), q, rtol=0, atol=1e-7)


def test_ik_nearest_is_continuous_along_a_path(robot):
    start = np.array([0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6])
    pose = robot.fk(start)
    path = np.repeat(pose[None], 400, axis=0)
    angle = np.linspace(0, 2 * np.pi, 400)
    path[:, 1, 3] += 0.15 * np.sin(angle)
    path[:, 2, 3] += 0.1 * (np.cos(angle) - 1)
    q, joints = start, []
    for target in path:
        q = robot.ik_nearest(target, q)
        joints.append(q)
    joints = np.array(joints)
    assert np.abs(robot.fk(joints) - path).max() <= 1e-14
    # A step of the path of 2.4 mm; the arm is nowhere near singular.
    assert np.abs(np.diff(joints, axis=0)).max() < 0.02
    np.testing.assert_allclose(np.diff(joints, n=2, axis=0), 0, atol=5e-4)


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


IIWA = [
    [0, 0, 0.36, 0],
    [-np.pi / 2, 0, 0, 0],
    [np.pi / 2, 0, 0.42, 0],
    [np.pi / 2, 0, 0, 0],
    [-np.pi / 2, 0, 0.4, 0],
    [-np.pi / 2, 0, 0, 0],
    [np.pi / 2, 0, 0.126, 0],
]
IIWA_LIMITS = np.deg2rad([170, 120, 170, 120, 170, 120, 175])
STRETCHED = -np.arctan2(0.0825, 0.316) - np.arctan2(0.0825, 0.384)


@pytest.mark.parametrize("off", [0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 3e-3, 1e-2])
@pytest.mark.parametrize("name", ["iiwa", *NAMES])
def test_any_pose_of_the_arm_near_stretched_is_reachable(name, off):
    if name == "iiwa":
        robot = irbkin.Robot.from_mdh(IIWA).with_limits(
            np.stack([-IIWA_LIMITS, IIWA_LIMITS], axis=1)
        )
        straight = 0.0
    else:
        robot, straight = irbkin.Robot(name), STRETCHED
    asked = 0
    for number, q in enumerate(inside(robot, 20, seed=9)):
        q[3] = straight + (off if number % 2 else -off)
        # Where axis 6 is square to the plane of a Panda, joint 7 alone does not change its reach.
        q[4] = q[4] if number % 4 < 2 else 0.0
        pose = robot.fk(q)
        assert robot.check_pose(pose)[:2] == (True, True), q
        assert np.abs(robot.ik_nearest(pose, q) - q).max() <= 1e-9
        assert np.abs(robot.fk(robot.ik_nearest(pose, np.zeros(7))) - pose).max() <= 1e-12
        asked += 1
    assert asked == 20


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
