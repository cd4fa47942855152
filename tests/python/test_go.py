"""Free motions from Python: `Robot.go`."""

import irbkin
import numpy as np
import pytest
from irbkin.body import Shape

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
START = np.array([-0.9, 0.5, 0.0, 0, 0.9, 0])
CELL = irbkin.Cell(
    {
        "post": Shape.box([0.2, 0.2, 2.0], irbkin.pose([1.1, 0, 1.0])),
        "floor": Shape.half_space([0, 0, 1], [0, 0, -0.01]),
    },
    margin=0.01,
)
GOAL = START * [-1, 1, 1, 1, 1, 1]


@pytest.mark.parametrize("cell", [None, CELL])
@pytest.mark.parametrize("start", [START, ROBOT.fk(START)])
@pytest.mark.parametrize("goal", [list(GOAL), ROBOT.fk(GOAL)])
def test_a_motion_goes_from_end_to_end_and_is_free(start, goal, cell):
    motion = ROBOT.go(start, goal, cell, steps=40)
    assert (cell or irbkin.Cell()).check_path(ROBOT, motion) is None
    assert motion.q.shape == (40, 6)
    for end, q in ((start, motion.q[0]), (goal, motion.q[-1])):
        if np.ndim(end) == 1:
            np.testing.assert_allclose(q, end, atol=1e-9)
        else:
            np.testing.assert_allclose(ROBOT.fk(q), end, atol=1e-9)
    again = ROBOT.go(start, goal, cell, steps=40)
    np.testing.assert_array_equal(motion.q, again.q)
    motion.check_limits(ROBOT.limits)
    peaks = motion.peaks()
    assert (peaks.velocity <= ROBOT.max_velocity * (1 + 1e-9)).all()
    assert (peaks.acceleration <= 2 * ROBOT.max_velocity * (1 + 1e-9)).all()


def test_limits_are_kept_and_a_detour_is_longer():
    slow = ROBOT.go(START, GOAL, CELL, max_velocity=0.5, max_acceleration=1)
    peaks = slow.peaks()
    assert (peaks.velocity <= 0.5 * (1 + 1e-9)).all()
    assert (peaks.acceleration <= 1 + 1e-9).all()
    straight = ROBOT.go(START, GOAL, max_velocity=0.5, max_acceleration=1)
    assert straight.duration < slow.duration
    assert CELL.check_path(ROBOT, straight).pair[1] == "post"


def test_seven_joints_and_a_locked_one():
    panda = irbkin.Robot("Panda")
    q = np.array([-0.8, 0.4, 0.2, -1.9, 0.1, 2.3, 0.7])
    goal = panda.fk(q * [-1, 1, 1, 1, 1, 1, 1])
    cell = irbkin.Cell({"post": Shape.box([0.1, 0.1, 0.9], irbkin.pose([0.5, 0, 0.4]))})
    for robot in (panda, panda.locked({3: 0.2})):
        motion = robot.go(q, goal, cell)
        assert cell.check_path(robot, motion) is None
    assert np.ptp(motion.q[:, 2]) < 1e-12


@pytest.mark.parametrize(
    ("goal", "proven", "words"),
    [
        (irbkin.pose([1.1, 0, 0.5], euler_zyx=[0, 2.9, 0]), True, "goal collides: .* with post"),
        (irbkin.pose([5, 0, 0.5]), True, "goal is not reached: wrist center .* beyond reach"),
        ([0, 3, 0, 0, 0, 0], True, "goal: joint 2 is 3.000000 rad, its limits"),
    ],
)
def test_what_cannot_be_is_refused(goal, proven, words):
    with pytest.raises(irbkin.UnreachableError, match=words) as caught:
        ROBOT.go(START, goal, CELL)
    assert caught.value.proven is proven


def test_none_found_is_no_proof():
    body = irbkin.body.Body([6], [[0, 0, 0, 0, 0, 0, 0.05]], [])
    robot = ROBOT.with_body(body)
    walls = {
        "one": Shape.box([6, 0.02, 6], irbkin.pose([0, 0, 0])),
        "other": Shape.box([0.02, 6, 6], irbkin.pose([0, 0, 0])),
    }
    ends = [[q1, 0.5, 0, 0, 0.5, 0] for q1 in (0.7, 2.3)]
    with pytest.raises(
        irbkin.UnreachableError, match=r"not prove .* \(0.1 s were given\)"
    ) as caught:
        robot.go(*ends, irbkin.Cell(walls), seconds=0.1)
    assert caught.value.proven is False


@pytest.mark.parametrize(
    ("arguments", "options", "error", "words"),
    [
        ((START, GOAL[:5]), {}, irbkin.InvalidJointsError, r"goal must have shape \(6,\)"),
        ((np.eye(3), GOAL), {}, irbkin.InvalidPoseError, r"start must have shape \(4, 4\)"),
        ((START, GOAL * np.nan), {}, irbkin.InvalidJointsError, "goal: joint 1 is NaN"),
        ((START, GOAL), {"seconds": 0}, irbkin.InvalidMotionError, "seconds is 0"),
        ((START, GOAL), {"max_velocity": 0}, irbkin.InvalidMotionError, "max_velocity"),
        ((START, GOAL), {"max_acceleration": [1, 2]}, irbkin.InvalidMotionError, r"\(6,\)"),
        ((START, GOAL), {"steps": 1}, irbkin.InvalidMotionError, "steps"),
    ],
)
def test_bad_arguments_are_named(arguments, options, error, words):
    with pytest.raises(error, match=words):
        ROBOT.go(*arguments, **options)
    with pytest.raises(irbkin.InvalidModelError, match="with_body"):
        ROBOT.with_body(None).go(START, GOAL)


def test_ends_that_are_next_to_each_other_are_one():
    q = np.zeros(6)
    for off in (0, 1e-20, 1e-13, 1e-9):
        motion = irbkin.Robot("IRB 2600-12/1.65").go(q, q + off * np.eye(6)[0])
        assert motion.duration < 1e-3
