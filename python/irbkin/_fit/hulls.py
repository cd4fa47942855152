"""Convex hulls with a radius that contain a solid, closer to it than capsules.

Planes cut the solid into parts where that makes the hulls of the parts smaller. The hull of what is
on one side of a plane contains the section, whose edge is on the surface: so it contains the inside
of closed triangles too. Of the corners of a hull some are kept, always the one that is farthest
outside of those before; the radius is how far the others are from the hull of these at most.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt
from scipy.spatial import ConvexHull  # type: ignore[import-untyped]

from irbkin._fit.capsules import axes_of, hull_of, unit
from irbkin._fit.solid import Array, doubled_areas

# Hulls of a link, corners of a hull.
MOST, CORNERS = 6, 64
# By how much a cut must lessen the volume of all hulls [1].
GAIN = 0.04
# Where a part is cut, as parts of its extent along a principal axis.
CUTS = np.linspace(0, 1, 14)[1:-1]
# Triangles by which a plane is chosen, at most.
CHOOSING = 4000
# A radius that is small enough, as a length [m], and over the size of the solid [1].
ENOUGH = (0.001, 0.0025)
# More than the rounding of a radius, and half of the thickness of what has none [m].
ROUNDING, THICKNESS = 1e-8, 1e-6


class Part(NamedTuple):
    triangles: Array
    corners: Array
    volume: float


def parts_of(triangles: Array) -> list[Part]:
    parts = [part_of(triangles)]
    cuts = [best_cut(parts[0])]
    while len(parts) < MOST:
        one = max(range(len(parts)), key=lambda at: cuts[at][0])
        if cuts[one][0] <= GAIN * sum(part.volume for part in parts):
            break
        halves = cuts[one][1]
        parts[one : one + 1], cuts[one : one + 1] = halves, [best_cut(half) for half in halves]
    return parts


def part_of(triangles: Array) -> Part:
    points = np.unique(triangles.reshape(-1, 3), axis=0)
    hull = hull_of(points)
    if hull is None:
        return Part(triangles, points, 0.0)
    return Part(triangles, points[hull.vertices], float(hull.volume))


def best_cut(part: Part) -> tuple[float, list[Part]]:
    """By how much a plane chosen by the largest triangles lessens the volume [m^3], its halves."""
    largest = np.argsort(-doubled_areas(part.triangles), kind="stable")[:CHOOSING]
    some = part.triangles[largest]
    whole, best = part_of(some), 0.0
    plane: tuple[Array, float] | None = None
    for way in axes_of(part.corners) if whole.volume > 0 else []:
        heights = part.corners @ way
        for at in heights.min() + CUTS * np.ptp(heights):
            sides = [part_of(side) for side in clipped(some, way, at) if len(side)]
            gain = whole.volume - sum(side.volume for side in sides)
            if gain > best and len(sides) > 1:
                best, plane = gain, (way, at)
    if plane is None:
        return 0.0, []
    halves = [part_of(side) for side in clipped(part.triangles, *plane)]
    return part.volume - sum(half.volume for half in halves), halves


def clipped(triangles: Array, way: Array, at: float) -> tuple[Array, Array]:
    """Triangles on both sides of a plane; one that it meets is divided."""
    heights = triangles @ way - at
    is_above = heights > 0
    count = is_above.sum(axis=1)
    sides = [[triangles[count == 0]], [triangles[count == 3]]]
    for alone in (0, 1):
        # One corner is above (or below), the other two are not.
        chosen = count == (1 if alone else 2)
        rest, rest_heights = triangles[chosen], heights[chosen]
        first = (is_above[chosen] == bool(alone)).argmax(axis=1)
        order = (first[:, None] + np.arange(3)) % 3
        a, b, c = np.take_along_axis(rest, order[:, :, None], axis=1).transpose(1, 0, 2)
        ha, hb, hc = np.take_along_axis(rest_heights, order, axis=1).T[:, :, None]
        p, q = a + (b - a) * (ha / (ha - hb)), a + (c - a) * (ha / (ha - hc))
        sides[alone].append(np.stack([a, p, q], axis=1))
        sides[1 - alone] += [np.stack([p, b, c], axis=1), np.stack([p, c, q], axis=1)]
    below, above = (np.concatenate(side) for side in sides)
    return below, above


def rounded(points: Array) -> tuple[Array, npt.NDArray[np.intp], float]:
    """Some of the points, the faces of their hull, and the radius that contains all."""
    if hull_of(points) is None:
        # In a plane, on a line, or one point: as thick as need be.
        ways = THICKNESS * np.concatenate([np.eye(3), -np.eye(3)])
        points = (points[:, None] + ways).reshape(-1, 3)
        points = points[ConvexHull(points).vertices]
    enough = max(ENOUGH[0], ENOUGH[1] * np.ptp(points, axis=0).max())
    heights = points @ axes_of(points).T
    first = np.unique(np.concatenate([heights.argmin(axis=0), heights.argmax(axis=0)]))
    hull = ConvexHull(points[first], incremental=True)
    while True:
        planes = hull.equations
        outside = (points @ planes[:, :3].T + planes[:, 3]).max(axis=1)
        if outside.max() <= enough or len(hull.vertices) >= CORNERS:
            break
        hull.add_points(points[outside.argmax()][None])
    kept = hull.points[hull.vertices]
    return kept, *around(kept, points)


def around(kept: Array, points: Array) -> tuple[npt.NDArray[np.intp], float]:
    """The faces of the hull of some points, and how far others are from it at most."""
    hull = ConvexHull(kept)
    normals, offsets = hull.equations[:, :3], hull.equations[:, 3]
    a, b, c = kept[hull.simplices].transpose(1, 0, 2)
    is_turned = (np.cross(b - a, c - a) * normals).sum(axis=1) < 0
    faces = np.where(is_turned[:, None], hull.simplices[:, ::-1], hull.simplices)
    outer = points[(points @ normals.T + offsets > 0).any(axis=1)]
    apart = np.full(len(outer), np.inf)
    for corners in kept[faces]:
        apart = np.minimum(apart, from_triangle(outer, corners))
    return faces, float(apart.max(initial=0.0)) + ROUNDING


def from_triangle(points: Array, corners: Array) -> Array:
    least = np.full(len(points), np.inf)
    normal = np.cross(corners[1] - corners[0], corners[2] - corners[0])
    is_over = np.ones(len(points), bool)
    for one, two in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        edge, off = two - one, points - one
        part = np.clip(off @ edge / (edge @ edge), 0, 1)
        least = np.minimum(least, np.linalg.norm(off - part[:, None] * edge, axis=1))
        is_over &= off @ np.cross(normal, edge) >= 0
    height = np.abs((points - corners[0]) @ unit(normal))
    return np.where(is_over, np.minimum(least, height), least)
