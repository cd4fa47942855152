"""Where a camera, or another sensor, is: A X = X B and A X = Y B."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arguments import check_extra
from irbkin._arrays import Floats
from irbkin.calibration._calibrate import FAR_ANGLE, FAR_LENGTH, FAR_PART
from irbkin.calibration._fit import Loss, check_weights, errors_of, outlying, rotation_vectors
from irbkin.calibration._measurements import read_poses
from irbkin.calibration._start import fit_shift, nearest_rotation, turns
from irbkin.errors import CalibrationError

# Least singular value of the relative rotations, for each pose [1]: about the angle in rad by which
# the hand turns about its second axis.
LEAST_TURN = 0.05
# Farthest that a position can be in meters [m].
FARTHEST = 100.0
# Fits with a robust loss, each with the scatter of the one before.
ROUNDS = 3


class HandEye(NamedTuple):
    """The transforms of a hand-eye calibration, and how good they are."""

    x: Floats
    """X, shape (4, 4)."""
    y: Floats | None
    """Y, shape (4, 4); None for A X = X B."""
    position_error: Floats
    """Distance of A X from Y B, or X B, for each pair [m], shape (m,)."""
    rotation_error: Floats
    """Angle between their rotations [rad], shape (m,)."""
    measured: Floats
    """Positions of Y B, or X B [m], shape (m, 3)."""
    fitted: Floats
    """Positions of A X [m], shape (m, 3)."""


def hand_eye(
    a: npt.ArrayLike,
    b: npt.ArrayLike,
    *,
    position_std: float = 1e-4,
    rotation_std: float = 5e-4,
    loss: Loss = "linear",
) -> HandEye:
    """Return X of A X = X B: A are moves of the hand, B the moves that its camera sees. It needs
    scipy: `pip install 'irbkin[calibrate]'`.

    With a camera on the hand, F_i = `robot.fk(q)` and C_i the pose of a fixed target in the
    camera, moves are A = F_j^-1 F_i and B = C_j C_i^-1, and X is the camera in the hand.
    `robot_world` takes F_i and C_i^-1 themselves.

    Args:
        a: Moves, shape (m, 4, 4), m >= 2.
        b: Moves, shape (m, 4, 4).
        position_std: Standard deviation of a coordinate [m].
        rotation_std: Standard deviation of an angle [rad]. Only their ratio matters.
        loss: As of `irbkin.calibrate`: any but "linear" gives outliers less weight.

    Raises:
        ImportError: scipy is not installed.
        InvalidPoseError: A wrong shape, or a matrix that is not a pose.
        CalibrationError: Too few moves, rotations about parallel axes, or half of them far off.
        ValueError: Another `loss` or standard deviation.
    """
    hands, eyes = _pairs(a, b, 2)
    check_weights(position_std, rotation_std, loss)
    _check_turns(hands[:, :3, :3], "a")
    _check_turns(eyes[:, :3, :3], "b")
    start = np.eye(4)
    start[:3, :3] = nearest_rotation(
        rotation_vectors(hands[:, :3, :3]).T @ rotation_vectors(eyes[:, :3, :3])
    )
    matrix = (hands[:, :3, :3] - np.eye(3)).reshape(-1, 3)
    wanted = eyes[:, :3, 3] @ start[:3, :3].T - hands[:, :3, 3]
    start[:3, 3] = np.linalg.lstsq(matrix, wanted.ravel(), rcond=None)[0]
    return _refined(lambda x: (hands @ x, x @ eyes), [start], (position_std, rotation_std, loss))


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
    in the camera, X the target in the hand and Y the camera in the base.

    Args:
        a: Poses, shape (m, 4, 4), m >= 3.
        b: Poses, shape (m, 4, 4).
        position_std: As of `hand_eye`.
        rotation_std: As of `hand_eye`.
        loss: As of `hand_eye`.

    Raises:
        ImportError: scipy is not installed.
        InvalidPoseError: A wrong shape, or a matrix that is not a pose.
        CalibrationError: Too few poses, all turned about one axis, or half of them far off.
        ValueError: Another `loss` or standard deviation.
    """
    hands, seen = _pairs(a, b, 3)
    check_weights(position_std, rotation_std, loss)
    for poses, name in ((hands, "a"), (seen, "b")):
        _check_turns(poses[0, :3, :3].T @ poses[1:, :3, :3], name)
    # A = Y B X^-1.
    y, inverse = np.eye(4), np.eye(4)
    y[:3, :3], inverse[:3, :3] = turns(seen[:, :3, :3], hands[:, :3, :3])
    fit_shift(seen, hands[:, :3, 3], y, inverse, frozenset({"base", "tool"}))
    start = [np.asarray(np.linalg.inv(inverse), dtype=float), y]
    return _refined(lambda x, y: (hands @ x, y @ seen), start, (position_std, rotation_std, loss))


def _pairs(a: npt.ArrayLike, b: npt.ArrayLike, least: int) -> tuple[Floats, Floats]:
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
    if len(first) < least:
        raise CalibrationError(f"a has {len(first)} poses, at least {least} are needed")
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


def _check_near(distance: float, angle: float, positions: Floats) -> None:
    """Refuse pairs of which half are farther off than any measurement."""
    bound = max(FAR_PART * float(np.linalg.norm(np.ptp(positions, axis=0))), FAR_LENGTH)
    if distance > bound or angle > FAR_ANGLE:
        raise CalibrationError(
            f"a and b do not fit: half are {distance:.2g} m and {angle:.2g} rad off, at most "
            f"{bound:.2g} m and {FAR_ANGLE} rad is taken (is one inverted, swapped or mirrored?)"
        )


def _refined(
    sides: Callable[..., tuple[Floats, Floats]],
    start: list[Floats],
    options: tuple[float, float, str],
) -> HandEye:
    """The frames near `start`, X and perhaps Y, for which both sides differ least."""
    from scipy.optimize import least_squares  # type: ignore[import-untyped]
    from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

    position_std, rotation_std, loss = options

    def frames(values: Floats) -> list[Floats]:
        moved = []
        for frame, part in zip(start, values.reshape(-1, 6), strict=True):
            turned = frame.copy()
            turned[:3, :3] = Rotation.from_rotvec(part[:3]).as_matrix() @ frame[:3, :3]
            turned[:3, 3] += part[3:]
            moved.append(turned)
        return moved

    def residuals(values: Floats) -> Floats:
        left, right = sides(*frames(values))
        shift, turn = errors_of(left, right[:, :3, 3], right[:, :3, :3])
        return np.concatenate([shift / position_std, turn / rotation_std], axis=1).ravel()

    values = np.zeros(6 * len(start))
    for _ in range(1 if loss == "linear" else ROUNDS):
        far = outlying(residuals(values))
        values = least_squares(
            residuals, values, x_scale="jac", loss=loss, f_scale=far, xtol=1e-14, ftol=1e-14
        ).x
    found = frames(values)
    left, right = sides(*found)
    measured = right[:, :3, 3]
    errors = errors_of(left, measured, right[:, :3, :3])
    shift, turn = (np.linalg.norm(it, axis=1) for it in errors)
    _check_near(float(np.median(shift)), float(np.median(turn)), measured)
    y = found[1] if len(found) > 1 else None
    return HandEye(found[0], y, shift, turn, measured, left[:, :3, 3])
