"""Sources of RAPID checked and corrected."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

from irbkin.cli.errors import complain
from irbkin.cli.findings import Found
from irbkin.cli.sources import Source

if TYPE_CHECKING:
    from irbkin import Cell, Robot
    from irbkin.rapid import Finding, Module

UNCHECKED = ("U801", "U802")
"""Codes of what is not checked."""
NOQA = re.compile(r"!\s*noqa\b(?:\s*:\s*([A-Z0-9, ]+))?", re.IGNORECASE)
PASSES = 10
"""How often corrections are looked for after corrections."""


class Checker:
    """Checks modules of one arm."""

    def __init__(
        self, robot: Robot, codes: Collection[str], step: float, cell: Cell | None = None
    ) -> None:
        from irbkin._core import check_codes

        self.robot, self.codes, self.step, self.cell = robot, codes, step, cell
        faults = (code for code, _, is_default in check_codes() if is_default)
        self.asked = {*faults, *UNCHECKED, *codes}

    def diagnostics(self, module: Module) -> list[Finding]:
        """Return the findings on a module that its comments do not silence."""
        from irbkin._core import check

        found = check(self.robot, module, codes=self.asked, step=self.step, cell=self.cell)
        if "noqa" not in module.source.lower():
            return list(found)
        lines = module.source.split("\n")
        return [it for it in found if not _is_silenced(lines[it.line - 1], it.code)]

    def wanted(self, module: Module) -> list[Finding]:
        """Return the findings of the wanted codes."""
        return [it for it in self.diagnostics(module) if it.code in self.codes]

    def found(self, source: Source) -> tuple[list[Found], int]:
        """Return the findings on a source, and how many places could not be checked."""
        if source.module is None:
            return [], 0
        found, unchecked = [], set()
        for it in self.diagnostics(source.module):
            if it.code in self.codes:
                place = (source.shown, it.line, it.column)
                found.append(Found(*place, it.code, it.name, it.message, it.edits))
            elif it.code in UNCHECKED:
                unchecked.add((it.line, it.column))
        return found, len(unchecked)


def fix(checker: Checker, sources: Sequence[Source]) -> int:
    """Correct sources in place; how many findings that removes.

    A source stays as it is if something else would be wrong with its corrections, or if another one
    moves to a target that they change.
    """
    fixed = 0
    for source in sources:
        corrected = _corrected(checker, source)
        if source.module is None or corrected is None:
            continue
        before, after = (_places(checker, it) for it in (source.module, corrected))
        if worse := sorted(after - before):
            line, code = worse[0]
            complain(f"{source.shown}: is not corrected, line {line} would have {code}")
            continue
        users = (it for it in sources if it is not source and _uses(checker, it, source, corrected))
        if user := next(users, None):
            complain(f"{source.shown}: is not corrected, {user.shown} moves to a target of it")
            continue
        fixed += len(checker.wanted(source.module)) - len(checker.wanted(corrected))
        source.write(corrected)
    return fixed


def _places(checker: Checker, module: Module) -> set[tuple[int, str]]:
    """Lines and codes of what is wrong with a module; what is undecided is not."""
    found = checker.diagnostics(module)
    return {(it.line, it.code) for it in found if not it.code.startswith("U")}


def _corrected(checker: Checker, source: Source) -> Module | None:
    """The module of a source with corrections; corrections may show another one to make."""
    from irbkin._core import parse_module

    if source.module is None:
        return None
    module = source.module
    for _ in range(PASSES):
        edits = sorted({edit for it in checker.wanted(module) for edit in it.edits})
        if not edits:
            break
        module = parse_module(edited(module.source, edits), source.context)
    return None if module is source.module else module


def _uses(checker: Checker, other: Source, source: Source, corrected: Module) -> bool:
    """Whether moves of another source go elsewhere with the corrections of a source."""
    import numpy as np

    from irbkin._core import calc_moves, parse_module

    if other.module is None:
        return False
    context = [corrected if it is source.alone else it for it in other.context]
    before, after = (
        calc_moves(checker.robot, module).q
        for module in (other.module, parse_module(other.content, context))
    )
    return not np.array_equal(before, after, equal_nan=True)


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
