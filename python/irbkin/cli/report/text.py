"""A report to read in a terminal: a line for each finding, its source line with a caret."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from irbkin.cli.findings import Found
from irbkin.cli.report import Report
from irbkin.cli.verdict import COUNTS, HEADINGS, Verdict, cells

STYLES = {
    "bold": "1",
    "error": "1;31",
    "warning": "1;33",
    "note": "1;34",
    "fix": "36",
    "added": "32",
    "removed": "31",
    "frame": "1;34",
}


def styled(text: str, style: str, is_colored: bool) -> str:
    """A text in a style of a terminal."""
    return f"\x1b[{STYLES[style]}m{text}\x1b[0m" if is_colored and text else text


def render(report: Report) -> str:
    """Each finding with its source line."""
    blocks = (_block(it, report) for it in report.found)
    return _whole(report, [f"{block}\n" for block in blocks])


def concise(report: Report) -> str:
    """Each finding in one line."""
    return _whole(report, [_heading(it, report.is_colored) for it in report.found])


def _whole(report: Report, lines: Sequence[str]) -> str:
    if report.is_quiet:
        return "".join(f"{it}\n" for it in lines)
    rows = (report.coverage.text(), *lines, report.conclusion, *_verdict(report.verdict))
    return "".join(f"{it}\n" for it in rows)


def _verdict(verdict: Verdict | None) -> Iterator[str]:
    """The routines as a table."""
    if verdict is None:
        return
    table = [HEADINGS, *map(cells, verdict.routines)]
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    lines = [
        "  ".join(
            f"{cell:>{width}}" if 0 < column < COUNTS else f"{cell:<{width}}"
            for column, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in table
    ]
    place = None
    for row, line in zip(verdict.routines, lines[1:], strict=True):
        if (row.robot, row.file) != place:
            place = (row.robot, row.file)
            yield from ("", f"{row.file} ({row.robot})", lines[0])
        yield line
    if words := verdict.unused_words():
        yield from ("", words)


def _heading(found: Found, is_colored: bool) -> str:
    mark = f"[{styled('*', 'fix', is_colored)}] " if found.edits else ""
    code = styled(found.code, found.severity, is_colored)
    return f"{styled(found.place, 'bold', is_colored)}: {code} {mark}{found.message}"


def _block(found: Found, report: Report) -> str:
    is_colored = report.is_colored
    text = report.text_of(found.file)
    line = text.line(found.line)
    begin, end = found.span(line)
    width = len(str(found.line))

    def margin(number: str, mark: str = "|") -> str:
        return styled(f"{number:>{width}} {mark}", "frame", is_colored)

    rows = [_heading(found, is_colored)]
    if line.strip():
        blank = "".join("\t" if it == "\t" else " " for it in line[:begin])
        caret = styled(f"{'^' * (end - begin)} {found.severity}", found.severity, is_colored)
        source = "".join(it if it.isprintable() or it == "\t" else "\ufffd" for it in line)
        rows += [f"{margin(str(found.line))} {source}", f"{margin('')} {blank}{caret}"]
    rows += (f"{margin('', '=')} note: {it}" for it in _related(found))
    rows += (
        f"{margin('', '=')} fix in line {number}: {new}"
        for number, new in text.corrected(found.own_edits).items()
    )
    return "\n".join(rows)


def _related(found: Found) -> Iterator[str]:
    for it in found.related:
        yield f"{it.file}:{it.line}:{it.column}: {it.message}"
