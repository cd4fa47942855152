"""Findings in files, the moves that were checked, and the words for both."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from irbkin.cli.codes import LEVELS

if TYPE_CHECKING:
    from irbkin.rapid import Checked

REASONS = {
    "U801": "unknown values",
    "U802": "instructions or calls that are not followed",
    "U804": "unknown units",
    "N601": "unknown targets",
    "N602": "unknown tools",
    "N603": "unknown work objects",
    "R106": "absent axes",
    "D701": "invalid frames",
}
"""Why a move is not checked, by the code of the finding on it."""


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
    edits: tuple[tuple[str, int, int, str], ...] = ()
    """File, first byte, end, and the text that takes their place."""
    routine: str | None = None
    joint: int | None = None
    value: float | None = None
    bound: float | None = None
    related: tuple[Related, ...] = ()

    @property
    def place(self) -> str:
        """File, line and column."""
        return f"{self.file}:{self.line}:{self.column}"

    @property
    def own_edits(self) -> tuple[tuple[int, int, str], ...]:
        """The edits of the file that it is in."""
        return tuple(edit[1:] for edit in self.edits if edit[0] == self.file)

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
            words += f"; {counted(self.unread, 'file')} not read"
        return f"{words}."


def coverage(programs: Iterable[tuple[Checked, int]]) -> Coverage:
    """Return what was checked of programs, each with how many of its files were not read."""
    moves, unread = 0, 0
    reasons: Counter[str] = Counter()
    for checked, count in programs:
        unread += count
        left = [it.unchecked for it in checked.moves if it.unchecked is not None]
        reasons.update(REASONS.get(code, code) for code in left)
        moves += len(checked.moves) - len(left)
    return Coverage(moves, dict(reasons.most_common()), unread)


def conclusion(found: Sequence[Found], fixed: Counter[str], whole: Coverage) -> str:
    """Return the last sentence of a report. `fixed` counts severities."""
    total = Counter(it.severity for it in found) + fixed
    if not total:
        if whole.is_whole:
            return "All checks passed!"
        return f"No findings in the {counted(whole.checked, 'move')} checked."
    counts = [counted(total[level], level) for level in LEVELS if total[level]]
    hint = ""
    if fixed:
        hint = f" ({fixed.total()} fixed, {len(found)} remaining)"
    elif fixable := sum(bool(it.edits) for it in found):
        hint = f" ({fixable} fixable with --fix)"
    return f"Found {', '.join(counts)}{hint}."


def counted(count: int, word: str) -> str:
    """A number with its word."""
    return f"{count} {word}" if count == 1 else f"{count} {word}s"
