"""Joint vectors and what was measured at them, checked."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from irbkin._arrays import Floats, finite
from irbkin._core import Robot, pose
from irbkin.errors import CalibrationError, InvalidJointsError, InvalidPoseError

# Ratio of the spreads of measured and nominal positions from which the units differ [1]: inches
# and centimeters have 39 and 100, no two arms have.
UNITS = 25.0
# How far the last row of a pose may be from 0 0 0 1 [1].
LAST_ROW = 1e-9
# Largest angle between joint vectors that count as one [rad].
SAME_JOINTS = 1e-6
# Least range of a joint that shows its axis [rad].
LEAST_RANGE = 0.05


@dataclass(frozen=True)
class Measurements:
    """Joint vectors with the poses, or positions, that were measured at them."""

    q: Floats
    """Joint angles [rad], shape (m, n)."""
    position: Floats
    """Measured positions [m], shape (m, 3)."""
    rotation: Floats | None
    """Measured rotations, shape (m, 3, 3); None where positions were measured."""

    def __len__(self) -> int:
        return len(self.q)

    @property
    def numbers(self) -> int:
        """Numbers of one measurement: 3 of a position, 6 of a pose."""
        return 3 if self.rotation is None else 6

    def part(self, rows: npt.NDArray[np.bool_]) -> Measurements:
        rotation = None if self.rotation is None else self.rotation[rows]
        return Measurements(self.q[rows], self.position[rows], rotation)


def read(robot: Robot, q: npt.ArrayLike, measured: npt.ArrayLike) -> Measurements:
    joints = finite(q, "q", (None, robot.dof), InvalidJointsError)
    count = len(joints)
    found = np.asarray(measured)
    if found.shape == (count, 4, 4):
        poses = read_poses(measured, "measured")
        measurements = Measurements(joints, poses[:, :3, 3], poses[:, :3, :3])
    elif found.shape == (count, 3):
        points = finite(measured, "measured", (count, 3), InvalidPoseError)
        measurements = Measurements(joints, points, None)
    else:
        raise InvalidPoseError(
            f"measured must have shape ({count}, 4, 4) or ({count}, 3), as q has {count} rows, got "
            f"{found.shape}"
        )
    _check_units(robot, measurements)
    return measurements


def read_poses(value: npt.ArrayLike, name: str) -> Floats:
    """Measured poses, shape (m, 4, 4), their rotations made exact."""
    poses = finite(value, name, (None, 4, 4), InvalidPoseError)
    off = np.abs(poses[:, 3] - [0.0, 0.0, 0.0, 1.0]).max(axis=1)
    for index in np.flatnonzero(off > LAST_ROW):
        raise InvalidPoseError(
            f"{name}[{index}]: the last row must be 0 0 0 1, it is off by {off[index]:.1e}"
        )
    try:
        return pose(poses[:, :3, 3], rotation=poses[:, :3, :3])
    except InvalidPoseError as fault:
        # It begins with the row: "row [4]: ..".
        raise InvalidPoseError(f"{name}{str(fault).removeprefix('row ')}") from None


def spread(points: Floats) -> float:
    """Root mean square distance of points from their middle [m]."""
    return float(np.sqrt(np.mean(np.sum(np.square(points - points.mean(axis=0)), axis=1))))


def _check_units(robot: Robot, measurements: Measurements) -> None:
    limits = robot.limits
    turns = np.abs(measurements.q) > np.maximum(np.abs(limits).max(axis=1), 4.0 * np.pi)
    bounded = np.isfinite(limits).all(axis=1)
    for row, joint in np.argwhere(turns & bounded):
        raise InvalidJointsError(
            f"q[{row}, {joint}] is {measurements.q[row, joint]:g} rad, limits of joint {joint + 1} "
            f"are {limits[joint, 0]:.4g} to {limits[joint, 1]:.4g} rad (did you pass degrees?)"
        )
    own, theirs = spread(robot.fk(measurements.q)[:, :3, 3]), spread(measurements.position)
    if theirs > UNITS * own:
        raise CalibrationError(
            f"measured positions are spread by {theirs:.4g} m, the robot's at q by "
            f"{own:.4g} m: meters are wanted (did you pass millimeters?)"
        )


def check_poses(measurements: Measurements, table: bool, parameters: int) -> None:
    """Refuse fewer different poses than the parameters need, and a joint that does not move."""
    rounded = np.round(measurements.q / SAME_JOINTS)
    different = len(np.unique(rounded, axis=0))
    needed = -(-(parameters + 1) // measurements.numbers)
    if different < needed:
        what = "poses" if measurements.numbers == 6 else "positions"
        raise CalibrationError(
            f"q has {different} different joint vectors, {needed} are needed at least for "
            f"{parameters} parameters from {what} (twice as many are good): measure more, or fit "
            "less, such as fit=('base', 'tool')"
        )
    if not table:
        return
    moved = np.ptp(measurements.q, axis=0)
    for joint in np.flatnonzero(moved < LEAST_RANGE):
        raise CalibrationError(
            f"joint {joint + 1} moves by {moved[joint]:.2g} rad in q, {LEAST_RANGE} rad are needed "
            "at least to see its axis: move every joint, or fit=('base', 'tool')"
        )
