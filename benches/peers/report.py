"""Tables of the results, for the terminal and as Markdown: the same cells."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from pathlib import Path

from .contenders.contender import BATCHES
from .recall import Recall
from .rows import Result

BEGIN, END = "<!-- peers: begin -->", "<!-- peers: end -->"
# Characters of the longest bar.
BAR = 32
Table = list[list[str]]


def time_of(seconds: float, batch: bool) -> str:
    """Microseconds of a call, or nanoseconds a pose of a batch."""
    return f"{seconds * 1e9:.1f} ns" if batch else f"{seconds * 1e6:.2f} us"


def times(result: Result) -> Table:
    """Times of a row: irbkin first, the others by their ratio to the yardstick."""
    batch = result.row.task in BATCHES
    timings, own = result.timings, result.own
    stick = timings[result.yardstick]
    head = ["", "a pose" if batch else "a call", "/ irbkin", f"/ {result.yardstick}", "checked"]
    order = sorted(
        timings, key=lambda name: (not name.startswith("irbkin"), timings[name].ratio(stick))
    )
    table = [head]
    for name in order:
        timing = timings[name]
        ratio = f"{timing.ratio(timings[own]):.2f}" if own else "-"
        words = [result.checked.get(name, ""), result.remarks.get(name, "")]
        said = "; ".join(word for word in words if word)
        table.append(
            [name, time_of(timing.median, batch), ratio, f"{timing.ratio(stick):.2f}", said]
        )
    return table


def bars(result: Result) -> str:
    """Times of a row as ratios to irbkin's, each with a bar, the fastest first."""
    own, batch = result.timings[result.own or result.yardstick], result.row.task in BATCHES
    ratios = {name: timing.ratio(own) for name, timing in result.timings.items()}
    order, most = sorted(ratios, key=lambda name: ratios[name]), max(ratios.values())
    width = max(map(len, order))
    return "\n".join(
        f"  {name:{width}} {ratios[name]:9.2f} x {time_of(result.timings[name].median, batch):>12} "
        + "#" * max(1, round(BAR * ratios[name] / most))
        for name in order
    )


def brief(table: Table) -> Table:
    """Times without the ratio to the yardstick and without what irbkin's row has checked alike."""
    alike = table[1][-1]
    return [
        [*line[:3], "" if number > 1 and line[-1] == alike else line[-1]]
        for number, line in enumerate(table)
    ]


def losses(recalls: Sequence[Recall]) -> Table:
    """Solutions that each contender missed, and what else its answers hold."""
    head = ["missed of", *(f"{each.poses.name} ({each.known})" for each in recalls)]
    table = [[*head, "flagged", "incorrect", "duplicate", "worst residual"]]
    for name in recalls[0].tallies:
        tallies = [each.tallies[name] for each in recalls]
        missed = [
            str(each.known - tally.found) for each, tally in zip(recalls, tallies, strict=True)
        ]
        sums = [
            str(sum(getattr(tally, what) for tally in tallies))
            for what in ("flagged", "inexact", "twice")
        ]
        table.append([name, *missed, *sums, f"{max(tally.worst for tally in tallies):.0e}"])
    return table


def plain(table: Table) -> str:
    """A table for the terminal; first and last column to the left, figures to the right."""
    widths = [max(len(line[i]) for line in table) for i in range(len(table[0]))]
    last = len(widths) - 1
    lines = []
    for line in table:
        padded = enumerate(zip(line, widths, strict=True))
        cells = [
            cell.ljust(width) if i in (0, last) else cell.rjust(width)
            for i, (cell, width) in padded
        ]
        lines.append("  ".join(cells).rstrip())
    return "\n".join(lines)


def markdown(table: Table) -> str:
    """A table of Markdown."""
    rule = ["---", *("---:" for _ in table[0][1:-1]), "---"]
    return "\n".join("| " + " | ".join(line) + " |" for line in [table[0], rule, *table[1:]])


def document(
    machine: Sequence[str],
    recalls: Mapping[str, Sequence[Recall]],
    results: Sequence[Result],
    missing: dict[str, str],
) -> str:
    """The generated part of docs/evidence/benchmarks.md."""
    parts = ["\n\n".join(textwrap.fill(line, 100) for line in machine)]
    for arm, tallies in recalls.items():
        parts += [f"### Solutions missed, {arm}", markdown(losses(tallies))]
    for result in results:
        parts += [f"### {result.row.title}", markdown(brief(times(result)))]
        parts += ["\n".join(f"- {line}" for line in result.absent)] if result.absent else []
    if missing:
        parts.append("Not installed: " + ", ".join(missing) + ".")
    return "\n\n".join(parts)


def write(page: Path, text: str) -> None:
    """Put text between the markers of a page.

    Raises:
        ValueError: The page has not one pair of markers.
    """
    old = page.read_text()
    if old.count(BEGIN) != 1 or old.count(END) != 1:
        raise ValueError(f"{page} needs one {BEGIN} and one {END}")
    before, rest = old.split(BEGIN)
    page.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{rest.split(END)[1]}")
