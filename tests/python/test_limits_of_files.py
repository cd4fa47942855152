"""Notes of `repr` on a URDF: other limits than of the catalog, and a joint of a gripper."""

import irbkin
import numpy as np
import pytest
from irbkin import Robot

IRB = Robot("IRB 2600-12/1.65")
MIRRORED = np.radians([-155, 95])


def read(robot):
    text = robot.to_urdf().replace("<robot name=", "<robot name='own' was=")
    return Robot.from_urdf(text)


def test_every_arm_is_read_back_without_a_note():
    for name in irbkin.catalog():
        assert "catalog" not in repr(read(Robot(name)))


def test_other_limits_are_noted_and_kept():
    limits = IRB.limits.copy()
    limits[1] = MIRRORED
    robot = read(IRB.with_limits(limits))
    note = "spherical wrist, limits of the catalog's IRB 2600-12/1.65: J2 -95 to 155 deg>"
    assert repr(robot).endswith(note)
    np.testing.assert_array_equal(robot.limits, limits)
    # In three digits they are the same.
    assert "catalog" not in repr(read(IRB.with_limits(IRB.limits.round(3))))
    # What was given by hand is no file's.
    assert "catalog" not in repr(IRB.with_limits(limits))
    assert "catalog" not in repr(robot.with_limits(IRB.limits))


@pytest.mark.parametrize("name", ["UR5e", "Panda", "CRX-10iA", "IRB 2400-10/1.55"])
def test_base_and_tool_do_not_matter(name):
    arm = Robot(name)
    limits = arm.limits.copy()
    limits[2] *= 0.5
    turned = irbkin.pose([1, 2, 3], euler_zyx=[0.5, 0.2, -0.4])
    robot = read(arm.with_limits(limits).with_base(turned).with_tool([0.1, 0, 0.2]))
    lower, upper = np.degrees(arm.limits[2])
    assert f"limits of the catalog's {name}: J3 {lower:.6g} to {upper:.6g} deg" in repr(robot)


def test_another_arm_has_no_note():
    rows = IRB.mdh.copy()
    rows[2, 1] += 0.01
    robot = read(Robot.from_mdh(rows, limits=np.tile([-1, 1], (6, 1))))
    assert "catalog" not in repr(robot)


def test_a_grippers_joint_that_a_given_tip_is_behind_is_noted():
    text = IRB.to_urdf().replace("<robot name=", "<robot name='own' was=")
    for name in ("gripper", "left_knuckle_joint"):
        renamed = text.replace('name="joint_6"', f'name="{name}"')
        with pytest.raises(irbkin.InvalidModelError, match="may be a gripper's"):
            Robot.from_urdf(renamed)
        noted = Robot.from_urdf(renamed, tip="tool0")
        assert repr(noted).endswith(f', joint "{name}" may be a gripper\'s>')
        assert noted.fk(np.zeros(6)).tolist() == read(IRB).fk(np.zeros(6)).tolist()
    assert "gripper" not in repr(Robot.from_urdf(text, tip="tool0"))
