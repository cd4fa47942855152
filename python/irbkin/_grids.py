"""Records of what is tried on a grid: bases, and positions of the tool."""

from os import PathLike
from typing import IO, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats
from irbkin._equality import by_value
from irbkin._files import write_columns
from irbkin._words import counted
from irbkin.records import Plan


class Region(NamedTuple):
    """Where a base may be: a box of positions, and a range of turns about z.

    A number fixes a coordinate, a pair is a range.
    """

    x: float | tuple[float, float] = 0.0
    """[m]"""
    y: float | tuple[float, float] = 0.0
    """[m]"""
    z: float | tuple[float, float] = 0.0
    """[m]"""
    turn: float | tuple[float, float] = 0.0
    """Angle about z [rad]. Of a full turn the upper end is the lower one."""


@by_value
class BaseGrid(NamedTuple):
    """The bases of the grid that were tried."""

    x: Floats
    """Positions along x [m], shape (i,)."""
    y: Floats
    """Positions along y [m], shape (j,)."""
    z: Floats
    """Positions along z [m], shape (k,)."""
    turn: Floats
    """Angles about z [rad], shape (l,)."""
    reachable: Floats
    """Share of the targets that are reached inside the limits, shape (i, j, k, l)."""
    margin: Floats
    """The smallest margin of all targets, shape (i, j, k, l). NaN where not all are reached, or
    where a path has no plan.
    """
    frame: Floats
    """The frame of these positions in the world, shape (4, 4)."""


@by_value
class Placement(NamedTuple):
    """Where a robot should stand."""

    base: Floats
    """The best base, shape (4, 4): `robot.with_base(base)`."""
    margin: float
    """The smallest margin of all targets there; NaN if they cannot all be reached."""
    reachable: float
    """Share of the targets that are reached there."""
    slack: Floats
    """The margin of each target, shape (m,); NaN where it is not reached."""
    q: Floats
    """Joint angles with that margin [rad], shape (m, 6); of a path, the joints of its plan. NaN
    where a target is not reached.
    """
    tool_angle: Floats
    """The angle that the tool is turned by [rad], shape (m,); zeros without a free rotation."""
    nowhere: tuple[int, ...]
    """The targets that are reached from no base that was tried."""
    plan: Plan | None
    """The plan of a path; None without `path` or without a plan."""
    grid: BaseGrid
    """The values of the grid."""
    reason: str
    """The outcome in a sentence."""

    def __repr__(self) -> str:
        """The outcome, and how many bases of the grid were tried."""
        return f"<Placement: {self.reason}; {self.grid.margin.size:,} bases on the grid>"


@by_value
class ReachMap(NamedTuple):
    """The reach of an arm: a grid of positions, each with every orientation."""

    x: Floats
    """Positions along x [m], shape (i,)."""
    y: Floats
    """Positions along y [m], shape (j,)."""
    z: Floats
    """Positions along z [m], shape (k,)."""
    orientations: Floats
    """Orientations of the tool, shape (o, 3, 3)."""
    reached: npt.NDArray[np.int64]
    """Number of orientations that are reached inside the limits and without a collision, shape (i,
    j, k).
    """
    solutions: npt.NDArray[np.int64]
    """Number of these solutions, all orientations together, shape (i, j, k)."""
    margin: Floats
    """The smallest margin of the orientations that are reached, the margin of an orientation being
    `IkMargin.margin`, shape (i, j, k). NaN where none is reached.
    """
    singularities: Floats
    """`IkMargin.singularities` in the same way: the worst distance from singularities."""

    @property
    def share(self) -> Floats:
        """Share of the orientations that are reached, shape (i, j, k)."""
        return self.reached / len(self.orientations)

    def to_dict(self) -> dict[str, npt.NDArray[Any]]:
        """Return the positions as columns, of which `pandas.DataFrame` and `polars.DataFrame` make
        a table.

        Returns:
            Arrays of shape (i * j * k,) by name, z the fastest: `x`, `y`, `z` [m]; `reached`,
            `share`, `solutions`, `margin`, `singularities`.
        """
        places = np.meshgrid(self.x, self.y, self.z, indexing="ij")
        names = ("reached", "share", "solutions", "margin", "singularities")
        columns = dict(zip("xyz", places, strict=True), **{it: getattr(self, it) for it in names})
        return {name: column.flatten() for name, column in columns.items()}

    def to_csv(self, path_or_file: str | PathLike[str] | IO[str]) -> None:
        """Write the columns of `to_dict`, separated by commas, under a line of their names.

        Args:
            path_or_file: A path, or a file that is open for text.

        Raises:
            OSError: It cannot be written.
        """
        write_columns(self.to_dict(), path_or_file)

    def __repr__(self) -> str:
        """The grid, how much of it is reached, and the best position."""
        axes, share = (self.x, self.y, self.z), self.share
        sizes = " x ".join(map(str, share.shape))
        ends = (
            f"{name} {axis[0]:g}" + (f" .. {axis[-1]:g}" if len(axis) > 1 else "")
            for name, axis in zip("xyz", axes, strict=True)
        )
        best = np.unravel_index(share.argmax(), share.shape)
        place = ", ".join(f"{axis[i]:g}" for axis, i in zip(axes, best, strict=True))
        some, every = np.count_nonzero(share), np.count_nonzero(share == 1)
        return (
            f"<ReachMap: {sizes} positions, {counted(len(self.orientations), 'orientation')} each\n"
            f"{', '.join(ends)} m\n"
            f"reached: {share.mean():.1%} of all poses; {some:,} of {share.size:,} positions, "
            f"{every:,} in every orientation\n"
            f"best: {share.max():.1%} at ({place}) m>"
        )
