"""Choosing among solutions: limits, turns, nearest, least motion, the caller's own condition."""

from itertools import product

import irbkin
import numpy as np
import pytest
from arms import ABB
from irbkin import Status
from reference import apart

TURN = 2 * np.pi
WIDE = np.deg2rad([[-400, 400]] * 6)


@pytest.fixture(scope="module")
def robot():
    return irbkin.Robot("IRB 2600-12/1.65")


@pytest.fixture(scope="module")
def pose(robot):
    return robot.fk(np.deg2rad([10, -20, 30, 40, 50, 60]))


def brute_force(solutions, limits):
    """Every turn of every solution inside the limits, by trying three turns either way, with the
    slot.
    """
    found = []
    for solution in solutions:
        choices = [[angle + TURN * k for k in range(-3, 4)] for angle in solution.q]
        inside = [
            [angle for angle in choice if low - 1e-9 <= angle <= high + 1e-9]
            for choice, (low, high) in zip(choices, limits, strict=True)
        ]
        found += [(solution.slot, q) for q in product(*inside)]
    return found


def cost_nearest(difference, weights):
    return np.sqrt(np.sum(weights * difference**2, axis=-1))


def cost_least_motion(difference, weights):
    return np.sum(weights * np.abs(difference), axis=-1)


def test_within_limits_keeps_those_inside_in_their_slots(robot, pose):
    solutions = robot.ik(pose)
    inside = solutions.within_limits()
    assert 0 < len(inside) < len(solutions)
    assert [s.slot for s in inside] == [s.slot for s in solutions if s.is_within_limits]
    assert all(s.is_within_limits for s in inside)
    outside = [s.slot for s in solutions if not s.is_within_limits]
    assert np.isnan(inside.q_by_slot[outside]).all()
    assert (inside.status[outside] & Status.FOUND == 0).all()
    assert inside.within_limits().q.tolist() == inside.q.tolist()


def test_turns_are_those_of_brute_force(robot):
    rng = np.random.default_rng(1)
    for name in ABB:
        arm = irbkin.Robot(name)
        for q in rng.uniform(*arm.limits.T, (5, 6)):
            solutions = arm.ik(arm.fk(q))
            turns = solutions.turns()
            wanted = brute_force(solutions, arm.limits)
            assert len(turns) == len(wanted)
            assert sorted(s.slot for s in turns) == sorted(slot for slot, _ in wanted)
            wanted_q, found_q = np.array([angles for _, angles in wanted]), np.array(turns.q)
            order = [np.lexsort(np.round(array, 6).T) for array in (wanted_q, found_q)]
            np.testing.assert_allclose(found_q[order[1]], wanted_q[order[0]], rtol=0, atol=1e-12)
            assert all(s.is_within_limits for s in turns)


def test_turns_without_end_are_refused(robot, pose):
    wide = robot.with_limits([[-1e4, 1e4]] * 6)
    with pytest.raises(ValueError, match=r"more than 1e6 \(are they in radians\?\)"):
        wide.ik(pose).turns()


@pytest.mark.parametrize(
    ("method", "cost"),
    [("nearest", cost_nearest), ("least_motion", cost_least_motion)],
    ids=["nearest", "least_motion"],
)
@pytest.mark.parametrize("limits", [None, WIDE], ids=["own limits", "wide limits"])
def test_the_cheapest_is_that_of_brute_force(robot, method, cost, limits):
    rng = np.random.default_rng(2)
    arm = robot if limits is None else robot.with_limits(limits)
    for _ in range(20):
        solutions = arm.ik(arm.fk(rng.uniform(*robot.limits.T)))
        seed, weights = rng.uniform(-7, 7, 6), rng.uniform(0.1, 3, 6)
        turns = np.array([q for _, q in brute_force(solutions, arm.limits)])
        for given in (None, weights):
            costs = cost(turns - seed, np.ones(6) if given is None else given)
            chosen = getattr(solutions, method)(seed, weights=given)
            np.testing.assert_allclose(chosen.q, turns[costs.argmin()], rtol=0, atol=1e-12)
            assert chosen.is_within_limits
            turned = getattr(solutions.turns(), method)(seed, weights=given)
            np.testing.assert_array_equal(turned.q, chosen.q)


def test_a_weight_of_zero_makes_a_joint_free(robot, pose):
    seed = robot.ik(pose).within_limits()[0].q.copy()
    seed[5] += 100
    assert (
        apart(
            robot.ik(pose).nearest(seed, weights=[1, 1, 1, 1, 1, 0]).q,
            robot.ik(pose).within_limits()[0].q,
        )
        <= 1e-12
    )


def test_ik_nearest_is_the_nearest_solution(robot):
    rng = np.random.default_rng(3)
    for q in rng.uniform(*robot.limits.T, (50, 6)):
        pose, seed, weights = robot.fk(q), rng.uniform(-7, 7, 6), rng.uniform(0.1, 3, 6)
        np.testing.assert_array_equal(robot.ik_nearest(pose, seed), robot.ik(pose).nearest(seed).q)
        weighted = robot.ik_nearest(pose, seed, weights=weights)
        np.testing.assert_array_equal(weighted, robot.ik(pose).nearest(seed, weights).q)
        assert (
            apart(robot.ik_nearest(pose, q), q)
            <= 1e-14 * 4 / robot.singularity(q).min_singular_value + 1e-9
        )


def test_filter_hands_over_solutions_that_are_sequences_too(robot, pose):
    seen = []
    solutions = robot.ik(pose)

    def accept(solution):
        seen.append(solution)
        assert isinstance(solution, irbkin.Solution)
        assert len(solution) == 6
        assert list(solution) == solution.q.tolist()
        assert solution[-1] == solution.q[5]
        np.testing.assert_array_equal(np.asarray(solution), solution.q)
        assert robot.fk(solution).shape == (4, 4)
        return solution[4] > 0

    kept = solutions.filter(accept)
    assert len(seen) == len(solutions)
    assert [s.slot for s in kept] == [0, 2, 4, 6]
    assert (kept.q[:, 4] > 0).all()
    turned = solutions.turns().filter(lambda solution: solution[5] > 0)
    assert 0 < len(turned) < len(solutions.turns())
    assert (turned.q[:, 5] > 0).all()


def test_an_exception_in_a_filter_propagates(robot, pose):
    class OwnError(Exception):
        pass

    def fail(solution):
        raise OwnError(solution.slot)

    for solutions in (robot.ik(pose), robot.ik(pose).turns()):
        with pytest.raises(OwnError, match="0"):
            solutions.filter(fail)


def test_a_filter_that_rejects_everything_is_named_as_the_reason(robot, pose):
    empty = robot.ik(pose).filter(lambda _: False)
    assert len(empty) == 0
    assert empty.explain() == "the filter rejected every solution"
    assert empty.q.shape == (0, 6)
    with pytest.raises(irbkin.UnreachableError, match="the filter rejected every solution"):
        empty.nearest(np.zeros(6))


def test_a_choice_from_turns_chooses_from_those_that_are_left(robot, pose):
    """What a filter took out of the turns does not come back through `nearest`."""
    turns = robot.ik(pose).turns()
    kept = turns.filter(lambda solution: solution[5] < 0)
    seed = max(turns, key=lambda solution: solution[5]).q
    for method in ("nearest", "least_motion"):
        assert getattr(kept, method)(seed)[5] < 0


def test_indices_and_slices(robot, pose):
    solutions = robot.ik(pose)
    assert solutions[-1].slot == solutions[len(solutions) - 1].slot == 7
    with pytest.raises(IndexError, match="solution 8 of 8"):
        solutions[8]
    with pytest.raises(IndexError):
        solutions[-9]
    assert solutions[0][1:3].tolist() == solutions.q[0, 1:3].tolist()
