"""Undetermined joints: the solution names the joint and moves along its self-motion."""

import irbkin
import numpy as np
import pytest
from arms import ABB
from irbkin import InvalidJointsError
from irbkin.records import FreeJoint
from reference import apart, fk, rotation_apart, rounding
from strategies import subjects
from test_singular_poses import RNG_SEED, TRIALS, at_shoulder, free, ordinary

VALUES = (-3.0, -0.4, 0.0, 1.1, 3.1)


def check_self_motion(solution, name, pose):
    """Every member has the free joint where it was put, and the tool where the pose has it."""
    reach = subjects()[name].reach
    for value in VALUES:
        member = solution.with_free_joint(value)
        assert member.q[solution.free_joint.joint - 1] == value
        assert member.free_joint == solution.free_joint
        assert member.residual <= max(1e-14, 3e-15 * reach)
        by_hand = fk(ABB[name].rows, member.q)
        assert np.abs(by_hand - pose)[:3, 3].max() <= 1e-14 + rounding(reach)
        assert rotation_apart(by_hand, pose) <= 1e-14 + 3 * rounding(0)


@pytest.mark.parametrize(("straight", "fixed"), [(0.0, "q4 + q6"), (np.pi, "q4 - q6")])
@pytest.mark.parametrize("name", ABB)
def test_at_the_wrist_q4_is_free_and_its_sum_with_q6_is_not(name, straight, fixed):
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        q = ordinary(rng)
        q[4] = straight
        pose = robot.fk(q)
        (solution,) = [solution for solution in robot.ik(pose) if solution.free_joint]
        assert solution.free_joint == FreeJoint(4, fixed)
        check_self_motion(solution, name, pose)
        # The vector that made the pose is a member.
        assert apart(solution.with_free_joint(q[3]).q, q) <= 1e-9


@pytest.mark.parametrize("name", ABB)
def test_at_the_shoulder_q1_is_free_and_the_arm_is_not(name):
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        q = at_shoulder(name, 0.0, rng)
        pose = robot.fk(q)
        solutions = robot.ik(pose)
        assert {solution.free_joint for solution in solutions} == {FreeJoint(1, "q2, q3")}
        for solution in solutions:
            check_self_motion(solution, name, pose)
            assert apart(solution.with_free_joint(1.0).q[1:3], solution.q[1:3]) <= 1e-12
        # The vector that made the pose is a member of one of the self-motions.
        assert min(apart(solution.with_free_joint(q[0]).q, q) for solution in solutions) <= 1e-9


def test_folded_onto_axis_2_q2_is_free():
    robot = irbkin.Robot.from_opw(a1=0.15, a2=0, b=0, c1=0.4, c2=0.3, c3=0.3, c4=0.1)
    q = np.array([0.4, 0.5, np.pi, 0.3, 0.8, 0.2])
    solutions = robot.ik(robot.fk(q))
    front = [solution for solution in solutions if apart(solution.q[:1], q[:1]) < 1e-9]
    assert [solution.free_joint for solution in front] == [FreeJoint(2, "q1, q3")] * 2
    for solution in front:
        for value in VALUES:
            assert solution.with_free_joint(value).q[1] == value
            assert solution.with_free_joint(value).residual <= 1e-14
    assert min(apart(solution.with_free_joint(0.5).q, q) for solution in front) <= 1e-9


@pytest.mark.parametrize("name", ABB)
def test_near_the_singularity_the_residual_reports_how_far_the_tool_turns(name):
    """At q5 = 1e-9 the branches are one; a member of the self-motion is off by at most 2e-9."""
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        q = ordinary(rng)
        q[4] = 1e-9
        pose = robot.fk(q)
        (solution,) = [solution for solution in robot.ik(pose) if solution.free_joint]
        half_turned = solution.with_free_joint(solution.q[3] + np.pi / 2)
        off = rotation_apart(robot.fk(half_turned.q), pose)
        assert 0.5e-9 <= off <= 2e-9
        assert half_turned.residual == pytest.approx(off, abs=1e-14)
        # Beyond, axis 5 is on the other side, which is the other slot.
        flipped = solution.with_free_joint(solution.q[3] + np.pi)
        assert flipped.q[4] == pytest.approx(-solution.q[4], abs=1e-14)
        assert flipped.slot == solution.slot ^ 1
        assert flipped.residual <= 1e-14


@pytest.mark.parametrize("name", ABB)
def test_elsewhere_nothing_is_free(name):
    robot, rng = free(name), np.random.default_rng(RNG_SEED)
    for _ in range(TRIALS):
        for solution in robot.ik(robot.fk(ordinary(rng))):
            assert solution.free_joint is None
            with pytest.raises(InvalidJointsError, match=r"no joint is free: Solution\(slot "):
                solution.with_free_joint(0.0)


def test_a_member_knows_whether_it_is_inside_the_limits():
    robot = irbkin.Robot("IRB 140-6/0.81")
    (solution,) = [
        found for found in robot.ik(robot.fk([0.1, 0.2, 0.3, 0.4, 0, 0.6])) if found.free_joint
    ]
    assert solution.is_within_limits
    assert not solution.with_free_joint(np.deg2rad(201)).is_within_limits
    assert solution.with_free_joint(np.deg2rad(199)).is_within_limits


@pytest.mark.parametrize(
    ("value", "error"),
    [(np.nan, InvalidJointsError), (np.inf, InvalidJointsError), ("x", TypeError)],
)
def test_an_invalid_angle_is_refused(value, error):
    robot = irbkin.Robot("IRB 140-6/0.81")
    (solution,) = [
        found for found in robot.ik(robot.fk([0.1, 0.2, 0.3, 0.4, 0, 0.6])) if found.free_joint
    ]
    with pytest.raises(error):
        solution.with_free_joint(value)


SURFACES = {
    # Five joints of a plane, of which three place and turn what they carry.
    "planar": (
        [[90, 0, 0], [0, 0.5, 0.5], [90, 0.2, 0.5], [-90, 0, 0], [0, 0.2, 0], [0, 0.4, 0]],
        [0, -90, 0, 0, -180, -90],
        3,
    ),
    "planar, read backwards": (
        [[-90, 0, 0], [0, 0.5, 0], [0, 0.25, 0.4], [-90, 0.4, 0.5], [90, 0, 0.3], [0, 0.2, 0.5]],
        [-180, -90, -90, 0, -90, 0],
        4,
    ),
    # Joints 1 and 5 turn with one another: two such self-motions in one place.
    "merged": (
        [[90, 0.5, 0], [90, 0.3, 0], [-90, 0, 0.3], [-90, 0, 0], [-90, 0, 0], [90, 0.25, 0]],
        [-180, 90, -180, 90, -90, 90],
        2,
    ),
}


@pytest.mark.parametrize("name", SURFACES)
def test_what_is_free_in_two_directions_stands_once(name):
    rows, q, fixed = SURFACES[name]
    rows = [[np.radians(alpha), a, d, 0] for alpha, a, d in rows]
    robot, q = irbkin.Robot.from_mdh(rows), np.radians(q)
    pose = robot.fk(q)
    solutions = robot.ik(pose)
    assert not solutions.certified
    assert 1 <= len(solutions) <= 2
    for solution in solutions:
        assert solution.free_joint.joint == 1
        assert f"q{fixed}" in solution.free_joint.fixed
        assert solution.residual <= 4e-14
        values = np.linalg.svd(robot.jacobian(solution.q), compute_uv=False)
        assert values[4] < 1e-6
    # The joint vector that made the pose is a member.
    assert apart(robot.ik_nearest(pose, q), q).max() < 1e-6
    if name == "merged":
        for solution in solutions:
            for value in VALUES:
                member = solution.with_free_joint(value)
                assert member.q[0] == pytest.approx(value, abs=1e-12)
                assert member.residual <= 4e-14
