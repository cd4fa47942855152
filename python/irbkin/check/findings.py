"""Findings in files, of modules, of backups and of moves."""

from typing import NamedTuple

from irbkin import rapid
from irbkin.abb import Backup
from irbkin.check.codes import BACKUP, codes


class Finding(NamedTuple):
    """An error, a warning or a note at a line and column of a file."""

    file: str
    line: int
    column: int
    code: str
    name: str
    severity: str
    message: str
    edits: tuple[tuple[str, int, int, str], ...] = ()
    """File, first byte, end, and the replacement."""
    routine: str | None = None
    joint: int | None = None
    value: float | None = None
    bound: float | None = None
    related: tuple[tuple[str, int, int], ...] = ()
    """Files, lines and columns at which its cause shows, too."""


def of_file(found: rapid.FileFinding) -> Finding:
    """Return a finding on the file of a module; one on the whole file is at its beginning."""
    place = (found.file, max(found.line, 1), max(found.column, 1), found.code)
    return Finding(*place, codes()[found.code].name, found.severity, found.message)


def of_backup(backup: Backup) -> list[Finding]:
    """Return the findings on the files of a backup; one on a whole file is at its beginning."""
    places = [(str(backup.origin / it.file), max(it.line, 1), 1, BACKUP) for it in backup.findings]
    own = zip(places, backup.findings, strict=True)
    return [Finding(*place, it.code, it.severity, it.message) for place, it in own]
