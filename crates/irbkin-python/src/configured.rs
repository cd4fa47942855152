//! ABB's confdata and arm angles of joint vectors, and the solutions that have them.

use std::num::NonZeroUsize;

use pyo3::IntoPyObjectExt;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::intern;
use pyo3::prelude::*;

use super::arguments::{read_threads, thread_count};
use super::arm::{SharedArm, joints, on, seven_joints};
use super::arrays::{Rows, together};
use super::errors::{Fault, exception};
use super::outputs::{Output, answer_row, matrix};
use super::records::{self, ConfigurationBatch};
use super::robot::PyRobot;
use super::signals::detached;
use super::targets::{read_single_pose, single_pose, single_seed};
use irbkin::batch::{Configured, NO_CONFIGURATION};
use irbkin::report::ConfigurationRule;
use irbkin::{Configuration, ConfigurationRequest, Robot};

#[pymethods]
impl PyRobot {
    /// ABB's confdata of joint vectors: quarter turns of axes 1, 4 and 6, and the branch.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///
    /// Returns:
    ///     Configuration(cf1, cf4, cf6, cfx): integers for one joint vector, int32 arrays of shape
    ///     (...) for many. cf is floor(angle / 90 deg), of a YuMi the nearest whole number. cfx is
    ///     the slot of a spherical wrist, 0 for an arm with coupled axes 2 and 3, whose controller
    ///     does not use it; docs/guide/abb.md has the rules of GoFa and YuMi. In a batch, a row
    ///     that is not finite, or has an angle beyond 1e5 rad, has -2147483648, the least int32, in
    ///     all four: `ik_configured` gives NaN for it.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     InvalidModelError: The arm has no spherical wrist and is not a GoFa or YuMi of the
    ///         catalog: its controller counts otherwise.
    fn configuration<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (py, arm) = (q.py(), self.arm());
        on!(arm, robot => robot.configuration_rule().map(drop)).map_err(exception)?;
        let rows = joints(arm, q)?;
        if let Some(one) = on!(arm, robot => rows.single()?.map(|q| robot.configuration(q))) {
            return records::Configuration::from(one.map_err(exception)?).into_bound_py_any(py);
        }
        let mut numbers = Output::<i32>::new(py, None, &rows.shape_with(&[4]), &[])?;
        let (data, slice) = (rows.data()?, numbers.slice()?);
        on!(arm, robot => detached(py, None, |batch| batch.configuration(robot, data, slice)))?;
        let numbers = numbers.bound();
        let column =
            |number: usize| PyResult::Ok(numbers.get_item((py.Ellipsis(), number))?.unbind());
        let (cf1, cf4, cf6, cfx) = (column(0)?, column(1)?, column(2)?, column(3)?);
        ConfigurationBatch { cf1, cf4, cf6, cfx }.into_bound_py_any(py)
    }

    /// The arm angle of a YuMi's joint vectors: eax_a of a robtarget.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., 7), in the order of the axes from the base: 1, 2, 7,
    ///         3, 4, 5, 6.
    ///
    /// Returns:
    ///     Arm angles [rad]: a number for one joint vector, shape (...) for many; NaN where axis 3
    ///     points from the shoulder to the wrist, and for a row of a batch that is not finite.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     InvalidModelError: The arm is not a YuMi of the catalog.
    fn arm_angle<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let (py, robot) = (q.py(), seven_joints(self.arm())?);
        let rows = joints(self.arm(), q)?;
        if let Some(q) = rows.single()? {
            let angle = robot.arm_angle(q).map_err(exception)?;
            return angle.unwrap_or(f64::NAN).into_bound_py_any(py);
        }
        let mut angles = Output::new(py, None, &rows.lead, &[])?;
        let (data, slice) = (rows.data()?, angles.slice()?);
        detached(py, None, |batch| batch.arm_angle(robot, data, slice))?;
        Ok(angles.bound())
    }

    /// The solution inside the limits that has a configuration, which chooses the turns of axes 1,
    /// 4 and 6, too.
    ///
    /// An angle within 0.01 deg of the edge of a quarter turn is taken for either side of it. A
    /// GoFa may have two solutions with one configuration: `every` returns both. Its joints, and a
    /// YuMi's, may be up to 1.5 deg beyond the limits where none is inside.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     configuration: (cf1, cf4, cf6, cfx): an `irbkin.Configuration`, or whole numbers of
    ///         shape (..., 4). T, configuration, arm_angle and seed are broadcast. None with
    ///         `every` and an arm_angle: any configuration, inside the limits or not.
    ///     arm_angle: Arm angles [rad] of a YuMi, shape (...): eax_a of its robtargets.
    ///     fallback: With "nearest", the solution nearest to `seed` where none has the
    ///         configuration: many programs write [0, 0, 0, 0] without having calculated it.
    ///     seed: Joint vectors [rad], shape (..., n): of the fallback, and those to which the
    ///         solution of a GoFa or YuMi is the nearest; angles of zero when not given.
    ///     every: Whether to return every such solution of one pose, the nearest to `seed` first.
    ///         For an arm angle alone, self-motions are searched that turn the first or the last
    ///         joint by a degree or more; one joint vector represents those that differ in two
    ///         axes of one line.
    ///     out: Array to write to, shape (..., n), float64, C-contiguous; it is returned.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (..., n); with `every` shape (k, n). In a batch, a row
    ///     without such a solution, or whose pose, seed or configuration (that which
    ///     `configuration` gives an invalid row) is invalid, is NaN.
    ///
    /// Raises:
    ///     UnreachableError: A single pose has no solution inside the limits with that
    ///         configuration; the message, and its attribute `configurations`, have those that
    ///         exist.
    ///     InvalidPoseError, InvalidJointsError: A wrong shape, an invalid pose, a number of the
    ///         configuration that is not whole or that the arm does not have, a YuMi without
    ///         arm_angle.
    ///     InvalidModelError: As `configuration`; arm_angle of another arm than a YuMi.
    ///     TypeError, ValueError: Another fallback, or one without a seed; a seed alone where the
    ///         configuration names one solution.
    #[pyo3(signature = (T, configuration, *, arm_angle=None, fallback=None, seed=None, every=false, out=None, threads=1))]
    fn ik_configured<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        configuration: Option<&Bound<'py, PyAny>>,
        arm_angle: Option<&Bound<'py, PyAny>>,
        fallback: Option<&str>,
        seed: Option<&Bound<'py, PyAny>>,
        every: bool,
        out: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, arm, threads) = (T.py(), self.arm(), thread_count(threads)?);
        let Some(configuration) = configuration else {
            let (Some(arm_angle), true) = (arm_angle, every) else {
                let message = "give a configuration, or an arm_angle with every=True";
                return Err(PyTypeError::new_err(message));
            };
            let robot = seven_joints(arm)?;
            let pose = read_single_pose(T, "ik_configured with every=True")?;
            let found = robot.ik_arm_angle(&pose, arm_angle.extract()?).map_err(exception)?;
            let q: Vec<_> = found.iter().map(|solution| solution.q).collect();
            return Ok(matrix(py, &q).into_any());
        };
        on!(arm, robot => robot.configuration_rule().map(drop)).map_err(exception)?;
        let or_nearest = !every && or_nearest(arm, fallback, seed)?;
        on!(arm, robot => {
            let asked = SelectionArguments::read(robot, configuration, arm_angle, seed, or_nearest)?;
            if every { asked.every(robot, T) } else { asked.one(robot, T, out, threads) }
        })
    }
}

/// Whether the solution nearest to the seed replaces one that does not exist.
pub(super) fn or_nearest(
    arm: &SharedArm,
    fallback: Option<&str>,
    seed: Option<&Bound<'_, PyAny>>,
) -> PyResult<bool> {
    // A configuration, with the arm angle of a YuMi, may name several solutions of a pose.
    let rule = on!(arm, robot => robot.configuration_rule());
    match (fallback, seed) {
        (None, Some(_)) if rule == Ok(ConfigurationRule::SphericalWrist) => {
            Err(PyTypeError::new_err("a seed is for fallback=\"nearest\""))
        }
        (None, _) => Ok(false),
        (Some("nearest"), None) => Err(PyTypeError::new_err("fallback=\"nearest\" needs a seed")),
        (Some("nearest"), Some(_)) => Ok(true),
        (Some(other), _) => {
            let message = format!("fallback must be \"nearest\" or None, got \"{other}\"");
            Err(PyValueError::new_err(message))
        }
    }
}

/// The arguments that select solutions of poses of an arm of `N` joints.
struct SelectionArguments<'py, const N: usize> {
    configurations: Rows<'py>,
    arm_angles: Option<Rows<'py>>,
    seeds: Option<Rows<'py>>,
    or_nearest: bool,
}

impl<'py, const N: usize> SelectionArguments<'py, N> {
    fn read(
        _: &Robot<N>,
        configuration: &Bound<'py, PyAny>,
        arm_angle: Option<&Bound<'py, PyAny>>,
        seed: Option<&Bound<'py, PyAny>>,
        or_nearest: bool,
    ) -> PyResult<Self> {
        let configurations = configuration_rows(configuration)?;
        let angle = |angle| Rows::read(angle, &[], "arm_angle", Fault::Joints);
        let seed_rows = |seed| Rows::read(seed, &[N], "seed", Fault::Joints);
        let (arm_angles, seeds) = (arm_angle.map(angle), seed.map(seed_rows));
        let (arm_angles, seeds) = (arm_angles.transpose()?, seeds.transpose()?);
        Ok(Self { configurations, arm_angles, seeds, or_nearest })
    }

    /// The request, if it is one.
    fn single(&self) -> PyResult<Option<ConfigurationRequest<N>>> {
        let seed = self.seeds.as_ref().map_or(Ok(None), single_seed::<N>)?;
        let others = [&self.arm_angles, &self.seeds];
        let is_single = others.into_iter().flatten().all(Rows::is_single);
        if !(is_single && self.configurations.is_single()) {
            return Ok(None);
        }
        let arm_angle = self.arm_angles.as_ref().map_or(Ok(&[][..]), Rows::data)?.first().copied();
        let or_nearest = self.or_nearest;
        let request = |&configuration: &Configuration| {
            let request = ConfigurationRequest { configuration, arm_angle, seed, or_nearest };
            request.check().map(|()| request)
        };
        let configurations = read_configurations(&self.configurations)?;
        configurations.first().map(request).transpose().map_err(exception)
    }

    /// Every solution of one pose, the nearest to the seed first, shape (k, n).
    fn every(self, robot: &Robot<N>, given: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let pose = read_single_pose(given, "ik_configured with every=True")?;
        let Some(request) = self.single()? else {
            let message =
                "ik_configured with every=True takes one configuration, arm angle and seed";
            return Err(Fault::Joints.error(message));
        };
        let all = robot.configured_all_checked(pose, &request).map_err(exception)?;
        let q: Vec<_> = all.iter().map(|solution| solution.q).collect();
        Ok(matrix(given.py(), &q).into_any())
    }

    /// The solution of each of the poses, shape (..., 4, 4).
    fn one(
        mut self,
        robot: &Robot<N>,
        given: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut poses = Rows::read(given, &[4, 4], "T", Fault::Pose)?;
        if let (Some(pose), Some(request)) = (single_pose(&poses)?, self.single()?) {
            let found = robot.configured_checked(pose, &request).map_err(exception)?;
            return answer_row(given, out, &found.q);
        }
        let mut arguments = vec![&mut poses, &mut self.configurations];
        arguments.extend([&mut self.arm_angles, &mut self.seeds].into_iter().flatten());
        together(&mut arguments)?;
        let inputs = [Some(&poses), self.arm_angles.as_ref(), self.seeds.as_ref()];
        let inputs: Vec<_> = inputs.into_iter().flatten().map(Rows::addresses).collect();
        let mut answer = Output::new(given.py(), out, &poses.shape_with(&[N]), &inputs)?;
        let asked = Configured {
            configurations: &read_configurations(&self.configurations)?,
            arm_angles: self.arm_angles.as_ref().map(Rows::data).transpose()?,
            seeds: self.seeds.as_ref().map(Rows::data).transpose()?,
            or_nearest: self.or_nearest,
        };
        let (data, q) = (poses.data()?, answer.slice()?);
        detached(given.py(), threads, |batch| batch.ik_configured(robot, data, &asked, q))?;
        Ok(answer.bound())
    }
}

/// Configurations of shape (..., 4), or a record of four arrays.
fn configuration_rows<'py>(value: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
    let py = value.py();
    let is_record = value.is_instance_of::<records::Configuration>()
        || value.is_instance_of::<ConfigurationBatch>();
    if !is_record {
        return Rows::read(value, &[4], "configuration", Fault::Joints);
    }
    let stacked = py.import(intern!(py, "numpy"))?.call_method1(intern!(py, "stack"), (value, -1));
    let unlike = |_| Fault::Joints.error("configuration: its four numbers have different shapes");
    Rows::read(&stacked.map_err(unlike)?, &[4], "configuration", Fault::Joints)
}

/// The numbers of configurations, which must be whole.
fn read_configurations(rows: &Rows<'_>) -> PyResult<Vec<Configuration>> {
    let bounds = f64::from(NO_CONFIGURATION)..=f64::from(i32::MAX);
    let whole = |field: &str, number: f64| {
        if number.fract() != 0.0 || !bounds.contains(&number) {
            return Err(Fault::Joints.error(format_args!(
                "configuration: {field} is {number}, it must be a whole number of at most {}",
                i32::MAX
            )));
        }
        #[expect(clippy::cast_possible_truncation, reason = "checked to be such a number")]
        Ok(number as i32)
    };
    let configuration = |[cf1, cf4, cf6, cfx]: &[f64; 4]| {
        Ok(Configuration {
            cf1: whole("cf1", *cf1)?,
            cf4: whole("cf4", *cf4)?,
            cf6: whole("cf6", *cf6)?,
            cfx: whole("cfx", *cfx)?,
        })
    };
    rows.chunks::<4>()?.iter().map(configuration).collect()
}
