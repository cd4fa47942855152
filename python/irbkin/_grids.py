"""Records of what is tried on a grid: bases, and positions of the tool."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from irbkin._equality import by_value

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

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

    x: npt.NDArray[np.float64]
    """Positions along x [m], shape (i,)."""
    y: npt.NDArray[np.float64]
    """Positions along y [m], shape (j,)."""
    z: npt.NDArray[np.float64]
    """Positions along z [m], shape (k,)."""
    turn: npt.NDArray[np.float64]
    """Angles about z [rad], shape (l,)."""
    reachable: npt.NDArray[np.float64]
    """Share of the targets that are reached inside the limits, shape (i, j, k, l)."""
    margin: npt.NDArray[np.float64]
    """The smallest margin of all targets, shape (i, j, k, l). NaN where not all are reached, or
    where a path has no plan.
    """
    frame: npt.NDArray[np.float64]
    """The frame of these positions in the world, shape (4, 4)."""


@by_value
class Placement(NamedTuple):
    """Where a robot should stand."""

    base: npt.NDArray[np.float64]
    """The best base, shape (4, 4): `robot.with_base(base)`."""
    margin: float
    """The smallest margin of all targets there; NaN if they cannot all be reached."""
    reachable: float
    """Share of the targets that are reached there."""
    slack: npt.NDArray[np.float64]
    """The margin of each target, shape (m,); NaN where it is not reached."""
    q: npt.NDArray[np.float64]
    """Joint angles with that margin [rad], shape (m, 6); of a path, the joints of its plan. NaN
    where a target is not reached.
    """
    tool_angle: npt.NDArray[np.float64]
    """The angle that the tool is turned by [rad], shape (m,); zeros without a free rotation."""
    nowhere: tuple[int, ...]
    """The targets that are reached from no base that was tried."""
    plan: Plan | None
    """The plan of a path; None without `path` or without a plan."""
    grid: BaseGrid
    """The values of the grid, for `irbkin.plot.placement`."""
    reason: str
    """The outcome in a sentence."""


@by_value
class ReachMap(NamedTuple):
    """The reach of an arm: a grid of positions, each with every orientation."""

    x: npt.NDArray[np.float64]
    """Positions along x [m], shape (i,)."""
    y: npt.NDArray[np.float64]
    """Positions along y [m], shape (j,)."""
    z: npt.NDArray[np.float64]
    """Positions along z [m], shape (k,)."""
    orientations: npt.NDArray[np.float64]
    """Orientations of the tool, shape (o, 3, 3)."""
    reached: npt.NDArray[np.int64]
    """Number of orientations that are reached inside the limits, shape (i, j, k)."""
    solutions: npt.NDArray[np.int64]
    """Number of solutions inside the limits, all orientations together, shape (i, j, k)."""
    margin: npt.NDArray[np.float64]
    """The smallest margin of the orientations that are reached, the margin of an orientation being
    `IkMargin.margin`, shape (i, j, k). NaN where none is reached.
    """
    singularities: npt.NDArray[np.float64]
    """`IkMargin.singularities` in the same way: the worst distance from singularities."""

    @property
    def share(self) -> npt.NDArray[np.float64]:
        """Share of the orientations that are reached inside the limits, shape (i, j, k)."""
        return self.reached / len(self.orientations)
