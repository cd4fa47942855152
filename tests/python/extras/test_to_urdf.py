"""The URDF of a robot: programs that read it have the same forward kinematics."""

import io
import tempfile
import warnings
from pathlib import Path

import ikpy.chain
import lxml.etree
import mujoco
import numpy as np
import pinocchio
import pytest
import roboticstoolbox
import yourdfpy
from irbkin import Robot, catalog
from reference import random_pose, reach, rounding

SAMPLES = 20
COUPLED = "IRB 2400-10/1.55"


def joint_names(robot):
    return [f"joint_{i + 1}" for i in range(robot.dof)]


def by_pinocchio(robot, tip):
    # Without mimic=True the joint of a linkage would be one of the configuration.
    model = pinocchio.buildModelFromXML(robot.to_urdf(), mimic=True)
    data, frame = model.createData(), model.getFrameId(tip)
    places = [model.joints[model.getJointId(name)] for name in joint_names(robot)]

    def fk(q):
        configuration = pinocchio.neutral(model)
        for joint, angle in zip(places, q, strict=True):
            # A continuous joint has the cosine and sine of its angle.
            values = [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
            configuration[joint.idx_q : joint.idx_q + joint.nq] = values
        pinocchio.framesForwardKinematics(model, data, configuration)
        return data.oMf[frame].homogeneous

    return fk


def by_yourdfpy(robot, tip):
    model = yourdfpy.URDF.load(io.BytesIO(robot.to_urdf().encode()), load_meshes=False)
    names = joint_names(robot)
    assert list(model.actuated_joint_names) == names

    def fk(q):
        model.update_cfg(dict(zip(names, q, strict=True)))
        return model.get_transform(tip, model.base_link)

    return fk


def by_mujoco(robot, tip):
    model = mujoco.MjModel.from_xml_string(robot.to_urdf())
    data, names = mujoco.MjData(model), joint_names(robot)
    body = data.body(tip)

    def fk(q):
        for name, angle in zip(names, q, strict=True):
            data.joint(name).qpos = angle
        if robot.is_coupled:
            # Of a mimic MuJoCo makes a constraint, which acts in a simulation.
            data.joint("joint_2-linkage").qpos = -q[1]
        mujoco.mj_kinematics(model, data)
        pose = np.eye(4)
        pose[:3, :3], pose[:3, 3] = body.xmat.reshape(3, 3), body.xpos
        return pose

    return fk


def in_a_file(robot, read):
    """What a reader of files makes of the text."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "arm.urdf")
        path.write_text(robot.to_urdf())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return read(str(path))


def by_ikpy(robot, tip):
    root = "base_link" if (robot.base == np.eye(4)).all() else "world"
    chain = in_a_file(robot, lambda path: ikpy.chain.Chain.from_urdf_file(path, [root]))
    turning = [i for i, link in enumerate(chain.links) if link.joint_type != "fixed"]
    assert chain.links[-1].name.endswith(f"-{tip}")
    assert len(turning) == robot.dof

    def fk(q):
        joints = np.zeros(len(chain.links))
        joints[turning] = q
        return chain.forward_kinematics(joints)

    return fk


def by_robotics_toolbox(robot, tip):
    model = in_a_file(robot, roboticstoolbox.Robot.URDF)
    assert model.ee_links[0].name == tip
    return lambda q: model.fkine(q).A


def assert_agrees(robot, build, tip="tool0"):
    fk, rng = build(robot, tip), np.random.default_rng(1)
    far = reach(robot.mdh) + sum(np.linalg.norm(end[:3, 3]) for end in (robot.base, robot.tool))
    # Two more fixed joints than `rounding` counts, and angles of at most 8 rad.
    bound = 2 * rounding(far)
    assert bound < 1e-12
    for q in rng.uniform(-np.pi, np.pi, (SAMPLES, robot.dof)):
        np.testing.assert_allclose(fk(q), robot.fk(q), rtol=0, atol=bound)


@pytest.mark.parametrize("build", [by_pinocchio, by_yourdfpy, by_mujoco])
def test_every_arm_of_the_catalog_has_its_forward_kinematics(build):
    names = catalog()
    assert len(names) > 100
    for name in names:
        assert_agrees(Robot(name), build)


# They choose the end themselves, and know no mimic.
@pytest.mark.parametrize("build", [by_ikpy, by_robotics_toolbox])
@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", "UR5e", "GoFa 5", "CRX-10iA", "Panda"])
def test_programs_that_choose_the_end_take_the_tool(build, name):
    robot = Robot(name)
    assert_agrees(robot, build)
    rng = np.random.default_rng(4)
    assert_agrees(robot.with_base(random_pose(rng)).with_tool([0.1, 0, 0.2]), build, "tool")


def test_the_text_is_read_as_a_str():
    assert lxml.etree.fromstring(Robot("UR5e").to_urdf(visual=True)).tag == "robot"


@pytest.mark.parametrize("build", [by_pinocchio, by_yourdfpy, by_mujoco])
@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", COUPLED, "UR5e", "Panda"])
def test_base_and_tool_are_part_of_it(build, name):
    rng = np.random.default_rng(2)
    robot = Robot(name).with_base(random_pose(rng)).with_tool(random_pose(rng, 0.3))
    assert_agrees(robot, build, "tool")


@pytest.mark.parametrize("build", [by_pinocchio, by_yourdfpy, by_mujoco])
@pytest.mark.parametrize("name", ["CRX-10iA", "UR5e", "IRB 2600-12/1.65"])
def test_coupled_axes_turn_in_whatever_sense(build, name):
    robot = Robot(name).coupled()
    assert_agrees(robot, build)
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


@pytest.mark.parametrize("build", [by_pinocchio, by_yourdfpy, by_mujoco])
@pytest.mark.parametrize("name", ["IRB 2600-12/1.65", COUPLED])
def test_joints_without_limits_are_continuous(build, name):
    robot = Robot(name)
    assert_agrees(robot.with_limits(np.tile([-np.inf, np.inf], (6, 1))), build)


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
