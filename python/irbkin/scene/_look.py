"""The look of arms in pictures and windows: the direction of the eye, the colors of links."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from irbkin._arrays import Floats

# Seen from the front on the right, from above.
AZIMUTH, ELEVATION = np.radians([-29.0, 20.0])
SIDEWAYS = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
UPWARD = np.array(
    [
        -np.sin(ELEVATION) * np.cos(AZIMUTH),
        -np.sin(ELEVATION) * np.sin(AZIMUTH),
        np.cos(ELEVATION),
    ]
)
TOWARD = np.cross(SIDEWAYS, UPWARD)
BASE, LINKS = "#5b6470", ("#e8912d", "#f3ae5c")
"""Colors of the base, and of the links in turn."""


def link_color(link: int) -> str:
    """Return the color of a link, of which 0 is the base."""
    return BASE if link == 0 else LINKS[link % 2]


def on_paper(points: Floats) -> Floats:
    """Project points of the world, shape (..., 3), to the paper, (..., 2)."""
    drawn: Floats = points @ np.column_stack([SIDEWAYS, UPWARD])
    return drawn


def nearness(points: Floats) -> Floats:
    """Return how near points are to the eye [m], shape (...): far ones are drawn first."""
    near: Floats = points @ TOWARD
    return near
