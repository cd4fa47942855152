"""Reports of a check: one format a file, imported when it is asked for."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import IO, TYPE_CHECKING

from irbkin.cli.findings import Coverage, Found, conclusion
from irbkin.cli.report.source_text import SourceText

if TYPE_CHECKING:
    from irbkin.cli.report.places import Places
    from irbkin.cli.verdict import Verdict

FORMATS = ("text", "concise", "json", "github", "sarif", "html")
ENDINGS = {".json": "json", ".sarif": "sarif", ".html": "html", ".htm": "html", ".txt": "text"}
"""The format of a file by its ending."""


@dataclass(frozen=True)
class Report:
    """Everything that a format may show."""

    found: Sequence[Found]
    texts: Mapping[str, SourceText]
    """The text of each file, by the name that findings have."""
    coverage: Coverage
    fixed: Counter[str]
    robot: str
    places: Places | None = None
    """Where the targets are, for formats with pictures."""
    verdict: Verdict | None = None
    """The routines at a glance, for formats that show them."""
    is_quiet: bool = False
    is_colored: bool = False

    @property
    def conclusion(self) -> str:
        """The last sentence."""
        return conclusion(self.found, self.fixed, self.coverage)

    def text_of(self, file: str) -> SourceText:
        """The text of a file, empty if it is not known."""
        return self.texts.get(file) or SourceText("")


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
