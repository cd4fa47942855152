"""States and limits of motions over time."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from irbkin._equality import by_value

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt


class TrajectorySample(NamedTuple):
    """The state of the joints at times."""

    q: npt.NDArray[np.float64]
    """Joint angles [rad], shape (..., n)."""
    dq: npt.NDArray[np.float64]
    """Joint velocities [rad/s], shape (..., n)."""
    ddq: npt.NDArray[np.float64]
    """Joint accelerations [rad/s^2], shape (..., n)."""


class MotionPeaks(NamedTuple):
    """The largest sizes of each joint's derivatives."""

    velocity: npt.NDArray[np.float64]
    """Velocities [rad/s], shape (n,)."""
    acceleration: npt.NDArray[np.float64]
    """Accelerations [rad/s^2], shape (n,)."""
    jerk: npt.NDArray[np.float64]
    """Jerks [rad/s^3], shape (n,)."""


@by_value
class ToolSpeedLimits(NamedTuple):
    """The constant speed of the tool along a path that the limits of the joints allow."""

    speed: npt.NDArray[np.float64]
    """The highest at each sample [m/s], shape (m,); infinite where no limit binds."""
    joint: npt.NDArray[np.int64]
    """The joint that limits it, from 1, shape (m,); 0 where none does."""
    fastest: float
    """The fastest constant speed on the whole path [m/s], between the samples too."""
    fastest_joint: int
    """The joint that limits that, from 1; 0 where none does."""
    fastest_index: int
    """The sample at which it does, or the last one before the place."""
