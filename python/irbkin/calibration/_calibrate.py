"""`irbkin.calibrate`."""

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from irbkin._arguments import Bar, Report, check_extra, check_robot, reporter
from irbkin._arrays import Floats
from irbkin._core import Robot
from irbkin.calibration import _fit, _identify, _measurements, _parameters, _start
from irbkin.calibration._loss import Loss, check_weights
from irbkin.calibration._measurements import Measurements
from irbkin.calibration._records import (
    CalibratedParameter,
    Calibration,
    CalibrationResiduals,
    LeftOutParameter,
    Residuals,
)
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
    has_table = bool(wanted & {"table", *_parameters.of_table(robot.dof)})
    measurements = _measurements.read(robot, q, measured)
    problem = _fit.Problem(robot, measurements, position_std, rotation_std, loss)
    tiers = _parameters.tiers(robot, wanted)
    moved = _everywhere(problem, np.zeros(len(_parameters.names(robot.dof))))
    needed = len(_identify.chosen(moved, tiers, _identify.INDEPENDENT))
    _measurements.check_poses(measurements, "table" in wanted, needed)

    problem = _aligned(problem, wanted)
    none = np.zeros(len(_parameters.names(robot.dof)))
    ends = _parameters.ends(tiers[0], robot.dof)
    ends = ends and _identify.chosen(problem.jacobian(none), [ends], _identify.DETERMINED)
    start = _fit.fit(problem, ends, none) if ends else none
    _check_near(problem, start)
    report(1, 2 + folds)
    jacobian = problem.jacobian(start)
    kept = _identify.chosen(jacobian, tiers, _identify.DETERMINED)
    if not kept:
        raise CalibrationError("measured determines no parameter: move the joints farther")
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
    position, rotation = _fit.errors_of(robot.fk(measurements.q), measurements)
    distance, angle = np.linalg.norm(position, axis=1), np.linalg.norm(rotation, axis=1)
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
            LeftOutParameter(names[index], _identify.reason(jacobian, moved, kept, index, names))
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
        condition=_identify.condition(jacobian[:, kept]),
        q=measurements.q,
        measured=measurements.position,
    )


def _cross_validated(
    problem: _fit.Problem, kept: Sequence[int], corrections: Floats, folds: int, report: Report
) -> Residuals | None:
    """Residuals of each part of the measurements with the corrections that the others give."""
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
