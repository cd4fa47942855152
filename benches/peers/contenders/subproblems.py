"""Solvers by canonical subproblems: eaik, ik-geo, py-ikgeo-kinematics and ssik.

The first two are built from axes and offsets; at zero joint angles their tool frame stands as the
base frame does. Poses are turned into that frame before the clock starts. A pose that they cannot
meet they answer with the nearest, and flag it.
"""

from __future__ import annotations

import contextlib
import importlib.util
import io
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from ..arms import Arm, Floats
from .contender import Contender, from_both, from_joints, from_pose
from .opw import two_layers


def turned(poses: Floats, rotation: Floats) -> Floats:
    """Poses of the tool with its frame turned by a rotation, (..., 4, 4)."""
    result = poses.copy()
    result[..., :3, :3] = poses[..., :3, :3] @ rotation
    return result


def eaik(arm: Arm) -> list[Contender]:
    """From axes and offsets (`HPRobot`); six joints."""
    from eaik.IK_HP import HPRobot

    if arm.dof != 6:
        return []
    robot = HPRobot(arm.axes, arm.offsets)
    # Where it knows no decomposition, a pose raises an error, and a batch ends the process.
    is_solved = robot.hasKnownDecomposition()
    threads_of = ((1, ""), (2, "s")) if is_solved else ()

    def own_frame(pose: Floats, joints: Floats) -> tuple[Any, ...]:
        return (turned(pose, arm.tool.T),)

    one_pose = Contender(
        "ik",
        "eaik",
        lambda T: np.array(robot.IK(T).Q),
        own_frame,
        flagged=lambda T: np.array(robot.IK(T).is_LS, dtype=bool),
    )
    return [
        *([one_pose] if is_solved else []),
        Contender(
            "fk", "eaik", robot.fwdKin, from_joints, read=lambda answer: turned(answer, arm.tool)
        ),
        *(
            Contender(
                "ik_batch",
                f"eaik, {threads} thread{plural}",
                lambda T, threads=threads: robot.IK_batched(T, threads),
                own_frame,
                read=lambda answer: [each.Q for each in answer],
            )
            for threads, plural in threads_of
        ),
    ]


def ik_geo(arm: Arm) -> list[Contender]:
    """From axes and offsets, wrist center as the point of J4 to J6; `get_ik` takes the rotation
    transposed.
    """
    from ik_geo.ik_geo import Robot

    if not arm.opw:
        return []
    robot = Robot.spherical_two_parallel(arm.axes, arm.offsets)

    def rotation_and_point(pose: Floats, joints: Floats) -> tuple[Any, ...]:
        own = turned(pose, arm.tool.T)
        return np.ascontiguousarray(own[:3, :3].T), own[:3, 3].copy()

    return [
        Contender(
            "ik",
            "ik-geo",
            lambda R, t: np.array([q for q, _ in robot.get_ik(R, t)]),
            rotation_and_point,
            flagged=lambda R, t: np.array([flag for _, flag in robot.get_ik(R, t)], dtype=bool),
        ),
    ]


def py_ikgeo_kinematics(arm: Arm) -> list[Contender]:
    """Built from the same parameters and with the same two layers as py-opw-kinematics."""
    import py_ikgeo_kinematics as ikgeo

    if not arm.opw:
        return []
    robot = ikgeo.Robot(ikgeo.KinematicModel.from_opw(**arm.opw), degrees=False)
    name = "py-ikgeo-kinematics"
    return [*two_layers(name, robot), Contender("jacobian", name, robot.jacobian, from_joints)]


def ssik(arm: Arm) -> list[Contender]:
    """The module that `ssik build` writes for the arm's URDF: an arm made in Python runs without
    the native solver.
    """
    from ssik.cli import main

    # Of the Panda it samples q7: another task than one q7 that is given.
    if arm.dof != 6:
        return []
    with tempfile.TemporaryDirectory() as folder:
        urdf, module = Path(folder, "arm.urdf"), Path(folder, "arm_ik.py")
        urdf.write_text(arm.urdf())
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            main(
                [
                    "build",
                    str(urdf),
                    "--base",
                    "link0",
                    "--ee",
                    "tool0",
                    "--no-validate",
                    "--out",
                    str(module),
                ]
            )
        spec = importlib.util.spec_from_file_location("arm_ik", module)
        if spec is None or spec.loader is None:
            raise ImportError("the module that ssik built does not load")
        built = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(built)
    return [
        Contender(
            "ik",
            "ssik",
            lambda T: np.array([each.q for each in built.solve(T, respect_limits=False)]),
            from_pose,
        ),
        Contender(
            "ik_nearest",
            "ssik",
            lambda T, seed: built.solve(T, q_seed=seed, max_solutions=1)[0].q,
            from_both,
        ),
    ]
