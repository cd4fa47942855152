"""Where a camera, or another sensor, is: A X = Y B."""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arguments import check_extra
from irbkin._arrays import Floats
from irbkin.calibration._calibrate import FAR_ANGLE, FAR_LENGTH, FAR_PART
from irbkin.calibration._fit import Loss, check_weights, errors_of, outlying, rotation_vectors
from irbkin.calibration._measurements import read_poses
from irbkin.calibration._start import fit_shift, turns
from irbkin.errors import CalibrationError

# Least singular value of the relative rotations, for each pose [1]: about the angle in rad by which
# the hand turns about its second axis.
LEAST_TURN = 0.05
# Farthest that a position can be in meters [m].
FARTHEST = 100.0
# Poses that determine X and Y: two moves.
LEAST_POSES = 3
# Fits with a robust loss, each with the scatter of the one before.
ROUNDS = 3


class HandEye(NamedTuple):
    """The transforms of a hand-eye calibration, and how good they are."""

    x: Floats
    """X, shape (4, 4)."""
    y: Floats
    """Y, shape (4, 4)."""
    position_error: Floats
    """Distance of A X from Y B, for each pair [m], shape (m,)."""
    rotation_error: Floats
    """Angle between their rotations [rad], shape (m,)."""
    measured: Floats
    """Positions of Y B [m], shape (m, 3)."""
    fitted: Floats
    """Positions of A X [m], shape (m, 3)."""


def robot_world(
    a: npt.ArrayLike,
    b: npt.ArrayLike,
    *,
    position_std: float = 1e-4,
    rotation_std: float = 5e-4,
    loss: Loss = "linear",
) -> HandEye:
    """Return X and Y of A X = Y B: A are poses of the hand, B of what it carries in another frame.
    It needs scipy: `pip install 'irbkin[calibrate]'`.

    With A = `robot.fk(q)`: for a camera on the hand, B is the camera in a fixed target, X the
    camera in the hand and Y the target in the base. For a fixed camera, B is a target on the hand
    in the camera, X the target in the hand and Y the camera in the base. Moves of the hand and the
    moves that a camera sees (A X = X B) are such poses once they are chained, from any first one.

    Args:
        a: Poses, shape (m, 4, 4), m >= 3.
        b: Poses, shape (m, 4, 4).
        position_std: Standard deviation of a coordinate [m].
        rotation_std: Standard deviation of an angle [rad]. Only their ratio matters.
        loss: As of `irbkin.calibrate`: any but "linear" gives outliers less weight.

    Raises:
        ImportError: scipy is not installed.
        InvalidPoseError: A wrong shape, or a matrix that is not a pose.
        CalibrationError: Too few poses, all turned about one axis, or half of them far off.
        ValueError: Another `loss` or standard deviation.
    """
    hands, seen = _pairs(a, b)
    check_weights(position_std, rotation_std, loss)
    from scipy.optimize import least_squares  # type: ignore[import-untyped]
    from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

    for poses, name in ((hands, "a"), (seen, "b")):
        _check_turns(poses[0, :3, :3].T @ poses[1:, :3, :3], name)
    # A = Y B X^-1.
    first_y, inverse = np.eye(4), np.eye(4)
    first_y[:3, :3], inverse[:3, :3] = turns(seen[:, :3, :3], hands[:, :3, :3])
    fit_shift(seen, hands[:, :3, 3], first_y, inverse, frozenset({"base", "tool"}))
    start = np.array([np.linalg.inv(inverse), first_y])

    def frames(values: Floats) -> Floats:
        """X and Y, each turned and shifted by six numbers from where it began."""
        moved, parts = start.copy(), values.reshape(2, 6)
        moved[:, :3, :3] = Rotation.from_rotvec(parts[:, :3]).as_matrix() @ start[:, :3, :3]
        moved[:, :3, 3] += parts[:, 3:]
        return moved

    def errors(values: Floats) -> tuple[Floats, Floats]:
        x, y = frames(values)
        right = y @ seen
        return errors_of(hands @ x, right[:, :3, 3], right[:, :3, :3])

    def residuals(values: Floats) -> Floats:
        shift, turn = errors(values)
        return np.concatenate([shift / position_std, turn / rotation_std], axis=1).ravel()

    values = np.zeros(12)
    for _ in range(1 if loss == "linear" else ROUNDS):
        far = outlying(residuals(values))
        values = least_squares(
            residuals, values, x_scale="jac", loss=loss, f_scale=far, xtol=1e-14, ftol=1e-14
        ).x
    x, y = frames(values)
    shift, turn = (np.linalg.norm(it, axis=1) for it in errors(values))
    measured = (y @ seen)[:, :3, 3]
    # Half are farther off than any measurement.
    distance, angle = np.median(shift), np.median(turn)
    bound = max(FAR_PART * np.linalg.norm(np.ptp(measured, axis=0)), FAR_LENGTH)
    if distance > bound or angle > FAR_ANGLE:
        raise CalibrationError(
            f"a and b do not fit: half are {distance:.2g} m and {angle:.2g} rad off, at most "
            f"{bound:.2g} m and {FAR_ANGLE} rad is taken (is one inverted, swapped or mirrored?)"
        )
    return HandEye(x, y, shift, turn, measured, (hands @ x)[:, :3, 3])


def _pairs(a: npt.ArrayLike, b: npt.ArrayLike) -> tuple[Floats, Floats]:
    check_extra("hand-eye calibration", "calibrate", "scipy")
    first, second = read_poses(a, "a"), read_poses(b, "b")
    for poses, name in ((first, "a"), (second, "b")):
        # Farther than an arm reaches.
        largest = float(np.abs(poses[:, :3, 3]).max())
        if largest > FARTHEST:
            raise CalibrationError(
                f"{name} has a coordinate of {largest:g} m, its size must be at most {FARTHEST:g} "
                "m (did you pass millimeters?)"
            )
    if len(first) != len(second):
        raise CalibrationError(f"a has {len(first)} poses and b {len(second)}: give pairs")
    if len(first) < LEAST_POSES:
        raise CalibrationError(f"a has {len(first)} poses, at least {LEAST_POSES} are needed")
    return first, second


def _check_turns(rotations: Floats, name: str) -> None:
    """Refuse rotations about one axis: they leave a turn and a shift along it undetermined."""
    values = np.linalg.svd(rotation_vectors(rotations), compute_uv=False)
    second = values[1] / np.sqrt(len(rotations))
    if second < LEAST_TURN:
        raise CalibrationError(
            f"the poses of {name} turn by {second:.2g} rad about a second axis, at least "
            f"{LEAST_TURN:g} rad is needed: turn the hand about two axes that are not parallel"
        )
