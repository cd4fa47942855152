"""`irbkin check`: a linter of RAPID modules."""

from __future__ import annotations

import argparse
import io
import os
import sys
from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, read_cell, read_robot
from irbkin.cli.codes import meant, selected
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.findings import coverage
from irbkin.cli.numbers import number
from irbkin.cli.report import ENDINGS, FORMATS, Report, is_colored, rendered
from irbkin.cli.report.source_text import SourceText
from irbkin.cli.settings import Settings, settings_of
from irbkin.cli.sources import Source, checksum_of, expanded, read_modules

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.cli.checker import Checker

HELP = """Every MoveJ, MoveL, MoveC and MoveAbsJ of every routine is checked: reach, limits, flips,
confdata, singularities, joint speeds, zones, names and, with --cell, collisions (--codes lists the
codes, `irbkin rule CODE` explains one). The files are one program: names that a file does not
declare are looked for in the others. A comment `! noqa` on the line of a move, or
`! noqa: C201,S301`, silences it. Options that are not given are taken from irbkin.toml or
pyproject.toml, the robot from IRBKIN_ROBOT, too. --fix corrects confdata in place and changes
nothing else. Exit codes: 0 nothing but notes, 1 errors or warnings, 2 wrong usage."""
EXAMPLES = """  irbkin check --robot "IRB 2600-12/1.65" program.mod
  irbkin check --robot "IRB 2600-12/1.65" --cell cell.toml program.mod
  irbkin check --robot "IRB 2600-12/1.65" --diff programs/
  irbkin check --robot "IRB 2600-12/1.65" --limits 6 -360 360 --strict programs/
  irbkin check --robot "IRB 2600-12/1.65" --select R,C,N -o report.html program.mod tools.sys
  irbkin check --robot "IRB 2600-12/1.65" --ignore S,Z501 - < program.mod"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add = parser.add
    add("files", metavar="FILE", nargs="*", help="RAPID modules, folders of them, - for stdin")
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
    parser.add_cell()
    words = "codes or their beginnings, with commas; ALL for all"
    add("--select", metavar="CODES", type=_words, help=words)
    words = "codes or their beginnings to leave out"
    add("--ignore", metavar="CODES", type=_words, help=words)
    strict = argparse.BooleanOptionalAction
    add("--strict", action=strict, help="moves that are not checked are errors")
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
    add("--step", type=float, metavar="MM", help="distance of samples on a line: 5")
    add("--codes", action="store_true", help="list the codes")


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
    codes = selected(arguments.select, arguments.ignore or (), is_strict=bool(arguments.strict))
    robot = _robot(arguments)
    step = 5.0 if arguments.step is None else arguments.step
    if not 0.0 < step < float("inf"):
        raise CommandError(f"--step must be positive and finite [mm], got {step}")
    sources = _sources(arguments, settings)
    from irbkin.cli.checker import Checker

    broken = read_modules(sources)
    cell = read_cell(arguments)
    checker = Checker(robot, codes, step / 1e3, cell, is_strict=bool(arguments.strict))
    if arguments.diff:
        return _diff(checker, sources, arguments.color)
    fixed = _fix(checker, sources) if arguments.fix else Counter()
    report = _checked(checker, sources, fixed)
    kept = {it.shown: codes - set(it.ignored) for it in sources}
    found = [*(it for it in broken if it.code in kept[it.file]), *report.found]
    report = replace(report, found=found, is_quiet=arguments.quiet)
    if form == "html":
        from irbkin.cli.report.places import places_of

        modules = {it.shown: it.module for it in sources if it.module is not None}
        report = replace(report, places=places_of(robot, modules, found))
    if robot.max_velocity is None and "V401" in codes:
        complain(f"the speeds of the joints of {robot.name} are unknown: V401 is not checked")
    _write(report, form, arguments)
    return FOUND if any(it.severity != "note" for it in found) else FINE


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


def _robot(arguments: argparse.Namespace) -> Robot:
    """The robot of the arguments, with its limits."""
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


def _sources(arguments: argparse.Namespace, settings: Settings) -> list[Source]:
    """The files that are not excluded, with the codes that are not wanted of them."""
    excluded = settings.options.get("exclude", ())
    ignores = {
        pattern: meant(words)
        for pattern, words in settings.options.get("per_file_ignores", {}).items()
    }
    sources = []
    for name in expanded(arguments.files):
        source = Source.read(name) if not settings.matches(name, excluded) else None
        if source is None:
            continue
        patterns = (it for it in ignores if not source.is_stdin and settings.matches(name, [it]))
        source.ignored = set().union(*(ignores[it] for it in patterns))
        sources.append(source)
    if (arguments.fix or arguments.diff) and any(source.is_stdin for source in sources):
        raise CommandError("--fix and --diff take files, not stdin")
    return sources


def _checked(checker: Checker, sources: Sequence[Source], fixed: Counter[str]) -> Report:
    """The report on sources that are read."""
    from irbkin.cli.progress import Progress

    found, checked = [], []
    with Progress("files", len(sources)) as progress:
        for source in sources:
            findings = () if source.module is None else checker.findings(source.module)
            found += checker.found(source, findings)
            checked.append((source.module, findings))
            progress.add(1)
    texts = {source.shown: SourceText(source.text) for source in sources}
    return Report(found, texts, coverage(checked), fixed, checker.robot.name)


def _fix(checker: Checker, sources: Sequence[Source]) -> Counter[str]:
    """Write the corrections of sources; count the findings that they remove."""
    from irbkin.cli.checker import corrections

    fixed: Counter[str] = Counter()
    for source, module, removed in corrections(checker, sources):
        source.write(module)
        fixed += removed
        if file := checksum_of(source.name):
            complain(f"{source.shown}: is changed, its hash in {file} no longer agrees with it")
    return fixed


def _diff(checker: Checker, sources: Sequence[Source], color: str) -> int:
    """Print the corrections of sources."""
    from irbkin.cli.checker import corrections
    from irbkin.cli.report.diff import render

    is_shown = is_colored(color, sys.stdout)
    fixed: Counter[str] = Counter()
    for source, module, removed in corrections(checker, sources):
        _print(render(source.shown, source.text, module.source, is_shown))
        fixed += removed
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
