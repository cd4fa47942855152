"""The look of scenes in pictures and windows: the direction of the eye, and colors."""

import numpy as np

from irbkin._arrays import Floats

# Seen from the front on the right, from above.
AZIMUTH, ELEVATION = np.radians([-29.0, 20.0])
SIDEWAYS = np.array([-np.sin(AZIMUTH), np.cos(AZIMUTH), 0.0])
LEVEL = np.array([np.cos(AZIMUTH), np.sin(AZIMUTH), 0.0])
UPWARD = np.cos(ELEVATION) * np.array([0.0, 0.0, 1.0]) - np.sin(ELEVATION) * LEVEL
TOWARD = np.cross(SIDEWAYS, UPWARD)
LIGHT = SIDEWAYS * -0.35 + UPWARD * 0.75 + TOWARD * 0.56
"""The direction to the light, of length 1."""
BASE, LINKS, CARRIED = "#5b6470", ("#e8912d", "#f3ae5c"), "#6f7a88"
"""Colors of the base, of the links in turn, and of what the flange carries."""


def link_color(link: int) -> str:
    """Return the color of a link, of which 0 is the base."""
    return BASE if link == 0 else LINKS[link % 2]


def toned(color: str, lighter: float) -> str:
    """Return a color mixed with white, or with black if it is to be darker."""
    own = np.array(list(bytes.fromhex(color[1:])))
    mixed = (1 - abs(lighter)) * own + 255 * max(lighter, 0.0)
    return "#" + bytes(mixed.round().astype(int).tolist()).hex()


def on_paper(points: Floats) -> Floats:
    """Project points of the world, shape (..., 3), to the paper, (..., 2)."""
    return np.asarray(points @ np.column_stack([SIDEWAYS, UPWARD]))


def nearness(points: Floats) -> Floats:
    """Return how near points are to the eye [m], shape (...): far ones are drawn first."""
    return points @ TOWARD
