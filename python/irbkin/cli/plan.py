"""`irbkin plan`: the best joints along a path of poses."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from irbkin._arm_options import check_millimeters
from irbkin.cli.arguments import Parser, joints, read_cell, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.numbers import count, number
from irbkin.cli.tool_paths import add_path, fastest, read_path

if TYPE_CHECKING:
    from irbkin import Robot, Track
    from irbkin._arrays import Floats

HELP = """Branch, turns of the joints and, with --rotation, the angle of the tool about its z are
chosen for the whole path: the largest joint speed is the least possible, and every step is shown to
be continuous (docs/guide/plan.md). Without a path the exit code is 1, and stderr says where and why
each branch ends."""
EXAMPLES = """  irbkin plan "IRB 2600-12/1.65" poses.csv
  irbkin plan "IRB 2600-12/1.65" corners.csv --through lines --rotation 36 --csv
  irbkin plan "IRB 2600-12/1.65" seam.csv --through lines --track 0 1 0 -3000 3000
  irbkin plan "IRB 2600-12/1.65" contour.npy --closed -o q.npy
  irbkin plan "IRB 2600-12/1.65" poses.csv -o weld.mod"""
MOST_ROTATION = 3600
MOST_TRACK = 1e6
"""How far the ends of a track may be from its zero [mm]."""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    parser.add_cell()
    add_path(parser)
    add = parser.add
    add(
        "--rotation",
        type=count(2, MOST_ROTATION),
        metavar="STEPS",
        help="number of tool angles around z",
    )
    add(
        "--track",
        nargs=5,
        type=number,
        metavar=("X", "Y", "Z", "FROM", "TO"),
        help="a track under the robot: its direction and its ends [mm]",
    )
    add(
        "--start", nargs="+", type=number, metavar="Q", help="joints at the first pose [deg], track"
    )
    add("--end", nargs="+", type=number, metavar="Q", help="joints at the last pose [deg], track")
    add("--closed", action="store_true", help="the joints end where they start")
    parser.add_formats(
        "joint angles in radians, shape (m, 6), and the track in meters, (m, 7); .mod: RAPID",
        ".mod",
    )


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    import numpy as np

    from irbkin import rapid
    from irbkin.cli.files import replaced
    from irbkin.cli.output import Column, table
    from irbkin.cli.postures import Postures
    from irbkin.cli.progress import waiting
    from irbkin.errors import PathError

    robot, cell = read_robot(arguments), read_cell(arguments)
    poses = read_path(arguments, robot)
    try:
        with waiting(f"plan of {len(poses):,} poses"):
            plan = robot.plan(
                poses,
                rotation=arguments.rotation,
                start=_end(arguments, "start", robot),
                end=_end(arguments, "end", robot),
                closed=arguments.closed,
                cell=cell,
                carrier=_track(arguments.track),
            )
    except PathError as error:
        complain(error)
        return FOUND
    if (arguments.output or "").lower().endswith(".mod"):
        module = rapid.plan_module(robot, plan, carrier=_track(arguments.track))
        with replaced(arguments.output) as file:
            file.write(str(module).encode())
        return FINE
    postures = Postures(robot)
    columns = (
        Column("pose", "", "6d"),
        *(Column(name, "mm", "8.2f") for name in "xyz"),
        Column("tool_angle", "deg", "8.2f"),
        *([] if arguments.track is None else [Column("track", "mm", "8.1f")]),
        *postures.columns,
    )
    with table(arguments, columns, f"{robot.name}: {len(poses)} poses") as rows:
        places = (poses[:, axis, 3] * 1e3 for axis in range(3))
        angle = np.degrees(plan.tool_angle)
        track = (plan.external * 1e3).T
        rows.write(
            [np.arange(len(poses)), *places, angle, *track, *postures.values(plan.q)],
            np.hstack([plan.q, plan.external]),
        )
        rows.note("certified", plan.certified, "every step is shown to be continuous")
        turned = poses @ _about_z(plan.tool_angle)
        # The speed of a tool that a track carries is not the arm's alone.
        if arguments.track is None and (best := fastest(robot, plan.q, turned)):
            speed, joint = best
            words = f"tool speed up to {speed * 1e3:.0f} mm/s, limited by J{joint}"
            rows.note("fastest_mm_s", speed * 1e3, words)
    return FINE


def _track(numbers: list[float] | None) -> Track | None:
    from irbkin.freedom import Track

    if numbers is None:
        return None
    *direction, lower, upper = numbers
    if not any(direction):
        raise CommandError("--track: its direction X Y Z is 0 0 0, it must have a length")
    check_millimeters([lower, upper], "--track: its ends")
    if not -MOST_TRACK <= lower < upper <= MOST_TRACK:
        raise CommandError(
            f"--track: its ends {lower:g} and {upper:g} mm must be FROM < TO, between "
            f"{-MOST_TRACK:g} and {MOST_TRACK:g} mm"
        )
    return Track(direction, lower / 1e3, upper / 1e3)


def _end(arguments: argparse.Namespace, name: str, robot: Robot) -> Floats | None:
    """Joints at an end [rad], with the place on the track [m] if there is one."""
    import numpy as np

    given: list[float] | None = getattr(arguments, name)
    if given is None or arguments.track is None:
        return joints(given, f"--{name}", robot.dof)
    *angles, place = given
    q = joints(angles, f"--{name} (with the track's place behind the joints)", robot.dof)
    return None if q is None else np.append(q, place / 1e3)


def _about_z(angles: Floats) -> Floats:
    """Rotations about z, shape (m, 4, 4)."""
    import numpy as np

    turns = np.tile(np.eye(4), (len(angles), 1, 1))
    cosines, sines = np.cos(angles), np.sin(angles)
    turns[:, 0, 0], turns[:, 0, 1] = cosines, -sines
    turns[:, 1, 0], turns[:, 1, 1] = sines, cosines
    return turns
