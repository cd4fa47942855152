"""What a map holds."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from irbkin.records import by_value

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = ["ReachMap"]


@by_value
class ReachMap(NamedTuple):
    """What an arm reaches: a grid of positions, each with every orientation."""

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
    """The smallest margin of the orientations that are reached, that of an orientation being
    `IkMargin.margin`, shape (i, j, k). NaN where none is reached.
    """
    singularities: npt.NDArray[np.float64]
    """The same of `IkMargin.singularities`: the worst distance from singularities."""

    @property
    def share(self) -> npt.NDArray[np.float64]:
        """Share of the orientations that are reached inside the limits, shape (i, j, k)."""
        return self.reached / len(self.orientations)
