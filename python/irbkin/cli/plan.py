"""Branch, turns of the joints and, with --rotation, the angle of the tool about its z are
chosen for the whole path: the largest joint speed is the least possible, and every step is shown to
be continuous (docs/guide/plan.md). Without a path the exit code is 1, and stderr says where and why
each branch ends.

Examples:
  irbkin plan "IRB 2600-12/1.65" corners.csv --through lines --rotation 36 --csv
  irbkin plan "IRB 2600-12/1.65" seam.csv --through lines --track 0 1 0 -3000 3000
  irbkin plan "IRB 2600-12/1.65" poses.csv -o weld.mod
"""

import argparse
from typing import Any

import numpy as np

from irbkin import Robot, Track, pose, rapid
from irbkin._arm_options import check_millimeters
from irbkin.cli.arguments import Parser, joints, read_cell, read_robot, read_wobj
from irbkin.cli.data import angles_of
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.files import put_text
from irbkin.cli.numbers import count, number
from irbkin.cli.output import Column, Floats, show
from irbkin.cli.postures import place_columns, posture_columns
from irbkin.cli.progress import waiting
from irbkin.cli.tool_paths import add_path, read_path, speed_notes
from irbkin.errors import PathError

MOST_ROTATION = 3600
MOST_TRACK = 1e6
"""How far the ends of a track may be from its zero [mm]."""


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    parser.add_cell()
    add_path(parser)
    add = parser.add
    steps = count(2, MOST_ROTATION)
    add("--rotation", type=steps, metavar="STEPS", help="number of tool angles around z")
    ends = (*"XYZ", "FROM", "TO")
    add("--track", nargs=5, type=number, metavar=ends, help="direction and ends of a track [mm]")
    parser.add_joints("start", "joints at the first pose [deg], track")
    parser.add_joints("end", "joints at the last pose [deg], track")
    add("--closed", action="store_true", help="the joints end where they start")
    parser.add_formats("joints [rad], (m, 6), track [m], (m, 7); .mod: RAPID", ".mod")


def run(arguments: argparse.Namespace) -> int:
    robot, cell = read_robot(arguments), read_cell(arguments)
    poses = read_path(arguments, robot)
    world = read_wobj(arguments) @ poses
    try:
        with waiting(f"plan of {len(poses):,} poses"):
            plan = robot.plan(
                world,
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
        put_text(arguments.output, str(module))
        return FINE
    columns = {
        Column("pose", "6d"): np.arange(len(poses)),
        **place_columns(poses),
        Column("tool_angle", "8.2f", "deg"): np.degrees(plan.tool_angle),
        **{Column("track", "8.1f", "mm"): own for own in plan.external.T * 1e3},
        **posture_columns(robot, plan.q),
    }
    notes: list[Any] = [("certified", plan.certified, "every step is shown to be continuous")]
    # The speed of a tool that a track carries is not the arm's alone.
    if arguments.track is None:
        turns = pose(np.zeros((len(poses), 3)), euler_zyx=plan.tool_angle[:, None] * [1.0, 0, 0])
        notes += speed_notes(robot, plan.q, world @ turns)
    array = np.hstack([plan.q, plan.external])
    show(arguments, f"{robot.name}: {len(poses)} poses", columns, array, *notes)
    return FINE


def _track(numbers: list[float] | None) -> Track | None:
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
    given: list[float | str] | None = getattr(arguments, name)
    if given is None or arguments.track is None:
        return joints(given, f"--{name}", robot.dof)
    *angles, place = angles_of(given, robot.dof + 1)
    q = joints(angles, f"--{name} (with the track's place behind the joints)", robot.dof)
    return None if q is None else np.append(q, place / 1e3)
