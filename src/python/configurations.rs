//! ABB's confdata: of joint vectors, and solutions that have one.

use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;

use super::answers::index_in;
use super::arm::Arm;
use super::arrays::{Rows, output, writable};
use super::classes;
use super::errors::{Fault, to_py};
use super::found::read_seed;
use super::masked::Masked;
use super::paths::read_seeds;
use super::poses::{PoseArgument, read_poses};
use super::records;
use super::wording::shape;
use crate::batch;
use crate::error::ModelFault;
use crate::kinematics::Robot;
use crate::report::Configuration;

/// `irbkin.Configuration` of joint vectors, shape (..., 6): integers for one, arrays for many.
pub(super) fn configuration<'py>(arm: &Arm, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = q.py();
    let robot = counted(py, arm)?;
    let rows = arm.joints(q)?;
    let data = rows.data()?;
    let answers: Result<Vec<_>, _> =
        py.detach(|| batch::configuration(robot, data).map(Iterator::collect));
    let configurations = answers.map_err(|error| to_py(py, &error))?.into_iter().enumerate().map(
        |(number, configuration)| {
            configuration.map_err(|error| match rows.lead[..] {
                [] => to_py(py, &error),
                _ => {
                    Fault::Joints.error(py, format!("q{:?}: {error}", index_in(&rows.lead, number)))
                }
            })
        },
    );
    let configurations = configurations.collect::<PyResult<Vec<_>>>()?;
    match &configurations[..] {
        [one] if rows.is_single() => records::configuration(py, one),
        many => {
            let column = |of: fn(&Configuration) -> i32| {
                PyArray1::from_iter(py, many.iter().map(of)).reshape(rows.lead.clone())
            };
            let columns =
                (column(|c| c.cf1)?, column(|c| c.cf4)?, column(|c| c.cf6)?, column(|c| c.cfx)?);
            classes::configuration_batch_class(py)?.call1(columns)
        }
    }
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
) -> PyResult<Bound<'py, PyAny>> {
    let py = poses.py();
    let (robot, seed) = (counted(py, arm)?, fallback.checked()?);
    let wanted = read_configurations(configuration)?;
    let poses = match read_poses(poses)? {
        PoseArgument::Many(poses) => poses,
        PoseArgument::One(pose) => {
            let one = wanted.one(py)?;
            let found = match seed {
                Some(seed) => {
                    robot.ik_configured_or_nearest_checked(pose, one, &read_seed(seed, None)?.0)
                }
                None => robot.ik_configured_checked(pose, one),
            };
            return Ok(
                PyArray1::from_slice(py, &found.map_err(|error| to_py(py, &error))?.q).into_any()
            );
        }
    };
    let wanted = wanted.many(py, &poses.lead)?;
    let seeds = seed.map(|seed| read_seeds::<6>(seed, &poses.lead)).transpose()?;
    let answer = output(py, None, &poses.shape_with(&[6]))?;
    let (data, mut view) = (poses.data()?, writable(&answer, &[])?);
    let q = view.as_slice_mut()?;
    py.detach(|| batch::ik_configured(robot, data, &wanted, seeds.as_deref(), q))
        .map_err(|error| to_py(py, &error))?;
    Ok(answer.into_any())
}

/// Configurations with the leading dimensions in which they came.
struct Configurations {
    all: Vec<Configuration>,
    lead: Vec<usize>,
}

impl Configurations {
    fn one(&self, py: Python<'_>) -> PyResult<Configuration> {
        match self.all[..] {
            [one] if self.lead.is_empty() => Ok(one),
            _ => Err(Fault::Joints.error(
                py,
                format!(
                    "configuration must have shape (4,), got {}",
                    shape(&[&self.lead[..], &[4]].concat())
                ),
            )),
        }
    }

    fn many(self, py: Python<'_>, lead: &[usize]) -> PyResult<Vec<Configuration>> {
        if self.lead == lead {
            return Ok(self.all);
        }
        let wanted = shape(&[lead, &[4]].concat());
        let got = shape(&[&self.lead[..], &[4]].concat());
        match self.all[..] {
            [one] if self.lead.is_empty() => Ok(vec![one; lead.iter().product()]),
            _ => Err(Fault::Joints
                .error(py, format!("configuration must have shape (4,) or {wanted}, got {got}"))),
        }
    }
}

/// Configurations of shape (..., 4), or a record of four arrays.
fn read_configurations(value: &Bound<'_, PyAny>) -> PyResult<Configurations> {
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
    let rows = Rows::read(stacked, &[4], "configuration", Fault::Joints)?;
    let whole = |field: &str, number: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "checked to be a whole number of that size"
        )]
        if number.fract() == 0.0 && number.abs() <= f64::from(i32::MAX) {
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
    let all = rows.data()?.as_chunks::<4>().0.iter().map(configuration).collect::<PyResult<_>>()?;
    Ok(Configurations { all, lead: rows.lead.clone() })
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
