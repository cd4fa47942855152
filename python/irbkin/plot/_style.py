"""The style of the pictures: colors, line styles, the look of axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from matplotlib.figure import Figure, SubFigure

from irbkin.plot._picture import Picture

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from irbkin import Robot
    from irbkin._arrays import Floats

Canvas = Figure | SubFigure

# Okabe and Ito's colors, which color-blind readers can tell apart.
BLUE, ORANGE, GREEN, PURPLE, VERMILION, SKY, BLACK = COLORS = (
    "#0072b2",
    "#e69f00",
    "#009e73",
    "#cc79a7",
    "#d55e00",
    "#56b4e9",
    "#000000",
)
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


def edges_of(values: Floats) -> Floats:
    """The edges of cells around even values."""
    half = 0.5 * (values[1] - values[0]) if len(values) > 1 else ALONE
    edges: Floats = np.r_[values - half, values[-1] + half]
    return edges
