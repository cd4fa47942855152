"""Findings in files, the moves that were checked, and the words for both."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from irbkin.cli.codes import LEVELS

if TYPE_CHECKING:
    from irbkin.rapid import Finding, Module

REASONS = {
    "U801": "unknown values",
    "U802": "instructions that are not followed",
    "N601": "unknown targets",
    "N602": "unknown tools",
    "N603": "unknown work objects",
    "D701": "invalid frames",
}
"""Why a move is not checked, by the code of the finding on it."""
MOVING = "moves the robot"
"""Words of the finding on an instruction that is a move itself, but is not read."""


class Related(NamedTuple):
    """A place that belongs to a finding, and the words for it."""

    file: str
    line: int
    column: int
    message: str


class Found(NamedTuple):
    """Something wrong at a place of a file."""

    file: str
    line: int
    column: int
    code: str
    name: str
    severity: str
    message: str
    edits: tuple[tuple[int, int, str], ...] = ()
    routine: str | None = None
    joint: int | None = None
    value: float | None = None
    bound: float | None = None
    related: tuple[Related, ...] = ()

    @property
    def place(self) -> str:
        """File, line and column."""
        return f"{self.file}:{self.line}:{self.column}"

    def text(self) -> str:
        """A line as linters print it."""
        fixable = "[*] " if self.edits else ""
        return f"{self.place}: {self.code} {fixable}{self.message}"

    def span(self, line: str) -> tuple[int, int]:
        """The part of its line that it is about: first and last column, from 0, the last not in.

        A statement without its semicolon; of a text that is broken, one character.
        """
        begin = min(self.column - 1, len(line))
        if self.code.startswith("E"):
            return begin, begin + 1
        statement = line[begin:].partition(";")[0].partition("!")[0].rstrip()
        return begin, begin + max(len(statement), 1)


class Coverage(NamedTuple):
    """How many moves were checked, why others were not, and how many files were not read."""

    checked: int
    reasons: Mapping[str, int]
    unread: int = 0

    @property
    def unchecked(self) -> int:
        """Number of moves that were not checked."""
        return sum(self.reasons.values())

    @property
    def is_whole(self) -> bool:
        """Whether there were moves, and all of them were checked."""
        return self.checked > 0 and not self.unchecked and not self.unread

    def text(self) -> str:
        """A sentence."""
        total = self.checked + self.unchecked
        words = f"{self.checked} of {total} {'move' if total == 1 else 'moves'} checked"
        if self.unchecked:
            parts = [f"{count} by {reason}" for reason, count in self.reasons.items()]
            words += f", {self.unchecked} not: {', '.join(parts)}"
        if self.unread:
            words += f"; {_counted(self.unread, 'file')} not read"
        return f"{words}."


def coverage(checked: Iterable[tuple[Module | None, Sequence[Finding]]]) -> Coverage:
    """Return what was checked of modules with their findings, the silenced ones included."""
    moves, unread = 0, 0
    reasons: Counter[str] = Counter()
    for module, findings in checked:
        if module is None:
            unread += 1
            continue
        # The column is of the instruction: a MoveC is one move.
        places = {(it.line, it.column) for it in module.moves}
        left: dict[tuple[int, int], str] = {}
        for it in findings:
            place = (it.line, it.column)
            if it.code in REASONS and (place in places or MOVING in it.message):
                left.setdefault(place, REASONS[it.code])
        reasons.update(left.values())
        moves += len(places - left.keys())
    return Coverage(moves, dict(reasons.most_common()), unread)


def conclusion(found: Sequence[Found], fixed: Counter[str], whole: Coverage) -> str:
    """Return the last sentence of a report. `fixed` counts severities."""
    total = Counter(it.severity for it in found) + fixed
    if not total:
        if whole.is_whole:
            return "All checks passed!"
        return f"No findings in the {_counted(whole.checked, 'move')} checked."
    counts = [_counted(total[level], level) for level in LEVELS if total[level]]
    hint = ""
    if fixed:
        hint = f" ({fixed.total()} fixed, {len(found)} remaining)"
    elif fixable := sum(bool(it.edits) for it in found):
        hint = f" ({fixable} fixable with --fix)"
    return f"Found {', '.join(counts)}{hint}."


def _counted(count: int, word: str) -> str:
    return f"{count} {word}" if count == 1 else f"{count} {word}s"
