"""Records of a calibration."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from irbkin._arrays import Floats
from irbkin._core import Robot
from irbkin._equality import by_value
from irbkin.calibration._parameters import names

_MILLI = 1e3


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
        """Fitted minus nominal value."""
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
        """Summary of the distances and angles of poses, shapes (m,)."""
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
        """Names of the fitted parameters."""
        return tuple(parameter.name for parameter in self.parameters)

    @property
    def corrections(self) -> Floats:
        """Corrections for `nominal.with_corrections`, shape (12 + 5 n,)."""
        index = {name: i for i, name in enumerate(names(self.nominal.dof))}
        corrections = np.zeros(len(index))
        for parameter in self.parameters:
            corrections[index[parameter.name]] = parameter.correction
        return corrections

    def __repr__(self) -> str:
        """The outcome in a line."""
        before, after = self.residuals.aligned, self.residuals.after
        return (
            f"<Calibration of {self.robot.name or 'a robot'}: {len(self.parameters)} parameters "
            f"from {len(self.position_error)} measurements, rms {_length(before.position_rms)} "
            f"mm before, {_length(after.position_rms)} mm after>"
        )

    def __str__(self) -> str:
        """Residuals at each stage, then the parameters, in mm and mrad."""
        lines = [
            f"{self.robot.name or 'robot'}: {len(self.parameters)} parameters from "
            f"{len(self.position_error)} measurements",
            f"{'':15}  {'position [mm]':^19}  {'rotation [mrad]':^19}".rstrip(),
            f"{'':15}  {'rms':>9} {'worst':>9}  {'rms':>9} {'worst':>9}",
        ]
        for name, residuals in zip(_STAGES, self.residuals, strict=True):
            if residuals is not None:
                figures = [_length(figure) for figure in residuals]
                lines.append(
                    f"{name:15}  {figures[0]:>9} {figures[1]:>9}  {figures[2]:>9} {figures[3]:>9}"
                )
            else:
                lines.append(f"{name}: none, no folds or too few measurements")
        lines.append(f"{'parameter':15}  {'correction':>12}  {'standard error':>14}")
        for each in self.parameters:
            unit = "mm" if each.unit == "m" else "mrad"
            lines.append(
                f"{each.name:15}  {each.correction * _MILLI:12.4f}  "
                f"{each.standard_error * _MILLI:14.4f} {unit}"
            )
        lines += [f"left out: {each.name}, {each.reason}" for each in self.left_out]
        return "\n".join(lines)


_STAGES = ("before", "base and tool", "after", "cross-validated")


def _length(meters: float) -> str:
    """A length in mm, or an angle in mrad, with three digits at least."""
    return "-" if np.isnan(meters) else f"{meters * _MILLI:.4f}"
