"""`Robot.margin` and `Robot.ik_margin` against definitions in NumPy."""

import irbkin
import numpy as np
import pytest

ROBOT = irbkin.Robot("IRB 2600-12/1.65")
NAMES = ("IRB 2600-12/1.65", "IRB 2400-16/1.55", "UR5e")


def margin(robot: irbkin.Robot, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The definition, joint by joint."""
    low, high = robot.limits.T
    limits = (1 - np.abs(q - (low + high) / 2) / ((high - low) / 2)).min(axis=-1)
    if robot.linkage_limits is not None:
        low, high = robot.linkage_limits
        linkage = q[..., 2] - q[..., 1]
        limits = np.minimum(limits, 1 - np.abs(linkage - (low + high) / 2) / ((high - low) / 2))
    away = robot.singularity(q)
    length = np.abs(robot.mdh[1:4, 1:3]).sum()
    parts = [away.wrist * 2 / np.pi, away.elbow * 2 / np.pi, away.shoulder * 2 / length]
    return limits, np.minimum(np.min(parts, axis=0), 1)


def inside(robot: irbkin.Robot, count: int) -> np.ndarray:
    return np.random.default_rng(3).uniform(*robot.limits.T, (count, robot.dof))


@pytest.mark.parametrize("name", NAMES)
def test_a_margin_is_its_definition(name):
    robot = irbkin.Robot(name)
    q = inside(robot, 200)
    found = robot.margin(q)
    for field, wanted in zip(found, margin(robot, q), strict=True):
        np.testing.assert_allclose(field, wanted, atol=1e-12)
    assert robot.margin(q[0]) == irbkin.records.Margin(found.limits[0], found.singularities[0])
    assert robot.margin(q.reshape(20, 10, 6)).limits.shape == (20, 10)
    many = np.tile(q, (30, 1))
    np.testing.assert_array_equal(robot.margin(many, threads=2).limits, np.tile(found.limits, 30))


@pytest.mark.parametrize("threads", [1, 2])
@pytest.mark.parametrize("name", NAMES)
def test_the_margin_of_a_pose_is_that_of_its_best_solution(name, threads):
    robot = irbkin.Robot(name)
    T = robot.fk(inside(robot, 300))
    T[::7, 2, 3] += 0.8
    found = robot.ik_margin(T, threads=threads)
    for row, pose in enumerate(T):
        solutions = robot.ik(pose).within_limits()
        assert found.solutions[row] == len(solutions)
        if not len(solutions):
            assert np.isnan([found.margin[row], found.singularities[row]]).all()
            continue
        turns = np.array([turn.q for turn in solutions.turns()])
        limits, singularities = margin(robot, turns)
        assert found.margin[row] == pytest.approx(np.minimum(limits, singularities).max(), abs=1e-9)
        assert found.singularities[row] == pytest.approx(singularities.max(), abs=1e-9)
    assert (found.solutions == 0).any()


def test_an_arm_of_seven_joints_needs_q7():
    robot = irbkin.Robot("Panda")
    q = inside(robot, 50)
    T = robot.fk(q)
    found = robot.ik_margin(T, q[:, 6])
    wanted = [
        len(robot.ik(pose, q7=q7).within_limits()) for pose, q7 in zip(T, q[:, 6], strict=True)
    ]
    assert found.solutions.tolist() == wanted
    with pytest.raises(TypeError, match="q7"):
        robot.ik_margin(T)


def test_what_is_no_pose_has_no_solution():
    T = np.broadcast_to(ROBOT.fk(np.full(6, 0.3)), (3, 4, 4)).copy()
    T[1, 0, 0] = np.nan
    found = ROBOT.ik_margin(T)
    assert (found.solutions > 0).tolist() == [True, False, True]
    assert np.isnan(found.margin).tolist() == [False, True, False]
    assert np.isnan(ROBOT.margin([[0, 0, 0, 0, np.inf, 0]]).limits).all()
    assert ROBOT.ik_margin(np.empty((0, 4, 4))).margin.shape == (0,)
    assert ROBOT.ik_margin(T[0]).margin.shape == ()
    with pytest.raises(irbkin.InvalidPoseError, match="shape"):
        ROBOT.ik_margin(T[0, :3])
    with pytest.raises(irbkin.InvalidJointsError, match="shape"):
        ROBOT.margin(np.zeros(5))
    with pytest.raises(irbkin.InvalidJointsError, match="finite"):
        ROBOT.margin([0, 0, 0, 0, np.inf, 0])
