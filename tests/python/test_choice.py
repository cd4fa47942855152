"""Next to singularities: what `check_pose`, `ik`, `ik_nearest` and `ik_configured` say of one pose
agrees.
"""

import irbkin
import numpy as np
import pytest

ARMS = ("IRB 120-3/0.58", "IRB 1520ID-4/1.5", "IRB 2600-12/1.65", "UR3")
DISTANCES = (0.0, 1e-13, 1e-10, 1e-8, 1e-7)
TRIALS = 4


def next_to(name, wrist, elbow, rng):
    """A joint vector this far from the wrist's and the elbow's singularity; none where an offset is
    None.
    """
    robot = irbkin.Robot(name)
    low, high = np.maximum(robot.limits[:, 0], -3), np.minimum(robot.limits[:, 1], 3)
    q = rng.uniform(low, high)
    q[4] = rng.uniform(0.3, 1.5) if wrist is None else wrist
    if elbow is not None:
        straight = 0.0
        if not name.startswith("UR"):
            straight = straight_elbow(robot, q)
        q[2] = straight + elbow
    return q


def straight_elbow(robot, q):
    """Axis 3 of the straight arm: an elbow angle to one or the other side of `q`."""
    for side in (1, -1):
        there = np.array(q)
        there[2] += side * robot.singularity(q).elbow
        if robot.singularity(there).elbow < 1e-9:
            return there[2]
    raise AssertionError(q)


def cost(q, seed):
    return ((q - seed) ** 2).sum()


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize(("wrist", "elbow"), [(True, False), (False, True), (True, True)])
def test_a_pose_that_joints_inside_the_limits_made_is_within_limits(name, wrist, elbow):
    rng, compared = np.random.default_rng(3), 0
    for off in DISTANCES:
        for _ in range(TRIALS):
            q = next_to(name, off if wrist else None, off if elbow else None, rng)
            width = rng.uniform(1e-3, 0.25, (6, 2)) * [-1, 1]
            for robot in (irbkin.Robot(name), irbkin.Robot(name).with_limits(q[:, None] + width)):
                inside = (robot.limits[:, 0] <= q) & (q <= robot.limits[:, 1])
                if not inside.all():
                    continue
                T, seed = robot.fk(q), rng.uniform(-3, 3, 6)
                solutions = robot.ik(T)
                assert robot.check_pose(T).within_limits
                assert len(solutions.within_limits()) > 0
                found = robot.ik_nearest(T, seed)
                assert cost(found, seed) <= cost(solutions.nearest(seed).q, seed) + 1e-12
                assert np.abs(robot.fk(found) - T).max() <= 2e-12
                compared += 1
    assert compared >= len(DISTANCES) * TRIALS


@pytest.mark.parametrize("name", ARMS)
def test_check_pose_and_ik_agree_on_limits_that_need_not_hold_the_joints(name):
    rng, counts = np.random.default_rng(4), {True: 0, False: 0}
    for off in (0.0, 1e-13, 1e-7):
        for _ in range(4 * TRIALS):
            q = next_to(name, off, None, rng)
            middle = q + rng.uniform(-0.4, 0.4, 6) * [0, 0, 0, 1, 0, 1]
            robot = irbkin.Robot(name).with_limits(middle[:, None] + np.array([-0.3, 0.3]))
            T = robot.fk(q)
            inside = len(robot.ik(T).within_limits()) > 0
            assert robot.check_pose(T).within_limits == inside
            if inside:
                robot.ik_nearest(T, rng.uniform(-3, 3, 6))
            else:
                with pytest.raises(irbkin.UnreachableError):
                    robot.ik_nearest(T, rng.uniform(-3, 3, 6))
            counts[inside] += 1
    assert min(counts.values()) > 0
