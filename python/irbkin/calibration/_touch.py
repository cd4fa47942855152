"""A tool center point from poses that touch one point, a work object from points."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from irbkin._arrays import as_array
from irbkin.calibration._calibrate import FAR_ANGLE, FAR_LENGTH, FAR_PART
from irbkin.calibration._measurements import check_finite, read_poses
from irbkin.calibration._start import nearest_rotation
from irbkin.errors import CalibrationError, InvalidPoseError

if TYPE_CHECKING:
    import numpy.typing as npt

    from irbkin._arrays import Floats

# Least singular value of the orientations, for each pose [1]: below, a millimeter of scatter is
# more than 20 mm of the tool. Poses that turn by 6 deg about two axes have it.
LEAST_TURN = 0.05
# Least distance of points that span a frame [m], and least sine of the angle between its sides [1].
LEAST_LENGTH, LEAST_SINE = 1e-3, 0.02
# Farthest that a point can be in meters [m].
FARTHEST = 100.0


class ToolCenterPoint(NamedTuple):
    """A tool center point, and how good it is."""

    tool: Floats
    """Pose for `robot.with_tool`, with the flange's orientation, shape (4, 4)."""
    point: Floats
    """The touched point in the base [m], shape (3,)."""
    error: Floats
    """Distance of the tool center point from it at each pose [m], shape (m,)."""
    fitted: Floats
    """The tool center point at each pose in the base [m], shape (m, 3)."""

    @property
    def measured(self) -> Floats:
        """The touched point, once for each pose [m], shape (m, 3)."""
        return np.broadcast_to(self.point, self.fitted.shape)


class WorkObject(NamedTuple):
    """A work object, and how good it is."""

    frame: Floats
    """Its pose in the base, shape (4, 4)."""
    error: Floats
    """Distance of each point from its nominal place [m], shape (m,); zeros of three points."""
    measured: Floats
    """The points in the base [m], shape (m, 3)."""
    fitted: Floats
    """Their nominal places in the base [m], shape (m, 3); of X1, X2 and Y1 the points."""


def tool_center_point(flange: npt.ArrayLike) -> ToolCenterPoint:
    """Return the tool center point of a tool whose tip touches one point in several orientations.

    Its position is the least-squares solution of R_i x + p_i = c, for the flange R_i, p_i, the tool
    center point x and the touched point c.

    Args:
        flange: Poses of the flange in the base, shape (m, 4, 4), m >= 4: `robot.fk(q)` of a robot
            without a tool.

    Raises:
        InvalidPoseError: A wrong shape, or a matrix that is not a pose.
        CalibrationError: Fewer than four poses, or orientations that differ too little, or about
            one axis only.
    """
    poses = read_poses(flange, "flange")
    if len(poses) < 4:
        raise CalibrationError(f"flange has {len(poses)} poses, at least 4 are needed")
    rotations, positions = poses[:, :3, :3], poses[:, :3, 3]
    check_meters(positions, "flange")
    turned = rotations - rotations.mean(axis=0)
    least = float(np.linalg.svd(turned.reshape(-1, 3), compute_uv=False)[-1] / np.sqrt(len(poses)))
    if least < LEAST_TURN:
        raise CalibrationError(
            f"the orientations of flange differ by {least:.2g} rad about some axis, at least "
            f"{LEAST_TURN:g} rad is needed: tilt the tool by 30 deg or more about two axes"
        )
    shifted = positions - positions.mean(axis=0)
    solved = np.linalg.lstsq(turned.reshape(-1, 3), -shifted.ravel(), rcond=None)
    tip = np.asarray(solved[0], dtype=np.float64)
    tips = rotations @ tip + positions
    point = tips.mean(axis=0)
    tool = np.eye(4)
    tool[:3, 3] = tip
    return ToolCenterPoint(tool, point, np.linalg.norm(tips - point, axis=1), tips)


def work_object(
    points: npt.ArrayLike, nominal: npt.ArrayLike | None = None, y1: npt.ArrayLike | None = None
) -> WorkObject:
    """Return the frame of a work object from measured points: `work_object(X1, X2, Y1)` as ABB asks
    for them. `rapid.WobjData.of(found.frame)` is its wobjdata.

    Without `nominal`, points are ABB's X1, X2 and Y1: x goes from X1 to X2, y to the side of Y1,
    and the origin is the foot of Y1 on the line through X1 and X2. With it, the frame is that in
    which the points are nearest to their nominal places, by least squares.

    Args:
        points: Measured points in the base [m], shape (3, 3), or (m, 3), m >= 3, with `nominal`.
        nominal: These points in the work object [m], shape (m, 3).
        y1: The third point where each is given by itself [m], shape (3,): then `points` is X1 and
            `nominal` X2.

    Raises:
        InvalidPoseError: A wrong shape, or a coordinate that is not finite.
        CalibrationError: Points near to one line, in millimeters, or half of them far off.
    """
    if y1 is not None:
        given = zip(
            ("X1", "X2", "Y1"), (points, () if nominal is None else nominal, y1), strict=True
        )
        points, nominal = [as_array(it, name, (3,), InvalidPoseError) for name, it in given], None
    if nominal is None:
        measured = _points(points, "points", 3)
        x1, x2, y1 = measured
        rotation = _axes(x2 - x1, y1 - x1, "points X1, X2 and Y1")
        x = rotation[:, 0]
        frame = np.eye(4)
        frame[:3, :3], frame[:3, 3] = rotation, x1 + x * (x @ (y1 - x1))
        return WorkObject(frame, np.zeros(3), measured, measured)
    measured = _points(points, "points", None)
    wanted = _points(nominal, "nominal", len(measured))
    off, own = measured - measured.mean(axis=0), wanted - wanted.mean(axis=0)
    for name, spread in (("points", off), ("nominal", own)):
        width = float(np.linalg.svd(spread, compute_uv=False)[1])
        if width < LEAST_LENGTH:
            raise CalibrationError(
                f"{name} are on one line to {width:.2g} m, they must span a plane by "
                f"{LEAST_LENGTH:g} m at least: measure points farther apart"
            )
    frame = np.eye(4)
    frame[:3, :3] = nearest_rotation(off.T @ own)
    frame[:3, 3] = measured.mean(axis=0) - frame[:3, :3] @ wanted.mean(axis=0)
    places = wanted @ frame[:3, :3].T + frame[:3, 3]
    far = float(np.median(np.linalg.norm(places - measured, axis=1)))
    check_near(far, 0.0, measured, "points and nominal")
    return WorkObject(frame, np.linalg.norm(places - measured, axis=1), measured, places)


def _points(points: npt.ArrayLike, name: str, count: int | None) -> Floats:
    array = as_array(points, name, (count, 3), InvalidPoseError)
    check_finite(array, name, InvalidPoseError)
    if len(array) < 3:
        raise CalibrationError(f"{name} has {len(array)} rows, at least 3 are needed")
    check_meters(array, name)
    return array


def check_meters(positions: Floats, name: str) -> None:
    """Refuse positions that are farther than an arm reaches."""
    largest = float(np.abs(positions).max())
    if largest > FARTHEST:
        raise CalibrationError(
            f"{name} has a coordinate of {largest:g} m, its size must be at most {FARTHEST:g} m "
            "(did you pass millimeters?)"
        )


def check_near(distance: float, angle: float, positions: Floats, names: str) -> None:
    """Refuse data of which half are farther off than any measurement."""
    bound = max(FAR_PART * float(np.linalg.norm(np.ptp(positions, axis=0))), FAR_LENGTH)
    if distance > bound or angle > FAR_ANGLE:
        raise CalibrationError(
            f"{names} do not fit: half are {distance:.2g} m and {angle:.2g} rad off, at most "
            f"{bound:.2g} m and {FAR_ANGLE} rad is taken (is one inverted, swapped or mirrored?)"
        )


def _axes(x: Floats, other: Floats, name: str) -> Floats:
    """The rotation with x along a vector and y on the side of another one."""
    lengths = np.linalg.norm(x), np.linalg.norm(other)
    normal = np.cross(x, other)
    sine = np.linalg.norm(normal) / max(lengths[0] * lengths[1], np.finfo(float).tiny)
    if min(lengths) < LEAST_LENGTH or sine < LEAST_SINE:
        raise CalibrationError(
            f"{name} are {lengths[0]:.2g} and {lengths[1]:.2g} m apart, at an angle with sine "
            f"{sine:.2g}: at least {LEAST_LENGTH:g} m and {LEAST_SINE:g} are needed: measure "
            "points that are farther apart and not on one line"
        )
    x, z = x / lengths[0], normal / np.linalg.norm(normal)
    rotation: Floats = np.column_stack([x, np.cross(z, x), z])
    return rotation
