//! ABB's confdata: of joint vectors, and solutions that have one.

use std::num::NonZeroUsize;

use numpy::PyArrayDyn;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;

use super::arm::Arm;
use super::arrays::Rows;
use super::broadcast::{Argument, together};
use super::classes;
use super::errors::{Fault, to_py};
use super::masked::Masked;
use super::nearest::{single_pose, single_seed};
use super::outputs::{answer_row, output, writable};
use super::records;
use super::signals::detached;
use crate::batch::NO_CONFIGURATION;
use crate::error::ModelFault;
use crate::kinematics::Robot;
use crate::report::Configuration;

/// `irbkin.Configuration` of joint vectors, shape (..., 6): integers for one, arrays for many.
pub(super) fn configuration<'py>(arm: &Arm, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = q.py();
    let robot = counted(py, arm)?;
    let rows = arm.joints(q)?;
    let data = rows.data()?;
    if let ([one], true) = (data.as_chunks::<6>().0, rows.is_single()) {
        let counted = robot.configuration(one).map_err(|error| to_py(py, &error))?;
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
        detached(py, None, |pace| pace.configurations(robot, data, numbers))?;
    }
    let [cf1, cf4, cf6, cfx] = columns;
    classes::configuration_batch_class(py)?.call1((cf1, cf4, cf6, cfx))
}

/// What to do with a pose that no solution reaches in the configuration that was asked for.
pub(super) struct Fallback<'a, 'py> {
    pub(super) name: Option<&'a str>,
    pub(super) seed: Option<&'a Bound<'py, PyAny>>,
}

impl<'a, 'py> Fallback<'a, 'py> {
    /// The seeds to take the nearest solution to, where that is wanted.
    pub(super) fn checked(&self) -> PyResult<Option<&'a Bound<'py, PyAny>>> {
        match (self.name, self.seed) {
            (None, None) => Ok(None),
            (None, Some(_)) => Err(PyTypeError::new_err("a seed is for fallback=\"nearest\"")),
            (Some("nearest"), None) => {
                Err(PyTypeError::new_err("fallback=\"nearest\" needs a seed"))
            }
            (Some("nearest"), seed) => Ok(seed),
            (Some(other), _) => Err(PyValueError::new_err(format!(
                "fallback must be \"nearest\" or None, got \"{other}\""
            ))),
        }
    }
}

/// The solutions of poses, shape (..., 4, 4), that have a configuration.
pub(super) fn ik<'py>(
    arm: &Arm,
    poses: &Bound<'py, PyAny>,
    configuration: &Bound<'py, PyAny>,
    fallback: &Fallback<'_, 'py>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = poses.py();
    let (robot, seed) = (counted(py, arm)?, fallback.checked()?);
    let mut rows = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    let mut wanted = configuration_rows(configuration)?;
    let mut seeds = seed.map(|seed| Rows::read(seed, &[6], "seed", Fault::Joints)).transpose()?;
    let pose = single_pose(py, &rows)?;
    let one_seed = match &seeds {
        Some(seeds) => single_seed::<6>(py, seeds)?,
        None => None,
    };
    if let Some(pose) = pose
        && wanted.is_single()
        && one_seed.is_some() == seeds.is_some()
    {
        let one = read_configurations(py, &wanted)?;
        let Some(one) = one.first().copied() else { return Ok(py.None().into_bound(py)) };
        let found = match one_seed {
            Some(seed) => robot.ik_configured_or_nearest_checked(pose, one, &seed),
            None => robot.ik_configured_checked(pose, one),
        };
        return answer_row(poses, out, &found.map_err(|error| to_py(py, &error))?.q);
    }
    let mut arguments = vec![
        Argument { field: "T", fault: Fault::Pose, rows: &mut rows },
        Argument { field: "configuration", fault: Fault::Joints, rows: &mut wanted },
    ];
    arguments.extend(seeds.as_mut().map(|rows| Argument {
        field: "seed",
        fault: Fault::Joints,
        rows,
    }));
    together(py, &mut arguments)?;
    let wanted = read_configurations(py, &wanted)?;
    let answer = output(py, out, &rows.shape_with(&[6]))?;
    let inputs = [Some(rows.addresses()), seeds.as_ref().map(Rows::addresses)];
    let mut view = writable(&answer, &inputs.into_iter().flatten().collect::<Vec<_>>())?;
    let (data, seeds) = (rows.data()?, seeds.as_ref().map(Rows::data).transpose()?);
    let q = view.as_slice_mut()?;
    detached(py, threads, |pace| pace.ik_configured(robot, data, &wanted, seeds, q))?;
    Ok(answer.into_any())
}

/// Configurations of shape (..., 4), or a record of four arrays.
fn configuration_rows<'py>(value: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
    let py = value.py();
    if let Some(masked) = Masked::of(value)? {
        return Err(masked.refused(py, "configuration", Fault::Joints));
    }
    let is_record = value.is_instance(classes::configuration_class(py)?)?
        || value.is_instance(classes::configuration_batch_class(py)?)?;
    let stacked = if is_record {
        let numpy = py.import(intern!(py, "numpy"))?;
        let unlike = |_| {
            Fault::Joints
                .error(py, "configuration: its four numbers have different shapes".to_owned())
        };
        &numpy.call_method1(intern!(py, "stack"), (value, -1)).map_err(unlike)?
    } else {
        value
    };
    Rows::read(stacked, &[4], "configuration", Fault::Joints)
}

/// The numbers of configurations, which must be whole.
fn read_configurations(py: Python<'_>, rows: &Rows<'_>) -> PyResult<Vec<Configuration>> {
    let whole = |field: &str, number: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "checked to be a whole number of that size"
        )]
        if number.fract() == 0.0
            && (f64::from(NO_CONFIGURATION)..=f64::from(i32::MAX)).contains(&number)
        {
            Ok(number as i32)
        } else {
            let bound = i32::MAX;
            Err(Fault::Joints.error(py, format!("configuration: {field} is {number}, it must be a whole number of at most {bound}")))
        }
    };
    let configuration = |[cf1, cf4, cf6, cfx]: &[f64; 4]| {
        Ok(Configuration {
            cf1: whole("cf1", *cf1)?,
            cf4: whole("cf4", *cf4)?,
            cf6: whole("cf6", *cf6)?,
            cfx: whole("cfx", *cfx)?,
        })
    };
    rows.data()?.as_chunks::<4>().0.iter().map(configuration).collect()
}

/// The robot that has configurations.
pub(super) fn counted<'a>(py: Python<'_>, arm: &'a Arm) -> PyResult<&'a Robot<6>> {
    let refused = match arm {
        Arm::Six(robot) => match robot.counted() {
            Ok(_) => return Ok(robot),
            Err(error) => error,
        },
        Arm::Seven(robot) => ModelFault::NoConfiguration { structure: robot.structure() }.into(),
    };
    Err(to_py(py, &refused))
}
