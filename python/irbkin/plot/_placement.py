"""The bases that were tried, from above or from the side."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import ListedColormap

from irbkin._arrays import as_array
from irbkin._grids import Placement
from irbkin.errors import InvalidPoseError
from irbkin.plot import _style
from irbkin.plot._style import BLACK, FONT, MANY, VERMILION, canvas, tidy, whole

if TYPE_CHECKING:
    from typing import Literal

    import numpy.typing as npt
    from matplotlib.figure import Figure

    from irbkin._arrays import Floats
    from irbkin._grids import BaseGrid
    from irbkin.plot._style import Canvas

NAMES = ("x", "y", "z", "turn")
# The length of the arrow of the base as a part of the picture.
ARROW = 0.12


def placement(
    found: Placement,
    T: npt.ArrayLike | None = None,
    *,
    across: tuple[Literal["x", "y", "z", "turn"], Literal["x", "y", "z", "turn"]] = ("x", "y"),
    figure: Canvas | None = None,
) -> Figure:
    """Draw the bases of the grid: their margin in color or, where not all targets are reached, the
    share that is, in gray. A cell is the best over the other coordinates. The cross is the answer,
    an arrow its x axis.

    Args:
        found: The answer of `irbkin.placement.best_base`.
        T: The targets, shape (m, 4, 4), to be drawn as dots.
        across: Which coordinates of the region are drawn.
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: axes in m, turns in deg, in the frame of the region.

    Raises:
        TypeError: `found` is not a Placement.
        InvalidPoseError: `T` has a wrong shape.
        ValueError: `across` is not two coordinates.
    """
    if not isinstance(found, Placement):
        raise TypeError(f"found must be a Placement, got {type(found).__name__}")
    first, second = _style.two_of(NAMES, across)
    grid = found.grid
    drawn = canvas(figure, 5.6, 4.6)
    axes = drawn.subplots()
    edges = [_style.edges_of(_values(grid, name)) for name in (first, second)]
    share, margin = (_best(field, first, second) for field in (grid.reachable, grid.margin))
    gray = ListedColormap(colormaps["gray"](np.linspace(0.55, 1.0, 64))[::-1])
    short = np.ma.masked_array(share, mask=~np.isnan(margin))
    missed = axes.pcolormesh(*edges, short.T, cmap=gray, vmin=0.0, vmax=1.0, rasterized=True)
    colored = np.ma.masked_invalid(margin)
    room = axes.pcolormesh(*edges, colored.T, cmap=MANY, vmin=0.0, rasterized=True)
    if not np.isnan(margin).all():
        _style.scale(drawn, axes, room, "margin")
    if not short.mask.all():
        _style.scale(drawn, axes, missed, "share of the targets that is reached")
    to_region = np.linalg.inv(grid.frame)
    if T is not None and max(first, second) < 3:
        rows = to_region @ as_array(T, "T", (None, 4, 4), InvalidPoseError)
        dots = rows[:, [first, second], 3].T
        axes.plot(*dots, ".", color=BLACK, markersize=4, label="targets")
    base = to_region @ found.base
    turn = np.degrees(np.arctan2(base[1, 0], base[0, 0]))
    place = np.r_[base[:3, 3], turn][[first, second]]
    if max(first, second) < 3:
        size = max(abs(float(np.subtract(*axes.get_xlim()))), 1e-9)
        head = place + ARROW * size * base[[first, second], 0]
        _style.arrow(axes, np.array([place, head]), VERMILION, 1.4)
        axes.set_aspect("equal")
    axes.plot(*place, "x", color=VERMILION, markersize=9, markeredgewidth=2.0, label="best base")
    tidy(axes)
    for label, name in ((axes.set_xlabel, across[0]), (axes.set_ylabel, across[1])):
        label(f"{name} [{'deg' if name == 'turn' else 'm'}]", fontsize=FONT)
    _style.legend(drawn, axes, 2)
    return whole(drawn)


def _values(grid: BaseGrid, coordinate: int) -> Floats:
    """The values of a coordinate, as they are drawn."""
    values: Floats = getattr(grid, NAMES[coordinate])
    return np.degrees(values) if NAMES[coordinate] == "turn" else values


def _best(field: Floats, first: int, second: int) -> Floats:
    """The largest over the other coordinates."""
    others = tuple(axis for axis in range(4) if axis not in (first, second))
    best: Floats = np.fmax.reduce(np.fmax.reduce(field, axis=others[1]), axis=others[0])
    return best if first < second else best.T
