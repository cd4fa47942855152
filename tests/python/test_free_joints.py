"""Undetermined joints: the solution names the joint and moves along its self-motion."""

import irbkin
import numpy as np
import pytest
from irbkin import InvalidJointsError
from irbkin.records import FreeJoint

ROBOT = irbkin.Robot("IRB 140-6/0.81")
Q = np.array([0.1, 0.2, 0.3, 0.4, 0, 0.6])


@pytest.fixture
def solution():
    (found,) = [found for found in ROBOT.ik(ROBOT.fk(Q)) if found.free_joint]
    return found


def test_a_member_has_the_pose_and_knows_its_limits(solution):
    assert solution.free_joint == FreeJoint(4, "q4 + q6")
    member = solution.with_free_joint(0.4)
    assert member.free_joint == solution.free_joint
    assert member.q[3] == 0.4
    np.testing.assert_allclose(member.q, Q, rtol=0, atol=1e-9)
    np.testing.assert_allclose(ROBOT.fk(member), ROBOT.fk(Q), rtol=0, atol=1e-14)
    assert solution.is_within_limits
    assert not solution.with_free_joint(np.deg2rad(201)).is_within_limits


def test_elsewhere_nothing_is_free():
    solution = ROBOT.ik(ROBOT.fk([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]))[0]
    assert solution.free_joint is None
    with pytest.raises(InvalidJointsError, match=r"no joint is free: Solution\(slot "):
        solution.with_free_joint(0.0)


def test_a_free_joint_that_does_not_reach_is_reported_with_its_angle():
    robot = irbkin.Robot("UR3")
    free = robot.ik(robot.fk([0.4, -0.3, 0.05, -1.1, 0.0, 2.5]))[0]
    with pytest.raises(
        irbkin.UnreachableError, match=r"the robot does not reach the pose with J6 at 0\.000 deg"
    ):
        free.with_free_joint(0.0)


@pytest.mark.parametrize(
    ("value", "error"),
    [(np.nan, InvalidJointsError), (np.inf, InvalidJointsError), ("x", TypeError)],
)
def test_an_invalid_angle_is_refused(solution, value, error):
    with pytest.raises(error):
        solution.with_free_joint(value)
