"""Right angles that were written with few digits are made exact where that is asked for, and the
refusal says how.
"""

import pickle
import re
from pathlib import Path

import irbkin
import numpy as np
import pytest
from irbkin import InvalidModelError, Robot

DATA = Path(__file__).parents[1] / "data" / "few_digits"
# PUMA 560 as textbooks print it, standard rows: alpha, a, d, theta. Right angles with four
# decimals.
PUMA = [
    [1.5708, 0, 0.6718, 0],
    [0, 0.4318, 0, 0],
    [-1.5708, 0.0203, 0.15005, 0],
    [1.5708, 0, 0.4318, 0],
    [-1.5708, 0, 0, 0],
    [0, 0, 0, 0],
]


def test_a_table_is_accepted_with_the_proposed_snap():
    for build, rows in (
        (Robot.from_sdh, PUMA),
        (Robot.from_mdh, Robot.from_sdh(PUMA).mdh),
    ):
        told = str(build(rows))
        assert re.search(r"they are 0\.000210 deg off.*; snap=1e-5 would take it$", told)
        assert "snap=1e-5 would take it" in str(build(rows, snap=1e-6))
        robot = build(rows, snap=1e-5)
        assert robot.structure == "spherical wrist"
        text = build(rows)
        assert text.structure == "general"
        q = np.random.default_rng(3).uniform(-np.pi, np.pi, (500, 6))
        # Four right angles, each at most 1e-5 rad off; the arm is 1.6 m long.
        assert 0 < np.abs(robot.fk(q) - text.fk(q)).max() <= 4 * 1e-5 * 1.6
        poses = robot.fk(q)
        counts = []
        for pose, joints in zip(poses, q, strict=True):
            solutions = robot.ik(pose)
            assert max(solution.residual for solution in solutions) <= 1e-14
            difference = solutions.q - joints
            assert (
                np.abs(difference - 2 * np.pi * np.round(difference / 2 / np.pi)).max(axis=1).min()
                <= 1e-8
            )
            counts.append(len(solutions))
        assert counts.count(8) > 200
        assert pickle.loads(pickle.dumps(robot)) == robot
        assert pickle.loads(pickle.dumps(text)) == text


@pytest.mark.parametrize("snap", [-1e-9, 2e-3, np.nan, np.inf])
def test_a_snap_has_bounds(snap):
    for build in (
        lambda: Robot.from_mdh(PUMA, snap=snap),
        lambda: Robot.from_sdh(PUMA, snap=snap),
        lambda: Robot.from_urdf(DATA / "puma560.urdf", snap=snap),
    ):
        with pytest.raises(InvalidModelError, match=r"^snap is .* rad, it must be 0 to 1e-3 rad$"):
            build()


def test_a_snap_is_a_keyword_and_a_number():
    with pytest.raises(TypeError):
        Robot.from_mdh(PUMA, None, "", 1e-5)
    with pytest.raises(TypeError, match="must be real number, not str"):
        Robot.from_mdh(PUMA, snap="1e-5")


def test_an_exact_arm_is_the_same_with_any_snap():
    robot = irbkin.Robot("IRB 2600-12/1.65")
    for snap in (0.0, 1e-9, 1e-3):
        np.testing.assert_array_equal(Robot.from_mdh(robot.mdh, snap=snap).mdh, robot.mdh)


def test_a_snap_that_gives_a_faster_structure_is_proposed_too():
    text = irbkin.Robot("CRB 15000-5/0.95").to_urdf()
    start, name, rest = text.partition('<joint name="joint_2"')
    rounded = start + name + rest.replace('rpy="0 0 0"', 'rpy="0.0002 0 0"', 1)
    robot = Robot.from_urdf(rounded)
    assert "general (by rounded angles: snap=1e-3 makes it an offset wrist)" in repr(robot)
    assert Robot.from_urdf(rounded, snap=1e-3).structure == "offset wrist"
