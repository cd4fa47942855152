"""Solvers made for one maker's arms: ur-analytic-ik, frankik and crx-kinematics."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arms import PANDA, UR3, Arm, Floats
from ..general_arms import CRX10IAL
from .contender import Contender, from_pose


def ur_analytic_ik(arm: Arm) -> list[Contender]:
    """Its own table of the UR3, frames 0 and 6 of the standard Denavit-Hartenberg form."""
    from ur_analytic_ik import ur3

    if arm is not UR3:
        return []
    return [
        Contender("ik", "ur-analytic-ik", lambda T: np.array(ur3.inverse_kinematics(T)), from_pose)
    ]


def frankik(arm: Arm) -> list[Contender]:
    """`ik_full` takes the pose of the flange (its `fk` gives the hand's) and q7; solutions inside
    the limits only.
    """
    import frankik

    if arm is not PANDA:
        return []
    return [
        Contender(
            "ik",
            "frankik, ik_full",
            lambda T, q7: frankik.ik_full(T, q7=q7),
            lambda pose, joints: (pose, float(joints[6])),
            remark="only those inside the limits",
        )
    ]


def crx_kinematics(arm: Arm) -> list[Contender]:
    """In millimeters and the controller's degrees, from the intersection of axes 1 and 2 on: J3
    counts from the floor, J4 and J6 the other way round.
    """
    import crx_kinematics as crx

    if arm is not CRX10IAL:
        return []
    robot, height = crx.Crx.crx10ial(), CRX10IAL.offsets[0, 2]

    def in_millimeters(pose: Floats, joints: Floats) -> tuple[Any, ...]:
        target = pose.copy()
        target[:3, 3] = 1e3 * (pose[:3, 3] - [0.0, 0.0, height])
        return (target,)

    def in_radians(found: Floats) -> Floats:
        j1, j2, j3, j4, j5, j6 = np.asarray(found, dtype=float).T
        return np.deg2rad(np.column_stack([j1, j2, -j3 - j2, 180.0 - j4, j5, -j6]))

    return [Contender("ik", "crx-kinematics", robot.ik, in_millimeters, read=in_radians)]
