"""A report to read in a terminal: a line for each finding, its source line with a caret; a summary
of routines: nearest limits and singularities; corrections as a unified diff.
"""

import difflib
import math
import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence

import numpy as np

from irbkin import Robot
from irbkin._files import shown
from irbkin._words import visible
from irbkin.check.findings import Finding
from irbkin.check.report import Report, excerpt
from irbkin.rapid import CheckedMove

STYLES = {"error": "bold red", "warning": "bold yellow", "note": "bold blue"}
HEADINGS = (
    "routine", "moves", "assumed", "not checked", "errors", "warnings", "nearest limit",
    "nearest singularity",
)  # fmt: skip
COUNTS = 6
"""End of the numeric columns, which begin at 1."""


def styled(text: str, style: str, is_colored: bool) -> str:
    if not (is_colored and text):
        return text
    from rich.style import Style

    return Style.parse(STYLES.get(style, style)).render(text)


def render(report: Report) -> str:
    return _whole(report, [f"{_block(found, report)}\n" for found in report.findings])


def concise(report: Report) -> str:
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


def heading(found: Finding, is_colored: bool, show: Callable[[str], str] = visible) -> str:
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


def routines(report: Report) -> dict[str, list[tuple[str, ...]]]:
    """Return the cells below `HEADINGS` of each routine that moves, by its file and arm."""
    counts = Counter((found.file, found.routine or "", found.severity) for found in report.findings)
    tables: dict[str, list[tuple[str, ...]]] = {}
    for job, checked in report.programs:
        groups: dict[tuple[int, str], list[CheckedMove]] = {}
        for move in checked.moves:
            groups.setdefault((move.module, move.routine or ""), []).append(move)
        for (module, routine), moves in groups.items():
            file = shown(job.program.files[module].path)
            assumed = sum(move.assumed for move in moves)
            left = sum(move.unchecked is not None for move in moves)
            wrong = [counts[file, routine, level] for level in ("error", "warning")]
            numbers = [str(count or "") for count in (len(moves), assumed, left, *wrong)]
            near = _nearest(job.robot, [move for move in moves if move.q is not None])
            tables.setdefault(f"{file} ({job.title})", []).append((routine, *numbers, *near))
    return tables


def _nearest(robot: Robot | None, moves: Sequence[CheckedMove]) -> tuple[str, str]:
    """The nearest limit and the nearest singularity of the targets of moves, each with its line."""
    if robot is None or not moves:
        return "", ""
    q = np.array([move.q for move in moves])
    lower, upper = robot.limits.T
    rooms = np.minimum(q - lower, upper - q)
    index, joint = np.unravel_index(rooms.argmin(), rooms.shape)
    limit = f"J{joint + 1} {math.degrees(rooms[index, joint]):.1f} deg, line {moves[index].line}"
    at = robot.singularity(q)
    # The shoulder distance is a length: only the two angles are comparable.
    angles = {"wrist": np.degrees(at.wrist), "elbow": np.degrees(at.elbow)}
    known = [name for name, own in angles.items() if np.isfinite(own).any()]
    if not known:
        return limit, ""
    name = min(known, key=lambda name: np.nanmin(angles[name]))
    index = int(np.nanargmin(angles[name]))
    return limit, f"{name} {angles[name][index]:.1f} deg, line {moves[index].line}"


def diff(file: str, before: str, after: str, is_colored: bool) -> str:
    """Return the diff of a file, which `patch` and `git apply` read unless it has escapes."""
    file = visible(file)
    # Lines end with \n alone: a \r before it belongs to the line.
    old, new = (re.findall(r"[^\n]*\n|[^\n]+", text) for text in (before, after))
    rows = []
    for row in difflib.unified_diff(old, new, file, file):
        line, end, _ = row.partition("\n")
        line = visible(line.removesuffix("\r")) + "\r" * line.endswith("\r")
        is_head = row.startswith(("---", "+++"))
        style = {"+": "green", "-": "red", "@": "note"}.get(row[0])
        rows.append(styled(line, style, is_colored) if style and not is_head else line)
        rows.append(end or "\n\\ No newline at end of file\n")
    return "".join(rows)
