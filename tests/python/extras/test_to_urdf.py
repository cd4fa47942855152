"""The URDF of a robot: programs that read it have the same forward kinematics."""

import io

import lxml.etree
import mujoco
import numpy as np
import pinocchio
import pytest
import yourdfpy
from irbkin import Robot, catalog
from reference import random_pose
from urdf_readers import assert_agrees

SAMPLES = 20
MOST_USED = ["pinocchio", "yourdfpy", "mujoco"]
COUPLED = "IRB 2400-10/1.55"
# Its axes are along none of x, y and z of its base.
YUMI = "IRB 14000-0.5/0.5 (left)"


def assert_reads(robot, reader, tip="tool0"):
    rows = np.random.default_rng(1).uniform(-np.pi, np.pi, (SAMPLES, robot.dof))
    assert_agrees(robot, reader, rows, tip)


@pytest.mark.parametrize("reader", MOST_USED)
def test_every_arm_of_the_catalog_has_its_forward_kinematics(reader):
    names = catalog()
    assert len(names) > 100
    for name in names:
        assert_reads(Robot(name), reader)


# They choose the end themselves.
@pytest.mark.parametrize("reader", ["ikpy", "roboticstoolbox"])
@pytest.mark.parametrize(
    "name", ["IRB 2600-12/1.65", "UR5e", "GoFa 5", "CRX-10iA", "Panda", YUMI, COUPLED]
)
def test_programs_that_choose_the_end_take_the_tool(reader, name):
    robot = Robot(name)
    assert_reads(robot, reader)
    rng = np.random.default_rng(4)
    assert_reads(robot.with_base(random_pose(rng)).with_tool([0.1, 0, 0.2]), reader, "tool")


def test_the_text_is_read_as_a_str():
    assert lxml.etree.fromstring(Robot("UR5e").to_urdf(visual=True)).tag == "robot"


@pytest.mark.parametrize("reader", MOST_USED)
@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", COUPLED, "UR5e", "Panda"])
def test_base_and_tool_are_part_of_it(reader, name):
    rng = np.random.default_rng(2)
    robot = Robot(name).with_base(random_pose(rng)).with_tool(random_pose(rng, 0.3))
    assert_reads(robot, reader, "tool")


@pytest.mark.parametrize("reader", MOST_USED)
@pytest.mark.parametrize("name", ["CRX-10iA", "UR5e", "IRB 2600-12/1.65"])
def test_coupled_axes_turn_in_whatever_sense(reader, name):
    robot = Robot(name).coupled()
    assert_reads(robot, reader)
    read = Robot.from_urdf(robot.to_urdf())
    assert read.is_coupled
    np.testing.assert_array_equal(read.linkage_limits, robot.linkage_limits)


MIMIC = '<mimic joint="joint_2" multiplier="-1" offset="0"/>'
LINKAGE_AXIS = '<axis xyz="0 1 0"/>'


@pytest.mark.parametrize(
    ("axis", "mimic"),
    [
        (LINKAGE_AXIS, MIMIC),
        (LINKAGE_AXIS, MIMIC.replace('"0"', '"0.3"')),
        ('<axis xyz="0 -1 0"/>', '<mimic joint="joint_2"/>'),
        ('<axis xyz="0 -1 0"/>', '<mimic joint="joint_2" multiplier="1" offset="-0.3"/>'),
    ],
)
@pytest.mark.parametrize("third", [LINKAGE_AXIS, '<axis xyz="0 -1 0"/>'])
def test_a_mimic_that_takes_joint_2_back_is_read(axis, mimic, third):
    text = Robot(COUPLED).to_urdf().replace("joint_2-linkage", "parallel_rod")
    before, linkage, rest = text.partition('<joint name="parallel_rod"')
    passive, name, after = rest.partition('<joint name="joint_3"')
    passive = passive.replace(LINKAGE_AXIS, axis).replace(MIMIC, mimic)
    text = before + linkage + passive + name + after.replace(LINKAGE_AXIS, third, 1)
    robot = Robot.from_urdf(text, tip="tool0")
    assert robot.is_coupled
    model = pinocchio.buildModelFromXML(text, mimic=True)
    data, tip = model.createData(), model.getFrameId("tool0")
    for q in np.random.default_rng(3).uniform(-1.5, 1.5, (SAMPLES, 6)):
        pinocchio.framesForwardKinematics(model, data, q)
        np.testing.assert_allclose(robot.fk(q), data.oMf[tip].homogeneous, rtol=0, atol=1e-13)
        assert np.abs(robot.ik(robot.fk(q)).q - q).max(axis=1).min() < 1e-9


@pytest.mark.parametrize("reader", MOST_USED)
@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", COUPLED])
def test_joints_without_limits_are_continuous(reader, name):
    robot = Robot(name)
    assert_reads(robot.with_limits(np.tile([-np.inf, np.inf], (6, 1))), reader)


def test_limits_and_velocities_arrive_in_other_programs():
    robot = Robot("IRB 2600-12/1.65")
    text = robot.to_urdf()
    model = pinocchio.buildModelFromXML(text)
    limits = np.column_stack([model.lowerPositionLimit, model.upperPositionLimit])
    np.testing.assert_array_equal(limits, robot.limits)
    np.testing.assert_array_equal(model.velocityLimit, robot.max_velocity)
    np.testing.assert_array_equal(mujoco.MjModel.from_xml_string(text).jnt_range, robot.limits)


def test_links_have_the_names_of_ros_industrial():
    model = yourdfpy.URDF.load(
        io.BytesIO(Robot("IRB 2600-12/1.65").to_urdf().encode()), load_meshes=False
    )
    links = ["base_link", *(f"link_{i}" for i in range(1, 7)), "flange", "tool0", "base"]
    assert list(model.link_map) == links
    joints = {
        "base_link-base": "fixed",
        **{f"joint_{i}": "revolute" for i in range(1, 7)},
        "joint_6-flange": "fixed",
        "flange-tool0": "fixed",
    }
    assert {name: joint.type for name, joint in model.joint_map.items()} == joints


def test_at_zero_links_are_parallel_to_the_base():
    """As in the drawing of the IRB 2600, in meters."""
    model = yourdfpy.URDF.load(
        io.BytesIO(Robot("IRB 2600-12/1.65").to_urdf().encode()), load_meshes=False
    )
    places = {
        "link_1": (0, 0, 0.445),
        "link_2": (0.15, 0, 0.445),
        "link_3": (0.15, 0, 1.145),
        "link_5": (0.945, 0, 1.26),
        "flange": (1.03, 0, 1.26),
    }
    for link, xyz in places.items():
        pose = model.get_transform(link)
        np.testing.assert_allclose(pose[:3, 3], xyz, atol=1e-15)
        np.testing.assert_array_equal(pose[:3, :3], np.eye(3))
    axes = [model.joint_map[f"joint_{i}"].axis for i in range(1, 7)]
    x, y, z = np.eye(3)
    np.testing.assert_array_equal(axes, [z, y, y, x, y, x])


def test_the_text_is_read_back_as_the_robot():
    robot = Robot(COUPLED).with_linkage_limits([-2.0, 1.0])
    read = Robot.from_urdf(robot.to_urdf())
    assert read.is_coupled
    assert read.name == robot.name
    for field in ("limits", "linkage_limits", "max_velocity"):
        np.testing.assert_array_equal(getattr(read, field), getattr(robot, field))
    T = robot.fk([0.3, -0.2, 0.4, 0.5, -0.6, 0.7])
    np.testing.assert_allclose(read.ik(T).q_by_slot, robot.ik(T).q_by_slot, atol=1e-12)
    np.testing.assert_array_equal(read.ik(T).status, robot.ik(T).status)
    # The text of what was read is the same: nothing drifts.
    assert Robot.from_urdf(read.to_urdf()).to_urdf() == read.to_urdf()
