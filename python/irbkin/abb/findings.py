"""Findings: what the files of a backup leave open, contradict, or have broken."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

Severity = Literal["error", "warning", "note"]

MOST_OF_A_CODE = 20
"""Findings of one code in one file; a last one counts the others."""


@dataclass(frozen=True)
class Finding:
    """A finding of a file of a backup."""

    file: str
    """Path in the backup, with `/`; empty if no file is at fault."""
    line: int
    """Line of the file, from 1; 0 where it has none."""
    code: str
    """Kind of the finding, one word: "unknown-arm", "base-frame"."""
    severity: Severity
    """"error": the controller would not take the file, or a value is unusable. "warning": moves
    cannot be checked, or are checked with another figure. "note": worth knowing.
    """
    message: str
    """Message; it names the unit, task or module."""

    def __str__(self) -> str:
        """Write it as linters do: `SYSPAR/MOC.cfg:12: warning: message [code]`."""
        place = f"{self.file}:{self.line}" if self.line else self.file
        return f"{place + ': ' if place else ''}{self.severity}: {self.message} [{self.code}]"


def limited(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    """Keep the first findings of each code in each file; count the others in one line."""
    kept: list[Finding] = []
    counts: dict[tuple[str, str], int] = {}
    for finding in findings:
        key = (finding.file, finding.code)
        counts[key] = counts.get(key, 0) + 1
        if counts[key] <= MOST_OF_A_CODE:
            kept.append(finding)
    for (file, code), count in counts.items():
        if count > MOST_OF_A_CODE:
            message = f"{count - MOST_OF_A_CODE} more places of this kind"
            kept.append(Finding(file, 0, code, "note", message))
    return tuple(kept)
