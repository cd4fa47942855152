"""Solutions of a pose: their views, their reach, any array."""

import irbkin
import numpy as np
from irbkin import Reach, Status

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
Q = np.deg2rad([10, -20, 30, 40, 50, 60])


def test_the_views_of_the_solutions_agree():
    solutions = ROBOT.ik(ROBOT.fk(Q))
    assert [solution.slot for solution in solutions] == list(range(8))
    np.testing.assert_allclose(solutions[0].q, Q, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(solutions.q, [solution.q for solution in solutions])
    np.testing.assert_array_equal(np.asarray(solutions), solutions.q)
    np.testing.assert_array_equal(solutions.q_by_slot, solutions.q)
    np.testing.assert_array_equal(solutions.q_deg, np.degrees(solutions.q))
    for solution in solutions:
        assert solution.status == solutions.status[solution.slot]
        assert bool(solution.status & Status.WITHIN_LIMITS) is solution.is_within_limits
        assert solution.residual <= 1e-14
    assert (solutions.reach, solutions.shortfall) == (Reach.REACHED, 0.0)


def test_an_empty_slot_is_nan():
    solutions = ROBOT.ik(ROBOT.fk(Q)).within_limits()
    outside = solutions.status & Status.FOUND == 0
    assert 0 < outside.sum() < 8
    assert np.isnan(solutions.q_by_slot[outside]).all()


def test_beyond_reach_an_answer_is_empty_and_says_why():
    solutions = ROBOT.ik(irbkin.pose([5.0, 0, 0]))
    assert len(solutions) == 0
    assert solutions.q.shape == (0, 6)
    assert solutions.reach is Reach.TOO_FAR
    assert solutions.shortfall > 3.0
    assert "beyond reach" in solutions.explain()


def test_a_single_array_a_list_and_a_float32_pose_get_the_same_answer():
    pose = ROBOT.fk(Q)
    np.testing.assert_array_equal(ROBOT.ik(pose.tolist()).q, ROBOT.ik(pose).q)
    np.testing.assert_array_equal(ROBOT.ik(np.asfortranarray(pose)).q, ROBOT.ik(pose).q)
    single = ROBOT.ik(pose.astype(np.float32))
    np.testing.assert_allclose(single.q, ROBOT.ik(pose).q, rtol=0, atol=1e-5)
    assert max(solution.residual for solution in single) <= 1e-14
