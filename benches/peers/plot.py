"""The picture of the results: bars on a logarithmic scale, irbkin at one."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from .contenders.contender import BATCHES
from .report import time_of
from .rows import Result

OWN_COLOUR, PEER_COLOUR, STICK_COLOUR, TEXT_COLOUR = "#0072b2", "#b0b7bf", "#e69f00", "#333333"
STYLE: dict[Any, Any] = {
    "axes.spines.left": False,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 9,
    "axes.titleweight": "bold",
    "font.sans-serif": ["DejaVu Sans", "Verdana"],
    "font.size": 8,
    "savefig.facecolor": "white",
    "svg.fonttype": "none",
    "svg.hashsalt": "irbkin",
    "text.color": TEXT_COLOUR,
    "xtick.color": "#777777",
    "ytick.color": TEXT_COLOUR,
    "ytick.major.size": 0,
}


def color(name: str, yardstick: str) -> str:
    """Of a bar."""
    if name == yardstick:
        return STICK_COLOUR
    return OWN_COLOUR if name.startswith("irbkin") else PEER_COLOUR


def ratios_of(result: Result) -> dict[str, float]:
    """Times relative to irbkin, the slowest first."""
    own = result.timings[str(result.own)]
    ratios = {name: timing.ratio(own) for name, timing in result.timings.items()}
    return dict(sorted(ratios.items(), key=lambda item: item[1], reverse=True))


def number(ratio: float) -> str:
    """Two digits that count, no exponent."""
    return f"{ratio:.0f}" if ratio >= 10 else f"{ratio:.2g}"


def draw(results: Sequence[Result], path: Path) -> None:
    """Write the picture of those rows that irbkin and a peer share."""
    import matplotlib as mpl

    mpl.use("svg")
    import matplotlib.pyplot as plt

    shared = [
        r for r in results if r.own and any(color(n, r.yardstick) == PEER_COLOUR for n in r.timings)
    ]
    if not shared:
        return
    ratios = [ratios_of(result) for result in shared]
    low, high = (
        min(min(each.values()) for each in ratios),
        max(max(each.values()) for each in ratios),
    )
    floor = low / 2
    with mpl.rc_context(STYLE):
        heights = [len(result.timings) + 1 for result in shared]
        figure, panels = plt.subplots(
            len(shared),
            sharex=True,
            squeeze=False,
            figsize=(8, 0.19 * sum(heights) + 0.6),
            height_ratios=heights,
            layout="constrained",
        )
        for axes, result, bars in zip(panels[:, 0], shared, ratios, strict=True):
            colors = [color(name, result.yardstick) for name in bars]
            axes.barh(
                list(bars), [ratio - floor for ratio in bars.values()], left=floor, color=colors
            )
            axes.set_xscale("log")
            # Room on the right for the words beside the longest bar.
            axes.set_xlim(floor, high * (high / floor) ** 0.3)
            axes.axvline(1.0, color=OWN_COLOUR, linewidth=0.8, zorder=0)
            axes.set_title(result.row.title)
            axes.xaxis.set_major_formatter(lambda ratio, _: f"{ratio:g} x")
            axes.tick_params(axis="x", which="both", bottom=axes is panels[-1, 0])
            axes.spines["bottom"].set_visible(axes is panels[-1, 0])
            for place, (name, ratio) in enumerate(bars.items()):
                time = time_of(result.timings[name].median, result.row.task in BATCHES)
                words = f"{number(ratio)} x, {time}"
                box = {"facecolor": "white", "edgecolor": "none", "pad": 0.5}
                axes.text(ratio * 1.1, place, words, va="center", fontsize=7, bbox=box)
        panels[-1, 0].set_xlabel("time relative to irbkin, median of the rounds")
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, metadata={"Date": None})
        plt.close(figure)
    # matplotlib writes a line for each point, and leaves blanks at the ends of lines.
    svg = re.sub(r'"[^"]*"', lambda text: " ".join(text[0].split()), path.read_text())
    path.write_text("\n".join(line.rstrip() for line in svg.splitlines()) + "\n")
