"""`irbkin check`: a linter of RAPID modules."""

from __future__ import annotations

import argparse
import os
from collections.abc import Collection, Sequence

from irbkin.cli.arguments import Parser, read_cell, read_robot
from irbkin.cli.checker import Checker, fix
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.findings import report
from irbkin.cli.progress import Progress
from irbkin.cli.sources import Source, expanded, read_modules

HELP = """Every MoveJ, MoveL, MoveC and MoveAbsJ of every routine is checked: reach, limits, flips,
confdata, singularities, joint speeds, zones, names and, with --cell, collisions (--codes lists the
codes, docs/guide/check.md explains them). The files are one program: names that a file does not
declare are looked for in the others. A comment `! noqa` on the line of a move, or
`! noqa: C201,S301`, silences it. The robot may be given by the environment, too: IRBKIN_ROBOT.
--fix corrects confdata in place and changes nothing else."""
EXAMPLES = """  irbkin check --robot "IRB 2600-12/1.65" program.mod
  irbkin check --robot "IRB 2600-12/1.65" --cell cell.toml program.mod
  irbkin check --robot "IRB 2600-12/1.65" --fix programs/
  irbkin check --robot "IRB 2600-12/1.65" --select R,C,N --json program.mod tools.sys
  irbkin check --robot "IRB 2600-12/1.65" --ignore S,Z501 - < program.mod"""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add = parser.add
    add("files", metavar="FILE", nargs="*", help="RAPID modules, folders of them, - for stdin")
    robot = os.environ.get("IRBKIN_ROBOT") or None
    add("--robot", metavar="ROBOT", default=robot, help="name in the catalog, or a .urdf file")
    parser.add_frames()
    parser.add_cell()
    add("--select", metavar="CODES", help="codes or their beginnings, with commas; ALL for all")
    add("--ignore", metavar="CODES", default="", help="codes or their beginnings to leave out")
    add("--fix", action="store_true", help="correct confdata in the files")
    add("--json", action="store_true", help="write JSON")
    add("-q", "--quiet", action="store_true", help="write no summary")
    add("--step", type=float, default=5.0, metavar="MM", help="distance of samples on a line: 5")
    add("--codes", action="store_true", help="list the codes")


def run(arguments: argparse.Namespace) -> int:
    """Run the verb."""
    from irbkin._core import check_codes

    known = check_codes()
    if arguments.codes:
        for code, name, is_default in known:
            print(f"{code}  {name:22}{'' if is_default else '(only if selected)'}".rstrip())
        return FINE
    codes = selected(arguments.select, arguments.ignore, known)
    if not arguments.files:
        raise CommandError("no FILE to check (irbkin check --help)")
    if arguments.robot is None:
        raise CommandError('no robot: give --robot NAME, such as --robot "IRB 2600-12/1.65"')
    if not 0.0 < arguments.step < float("inf"):
        raise CommandError(f"--step must be positive and finite [mm], got {arguments.step}")
    robot = read_robot(arguments)
    sources = [Source.read(name) for name in expanded(arguments.files)]
    if arguments.fix and any(source.is_stdin for source in sources):
        raise CommandError("--fix corrects files, stdin is none")
    broken = read_modules(sources)
    checker = Checker(robot, codes, arguments.step / 1e3, read_cell(arguments))
    fixed = fix(checker, sources) if arguments.fix else 0
    found, unchecked = list(broken), 0
    with Progress("files", len(sources)) as progress:
        for source in sources:
            own, count = checker.found(source)
            found += own
            unchecked += count
            progress.add(1)
    if robot.max_velocity is None and "V401" in codes:
        complain(f"the speeds of the joints of {robot.name} are unknown: V401 is not checked")
    report(found, fixed, unchecked, as_json=arguments.json, is_quiet=arguments.quiet)
    return FOUND if found else FINE


def selected(
    select: str | None, ignore: str, known: Sequence[tuple[str, str, bool]]
) -> Collection[str]:
    """The codes that are wanted."""
    codes = [code for code, _, _ in known]
    names = {name: code for code, name, _ in known}

    def meant(words: str) -> set[str]:
        found = set()
        for word in filter(None, (part.strip() for part in words.split(","))):
            begin = names.get(word.lower(), word.upper())
            these = codes if begin == "ALL" else [it for it in codes if it.startswith(begin)]
            if not these:
                import difflib

                close = difflib.get_close_matches(word.upper(), codes, 3) or sorted(
                    {code[0] for code in codes}
                )
                raise CommandError(
                    f"unknown code {word!r}: did you mean {', '.join(close)}? (--codes)"
                )
            found.update(these)
        return found

    wanted = {code for code, _, is_default in known if is_default}
    if select is not None:
        wanted = meant(select)
    wanted -= meant(ignore)
    if not wanted:
        raise CommandError(
            "--select and --ignore leave no code to check: select codes or their beginnings, or "
            "ALL (--codes lists them)"
        )
    return wanted
