//! The heading of arms of five axes.

use std::sync::Arc;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use super::arm::{SharedArm, changed};
use super::errors::exception;
use super::robot::PyRobot;
use super::targets::{read_frame, read_seed, read_single_pose, read_weights};
use irbkin_motion::Arm;

#[pymethods]
#[expect(non_snake_case, reason = "T is the name that users pass")]
impl PyRobot {
    /// How far a pose may be turned about axis 1 for an arm of five axes to reach it [rad]; None of
    /// other arms.
    #[getter]
    fn heading_tolerance(&self) -> Option<f64> {
        five_axes(self.arm()).ok().map(|arm| arm.heading_tolerance())
    }

    /// Return the arm of five axes with another heading tolerance, for all of its solves, paths and
    /// plans.
    ///
    /// Args:
    ///     tolerance: How far a pose may be turned about axis 1 for the arm to reach it [rad], 0 to
    ///         pi.
    ///
    /// Raises:
    ///     InvalidModelError: The tolerance is not 0 to pi.
    ///     TypeError: The arm has not five axes.
    fn with_heading_tolerance(&self, tolerance: f64) -> PyResult<Self> {
        let arm = five_axes(self.arm())?;
        Ok(changed(arm, |robot| robot.with_heading_tolerance(tolerance))?.into())
    }

    /// The turn about axis 1, upwards, from a pose to the tool of an arm of five axes.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (5,).
    ///     T: Pose of the tool, shape (4, 4).
    ///
    /// Returns:
    ///     The angle [rad], in (-pi, pi]: of a solution all that the tool is off, otherwise the
    ///     nearest turn to it.
    ///
    /// Raises:
    ///     InvalidJointsError, InvalidPoseError: A wrong shape, or a number that is not finite.
    ///     TypeError: The arm has not five axes.
    fn heading_error(&self, q: &Bound<'_, PyAny>, T: &Bound<'_, PyAny>) -> PyResult<f64> {
        let arm = five_axes(self.arm())?;
        Ok(arm.heading_error(&read_seed(q)?, &read_single_pose(T, "heading_error")?))
    }
}

fn five_axes(arm: &SharedArm) -> PyResult<&Arc<Arm<5>>> {
    match arm {
        SharedArm::Five(arm) => Ok(arm),
        SharedArm::Six(_) | SharedArm::Seven(_) => Err(PyTypeError::new_err(format!(
            "heading_tolerance, heading_error and position_only are for arms of five axes: this one \
             has {}, and its solutions have the heading of the pose",
            arm.dof()
        ))),
    }
}

/// The arm with a heading tolerance, if one is given.
#[inline]
pub(super) fn turning(arm: &SharedArm, tolerance: Option<f64>) -> PyResult<Option<SharedArm>> {
    let Some(tolerance) = tolerance else { return Ok(None) };
    let arm = five_axes(arm)?;
    changed(arm, |robot| robot.with_heading_tolerance(tolerance)).map(Some)
}

/// The joints of `ik_nearest` with `position_only`; `narrowed` is whether more is asked of them.
pub(super) fn nearest_position(
    arm: &SharedArm,
    place: &Bound<'_, PyAny>,
    seed: &Bound<'_, PyAny>,
    weights: Option<&Bound<'_, PyAny>>,
    narrowed: bool,
) -> PyResult<[f64; 5]> {
    let arm = five_axes(arm)?;
    if narrowed {
        return Err(PyTypeError::new_err(
            "position_only leaves the heading free: it takes neither heading_tolerance nor cell",
        ));
    }
    let pose = read_frame(place, "ik_nearest with position_only")?;
    let nearest = arm.ik_nearest_position(&pose, &read_seed(seed)?, &read_weights(weights)?);
    Ok(nearest.map_err(exception)?.q)
}
