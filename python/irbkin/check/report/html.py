"""A report as one HTML file, with pictures, a filter, and colors for light and dark screens."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Iterable
from html import escape
from itertools import groupby
from operator import attrgetter
from pathlib import Path
from string import Template

from irbkin.check.codes import LEVELS, rules
from irbkin.check.findings import Finding
from irbkin.check.report import Report, excerpt
from irbkin.check.report.pictures import bars, gauge, share
from irbkin.check.report.places import views
from irbkin.check.report.routines import HEADINGS, routines, unused

FILE = attrgetter("file")
AROUND = 1
"""Lines of context before and after a finding."""


def render(report: Report) -> str:
    """Return the page."""
    counts = Counter(found.severity for found in report.findings)
    fixable = sum(bool(found.edits) for found in report.findings)
    tiles = [(counts[level], f"{level}s", level) for level in LEVELS]
    tiles += [(fixable, "fixable with --fix", "fine")]
    pictures = {
        "Moves": share(report),
        "Targets in the base frame": views(report),
        "Findings by routine": bars(_tally(report, lambda found: _routine(found, report))),
        "Findings by code": bars(_tally(report, lambda found: f"{found.code} {found.name}")),
    }
    boxes = (
        f'<label class="{level}"><input type="checkbox" value="{level}" checked> {level}s</label>'
        for level in LEVELS
    )
    template = Template(Path(__file__).with_name("page.html").read_text(encoding="utf-8"))
    return template.substitute(
        robot=escape(report.title),
        conclusion=escape(report.conclusion),
        coverage=escape(report.coverage),
        tiles="".join(_tile(*tile) for tile in tiles),
        pictures="".join(
            f'<div class="card"><h3>{title}</h3>{svg}</div>'
            for title, svg in pictures.items()
            if svg
        ),
        levels="\n".join(boxes),
        verdict=_routines(report) if report.is_judged else "",
        files="\n".join(_file(report, *group) for group in groupby(report.findings, FILE)),
    )


def _routines(report: Report) -> str:
    """The routines as a table."""
    rows = [f"<tr>{''.join(f'<th>{escape(words)}</th>' for words in HEADINGS)}</tr>"]
    for place, own in routines(report).items():
        rows.append(f'<tr><th colspan="{len(HEADINGS)}" class="place">{escape(place)}</th></tr>')
        rows += (f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in row)}</tr>" for row in own)
    words = f'<p class="dim">{escape(unused(report))}</p>'
    table = f"<table>{''.join(rows)}</table>"
    return f'<div class="card wide"><h3>Routines</h3>{table}{words}</div>'


def _tile(count: int, words: str, style: str) -> str:
    style = style if count else "dim"
    return f'<div class="tile card"><b class="{style}">{count}</b>{words}</div>'


def _routine(found: Finding, report: Report) -> str:
    """The routine of a finding, with its file name in a report on several files."""
    names = [os.path.basename(found.file)] if len(report.texts) > 1 or not found.routine else []
    return " ".join([*names, found.routine or ""])


def _tally(report: Report, name: Callable[[Finding], str]) -> dict[str, Counter[str]]:
    """Numbers of findings by a name and a severity."""
    tally: dict[str, Counter[str]] = {}
    for found in report.findings:
        tally.setdefault(name(found), Counter())[found.severity] += 1
    return tally


def _file(report: Report, file: str, found: Iterable[Finding]) -> str:
    cards = "\n".join(_card(one, report) for one in found)
    return f"<section>\n<h2>{escape(file)}</h2>\n{cards}\n</section>"


def _card(found: Finding, report: Report) -> str:
    rule = rules()[found.code]
    routine = f" in {escape(found.routine)}" if found.routine else ""
    place = f", line {found.line}" if found.line else ""
    words = " ".join([found.code, found.name, found.routine or "", found.file, found.message])
    parts = [
        f'<article class="finding card {found.severity}" data-level="{found.severity}" '
        f'data-words="{escape(words)}">',
        f"<header><b>{found.code} {escape(found.name)}</b>"
        f'<span class="dim">{found.severity}{place}{routine}</span></header>',
        f"<p>{escape(found.message)}</p>",
        gauge(found),
        _excerpt(found, report),
    ]
    for line, new in report.corrected(found).items():
        parts.append(f"<p>Fix in line {line}:</p><pre>{escape(new)}</pre>")
    meaning, cure = (escape(" ".join(words.split())) for words in (rule.meaning, rule.cure))
    parts.append(
        f"<details><summary>What it means</summary><p>{meaning}</p><p>Cure: {cure}</p></details>"
    )
    return "\n".join(part for part in parts if part) + "\n</article>"


def _excerpt(found: Finding, report: Report) -> str:
    """The line of a finding between its neighbors."""
    if not found.line:
        return ""
    lines = report.text_of(found.file).lines
    rows = []
    first = max(found.line - AROUND, 1)
    for number, line in enumerate(lines[first - 1 : found.line + AROUND], first):
        text = escape(excerpt(line, 0)[0])
        if number == found.line:
            _, begin, end = report.place(found)
            part, shift = excerpt(line, begin)
            begin, end = begin + shift, end + shift
            before, own, after = map(escape, (part[:begin], part[begin:end], part[end:]))
            text = f"{before}<mark>{own}</mark>{after}"
        rows.append(f'<span class="number">{number:5} </span>{text}')
    return f"<pre>{chr(10).join(rows)}</pre>" if rows else ""
