"""Triangles as points: pieces of the surface, the inside, and distances from the surface."""

import numpy as np
import numpy.typing as npt
from scipy.ndimage import map_coordinates  # type: ignore[import-untyped]
from scipy.spatial import cKDTree  # type: ignore[import-untyped]

from irbkin.errors import InvalidModelError

Array = npt.NDArray[np.float64]

# Longest edge of a piece, over the size of the solid [1].
LONGEST = 1 / 16
# Cells of the grid of distances along the longest side.
CELLS = 32
# How far the grid goes beyond the solid, over its size [1].
BEYOND = 0.2
# Points of the surface from which distances are measured.
POINTS = 30_000


class Solid:
    """The triangles of a link, shape (n, 3, 3), in its frame [m]."""

    def __init__(self, triangles: Array) -> None:
        if not np.isfinite(triangles).all():
            raise InvalidModelError("a corner of a triangle is not finite")
        if not doubled_areas(triangles).any():
            raise InvalidModelError("the triangles have no area")
        self.triangles = triangles
        corners = triangles.reshape(-1, 3)
        self.size = float(np.ptp(corners, axis=0).max())
        self.tree = cKDTree(spread_over(triangles, POINTS))
        low = corners.min(axis=0) - BEYOND * self.size
        high = corners.max(axis=0) + BEYOND * self.size
        self.cell, self.low = (high - low).max() / CELLS, low
        axes = [np.arange(a, b + self.cell, self.cell) for a, b in zip(low, high, strict=True)]
        grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        apart = self.tree.query(grid.reshape(-1, 3))[0].reshape(grid.shape[:3])
        is_inside = inside(triangles, axes)
        self.grid = np.where(is_inside, -apart, apart)
        # Pieces of the surface, and the points inside as pieces of no size: numbers of their
        # corners.
        pieces = halved(triangles, LONGEST * self.size).reshape(-1, 3)
        inner = grid[is_inside]
        self.points, numbers = np.unique(pieces, axis=0, return_inverse=True)
        alone = np.repeat(len(self.points) + np.arange(len(inner)), 3)
        self.pieces = np.concatenate([numbers.ravel(), alone]).reshape(-1, 3)
        self.points = np.concatenate([self.points, inner])

    def corners(self, chosen: npt.NDArray[np.bool_]) -> Array:
        is_corner = np.zeros(len(self.points), bool)
        is_corner[self.pieces[chosen]] = True
        return self.points[is_corner]

    def signed(self, points: Array) -> Array:
        """Distances from the surface by the grid, less than zero inside."""
        places = ((points - self.low) / self.cell).T
        return np.asarray(map_coordinates(self.grid, places, order=1, mode="nearest"))


def halved(triangles: Array, longest: float) -> Array:
    """Halve triangles along their longest edge until none is longer."""
    done = []
    while len(triangles):
        edges = np.linalg.norm(triangles - np.roll(triangles, -1, axis=1), axis=2)
        is_short = edges.max(axis=1) <= longest
        done.append(triangles[is_short])
        rest, edges = triangles[~is_short], edges[~is_short]
        order = (edges.argmax(axis=1)[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(rest, order[:, :, None], axis=1).transpose(1, 0, 2)
        middle = (a + b) / 2
        triangles = np.concatenate([np.stack([a, middle, c], 1), np.stack([middle, b, c], 1)])
    return np.concatenate(done)


def doubled_areas(triangles: Array) -> Array:
    a, b, c = triangles.transpose(1, 0, 2)
    return np.asarray(np.linalg.norm(np.cross(b - a, c - a), axis=1))


def spread_over(triangles: Array, count: int) -> Array:
    rng = np.random.default_rng(0)
    a, b, c = triangles.transpose(1, 0, 2)
    area = doubled_areas(triangles)
    chosen = rng.choice(len(area), count, p=area / area.sum())
    u, v = np.sqrt(rng.uniform(size=count))[:, None], rng.uniform(size=count)[:, None]
    return np.asarray(a[chosen] * (1 - u) + b[chosen] * u * (1 - v) + c[chosen] * u * v)


def inside(triangles: Array, axes: list[Array]) -> npt.NDArray[np.bool_]:
    """Which points of a grid are inside closed triangles: an odd number of them is below.

    A line that meets an odd number, as where they are not closed, has no point inside.
    """
    x, y, z = axes
    found = np.zeros((len(x), len(y), len(z)), bool)
    # Lines a little beside the grid meet no edge that lies in it.
    x, y = x + 1.1e-6 * (x[1] - x[0]), y + 2.3e-6 * (y[1] - y[0])
    a, b, c = triangles.transpose(1, 0, 2)
    twice = (b - a)[:, 0] * (c - a)[:, 1] - (c - a)[:, 0] * (b - a)[:, 1]
    upright = np.abs(twice) <= 1e-18
    a, b, c, twice = a[~upright], b[~upright], c[~upright], twice[~upright]
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    for i, at in enumerate(x):
        near = (low[:, 0] <= at) & (high[:, 0] >= at)
        first, one, two = a[near], (b - a)[near], (c - a)[near]
        p, q = at - first[:, 0], y[:, None] - first[:, 1]
        u = (p * two[:, 1] - two[:, 0] * q) / twice[near]
        v = (one[:, 0] * q - p * one[:, 1]) / twice[near]
        is_hit = (u >= 0) & (v >= 0) & (u + v <= 1)
        heights = first[:, 2] + u * one[:, 2] + v * two[:, 2]
        for j in range(len(y)):
            met = np.sort(heights[j, is_hit[j]])
            if len(met) % 2 == 0:
                found[i, j] = np.searchsorted(met, z) % 2 == 1
    return found
