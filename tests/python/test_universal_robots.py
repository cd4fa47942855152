"""Arms with three parallel axes: every solution in its slot, what is singular, turns, other
packages' answers.
"""

import irbkin
import numpy as np
import pytest
from arms import UR, UR_FIGURES, ur_rows
from irbkin import SingularityKind, Status
from reference import fk, move, reach, rotation_apart, turn

NAMES = tuple(UR)
STRETCHED_AND_SINGULAR = np.zeros(6)


def generator():
    return np.random.default_rng(5)


def wrapped(angles):
    return np.abs((angles + np.pi) % (2 * np.pi) - np.pi)


@pytest.mark.parametrize("name", NAMES)
def test_every_arm_is_recognized_from_its_own_table_and_from_its_name(name):
    robot = irbkin.Robot(name)
    assert (
        robot.structure == irbkin.Robot.from_sdh(ur_rows(name)).structure == "three parallel axes"
    )
    for q in generator().uniform(-np.pi, np.pi, (20, 6)):
        np.testing.assert_allclose(
            robot.fk(q), fk(UR[name].rows, q), rtol=0, atol=4e-15 * reach(UR[name].rows)
        )


@pytest.mark.parametrize("name", NAMES)
def test_every_solution_closes_and_the_generating_one_is_among_them(name):
    robot = irbkin.Robot(name)
    for q in generator().uniform(-np.pi, np.pi, (200, 6)):
        solutions = robot.ik(robot.fk(q))
        assert max(solution.residual for solution in solutions) <= 1e-14
        assert min(wrapped(solution.q - q).max() for solution in solutions) <= 1e-9
        assert all(solution.is_within_limits for solution in solutions)


def test_the_slot_is_the_shoulder_the_elbow_and_the_sign_of_q5():
    robot = irbkin.Robot("UR3")
    a2, a3, d5 = (UR_FIGURES["UR3"][i] for i in (1, 2, 4))
    seen = set()
    for q in generator().uniform(-np.pi, np.pi, (300, 6)):
        for solution in robot.ik(robot.fk(q)):
            _, q2, q3, q4, q5, _ = solution.q
            # Along -x of frame 1, which turns with joint 1: where the arm points to at zero.
            forward = -(a2 * np.cos(q2) + a3 * np.cos(q2 + q3) + d5 * np.sin(q2 + q3 + q4))
            assert solution.slot == 4 * (forward < 0) + 2 * (q3 < 0) + (q5 < 0)
            seen.add(solution.slot)
    assert seen == set(range(8))


def test_a_slot_keeps_its_branch_along_a_path_without_singularities():
    robot = irbkin.Robot("UR5e")
    start, end = (
        np.array([0.3, -1.8, 1.4, -0.9, 1.2, 0.4]),
        np.array([-0.4, -1.2, 1.9, -1.5, 0.7, -0.6]),
    )
    path = start + np.linspace(0, 1, 400)[:, None] * (end - start)
    slots = robot.ik_batch(robot.fk(path)).q
    np.testing.assert_allclose(slots[:, 0], path, rtol=0, atol=1e-12)
    for slot in range(1, 8):
        branch = slots[:, slot]
        both = np.isfinite(branch[:-1, 0]) & np.isfinite(branch[1:, 0])
        assert wrapped(np.diff(branch, axis=0)[both]).max(initial=0) < 0.05


def test_turns_of_a_full_turn_either_way():
    robot = irbkin.Robot("UR10e")
    solutions = robot.ik(robot.fk([-0.2, -1.1, 1.3, -0.4, 0.9, 0.1]))
    turned = solutions.turns()
    assert len(turned) == 64 * len(solutions)
    assert np.abs(turned.q).max() <= 2 * np.pi
    far = robot.ik_nearest(robot.fk([-0.2, -1.1, 1.3, -0.4, 0.9, 0.1]), [6.0, -1, 1, 0, 1, -6])
    np.testing.assert_allclose(far[[0, 5]], [-0.2 + 2 * np.pi, 0.1 - 2 * np.pi], atol=1e-9)


@pytest.mark.parametrize("q5", [0.0, np.pi])
def test_at_the_wrist_singularity_joint_6_is_free_and_stays_at_zero_or_the_seed(q5):
    robot = irbkin.Robot("UR3")
    q = np.array([0.4, -1.4, 1.3, -0.8, q5, 0.9])
    pose = robot.fk(q)
    solutions = robot.ik(pose)
    assert {solution.slot >> 1 & 1 for solution in solutions if solution.free_joint} == {0, 1}
    for solution in solutions:
        assert solution.residual <= 1e-14
        if solution.singularities & SingularityKind.WRIST:
            assert (solution.free_joint.joint, solution.free_joint.fixed) == (6, "q1, q5")
            assert solution.q[5] == 0
            assert (
                solutions.status[solution.slot ^ 1] & (Status.MERGED | Status.FOUND)
                == Status.MERGED
            )
    same = [s for s in solutions if s.free_joint and s.slot >> 1 == 0]
    np.testing.assert_allclose(wrapped(same[0].with_free_joint(0.9).q - q), 0, atol=1e-9)
    np.testing.assert_allclose(robot.ik_nearest(pose, q), q, atol=1e-9)


def reaches(solution, q6):
    try:
        solution.with_free_joint(q6)
    except irbkin.UnreachableError:
        return False
    return True


def test_a_free_joint_that_does_not_reach_is_reported_with_its_angle():
    robot = irbkin.Robot("UR3")
    free = robot.ik(robot.fk([0.4, -0.3, 0.05, -1.1, 0.0, 2.5]))[0]
    with pytest.raises(
        irbkin.UnreachableError, match=r"the robot does not reach the pose with J6 at 0\.000 deg"
    ):
        free.with_free_joint(0.0)


def test_a_free_joint_6_goes_to_the_reachable_angle_nearest_to_zero():
    robot = irbkin.Robot("UR3")
    q = np.array([0.4, -0.3, 0.05, -1.1, 0.0, 2.5])
    solutions = [s for s in robot.ik(robot.fk(q)) if s.free_joint and s.slot < 4]
    values = np.linspace(-np.pi, np.pi, 2001)
    reachable = [value for value in values if reaches(solutions[0], value)]
    assert 0 < len(reachable) < 2001
    for solution in solutions:
        assert solution.singularities & SingularityKind.ELBOW
        assert abs(abs(solution.q[5]) - np.abs(reachable).min()) < 0.004


@pytest.mark.parametrize("name", ["UR3", "UR5e", "UR10"])
@pytest.mark.parametrize("q5", [0.0, np.pi])
@pytest.mark.parametrize("most_q3", [np.pi, 0.15])
def test_tight_limits_around_joints_at_the_wrist_singularity_are_met(name, q5, most_q3):
    """Also next to the stretched arm, where the two elbows are one in `ik` and go apart along joint
    6.
    """
    rng = np.random.default_rng(9)
    for q in rng.uniform(-np.pi, np.pi, (100, 6)):
        q[2:5:2] = q[2] * most_q3 / np.pi, q5
        robot = irbkin.Robot(name).with_limits(np.column_stack([q - 0.05, q + 0.05]))
        pose = robot.fk(q)
        found = robot.ik_nearest(pose, q + rng.uniform(-0.05, 0.05, 6))
        assert np.abs(found - q).max() <= 0.05 + 1.1e-9
        assert np.abs(robot.fk(found) - pose).max() <= 1e-13
        assert robot.check_pose(pose).within_limits


def test_a_stretched_arm_at_the_wrist_singularity_is_found():
    robot = irbkin.Robot("UR3")
    solution = robot.ik(robot.fk(STRETCHED_AND_SINGULAR))[0]
    np.testing.assert_allclose(solution.q, STRETCHED_AND_SINGULAR, atol=1e-7)
    assert solution.singularities == SingularityKind.WRIST | SingularityKind.ELBOW


def test_singularity_reports_all_three_distances():
    robot = irbkin.Robot("UR3")
    found = robot.singularity([0.3, -1.0, 0.2, 0.5, -0.1, 0.0])
    assert abs(found.wrist - 0.1) < 1e-15
    assert abs(found.elbow - 0.2) < 1e-15
    assert found.shoulder > 0.3
    assert found.kinds == SingularityKind(0)
    assert robot.singularity(np.zeros(6)).kinds == SingularityKind.WRIST | SingularityKind.ELBOW


def test_follow_meets_a_path_and_refuses_what_needs_a_spherical_wrist():
    robot = irbkin.Robot("UR5e").with_tool(move(0, 0.02, 0.1) @ turn("x", 0.3))
    start, end = (
        np.array([0.3, -1.8, 1.4, -0.9, 1.2, 0.4]),
        np.array([-0.4, -1.2, 1.9, -1.5, 0.7, -0.6]),
    )
    joints = start + np.linspace(0, 1, 80)[:, None] * (end - start)
    followed = robot.follow(robot.fk(joints), start)
    np.testing.assert_allclose(followed.q, joints, atol=1e-9)
    assert not followed.breaks
    for policy in ("wrist", "lock_axis4"):
        with pytest.raises(irbkin.InvalidModelError, match="spherical wrist"):
            robot.follow(robot.fk(joints), start, singularity_mode=policy)


@pytest.mark.parametrize("name", NAMES)
def test_ur_analytic_ik_has_the_same_arm_and_no_further_solution(name):
    module = pytest.importorskip("ur_analytic_ik")
    peer = getattr(module, name.lower().replace(" ", ""))
    robot = irbkin.Robot(name)
    for q in generator().uniform(-3, 3, (50, 6)):
        pose = robot.fk(q)
        theirs = np.array(peer.forward_kinematics(*q))
        assert np.abs(theirs[:3, 3] - pose[:3, 3]).max() <= 1e-14
        assert rotation_apart(theirs, pose) <= 1e-14
        ours = robot.ik(pose).q
        for found in peer.inverse_kinematics(np.ascontiguousarray(pose)):
            # Its own solutions close to about 1e-9 only, some not at all.
            if np.abs(robot.fk(found) - pose).max() < 1e-9:
                assert wrapped(ours - found).max(axis=1).min() < 1e-5
