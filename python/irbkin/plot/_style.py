"""The style of the pictures: colors, line styles, the look of axes."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure

from irbkin._arrays import Floats
from irbkin.plot._picture import Picture

Canvas = Figure | SubFigure

# Okabe and Ito's colors, which color-blind readers can tell apart.
COLORS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#000000")
VERMILION = COLORS[4]
BLACK = COLORS[6]
# With them, so that black and white does: solid, dashed, dash-dot, dotted, ...
DASHES: tuple[Any, ...] = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (2, 1)), (0, (9, 2)))
SHADE = "#f6d5c5"
FONT = 9


def line_style(index: int) -> dict[str, Any]:
    """The color and the dashes of joint `index`, from 0."""
    index %= len(COLORS)
    return {"color": COLORS[index], "linestyle": DASHES[index], "linewidth": 1.6}


def canvas(figure: Canvas | None, width: float, height: float) -> Canvas:
    """The figure that is given, or a new one of a size [inch]."""
    return Picture(figsize=(width, height), layout="constrained") if figure is None else figure


def whole(figure: Canvas) -> Figure:
    """The figure that a subfigure is in."""
    top = figure.get_figure(root=True)
    assert isinstance(top, Figure)
    return top


def tidy(axes: Axes) -> None:
    axes.grid(visible=True, color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=FONT)


def legend(drawn: Canvas, axes: Axes, columns: int, size: int = FONT) -> None:
    """Give a figure the legend of one of its axes, below it."""
    handles, labels = axes.get_legend_handles_labels()
    place: Any = {"loc": "outside lower center", "ncols": columns, "frameon": False}
    drawn.legend(handles, labels, fontsize=size, handlelength=3.2, **place)


def shade(axes: Axes, bounds: Floats) -> None:
    """Shade what is beyond limits, lower and upper, so that both are in view."""
    shown = [*axes.get_ylim(), *bounds[np.isfinite(bounds)]]
    margin = 0.1 * (max(shown) - min(shown)) if np.isfinite(bounds).any() else 0.0
    edges = min(shown) - margin, max(shown) + margin
    for limit, edge in zip(bounds, edges, strict=True):
        if np.isfinite(limit):
            axes.axhspan(min(limit, edge), max(limit, edge), color=SHADE, linewidth=0, zorder=0.5)
            axes.axhline(limit, color=VERMILION, linewidth=0.9, linestyle="--")
    axes.set_ylim(*edges)


def along_x(axes: Axes, along: Floats, words: str) -> None:
    """Give the lowest axes the label and the range of what panels share."""
    axes.set_xlabel(words, fontsize=FONT)
    axes.set_xlim(along[0], along[-1] if along[-1] > along[0] else along[0] + 1.0)
