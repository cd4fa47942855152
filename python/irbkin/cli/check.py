"""Every instruction that moves is checked: reach, limits, flips, confdata, singularities, speeds,
zones, names and, with --cell, collisions (`irbkin rule CODE` explains a code). Calls are followed
with their arguments. The files are one program. A backup of a controller needs no ROBOT: each task
is checked with its own. A comment `! noqa` or `! noqa: C201,S301` on the line of a move silences
it. Options that are not given are taken from irbkin.toml or pyproject.toml. Exit codes: 0 nothing
but notes, 1 errors, warnings, or no move checked, 2 wrong usage.

Examples:
  irbkin check backups/cell_3
  irbkin check "IRB 2600-12/1.65" program.mod --cell cell.toml
  irbkin check "IRB 2600-12/1.65" program.mod tools.sys --select R,C,N -o report.html
  irbkin check "IRB 2600-12/1.65" program.mod --tool tGun=0 0 180
"""

import argparse
import contextlib
import io
import json
import os
import re
import sys
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from irbkin import catalog_entry
from irbkin._arm_options import is_arm_file, robot_of
from irbkin.abb.folders import archive_of, backup_above
from irbkin.check import fixes
from irbkin.check.checker import Checker
from irbkin.check.fixes import Text
from irbkin.check.jobs import Job, backup_of, job_of_files, jobs_of_backup
from irbkin.check.report import ENDINGS, Report, counted, is_colored, rendered, report_of
from irbkin.check.report.text import diff
from irbkin.check.settings import FORMATS, option_files, schema, settings_of
from irbkin.cli.arguments import ROBOT_HELP, Parser, read_tools
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.files import STDIN, opened, replaced, shown
from irbkin.cli.numbers import number
from irbkin.cli.progress import Progress
from irbkin.cli.watch import repeated
from irbkin.errors import IrbkinError
from irbkin.rapid import ModuleFile, program

COUNTED = ("text", "concise", "json")


def add_arguments(parser: Parser) -> None:
    add = parser.add
    add("files", metavar="FILE", nargs="*", help="ROBOT but for a backup, then modules, folders, -")
    add_arm(parser)
    change = parser.add_mutually_exclusive_group()
    change.add_argument("--fix", action="store_true", help="correct confdata in the files")
    change.add_argument("--diff", action="store_true", help="show what --fix would write")
    change.add_argument("--watch", action="store_true", help="check again when a file changes")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--output-format", choices=FORMATS, help="text if not given")
    form.add_argument("--json", action="store_const", const="json", dest="output_format")
    add("-o", "--output-file", metavar="FILE", help="its format by its ending: .html, .sarif, ...")
    add("--color", choices=("auto", "always", "never"), default="auto", help="colors: auto")
    add("-q", "--quiet", action="store_true", help="write no summary")
    add("--verdict", action="store_true", help="the routines at a glance: nearest limits, ...")
    add("--statistics", action="store_true", help="count the findings of each code in their place")
    add("--schema", action="store_true", help="write the JSON schema of irbkin.toml")


def add_arm(parser: Parser) -> None:
    add = parser.add
    robot = os.environ.get("IRBKIN_ROBOT") or None
    add("-r", "--robot", metavar="ROBOT", default=robot, help=ROBOT_HELP)
    parser.add_frames(with_tool=False)
    bounds, words = ("LOWER", "UPPER"), "limits of an axis [deg]; may be repeated"
    add("--limits", nargs=3, type=number, action="append", metavar=("AXIS", *bounds), help=words)
    add("--linkage-limits", nargs=2, type=number, metavar=bounds, help="of q3 - q2 [deg]")
    parser.add_tools()
    add("--last-values", action="store_true", help="a PERS has its saved value, as in a backup")
    parser.add_cell()
    codes: Any = {"metavar": "CODES", "type": lambda text: text.split(",")}
    add("--select", help="codes or their beginnings, with commas; ALL for all", **codes)
    add("--ignore", help="those to leave out", **codes)
    strict = argparse.BooleanOptionalAction
    add("--strict", action=strict, help="moves that are not checked are errors")
    add("--step", type=float, metavar="MM", help="distance of samples on a line: 5")


def run(arguments: argparse.Namespace) -> int:
    if arguments.schema:
        print(json.dumps(schema(), indent=1))
        return FINE
    _take_robot(arguments)
    names: list[str] = arguments.files
    if not names:
        raise CommandError("no FILE to check (irbkin check --help)")
    if not arguments.watch:
        return _check(arguments)
    if STDIN in names:
        raise CommandError("--watch takes files, not stdin")
    roots = () if arguments.robot else map(backup_above, map(Path, names))
    beside = filter(None, (arguments.cell, arguments.robot, *roots, *option_files(names)))
    repeated(lambda: _check(arguments), [*names, *map(str, beside)], arguments.output_file)


def _take_robot(arguments: argparse.Namespace) -> None:
    """Take the robot from the first name, as other verbs do, if that is no file but an arm."""
    names = arguments.files
    is_given = arguments.robot not in (None, os.environ.get("IRBKIN_ROBOT"))
    endings = (*program.ENDINGS, program.LIST, STDIN)
    if is_given or not names or names[0].lower().endswith(endings):
        return
    # A station that is packed may have backups in it, which can be checked.
    if not is_arm_file(names[0]) or names[0].lower().endswith(".rspag"):
        if os.path.exists(names[0]) or archive_of(Path(names[0])):
            return
        try:
            catalog_entry(names[0])
        except IrbkinError as error:
            raise CommandError(f"{names[0]}: no such file or folder, and no arm: {error}") from None
    arguments.robot, *arguments.files = names


def _check(arguments: argparse.Namespace) -> int:
    names: list[str] = arguments.files
    settings = settings_of([name for name in names if name != STDIN])
    options = {**settings.options, **given(arguments)}
    form = _form(arguments, options)
    checker = Checker(options, settings)
    if (arguments.fix or arguments.diff) and STDIN in names:
        raise CommandError("--fix and --diff take files, not stdin")
    backup = None if "robot" in options or STDIN in names else backup_of(names)
    if backup is not None:
        if arguments.fix and not os.path.isdir(backup):
            raise CommandError(f"{backup}: is an archive: unpack it, --fix corrects its folder")
        jobs, left_open = jobs_of_backup(backup, names)
    else:
        with opened(STDIN) if STDIN in names else contextlib.nullcontext() as stream:
            own = ModuleFile("<stdin>", stream.read()) if stream else None
        files = [own if own and name == STDIN else name for name in names]
        robot = robot_of({**options, "tool": None}, complain)
        jobs, left_open = [job_of_files(robot, files, settings)], []
    if not any(job.program.files or job.program.findings for job in jobs):
        complain(f"{' and '.join(names)}: excluded by {settings.file}: nothing is checked")
    check_tools(checker.tools, jobs)
    texts: list[Text] = []
    fixed = Counter[str]()
    if arguments.fix or arguments.diff:
        jobs, texts, fixed = fixes.corrected(checker, jobs, complain)
    if arguments.diff:
        is_shown = is_colored(arguments.color, sys.stdout)
        for file, before, after in texts:
            _print(diff(shown(file.path), before, after, is_shown))
        if count := fixed.total():
            complain(f"--fix would remove {counted(count, 'finding')}")
        return FOUND if texts else FINE
    if form == "html" and len(jobs) > 1:
        titles = ", ".join(job.title for job in jobs)
        raise CommandError(f"a page shows one program, give the files of one of: {titles}")
    with Progress("programs", len(jobs)) as progress:
        report = report_of(checker, _each(jobs, progress), left_open)
    for job in jobs:
        if job.robot and job.robot.max_velocity is None and "V401" in checker.codes:
            name = job.robot.name
            complain(f"the speeds of the joints of {name} are unknown: V401 is not checked")
    report = replace(
        report, fixed=fixed, is_judged=arguments.verdict, is_counted=arguments.statistics
    )
    _write(report, form, arguments, texts)
    return FOUND if report.is_wrong else FINE


def check_tools(tools: Iterable[str | None], jobs: list[Job]) -> None:
    modules = [module for job in jobs for module in job.program.modules]
    for name in filter(None, tools):
        if any(it.name.lower() == name.lower() for own in modules for it in own.declarations):
            complain(f"--tool {name}: the program declares it, and its own value counts")
        elif not any(re.search(rf"\b{name}\b", it.source, re.IGNORECASE) for it in modules):
            complain(f"--tool {name}: no move uses it")


def _each(jobs: list[Job], progress: Progress) -> Iterator[Job]:
    for job in jobs:
        yield job
        progress.add(1)


def _form(arguments: argparse.Namespace, options: dict[str, Any]) -> str:
    form, output = arguments.output_format, arguments.output_file
    if output and not form:
        form = ENDINGS.get(os.path.splitext(output)[1].lower())
        if not form:
            words = f"must end in {', '.join(ENDINGS)}, or --output-format must be given"
            raise CommandError(f"--output-file: {output} {words}")
    if arguments.diff and (form or arguments.statistics or arguments.verdict):
        words = "leave out its format, -o, --statistics and --verdict"
        raise CommandError(f"--diff has no report: {words}")
    found: str = form or options.get("output_format", "text")
    if arguments.statistics and found not in COUNTED:
        raise CommandError(f"--statistics is written as {' or '.join(COUNTED)}, not as {found}")
    return found


def given(arguments: argparse.Namespace) -> dict[str, Any]:
    found = {name: value for name, value in vars(arguments).items() if value is not None}
    if arguments.tool:
        found["tool"] = read_tools(arguments.tool)
    return found


def _write(report: Report, form: str, arguments: argparse.Namespace, texts: list[Text]) -> None:
    output, is_quiet = arguments.output_file, arguments.quiet
    is_shown = arguments.color == "always" if output else is_colored(arguments.color, sys.stdout)
    text = rendered(replace(report, is_quiet=is_quiet, is_colored=is_shown), form)
    # A report that cannot be written leaves all files as they are.
    with replaced(output) if output else contextlib.nullcontext() as stream:
        for file, before, after in texts:
            fixes.write(file, before, after, complain)
        if stream:
            stream.write(text.encode("utf-8", "backslashreplace"))
            text = "" if is_quiet else f"{report.coverage}\n{report.conclusion}\n"
    _print(text)


def _print(text: str) -> None:
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")
    sys.stdout.write(text)
