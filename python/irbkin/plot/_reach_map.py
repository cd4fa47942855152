"""A slice of a map of reach."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from irbkin._grids import ReachMap
from irbkin.plot._style import FONT, MANY, canvas, edges_of, scale, tidy, two_of, whole

if TYPE_CHECKING:
    from typing import Literal

    from matplotlib.figure import Figure

    from irbkin.plot._style import Canvas

NAMES = ("x", "y", "z")
QUANTITIES = {
    "share": "orientations that are reached [%]",
    "solutions": "solutions of an orientation, in the mean",
    "margin": "smallest margin",
    "singularities": "smallest distance from singularities",
}


def reach_map(
    found: ReachMap,
    quantity: Literal["share", "solutions", "margin", "singularities"] = "share",
    *,
    across: tuple[Literal["x", "y", "z"], Literal["x", "y", "z"]] = ("x", "z"),
    at: float | None = None,
    figure: Canvas | None = None,
) -> Figure:
    """Draw a slice of a map. Where no orientation is reached, it is white.

    Args:
        found: The map, of `irbkin.map.reach`.
        quantity: What is drawn: the share of the orientations that are reached, the mean number of
            solutions of an orientation, the smallest margin or the smallest distance from
            singularities of those that are reached.
        across: The axes of the slice.
        at: Where the slice is along the third axis [m]: the nearest position of the map; the middle
            one when not given.
        figure: Where to draw; a new figure if not given.

    Returns:
        The figure: axes in m.

    Raises:
        TypeError: `found` is not a ReachMap.
        ValueError: Another quantity, or `across` is not two axes.
    """
    if not isinstance(found, ReachMap):
        raise TypeError(f"found must be a ReachMap, got {type(found).__name__}")
    if quantity not in QUANTITIES:
        raise ValueError(f"quantity must be one of {tuple(QUANTITIES)}, got {quantity!r}")
    first, second = two_of(NAMES, across)
    third = 3 - first - second
    places = (found.x, found.y, found.z)
    middle = len(places[third]) // 2
    index = middle if at is None else int(np.argmin(np.abs(places[third] - at)))
    values = {
        "share": 100.0 * found.share,
        "solutions": found.solutions / len(found.orientations),
        "margin": found.margin,
        "singularities": found.singularities,
    }[quantity]
    cut = np.where(found.reached > 0, values, np.nan).take(index, axis=third)
    cut = cut.T if first < second else cut
    drawn = canvas(figure, 5.6, 4.6)
    axes = drawn.subplots()
    edges = [edges_of(places[it]) for it in (first, second)]
    most = 100.0 if quantity == "share" else None
    shown = np.ma.masked_invalid(cut)
    colors = axes.pcolormesh(*edges, shown, cmap=MANY, vmin=0.0, vmax=most, rasterized=True)
    tidy(axes)
    axes.set_aspect("equal")
    axes.set_xlabel(f"{across[0]} [m]", fontsize=FONT)
    axes.set_ylabel(f"{across[1]} [m]", fontsize=FONT)
    axes.set_title(f"{NAMES[third]} = {places[third][index]:.3f} m", fontsize=FONT)
    scale(drawn, axes, colors, QUANTITIES[quantity])
    return whole(drawn)
