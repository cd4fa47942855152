"""Nonlinear least squares over corrections of an arm, with losses that outliers do not lead astray,
and the spread of what they give.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot
from irbkin.calibration._measurements import Measurements
from irbkin.errors import CalibrationError

Loss = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]
LOSSES = get_args(Loss)
# Median absolute deviation of a normal distribution to its standard deviation.
FROM_MEDIAN = 1.4826
# Part of the scatter from which on a robust loss counts residuals less [1].
OUTLIER = 3.0
# Steps within which least squares of corrections converge; the first guess is near.
MOST_STEPS = 200
# Relative change of parameters at which they have (the next step would be its square), and of the
# sum of squares (rounding).
CONVERGED, SETTLED = 1e-10, 1e-15


def check_weights(position_std: float, rotation_std: float, loss: str) -> None:
    """Refuse a standard deviation that is not positive and finite, and an unknown loss."""
    for name, value in (("position_std", position_std), ("rotation_std", rotation_std)):
        if not 0.0 < value < np.inf:
            raise ValueError(f"{name} is {value}, it must be positive and finite")
    if loss not in LOSSES:
        raise ValueError(f'loss must be one of {", ".join(LOSSES)}, got "{loss}"')


def outlying(residuals: Floats) -> float:
    """Residual from which on one counts less: the scatter without outliers measures it."""
    scatter = FROM_MEDIAN * float(np.median(np.abs(residuals)))
    return max(OUTLIER * scatter, np.finfo(float).eps)


@dataclass(frozen=True)
class Problem:
    robot: Robot
    measurements: Measurements
    position_std: float
    rotation_std: float
    loss: str = "linear"

    def errors(self, corrections: Floats) -> tuple[Floats, Floats]:
        """Vectors from the measured position to the arm's [m], and rotation vectors from the
        measured orientation to the arm's [rad], each of shape (m, 3) (eq. 14).
        """
        poses = self.robot._corrected_fk(self.measurements.q, corrections)
        return errors_of(poses, self.measurements.position, self.measurements.rotation)

    def residuals(self, corrections: Floats) -> Floats:
        """Errors as parts of their standard deviations, shape (k,) (eq. 15)."""
        position, rotation = self.errors(corrections)
        return np.concatenate(
            [position / self.position_std, rotation / self.rotation_std], axis=1
        ).ravel()

    def jacobian(self, corrections: Floats) -> Floats:
        """Derivatives of the residuals, shape (k, p) (eq. 16)."""
        jacobian = self.robot._parameter_jacobian(self.measurements.q, corrections)
        rows = jacobian[:, :3] / self.position_std
        if self.measurements.rotation is not None:
            _, rotation = self.errors(corrections)
            angular = _inverse_left_jacobian(rotation) @ jacobian[:, 3:]
            rows = np.concatenate([rows, angular / self.rotation_std], axis=1)
        return rows.reshape(-1, rows.shape[-1])


def errors_of(poses: Floats, position: Floats, rotation: Floats | None) -> tuple[Floats, Floats]:
    """As `Problem.errors`, of poses; rotation vectors of shape (m, 0) of measured positions."""
    shift = poses[:, :3, 3] - position
    if rotation is None:
        return shift, np.zeros((len(poses), 0))
    return shift, rotation_vectors(poses[:, :3, :3] @ rotation.swapaxes(1, 2))


def rotation_vectors(rotations: Floats) -> Floats:
    from scipy.spatial.transform import Rotation  # type: ignore[import-untyped]

    return np.asarray(Rotation.from_matrix(rotations).as_rotvec(), dtype=np.float64)


def _inverse_left_jacobian(vectors: Floats) -> Floats:
    """How a rotation vector changes with an angular velocity, (m, 3) to (m, 3, 3) (eq. 17)."""
    x, y, z = vectors.T
    zero = np.zeros_like(x)
    cross = np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)
    angle = np.linalg.norm(vectors, axis=1)
    half = angle / 2
    near = angle < 1e-4
    safe = np.where(near, 1.0, half)
    factor = np.where(near, 1 / 12, (1 - safe / np.tan(safe)) / (4 * safe**2))
    return np.asarray(np.eye(3) - cross / 2 + factor[:, None, None] * (cross @ cross))


def fit(problem: Problem, kept: Sequence[int], start: Floats) -> Floats:
    """The corrections that fit best; only those kept differ from the start."""
    if problem.loss == "linear":
        return _solve(problem, kept, start, 1.0)
    # The scatter of all residuals measures how far is far: twice, for the first fit has outliers.
    found = _solve(replace(problem, loss="linear"), kept, start, 1.0)
    for _ in range(2):
        found = _solve(problem, kept, found, outlying(problem.residuals(found)))
    return found


def _solve(problem: Problem, kept: Sequence[int], start: Floats, far: float) -> Floats:
    from scipy.optimize import least_squares  # type: ignore[import-untyped]

    def whole(values: Floats) -> Floats:
        corrections = start.copy()
        corrections[kept] = values
        return corrections

    solved = least_squares(
        lambda values: problem.residuals(whole(values)),
        start[kept],
        jac=lambda values: problem.jacobian(whole(values))[:, kept],
        method="lm" if problem.loss == "linear" else "trf",
        x_scale="jac",
        loss=problem.loss,
        f_scale=far,
        ftol=SETTLED,
        xtol=CONVERGED,
        gtol=SETTLED,
        max_nfev=MOST_STEPS,
    )
    if solved.status == 0:
        raise CalibrationError(
            f"the fit has not converged after {MOST_STEPS} steps: measured positions and q may not "
            "belong together"
        )
    return whole(solved.x)


def standard_errors(problem: Problem, kept: Sequence[int], corrections: Floats) -> Floats:
    """Standard deviations of fitted parameters, by the scatter of the residuals (eq. 18, 19)."""
    residuals, jacobian = problem.residuals(corrections), problem.jacobian(corrections)[:, kept]
    if problem.loss == "linear":
        influence, slope = residuals, 1.0
    else:
        weight, slopes = _influence(problem.loss, residuals / outlying(residuals))
        influence, slope = weight * residuals, float(np.mean(slopes))
    sizes = np.linalg.norm(jacobian, axis=0)
    _, values, axes = np.linalg.svd(jacobian / sizes, full_matrices=False)
    freedom = len(residuals) - len(kept)
    scatter = np.sqrt(influence @ influence / freedom) / slope
    return np.asarray(scatter * np.linalg.norm(axes.T / values, axis=1) / sizes)


def _influence(loss: str, parts: Floats) -> tuple[Floats, Floats]:
    """Half the derivative of a loss by a residual, as a part of the residual; and its slope.

    Reference: Huber, Robust Statistics, 1981, section 7.6.
    """
    squares = np.square(parts)
    if loss == "soft_l1":
        return 1 / np.sqrt(1 + squares), (1 + squares) ** -1.5
    if loss == "huber":
        return 1 / np.sqrt(np.maximum(squares, 1)), np.where(squares > 1, 0.0, 1.0)
    if loss == "cauchy":
        return 1 / (1 + squares), (1 - squares) / np.square(1 + squares)
    fourth = np.square(squares)
    return 1 / (1 + fourth), (1 - 3 * fourth) / np.square(1 + fourth)
