"""Sources of RAPID checked and corrected."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from irbkin.cli.codes import NOT_CHECKED
from irbkin.cli.errors import complain
from irbkin.cli.findings import REASONS, Found
from irbkin.cli.sources import Source

if TYPE_CHECKING:
    from irbkin import Cell, Robot
    from irbkin.rapid import Finding, Module

NOQA = re.compile(r"!\s*noqa\b(?:\s*:\s*([A-Z0-9, ]+))?", re.IGNORECASE)
PASSES = 10
"""How often corrections are looked for after corrections."""


class Checker:
    """Checks modules of one arm."""

    def __init__(
        self,
        robot: Robot,
        codes: Collection[str],
        step: float,
        cell: Cell | None = None,
        *,
        is_strict: bool = False,
    ) -> None:
        from irbkin._core import check_codes

        self.robot, self.codes, self.step, self.cell = robot, codes, step, cell
        self.is_strict = is_strict
        known = {code: is_default for code, _, _, is_default in check_codes()}
        self.asked = {it for it in known if known[it] or it in REASONS or it in codes}

    def findings(self, module: Module) -> tuple[Finding, ...]:
        """Return every finding on a module, of codes that are not wanted too."""
        from irbkin._core import check

        return check(self.robot, module, codes=self.asked, step=self.step, cell=self.cell)

    def wanted(self, source: Source, module: Module) -> list[Finding]:
        """Return the findings on a text of a source that are wanted."""
        codes = set(self.codes) - set(source.ignored)
        return [it for it in audible(self.findings(module), module) if it.code in codes]

    def found(self, source: Source, findings: Sequence[Finding]) -> list[Found]:
        """Return the wanted ones of the findings on a source."""
        if source.module is None:
            return []
        codes = set(self.codes) - set(source.ignored)
        kept = (it for it in audible(findings, source.module) if it.code in codes)
        return [self._found(source.shown, it) for it in kept]

    def _found(self, file: str, it: Finding) -> Found:
        is_error = self.is_strict and it.code in NOT_CHECKED
        severity = "error" if is_error else it.severity
        words = (it.code, it.name, severity, it.message, it.edits)
        return Found(file, it.line, it.column, *words, it.routine, it.joint, it.value, it.bound)


def audible(findings: Sequence[Finding], module: Module) -> list[Finding]:
    """Return the findings that the comments of a module do not silence."""
    if "noqa" not in module.source.lower():
        return list(findings)
    lines = module.source.split("\n")
    return [it for it in findings if not _is_silenced(lines[it.line - 1], it.code)]


class Correction(NamedTuple):
    """A source with the module that takes its place."""

    source: Source
    module: Module
    fixed: Counter[str]
    """Number of findings that it removes, by severity."""


def corrections(checker: Checker, sources: Sequence[Source]) -> Iterator[Correction]:
    """Yield the corrections of sources, each before the next is looked for.

    A source stays as it is if something else would be wrong with its corrections, or if another one
    moves to a target that they change.
    """
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
        old, new = (_severities(checker.wanted(source, it)) for it in (source.module, corrected))
        yield Correction(source, corrected, old - new)


def _severities(findings: Sequence[Finding]) -> Counter[str]:
    return Counter(it.severity for it in findings)


def _places(checker: Checker, module: Module) -> set[tuple[int, str]]:
    """Lines and codes of what is wrong with a module; what is undecided is not."""
    found = audible(checker.findings(module), module)
    return {(it.line, it.code) for it in found if not it.code.startswith("U")}


def _corrected(checker: Checker, source: Source) -> Module | None:
    """The module of a source with corrections; corrections may show another one to make."""
    from irbkin._core import parse_module

    if source.module is None:
        return None
    module = source.module
    for _ in range(PASSES):
        edits = sorted({edit for it in checker.wanted(source, module) for edit in it.edits})
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
