"""The path of poses that `path`, `plan` and `plot` read, made denser where it is asked for."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser
from irbkin.cli.errors import CommandError
from irbkin.cli.numbers import number, positive

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin._arrays import Floats

STEP = 5.0
"""Distance of poses on lines, splines and arcs [mm]."""
ZONES = (
    "fine",
    *(f"z{size}" for size in (0, 1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200)),
)


def add_path(parser: Parser) -> None:
    """The arguments of a path."""
    parser.add_rows("poses along the path", optional=False)
    add = parser.add
    add(
        "--through",
        choices=("points", "lines", "spline", "arc"),
        default="points",
        help="points: the poses themselves; lines, a spline or an arc (of 3) through them",
    )
    add("--step", type=positive, metavar="MM", help="distance of poses on these [mm]: 5")
    add(
        "--zone",
        metavar="ZONE",
        help="corners of lines: fine, z0 .. z200 or a radius [mm]; fine",
    )


def read_path(arguments: argparse.Namespace, robot: Robot) -> Floats:
    """The poses of the path, shape (m, 4, 4)."""
    import numpy as np

    from irbkin import paths
    from irbkin.cli.reading import read_all, read_poses

    if robot.dof != 6:
        raise CommandError(
            f"paths are for arms of six joints, {robot.name} has {robot.dof}: take irbkin ik with "
            "--seed, pose by pose"
        )
    if arguments.through == "points" and arguments.step is not None:
        raise CommandError("--step goes with --through lines, spline or arc")
    if arguments.through != "lines" and arguments.zone is not None:
        raise CommandError("--zone goes with --through lines")
    zone = "fine" if arguments.zone is None else _zone(arguments.zone)
    step = (STEP if arguments.step is None else arguments.step) / 1e3
    poses = read_all(read_poses(arguments.file))
    wrong = np.flatnonzero(~np.isfinite(poses).all(axis=(1, 2)))
    if len(wrong):
        raise CommandError(f"{arguments.file}: row {wrong[0] + 1} is not a pose: it is not finite")
    if arguments.through == "lines":
        return paths.polyline(poses, zone, step=step, turn=np.radians(2.0))
    if arguments.through == "spline":
        return paths.spline(poses, step=step, turn=np.radians(2.0))
    if arguments.through == "arc":
        if len(poses) != 3:
            raise CommandError(f"--through arc takes 3 poses, {arguments.file} has {len(poses)}")
        return paths.arc(*poses, step=step, turn=np.radians(2.0))
    return poses


def _zone(text: str) -> float | str:
    """One of ABB's names, or a radius [m]."""
    name = text.strip()
    if name in ZONES:
        return name
    try:
        radius = number(name)
    except argparse.ArgumentTypeError:
        radius = -1.0
    if radius < 0.0:
        raise CommandError(
            f"--zone is {name!r}, it must be a radius of 0 mm or more, or one of {', '.join(ZONES)}"
        )
    return radius / 1e3


def fastest(robot: Robot, q: Floats, poses: Floats) -> tuple[float, int] | None:
    """The fastest constant tool speed [m/s] that the joints allow, and the joint that limits it;
    nothing where the speeds are unknown or the tool only turns somewhere.
    """
    from irbkin import trajectory
    from irbkin.errors import InvalidMotionError

    if robot.max_velocity is None or len(q) < 2:
        return None
    try:
        speeds = trajectory.tool_speed_limits(q, poses, robot.max_velocity)
    except InvalidMotionError:
        return None
    return speeds.fastest, speeds.fastest_joint
