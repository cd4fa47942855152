"""Libraries of rigid-body dynamics with forward kinematics and Jacobians: pinocchio and dynibo.
Both read the URDF.
"""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from ..arms import Arm, Floats
from .contender import Contender, from_joints


def pinocchio(arm: Arm) -> list[Contender]:
    """Frame `tool0`, the Jacobian in `LOCAL_WORLD_ALIGNED`: at the tool, along the axes of the
    base.
    """
    import pinocchio as pin

    model = pin.buildModelFromXML(arm.urdf())
    data = model.createData()
    frame, along_base = model.getFrameId("tool0"), pin.ReferenceFrame.LOCAL_WORLD_ALIGNED

    def fk(q: Floats) -> Any:
        pin.forwardKinematics(model, data, q)
        return pin.updateFramePlacement(model, data, frame).homogeneous

    def placed(_: Any) -> Any:
        return pin.updateFramePlacement(model, data, frame).homogeneous

    return [
        Contender("fk", "pinocchio", fk, from_joints),
        Contender(
            "fk",
            "pinocchio, forwardKinematics alone",
            lambda q: pin.forwardKinematics(model, data, q),
            from_joints,
            read=placed,
            remark="the joint placements stay in its data: nothing is returned",
        ),
        Contender(
            "jacobian",
            "pinocchio",
            lambda q: pin.computeFrameJacobian(model, data, q, frame, along_base),
            from_joints,
        ),
    ]


def dynibo(arm: Arm) -> list[Contender]:
    """Poses are an object of its own; a Jacobian is one column after the other, angular rows
    first.
    """
    import dynibo

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "arm.urdf")
        path.write_text(arm.urdf())
        robot = dynibo.Robot.from_urdf(str(path))
    tool = robot.link_id("tool0")
    room = np.empty(6 * arm.dof)

    def matrix(pose: Any) -> Floats:
        x, y, z, w = pose.rotation_xyzw
        result = np.eye(4)
        result[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        result[:3, 3] = pose.translation
        return result

    def rows(answer: Floats | None) -> Floats:
        columns = (room if answer is None else answer).reshape(arm.dof, 6).T
        return np.concatenate([columns[3:], columns[:3]])

    return [
        Contender(
            "fk",
            "dynibo",
            lambda q: robot.forward_kinematics(q, tool),
            from_joints,
            read=matrix,
            remark="an object with translation and quaternion, not a matrix",
        ),
        Contender("jacobian", "dynibo", lambda q: robot.jacobian(q, tool), from_joints, read=rows),
        Contender(
            "jacobian",
            "dynibo, out=",
            lambda q: robot.jacobian(q, tool, out=room),
            from_joints,
            read=rows,
            remark="into a preallocated array",
        ),
    ]
