"""A report to read in a terminal: a line for each finding, its source line with a caret."""

from collections.abc import Callable, Iterator, Sequence

from irbkin._words import visible
from irbkin.check.findings import Finding
from irbkin.check.report import Report, excerpt
from irbkin.check.report.routines import COUNTS, HEADINGS, routines, unused

STYLES = {"error": "bold red", "warning": "bold yellow", "note": "bold blue"}


def styled(text: str, style: str, is_colored: bool) -> str:
    """A text for a terminal, in a style of rich or of a severity."""
    if not (is_colored and text):
        return text
    from rich.style import Style

    return Style.parse(STYLES.get(style, style)).render(text)


def render(report: Report) -> str:
    """Each finding with its source line."""
    return _whole(report, [f"{_block(found, report)}\n" for found in report.findings])


def concise(report: Report) -> str:
    """Each finding in one line."""
    return _whole(report, [heading(found, report.is_colored) for found in report.findings])


def _whole(report: Report, lines: Sequence[str]) -> str:
    if report.is_counted:
        rows = report.statistics
        width = max((len(str(row["count"])) for row in rows), default=0)
        lines = [
            f"{row['count']:>{width}}  {styled(row['code'], row['severity'], report.is_colored)}  "
            f"[{'*' if row['fixable'] else ' '}] {row['name']}"
            for row in rows
        ]
    if not report.is_quiet:
        table = _routines(report) if report.is_judged else ()
        lines = (report.coverage, *lines, report.conclusion, *table)
    return "".join(f"{line}\n" for line in lines)


def _routines(report: Report) -> Iterator[str]:
    tables = routines(report)
    every = [HEADINGS, *(row for rows in tables.values() for row in rows)]
    widths = [max(map(len, column)) for column in zip(*every, strict=True)]
    for place, rows in tables.items():
        yield from ("", visible(place))
        for row in (HEADINGS, *rows):
            cells = [
                f"{cell:>{width}}" if 0 < column < COUNTS else f"{cell:<{width}}"
                for column, (cell, width) in enumerate(zip(row, widths, strict=True))
            ]
            yield "  ".join(cells).rstrip()
    if words := unused(report):
        yield from ("", words)


def heading(found: Finding, is_colored: bool, show: Callable[[str], str] = visible) -> str:
    """A finding in one line, as linters print it; names and messages as a function shows them."""
    place = show(f"{found.file}:{found.line}:{found.column}")
    mark = f"[{styled('*', 'cyan', is_colored)}] " if found.edits else ""
    code = styled(found.code, found.severity, is_colored)
    return f"{styled(place, 'bold', is_colored)}: {code} {mark}{show(found.message)}"


def _block(found: Finding, report: Report) -> str:
    is_colored = report.is_colored
    line, begin, end = report.place(found)
    part, shift = excerpt(line, begin)
    begin += shift
    end = max(min(end + shift, len(part)), begin + 1)
    width = len(str(found.line))

    def margin(number: str, mark: str = "|") -> str:
        return styled(f"{number:>{width}} {mark}", "note", is_colored)

    rows = [heading(found, is_colored)]
    if part.strip():
        blank = "".join("\t" if own == "\t" else " " for own in part[:begin])
        caret = styled(f"{'^' * (end - begin)} {found.severity}", found.severity, is_colored)
        source = "".join(own if own.isprintable() or own == "\t" else "\ufffd" for own in part)
        rows += [f"{margin(str(found.line))} {source}", f"{margin('')} {blank}{caret}"]
    rows += (
        f"{margin('', '=')} fix in line {number}: {visible(new)}"
        for number, new in report.corrected(found).items()
    )
    return "\n".join(rows)
