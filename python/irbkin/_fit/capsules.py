"""Capsules that contain a solid, so that little of them is outside.

Each piece of the surface is shorter than a given length and belongs to one capsule, which contains
its corners. Both are convex, so the capsule contains the piece, and the capsules the surface. Which
piece belongs to which capsule is found in turns: a capsule is fitted to its pieces, then each piece
goes to the capsule that it is deepest in. At the end a capsule is fitted anew to the pieces that no
other contains.

A ball of radius r whose center is at depth d reaches r - d beyond the surface, so a capsule reaches
as far as r + the largest signed distance on its axis. That is made small, by the axis and the
radius: with a direction, a point and a radius given, the shortest axis follows from the points.
"""

import numpy as np
import numpy.typing as npt
from scipy.optimize import minimize  # type: ignore[import-untyped]
from scipy.spatial import ConvexHull, QhullError  # type: ignore[import-untyped]

from irbkin._fit.solid import Array, Solid

# Turns of capsules and pieces, at most, and of capsules fitted anew.
TURNS, AGAIN = 6, 3
# Starts, of which the best is kept: how much the distance along the longest principal axis counts
# where the surface is first divided [1]. Little gives capsules that lie side by side, long and
# overlapping.
STARTS = (0.3, 0.1, 1.0, 0.3, 0.1, 0.3)
# Values of a capsule's cost in a turn, and at the end.
VALUES = (40, 150)
# By how much more a capsule of the same reach costs for its volume [1].
VOLUME = 0.05
# Points of the surface of capsules by which an excess is measured.
POINTS = 2000
# Part of the surface that is at most as far outside as the excess [1].
PART = 0.95
# Points of an axis at which its depth is looked up, as parts of its length.
ALONG = np.linspace(0, 1, 9)[:, None]


def fitted(solid: Solid, excess: float | None, most: int) -> tuple[Array, float]:
    """Capsules that contain a solid, shape (k, 7), and how far outside 95 % of them are at most.

    The fewest that are within `excess`, else the best of so many at most.
    """
    best: tuple[Array, float] | None = None
    for count in [most] if excess is None else range(1, most + 1):
        rng = np.random.default_rng(count)
        for stretch in STARTS if count > 1 else STARTS[:1]:
            rows = started(solid, count, stretch, rng)
            outside = excess_of(solid, rows, rng)
            if best is None or outside < best[1]:
                best = rows, outside
        if excess is not None and best is not None and best[1] <= excess:
            break
    assert best is not None
    return best


def started(solid: Solid, count: int, stretch: float, rng: np.random.Generator) -> Array:
    middles = solid.points[solid.pieces].mean(axis=1)
    longest = axes_of(solid.points)[2]
    owner = split(middles - (1 - stretch) * np.outer(middles @ longest, longest), count, rng)
    rows: list[Array] = []
    for turn in range(TURNS + 1):
        owners = np.unique(owner)
        starts = [rows[one] if rows else None for one in owners]
        rows = [
            least(solid.corners(owner == one), solid, start, VALUES[turn == TURNS])
            for one, start in zip(owners, starts, strict=True)
        ]
        # The last capsules contain what they were fitted to.
        owner = np.argmin([depths(row, solid) for row in rows], axis=0)
    for _ in range(AGAIN):
        if not refitted(rows, solid, rng):
            break
    return np.array(rows)


def refitted(rows: list[Array], solid: Solid, rng: np.random.Generator) -> bool:
    """Fit each capsule to the pieces that no other contains; return whether one became better."""
    within = np.array([depths(row, solid) <= 0 for row in rows])
    is_better = False
    for one in rng.permutation(len(rows)):
        left: npt.NDArray[np.bool_] = ~np.any(np.delete(within, one, axis=0), axis=0)
        if not left.any():
            continue
        row = least(solid.corners(left), solid, rows[one], VALUES[1])
        if cost(row, solid) < 0.999 * cost(rows[one], solid):
            rows[one], within[one], is_better = row, depths(row, solid) <= 0, True
    return is_better


def split(points: Array, count: int, rng: np.random.Generator) -> npt.NDArray[np.intp]:
    """The nearest of some points for each, drawn far from each other (k-means++)."""
    square = np.full(len(points), np.inf)
    nearest = np.zeros(len(points), np.intp)
    for number in range(count):
        weights = None if number == 0 else square / square.sum()
        off = ((points - points[rng.choice(len(points), p=weights)]) ** 2).sum(axis=1)
        nearest[off < square] = number
        square = np.minimum(square, off)
    return nearest


def least(points: Array, solid: Solid, start: Array | None, values: int) -> Array:
    """The capsule of small cost that contains points, near a principal axis or one given."""
    hull = hull_of(points)
    corners = points if hull is None else points[hull.vertices]
    middle, size = corners.mean(axis=0), max(np.ptp(corners, axis=0).max(), 1e-6)
    lines = [np.concatenate([middle, way]) for way in axes_of(corners)]
    if start is not None and np.any(start[:3] != start[3:6]):
        lines.append(np.concatenate([(start[:3] + start[3:6]) / 2, unit(start[3:6] - start[:3])]))
    line = min(lines, key=lambda line: cost(around(corners, line, 0.1), solid))
    across = np.linalg.svd(line[None, 3:])[2][1:]

    def capsule(x: Array) -> Array:
        moved = [line[:3] + size * x[:2] @ across, unit(line[3:] + x[2:4] @ across)]
        return around(corners, np.concatenate(moved), abs(x[4]))

    first = np.array([0, 0, 0, 0, 0.1])
    simplex = np.vstack([first, first + np.diag([0.08, 0.08, 0.08, 0.08, 0.15])])
    options = {"maxfev": values, "initial_simplex": simplex}
    found = minimize(
        lambda x: cost(capsule(x), solid), first, method="Nelder-Mead", options=options
    )
    row = capsule(found.x)
    # More than the rounding of what is compared with it.
    row[6] += 1e-9 * (1 + size)
    return row


def around(points: Array, line: Array, more: float) -> Array:
    """The capsule on a line that contains points, of more than the least radius by a part.

    The axis must pass each point's foot within sqrt(radius^2 - distance^2).
    """
    off = points - line[:3]
    along = off @ line[3:]
    square = np.maximum((off * off).sum(axis=1) - along**2, 0)
    radius = max(np.sqrt(square.max()) * (1 + more), 1e-6)
    inset = np.sqrt(radius**2 - square)
    low, high = (along + inset).min(), (along - inset).max()
    if low > high:
        low = high = (low + high) / 2
    ends = line[:3] + np.array([[low], [high]]) * line[3:]
    return np.array([*ends.ravel(), radius])


def cost(row: Array, solid: Solid) -> float:
    """How far a capsule reaches beyond a solid, and a little for its volume [m]."""
    axis, radius = row[3:6] - row[:3], row[6]
    volume = np.pi * radius**2 * (np.linalg.norm(axis) + 4 / 3 * radius)
    deepest = solid.signed(row[:3] + ALONG * axis).max()
    return float(radius + deepest + VOLUME * np.cbrt(volume))


def distances(points: Array, row: Array) -> Array:
    axis = row[3:6] - row[:3]
    length = axis @ axis
    along = (points - row[:3]) @ axis
    part = np.clip(along / length, 0, 1) if length > 0 else 0 * along
    off = points - row[:3] - part[:, None] * axis
    return np.asarray(np.sqrt((off * off).sum(axis=1)))


def depths(row: Array, solid: Solid) -> Array:
    """How far the farthest corner of each piece is outside a capsule, not above zero inside."""
    off = distances(solid.points, row) - row[6]
    return np.asarray(off[solid.pieces].max(axis=1))


def excess_of(solid: Solid, rows: Array, rng: np.random.Generator) -> float:
    """How far outside the solid 95 % of the outer surface of capsules are at most [m]."""
    lengths = np.linalg.norm(rows[:, 3:6] - rows[:, :3], axis=1)
    areas = (lengths + 2 * rows[:, 6]) * rows[:, 6]
    outer = []
    for one, row in enumerate(rows):
        count = int(np.ceil(POINTS * areas[one] / areas.sum()))
        axis = row[3:6] - row[:3]
        way = unit(rng.normal(size=(count, 3)))
        along = unit(axis) if lengths[one] > 0 else np.array([0.0, 0.0, 1.0])
        ends = np.where((way @ along > 0)[:, None], row[3:6], row[:3])
        side = unit(way - (way @ along)[:, None] * along)
        is_side = rng.uniform(size=count) * (lengths[one] + 2 * row[6]) < lengths[one]
        middle = row[:3] + rng.uniform(size=(count, 1)) * axis
        points = np.where(is_side[:, None], middle + row[6] * side, ends + row[6] * way)
        others = np.delete(rows, one, axis=0)
        is_outer = [distances(points, other) >= other[6] for other in others]
        outer.append(points[np.all(is_outer, axis=0)] if is_outer else points)
    return float(np.quantile(solid.tree.query(np.concatenate(outer))[0], PART))


def axes_of(points: Array) -> Array:
    off = points - points.mean(axis=0)
    return np.linalg.eigh(off.T @ off)[1].T


def hull_of(points: Array) -> ConvexHull | None:
    """The convex hull; None where it has no volume."""
    try:
        return ConvexHull(points)
    except (QhullError, ValueError):
        return None


def unit(ways: Array) -> Array:
    lengths = np.linalg.norm(ways, axis=-1, keepdims=True)
    return np.asarray(ways / np.maximum(lengths, 1e-300))
