"""The report of a check, and its formats: one a file, imported on demand."""

import importlib
import os
from bisect import bisect
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import accumulate
from typing import IO, Any

from irbkin import Cell
from irbkin._files import shown
from irbkin.check.checker import Checker
from irbkin.check.codes import LEVELS, REASONS, UNREAD
from irbkin.check.findings import Finding
from irbkin.check.jobs import Job
from irbkin.rapid import Checked

ENDINGS = {
    ".json": "json",
    ".sarif": "sarif",
    ".xml": "junit",
    ".html": "html",
    ".htm": "html",
    ".txt": "text",
}
"""The format of a file by its ending."""
WIDTH = 200
"""Characters that are shown of a line: one may have a whole module."""
LONGEST = 1_000
"""Characters of a statement that are marked."""


class SourceText:
    """The text of a file, split into lines on demand."""

    def __init__(self, text: str) -> None:
        self.text = text

    @cached_property
    def _rows(self) -> list[bytes]:
        return self.text.encode().split(b"\n")

    @cached_property
    def _starts(self) -> list[int]:
        return list(accumulate((len(row) + 1 for row in self._rows[:-1]), initial=0))

    def line(self, number: int) -> str:
        """A line by its number from 1, without its end; empty beyond the last."""
        return self._rows[number - 1].decode().rstrip("\r") if 0 < number <= len(self._rows) else ""

    def position(self, byte: int) -> tuple[int, int]:
        """Line and column, from 1 and in characters, of a byte of the text in UTF-8."""
        number = bisect(self._starts, byte)
        before = self._rows[number - 1][: byte - self._starts[number - 1]]
        return number, len(before.decode()) + 1

    def corrected(self, edits: Iterable[tuple[int, int, str]]) -> dict[int, str]:
        """Edited lines by number, of long ones an excerpt; each edit lies within one line."""
        lines: dict[int, tuple[bytes, bytes]] = {}
        for begin, end, new in sorted(edits, reverse=True):
            number = bisect(self._starts, begin)
            start, row = self._starts[number - 1], self._rows[number - 1]
            before, after = lines.get(number, (row, b""))
            after = new.encode() + before[end - start :] + after
            lines[number] = before[: begin - start], after
        return {
            number: excerpt((before + after).decode(), len(before.decode()))[0].strip()
            for number, (before, after) in sorted(lines.items())
        }


def excerpt(line: str, column: int) -> tuple[str, int]:
    """The part of a line around a column from 0, and what is to be added to columns in it.

    A carriage return alone ends a line, too.
    """
    start, stop = 0, len(line)
    if stop > WIDTH:
        start = max(column - WIDTH // 4, 0)
        stop = min(start + WIDTH, stop)
    ahead, behind = "..." * (start > 0), "..." * (stop < len(line))
    if (end := line.rfind("\r", start, column)) >= 0:
        start, ahead = end + 1, ""
    if (end := line.find("\r", column, stop)) >= 0:
        stop, behind = end, ""
    return f"{ahead}{line[start:stop]}{behind}", len(ahead) - start


def span(found: Finding, line: str) -> tuple[int, int]:
    """The columns of a finding in its line, from 0, end exclusive.

    A statement without its semicolon, of a long one the beginning; one character of a syntax
    error.
    """
    begin = min(found.column - 1, len(line))
    if found.code.startswith("E"):
        return begin, begin + 1
    statement = line[begin : begin + LONGEST].partition(";")[0].partition("!")[0].rstrip()
    return begin, begin + max(len(statement), 1)


@dataclass(frozen=True)
class Report:
    """The content of a report, independent of its format."""

    title: str
    """The arms."""
    findings: Sequence[Finding]
    texts: Mapping[str, SourceText]
    """The text of each file, by the name that findings have."""
    checked: int
    """Number of moves that were checked with what the program determines."""
    assumed: int = 0
    """Number of those that were checked with saved values or given tools."""
    reasons: Mapping[str, int] = field(default_factory=dict)
    """Number of unchecked moves by reason."""
    unread: int = 0
    """Number of files that were not read."""
    fixed: Counter[str] = field(default_factory=Counter)
    """Number of findings that corrections removed, by severity."""
    programs: Sequence[tuple[Job, Checked]] = ()
    cell: Cell | None = None
    is_judged: bool = False
    """Whether the summary of routines is shown, in formats that have one."""
    is_counted: bool = False
    """Whether text and JSON count the findings of each code in their place."""
    is_quiet: bool = False
    is_colored: bool = False

    def text_of(self, file: str) -> SourceText:
        return self.texts.get(file) or SourceText("")

    def place(self, found: Finding) -> tuple[str, int, int]:
        line = self.text_of(found.file).line(found.line)
        return line, *span(found, line)

    def corrected(self, found: Finding) -> dict[int, str]:
        edits = [edit[1:] for edit in found.edits if edit[0] == found.file]
        return self.text_of(found.file).corrected(edits)

    @property
    def moves(self) -> dict[str, Any]:
        """How many moves were checked, of how many, and why others were not, for programs."""
        total = self.checked + self.assumed + sum(self.reasons.values())
        counts = {"checked": self.checked, "assumed": self.assumed, "total": total}
        return {**counts, "reasons": dict(self.reasons), "unread": self.unread}

    @property
    def is_wrong(self) -> bool:
        """Whether it has an error or a warning, or no move was checked."""
        is_found = any(found.severity != "note" for found in self.findings)
        return is_found or bool(self.reasons and not self.checked + self.assumed)

    @property
    def statistics(self) -> list[dict[str, Any]]:
        """How many findings each code has, and how many of them a correction, most first."""
        counts = Counter((it.code, it.name, it.severity) for it in self.findings)
        fixable = Counter(it.code for it in self.findings if it.edits)
        rows = sorted(counts.items(), key=lambda row: (-row[1], row[0]))
        keys = ("code", "name", "severity", "count", "fixable")
        return [dict(zip(keys, (*of, count, fixable[of[0]]), strict=True)) for of, count in rows]

    @property
    def coverage(self) -> str:
        """The first sentence: number of checked moves, and of the others by reason."""
        left = sum(self.reasons.values())
        words = f"{self.checked} of {counted(self.moves['total'], 'move')} checked"
        if self.assumed:
            words += f", {self.assumed} more with saved values or given tools"
        if left:
            parts = [f"{count} by {reason}" for reason, count in self.reasons.items()]
            words += f"{';' if self.assumed else ','} {left} not: {', '.join(parts)}"
        if self.unread:
            words += f"; {counted(self.unread, 'file')} not read"
        return f"{words}."

    @property
    def conclusion(self) -> str:
        """The last sentence: number of findings by severity."""
        total = Counter(found.severity for found in self.findings) + self.fixed
        if not total:
            if self.checked and not (self.reasons or self.assumed or self.unread):
                return "All checks passed!"
            return f"No findings in the {counted(self.checked + self.assumed, 'move')} checked."
        counts = [counted(total[level], level) for level in LEVELS if total[level]]
        hint = ""
        if self.fixed:
            hint = f" ({self.fixed.total()} fixed, {len(self.findings)} remaining)"
        elif fixable := sum(bool(found.edits) for found in self.findings):
            hint = f" ({fixable} fixable with --fix)"
        return f"Found {', '.join(counts)}{hint}."


def report_of(checker: Checker, jobs: Iterable[Job], left_open: Iterable[Finding] = ()) -> Report:
    """Check programs and return the report; `left_open` are findings on the files around them."""
    found = [finding for finding in left_open if finding.code in checker.codes]
    texts, programs, reasons, unread, assumed = {}, [], Counter[str](), 0, 0
    for job in jobs:
        checked, own = checker.check(job)
        found += own
        programs.append((job, checked))
        left = (move.unchecked for move in checked.moves if move.unchecked is not None)
        reasons.update(REASONS.get(code, code) for code in left)
        assumed += sum(move.assumed for move in checked.moves)
        unread += sum(finding.code == UNREAD for finding in job.program.findings)
        for file, module in zip(job.program.files, job.program.modules, strict=True):
            texts[shown(file.path)] = SourceText(module.source)
    moves = sum(len(checked.moves) for _, checked in programs)
    return Report(
        ", ".join(job.title for job, _ in programs),
        # Shared modules are in several programs.
        list(dict.fromkeys(map(_shown, found))),
        texts,
        moves - assumed - reasons.total(),
        assumed,
        dict(reasons.most_common()),
        unread,
        programs=programs,
        cell=checker.cell,
    )


def _shown(found: Finding) -> Finding:
    """A finding with its files named as in messages, in place of their paths."""
    edits = tuple((shown(file), *edit) for file, *edit in found.edits)
    related = tuple((shown(file), *place) for file, *place in found.related)
    return found._replace(file=shown(found.file), edits=edits, related=related)  # type: ignore[arg-type]


def rendered(report: Report, form: str) -> str:
    module = importlib.import_module(f"irbkin.check.report.{form.replace('concise', 'text')}")
    text: str = module.concise(report) if form == "concise" else module.render(report)
    return text


def is_colored(choice: str, stream: IO[str]) -> bool:
    """Whether a stream is colored: by choice, NO_COLOR, FORCE_COLOR, or as a terminal."""
    if choice != "auto":
        return choice == "always"
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR", "0") not in ("", "0"):
        return True
    return stream.isatty() and os.environ.get("TERM") != "dumb"


def counted(count: int, word: str) -> str:
    """A number with its noun in singular or plural."""
    return f"{count} {word}" if count == 1 else f"{count} {word}s"
