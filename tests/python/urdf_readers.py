"""The forward kinematics of `Robot.to_urdf()` in programs that read it.

Each reader takes a robot and the link whose pose is wanted, and returns a function of the angles by
the names of their joints. It imports its own package, so that the others need not be installed.
"""

import contextlib
import io
import tempfile
import warnings
from pathlib import Path

import numpy as np
from reference import reach, rounding

LINKAGE = "joint_2-linkage"
# These follow a mimic; for the others the joint of a linkage is one more joint.
FOLLOW = {"pinocchio", "yourdfpy", "urchin", "compas_robots"}


def angles_of(robot, q, reader):
    """The angles by the names of the joints that a reader wants, in the order of the chain."""
    angles = {f"joint_{i + 1}": angle for i, angle in enumerate(q)}
    if reader in FOLLOW or not robot.is_coupled:
        return angles
    names = ["joint_1", "joint_2", LINKAGE, *list(angles)[2:]]
    return {name: -q[1] if name == LINKAGE else angles[name] for name in names}


def root_of(robot):
    return "base_link" if (robot.base == np.eye(4)).all() else "world"


def in_a_file(robot, read):
    """What a reader of files makes of the text."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "arm.urdf")
        path.write_text(robot.to_urdf())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return read(str(path))


def pose_of(rotation, point):
    pose = np.eye(4)
    pose[:3, :3], pose[:3, 3] = rotation, point
    return pose


def by_pinocchio(robot, tip):
    import pinocchio

    # Without mimic=True the joint of a linkage would be one of the configuration.
    model = pinocchio.buildModelFromXML(robot.to_urdf(), mimic=True)
    data, frame = model.createData(), model.getFrameId(tip)

    def fk(angles):
        configuration = pinocchio.neutral(model)
        for name, angle in angles.items():
            joint = model.joints[model.getJointId(name)]
            # A continuous joint has the cosine and sine of its angle.
            values = [angle] if joint.nq == 1 else [np.cos(angle), np.sin(angle)]
            configuration[joint.idx_q : joint.idx_q + joint.nq] = values
        pinocchio.framesForwardKinematics(model, data, configuration)
        return data.oMf[frame].homogeneous

    return fk


def by_yourdfpy(robot, tip):
    import yourdfpy

    model = yourdfpy.URDF.load(io.BytesIO(robot.to_urdf().encode()), load_meshes=False)
    assert len(model.actuated_joint_names) == robot.dof

    def fk(angles):
        model.update_cfg(angles)
        return model.get_transform(tip, model.base_link)

    return fk


def by_mujoco(robot, tip):
    import mujoco

    model = mujoco.MjModel.from_xml_string(robot.to_urdf())
    data = mujoco.MjData(model)

    def fk(angles):
        for name, angle in angles.items():
            data.joint(name).qpos = angle
        mujoco.mj_kinematics(model, data)
        return pose_of(data.body(tip).xmat.reshape(3, 3), data.body(tip).xpos)

    return fk


def by_ikpy(robot, tip):
    import ikpy.chain

    chain = in_a_file(robot, lambda path: ikpy.chain.Chain.from_urdf_file(path, [root_of(robot)]))
    assert chain.links[-1].name.endswith(f"-{tip}")
    turning = [link.name for link in chain.links if link.joint_type != "fixed"]
    assert len(turning) == robot.dof + robot.is_coupled
    return lambda angles: chain.forward_kinematics([angles.get(it.name, 0) for it in chain.links])


def by_roboticstoolbox(robot, tip):
    import roboticstoolbox

    model = in_a_file(robot, roboticstoolbox.Robot.URDF)
    assert model.ee_links[0].name == tip
    return lambda angles: model.fkine(list(angles.values())).A


def by_drake(robot, tip):
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(0.0)
    Parser(plant).AddModelsFromString(robot.to_urdf(), "urdf")
    root = plant.GetFrameByName(root_of(robot))
    # A link named world is drake's own.
    if root_of(robot) == "base_link":
        plant.WeldFrames(plant.world_frame(), root)
    plant.Finalize()
    context = plant.CreateDefaultContext()

    def fk(angles):
        for name, angle in angles.items():
            plant.GetJointByName(name).set_angle(context, angle)
        found = plant.CalcRelativeTransform(context, root, plant.GetFrameByName(tip))
        return found.GetAsMatrix4()

    return fk


def by_urchin(robot, tip):
    import urchin

    model = in_a_file(robot, urchin.URDF.load)
    return lambda angles: model.link_fk(cfg=angles, link=tip)


def by_compas_robots(robot, tip):
    import compas_robots

    model = compas_robots.RobotModel.from_urdf_string(robot.to_urdf())

    def fk(angles):
        configuration = model.zero_configuration()
        for name, angle in angles.items():
            configuration[name] = angle
        frame = model.forward_kinematics(configuration, link_name=tip)
        return pose_of(np.transpose([frame.xaxis, frame.yaxis, frame.zaxis]), frame.point)

    return fk


def by_klampt(robot, tip):
    import klampt

    world = klampt.WorldModel()
    assert in_a_file(robot, world.loadElement) >= 0
    # A joint has the name of its child.
    links = {f"joint_{i + 1}": f"link_{i + 1}" for i in range(robot.dof)} | {LINKAGE: "linkage"}

    def fk(angles):
        # Without a reference the world would be freed, and the robot with it.
        model = world.robot(0)
        configuration = model.getConfig()
        for name, angle in angles.items():
            configuration[model.link(links[name]).index] = angle
        model.setConfig(configuration)
        columns, point = model.link(tip).getTransform()
        return pose_of(np.reshape(columns, (3, 3)).T, point)

    return fk


def by_kinpy(robot, tip):
    import kinpy

    # It prints that the element of MuJoCo is unknown.
    with contextlib.redirect_stdout(io.StringIO()):
        chain = kinpy.build_serial_chain_from_urdf(robot.to_urdf(), tip)
    return lambda angles: chain.forward_kinematics(list(angles.values())).matrix()


def by_pytransform3d(robot, tip):
    from pytransform3d.urdf import UrdfTransformManager

    model = UrdfTransformManager()
    model.load_urdf(robot.to_urdf())

    def fk(angles):
        for name, angle in angles.items():
            model.set_joint(name, angle)
        return model.get_transform(tip, root_of(robot))

    return fk


READERS = {
    "pinocchio": by_pinocchio,
    "yourdfpy": by_yourdfpy,
    "mujoco": by_mujoco,
    "ikpy": by_ikpy,
    "roboticstoolbox": by_roboticstoolbox,
    "drake": by_drake,
    "urchin": by_urchin,
    "compas_robots": by_compas_robots,
    "klampt": by_klampt,
    "kinpy": by_kinpy,
    "pytransform3d": by_pytransform3d,
}
# What is installed, where that has another name.
PACKAGES = {"pinocchio": "pin", "roboticstoolbox": "roboticstoolbox-python"}


def assert_agrees(robot, reader, rows, tip="tool0"):
    """Compare the poses of a reader with `fk` at joint vectors; return the largest difference."""
    fk = READERS[reader](robot, tip)
    found = [fk(angles_of(robot, q, reader)) for q in rows]
    far = reach(robot.mdh) + sum(np.linalg.norm(end[:3, 3]) for end in (robot.base, robot.tool))
    # Two more fixed joints than `rounding` counts, and angles of at most 8 rad.
    bound = 2 * rounding(far)
    assert bound < 1e-12
    np.testing.assert_allclose(found, robot.fk(rows), rtol=0, atol=bound, err_msg=robot.name)
    return np.abs(found - robot.fk(rows)).max()
