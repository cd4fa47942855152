"""`irbkin path`: joints along a path of poses."""

from __future__ import annotations

import argparse

from irbkin.cli.arguments import Parser, joints, read_robot
from irbkin.cli.errors import FINE, FOUND, complain
from irbkin.cli.numbers import number
from irbkin.cli.tool_paths import add_path, fastest, read_path

HELP = """The joints go from pose to pose on the branch of the first one: that nearest to --seed.
Breaks, where they cannot, are reported on stderr, and the exit code is 1. See `irbkin plan` for
the branch that is best for the whole path."""
EXAMPLES = """  irbkin path "IRB 2600-12/1.65" poses.csv
  irbkin path "IRB 2600-12/1.65" corners.csv --through lines --zone z20 --step 2 --csv
  irbkin path "IRB 2600-12/1.65" poses.csv --seed 0 0 0 0 30 0 --singularity wrist -o q.npy"""


MOST_SHOWN = 10
"""How many breaks are reported one by one."""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    add_path(parser)
    add = parser.add
    add("--seed", nargs="+", type=number, metavar="Q", help="joints before the path [deg]: zeros")
    add(
        "--singularity",
        choices=("through", "error", "wrist", "lock_axis4"),
        default="through",
        help="what to do at the wrist singularity: through",
    )
    parser.add_formats("joint angles, shape (m, 6), in radians")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    import numpy as np

    from irbkin.cli.output import Column, table
    from irbkin.cli.postures import Postures

    robot = read_robot(arguments)
    poses = read_path(arguments, robot)
    seed = joints(arguments.seed, "--seed", robot.dof)
    followed = robot.follow(
        poses,
        np.zeros(robot.dof) if seed is None else seed,
        singularity_mode=arguments.singularity,
    )
    postures = Postures(robot)
    columns = (
        Column("pose", "", "6d"),
        *(Column(name, "mm", "8.2f") for name in "xyz"),
        *postures.columns,
        Column("off", "deg", "6.2f"),
    )
    count = f"{len(poses)} poses"
    with table(arguments, columns, f"{robot.name}: {count}") as rows:
        places = (poses[:, axis, 3] * 1e3 for axis in range(3))
        off = np.degrees(followed.orientation_error)
        rows.write([np.arange(len(poses)), *places, *postures.values(followed.q), off], followed.q)
        if not followed.breaks and (best := fastest(robot, followed.q, poses)):
            speed, joint = best
            words = f"tool speed up to {speed * 1e3:.0f} mm/s, limited by J{joint}"
            rows.note("fastest_mm_s", speed * 1e3, words)
    for broken in followed.breaks[:MOST_SHOWN]:
        complain(broken.reason)
    if len(followed.breaks) > MOST_SHOWN:
        complain(f"{len(followed.breaks) - MOST_SHOWN} more breaks")
    return FOUND if followed.breaks else FINE
