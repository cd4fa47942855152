"""`irbkin check`: a linter of RAPID modules."""

from __future__ import annotations

import argparse
import os
import re
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from irbkin.cli.arguments import Parser, read_robot
from irbkin.cli.errors import FINE, FOUND, CommandError, complain
from irbkin.cli.findings import Found, report
from irbkin.cli.progress import Progress
from irbkin.cli.sources import Source, read_modules

if TYPE_CHECKING:
    from irbkin import Robot
    from irbkin.rapid import Diagnostic, Module

HELP = """Every MoveJ, MoveL, MoveC and MoveAbsJ of every routine is checked: reach, limits, flips,
confdata, singularities, joint speeds, zones, names (docs/check.md has the codes; --codes lists
them). The files are one program: names that a file does not declare are looked for in the others.
A comment `! noqa` on the line of a move, or `! noqa: C201,S301`, silences it. The robot may be
given by the environment, too: IRBKIN_ROBOT. --fix corrects confdata in place and changes nothing
else."""
EXAMPLES = """  irbkin check --robot "IRB 2600-12/1.65" program.mod
  irbkin check --robot "IRB 2600-12/1.65" --fix *.mod
  irbkin check --robot "IRB 2600-12/1.65" --select R,C,N --json program.mod tools.sys
  irbkin check --robot "IRB 2600-12/1.65" --ignore S,Z501 - < program.mod"""
UNCHECKED = ("U801", "U802")
"""Codes of what is not checked."""
NOQA = re.compile(r"!\s*noqa\b(?:\s*:\s*([A-Z0-9, ]+))?", re.IGNORECASE)
PASSES = 10
"""How often corrections are looked for after corrections."""


def add_arguments(parser: Parser) -> None:
    """The arguments of the verb."""
    add = parser.add
    add("files", metavar="FILE", nargs="*", help="RAPID modules (.mod, .sys, .prg), - for stdin")
    robot = os.environ.get("IRBKIN_ROBOT") or None
    add("--robot", metavar="ROBOT", default=robot, help="name in the catalog, or a .urdf file")
    parser.add_frames()
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
    sources = [Source.read(name) for name in arguments.files]
    if arguments.fix and any(source.is_stdin for source in sources):
        raise CommandError("--fix corrects files, stdin is none")
    checker = Checker(robot, codes, arguments.step / 1e3)
    fixed = unchecked = 0
    with Progress("files", len(sources)) as progress:
        found = read_modules(sources)
        for source in sources:
            if arguments.fix:
                fixed += checker.fix(source)
            found += checker.check(source)
            unchecked += checker.unchecked
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
    return wanted - meant(ignore)


class Checker:
    """Checks and corrects sources."""

    def __init__(self, robot: Robot, codes: Collection[str], step: float) -> None:
        self.robot, self.codes, self.step = robot, codes, step
        self.unchecked = 0
        """How many places could not be checked, and are not reported."""

    def diagnostics(self, module: Module) -> list[Diagnostic]:
        """What is wrong with a module, without what its comments silence."""
        from irbkin._core import check

        found = check(self.robot, module, codes={*self.codes, *UNCHECKED}, step=self.step)
        if "noqa" in module.source.lower():
            lines = module.source.split("\n")
            found = tuple(it for it in found if not _is_silenced(lines[it.line - 1], it.code))
        wanted = [it for it in found if it.code in self.codes]
        self.unchecked = len({(it.line, it.column) for it in found if it.code not in self.codes})
        return wanted

    def check(self, source: Source) -> list[Found]:
        """What is wrong with a source."""
        if source.module is None:
            return []
        return [
            Found(source.shown, it.line, it.column, it.code, it.name, it.message, it.edits)
            for it in self.diagnostics(source.module)
        ]

    def fix(self, source: Source) -> int:
        """Correct a source in place; how many findings that removes.

        Corrections are applied until there are none, as one may show another. They are dropped
        where something else would be wrong with them.
        """
        from irbkin._core import parse

        if source.module is None:
            return 0
        before = self.diagnostics(source.module)
        module, found = source.module, before
        for _ in range(PASSES):
            edits = sorted({edit for it in found for edit in it.edits})
            if not edits:
                break
            text = edited(module.source, edits)
            module = parse(text, source.context)
            found = self.diagnostics(module)
        places = {(it.line, it.code) for it in before}
        is_worse = any((it.line, it.code) not in places for it in found)
        if module is source.module or is_worse or len(found) >= len(before):
            return 0
        source.write(module)
        return len(before) - len(found)


def edited(source: str, edits: Sequence[tuple[int, int, str]]) -> str:
    """A text with edits in the order of its bytes."""
    content, parts, copied = source.encode(), [], 0
    for begin, end, text in edits:
        parts += [content[copied:begin], text.encode()]
        copied = end
    return b"".join([*parts, content[copied:]]).decode()


def _is_silenced(line: str, code: str) -> bool:
    match = NOQA.search(line)
    if match is None:
        return False
    codes = match[1]
    return codes is None or any(
        code.startswith(it.strip().upper()) for it in codes.split(",") if it.strip()
    )
