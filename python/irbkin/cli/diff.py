"""Which robots, modules, tools, work objects, speeds, zones and motion settings differ, and
how many moves each touches; which moves have another speed, zone or tool; which targets moved, by
how much in space and in joints, which turned unreachable. Two backups need no robot; of two modules
or folders of modules it is the first name, or --robot. Exit codes: 0 nothing differs, 1 something
does.

Examples:
  irbkin diff backup_2025 backup_2026
  irbkin diff "IRB 2600-12/1.65" old/ new/
  irbkin diff --json backup_2025.zip backup_2026.zip
"""

import argparse
import json
import os
from collections import Counter
from dataclasses import asdict, replace

from irbkin._words import visible
from irbkin.abb import Change, Difference, TargetChange, diff
from irbkin.abb.differences import compared
from irbkin.abb.sides import Side
from irbkin.check.jobs import is_backup
from irbkin.cli.arguments import ROBOT_HELP, Parser, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError
from irbkin.cli.files import shown
from irbkin.rapid import load_program


def add_arguments(parser: Parser) -> None:
    add = parser.add
    add("arm", metavar="ROBOT", nargs="?", help=f"of programs: {ROBOT_HELP}")
    add("old", metavar="OLD", help="the earlier backup, a module or a folder of modules")
    add("new", metavar="NEW", help="the later one")
    add("-r", "--robot", metavar="ROBOT", help="the same")
    parser.add_frames()
    add("--json", action="store_true", help="write JSON")


def run(arguments: argparse.Namespace) -> int:
    difference = _difference(arguments)
    if arguments.json:
        print(json.dumps(asdict(difference), indent=1))
    else:
        every: tuple[Change | TargetChange, ...]
        every = (*difference.data, *difference.moves, *difference.targets)
        places = (str(replace(it, file=shown(it.file))) for it in every)
        lines = [*difference.robots, *difference.modules, *places]
        print("".join(f"{visible(line)}\n" for line in lines), end="")
        print(_last(difference))
    return FOUND if any(vars(difference).values()) else FINE


def _difference(arguments: argparse.Namespace) -> Difference:
    names = (arguments.old, arguments.new)
    if None not in (arguments.arm, arguments.robot):
        raise CommandError(f"a robot is given twice: {arguments.arm} and --robot {arguments.robot}")
    arguments.robot = arguments.arm or arguments.robot
    are_backups = [is_backup(name) for name in names]
    if all(are_backups) and arguments.robot is None:
        return diff(*names)
    if any(are_backups):
        raise CommandError(f"{' and '.join(names)}: give two backups and no robot, or two programs")
    arguments.robot = arguments.robot or os.environ.get("IRBKIN_ROBOT")
    robot = None if arguments.robot is None else read_robot(arguments)
    old, new = (Side(load_program(name), robot) for name in names)
    found = compared("", old, new)
    return replace(found, modules=tuple(it.removeprefix(": ") for it in found.modules))


def _last(difference: Difference) -> str:
    kinds = Counter(it.kind for it in difference.targets)
    words = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
    moves = sum(it.moves for it in difference.moves)
    counts = {"Data and settings": len(difference.data), "Moves": moves, "Targets": words}
    found = " ".join(f"{name}: {count}." for name, count in counts.items() if count)
    return found or ("" if difference.robots or difference.modules else "Nothing differs.")
