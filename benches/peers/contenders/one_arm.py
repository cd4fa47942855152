"""Solvers made for one maker's arms: ur-analytic-ik and frankik."""

from __future__ import annotations

import numpy as np

from ..arms import PANDA, UR3, Arm
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
