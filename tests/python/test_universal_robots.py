"""Arms with three parallel axes: recognized by their tables; another package's answers."""

import irbkin
import numpy as np
import pytest
from arms import UR, ur_rows
from reference import fk, move, reach, rotation_apart, turn

NAMES = tuple(UR)


def wrapped(angles):
    return np.abs((angles + np.pi) % (2 * np.pi) - np.pi)


@pytest.mark.parametrize("name", NAMES)
def test_every_arm_is_recognized_from_its_own_table_and_from_its_name(name):
    robot = irbkin.Robot(name)
    assert (
        robot.structure == irbkin.Robot.from_sdh(ur_rows(name)).structure == "three parallel axes"
    )
    for q in np.random.default_rng(5).uniform(-np.pi, np.pi, (20, 6)):
        np.testing.assert_allclose(
            robot.fk(q), fk(UR[name].rows, q), rtol=0, atol=4e-15 * reach(UR[name].rows)
        )


def test_follow_meets_a_path_and_refuses_what_needs_a_spherical_wrist():
    robot = irbkin.Robot("UR5e").with_tool(move(0, 0.02, 0.1) @ turn("x", 0.3))
    start, end = [0.3, -1.8, 1.4, -0.9, 1.2, 0.4], [-0.4, -1.2, 1.9, -1.5, 0.7, -0.6]
    joints = np.linspace(start, end, 80)
    followed = robot.follow(robot.fk(joints), joints[0])
    np.testing.assert_allclose(followed.q, joints, atol=1e-9)
    assert not followed.breaks
    for mode in ("wrist", "lock_axis4"):
        with pytest.raises(irbkin.InvalidModelError, match="spherical wrist"):
            robot.follow(robot.fk(joints), joints[0], singularity_mode=mode)


@pytest.mark.extra
@pytest.mark.parametrize("name", NAMES)
def test_ur_analytic_ik_has_the_same_arm_and_no_further_solution(name):
    module = pytest.importorskip("ur_analytic_ik")
    peer = getattr(module, name.lower().replace(" ", ""))
    robot = irbkin.Robot(name)
    for q in np.random.default_rng(5).uniform(-3, 3, (50, 6)):
        pose = robot.fk(q)
        theirs = np.array(peer.forward_kinematics(*q))
        assert np.abs(theirs[:3, 3] - pose[:3, 3]).max() <= 1e-14
        assert rotation_apart(theirs, pose) <= 1e-14
        ours = robot.ik(pose).q
        for found in peer.inverse_kinematics(np.ascontiguousarray(pose)):
            # Its own solutions close to about 1e-9 only, some not at all.
            if np.abs(robot.fk(found) - pose).max() < 1e-9:
                assert wrapped(ours - found).max(axis=1).min() < 1e-5
