"""Joint angles at a limit, as a controller reports them with six or seven digits."""

import re

import irbkin
import numpy as np
import pytest
from irbkin import ros

ARMS = ["UR5e", "IRB 2600-12/1.65", "CRB 15000-5/0.95", "Panda"]
LEAST = 1e-9


def at_limits(name, excess, count=8):
    """An arm with joints at their limits, exceeded by up to `excess`, and the same inside."""
    robot, rng = irbkin.Robot(name), np.random.default_rng(1)
    for _ in range(count):
        q = robot.random(rng=rng) * 0.5
        limits, over = robot.limits.copy(), q.copy()
        for joint in rng.choice(robot.dof, 2, replace=False):
            side = int(rng.integers(2))
            limits[joint, side] = q[joint]
            limits[joint, 1 - side] = q[joint] + (1 - 2 * side) * 2.0
            over[joint] += (2 * side - 1) * excess * rng.uniform(0.5, 1.0)
        yield robot.with_limits(limits), over, q


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("excess", [4.6e-8, 9e-7])
def test_joints_over_a_limit_by_rounding_are_at_it(name, excess):
    for robot, over, inside in at_limits(name, excess):
        T = robot.fk(over)
        np.testing.assert_array_equal(robot.ik_nearest(T, over), inside)
        np.testing.assert_array_equal(
            robot.ik_nearest([T, T], [over, inside])[0], robot.ik_nearest(T, over)
        )
        away = over + (robot.limits.mean(axis=1) - over) * np.linspace(0, 0.1, 20)[:, None]
        path = robot.fk(away)
        followed = robot.follow(path, over)
        np.testing.assert_array_equal(followed.q[0], inside)
        assert not followed.breaks
        np.testing.assert_allclose(robot.plan(path, start=over).q[0], inside, atol=1e-15)
        if irbkin.Cell().collides(robot, away).any():
            continue
        motion = robot.go(over, away[-1], seconds=5)
        np.testing.assert_allclose(motion.q[0], inside, atol=1e-15)
        motion.check_limits(robot.limits)
        np.testing.assert_array_equal(ros.Kinematics(robot, start=over).last, inside)


@pytest.mark.parametrize("name", ARMS)
def test_beyond_it_the_message_has_the_excess(name):
    for robot, over, _ in at_limits(name, 4e-6, 2):
        for call, given in (
            (robot.go, (over, robot.limits.mean(axis=1))),
            (lambda arm, q: arm.plan([arm.fk(q)], start=q), (robot, over)),
        ):
            with pytest.raises(
                irbkin.IrbkinError, match=r"exceeded by [234].\de-6 rad$"
            ) as refused:
                call(*given)
            numbers = re.findall(r"-?\d+\.\d{6}", str(refused.value))
            assert len(set(numbers)) == len(numbers) == 3, refused.value
        with pytest.raises(irbkin.IrbkinError, match=r"exceeded by [234](\.\d)?e-06 rad$"):
            ros.Kinematics(robot, start=over)


def test_a_seed_elsewhere_is_searched_from_as_before():
    for robot, over, inside in at_limits("UR5e", 9e-7):
        T = robot.fk(inside + 0.1 * (robot.limits.mean(axis=1) - inside))
        nearest = robot.ik_nearest(T, over)
        assert np.abs(robot.fk(nearest) - T).max() < LEAST
        np.testing.assert_allclose(nearest, robot.ik_nearest(T, inside), atol=1e-7)
