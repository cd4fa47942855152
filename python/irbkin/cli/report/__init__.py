"""Reports of a check: one format a file, imported when it is asked for."""

from __future__ import annotations

import functools
import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import IO, TYPE_CHECKING

from irbkin.cli.findings import Coverage, Found, conclusion

if TYPE_CHECKING:
    from irbkin.cli.report.places import Places

FORMATS = ("text", "concise", "json", "github", "sarif", "html")
ENDINGS = {".json": "json", ".sarif": "sarif", ".html": "html", ".htm": "html", ".txt": "text"}
"""The format of a file by its ending."""


@dataclass(frozen=True)
class Report:
    """Everything that a format may show."""

    found: Sequence[Found]
    texts: Mapping[str, str]
    """The text of each file, by the name that findings have."""
    coverage: Coverage
    fixed: Counter[str]
    robot: str
    places: Places | None = None
    """Where the targets are, for formats with pictures."""
    is_quiet: bool = False
    is_colored: bool = False

    @property
    def conclusion(self) -> str:
        """The last sentence."""
        return conclusion(self.found, self.fixed, self.coverage)

    @functools.cached_property
    def _lines(self) -> dict[str, list[str]]:
        return {file: text.split("\n") for file, text in self.texts.items()}

    def line(self, file: str, number: int) -> str:
        """A line of a file, empty if it has none of this number."""
        lines = self._lines.get(file, [])
        return lines[number - 1].rstrip("\r") if 0 < number <= len(lines) else ""


def rendered(report: Report, form: str) -> str:
    """The text of a report in a format."""
    import importlib

    name = "text" if form == "concise" else form
    module = importlib.import_module(f"irbkin.cli.report.{name}")
    text: str = module.concise(report) if form == "concise" else module.render(report)
    return text


def is_colored(choice: str, stream: IO[str]) -> bool:
    """Whether a stream gets colors: as chosen, by NO_COLOR, by FORCE_COLOR, on a terminal."""
    if choice != "auto":
        return choice == "always"
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR", "0") not in ("", "0"):
        return True
    return stream.isatty() and os.environ.get("TERM") != "dumb"


def fixes(found: Found, text: str) -> list[tuple[int, str]]:
    """Lines that a finding corrects, by their numbers, with its corrections."""
    content = text.encode()
    lines: dict[int, list[tuple[int, int, str]]] = {}
    for edit in sorted(found.edits):
        lines.setdefault(position(content, edit[0])[0], []).append(edit)
    corrected = []
    for number, edits in lines.items():
        begin = content.rfind(b"\n", 0, edits[0][0]) + 1
        end = content.find(b"\n", edits[-1][1])
        line = content[: end if end >= 0 else len(content)]
        for first, last, new in reversed(edits):
            line = line[:first] + new.encode() + line[last:]
        corrected.append((number, line[begin:].decode().strip()))
    return corrected


def position(content: bytes, byte: int) -> tuple[int, int]:
    """Line and column, from 1 and in characters, of a byte of a text in UTF-8."""
    before = content[:byte]
    begin = before.rfind(b"\n") + 1
    return before.count(b"\n") + 1, len(before[begin:].decode()) + 1
