"""`irbkin.calibrate`, and the records that it returns."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from irbkin._arguments import Bar, Report, check_extra, check_robot, reporter
from irbkin._arrays import Floats
from irbkin._core import Robot
from irbkin._equality import by_value
from irbkin.calibration import _fit, _measurements, _parameters, _start
from irbkin.calibration._fit import Loss, check_weights
from irbkin.calibration._measurements import Measurements
from irbkin.errors import CalibrationError

FITS = ("base", "table", "tool")

# Angle and part of the spread of positions that a robot may be off before its base and tool are
# aligned first, and after that at most: a calibration corrects an arm, it does not find one.
FAR_ANGLE, FAR_PART = 0.2, 0.1
# Distance that it may be off in any case [m]: short moves have small errors.
FAR_LENGTH = 0.02
# Rounds of an alignment that outliers must not lead astray, the part of the median error from
# which on a measurement is one [1], and the least number of measurements.
ALIGNMENTS, TYPICAL, LEAST_ALIGNED = 10, 3.0, 4
# Joint vectors all over the joint space, by which parameters are told from one another [1].
EVERYWHERE = 100
MILLI = 1e3
STAGES = ("before", "base and tool", "after", "cross-validated")


class CalibratedParameter(NamedTuple):
    """One fitted parameter."""

    name: str
    """Such as "alpha 2", "base x" or "tool rz"."""
    unit: str
    """"m" or "rad"."""
    nominal: float
    """Value before; of base, tool and beta zero."""
    fitted: float
    """Value after."""
    standard_error: float
    """Standard deviation of the fitted value, as the scatter of the residuals has it."""

    @property
    def correction(self) -> float:
        return self.fitted - self.nominal


class LeftOutParameter(NamedTuple):
    """A parameter that is not fitted."""

    name: str
    """As of `CalibratedParameter`."""
    reason: str
    """Which fitted parameters do the same, or why the measurements do not show it."""


class Residuals(NamedTuple):
    """Distances of the arm's tool from the measurements."""

    position_rms: float
    """Root mean square of the distances [m]."""
    position_worst: float
    """Largest distance [m]."""
    rotation_rms: float
    """Root mean square of the angles [rad]; NaN where positions were measured."""
    rotation_worst: float
    """Largest angle [rad]; NaN where positions were measured."""

    @classmethod
    def of(cls, position: Floats, rotation: Floats) -> Residuals:
        figures = []
        for values in (position, rotation):
            known = values if len(values) else np.full(1, np.nan)
            figures += [float(np.sqrt(np.mean(np.square(known)))), float(known.max())]
        return cls(*figures)


class CalibrationResiduals(NamedTuple):
    """Residuals at each stage of a calibration."""

    before: Residuals
    """Of the robot as it was given."""
    aligned: Residuals
    """With only base and tool fitted, as far as they are fitted at all."""
    after: Residuals
    """Of the calibrated robot."""
    cross_validated: Residuals | None
    """Of poses that did not take part in the fit, each once; None without folds, or if the other
    poses are too few for the parameters.
    """


@by_value
class Calibration(NamedTuple):
    """A calibrated robot, and how good it is. `print(calibration)` shows a table."""

    robot: Robot
    nominal: Robot
    """The robot that the corrections are added to: the one given or, if its base or tool was far
    off, that with both aligned first.
    """
    parameters: tuple[CalibratedParameter, ...]
    left_out: tuple[LeftOutParameter, ...]
    """Parameters that the measurements do not determine."""
    residuals: CalibrationResiduals
    """Distances from the measurements, before and after."""
    position_error: Floats
    """Distance of each pose from its measurement after the fit [m], shape (m,)."""
    rotation_error: Floats
    """These angles [rad], shape (m,); (0,) where positions were measured."""
    condition: float
    """Condition number of the Jacobian in the fitted parameters, its columns scaled to one."""
    q: Floats
    """Joint angles at each measurement [rad], shape (m, n)."""
    measured: Floats
    """Measured positions [m], shape (m, 3)."""

    @property
    def fitted(self) -> Floats:
        """Positions of the calibrated robot's tool at these joint angles [m], shape (m, 3)."""
        return self.robot.fk(self.q)[:, :3, 3]

    @property
    def identifiable(self) -> tuple[str, ...]:
        return tuple(parameter.name for parameter in self.parameters)

    @property
    def corrections(self) -> Floats:
        """Corrections for `nominal.with_corrections`, shape (12 + 5 n,)."""
        index = {name: i for i, name in enumerate(_parameters.names(self.nominal.dof))}
        corrections = np.zeros(len(index))
        for parameter in self.parameters:
            corrections[index[parameter.name]] = parameter.correction
        return corrections

    def __repr__(self) -> str:
        before, after = self.residuals.aligned, self.residuals.after
        return (
            f"<Calibration of {self.robot.name or 'a robot'}: {len(self.parameters)} parameters "
            f"from {len(self.position_error)} measurements, rms {_length(before.position_rms)} "
            f"mm before, {_length(after.position_rms)} mm after>"
        )

    def __str__(self) -> str:
        """Residuals at each stage, then the parameters, in mm and mrad."""
        row = "{:15}  {:>9} {:>9}  {:>9} {:>9}"
        lines = [
            f"{self.robot.name or 'robot'}: {len(self.parameters)} parameters from "
            f"{len(self.position_error)} measurements",
            f"{'':15}  {'position [mm]':^19}  {'rotation [mrad]':^19}".rstrip(),
            row.format("", "rms", "worst", "rms", "worst"),
        ]
        for name, residuals in zip(STAGES, self.residuals, strict=True):
            if residuals is None:
                lines.append(f"{name}: none, no folds or too few measurements")
            else:
                lines.append(row.format(name, *map(_length, residuals)))
        lines.append(f"{'parameter':15}  {'correction':>12}  {'standard error':>14}")
        for each in self.parameters:
            unit = "mm" if each.unit == "m" else "mrad"
            lines.append(
                f"{each.name:15}  {each.correction * MILLI:12.4f}  "
                f"{each.standard_error * MILLI:14.4f} {unit}"
            )
        lines += [f"left out: {each.name}, {each.reason}" for each in self.left_out]
        return "\n".join(lines)


def _length(meters: float) -> str:
    """A length in mm, or an angle in mrad, with three digits at least."""
    return "-" if np.isnan(meters) else f"{meters * MILLI:.4f}"


def calibrate(
    robot: Robot,
    q: npt.ArrayLike,
    measured: npt.ArrayLike,
    *,
    fit: Collection[str] = FITS,
    position_std: float = 1e-4,
    rotation_std: float = 5e-4,
    loss: Loss = "linear",
    folds: int = 5,
    progress: Report | Bar | None = None,
) -> Calibration:
    """Fit the parameters of an arm to measured poses or positions of its tool. It needs scipy:
    `pip install 'irbkin[calibrate]'`.

    Parameters are the frame of the base, the Denavit-Hartenberg table with joint offsets and, next
    to parallel axes, Hayati's rotation about y, and the frame of the tool. Of these, the ones that
    the measurements determine are fitted. A base or a tool that is far off is aligned first. See
    docs/guide/calibrate.md.

    Args:
        robot: The nominal robot, with its nominal base and tool.
        q: Joint angles at each measurement [rad], shape (m, n).
        measured: Poses of the tool, shape (m, 4, 4), or its positions, shape (m, 3), [m].
        fit: Parts to fit: some of "base", "table" and "tool", and of single parameters, by their
            names in `parameters`: "theta 3", "d 1", "tool z".
        position_std: Standard deviation of a measured coordinate [m].
        rotation_std: Standard deviation of an angle [rad]. Only their ratio matters: 0.1 mm and
            0.5 mrad are targets 0.2 m apart.
        loss: "linear" for least squares; any other of scipy's, such as "huber" or "cauchy", gives
            measurements less weight that are more than three times the scatter off.
        folds: Number of parts for cross-validation, each left out once; 0 for none.
        progress: Called with the number of fits that are done, and of all: of the ends, of all
            parameters, and one for each part; or a bar as `tqdm.tqdm()`.

    Returns:
        The calibrated robot, its parameters with standard errors, what was left out and why, and
        the residuals before and after.

    Raises:
        ImportError: scipy is not installed.
        InvalidJointsError: `q` has a wrong shape, is not finite or in degrees.
        InvalidPoseError: `measured` has a wrong shape, is not finite or holds a matrix that is no
            pose.
        CalibrationError: Too few poses, a joint that does not move, positions in millimeters, or
            joints and measurements that do not belong together.
        ValueError: Another `fit`, `loss`, standard deviation or number of folds.
    """
    check_extra("irbkin.calibrate", "calibrate", "scipy")
    check_robot(robot)
    report = reporter(progress)
    wanted = _check_fit(robot, fit, position_std, rotation_std, loss)
    if folds < 0 or folds == 1:
        raise ValueError(f"folds is {folds}, it must be 0 for none, or 2 at least")
    measurements = _measurements.read(robot, q, measured)
    problem = _fit.Problem(robot, measurements, position_std, rotation_std, loss)
    tiers = _parameters.tiers(robot, wanted)
    none = np.zeros(len(_parameters.names(robot.dof)))
    moved = _everywhere(problem, none)
    needed = len(_parameters.chosen(moved, tiers, _parameters.INDEPENDENT))
    _measurements.check_poses(measurements, "table" in wanted, needed)

    problem = _aligned(problem, wanted)
    table = _parameters.table(robot.dof)
    ends = [index for index in tiers[0] if index not in table]
    ends = ends and _parameters.chosen(problem.jacobian(none), [ends], _parameters.DETERMINED)
    start = _fit.fit(problem, ends, none) if ends else none
    _check_near(problem, start)
    report(1, 2 + folds)
    jacobian = problem.jacobian(start)
    kept = _parameters.chosen(jacobian, tiers, _parameters.DETERMINED)
    if not kept:
        raise CalibrationError("measured determines no parameter: move the joints farther")
    has_table = any(index in table for index in kept)
    corrections = _fit.fit(problem, kept, start) if has_table else start
    report(2, 2 + folds)
    held_out = _cross_validated(problem, kept, corrections, folds, report)
    report(2 + folds, 2 + folds)
    return _calibration(problem, tiers, kept, start, corrections, held_out)


def _check_fit(
    robot: Robot, fit: Collection[str], position_std: float, rotation_std: float, loss: str
) -> frozenset[str]:
    wanted = frozenset([fit] if isinstance(fit, str) else fit)
    names = _parameters.names(robot.dof)
    if not wanted or not wanted <= {*FITS, *names}:
        raise ValueError(
            f"fit must be some of {', '.join(FITS)}, got {tuple(sorted(wanted))} (or of the names "
            f"of parameters, such as {names[6]} and {names[-1]})"
        )
    check_weights(position_std, rotation_std, loss)
    return wanted


def _everywhere(problem: _fit.Problem, corrections: Floats) -> Floats:
    """Weighted Jacobian at joint vectors all over the joint space."""
    robot = problem.robot
    lower, upper = np.clip(robot.limits, -np.pi, np.pi).T
    q = np.random.default_rng(0).uniform(lower, upper, (EVERYWHERE, robot.dof))
    jacobian = robot._parameter_jacobian(q, corrections)
    weights = np.r_[np.full(3, 1 / problem.position_std), np.full(3, 1 / problem.rotation_std)]
    rows = (jacobian * weights[:, None])[:, : problem.measurements.numbers]
    return np.asarray(rows.reshape(-1, jacobian.shape[-1]))


def _bound(problem: _fit.Problem) -> float:
    """How far the positions of a robot may be off [m]."""
    return max(FAR_PART * _measurements.spread(problem.measurements.position), FAR_LENGTH)


def _residuals(robot: Robot, measurements: Measurements) -> tuple[Residuals, Floats, Floats]:
    errors = _fit.errors_of(robot.fk(measurements.q), measurements.position, measurements.rotation)
    distance, angle = (np.linalg.norm(it, axis=1) for it in errors)
    if measurements.rotation is None:
        angle = np.zeros(0)
    return Residuals.of(distance, angle), distance, angle


def _aligned(problem: _fit.Problem, wanted: frozenset[str]) -> _fit.Problem:
    """The problem with base and tool aligned, if the robot as it is is far off: for a robust loss
    again without the measurements that are far off then.
    """
    ends = wanted & {"base", "tool"}
    if not ends or _is_near(problem, problem.robot):
        return problem
    measurements, robot = problem.measurements, problem.robot
    part = np.ones(len(measurements), dtype=bool)
    for _ in range(1 if problem.loss == "linear" else ALIGNMENTS):
        robot = _start.aligned(problem.robot, measurements.part(part), ends)
        kept = _is_typical(robot, measurements)
        if (kept == part).all() or kept.sum() < LEAST_ALIGNED:
            break
        part = kept
    return replace(problem, robot=robot)


def _is_typical(robot: Robot, measurements: Measurements) -> npt.NDArray[np.bool_]:
    """Which measurements are off by no more than most are."""
    _, *errors = _residuals(robot, measurements)
    kept = np.ones(len(measurements), dtype=bool)
    for error in errors:
        if len(error):
            kept &= error <= TYPICAL * np.median(error)
    return kept


def _off(problem: _fit.Problem, robot: Robot) -> tuple[float, float]:
    """Errors of a robot [m], [rad]: root mean square or, for a robust loss, the median."""
    residuals, distance, angle = _residuals(robot, problem.measurements)
    if problem.loss == "linear":
        return residuals.position_rms, residuals.rotation_rms
    return float(np.median(distance)), float(np.median(angle)) if len(angle) else float("nan")


def _is_near(problem: _fit.Problem, robot: Robot) -> bool:
    distance, angle = _off(problem, robot)
    return distance <= _bound(problem) and not angle > FAR_ANGLE


def _check_near(problem: _fit.Problem, corrections: Floats) -> None:
    robot = problem.robot.with_corrections(corrections)
    if _is_near(problem, robot):
        return
    (distance, turn), bound = _off(problem, robot), _bound(problem)
    angle = "" if np.isnan(turn) else f" and {turn:.2g} rad"
    how = "rms" if problem.loss == "linear" else "median"
    raise CalibrationError(
        f"the nominal arm is {distance:.3g} m{angle} off measured ({how}), with the base and "
        f"tool that fit best: at most {bound:.3g} m and {FAR_ANGLE} rad can be calibrated (is q in "
        "radians, in the order of measured? are these poses of the tool in the base?)"
    )


def _calibration(
    problem: _fit.Problem,
    tiers: Sequence[Sequence[int]],
    kept: Sequence[int],
    start: Floats,
    corrections: Floats,
    held_out: Residuals | None,
) -> Calibration:
    robot, measurements = problem.robot, problem.measurements
    names, nominal = _parameters.names(robot.dof), _parameters.nominal(robot)
    errors = _fit.standard_errors(problem, kept, corrections)
    found = robot.with_corrections(corrections)
    after, distance, angle = _residuals(found, measurements)
    jacobian, moved = problem.jacobian(corrections), _everywhere(problem, corrections)
    left_out = sorted({index for tier in tiers for index in tier} - set(kept))
    return Calibration(
        robot=found,
        nominal=robot,
        parameters=tuple(
            CalibratedParameter(
                names[index],
                _parameters.unit(names[index]),
                float(nominal[index]),
                float(nominal[index] + corrections[index]),
                float(error),
            )
            for index, error in zip(kept, errors, strict=True)
        ),
        left_out=tuple(
            LeftOutParameter(names[index], _parameters.reason(jacobian, moved, kept, index, names))
            for index in left_out
        ),
        residuals=CalibrationResiduals(
            _residuals(robot, measurements)[0],
            _residuals(robot.with_corrections(start), measurements)[0],
            after,
            held_out,
        ),
        position_error=distance,
        rotation_error=angle,
        condition=_parameters.condition(jacobian[:, kept]),
        q=measurements.q,
        measured=measurements.position,
    )


def _cross_validated(
    problem: _fit.Problem, kept: Sequence[int], corrections: Floats, folds: int, report: Report
) -> Residuals | None:
    measurements = problem.measurements
    count, numbers = len(measurements), measurements.numbers
    if folds == 0 or folds > count or numbers * (count - -(-count // folds)) <= len(kept):
        return None
    order = np.random.default_rng(0).permutation(count)
    fold = np.empty(count, dtype=int)
    fold[order] = np.arange(count) % folds
    distances, angles = [], []
    for part in range(folds):
        others = replace(problem, measurements=measurements.part(fold != part))
        found = _fit.fit(others, kept, corrections)
        held_out = measurements.part(fold == part)
        _, distance, angle = _residuals(problem.robot.with_corrections(found), held_out)
        distances.append(distance)
        angles.append(angle)
        report(3 + part, 2 + folds)
    return Residuals.of(np.concatenate(distances), np.concatenate(angles))
