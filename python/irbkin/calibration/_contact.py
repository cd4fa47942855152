"""`irbkin.calibration.calibrate_contact`."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from irbkin._arguments import check_robot, check_scipy
from irbkin.calibration import _fit, _identify, _parameters
from irbkin.calibration._bodies import Body, PlaneContact, SphereContact, read_bodies
from irbkin.calibration._calibrate import FAR_LENGTH, check_fit, everywhere, fitted, left_out
from irbkin.calibration._measurements import Measurements
from irbkin.calibration._records import Calibration, CalibrationResiduals, Residuals
from irbkin.errors import CalibrationError

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    from irbkin._arrays import Floats
    from irbkin._core import Robot


# Distance of contacts from their bodies above which no fit is tried [m].
FARTHEST = 1.0


@dataclass(frozen=True)
class _Problem(_fit.Problem):
    """A robot and the bodies that it touches. Corrections are the robot's, then the places
    of the bodies.
    """

    bodies: tuple[Body, ...] = ()

    def off(self, corrections: Floats) -> Floats:
        """Distances of the contacts from their bodies [m], shape (m,)."""
        points = self._points(corrections)
        return np.concatenate(
            [body.errors(points[body.rows], corrections[body.numbers])[0] for body in self.bodies]
        )

    def touched(self, corrections: Floats) -> Floats:
        """The nearest points of the bodies [m], shape (m, 3)."""
        points = self._points(corrections)
        for body in self.bodies:
            rows = body.rows
            off, directions, _ = body.errors(points[rows], corrections[body.numbers])
            points[rows] -= off[:, None] * directions
        return points

    def typical(self, corrections: Floats) -> float:
        """Their root mean square and, for a robust loss, their median [m]."""
        off = np.abs(self.off(corrections))
        typical = np.sqrt(np.mean(np.square(off))) if self.loss == "linear" else np.median(off)
        return float(typical)

    def residuals(self, corrections: Floats) -> Floats:
        return self.off(corrections) / self.position_std

    def jacobian(self, corrections: Floats) -> Floats:
        count = len(_parameters.names(self.robot.dof))
        points = self._points(corrections)
        by_robot = self.robot._parameter_jacobian(self.measurements.q, corrections[:count])
        jacobian = np.zeros((len(points), len(corrections)))
        for body in self.bodies:
            rows, numbers = body.rows, body.numbers
            _, directions, by_place = body.errors(points[rows], corrections[numbers])
            jacobian[rows, :count] = np.einsum("mi,mip->mp", directions, by_robot[rows, :3])
            jacobian[rows, numbers] = by_place
        scaled: Floats = jacobian / self.position_std
        return scaled

    def _points(self, corrections: Floats) -> Floats:
        count = len(_parameters.names(self.robot.dof))
        poses = self.robot._corrected_fk(self.measurements.q, corrections[:count])
        return poses[:, :3, 3]


def calibrate_contact(
    robot: Robot,
    contacts: Sequence[SphereContact | PlaneContact],
    *,
    fit: Collection[str] = ("table", "tool"),
    position_std: float = 1e-4,
    loss: Literal["linear", "soft_l1", "huber", "cauchy", "arctan"] = "linear",
) -> Calibration:
    """Fit the parameters of an arm to contacts of its tool with spheres and planes. It needs scipy:
    `pip install 'irbkin[calibrate]'`.

    Where the bodies are is fitted too: the base is not determined then. Lengths come from the
    distances of spheres alone, the better the longer these are. See docs/guide/calibrate.md.

    Args:
        robot: The nominal robot, the center of its probe as tool center point.
        contacts: What was touched: a `SphereContact` or `PlaneContact` for each sphere or plane.
        fit: As of `calibrate`.
        position_std: Standard deviation of a contact [m]; with one kind of measurement it does not
            change the fit.
        loss: As of `calibrate`.

    Returns:
        As `calibrate`, without cross-validation; `position_error` is the distance of each contact
        from its sphere or plane.

    Raises:
        ImportError: scipy is not installed.
        InvalidJointsError, InvalidPoseError: A wrong shape, or a number that is not finite.
        InvalidModelError: The table of a robot with coupled axes 2 and 3 is to be fitted.
        CalibrationError: Too few contacts, contacts that do not determine their body, or that are
            off it by more than 20 mm.
        ValueError: Another `fit`, `loss` or standard deviation.
    """
    check_scipy("irbkin.calibration.calibrate_contact")
    check_robot(robot)
    wanted = check_fit(robot, fit, position_std, 1.0, loss)
    names = _parameters.names(robot.dof)
    q, bodies, places = read_bodies(robot, contacts, len(names))
    measurements = Measurements(q, robot.fk(q)[:, :3, 3], None)
    problem = _Problem(robot, measurements, position_std, 1.0, loss, bodies)
    all_names = [*names, *places]
    none = np.zeros(len(all_names))
    own = list(range(len(names), len(all_names)))
    # A body that is far off its contacts in the first place may not be found at all.
    off = problem.typical(none)
    if off <= FARTHEST and own:
        located = _fit.fit(problem, own, none)
        off = problem.typical(located)
    else:
        located = none
    if off > FAR_LENGTH:
        raise CalibrationError(
            f"the contacts are {off:.3g} m off their spheres and planes, at most "
            f"{FAR_LENGTH:g} m can be calibrated (is distance in meters, and does it have both "
            "radii? is the probe the tool of the robot?)"
        )
    tiers = [own, *_parameters.tiers(robot, wanted)]
    kept = _identify.chosen(problem.jacobian(located), tiers, _identify.DETERMINED)
    if len(problem.measurements) <= len(kept) or len(kept) == len(own):
        raise CalibrationError(
            f"{len(problem.measurements)} contacts do not determine the arm, whose parameters and "
            f"bodies are {len(kept)} numbers or more: measure twice as many contacts, each joint "
            "through its range, or fit less, such as fit=('tool',)"
        )
    ends = [*own, *_parameters.ends([index for index in kept if index not in own], robot.dof)]
    aligned = _fit.fit(problem, sorted(ends), located)
    found = _fit.fit(problem, kept, aligned)
    before, base_and_tool, after = (
        Residuals.of(np.abs(problem.off(it)), np.zeros(0)) for it in (located, aligned, found)
    )
    jacobian, nominal = problem.jacobian(found), _parameters.nominal(robot)
    moved = everywhere(problem, found[: len(names)])
    moved = np.pad(moved, ((0, 0), (0, len(own))))
    errors = dict(zip(kept, _fit.standard_errors(problem, kept, found), strict=True))
    return Calibration(
        robot=robot.with_corrections(found[: len(names)]),
        nominal=robot,
        parameters=fitted(names, nominal, found, {i: errors[i] for i in kept if i < len(names)}),
        left_out=left_out(jacobian, moved, tiers, kept, all_names),
        residuals=CalibrationResiduals(before, base_and_tool, after, None),
        position_error=np.abs(problem.off(found)),
        rotation_error=np.zeros(0),
        condition=_identify.condition(jacobian[:, kept]),
        q=q,
        measured=problem.touched(found),
    )
