"""A region as a grid of bases, and steps around one of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
import numpy.typing as npt

from irbkin import Robot
from irbkin._arrays import Floats, rotations
from irbkin._grids import Region
from irbkin.errors import InvalidPoseError

FIELDS = ("x", "y", "z", "turn")
MOST_BASES = 10**7


@dataclass(frozen=True, slots=True)
class Bases:
    """The bases of a region: x, y, z [m] and turn [rad] each."""

    low: Floats
    high: Floats
    steps: tuple[int, ...]
    """Values across each coordinate."""
    start: Floats
    """From which positions are given, with the orientation of the base, shape (4, 4)."""
    mounting: Floats
    """Orientation of the base where the turn is zero, shape (4, 4)."""

    @classmethod
    def of(
        cls,
        region: Region,
        steps: int | Sequence[int],
        frame: npt.ArrayLike | None,
        robot: Robot,
    ) -> Bases:
        """Read a region; an InvalidPoseError for a range or steps that are none."""
        if not isinstance(region, Region):
            raise InvalidPoseError(
                f"region must be a Region, got {region!r}: give Region(x=(lower, upper), ...)"
            )
        ranges = np.array([_range(name, getattr(region, name)) for name in FIELDS])
        low, high = ranges.T
        if high[3] - low[3] > 2 * np.pi + 1e-9:
            raise InvalidPoseError(
                f"region.turn is {region.turn}, more than a full turn (did you pass degrees?)"
            )
        counts = tuple(steps) if isinstance(steps, Sequence) else (steps,) * 4
        if len(counts) != 4 or any(not isinstance(n, int) or n < 1 for n in counts):
            raise InvalidPoseError(f"steps must be 1 or more, or four such numbers, got {steps!r}")
        counts = tuple(n if b > a else 1 for n, a, b in zip(counts, low, high, strict=True))
        if np.prod(counts, dtype=float) > MOST_BASES:
            raise InvalidPoseError(f"steps {counts} are more than {MOST_BASES} bases")
        mounting = np.eye(4)
        mounting[:3, :3] = robot.base[:3, :3]
        start = np.eye(4)
        if frame is not None:
            try:
                start = robot.with_base(frame).base
            except InvalidPoseError as fault:
                raise InvalidPoseError(f"frame: {fault}") from None
        return cls(low, high, counts, start, mounting)

    @property
    def is_full_turn(self) -> bool:
        """Whether the turns go all around."""
        return bool(self.high[3] - self.low[3] > 2 * np.pi - 1e-9)

    def axes(self) -> list[Floats]:
        """The values of each coordinate on the grid."""
        ends = [True, True, True, not self.is_full_turn]
        return [
            np.linspace(a, b, n, endpoint=end) if n > 1 else np.array([0.5 * (a + b)])
            for a, b, n, end in zip(self.low, self.high, self.steps, ends, strict=True)
        ]

    def grid(self) -> Floats:
        """Every base of the grid, shape (k, 4)."""
        axes = np.meshgrid(*self.axes(), indexing="ij")
        return np.stack(axes, axis=-1).reshape(-1, 4)

    def spacing(self) -> Floats:
        """The distance of neighbors on the grid, shape (4,); half the range of one value."""
        width = self.high - self.low
        count = np.array(self.steps) - np.array([1, 1, 1, 0 if self.is_full_turn else 1])
        return np.where(count > 0, width / np.maximum(count, 1), width / 2)

    def around(self, values: Floats, step: Floats) -> Floats:
        """The neighbors of a base, one step along each coordinate or several, shape (k, 4)."""
        free = np.flatnonzero(self.high > self.low)
        moves = np.zeros((3 ** len(free), 4))
        moves[:, free] = list(product((0.0, -1.0, 1.0), repeat=len(free)))
        near = values + moves[1:] * step
        if self.is_full_turn:
            near[:, 3] = self.low[3] + (near[:, 3] - self.low[3]) % (2 * np.pi)
        near = np.clip(near, self.low, self.high)
        return np.asarray(near[(near != values).any(axis=1)])

    def poses(self, values: Floats) -> Floats:
        placed = rotations(2, values[:, 3])
        placed[:, :3, 3] = values[:, :3]
        return self.start @ placed @ self.mounting


def _range(name: str, given: float | tuple[float, float]) -> tuple[float, float]:
    try:
        ends = np.broadcast_to(np.asarray(given, dtype=float), 2)
    except (TypeError, ValueError) as fault:
        raise InvalidPoseError(
            f"region.{name} must be a number or a pair (lower, upper), got {given!r}"
        ) from fault
    low, high = ends.tolist()
    if not (np.isfinite(ends).all() and low <= high):
        raise InvalidPoseError(
            f"region.{name} is {given!r}: lower and upper must be finite, in this order"
        )
    return low, high
