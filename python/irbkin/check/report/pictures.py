"""Pictures of a report, as SVG that takes its colors from the page."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from html import escape

from irbkin.check.codes import LEVELS
from irbkin.check.findings import Finding
from irbkin.check.report import Report

WIDTH = 320
"""Width of a picture, in its own units."""
MOST = 12
"""Bars of a picture."""


def share(report: Report) -> str:
    """Draw the shares of checked moves and of unchecked ones by reason."""
    parts = [("checked", report.checked, "fine")]
    parts += [(f"not: {reason}", count, "warning") for reason, count in report.reasons.items()]
    total = sum(count for _, count, _ in parts)
    if not total:
        return ""
    drawn, x = [], 0.0
    for index, (words, count, style) in enumerate(parts):
        width = WIDTH * count / total
        drawn.append(_bar(x, 4, max(width - 1, 0.5), style, 16))
        y = 40 + 20 * index
        drawn.append(_bar(0, y - 10, 10, style, 10) + text(16, y, f"{count} {words}"))
        x += width
    return svg(drawn, 30 + 20 * len(parts))


def bars(tally: Mapping[str, Counter[str]]) -> str:
    """Draw numbers of findings by name as bars, stacked by severity."""
    if not tally:
        return ""
    ranked = sorted(tally.items(), key=lambda named: -named[1].total())
    most = ranked[0][1].total()
    room = WIDTH - 30
    drawn = []
    for row, (name, counts) in enumerate(ranked[:MOST]):
        y, x = 34 * row, 0.0
        drawn.append(text(0, y + 12, name if len(name) < 48 else f"...{name[-44:]}"))
        for level in LEVELS:
            width = room * counts[level] / most
            if width:
                drawn.append(_bar(x, y + 17, width, level, 9))
            x += width
        drawn.append(text(x + 6, y + 26, str(counts.total()), "dim"))
    left = len(ranked) - MOST
    if left > 0:
        drawn.append(text(0, 34 * MOST + 12, f"and {left} more", "dim"))
    return svg(drawn, 34 * min(len(ranked), MOST) + (20 if left > 0 else 0))


def gauge(found: Finding) -> str:
    """Draw a value and its bound, if a finding has both."""
    value, bound = found.value, found.bound
    if value is None or not bound or bound < 0 or value < 0:
        return ""
    scale = (WIDTH - 110) / max(value, bound)
    tick = scale * bound
    drawn = [
        _bar(0, 4, WIDTH - 110, "rest", 10),
        _bar(0, 4, scale * value, found.severity, 10),
        f'<path d="M{tick:.1f} 0V18" stroke="currentColor" stroke-width="2"/>',
        text(WIDTH - 102, 13, f"{100 * value / bound:.0f} % of the bound"),
    ]
    return svg(drawn, 18).replace("<svg", '<svg class="gauge"', 1)


def svg(drawn: list[str], height: float) -> str:
    """Return a picture of drawn parts."""
    return f'<svg viewBox="0 0 {WIDTH} {height:g}" role="img">{"".join(drawn)}</svg>'


def _bar(x: float, y: float, width: float, style: str, height: float) -> str:
    place = f'x="{x:.1f}" y="{y:g}" width="{width:.1f}" height="{height:g}"'
    return f'<rect class="{style}" {place} rx="2"/>'


def text(x: float, y: float, words: str, style: str = "") -> str:
    """Draw words."""
    return f'<text class="{style}" x="{x:.1f}" y="{y:g}">{escape(words)}</text>'
