//! `irbkin.Given`: a seven-axis arm with the angle of one joint given.

use std::num::NonZeroUsize;
use std::sync::Arc;

use pyo3::basic::CompareOp;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyMapping};

use super::answers::{batch_output, pose_check};
use super::arguments::{read_singularity_mode, thread_count};
use super::arm::Arm;
use super::arrays::Rows;
use super::batches::filled;
use super::classes;
use super::errors::{Fault, of_seed, to_py};
use super::found::{Found, read_weights};
use super::nearest::{Seeded, read_seeded};
use super::outputs::{answer_row, output, writable};
use super::paths;
use super::poses::{read_ik_pose, read_single_pose};
use super::redundancy::{one_angle, read_angles};
use super::robot::PyRobot;
use super::signals::detached;
use super::solution::compared;
use super::solutions::PySolutions;
use crate::kinematics::thresholds::WRIST_ZONE;
use crate::kinematics::{FollowOptions, GivenJoint, Robot};

/// A seven-axis arm with the angle of one joint given: `robot.given({3: 0.2})`.
///
/// The other six joints are a chain of their own, which is prepared once, here. Answers have seven
/// joints. Frozen, equal by value, picklable.
#[pyclass(name = "Given", module = "irbkin", frozen, weakref)]
pub(super) struct PyGiven {
    /// The arm whose answers these are.
    robot: Arc<Robot<7>>,
    given: Arc<GivenJoint>,
}

/// A joint, from 1, and its angle or angles as they were passed; or what was prepared.
pub(super) enum Asked<'py> {
    Joint(usize, Bound<'py, PyAny>),
    Prepared(Bound<'py, PyGiven>),
}

impl<'py> Asked<'py> {
    /// The argument `given` of an arm.
    pub(super) fn read(arm: &Arm, given: &Bound<'py, PyAny>) -> PyResult<Self> {
        let Arm::Seven(robot) = arm else {
            return Err(PyTypeError::new_err(
                "given is for arms of seven joints: the pose alone determines the six of this one",
            ));
        };
        if let Ok(prepared) = given.cast::<PyGiven>() {
            if *prepared.get().robot != **robot {
                let message = "given was prepared for another robot: call given() of this one";
                return Err(PyValueError::new_err(message));
            }
            return Ok(Self::Prepared(prepared.clone()));
        }
        let (joint, angle) = read_pair(given)?;
        Ok(Self::Joint(joint, angle))
    }
}

/// The joint, from 1, and the angles of `{3: 0.2}`.
fn read_pair<'py>(given: &Bound<'py, PyAny>) -> PyResult<(usize, Bound<'py, PyAny>)> {
    let py = given.py();
    let Ok(pairs) = given.cast::<PyMapping>() else {
        return Err(PyTypeError::new_err(format!(
            "given must map a joint, from 1, to its angle [rad], as {{3: 0.2}}, got {}",
            given.get_type().name()?
        )));
    };
    let pairs = pairs.items()?;
    if pairs.len() != 1 {
        return Err(PyValueError::new_err(format!(
            "given has {} joints: a pose determines six of seven, give one",
            pairs.len()
        )));
    }
    let (joint, angle): (Bound<'py, PyAny>, Bound<'py, PyAny>) = pairs.get_item(0)?.extract()?;
    // A bool is a number for Python.
    let number = joint.extract::<i64>().ok().filter(|_| !joint.is_instance_of::<PyBool>());
    let number = number.ok_or_else(|| {
        PyTypeError::new_err(format!("given: {joint} is not the number of a joint, from 1"))
    })?;
    let missing =
        || Fault::Joints.error(py, format!("given: there is no joint {number}, it must be 1 to 7"));
    let joint = usize::try_from(number).ok().filter(|joint| (1..=7).contains(joint));
    Ok((joint.ok_or_else(missing)?, angle))
}

impl PyGiven {
    /// The prepared joint of an argument `given`.
    pub(super) fn of(py: Python<'_>, robot: &PyRobot, asked: Asked<'_>) -> PyResult<Self> {
        match asked {
            Asked::Joint(joint, angle) => {
                Self::prepared(robot, joint, one_angle(&angle, "given")?, py)
            }
            Asked::Prepared(prepared) => {
                let Self { robot, given } = prepared.get();
                Ok(Self { robot: Arc::clone(robot), given: Arc::clone(given) })
            }
        }
    }

    pub(super) fn prepared(
        robot: &PyRobot,
        joint: usize,
        angle: f64,
        py: Python<'_>,
    ) -> PyResult<Self> {
        let Arm::Seven(arm) = robot.arm() else {
            return Err(PyTypeError::new_err("given is for arms of seven joints"));
        };
        let given = robot.given_joint(arm, joint, angle).map_err(|error| to_py(py, &error))?;
        Ok(Self { robot: Arc::clone(arm), given })
    }

    pub(super) fn solutions<'py>(
        &self,
        py: Python<'py>,
        pose: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PySolutions>> {
        let pose = read_ik_pose(pose)?;
        let found = self.given.ik_checked(&pose, self.given.angle());
        let found = found.map_err(|error| to_py(py, &error))?;
        let found = Found::new(Arc::clone(&self.robot), found);
        Bound::new(py, PySolutions::from(found.with_given(self.joint(), self.angle())))
    }

    /// `irbkin.IkBatch` of poses and, for the first and the last joint, an angle for each.
    pub(super) fn batch<'py>(
        &self,
        poses: &Bound<'py, PyAny>,
        angles: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        threads: Option<NonZeroUsize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = poses.py();
        let mut rows = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
        let angles = angles.map(|angles| read_angles(angles, "given", &mut rows)).transpose()?;
        let angles = angles.as_ref().map(Rows::data).transpose()?;
        let (given, slots) = (&*self.given, self.given.six().slot_count());
        let answers = batch_output(py, out, &rows, [slots, 7])?;
        filled(py, &rows, answers, threads, |pace, poses, q, status| {
            pace.ik_given(given, poses, angles, q, status)
        })
    }
}

#[pymethods]
#[expect(non_snake_case, reason = "T is the name that users pass")]
impl PyGiven {
    /// The joint whose angle is given, from 1.
    #[getter]
    fn joint(&self) -> usize {
        self.given.joint()
    }

    /// Its angle [rad].
    #[getter]
    fn angle(&self) -> f64 {
        self.given.angle()
    }

    /// The same with the joint at another angle: another chain, in a tenth of a millisecond, for
    /// those between the first and the last.
    ///
    /// Args:
    ///     angle: Angle of the joint [rad].
    ///
    /// Returns:
    ///     Given, equal to that of `Robot.given` with this angle.
    ///
    /// Raises:
    ///     InvalidJointsError, InvalidModelError: As `Robot.given`.
    fn at(&self, angle: &Bound<'_, PyAny>) -> PyResult<Self> {
        let given = self.given.at(one_angle(angle, "angle")?);
        let given = given.map_err(|error| to_py(angle.py(), &error))?;
        Ok(Self { robot: Arc::clone(&self.robot), given: Arc::new(given) })
    }

    /// The seven-axis arm.
    #[getter]
    fn robot(&self) -> PyRobot {
        Arm::from(Arc::clone(&self.robot)).into()
    }

    /// The other six joints as a robot, with the arm's base, tool, limits and velocities. Its own
    /// joints are numbered 1 to 6; `joints` makes seven of them.
    #[getter]
    fn six_joints(&self, py: Python<'_>) -> PyResult<PyRobot> {
        let six = self.given.six_joints().map_err(|error| to_py(py, &error))?;
        Ok(Arm::from(six).into())
    }

    /// Return joint vectors of the arm for those of its other six joints.
    ///
    /// Args:
    ///     q: Joint angles [rad] of `six_joints`, shape (..., 6).
    ///
    /// Returns:
    ///     Joint angles [rad], shape (..., 7), the given one among them.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape.
    fn joints<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let rows = Rows::read(q, &[6], "q", Fault::Joints)?;
        let answer = output(q.py(), None, &rows.shape_with(&[7]))?;
        let mut view = writable(&answer, &[rows.addresses()])?;
        let sixes = rows.data()?.as_chunks::<6>().0;
        for (to, six) in view.as_slice_mut()?.as_chunks_mut::<7>().0.iter_mut().zip(sixes) {
            *to = self.given.joints(six);
        }
        Ok(answer.into_any())
    }

    /// Every joint vector that brings the tool to a pose.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///
    /// Returns:
    ///     Solutions of seven joints, limits not regarded. A joint that a singular pose leaves free
    ///     is reported by `six_joints.ik(T)`.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape, is not finite or is no rigid transform.
    fn ik<'py>(&self, T: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PySolutions>> {
        self.solutions(T.py(), T)
    }

    /// Every joint vector of many poses.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     out: Where to write, as `Robot.ik_batch` has it.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     IkBatch(q, status), q of shape (..., slots, 7).
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape.
    #[pyo3(signature = (T, *, out=None, threads=1))]
    fn ik_batch<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.batch(T, None, out, thread_count(threads)?)
    }

    /// The solution inside the limits that is nearest to `seed`, turns considered. The given joint
    /// does not count.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     seed: Joint vectors [rad], shape (..., 7). T and seed are broadcast.
    ///     weights: Cost of moving each joint, shape (7,); ones when not given.
    ///     out: Array to write to, shape (..., 7), float64, C-contiguous; it is returned.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (..., 7); in a batch, NaN for a row without a solution.
    ///
    /// Raises:
    ///     UnreachableError: A single pose has no solution inside the limits.
    ///     InvalidPoseError, InvalidJointsError: As `Robot.ik_nearest`.
    #[pyo3(signature = (T, seed, weights=None, *, out=None, threads=1))]
    fn ik_nearest<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: &Bound<'py, PyAny>,
        weights: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, threads, weights) = (T.py(), thread_count(threads)?, read_weights(weights)?);
        match read_seeded::<7>(T, seed)? {
            Seeded::One(pose, seed) => {
                let nearest = self.given.nearest_checked(&pose, &seed, &weights);
                let nearest = nearest.map_err(|error| of_seed(py, &error, &seed))?;
                answer_row(T, out, &nearest.q)
            }
            Seeded::Many(poses, seeds) => {
                let answer = output(py, out, &poses.shape_with(&[7]))?;
                let mut view = writable(&answer, &[poses.addresses(), seeds.addresses()])?;
                let (poses, seeds, q) = (poses.data()?, seeds.data()?, view.as_slice_mut()?);
                let given = &*self.given;
                detached(py, threads, |pace| {
                    pace.ik_nearest_given(given, poses, seeds, &weights, q)
                })?;
                Ok(answer.into_any())
            }
        }
    }

    /// Follow a path of poses with the other six joints, each time with the solution that continues
    /// the one before.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., m, 4, 4), translation [m].
    ///     seed: Joint vectors [rad] to start from, shape (..., 7).
    ///     weights: Cost of moving each joint, shape (7,); ones when not given.
    ///     singularity_mode: "through" or "error", as `Robot.follow` has it; the other modes are
    ///         for six joints with a spherical wrist.
    ///     threads: Number of threads, for several paths; 0 for one a core.
    ///
    /// Returns:
    ///     FollowResult: joints [rad], shape (..., m, 7); orientation error; the breaks, whose
    ///     sentences have the numbers of `six_joints`.
    ///
    /// Raises:
    ///     InvalidPoseError, InvalidJointsError, InvalidModelError: As `Robot.follow`.
    #[pyo3(signature = (T, seed, weights=None, *, singularity_mode="through", threads=1))]
    fn follow<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: &Bound<'py, PyAny>,
        weights: Option<&Bound<'py, PyAny>>,
        singularity_mode: &str,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let py = T.py();
        let weights = self.given.others(&read_weights::<7>(weights)?);
        let options = FollowOptions {
            weights,
            singularity_mode: read_singularity_mode(singularity_mode)?,
            zone: WRIST_ZONE,
        };
        let seeds = Rows::read(seed, &[7], "seed", Fault::Joints)?;
        let six = output(py, None, &seeds.shape_with(&[6]))?;
        {
            let mut view = writable(&six, &[seeds.addresses()])?;
            let sevens = seeds.data()?.as_chunks::<7>().0;
            for (to, q) in view.as_slice_mut()?.as_chunks_mut::<6>().0.iter_mut().zip(sevens) {
                *to = self.given.others(q);
            }
        }
        let robot = self.given.six();
        let found = paths::follow(robot, T, six.as_any(), &options, None, thread_count(threads)?)?;
        let (q, error, breaks): (Bound<'py, PyAny>, Bound<'py, PyAny>, Bound<'py, PyAny>) =
            found.extract()?;
        classes::follow_result_class(py)?.call1((self.joints(&q)?, error, breaks))
    }

    /// Whether a pose can be reached with the joint at its angle, and why not.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///
    /// Returns:
    ///     PoseCheck(reachable, within_limits, reason).
    ///
    /// Raises:
    ///     InvalidPoseError: As `ik`.
    fn check_pose<'py>(&self, T: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let pose = read_single_pose(T, "check_pose")?;
        let explanation = self.given.explain(&pose).map_err(|error| to_py(T.py(), &error))?;
        pose_check(T.py(), &explanation)
    }

    fn __richcmp__<'py>(
        &self,
        other: &Bound<'py, PyAny>,
        operator: CompareOp,
    ) -> PyResult<Bound<'py, PyAny>> {
        let is_equal = other.cast::<Self>().ok().map(|other| self.given == other.get().given);
        compared(other.py(), is_equal, operator)
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        (self.robot(), self.joint(), self.angle()).into_pyobject(py)?.hash()
    }

    fn __reduce__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyAny>, (Bound<'py, PyDict>,))> {
        let robot = Bound::new(py, self.robot())?;
        let pair = PyDict::new(py);
        pair.set_item(self.joint(), self.angle())?;
        Ok((robot.getattr("given")?, (pair,)))
    }

    fn __repr__(&self) -> String {
        format!(
            "Given({}, joint {} at {} rad)",
            self.given.robot().name(),
            self.joint(),
            self.angle()
        )
    }
}
