//! ABB's confdata and arm angles of joint vectors.

use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::arm::{Arm, on};
use super::classes;
use super::errors::to_py;
use super::outputs::writable;
use super::records;
use super::signals::detached;
use crate::error::{Error, ModelFault};
use crate::kinematics::Robot;
use crate::report::{Configuration, ConfigurationRule};

/// `irbkin.Configuration` of joint vectors, shape (..., n): integers for one, arrays for many.
pub(super) fn configuration<'py>(arm: &Arm, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = q.py();
    on!(arm, robot => robot.configuration_rule().map(drop)).map_err(|error| to_py(py, &error))?;
    let rows = arm.joints(q)?;
    let data = rows.data()?;
    if rows.is_single() {
        let counted = on!(arm, robot => single(robot, data)).map_err(|error| to_py(py, &error))?;
        return records::configuration(py, &counted);
    }
    let columns = [(); 4].map(|()| PyArrayDyn::<i32>::zeros(py, rows.lead.clone(), false));
    let mut views = Vec::with_capacity(columns.len());
    for column in &columns {
        views.push(writable(column, &[])?);
    }
    if let [cf1, cf4, cf6, cfx] = &mut views[..] {
        let numbers =
            [cf1.as_slice_mut()?, cf4.as_slice_mut()?, cf6.as_slice_mut()?, cfx.as_slice_mut()?];
        on!(arm, robot => {
            detached(py, None, |pace| pace.configurations(robot, data, numbers))?;
        });
    }
    let [cf1, cf4, cf6, cfx] = columns;
    classes::configuration_batch_class(py)?.call1((cf1, cf4, cf6, cfx))
}

/// The configuration of one joint vector, whose length was checked.
fn single<const N: usize>(robot: &Robot<N>, q: &[f64]) -> Result<Configuration, Error> {
    let wrong_length = || Error::WrongLength { field: "q", found: q.len(), wanted: N };
    robot.configuration(q.first_chunk().ok_or_else(wrong_length)?)
}

/// Arm angles of joint vectors, shape (..., 7): a number for one, an array for many.
pub(super) fn arm_angle<'py>(arm: &Arm, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = q.py();
    let Arm::Seven(robot) = arm else {
        return Err(to_py(py, &ModelFault::NoArmAngle.into()));
    };
    let rows = arm.joints(q)?;
    if let ([q], true) = (rows.data()?.as_chunks::<7>().0, rows.is_single()) {
        let angle = robot.arm_angle(q).map_err(|error| to_py(py, &error))?;
        return Ok(angle.unwrap_or(f64::NAN).into_pyobject(py)?.into_any());
    }
    let angles = PyArrayDyn::<f64>::zeros(py, rows.lead.clone(), false);
    let (data, mut view) = (rows.data()?, writable(&angles, &[rows.addresses()])?);
    let slice = view.as_slice_mut()?;
    detached(py, None, |pace| pace.arm_angles(robot, data, slice))?;
    Ok(angles.into_any())
}

/// Whether a configuration, with the arm angle of a YuMi, names one solution of a pose.
pub(super) fn names_one(arm: &Arm) -> bool {
    let rule = on!(arm, robot => robot.configuration_rule());
    rule.is_ok_and(|rule| rule == ConfigurationRule::SphericalWrist)
}
