"""The joints go from pose to pose on the branch of the first one: that nearest to --seed.
Breaks, where they cannot, are reported on stderr, and the exit code is 1. See `irbkin plan` for
the branch that is best for the whole path.

Examples:
  irbkin path "IRB 2600-12/1.65" corners.csv --through lines --zone z20 --step 2 --csv
  irbkin path "IRB 2600-12/1.65" poses.csv --seed 0 0 0 0 30 0 --singularity wrist -o q.npy
"""

import argparse

import numpy as np

from irbkin.cli.arguments import Parser, joints, read_robot, read_wobj
from irbkin.cli.errors import FINE, FOUND, complain
from irbkin.cli.output import Column, show
from irbkin.cli.postures import place_columns, posture_columns
from irbkin.cli.tool_paths import add_path, read_path, speed_notes

MOST_SHOWN = 10
"""How many breaks are reported one by one."""


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    add_path(parser)
    add = parser.add
    parser.add_joints("seed", "joints before the path [deg]: zeros")
    add(
        "--singularity",
        choices=("through", "error", "wrist", "lock_axis4"),
        default="through",
        help="what to do at the wrist singularity: through",
    )
    parser.add_formats("joint angles, shape (m, 6), in radians")


def run(arguments: argparse.Namespace) -> int:

    robot = read_robot(arguments)
    poses = read_path(arguments, robot)
    seed = joints(arguments.seed, "--seed", robot.dof)
    start = np.zeros(robot.dof) if seed is None else seed
    world = read_wobj(arguments) @ poses
    followed = robot.follow(world, start, singularity_mode=arguments.singularity)
    columns = {
        Column("pose", "6d"): np.arange(len(poses)),
        **place_columns(poses),
        **posture_columns(robot, followed.q),
        Column("off", "6.2f", "deg"): np.degrees(followed.orientation_error),
    }
    notes = () if followed.breaks else speed_notes(robot, followed.q, world)
    show(arguments, f"{robot.name}: {len(poses)} poses", columns, followed.q, *notes)
    for broken in followed.breaks[:MOST_SHOWN]:
        complain(broken.reason)
    if len(followed.breaks) > MOST_SHOWN:
        complain(f"{len(followed.breaks) - MOST_SHOWN} more breaks")
    return FOUND if followed.breaks else FINE
