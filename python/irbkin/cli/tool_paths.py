"""The path of poses that `path`, `plan` and `plot` read, made denser where it is asked for."""

import argparse
import contextlib

import numpy as np

from irbkin import Robot, paths, trajectory
from irbkin.cli.arguments import Parser
from irbkin.cli.errors import CommandError
from irbkin.cli.numbers import number, positive
from irbkin.cli.output import Floats
from irbkin.cli.reading import read_all, read_poses
from irbkin.errors import InvalidMotionError

STEP = 5.0
"""Distance of poses on lines, splines and arcs [mm]."""
TURN = np.radians(2.0)
ZONES = ("fine", *map("z{}".format, (0, 1, 5, 10, 15, 20, 30, 40, 50, 60, 80, 100, 150, 200)))


def add_path(parser: Parser) -> None:
    """The arguments of a path."""
    parser.add_rows("poses along the path", "robtargets", nargs="+")
    parser.add_wobj()
    add = parser.add
    ways = ("points", "lines", "spline", "arc")
    words = "the points alone, or lines, a spline, an arc (of 3) through them"
    add("--through", choices=ways, default="points", help=words)
    add("--step", type=positive, metavar="MM", help="distance of poses on these [mm]: 5")
    add("--zone", type=_zone, metavar="ZONE", help="corners: fine, z0 .. z200, or a radius [mm]")


def read_path(arguments: argparse.Namespace, robot: Robot) -> Floats:
    """The poses of the path, shape (m, 4, 4)."""
    if robot.dof != 6:
        words = f"paths are for arms of six joints, {robot.name} has {robot.dof}"
        raise CommandError(f"{words}: take irbkin ik --seed, pose by pose")
    if arguments.through == "points" and arguments.step is not None:
        raise CommandError("--step goes with --through lines, spline or arc")
    if arguments.through != "lines" and arguments.zone is not None:
        raise CommandError("--zone goes with --through lines")
    zone = "fine" if arguments.zone is None else arguments.zone
    step = (STEP if arguments.step is None else arguments.step) / 1e3
    poses = read_all(read_poses(arguments.file))
    if arguments.through == "points":
        return poses
    if arguments.through == "lines":
        return paths.polyline(poses, zone, step=step, turn=TURN)
    if arguments.through == "spline":
        return paths.spline(poses, step=step, turn=TURN)
    if len(poses) != 3:
        raise CommandError(f"--through arc takes 3 poses, got {len(poses)}")
    return paths.arc(*poses, step=step, turn=TURN)


def _zone(text: str) -> float | str:
    """One of ABB's names, or a radius [m]."""
    name = text.strip()
    if name in ZONES:
        return name
    with contextlib.suppress(argparse.ArgumentTypeError):
        if (radius := number(name)) >= 0.0:
            return radius / 1e3
    words = f"{name!r} must be a radius of 0 mm or more, or one of {', '.join(ZONES)}"
    raise argparse.ArgumentTypeError(words)


def speed_notes(robot: Robot, q: Floats, poses: Floats) -> list[tuple[str, float, str]]:
    """The fastest constant tool speed that the joints allow; nothing where their speeds are
    unknown or the tool only turns somewhere.
    """
    if robot.max_velocity is None or len(q) < 2:
        return []
    try:
        speeds = trajectory.tool_speed_limits(q, poses, robot.max_velocity)
    except InvalidMotionError:
        return []
    speed = speeds.fastest * 1e3
    words = f"tool speed up to {speed:.0f} mm/s, limited by J{speeds.fastest_joint}"
    return [("fastest_mm_s", speed, words)]
