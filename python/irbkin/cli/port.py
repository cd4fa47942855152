"""The confdata of a program are solved anew for another arm, along its moves and nearest to the
postures of the arm before; nothing else changes, not one byte. The files are one program, or a
backup with one robot, which knows --from and --from-base. They are written into a new folder and
checked there. Moves are left, and listed, that have joint angles, are not checked, or are made
otherwise than programmed. Options that are not given are taken from irbkin.toml or pyproject.toml.
Exit codes: 0 all is ported, 1 some moves are left, 2 wrong usage.

Examples:
  irbkin port "IRB 2600-12/1.65" cell.mod tools.sys --from "IRB 1600-6/1.45" --to ported
  irbkin port "IRB 1660ID-6/1.55" backups/cell_3 --to ported
  irbkin port "IRB 1300-10/1.15" cell.mod --from "IRB 1600-6/1.45" --base 240 0 0 --to ported
"""

import argparse
import os
from dataclasses import replace

from irbkin._arm_options import robot_of
from irbkin._files import shown
from irbkin._words import counted, visible
from irbkin.check.checker import Checker
from irbkin.check.jobs import backup_of, only_job
from irbkin.check.report import rendered, report_of
from irbkin.check.settings import settings_of
from irbkin.cli.arguments import ROBOT_HELP, Parser
from irbkin.cli.check import given
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.files import STDIN
from irbkin.rapid import port
from irbkin.rapid.program import is_inside


def add_arguments(parser: Parser) -> None:
    add = parser.add
    add("arm", metavar="ARM", help=f"the new arm: {ROBOT_HELP}")
    add("files", metavar="FILE", nargs="+", help="modules, folders, or a backup")
    add("--from", dest="robot", metavar="ARM", help="the arm before, which a backup knows")
    add("--to", metavar="DIR", required=True, help="a new or an empty folder")
    parser.add_frame("base", "base of the new arm in the world, if it is another", "pose")
    parser.add_frame("from-base", "base of the arm before", "pose")
    parser.add_tools()


def run(arguments: argparse.Namespace) -> int:
    names: list[str] = arguments.files
    if STDIN in names:
        raise CommandError("port takes files, not stdin")
    for place in filter(os.path.isdir, (*names, backup_of(names) or "")):
        if is_inside(os.path.realpath(arguments.to), os.path.realpath(place)):
            raise CommandError(f"--to {arguments.to}: is in {place}, which is read: give another")
    settings = settings_of(names)
    options = {**settings.options, **given(arguments)}
    checker = Checker(options, settings)
    before = arguments.from_base or settings.options.get("base")
    source = None
    if "robot" in options:
        source = robot_of({**options, "tool": None, "base": before}, complain)
    base = arguments.base or before
    robot = robot_of({"robot": arguments.arm, "base": base}, complain)
    job = only_job(robot, names, settings)
    if job.is_saved and job.robot is not None:
        if base is None:
            robot = robot.with_base(job.robot.base)
        if source is None or before is None:
            source = (source or job.robot).with_base(job.robot.base)
    if not any(module.moves for module in job.program.modules):
        raise CommandError(f"{' and '.join(names)}: no instruction moves, nothing is ported")
    saved = {"units": job.units, "last_values": job.is_saved, "tools": checker.tools}
    ported = port(job.program, robot, to=arguments.to, source=source, **saved)
    of = f" instead of {source.name}" if source else ""
    files = counted(len(ported.program.files), "file")
    where = f"{files} in {shown(arguments.to)}"
    print(visible(f"{robot.name}{of}: {where}, {ported.changed} new confdata"))
    for left in ported.left:
        print(visible(f"{shown(left.file)}:{left.line}:{left.column}: {left.message}"))
    print(f"{counted(len(ported.left), 'move')} left as before\n")
    checked = replace(job, robot=robot, program=ported.program, title=robot.name, given=None)
    print(rendered(report_of(checker, [checked], []), "concise"), end="")
    return FOUND if ported.left else FINE
