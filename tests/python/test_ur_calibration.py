"""A machine's calibration by Universal Robots: of its controller, and of the ROS driver."""

import irbkin
import numpy as np
import pytest
from irbkin.calibration import load_ur
from irbkin.errors import InvalidModelError

UR5E = irbkin.Robot("UR5e")
Q = np.random.default_rng(2).uniform(-3, 3, (50, 6))
NAMES = ("delta_theta", "delta_a", "delta_d", "delta_alpha")
# The nominal UR5e, as ur_description has it.
POSES = {
    "shoulder": (0, 0, 0.1625, 0, 0, 0),
    "upper_arm": (0, 0, 0, 1.570796327, 0, 0),
    "forearm": (-0.425, 0, 0, 0, 0, 0),
    "wrist_1": (-0.3922, 0, 0.1333, 0, 0, 0),
    "wrist_2": (0, -0.0997, -2.044881182297852e-11, 1.570796327, 0, 0),
    "wrist_3": (0, 0.0996, -2.042830148012698e-11, 1.570796326589793, np.pi, np.pi),
}


def driver(poses):
    """The text of the ROS driver."""
    fields = ("x", "y", "z", "roll", "pitch", "yaw")
    lines = ["kinematics:"]
    for link, values in poses.items():
        pairs = zip(fields, values, strict=True)
        lines += [f"  {link}:", *(f"    {field}: {value!r}" for field, value in pairs)]
    return "\n".join([*lines, "  hash: calib_209549117540498681", ""])


def standard(rows):
    """theta, a, d, alpha of a standard table."""
    alpha, a, d, theta = rows.T
    return np.column_stack([theta, np.r_[a[1:], 0], d, np.r_[alpha[1:], 0]])


def controller(deltas):
    """The text of a controller."""
    lines = [f"{name} = {row.tolist()}" for name, row in zip(NAMES, deltas.T, strict=True)]
    return "\n".join(["[mounting]", *lines, "joint_checksum = [0xfe, 0x01]", ""])


@pytest.mark.parametrize("scale", [1e-5, 1e-4, 1e-3])
def test_the_deltas_of_a_controller_are_added(scale):
    corrections = np.zeros(42)
    corrections[6:36] = np.random.default_rng(3).normal(0, scale, 30)
    corrections[[6, 7, 10]] = 0
    machine = UR5E.with_corrections(corrections)
    deltas = standard(machine.mdh) - standard(UR5E.mdh)
    # Axes 2 to 4 are nearly parallel: the table has kilometers, which cancel.
    found = load_ur(UR5E, controller(deltas))
    rounding = 4 * np.finfo(float).eps * (1 + np.abs(deltas).sum())
    np.testing.assert_allclose(found.fk(Q), machine.fk(Q), rtol=0, atol=rounding)
    np.testing.assert_array_equal(found.max_velocity, UR5E.max_velocity)
    np.testing.assert_array_equal(found.limits, UR5E.limits)
    tracking = found.with_nominal(UR5E)
    np.testing.assert_allclose(tracking.ik_nearest(found.fk(Q[0]), Q[0]), Q[0], rtol=0, atol=1e-9)


def test_the_poses_of_the_driver_are_the_arm(tmp_path):
    path = tmp_path / "my_robot_calibration.yaml"
    path.write_text(driver(POSES))
    tool, base = irbkin.pose([0, 0, 0.1]), irbkin.pose([0, 0, 0.5])
    robot = UR5E.with_tool(tool).with_base(base)
    np.testing.assert_allclose(load_ur(robot, path).fk(Q), robot.fk(Q), rtol=0, atol=1e-9)
    tilted = POSES | {"forearm": (-0.4251, 0, 0, 1e-3, 2e-3, 0)}
    off = load_ur(UR5E, driver(tilted)).fk(Q) - UR5E.fk(Q)
    assert 1e-4 < np.abs(off[:, :3, 3]).max() < 5e-3


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("UR10e", driver(POSES), "off UR10e at zero joint angles: is it the calibration of"),
        ("Panda", driver(POSES), "it must be an arm of Universal Robots"),
        ("UR5e", "nothing\n", "the calibration has no shoulder"),
        ("UR5e", driver(POSES).replace("    pitch: 0\n", "", 1), "shoulder .* has no number pitch"),
        ("UR5e", "delta_theta = [0, 0]\n", "delta_theta of the calibration has 2 numbers"),
    ],
)
def test_what_is_no_calibration_of_the_arm_is_refused(name, text, words):
    with pytest.raises(InvalidModelError, match=words):
        load_ur(irbkin.Robot(name), text)
