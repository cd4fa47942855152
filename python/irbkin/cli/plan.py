"""`irbkin plan`: the best joints along a path of poses."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, joints, read_robot
from irbkin.cli.errors import FINE, FOUND, complain
from irbkin.cli.tool_paths import add_path, fastest, read_path

if TYPE_CHECKING:
    from irbkin._arrays import Floats

HELP = """Branch, turns of the joints and, with --rotation, the angle of the tool about its z are
chosen for the whole path: the largest joint speed is the least possible, and every step is shown to
be continuous (docs/plan.md). Without a way the exit code is 1, and stderr says where and why each
branch ends."""
EXAMPLES = """  irbkin plan "IRB 2600-12/1.65" poses.csv
  irbkin plan "IRB 2600-12/1.65" corners.csv --through lines --rotation 36 --csv
  irbkin plan "IRB 2600-12/1.65" contour.npy --closed -o q.npy"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    add_path(parser)
    add = parser.add
    add("--rotation", type=int, metavar="STEPS", help="number of tool angles around z")
    add("--start", nargs="+", type=float, metavar="Q", help="joints at the first pose [deg]")
    add("--end", nargs="+", type=float, metavar="Q", help="joints at the last pose [deg]")
    add("--closed", action="store_true", help="the joints end where they start")
    parser.add_formats("joint angles, shape (m, 6), in radians")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    import numpy as np

    from irbkin.cli.output import Column, table
    from irbkin.cli.postures import Postures
    from irbkin.errors import PathError

    robot = read_robot(arguments)
    poses = read_path(arguments)
    try:
        plan = robot.plan(
            poses,
            rotation=arguments.rotation,
            start=joints(arguments.start, "--start", robot.dof),
            end=joints(arguments.end, "--end", robot.dof),
            closed=arguments.closed,
        )
    except PathError as error:
        complain(error)
        for end in error.reasons:
            complain(f"slot {end.slot} ends at pose {end.pose_index}: {end.reason}")
        return FOUND
    postures = Postures(robot)
    columns = (
        Column("pose", "", "6d"),
        *(Column(name, "mm", "8.2f") for name in "xyz"),
        Column("tool_angle", "deg", "8.2f"),
        *postures.columns,
    )
    with table(arguments, columns, f"{robot.name}: {len(poses)} poses") as rows:
        places = (poses[:, axis, 3] * 1e3 for axis in range(3))
        angle = np.degrees(plan.tool_angle)
        rows.write([np.arange(len(poses)), *places, angle, *postures.values(plan.q)], plan.q)
        rows.note("certified", plan.certified, "every step is shown to be continuous")
        turned = poses @ _about_z(plan.tool_angle)
        if best := fastest(robot, plan.q, turned):
            speed, joint = best
            words = f"tool speed up to {speed * 1e3:.0f} mm/s, limited by J{joint}"
            rows.note("fastest_mm_s", speed * 1e3, words)
    return FINE


def _about_z(angles: Floats) -> Floats:
    """Rotations about z, shape (m, 4, 4)."""
    import numpy as np

    turns = np.tile(np.eye(4), (len(angles), 1, 1))
    cosines, sines = np.cos(angles), np.sin(angles)
    turns[:, 0, 0], turns[:, 0, 1] = cosines, -sines
    turns[:, 1, 0], turns[:, 1, 1] = sines, cosines
    return turns
