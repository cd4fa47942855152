"""The moves are followed from the joints before them and timed at their programmed speeds
(docs/guide/motion.md). Without --acceleration, times are kinematic lower bounds, no cycle times.
Without --routine it is main, or the only one that moves. Findings are reported on stderr, and the
exit code is 1. `irbkin check` checks all routines, branches and loops too.

Examples:
  irbkin rapid "IRB 2600-12/1.65" program.mod tools.sys --routine weld --acceleration 600
  irbkin rapid "IRB 2600-12/1.85" program.mod --max-velocity 175 175 175 360 360 500
  irbkin rapid "IRB 2600-12/1.65" program.mod -o joints.mod
"""

import argparse
import contextlib
import math
from typing import Any

import numpy as np

from irbkin import Robot, rapid
from irbkin._core import parse_module
from irbkin.cli.arguments import Parser, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.files import opened, put_text, shown
from irbkin.cli.numbers import positive
from irbkin.cli.output import Column, Columns, show
from irbkin.cli.postures import joint_columns
from irbkin.errors import IrbkinError, RapidError
from irbkin.rapid import RoutineMotion


def add_arguments(parser: Parser) -> None:
    parser.add_robot()
    add = parser.add
    add("file", metavar="FILE", help="a RAPID module (.mod, .sys, .prg), - for stdin")
    add("context", metavar="OTHER", nargs="*", help="modules that declare what it names")
    add("--routine", metavar="NAME", help="the routine: main, or the only one that moves")
    add("--acceleration", type=positive, metavar="A", help="of every joint [deg/s^2]")
    add("--max-velocity", nargs="+", type=positive, metavar="V", help="of each joint [deg/s]")
    add("--samples", action="store_true", help="the samples of the motion, not its moves")
    parser.add_formats("samples: t [s], q [rad], shape (m, 7); .mod: MoveAbsJ", ".mod")


def run(arguments: argparse.Namespace) -> int:
    robot, speeds = read_robot(arguments), arguments.max_velocity
    words = "one for each joint [deg/s]"
    if speeds is None and robot.max_velocity is None:
        lack = f"the speeds of the joints of {robot.name} are unknown"
        raise CommandError(f"{lack}: give --max-velocity, {words}")
    if speeds is not None and len(speeds) != robot.dof:
        raise CommandError(f"--max-velocity takes {robot.dof} speeds, {words}, got {len(speeds)}")
    context = tuple(parsed(name) for name in arguments.context)
    acceleration = arguments.acceleration
    motion = motion_of(
        robot,
        arguments,
        parsed(arguments.file, context),
        max_velocity=None if speeds is None else np.radians(speeds),
        max_acceleration=None if acceleration is None else math.radians(acceleration),
    )
    name = motion.routine or "the text"
    heading = f"{robot.name}: {name}, {len(motion.moves)} moves, {motion.duration:.3f} s"
    output: str = arguments.output or ""
    if output.lower().endswith(".mod"):
        put_text(output, str(motion.to_module()))
    elif arguments.samples or output.lower().endswith(".npy"):
        columns = {Column("line", "5d"): motion.lines, Column("t", "9.4f", "s"): motion.t}
        array = np.column_stack([motion.t, motion.q])
        show(arguments, heading, {**columns, **joint_columns(motion.q)}, array)
    else:
        show(arguments, heading, _moves(robot, motion))
    for finding in motion.findings:
        complain(f"{arguments.file}:{finding.line}:{finding.column}: {finding.message}")
    return FOUND if motion.findings else FINE


def parsed(name: str, context: tuple[rapid.Module, ...] = ()) -> rapid.Module:
    try:
        with opened(name) as file:
            return parse_module(file.read(), context)
    except RapidError as error:
        raise CommandError(f"{shown(name)}: {error}") from None


def motion_of(
    robot: Robot, arguments: argparse.Namespace, module: rapid.Module, **options: Any
) -> RoutineMotion:
    """The motion of the routine that is asked for; an error names those that have one."""
    try:
        return rapid.motion(robot, module, arguments.routine, **options)
    except RapidError as error:
        words = f"{shown(arguments.file)}: {error}"
    playable = []
    for routine in module.routines:
        with contextlib.suppress(IrbkinError):
            if rapid.motion(robot, module, routine.name, **options).moves:
                playable.append(routine.name)
    hint = f" (--routine {' or '.join(playable)} has none)" if playable else ""
    raise CommandError(words + hint)


def _moves(robot: Robot, motion: RoutineMotion) -> Columns:
    moves = motion.moves
    q = np.array([np.full(robot.dof, np.nan) if it.q is None else it.q for it in moves])
    left = ["left out" if it.q is None else "joint move" for it in moves]
    made = ["programmed" if it.as_programmed else own for it, own in zip(moves, left, strict=True)]
    return {
        Column("line", "5d"): [it.line for it in moves],
        Column("move", "<8s"): [it.kind for it in moves],
        Column("start", "8.3f", "s"): [it.start for it in moves],
        Column("end", "8.3f", "s"): [it.end for it in moves],
        Column("length", "8.1f", "mm"): [it.length * 1e3 for it in moves],
        Column("as", "<10s"): made,
        **joint_columns(q),
    }
