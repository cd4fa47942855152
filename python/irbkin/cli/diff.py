"""`irbkin diff`: what differs between two backups, or two programs."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict, replace
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError
from irbkin.cli.files import shown
from irbkin.cli.jobs import is_backup

if TYPE_CHECKING:
    from irbkin.abb import Difference

HELP = """Which targets moved, by how much in space and in joints, which turned unreachable; which
robots have other limits or another base; which modules are new. Two backups need no --robot. Exit
codes: 0 nothing differs, 1 something does."""
EXAMPLES = """  irbkin diff backup_2025 backup_2026
  irbkin diff --robot "IRB 2600-12/1.65" old/ new/
  irbkin diff --json backup_2025.zip backup_2026.zip"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add = parser.add
    add("old", metavar="OLD", help="the earlier backup, a module or a folder of modules")
    add("new", metavar="NEW", help="the later one")
    add("--robot", metavar="ROBOT", help="name in the catalog, or a .urdf file")
    parser.add_frames()
    add("--json", action="store_true", help="write JSON")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    difference = _difference(arguments)
    if arguments.json:
        print(json.dumps(asdict(difference), indent=1))
    else:
        targets = (replace(it, file=shown(it.file)) for it in difference.targets)
        lines = [*difference.robots, *difference.modules, *map(str, targets)]
        print("".join(f"{line}\n" for line in lines), end="")
        print(_last(difference))
    is_same = not (difference.robots or difference.modules or difference.targets)
    return FINE if is_same else FOUND


def _difference(arguments: argparse.Namespace) -> Difference:
    from irbkin.abb import Difference, diff
    from irbkin.abb.differences import Side, compared
    from irbkin.rapid import load_program

    names = (arguments.old, arguments.new)
    are_backups = [is_backup(name) for name in names]
    if all(are_backups) and arguments.robot is None:
        return diff(*names)
    if any(are_backups):
        raise CommandError(f"{' and '.join(names)}: two backups, or two programs with --robot")
    robot = None if arguments.robot is None else read_robot(arguments)
    old, new = (Side(load_program(name), robot) for name in names)
    targets, modules = compared("", old, new)
    return Difference(tuple(targets), (), tuple(it.removeprefix(": ") for it in modules))


def _last(difference: Difference) -> str:
    """The last sentence."""
    kinds: dict[str, int] = {}
    for it in difference.targets:
        kinds[it.kind] = kinds.get(it.kind, 0) + 1
    words = ", ".join(f"{count} {kind}" for kind, count in kinds.items())
    return f"Targets: {words}." if words else "No target differs."
