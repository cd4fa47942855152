"""Arguments that verbs share: the arm, its tool and base, poses, formats."""

from __future__ import annotations

import argparse
import math
import os
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, NoReturn

from irbkin._arm_options import robot_of
from irbkin.cli.errors import CommandError, complain
from irbkin.cli.numbers import check_joints, number

if TYPE_CHECKING:
    from irbkin import Cell, Robot
    from irbkin._arrays import Floats

ROBOT_HELP = "name in the catalog, or a .urdf or RobotStudio file"
TABLES = (".csv", ".json", ".npy", ".txt")
NUMBER = re.compile(r"-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


class Parser:
    """The arguments of a verb."""

    def __init__(self, verb: str, title: str, words: str, examples: str) -> None:
        self.verb = verb
        self.parser = _OneLine(
            prog=f"irbkin {verb}",
            description=f"{title[0].upper()}{title[1:]}.\n\n{words}",
            epilog=f"examples:\n{examples}",
            formatter_class=_Help,
            allow_abbrev=False,
        )
        self.add = self.parser.add_argument
        self.endings: tuple[str, ...] | None = None

    def parsed(self, given: Sequence[str]) -> argparse.Namespace:
        """The arguments; a negative number is not an option, with an exponent either."""
        words = [f" {it}" if NUMBER.fullmatch(it) else it for it in given]
        arguments = self.parser.parse_intermixed_args(words)
        if self.endings is not None and not (arguments.json or arguments.csv):
            _check_ending(arguments.output, self.endings)
        return arguments

    def add_robot(self) -> None:
        """The arm, and what it carries."""
        self.add("robot", metavar="ROBOT", help=ROBOT_HELP)
        self.add_frames()

    def add_frames(self) -> None:
        """The frames of a .urdf file, the tool and the base."""
        self.add("--tip", metavar="LINK", help="of a .urdf file: the link that poses are of")
        self.add("--base-link", metavar="LINK", help="and the one that they are seen from")
        self.add(
            "--snap",
            type=number,
            metavar="RAD",
            help="and how far angles are rounded to right angles [rad]: 1e-5 takes 1.5708 for one",
        )
        for name, frame in (("tool", "TCP in the flange"), ("base", "base in the world")):
            self.add(
                f"--{name}",
                nargs="+",
                type=number,
                metavar="N",
                help=f"{frame}: x y z [mm], then w x y z or rz ry rx [deg] if turned",
            )

    def add_cell(self) -> None:
        """The cell around the arm."""
        self.add("--cell", metavar="FILE", help="what the arm must not touch: .toml, .urdf, .scene")

    def add_rows(self, what: str, *, optional: bool = True) -> None:
        """A file of rows."""
        self.add(
            "file",
            metavar="FILE",
            nargs="?" if optional else None,
            help=f"{what}: a CSV or .npy file, - for stdin",
        )

    def add_formats(self, array: str, *others: str) -> None:
        """How rows are written: by the ending of the output, which may be one of `others`."""
        self.endings = (*TABLES, *others)
        formats = self.parser.add_mutually_exclusive_group()
        formats.add_argument("--json", action="store_true", help="write JSON")
        formats.add_argument("--csv", action="store_true", help="write CSV")
        self.add(
            "-o",
            "--output",
            metavar="FILE",
            help=f"write to a file, its format by its ending: .csv, .json, .npy ({array}), "
            ".txt or none for a table",
        )


class _Help(argparse.RawDescriptionHelpFormatter):
    """Help of one width: asking the terminal would import what nothing else needs."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, width=96)


class _OneLine(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        """End the command."""
        raise CommandError(f"{message} ({self.prog} --help)")


def _check_ending(output: str | None, endings: Sequence[str]) -> None:
    ending = os.path.splitext(output or "")[1].lower()
    if ending and ending not in endings:
        raise CommandError(
            f"--output: {output} ends in {ending}, it must end in {', '.join(endings)} or in "
            "nothing, for a table"
        )


def read_robot(arguments: argparse.Namespace) -> Robot:
    """The arm of the arguments, with its tool and base."""
    return robot_of(vars(arguments), complain)


def read_cell(arguments: argparse.Namespace) -> Cell | None:
    """The cell of the arguments, if there is one."""
    from irbkin import Cell

    return None if arguments.cell is None else Cell.load(arguments.cell)


def read_q7(arguments: argparse.Namespace, robot: Robot) -> float | None:
    """The angle of joint 7 [rad], which the arm takes if it has seven joints."""
    q7: float | None = arguments.q7
    if robot.dof == 7 and q7 is None:
        raise CommandError(f"{robot.name} has seven joints: give --q7, the angle of joint 7 [deg]")
    if robot.dof != 7 and q7 is not None:
        raise CommandError(f"--q7 is for arms of seven joints, {robot.name} has {robot.dof}")
    return None if q7 is None else math.radians(q7)


def joints(numbers: Sequence[float] | None, name: str, dof: int) -> Floats | None:
    """Joint angles [deg] as an array [rad], shape (dof,)."""
    import numpy as np

    if numbers is None:
        return None
    if len(numbers) != dof:
        raise CommandError(f"{name} takes {dof} angles [deg] of this arm, got {len(numbers)}")
    check_joints(numbers, name)
    return np.radians(numbers)
