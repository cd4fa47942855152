"""Arguments that verbs share: the arm, its tool and base, poses, formats."""

from __future__ import annotations

import argparse
import functools
import os
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NoReturn

from irbkin._arm_options import check_millimeters, frame, is_arm_file, robot_of
from irbkin.cli.data import angles_of, frame_of, is_data
from irbkin.cli.errors import CommandError, complain
from irbkin.cli.numbers import MOST_ANGLE, TOO_LARGE, number, number_or_data
from irbkin.errors import UnknownRobotError

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin._arrays import Floats

ROBOT_HELP = "name in the catalog, or a .urdf or RobotStudio file"
GIVE_ROBOT = 'give ROBOT first, as "IRB 2600-12/1.65", or once in IRBKIN_ROBOT or irbkin.toml'
OF_ARM = ("tool", "base", "limits", "linkage_limits", "cell")
"""Options of irbkin.toml that belong to its robot."""
OTHERS = {
    "pos position p xyz_mm": "--xyz",
    "quat quaternion q rot": "--wxyz",
    "rpy zyx abc": "--euler",
    "workobject wobjdata frame": "--wobj",
    "tcp tooldata": "--tool",
    "q0 init near": "--seed",
    "robot": "--arm",
    "colour no-color": "--color",
}
"""Names of options elsewhere, and ours."""
TABLES = (".csv", ".json", ".npy", ".txt")
NAMED = re.compile(r"[A-Za-z]\w*=")
NUMBER = re.compile(r"-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


class Parser(argparse.ArgumentParser):
    """A parser whose errors are one line, and whose help has the width of the terminal."""

    add = argparse.ArgumentParser.add_argument

    def __init__(self, **options: Any) -> None:
        # Each argument that is added asks for a formatter: this one does not ask the terminal.
        plain = functools.partial(argparse.HelpFormatter, width=96)
        super().__init__(formatter_class=plain, allow_abbrev=False, **options)
        self.examples, self.own_usage = "", self.usage
        self.endings: tuple[str, ...] | None = None
        self.needs_robot = False

    def print_help(self, file: Any = None) -> None:
        from rich_argparse import RichHelpFormatter

        RichHelpFormatter.text_markup = RichHelpFormatter.help_markup = False
        self.formatter_class = RichHelpFormatter
        # Parsing has set the usage, at another width.
        self.usage = self.own_usage
        super().print_help(file)
        print(self.examples, end="")

    def error(self, message: str) -> NoReturn:
        if message.endswith("required: ROBOT"):
            message = f"no robot: {GIVE_ROBOT}"
        elif unknown := re.match(r"unrecognized arguments: (-\S+)", message):
            import difflib

            word, options = unknown[1].partition("=")[0], self._option_string_actions
            meant = [it for names, it in OTHERS.items() if word.strip("-") in names.split()]
            close = [it for it in meant if it in options]
            for it in close or difflib.get_close_matches(word, options, n=1):
                message += f": did you mean {it}?"
        raise CommandError(f"{message} ({self.prog} --help)")

    def parsed(self, given: Sequence[str]) -> argparse.Namespace:
        """The arguments; a negative number is not an option, with an exponent either."""
        words = [f" {it}" if NUMBER.fullmatch(it) else it for it in given]
        if self.needs_robot and not {"-h", "--help"} & {*words}:
            words = self._with_robot(words)
        arguments = self.parse_intermixed_args(words)
        for name in ("tool", "base", "wobj"):
            own = getattr(arguments, name, None)
            if own and isinstance(own[0], str):
                setattr(arguments, name, frame_of(own, name))
        if self.endings is not None and not (arguments.json or arguments.csv):
            output, wanted = arguments.output or "", ", ".join(self.endings)
            if (ending := os.path.splitext(output)[1].lower()) and ending not in self.endings:
                what = f"--output: {output} ends in {ending}"
                raise CommandError(f"{what}, it must end in {wanted} or in nothing, for a table")
        return arguments

    def _with_robot(self, words: list[str]) -> list[str]:
        """The arguments with the robot first: given by its option, or once for all calls."""
        options = Parser(prog=self.prog, add_help=False)
        options.add_argument("-r", "--robot")
        given, rest = options.parse_known_args(words)
        if given.robot is not None:
            return [given.robot, *rest]
        if any(map(_is_arm, words)) or (words and _is_meant(words[0])):
            return words
        if robot := os.environ.get("IRBKIN_ROBOT"):
            return [robot, *words]
        from irbkin.check.settings import settings_of

        settings = settings_of([])
        if "robot" not in settings.options:
            return words
        own = {name: it for name, it in settings.options.items() if name in OF_ARM}
        self.set_defaults(**own)
        complain(f"{', '.join(('robot', *own)).replace('_', '-')} of {settings.file}")
        return [settings.options["robot"], *words]

    def add_robot(self) -> None:
        self.needs_robot = True
        self.add("robot", metavar="ROBOT", help=ROBOT_HELP)
        words = "the same: -r ROBOT or IRBKIN_ROBOT=ROBOT takes the place of the first argument"
        self.add("-r", "--robot", dest="robot_", metavar="ROBOT", help=words)
        self.add_frames()

    def add_frames(self, *, with_tool: bool = True) -> None:
        """The frames of a .urdf file, the tool and the base."""
        self.add("--tip", metavar="LINK", help="of a .urdf file: the link that poses are of")
        self.add("--base-link", metavar="LINK", help="and the one that they are seen from")
        words = "and how far angles are rounded to right angles [rad]: 1e-3 takes 1.571 for one"
        self.add("--snap", type=number, metavar="RAD", help=words)
        if with_tool:
            self.add_frame("tool", "TCP in the flange", "tooldata")
        self.add_frame("base", "base in the world", "pose")

    def add_frame(self, name: str, frame: str, kind: str) -> None:
        words = f"{frame}: x y z [mm], then w x y z or rz ry rx [deg] if turned; or a {kind}"
        self.add(f"--{name}", nargs="+", type=number_or_data, metavar="N", help=words)

    def add_tools(self) -> None:
        words = "TCP of a tool that nothing declares: as of ik; without NAME= of all others"
        self.add("--tool", nargs="+", action="append", metavar=("[NAME=]X", "Y Z"), help=words)

    def add_wobj(self) -> None:
        self.add_frame("wobj", "frame of the poses in the world", "wobjdata")

    def add_joints(self, name: str, words: str) -> None:
        self.add(f"--{name}", nargs="+", type=number_or_data, metavar="Q", help=words)

    def add_cell(self) -> None:
        self.add("--cell", metavar="FILE", help="what the arm must not touch: .toml, .urdf")

    def add_formats(self, array: str, *others: str) -> None:
        """How rows are written: by the ending of the output, which may be one of `others`."""
        self.endings = (*TABLES, *others)
        formats = self.add_mutually_exclusive_group()
        formats.add_argument("--json", action="store_true", help="write JSON")
        formats.add_argument("--csv", action="store_true", help="write CSV")
        words = f"write to a file, its format by its ending: .csv, .json, .npy ({array}), "
        self.add("-o", "--output", metavar="FILE", help=f"{words}.txt or none for a table")


def _is_arm(word: str) -> bool:
    from irbkin import catalog_entry

    try:
        return is_arm_file(word) or bool(catalog_entry(word))
    except UnknownRobotError:
        return False


def _is_meant(word: str) -> bool:
    """Whether a first word is a scene, or a robot that is misspelled."""
    is_name = re.fullmatch(r"(?!-|.*\.[A-Za-z]+$)(?=.*[A-Za-z])(?=.*\d)[\w /.-]+", word)
    return word.endswith(".json") or (is_name is not None and not os.path.exists(word))


def read_robot(arguments: argparse.Namespace) -> Robot:
    name = (arguments.robot or "").strip()
    if not name:
        raise CommandError(f"no robot: {GIVE_ROBOT}")
    try:
        return robot_of(vars(arguments), complain)
    except UnknownRobotError:
        # A number, a file.
        is_other = re.fullmatch(r"-?\d{1,2}|[\d.]*\.[\d.]*|.*\.\w{3}", name)
        if is_other or is_data(name) or os.path.isfile(name):
            raise CommandError(f"{name[:60]!r} is no robot: {GIVE_ROBOT}") from None
        raise


def read_wobj(arguments: argparse.Namespace) -> Floats:
    return frame(arguments.wobj or [0, 0, 0], "--wobj")


def read_tools(given: Sequence[Sequence[str]]) -> dict[str | None, Floats]:
    """The frames of tools that nothing declares, by their names; None is for all others."""
    tools: dict[str | None, Floats] = {}
    for first, *others in given:
        name, _, value = first.partition("=") if NAMED.match(first) else ("", "", first)
        words = [value, *others]
        try:
            numbers = frame_of(words, "tool") if is_data(value) else [number(it) for it in words]
        except argparse.ArgumentTypeError as error:
            raise CommandError(f"--tool: {error}") from None
        tools[name or None] = frame(numbers, "--tool")
    return tools


def read_pose(arguments: argparse.Namespace) -> tuple[Floats, str]:
    """The pose of --xyz and an orientation, shape (4, 4), and its words."""
    if arguments.wxyz and arguments.euler:
        raise CommandError("--wxyz and --euler: give one of them")
    turn = arguments.wxyz or arguments.euler or []
    return pose_of(
        [*(arguments.xyz or (0, 0, 0)), *turn], "--euler" if arguments.euler else "--wxyz"
    )


def pose_of(numbers: Sequence[float], name: str) -> tuple[Floats, str]:
    """The pose of 3, 6 or 7 numbers, shape (4, 4), and its words."""
    check_millimeters(numbers[:3], "--xyz")
    texts = [f"{number:g}" for number in numbers]
    words = f"tool at {' '.join(texts[:3])} mm"
    kind = {3: "wxyz 1 0 0 0, as no orientation is given", 6: "rz ry rx ", 7: "wxyz "}
    return frame(numbers, name), f"{words}, {kind.get(len(numbers), '')}{' '.join(texts[3:])}"


def joints(words: Sequence[float | str] | None, name: str, dof: int) -> Floats | None:
    """Joint angles [deg] or a jointtarget as an array [rad], shape (dof,)."""
    import numpy as np

    if words is None:
        return None
    numbers = angles_of(words, dof)
    if len(numbers) != dof:
        raise CommandError(f"{name} takes {dof} angles [deg] of this arm, got {len(numbers)}")
    for joint, value in enumerate(numbers, 1):
        if abs(value) > MOST_ANGLE:
            raise CommandError(f"{name}: joint {joint} at {value:g} deg {TOO_LARGE}")
    return np.radians(numbers)
