"""Solvers by Brandstoetter's parameters: py-opw-kinematics and spherical-wrist.

Both wrap a Rust core in a Python class whose poses are SciPy's RigidTransform. The class is their
public interface; the core, which takes arrays, is private (`_robot`, `_internal`) and shown beside
it.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arms import Arm, Floats
from .contender import Contender, from_both, from_joints, from_pose

PUBLIC, CORE = "public API", "private core"


def rows_of_16(poses: Floats, joints: Floats) -> tuple[Any, ...]:
    """Poses as the core takes a batch of them, (n, 16)."""
    return (poses.reshape(-1, 16),)


def two_layers(name: str, robot: Any) -> list[Contender]:
    """What the Python class and the private core of py-opw-kinematics and py-ikgeo-kinematics have
    in common.
    """
    from scipy.spatial.transform import RigidTransform

    core = robot._robot
    return [
        Contender(
            "ik",
            f"{name}, {PUBLIC}",
            lambda T: np.array(robot.inverse(RigidTransform.from_matrix(T))),
            from_pose,
        ),
        Contender("ik", f"{name}, {CORE}", lambda T: np.array(core.inverse(T)), from_pose),
        Contender("fk", f"{name}, {CORE}", lambda q: np.array(core.forward(q)), from_joints),
        Contender(
            "ik_batch",
            f"{name}, {CORE}, reach",
            lambda T: core.reach(T, None, None, 1),
            rows_of_16,
            read=lambda answer: answer[0],
            remark="also returns margins and the smallest singular value",
        ),
        Contender(
            "fk_batch",
            f"{name}, {CORE}",
            core.batch_forward,
            from_joints,
            read=lambda answer: answer.reshape(-1, 4, 4),
        ),
    ]


def py_opw_kinematics(arm: Arm) -> list[Contender]:
    """Angles and tool frame are irbkin's; `reach` gives all eight solutions and margins,
    `batch_inverse` one.
    """
    import py_opw_kinematics as opw

    if not arm.opw:
        return []
    robot = opw.Robot(opw.KinematicModel(**arm.opw), degrees=False)
    core = robot._robot
    name = "py-opw-kinematics"
    return [
        *two_layers(name, robot),
        Contender(
            "ik_nearest",
            f"{name}, {CORE}",
            lambda T, seed: np.array(core.inverse(T, seed)[0]),
            from_both,
        ),
        Contender("fk", f"{name}, {PUBLIC}", lambda q: robot.forward(q).as_matrix(), from_joints),
        Contender(
            "ik_batch",
            f"{name}, {CORE}, batch_inverse",
            core.batch_inverse,
            rows_of_16,
            read=lambda answer: answer[:, None, :],
            remark="one solution a pose",
        ),
    ]


def spherical_wrist(arm: Arm) -> list[Contender]:
    """Angles and tool frame are irbkin's; no constraints are set, so nothing is filtered."""
    import spherical_wrist as sw
    from scipy.spatial.transform import RigidTransform

    if not arm.opw:
        return []
    robot = sw.Robot(sw.KinematicModel(**arm.opw), degrees=False)
    core = robot._robot
    name = "spherical-wrist"

    def nearest(T: Floats, seed: Any) -> Any:
        return np.array(robot.inverse_continuing(RigidTransform.from_matrix(T), seed)[0])

    return [
        Contender(
            "ik",
            f"{name}, {PUBLIC}",
            lambda T: np.array(robot.inverse(RigidTransform.from_matrix(T))),
            from_pose,
        ),
        Contender(
            "ik", f"{name}, {CORE}", lambda T: np.array(core.inverse(T, None, None)), from_pose
        ),
        Contender("ik_nearest", f"{name}, {PUBLIC}", nearest, from_both),
        Contender(
            "ik_nearest",
            f"{name}, {CORE}",
            lambda T, seed: np.array(core.inverse_continuing(T, seed, None)[0]),
            from_both,
        ),
        Contender("fk", f"{name}, {PUBLIC}", lambda q: robot.forward(q).as_matrix(), from_joints),
        Contender("fk", f"{name}, {CORE}", lambda q: np.array(core.forward(q)), from_joints),
        Contender(
            "jacobian",
            name,
            lambda q: sw.Jacobian(robot, q).matrix(),
            from_joints,
            bound=1e-5,
            remark="by finite differences",
        ),
        Contender(
            "ik_batch",
            f"{name}, {CORE}, every core",
            lambda T: core.inverse_multiple(T, None),
            from_pose,
            remark="lists of tuples; as many threads as cores",
        ),
    ]
