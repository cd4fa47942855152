"""`irbkin rapid`: the moves of a routine as one motion."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.numbers import positive

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin._arrays import Floats
    from irbkin.rapid import RoutineMotion

HELP = """The moves are followed from the joints before them and timed at their programmed speeds
(docs/guide/motion.md). Without --acceleration, times are kinematic lower bounds, no cycle times.
Without --routine it is main, or the only one that moves. Findings are reported on stderr, and the
exit code is 1. `irbkin check` checks all routines, branches and loops too."""
EXAMPLES = """  irbkin rapid "IRB 2600-12/1.65" program.mod
  irbkin rapid "IRB 2600-12/1.65" program.mod tools.sys --routine weld --acceleration 600
  irbkin rapid "IRB 2600-12/1.65" program.mod --samples --csv > motion.csv
  irbkin rapid "IRB 2600-12/1.85" program.mod --max-velocity 175 175 175 360 360 500
  irbkin rapid "IRB 2600-12/1.65" program.mod -o joints.mod"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    parser.add_robot()
    add = parser.add
    add("file", metavar="FILE", help="a RAPID module (.mod, .sys, .prg), - for stdin")
    add("context", metavar="OTHER", nargs="*", help="modules that declare what it names")
    add("--routine", metavar="NAME", help="the routine: main, or the only one that moves")
    add("--acceleration", type=positive, metavar="A", help="of every joint [deg/s^2]")
    add(
        "--max-velocity",
        nargs="+",
        type=positive,
        metavar="V",
        help="of each joint [deg/s], by default the catalog's",
    )
    add("--samples", action="store_true", help="the samples of the motion, not its moves")
    parser.add_formats(
        "samples: time [s] and joint angles [rad], shape (m, 7); .mod: MoveAbsJ", ".mod"
    )


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    import math

    from irbkin import rapid
    from irbkin._core import parse_module
    from irbkin.cli.files import opened, replaced, shown
    from irbkin.errors import RapidError

    robot = read_robot(arguments)

    def parsed(name: str, context: tuple[rapid.Module, ...] = ()) -> rapid.Module:
        try:
            with opened(name) as file:
                return parse_module(file.read(), context)
        except RapidError as error:
            raise CommandError(f"{shown(name)}: {error}") from None

    context = tuple(parsed(name) for name in arguments.context)
    acceleration = arguments.acceleration
    velocity = _max_velocity(arguments.max_velocity, robot)
    motion = rapid.motion(
        robot,
        parsed(arguments.file, context),
        arguments.routine,
        max_velocity=velocity,
        max_acceleration=None if acceleration is None else math.radians(acceleration),
    )
    output: str = arguments.output or ""
    if output.lower().endswith(".mod"):
        with replaced(output) as file:
            file.write(str(motion.to_module()).encode())
    elif arguments.samples or output.lower().endswith(".npy"):
        _write_samples(arguments, robot, motion)
    else:
        _write_moves(arguments, robot, motion)
    for finding in motion.findings:
        complain(f"{arguments.file}:{finding.line}:{finding.column}: {finding.message}")
    return FOUND if motion.findings else FINE


def _max_velocity(numbers: list[float] | None, robot: Robot) -> Floats | None:
    """Return the speeds of the joints [deg/s] as an array [rad/s]; None for the robot's."""
    import numpy as np

    if numbers is None and robot.max_velocity is None:
        raise CommandError(
            f"the speeds of the joints of {robot.name} are unknown: give --max-velocity, one for "
            "each joint [deg/s]"
        )
    if numbers is not None and len(numbers) != robot.dof:
        raise CommandError(
            f"--max-velocity takes {robot.dof} speeds [deg/s] of this arm, got {len(numbers)}"
        )
    return None if numbers is None else np.radians(numbers)


def _heading(robot: Robot, motion: RoutineMotion) -> str:
    name = motion.routine or "the text"
    return f"{robot.name}: {name}, {len(motion.moves)} moves, {motion.duration:.3f} s"


def _write_moves(arguments: argparse.Namespace, robot: Robot, motion: RoutineMotion) -> None:
    """A row for each move."""
    import numpy as np

    from irbkin.cli.output import Column, table
    from irbkin.cli.postures import Postures

    columns = (
        Column("line", "", "5d"),
        Column("move", "", "<8s"),
        Column("start", "s", "8.3f"),
        Column("end", "s", "8.3f"),
        Column("length", "mm", "8.1f"),
        Column("as", "", "<10s"),
        *Postures.joints(robot.dof),
    )
    moves = motion.moves
    q = np.array([np.full(6, np.nan) if it.q is None else it.q for it in moves])
    made = [
        "programmed" if it.as_programmed else "left out" if it.q is None else "joint move"
        for it in moves
    ]
    with table(arguments, columns, _heading(robot, motion)) as rows:
        rows.write(
            [
                [it.line for it in moves],
                [it.kind for it in moves],
                [it.start for it in moves],
                [it.end for it in moves],
                [it.length * 1e3 for it in moves],
                made,
                *np.degrees(q).T + 0.0,
            ]
        )


def _write_samples(arguments: argparse.Namespace, robot: Robot, motion: RoutineMotion) -> None:
    """A row for each sample."""
    import numpy as np

    from irbkin.cli.output import Column, table
    from irbkin.cli.postures import Postures

    columns = (
        Column("line", "", "5d"),
        Column("t", "s", "9.4f"),
        *Postures.joints(robot.dof),
    )
    with table(arguments, columns, _heading(robot, motion)) as rows:
        array = np.column_stack([motion.t, motion.q])
        rows.write([motion.lines, motion.t, *np.degrees(motion.q).T + 0.0], array)
