"""The style of the pictures: colors, line styles, the look of axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.figure import Figure, SubFigure

from irbkin.plot._picture import Picture

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes

    from irbkin import Robot
    from irbkin._arrays import Floats

Canvas = Figure | SubFigure

# Okabe and Ito's colors, which color-blind readers can tell apart.
COLORS = ("#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#000000")
BLUE, ORANGE, GREEN, PURPLE, VERMILION, SKY, BLACK = COLORS
# With them, so that black and white does: solid, dashed, dash-dot, dotted, ...
DASHES: tuple[Any, ...] = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (2, 1)), (0, (9, 2)))
SHADE = "#f6d5c5"
AXIS_COLORS = ("#d62728", "#2ca02c", "#1f77b4")
"""x, y and z of a frame."""
MANY = "viridis_r"
"""Colors of a quantity in all pictures: the darker, the more."""
FONT = 9
# Half the width of a cell that has no neighbors.
ALONE = 0.05


def line_style(index: int) -> dict[str, Any]:
    """The color and the dashes of joint `index`, from 0."""
    index %= len(COLORS)
    return {"color": COLORS[index], "linestyle": DASHES[index], "linewidth": 1.6}


def canvas(
    figure: Canvas | None,
    width: float,
    height: float,
    layout: Literal["constrained"] | None = "constrained",
) -> Canvas:
    """The figure that is given, or a new one of a size [inch]."""
    return Picture(figsize=(width, height), layout=layout) if figure is None else figure


def whole(figure: Canvas) -> Figure:
    """The figure that a subfigure is in."""
    top = figure.get_figure(root=True)
    assert isinstance(top, Figure)
    return top


def title(axes: Axes, robot: Robot, words: str = "") -> None:
    """Give axes the name of an arm, and words behind it."""
    name = robot.name or f"{robot.dof} joints"
    axes.set_title(f"{name}, {words}" if words else name, fontsize=FONT)


def tidy(axes: Axes) -> None:
    """Give axes the look of all pictures."""
    axes.grid(visible=True, color="#dddddd", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(labelsize=FONT)


def legend(drawn: Canvas, axes: Axes, columns: int, size: int = FONT) -> None:
    """Give a figure the legend of one of its axes, below it."""
    handles, labels = axes.get_legend_handles_labels()
    place: Any = {"loc": "outside lower center", "ncols": columns, "frameon": False}
    drawn.legend(handles, labels, fontsize=size, handlelength=3.2, **place)


def scale(drawn: Canvas, axes: Axes, colors: Any, words: str, **options: Any) -> None:
    """Give axes the scale of their colors."""
    bar = drawn.colorbar(colors, ax=axes, shrink=0.9, **options)
    bar.set_label(words, fontsize=FONT)
    bar.ax.tick_params(labelsize=FONT)


def arrow(axes: Axes, ends: Floats, color: str, width: float, room: float = 0.0) -> Any:
    """Add an arrow from one point to the other, shape (2, 2), with room at its ends [pt]."""
    look: dict[str, Any] = {"arrowstyle": "-|>", "color": color, "linewidth": width}
    look |= {"shrinkA": room, "shrinkB": 0.0}
    (x, y), head = ends.tolist()
    return axes.annotate("", head, (x, y), arrowprops=look, zorder=4)


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


def two_of(names: Sequence[str], across: Sequence[str]) -> tuple[int, int]:
    """The places of two names.

    Raises:
        ValueError: They are not two of them.
    """
    if len(across) != 2 or across[0] == across[1] or not {*across} <= {*names}:
        raise ValueError(f"across must be two of {names}, got {across!r}")
    return names.index(across[0]), names.index(across[1])


def edges_of(values: Floats) -> Floats:
    """The edges of cells around even values."""
    half = 0.5 * (values[1] - values[0]) if len(values) > 1 else ALONE
    edges: Floats = np.r_[values - half, values[-1] + half]
    return edges
