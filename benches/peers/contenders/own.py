"""irbkin itself, from its catalog: what it cannot do yet shows when it is called."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from ..arms import IRB2600, Arm, Floats
from .contender import Contender, from_both, from_joints, from_pose
from .motion import own_motions


def irbkin(arm: Arm) -> list[Contender]:
    """`ik` of an arm of seven joints takes q7; batches write into arrays made beforehand."""
    import irbkin

    robot = irbkin.Robot(arm.name) if arm.table is None else irbkin.Robot.from_mdh(arm.table)
    slots = 8 if arm.table is None else 16

    def ik_given_q7(pose: Floats, q7: float) -> Floats:
        return robot.ik(pose, q7=q7).q

    def batch(
        poses: Floats, q7: Floats | None, out: irbkin.IkBatch, threads: int
    ) -> irbkin.IkBatch:
        return robot.ik_batch(poses, q7, out=out, threads=threads)

    def for_batch(poses: Floats, joints: Floats) -> tuple[Floats, Floats | None, irbkin.IkBatch]:
        out = irbkin.IkBatch(
            np.empty((len(poses), slots, arm.dof)), np.empty((len(poses), slots), np.uint8)
        )
        return poses, np.ascontiguousarray(joints[..., 6]) if arm.dof == 7 else None, out

    def with_room(*shape: int) -> Any:
        return lambda poses, joints: (joints, np.empty((len(joints), *shape)))

    single = (
        Contender("ik", "irbkin", lambda pose: robot.ik(pose).q, from_pose)
        if arm.dof == 6
        else Contender("ik", "irbkin", ik_given_q7, lambda pose, joints: (pose, float(joints[6])))
    )
    return [
        single,
        Contender("ik_nearest", "irbkin", robot.ik_nearest, from_both),
        Contender("fk", "irbkin", robot.fk, from_joints),
        Contender("jacobian", "irbkin", robot.jacobian, from_joints),
        *(
            Contender(
                "ik_batch",
                f"irbkin, {threads} thread{plural}",
                partial(batch, threads=threads),
                for_batch,
                read=lambda answer: answer.q,
            )
            for threads, plural in ((1, ""), (2, "s"))
        ),
        Contender("fk_batch", "irbkin", lambda q, out: robot.fk(q, out=out), with_room(4, 4)),
        Contender(
            "jacobian_batch",
            "irbkin",
            lambda q, out: robot.jacobian(q, out=out),
            with_room(6, arm.dof),
        ),
        *(own_motions(robot) if arm is IRB2600 else ()),
    ]
