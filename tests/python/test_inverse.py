"""Every solution, in its slot: laws on drawn poses. Singular poses have a file of their own."""

from itertools import product

import irbkin
import numpy as np
import pytest
from arms import ABB, IRB2400, KUKA_KR6, LATERAL
from hypothesis import assume, given
from irbkin import Reach, Status
from reference import UNIT, apart, fk_opw, random_pose, reach_opw, rotation_apart, rounding
from strategies import poses, subjects, subjects_with_joints

RESIDUAL = 1e-14  # [m] up to 3.3 m of reach, [rad]


def residual_bound(subject):
    return max(RESIDUAL, 3e-15 * subject.reach)


def amplified(subject, q):
    """How far the rounding of a pose may move the joints that give it [rad]."""
    return max(1e-9, 1e-14 * (1 + subject.reach) / subject.robot.singularity(q).min_singular_value)


def cfx(name, q):
    """ABB's configuration bits and, for each, how far the arm is from where it changes [m, m,
    rad].
    """
    a1, elbow, _, upper, forearm, _ = ABB[name].lengths
    _, q2, q3, _, q5, _ = q
    behind_axis_1 = a1 + upper * np.sin(q2) + forearm * np.cos(q2 + q3) + elbow * np.sin(q2 + q3)
    behind_lower_arm = forearm * np.cos(q3) + elbow * np.sin(q3)
    measures = np.array([behind_axis_1, behind_lower_arm, q5])
    return int((measures < 0) @ [4, 2, 1]), np.abs(measures)


@given(subjects_with_joints())
def test_the_generating_joints_are_among_the_solutions(drawn):
    subject, q = drawn
    assume(not subject.robot.singularity(q).kinds)
    solutions = subject.robot.ik(subject.robot.fk(q))
    found = solutions[int(np.argmin(apart(solutions.q, q)))]
    bound = amplified(subject, q)
    assert apart(found.q, q) <= bound
    # A vector at a limit may be rounded past it by no more than its own bound.
    assert found.is_within_limits or bound > 1e-9


@given(subjects_with_joints())
def test_every_solution_closes(drawn):
    subject, q = drawn
    pose = subject.robot.fk(q)
    solutions = subject.robot.ik(pose)
    assert len(solutions) > 0
    for solution in solutions:
        assert solution.residual <= residual_bound(subject)
        by_hand = subject.fk(solution.q)
        assert np.abs(by_hand - pose)[:3, 3].max() <= residual_bound(subject) + rounding(
            subject.reach
        )
        assert rotation_apart(by_hand, pose) <= residual_bound(subject) + 3 * rounding(0)


@given(subjects_with_joints())
def test_slots_are_abb_configurations(drawn):
    subject, q = drawn
    assume(subject.robot.name in ABB)
    solutions = subject.robot.ik(subject.robot.fk(q))
    assert len({solution.slot for solution in solutions}) == len(solutions)
    for solution in solutions:
        bits, clear = cfx(subject.robot.name, solution.q)
        if clear.min() > 1e-9:
            assert solution.slot == bits


@given(subjects_with_joints())
def test_the_set_of_a_pose_does_not_depend_on_the_solution_that_made_it(drawn):
    subject, q = drawn
    robot = subject.robot
    solutions = robot.ik(robot.fk(q))
    assume(min(robot.singularity(solution.q).min_singular_value for solution in solutions) > 1e-4)
    for solution in solutions:
        again = robot.ik(robot.fk(solution.q))
        assert [other.slot for other in again] == [other.slot for other in solutions]
        assert apart(again.q, solutions.q).max() <= 1e-14 * (1 + subject.reach) / 1e-4


@given(subjects_with_joints())
def test_each_shoulder_has_all_four_branches_or_none(drawn):
    subject, q = drawn
    solutions = subject.robot.ik(subject.robot.fk(q))
    taken = [bool(status & (Status.FOUND | Status.MERGED)) for status in solutions.status]
    assert taken[:4] in ([True] * 4, [False] * 4)
    assert taken[4:] in ([True] * 4, [False] * 4)
    assert any(taken)


@given(subjects_with_joints())
def test_flipping_the_wrist_negates_q5_and_turns_q4_and_q6_by_half(drawn):
    subject, q = drawn
    solutions = subject.robot.ik(subject.robot.fk(q))
    for plus, minus in solutions.q_by_slot.reshape(4, 2, 6):
        if not np.isnan([plus, minus]).any():
            flipped = [*plus[:3], plus[3] + np.pi, 2 * subject.straight - plus[4], plus[5] + np.pi]
            assert apart(flipped, minus) <= 64 * UNIT


@given(subjects_with_joints(), poses(), poses())
def test_base_and_tool_change_the_pose_and_not_the_joints(drawn, base, tool):
    subject, q = drawn
    plain, moved = subject.robot, subject.robot.with_base(base).with_tool(tool)
    sigma = min(
        plain.singularity(solution.q).min_singular_value for solution in plain.ik(plain.fk(q))
    )
    assume(sigma > 1e-4)
    there, here = moved.ik(base @ plain.fk(q) @ tool), plain.ik(plain.fk(q))
    assert [solution.slot for solution in there] == [solution.slot for solution in here]
    assert (
        apart(there.q, here.q).max()
        <= 2 * rounding(subject.reach + 6) * (1 + subject.reach) / sigma
    )


@given(subjects_with_joints())
def test_the_views_of_the_solutions_agree(drawn):
    subject, q = drawn
    solutions = subject.robot.ik(subject.robot.fk(q))
    assert [solution.slot for solution in solutions] == sorted(
        solution.slot for solution in solutions
    )
    np.testing.assert_array_equal(solutions.q, [solution.q for solution in solutions])
    np.testing.assert_array_equal(np.asarray(solutions), solutions.q)
    filled = {solution.slot: solution for solution in solutions}
    for slot in range(8):
        if slot in filled:
            np.testing.assert_array_equal(solutions.q_by_slot[slot], filled[slot].q)
            assert filled[slot].status == solutions.status[slot]
            assert (
                bool(solutions.status[slot] & Status.WITHIN_LIMITS) is filled[slot].is_within_limits
            )
        else:
            assert np.isnan(solutions.q_by_slot[slot]).all()
            assert not solutions.status[slot] & Status.FOUND
    assert solutions.reach is Reach.REACHED
    assert solutions.shortfall == 0.0


@given(subjects_with_joints())
def test_within_limits_agrees_with_the_limits(drawn):
    subject, q = drawn
    low, high = subject.robot.limits.T
    for solution in subject.robot.ik(subject.robot.fk(q)):
        assert solution.is_within_limits == bool(
            np.all((solution.q >= low - 1e-9) & (solution.q <= high + 1e-9))
        )


@pytest.mark.parametrize("name", subjects())
def test_any_pose_has_every_solution_or_a_shortfall(name):
    """Poses that no joint vector made: reachable or not, and each answer says so."""
    subject = subjects()[name]
    rng = np.random.default_rng(1)
    reached = 0
    for _ in range(200):
        pose = random_pose(rng, 0.8 * subject.reach)
        solutions = subject.robot.ik(pose)
        reached += len(solutions) > 0
        assert (
            (len(solutions) > 0)
            == (solutions.reach is Reach.REACHED)
            == (solutions.shortfall == 0.0)
        )
        assert all(solution.residual <= residual_bound(subject) for solution in solutions)
    assert 20 < reached < 180


@pytest.mark.parametrize("negative", ["a1", "a2", "b", "c1", "c3", "c4"])
def test_lengths_of_either_sign_are_arms(negative):
    opw = LATERAL | {negative: -LATERAL[negative]}
    robot = irbkin.Robot.from_opw(**opw)
    for q in np.random.default_rng(3).uniform(-3, 3, (100, 6)):
        pose = robot.fk(q)
        solutions = robot.ik(pose)
        np.testing.assert_allclose(pose, fk_opw(opw, q), rtol=0, atol=rounding(reach_opw(opw)))
        assert apart(solutions.q, q).min() <= max(
            1e-9, 4e-14 / robot.singularity(q).min_singular_value
        )
        assert max(solution.residual for solution in solutions) <= RESIDUAL


@pytest.mark.parametrize("name", subjects())
def test_angles_are_in_one_turn_unless_the_limits_ask_for_another(name):
    subject = subjects()[name]
    low, high = subject.robot.limits.T
    free = subject.robot.with_limits([[-np.inf, np.inf]] * 6)
    rng = np.random.default_rng(2)
    for q in rng.uniform(low, high, (50, 6)):
        pose = subject.robot.fk(q)
        unlimited, limited = free.ik(pose).q, subject.robot.ik(pose).q
        assert (unlimited > -np.pi).all()
        assert (unlimited <= np.pi).all()
        inside = (unlimited >= low - 1e-9) & (unlimited <= high + 1e-9)
        np.testing.assert_array_equal(limited[inside], unlimited[inside])
        settled = (limited >= low - 1e-9) & (limited <= high + 1e-9)
        turned = np.abs(limited - unlimited) > 1
        assert (settled[turned]).all()
        assert apart(limited, unlimited).max() <= 8 * UNIT


@pytest.mark.parametrize("opw", [KUKA_KR6, IRB2400], ids=["KUKA KR 6 R700", "IRB 2400"])
def test_half_turns_are_plus_pi(opw):
    robot = irbkin.Robot.from_opw(**opw)
    for q in product(
        [-np.pi, np.pi], [0.2], [0.4], [-np.pi, 0.0, np.pi], [0.5, np.pi], [-np.pi, np.pi]
    ):
        for solution in robot.ik(robot.fk(q)):
            assert (solution.q > -np.pi).all()
            assert (solution.q <= np.pi).all()


def test_axis_3_of_a_1600_is_given_beyond_half_a_turn():
    """Its limits are -245 .. 65 deg: -230 deg is a solution, 130 deg is none."""
    robot = irbkin.Robot("IRB 1600-6/1.45")
    q = np.deg2rad([10, 20, -230, 30, 40, 50])
    found = robot.ik(robot.fk(q)).within_limits()
    assert min(np.abs(found.q - q).max(axis=1)) <= 1e-9
    outside = robot.with_limits(np.deg2rad([[-180, 180]] * 6)).ik(robot.fk(q))
    assert min(np.abs(outside.q - np.deg2rad([10, 20, 130, 30, 40, 50])).max(axis=1)) <= 1e-9


def test_a_single_array_a_list_and_a_float32_pose_get_the_same_answer():
    robot = irbkin.Robot("IRB 120-3/0.58")
    pose = robot.fk([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    np.testing.assert_array_equal(robot.ik(pose.tolist()).q, robot.ik(pose).q)
    np.testing.assert_array_equal(robot.ik(np.asfortranarray(pose)).q, robot.ik(pose).q)
    single = robot.ik(pose.astype(np.float32))
    np.testing.assert_allclose(single.q, robot.ik(pose).q, rtol=0, atol=1e-5)
    assert max(solution.residual for solution in single) <= RESIDUAL
