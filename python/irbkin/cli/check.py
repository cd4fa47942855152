"""`irbkin check`: a linter of RAPID modules."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, read_cell, read_robot
from irbkin.cli.codes import meant, selected
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.files import STDIN, shown
from irbkin.cli.findings import Found, coverage
from irbkin.cli.jobs import Job, is_backup, job_of_files, jobs_of_backup
from irbkin.cli.numbers import number
from irbkin.cli.report import ENDINGS, FORMATS, Report, is_colored, rendered
from irbkin.cli.report.source_text import SourceText
from irbkin.cli.settings import Settings, settings_of
from irbkin.cli.sources import checksum_of, write

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.cli.checker import Checker

HELP = """Every instruction that moves, of every routine, is checked: reach, limits, flips,
confdata, singularities, joint speeds, zones, names and, with --cell, collisions (--codes lists the
codes, `irbkin rule CODE` explains one). Calls are followed with their arguments. The files are one
program: names that a file does not declare are looked for in the others. A backup of a controller
needs no --robot: each task is checked with its own, its limits and its base. A comment `! noqa` on
the line of a move, or `! noqa: C201,S301`, silences it. Options that are not given are taken from
irbkin.toml or pyproject.toml, the robot from IRBKIN_ROBOT, too. --fix corrects confdata in place
and changes nothing else. Exit codes: 0 nothing but notes, 1 errors or warnings, 2 wrong usage."""
EXAMPLES = """  irbkin check backups/cell_3
  irbkin check --robot "IRB 2600-12/1.65" program.mod
  irbkin check --robot "IRB 2600-12/1.65" --cell cell.toml program.mod
  irbkin check --robot "IRB 2600-12/1.65" --diff programs/
  irbkin check --robot "IRB 2600-12/1.65" --limits 6 -360 360 --strict programs/
  irbkin check --robot "IRB 2600-12/1.65" --select R,C,N -o report.html program.mod tools.sys
  irbkin check --robot "IRB 2600-12/1.65" --ignore S,Z501 - < program.mod"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add = parser.add
    add("files", metavar="FILE", nargs="*", help="modules, folders, a backup, - for stdin")
    add_arm(parser)
    change = parser.parser.add_mutually_exclusive_group()
    change.add_argument("--fix", action="store_true", help="correct confdata in the files")
    change.add_argument("--diff", action="store_true", help="show what --fix would write")
    form = parser.parser.add_mutually_exclusive_group()
    form.add_argument("--output-format", choices=FORMATS, help="text if not given")
    form.add_argument("--json", action="store_const", const="json", dest="output_format")
    words = "write the report to a file, its format by its ending: .json, .sarif, .html, .txt"
    add("-o", "--output-file", metavar="FILE", help=words)
    add("--color", choices=("auto", "always", "never"), default="auto", help="colors: auto")
    add("-q", "--quiet", action="store_true", help="write no summary")
    words = "the routines at a glance: nearest limits, singularities, unused names"
    add("--verdict", action="store_true", help=words)
    add_step(parser)
    add("--codes", action="store_true", help="list the codes")


def add_step(parser: Parser) -> None:
    """The distance of samples."""
    parser.add("--step", type=float, metavar="MM", help="distance of samples on a line: 5")


def add_arm(parser: Parser) -> None:
    """The arm, and the codes that are wanted."""
    add = parser.add
    robot = os.environ.get("IRBKIN_ROBOT") or None
    add("--robot", metavar="ROBOT", default=robot, help="name in the catalog, or a .urdf file")
    parser.add_frames()
    add(
        "--limits",
        nargs=3,
        type=number,
        action="append",
        metavar=("AXIS", "LOWER", "UPPER"),
        help="limits of an axis [deg]; may be repeated",
    )
    add(
        "--linkage-limits",
        nargs=2,
        type=number,
        metavar=("LOWER", "UPPER"),
        help="limits of q3 - q2 of an arm with a parallelogram linkage [deg]",
    )
    words = "a PERS that the program assigns has the value in its text"
    add("--last-values", action="store_true", help=words)
    parser.add_cell()
    words = "codes or their beginnings, with commas; ALL for all"
    add("--select", metavar="CODES", type=_words, help=words)
    words = "codes or their beginnings to leave out"
    add("--ignore", metavar="CODES", type=_words, help=words)
    strict = argparse.BooleanOptionalAction
    add("--strict", action=strict, help="moves that are not checked are errors")


def _words(text: str) -> list[str]:
    return text.split(",")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    if arguments.codes:
        from irbkin.cli.rule import listed

        print(listed(), end="")
        return FINE
    if not arguments.files:
        raise CommandError("no FILE to check (irbkin check --help)")
    form = _format(arguments)
    settings = settings_of(arguments.files)
    settings.fill(arguments)
    form = form or arguments.output_format or "text"
    checker = checker_of(arguments)
    jobs, left_open = _jobs(arguments, settings)
    checker.ignored = ignored_of((it.path for job in jobs for it in job.program.files), settings)
    if arguments.diff:
        return _diff(checker, jobs, arguments.color)
    fixed = _fix(checker, jobs) if arguments.fix else Counter()
    is_judged = arguments.verdict or form == "html"
    report = _report(checker, jobs, fixed, left_open, is_judged=is_judged)
    report = replace(report, is_quiet=arguments.quiet)
    if form == "html" and len(jobs) == 1:
        from irbkin.cli.report.places import places_of

        (job,) = jobs
        names = (shown(file.path) for file in job.program.files)
        modules = dict(zip(names, job.program.modules, strict=True))
        report = replace(report, places=places_of(job.robot, modules, report.found))
    for job in jobs:
        if job.robot.max_velocity is None and "V401" in checker.codes:
            name = job.robot.name
            complain(f"the speeds of the joints of {name} are unknown: V401 is not checked")
    _write(report, form, arguments)
    return FOUND if any(it.severity != "note" for it in report.found) else FINE


def checker_of(arguments: argparse.Namespace) -> Checker:
    """Return the checker of the arguments."""
    from irbkin.cli.checker import Checker

    is_strict = bool(arguments.strict)
    codes = selected(arguments.select, arguments.ignore or (), is_strict=is_strict)
    step = 5.0 if arguments.step is None else arguments.step
    if not 0.0 < step < float("inf"):
        raise CommandError(f"--step must be positive and finite [mm], got {step}")
    cell, takes_last = read_cell(arguments), arguments.last_values
    return Checker(codes, step / 1e3, cell, is_strict=is_strict, takes_last=takes_last)


def _jobs(arguments: argparse.Namespace, settings: Settings) -> tuple[list[Job], list[Found]]:
    """The programs of the arguments, and what a backup leaves open."""
    names = arguments.files
    if (arguments.fix or arguments.diff) and STDIN in names:
        raise CommandError("--fix and --diff take files, not stdin")
    if arguments.robot is None and len(names) == 1 and is_backup(names[0]):
        if arguments.fix and not os.path.isdir(names[0]):
            raise CommandError(f"{names[0]}: is an archive: unpack it, --fix corrects its folder")
        jobs, left_open = jobs_of_backup(names[0])
        if not jobs:
            reasons = "; ".join(it.message for it in left_open[:3])
            raise CommandError(f"{names[0]}: has no task whose robot is known: {reasons}")
        return jobs, left_open
    return [job_of_files(robot_of(arguments), names, settings)], []


def ignored_of(paths: Iterable[str], settings: Settings) -> dict[str, set[str]]:
    """Return the codes that are not wanted of files."""
    ignores = {
        pattern: meant(words)
        for pattern, words in settings.options.get("per_file_ignores", {}).items()
    }
    ignored: dict[str, set[str]] = {}
    for path in paths if ignores else ():
        patterns = (it for it in ignores if settings.matches(path, [it]))
        ignored[path] = set().union(*(ignores[it] for it in patterns))
    return ignored


def _format(arguments: argparse.Namespace) -> str | None:
    """The format that is given, by the ending of the file too."""
    form: str | None = arguments.output_format
    if form is None and arguments.output_file is not None:
        ending = os.path.splitext(arguments.output_file)[1].lower()
        if ending not in ENDINGS:
            raise CommandError(
                f"--output-file: {arguments.output_file} must end in {', '.join(ENDINGS)}, or "
                "--output-format must be given"
            )
        form = ENDINGS[ending]
    return form


def robot_of(arguments: argparse.Namespace) -> Robot:
    """Return the robot of the arguments, with its limits."""
    import math

    if arguments.robot is None:
        raise CommandError('no robot: give --robot NAME, such as --robot "IRB 2600-12/1.65"')
    robot = read_robot(arguments)
    if arguments.limits:
        limits = robot.limits.copy()
        for axis, *bounds in arguments.limits:
            if axis not in range(1, robot.dof + 1):
                raise CommandError(
                    f"--limits: axis {axis:g} must be a whole number from 1 to {robot.dof}"
                )
            limits[int(axis) - 1] = [math.radians(it) for it in bounds]
        robot = robot.with_limits(limits)
    if arguments.linkage_limits is not None:
        bounds = [math.radians(it) for it in arguments.linkage_limits]
        robot = robot.with_linkage_limits(bounds)
    return robot


def _report(
    checker: Checker,
    jobs: Sequence[Job],
    fixed: Counter[str],
    left_open: Sequence[Found],
    *,
    is_judged: bool,
) -> Report:
    """The report on programs."""
    from irbkin.cli.progress import Progress
    from irbkin.cli.verdict import UNUSED, verdict_of

    if is_judged:
        checker.asked.add(UNUSED)

    found = [it for it in left_open if it.code in checker.codes]
    texts, programs = {}, []
    with Progress("programs", len(jobs)) as progress:
        for job in jobs:
            checked = checker.checked(job)
            kept = (it for it in job.found if it.code in checker.codes)
            found += (it for it in kept if it.code not in checker.ignored.get(it.file, ()))
            found += checker.found(job, checked)
            programs.append((job, checked))
            for file, module in zip(job.program.files, job.program.modules, strict=True):
                texts[shown(file.path)] = SourceText(module.source)
            progress.add(1)
    title = ", ".join(job.title for job in jobs)
    # Shared modules are in several programs.
    found = list(dict.fromkeys(found))
    whole = coverage((checked, job.unread) for job, checked in programs)
    verdict = verdict_of(programs, found) if is_judged else None
    return Report(found, texts, whole, fixed, title, verdict=verdict)


def _fix(checker: Checker, jobs: Sequence[Job]) -> Counter[str]:
    """Write the corrections of programs; count the findings that they remove."""
    from irbkin.cli.checker import correction

    fixed: Counter[str] = Counter()
    for job in jobs:
        corrected = correction(checker, job)
        for file, before, after in corrected.texts:
            write(file, before, after)
            if hashes := checksum_of(file.path):
                complain(f"{file.path}: is changed, its hash in {hashes} no longer agrees with it")
        fixed += corrected.fixed
        job.program = corrected.program
    return fixed


def _diff(checker: Checker, jobs: Sequence[Job], color: str) -> int:
    """Print the corrections of programs."""
    from irbkin.cli.checker import correction
    from irbkin.cli.report.diff import render

    is_shown = is_colored(color, sys.stdout)
    fixed: Counter[str] = Counter()
    for job in jobs:
        corrected = correction(checker, job)
        for file, before, after in corrected.texts:
            _print(render(shown(file.path), before, after, is_shown))
        fixed += corrected.fixed
    count = fixed.total()
    if count:
        complain(f"--fix would remove {count} {'finding' if count == 1 else 'findings'}")
    return FOUND if count else FINE


def _write(report: Report, form: str, arguments: argparse.Namespace) -> None:
    """Write the report to stdout, or to a file with its first and last sentence on stdout."""
    if arguments.output_file is None:
        is_shown = is_colored(arguments.color, sys.stdout)
        _print(rendered(replace(report, is_colored=is_shown), form))
        return
    from irbkin.cli.files import replaced

    is_shown = arguments.color == "always"
    text = rendered(replace(report, is_colored=is_shown), form)
    with replaced(arguments.output_file) as file:
        file.write(text.encode("utf-8", "backslashreplace"))
    if not report.is_quiet:
        _print(f"{report.coverage.text()}\n{report.conclusion}\n")


def _print(text: str) -> None:
    """Print text, with escapes for characters that stdout cannot write."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")
    sys.stdout.write(text)
