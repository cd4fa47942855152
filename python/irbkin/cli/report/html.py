"""A report as one HTML file, with pictures, a filter, and colors for light and dark screens."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable
from html import escape
from itertools import groupby
from pathlib import Path
from string import Template

from irbkin.cli.codes import LEVELS, rules
from irbkin.cli.findings import Found
from irbkin.cli.report import Report
from irbkin.cli.report.pictures import bars, gauge, share
from irbkin.cli.report.places import views
from irbkin.cli.report.source_text import SourceText
from irbkin.cli.verdict import HEADINGS, Verdict, cells

AROUND = 1
"""Lines that are shown before a finding and behind it."""


def render(report: Report) -> str:
    """Return the page."""
    counts = Counter(it.severity for it in report.found)
    fixable = sum(bool(it.edits) for it in report.found)
    tiles = [(counts[level], f"{level}s", level) for level in LEVELS]
    tiles += [(fixable, "fixable with --fix", "fine")]
    pictures = {
        "Moves": share(report.coverage),
        "Targets in the base frame": views(report.places) if report.places else "",
        "Findings by routine": bars(_tally((_routine(it, report), it) for it in report.found)),
        "Findings by code": bars(_tally((f"{it.code} {it.name}", it) for it in report.found)),
    }
    boxes = (
        f'<label class="{it}"><input type="checkbox" value="{it}" checked> {it}s</label>'
        for it in LEVELS
    )
    template = Template(Path(__file__).with_name("page.html").read_text(encoding="utf-8"))
    return template.substitute(
        robot=escape(report.robot),
        conclusion=escape(report.conclusion),
        coverage=escape(report.coverage.text()),
        tiles="".join(_tile(*it) for it in tiles),
        pictures="".join(
            f'<div class="card"><h3>{title}</h3>{svg}</div>'
            for title, svg in pictures.items()
            if svg
        ),
        levels="\n".join(boxes),
        verdict=_routines(report.verdict) if report.verdict else "",
        files="\n".join(_file(report, *it) for it in groupby(report.found, lambda it: it.file)),
    )


def _routines(verdict: Verdict) -> str:
    """The routines as a table."""
    head = "".join(f"<th>{escape(it)}</th>" for it in HEADINGS)
    rows = []
    for place, group in groupby(verdict.routines, lambda it: f"{it.file} ({it.robot})"):
        rows.append(f'<tr><th colspan="{len(HEADINGS)}" class="place">{escape(place)}</th></tr>')
        rows += (
            f"<tr>{''.join(f'<td>{escape(it)}</td>' for it in cells(row))}</tr>" for row in group
        )
    unused = f'<p class="dim">{escape(verdict.unused_words())}</p>'
    table = f"<table><tr>{head}</tr>{''.join(rows)}</table>"
    return f'<div class="card wide"><h3>Routines</h3>{table}{unused}</div>'


def _tile(count: int, words: str, style: str) -> str:
    style = style if count else "dim"
    return f'<div class="tile card"><b class="{style}">{count}</b>{words}</div>'


def _routine(found: Found, report: Report) -> str:
    """The routine of a finding; of several files, with the name of its own."""
    names = [os.path.basename(found.file)] if len(report.texts) > 1 or not found.routine else []
    return " ".join([*names, found.routine or ""])


def _tally(named: Iterable[tuple[str, Found]]) -> dict[str, Counter[str]]:
    """Numbers of findings by a name and a severity."""
    tally: dict[str, Counter[str]] = {}
    for name, it in named:
        tally.setdefault(name, Counter())[it.severity] += 1
    return tally


def _file(report: Report, file: str, found: Iterable[Found]) -> str:
    text = report.text_of(file)
    cards = "\n".join(_card(it, text) for it in found)
    return f"<section>\n<h2>{escape(file)}</h2>\n{cards}\n</section>"


def _card(found: Found, text: SourceText) -> str:
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
        _excerpt(found, text.lines),
    ]
    for line, new in text.corrected(found.own_edits).items():
        parts.append(f"<p>Fix in line {line}:</p><pre>{escape(new)}</pre>")
    for it in found.related:
        parts.append(f"<p>{escape(f'{it.file}:{it.line}:{it.column}: {it.message}')}</p>")
    meaning, cure = (escape(" ".join(it.split())) for it in (rule.meaning, rule.cure))
    parts.append(
        f"<details><summary>What it means</summary><p>{meaning}</p><p>Cure: {cure}</p></details>"
    )
    return "\n".join(it for it in parts if it) + "\n</article>"


def _excerpt(found: Found, lines: list[str]) -> str:
    """The line of a finding between its neighbors."""
    if not found.line:
        return ""
    rows = []
    for number in range(found.line - AROUND, found.line + AROUND + 1):
        if not 0 < number <= len(lines):
            continue
        line = lines[number - 1]
        text = escape(line)
        if number == found.line:
            begin, end = found.span(line)
            before, own, after = (escape(it) for it in (line[:begin], line[begin:end], line[end:]))
            text = f"{before}<mark>{own}</mark>{after}"
        rows.append(f'<span class="number">{number:5} </span>{text}')
    return f"<pre>{chr(10).join(rows)}</pre>" if rows else ""
