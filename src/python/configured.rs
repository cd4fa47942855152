//! ABB's confdata and arm angles of joint vectors, and the solutions that have them.

use std::num::NonZeroUsize;

use numpy::PyArrayDyn;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;

use super::arm::{Arm, on};
use super::arrays::{Argument, Rows, together};
use super::errors::{Fault, to_py};
use super::nearest::single_seed;
use super::outputs::{answer_row, matrix, output, writable};
use super::poses::{read_single_pose, single_pose};
use super::records::{self, ConfigurationBatch};
use super::signals::detached;
use crate::batch::{Configured, NO_CONFIGURATION};
use crate::error::{Error, ModelFault};
use crate::kinematics::{ConfigurationRequest, Robot};
use crate::report::{Configuration, ConfigurationRule};

/// `irbkin.Configuration` of joint vectors, shape (..., n): integers for one, arrays for many.
pub(super) fn configuration<'py>(arm: &Arm, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
    let py = q.py();
    check_rule(py, arm)?;
    let rows = arm.joints(q)?;
    let data = rows.data()?;
    if rows.is_single() {
        let counted = on!(arm, robot => single(robot, data)).map_err(|error| to_py(py, &error))?;
        return records::configuration(py, &counted);
    }
    let numbers = PyArrayDyn::<i32>::zeros(py, rows.shape_with(&[4]), false);
    let mut view = writable(&numbers, &[])?;
    let slice = view.as_slice_mut()?;
    on!(arm, robot => detached(py, None, |batch| batch.configuration(robot, data, slice)))?;
    let column =
        |number: usize| -> PyResult<_> { Ok(numbers.get_item((py.Ellipsis(), number))?.unbind()) };
    let (cf1, cf4, cf6, cfx) = (column(0)?, column(1)?, column(2)?, column(3)?);
    Ok(Bound::new(py, ConfigurationBatch { cf1, cf4, cf6, cfx })?.into_any())
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
    detached(py, None, |batch| batch.arm_angle(robot, data, slice))?;
    Ok(angles.into_any())
}

/// Whether a configuration, with the arm angle of a YuMi, names one solution of a pose.
fn names_one(arm: &Arm) -> bool {
    let rule = on!(arm, robot => robot.configuration_rule());
    rule.is_ok_and(|rule| rule == ConfigurationRule::SphericalWrist)
}

/// Arguments that complete a configuration, and the choice if no solution has it.
pub(super) struct Options<'a, 'py> {
    pub(super) arm_angle: Option<&'a Bound<'py, PyAny>>,
    pub(super) fallback: Option<&'a str>,
    pub(super) seed: Option<&'a Bound<'py, PyAny>>,
}

impl Options<'_, '_> {
    /// Whether the solution nearest to the seed replaces one that does not exist.
    pub(super) fn or_nearest(&self, arm: &Arm) -> PyResult<bool> {
        match (self.fallback, self.seed) {
            (None, Some(_)) if names_one(arm) => {
                Err(PyTypeError::new_err("a seed is for fallback=\"nearest\""))
            }
            (None, _) => Ok(false),
            (Some("nearest"), None) => {
                Err(PyTypeError::new_err("fallback=\"nearest\" needs a seed"))
            }
            (Some("nearest"), Some(_)) => Ok(true),
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
    options: &Options<'_, 'py>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = poses.py();
    check_rule(py, arm)?;
    let or_nearest = options.or_nearest(arm)?;
    on!(arm, robot => {
        Asked::read(configuration, options, robot)?.solve(robot, poses, or_nearest, out, threads)
    })
}

/// Every solution of one pose that has a configuration, the nearest to the seed first, shape (k,
/// n).
pub(super) fn all<'py>(
    arm: &Arm,
    pose: &Bound<'py, PyAny>,
    configuration: &Bound<'py, PyAny>,
    options: &Options<'_, 'py>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = pose.py();
    check_rule(py, arm)?;
    let pose = read_single_pose(pose, "ik_configured with every=True")?;
    on!(arm, robot => {
        let Some(request) = Asked::read(configuration, options, robot)?.single(py)? else {
            let message = "ik_configured with every=True takes one configuration, arm angle and seed";
            return Err(Fault::Joints.error(py, message.to_owned()));
        };
        let all = request.check().and_then(|()| robot.configured_all_checked(pose, &request));
        let all = all.map_err(|error| to_py(py, &error))?;
        let q: Vec<_> = all.iter().map(|solution| solution.q).collect();
        Ok(matrix(py, &q).into_any())
    })
}

/// Every solution of a pose of a YuMi that has an arm angle, shape (k, 7).
pub(super) fn at_arm_angle<'py>(
    arm: &Arm,
    pose: &Bound<'py, PyAny>,
    arm_angle: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let py = pose.py();
    let Arm::Seven(robot) = arm else {
        return Err(to_py(py, &ModelFault::NoArmAngle.into()));
    };
    let pose = read_single_pose(pose, "ik_configured with every=True")?;
    let found =
        robot.ik_arm_angle(&pose, arm_angle.extract()?).map_err(|error| to_py(py, &error))?;
    let q: Vec<_> = found.iter().map(|solution| solution.q).collect();
    Ok(matrix(py, &q).into_any())
}

/// An arm that has configurations.
pub(super) fn check_rule(py: Python<'_>, arm: &Arm) -> PyResult<()> {
    on!(arm, robot => robot.configuration_rule().map(drop)).map_err(|error| to_py(py, &error))
}

/// The arguments that select solutions of poses of an arm of `N` joints.
struct Asked<'py, const N: usize> {
    configurations: Rows<'py>,
    arm_angles: Option<Rows<'py>>,
    seeds: Option<Rows<'py>>,
}

impl<'py, const N: usize> Asked<'py, N> {
    fn read(
        configuration: &Bound<'py, PyAny>,
        options: &Options<'_, 'py>,
        _: &Robot<N>,
    ) -> PyResult<Self> {
        let configurations = configuration_rows(configuration)?;
        let angle = |angle| Rows::read(angle, &[], "arm_angle", Fault::Joints);
        let seed = |seed| Rows::read(seed, &[N], "seed", Fault::Joints);
        let (arm_angles, seeds) = (options.arm_angle.map(angle), options.seed.map(seed));
        Ok(Self { configurations, arm_angles: arm_angles.transpose()?, seeds: seeds.transpose()? })
    }

    /// The request, if it is one.
    fn single(&self, py: Python<'py>) -> PyResult<Option<ConfigurationRequest<N>>> {
        let seed = match &self.seeds {
            Some(seeds) => single_seed::<N>(py, seeds)?,
            None => None,
        };
        let others = [&self.arm_angles, &self.seeds];
        let is_single = others.into_iter().flatten().all(Rows::is_single);
        if !(is_single && self.configurations.is_single()) {
            return Ok(None);
        }
        let arm_angle = match &self.arm_angles {
            Some(angles) => angles.data()?.first().copied(),
            None => None,
        };
        let configuration = read_configurations(py, &self.configurations)?.first().copied();
        Ok(configuration.map(|configuration| ConfigurationRequest {
            configuration,
            arm_angle,
            seed,
            or_nearest: false,
        }))
    }

    fn solve(
        mut self,
        robot: &Robot<N>,
        poses: &Bound<'py, PyAny>,
        or_nearest: bool,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = poses.py();
        let mut rows = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
        if let (Some(pose), Some(request)) = (single_pose(py, &rows)?, self.single(py)?) {
            let request = ConfigurationRequest { or_nearest, ..request };
            let found = request.check().and_then(|()| robot.configured_checked(pose, &request));
            return answer_row(poses, out, &found.map_err(|error| to_py(py, &error))?.q);
        }
        let Self { configurations, arm_angles, seeds } = &mut self;
        let of = |field: &'static str| move |rows| Argument { field, fault: Fault::Joints, rows };
        let mut arguments = vec![
            Argument { field: "T", fault: Fault::Pose, rows: &mut rows },
            of("configuration")(configurations),
        ];
        arguments.extend(arm_angles.as_mut().map(of("arm_angle")));
        arguments.extend(seeds.as_mut().map(of("seed")));
        together(py, &mut arguments)?;
        let configurations = read_configurations(py, &self.configurations)?;
        let answer = output(py, out, &rows.shape_with(&[N]))?;
        let inputs = [Some(&rows), self.arm_angles.as_ref(), self.seeds.as_ref()];
        let inputs: Vec<_> = inputs.into_iter().flatten().map(Rows::addresses).collect();
        let mut view = writable(&answer, &inputs)?;
        let asked = Configured {
            configurations: &configurations,
            arm_angles: self.arm_angles.as_ref().map(Rows::data).transpose()?,
            seeds: self.seeds.as_ref().map(Rows::data).transpose()?,
            or_nearest,
        };
        let (data, q) = (rows.data()?, view.as_slice_mut()?);
        detached(py, threads, |pace| pace.ik_configured(robot, data, &asked, q))?;
        Ok(answer.into_any())
    }
}

/// Configurations of shape (..., 4), or a record of four arrays.
fn configuration_rows<'py>(value: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
    let py = value.py();
    let is_record =
        value.is_instance_of::<Configuration>() || value.is_instance_of::<ConfigurationBatch>();
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
