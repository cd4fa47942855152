//! `irbkin.Robot`.

use std::sync::Arc;

use numpy::{PyArray1, PyArray2, PyArrayDyn, PyArrayMethods};
use pyo3::prelude::*;

use super::answers::singularity_record;
use super::arguments::{read_crossing, read_frame, thread_count};
use super::arm::{Arm, on_robot};
use super::arrays::vector;
use super::batches::{self, needed_q7, no_q7};
use super::build::{self, Convention, State};
use super::configurations::{self, Fallback};
use super::errors::{self, Fault, to_py};
use super::found::{Found, read_seed, read_weights};
use super::paths;
use super::poses::{PoseArgument, pose_array, read_pose, read_poses};
use super::solutions::PySolutions;
use super::urdf;
use crate::catalogue;
use crate::kinematics::thresholds::WRIST_ZONE;
use crate::kinematics::{Explanation, FollowOptions, Inverse, OpwParameters, Robot, check_given};

/// A robot arm: `Robot("IRB 2600-12/1.65")`. Frozen, hashable, equal by value, picklable.
///
/// Args:
///     name: Catalogue name; case, blanks, -, _, /, commas and parentheses do not matter. `irbkin.catalog()` lists them.
///
/// Raises:
///     UnknownRobotError: No arm of that name; the message has up to six close ones, the closest first.
#[pyclass(name = "Robot", module = "irbkin", frozen)]
pub(super) struct PyRobot {
    arm: Arm,
}

impl PyRobot {
    pub(super) fn arm(&self) -> &Arm {
        &self.arm
    }
}

impl From<Arm> for PyRobot {
    fn from(arm: Arm) -> Self {
        Self { arm }
    }
}

/// The robot of a pickled state.
#[pyfunction]
#[pyo3(name = "_restore_robot")]
#[expect(clippy::needless_pass_by_value, reason = "an extracted argument")]
pub(super) fn restore_robot(py: Python<'_>, state: State) -> PyResult<PyRobot> {
    build::restored(py, &state).map(PyRobot::from)
}

#[pymethods]
#[expect(non_snake_case, reason = "T is the name that users pass")]
impl PyRobot {
    #[new]
    fn new(py: Python<'_>, name: &str) -> PyResult<Self> {
        let arm = catalogue::find(name).and_then(|arm| match arm.dof() {
            6 => Robot::<6>::from_catalogue(arm).map(Arm::from),
            _ => Robot::<7>::from_catalogue(arm).map(Arm::from),
        });
        arm.map(Self::from).map_err(|error| to_py(py, &error))
    }

    /// Robot from a modified (Craig) Denavit-Hartenberg table: Rx(alpha) Tx(a) Rz(theta + q) Tz(d).
    ///
    /// Args:
    ///     rows: alpha [rad], a [m], d [m], theta offset [rad] of each joint, shape (6, 4) or (7, 4).
    ///     limits: Lower and upper limit of each joint [rad], shape (n, 2); none when not given.
    ///     name: A name of your own.
    ///     closed_form: With False, a six-axis arm of no known form is taken too: forward kinematics and Jacobian work, `ik` refuses. A
    ///         seven-axis one is always taken.
    ///
    /// Raises:
    ///     InvalidModelError: A number is not finite, a limit is empty, a link has no length, or no closed form is known: the message
    ///         names the axes that do not meet or are not parallel, and by how much.
    #[staticmethod]
    #[pyo3(signature = (rows, limits=None, name="", *, closed_form=true))]
    fn from_mdh(
        rows: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
        name: &str,
        closed_form: bool,
    ) -> PyResult<Self> {
        build::from_table(rows, limits, name, closed_form, Convention::Modified).map(Self::from)
    }

    /// Robot from a standard Denavit-Hartenberg table: Rz(theta + q) Tz(d) Tx(a) Rx(alpha).
    ///
    /// Args:
    ///     rows: alpha [rad], a [m], d [m], theta offset [rad] of each joint, in this order too, shape (6, 4) or (7, 4).
    ///     limits: Lower and upper limit of each joint [rad], shape (n, 2); none when not given.
    ///     name: A name of your own.
    ///     closed_form: With False, a six-axis arm of no known form is taken too: forward kinematics and Jacobian work, `ik` refuses. A
    ///         seven-axis one is always taken.
    ///
    /// Raises:
    ///     InvalidModelError: As `from_mdh`.
    #[staticmethod]
    #[pyo3(signature = (rows, limits=None, name="", *, closed_form=true))]
    fn from_sdh(
        rows: &Bound<'_, PyAny>,
        limits: Option<&Bound<'_, PyAny>>,
        name: &str,
        closed_form: bool,
    ) -> PyResult<Self> {
        build::from_table(rows, limits, name, closed_form, Convention::Standard).map(Self::from)
    }

    /// Robot from Brandstoetter's parameters of an ortho-parallel arm with a spherical wrist.
    ///
    /// Args:
    ///     a1, a2, b, c1, c2, c3, c4: Lengths [m]. At zero theta the arm stands straight up.
    ///     offsets: Joint offsets [rad], shape (6,): theta = sign * q - offset, as opw_kinematics has it; zeros when not given.
    ///     signs: Joint signs, each 1 or -1, shape (6,); ones when not given.
    ///     limits: Lower and upper limit of each joint [rad], shape (6, 2); none when not given.
    ///     name: A name of your own.
    ///
    /// Raises:
    ///     InvalidModelError: A number is not finite, a sign is not 1 or -1, a limit is empty, or a link has no length.
    #[staticmethod]
    #[pyo3(signature = (a1, a2, b, c1, c2, c3, c4, offsets=None, signs=None, limits=None, name=""))]
    #[expect(clippy::too_many_arguments, reason = "the parameters of the form have these names")]
    fn from_opw(
        py: Python<'_>,
        a1: f64,
        a2: f64,
        b: f64,
        c1: f64,
        c2: f64,
        c3: f64,
        c4: f64,
        offsets: Option<&Bound<'_, PyAny>>,
        signs: Option<&Bound<'_, PyAny>>,
        limits: Option<&Bound<'_, PyAny>>,
        name: &str,
    ) -> PyResult<Self> {
        let offsets =
            offsets.map_or(Ok([0.0; 6]), |offsets| vector(offsets, "offsets", Fault::Model))?;
        let signs = signs.map_or(Ok([1.0; 6]), |signs| vector(signs, "signs", Fault::Model))?;
        let opw = OpwParameters { a1, a2, b, c1, c2, c3, c4, offsets, signs: [1; 6] };
        build::from_opw(py, opw, signs, limits, name).map(Self::from)
    }

    /// Robot from a URDF: the revolute and continuous joints between two links, with their limits and velocities.
    ///
    /// Args:
    ///     text_or_path: The text, str that begins with "<" or bytes, or the path of a file. Xacro must be expanded first.
    ///     base: Link in whose frame poses are given; the one without a parent when not given.
    ///     tip: Link that poses are of; when not given, the only one at the end of a chain of six or seven joints.
    ///     name: A name of your own; the URDF's when not given.
    ///     closed_form: With False, a six-axis arm of no known form is taken too: forward kinematics and Jacobian work, `ik` refuses. A
    ///         seven-axis one is always taken.
    ///
    /// Raises:
    ///     InvalidModelError: The text is no URDF, several links could be meant, there are not six or seven joints, a joint between base
    ///         and tip is not revolute, continuous or fixed, or no closed form is known; the message names what is wrong.
    ///     OSError: The file cannot be read.
    #[staticmethod]
    #[pyo3(signature = (text_or_path, base=None, tip=None, name="", *, closed_form=true))]
    fn from_urdf(
        text_or_path: &Bound<'_, PyAny>,
        base: Option<&str>,
        tip: Option<&str>,
        name: &str,
        closed_form: bool,
    ) -> PyResult<Self> {
        urdf::from_urdf(text_or_path, base, tip, name, closed_form).map(Self::from)
    }

    /// Catalogue name, or the name that was given.
    #[getter]
    fn name(&self) -> &str {
        on_robot!(&self.arm, robot => robot.name())
    }

    /// Number of joints.
    #[getter]
    fn dof(&self) -> usize {
        self.arm.dof()
    }

    /// Name of the closed form: "spherical wrist", "three parallel axes", "spherical shoulder", or "serial" where there is none.
    #[getter]
    fn family(&self) -> &'static str {
        on_robot!(&self.arm, robot => robot.family())
    }

    /// Modified Denavit-Hartenberg rows: alpha [rad], a [m], d [m], theta offset [rad], shape (n, 4). `flange` follows the last row.
    #[getter]
    fn mdh<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows: Vec<f64> = on_robot!(&self.arm, robot => robot.mdh().rows.iter().flat_map(|row| row.to_array()).collect());
        PyArray1::from_vec(py, rows).reshape([self.arm.dof(), 4])
    }

    /// Fixed transform from the base to the frame before the first row of `mdh`, shape (4, 4).
    #[getter]
    fn root<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on_robot!(&self.arm, robot => pose_array(py, &robot.mdh().base))
    }

    /// Fixed transform from the last frame of `mdh` to the flange, shape (4, 4).
    #[getter]
    fn flange<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on_robot!(&self.arm, robot => pose_array(py, &robot.mdh().flange))
    }

    /// The base in the world, shape (4, 4).
    #[getter]
    fn base<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on_robot!(&self.arm, robot => pose_array(py, robot.base()))
    }

    /// The tool centre point in the flange frame, shape (4, 4).
    #[getter]
    fn tool<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        on_robot!(&self.arm, robot => pose_array(py, robot.tool()))
    }

    /// Lower and upper limit of each joint [rad], shape (n, 2); infinite where a joint has none.
    #[getter]
    fn limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let flat = on_robot!(&self.arm, robot => robot.limits().to_array().concat());
        PyArray1::from_vec(py, flat).reshape([self.arm.dof(), 2])
    }

    /// Largest velocity of each joint [rad/s], shape (n,), or None where no source has it.
    #[getter]
    fn max_velocity<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        on_robot!(&self.arm, robot => robot.max_velocity().map(|velocity| PyArray1::from_slice(py, velocity)))
    }

    /// The same robot with its tool centre point at T, shape (4, 4), in the flange frame. A tool that it had is replaced.
    fn with_tool(&self, T: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.arm.changed(T.py(), &build::Tool(read_pose(T, "T")?)).map(Self::from)
    }

    /// The same robot standing at T, shape (4, 4), in the world, in which poses are then given. A base that it had is replaced.
    fn with_base(&self, T: &Bound<'_, PyAny>) -> PyResult<Self> {
        self.arm.changed(T.py(), &build::Base(read_pose(T, "T")?)).map(Self::from)
    }

    /// The same robot with other joint limits [rad], shape (n, 2); those of a rod stay.
    fn with_limits(&self, limits: &Bound<'_, PyAny>) -> PyResult<Self> {
        build::with_limits(&self.arm, limits).map(Self::from)
    }

    /// Whether a parallelogram couples axes 2 and 3: joint 3 is then told from the base, as the controller tells it.
    #[getter]
    fn is_coupled(&self) -> bool {
        on_robot!(&self.arm, robot => robot.is_coupled())
    }

    /// Lower and upper limit of q3 - q2 [rad], shape (2,), of the rod that couples axes 2 and 3; None where none are known.
    #[getter]
    fn rod_limits<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        on_robot!(&self.arm, robot => robot.limits().rod())
            .map(|rod| PyArray1::from_slice(py, &rod))
    }

    /// The same robot with limits of q3 - q2 [rad], shape (2,), at whatever turn, for the rod that couples axes 2 and 3; None for none.
    ///
    /// Raises:
    ///     InvalidModelError: A limit is NaN, the lower one is above the upper one, or axes 2 and 3 are not coupled.
    fn with_rod_limits(&self, py: Python<'_>, limits: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let limits = limits.map(|limits| vector(limits, "limits", Fault::Model)).transpose()?;
        self.arm.changed(py, &build::RodLimits(limits)).map(Self::from)
    }

    /// The twin without the coupling of axes 2 and 3: its joint 3 is this one's minus joint 2. The arm itself where it has none.
    ///
    /// Its joint 3 is limited as the rod is or, where that is unknown, may stand wherever axes 2 and 3 let it, and turns as fast as both
    /// together: there and back again widens both.
    fn serial(&self, py: Python<'_>) -> PyResult<Self> {
        self.arm.changed(py, &build::Coupled(false)).map(Self::from)
    }

    /// The twin whose axes 2 and 3 a parallelogram couples: its joint 3 is this one's plus joint 2, as its controller tells it.
    ///
    /// What was the limit of joint 3 is that of the rod; joint 3 may stand wherever axes 2 and the rod let it, and turns as fast as both
    /// together: there and back again widens both.
    ///
    /// Raises:
    ///     InvalidModelError: The arm has no spherical wrist, or its axes 2 and 3 turn in opposite senses.
    fn coupled(&self, py: Python<'_>) -> PyResult<Self> {
        self.arm.changed(py, &build::Coupled(true)).map(Self::from)
    }

    /// Forward kinematics: the pose of the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Array to write to, shape (..., 4, 4), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., 4, 4), translation [m]. In a batch, a row with a NaN or inf gives NaN.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    #[pyo3(signature = (q, out=None))]
    fn fk<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        self.arm.fk(q, out)
    }

    /// Every frame of the modified Denavit-Hartenberg table after its joint, then the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., n + 1, 4, 4), translation [m].
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    fn link_frames<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.arm.link_frames(q)
    }

    /// Geometric Jacobian of the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     frame: "base", the frame in which poses are given, or "tool".
    ///     out: Array to write to, shape (..., 6, n), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Shape (..., 6, n): three linear rows [m/rad], then three angular [1].
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     ValueError: Another frame.
    #[pyo3(signature = (q, frame="base", out=None))]
    fn jacobian<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        frame: &str,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let frame = read_frame(frame)?;
        self.arm.jacobian(q, frame, out)
    }

    /// How far joint vectors are from the singularities.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///
    /// Returns:
    ///     Singularity; numbers for (n,), arrays of shape (...) for (..., n). NaN where an arm has no such singularity.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    fn singularity<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let rows = self.arm.joints(q)?;
        let records = self.arm.singularity(q.py(), rows.data()?)?;
        singularity_record(q.py(), &records, (!rows.is_single()).then_some(&rows.lead))
    }

    /// Every joint vector that brings the tool to a pose.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///     q7: Angle of joint 7 [rad], of an arm of seven joints.
    ///
    /// Returns:
    ///     Solutions, each in its slot, limits not regarded; empty with `reach` and `shortfall` when out of reach.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape, is not finite or is no rigid transform.
    ///     InvalidJointsError: q7 is not finite.
    ///     InvalidModelError: The arm has no closed form.
    ///     TypeError: q7 is missing, or the arm has six joints and it is not.
    #[pyo3(signature = (T, q7=None))]
    fn ik<'py>(&self, T: &Bound<'py, PyAny>, q7: Option<f64>) -> PyResult<Bound<'py, PySolutions>> {
        let py = T.py();
        match &self.arm {
            Arm::Six(robot) => {
                no_q7(q7.is_some())?;
                let mut found = Found::new(Arc::clone(robot), robot.unsolved(read_pose(T, "T")?));
                robot.ik_into(&mut found.solutions, 0.0).map_err(|error| to_py(py, &error))?;
                Bound::new(py, PySolutions::from(found))
            }
            Arm::Seven(robot) => {
                let q7 = needed_q7(py, robot, q7)?;
                let mut found = Found::new(Arc::clone(robot), robot.unsolved(read_pose(T, "T")?));
                check_given(q7)
                    .and_then(|()| robot.ik_into(&mut found.solutions, q7))
                    .map_err(|error| to_py(py, &error))?;
                Bound::new(py, PySolutions::from(found))
            }
        }
    }

    /// Every joint vector of many poses.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     q7: Angles of joint 7 [rad] of an arm of seven joints, of a shape that goes with (...): T and q7 are broadcast.
    ///     out: Where to write: an IkBatch or tuple of arrays (..., 8, n) float64 and (..., 8) uint8, or the first of them alone.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     IkBatch(q, status): joint angles [rad], shape (..., 8, n), NaN where a slot is empty, and `irbkin.Status` of each slot, shape
    ///     (..., 8), uint8. A row that is no pose, or whose q7 is none, has status INVALID; the others are not touched by it.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape.
    ///     InvalidJointsError: q7 has a wrong shape.
    ///     InvalidModelError: The arm has no closed form.
    ///     TypeError: q7 is missing, or the arm has six joints and it is not.
    #[pyo3(signature = (T, q7=None, *, out=None, threads=1))]
    fn ik_batch<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        batches::ik(&self.arm, T, q7, out, thread_count(threads)?)
    }

    /// The solution inside the limits that is nearest to `seed`, turns considered.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     seed: Joint vectors [rad], shape (..., n), or one for all poses, shape (n,). Of joints that the pose leaves
    ///         free, the nearest angles are taken.
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (..., n). In a batch, a row without a solution, or whose pose or seed is invalid, is NaN.
    ///
    /// Raises:
    ///     UnreachableError: A single pose has no solution inside the limits; the message says what is missing.
    ///     InvalidPoseError, InvalidJointsError, InvalidModelError: As `ik`; a seed or weight that is not finite.
    #[pyo3(signature = (T, seed, weights=None))]
    fn ik_nearest<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: &Bound<'py, PyAny>,
        weights: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        on_robot!(&self.arm, robot => {
            let pose = match read_poses(T)? {
                PoseArgument::One(pose) => pose,
                PoseArgument::Many(poses) => return Ok(paths::nearest(robot, &poses, seed, weights)?.into_any()),
            };
            let (seed, weights) = read_seed(seed, weights)?;
            let nearest = robot.ik_nearest_checked(pose, &seed, &weights).map_err(|error| to_py(T.py(), &error))?;
            Ok(PyArray1::from_slice(T.py(), &nearest.q).into_any())
        })
    }

    /// One continuous joint path along a path of poses: inside the limits, turns considered, through singularities without a jump where
    /// there is a way.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (m, 4, 4), or several paths, shape (..., m, 4, 4), translation [m].
    ///     seed: Joint vector from which a path starts [rad], shape (6,), or one for each path, shape (..., 6).
    ///     weights: Cost of moving each joint, shape (6,); ones when not given.
    ///     singular: What to do at the wrist singularity. "through": meet every pose exactly, however fast axes 4 and 6 turn. "error": stop
    ///         where joint 5 comes into the zone, and where a joint must jump, as SingArea \Off. "wrist": inside the zone axes 4, 5, 6 go
    ///         straight from where they enter to where they leave, position exact, as SingArea \Wrist. "lock_axis4": axis 4 stays at 0 or
    ///         +-180 deg all along, position exact, orientation where it can be, as SingArea \LockAxis4.
    ///     zone: |sin q5| below which `singular` acts; 0.0175, that is one degree, when not given.
    ///
    /// Returns:
    ///     FollowResult: joints [rad], shape (..., m, 6), NaN where a pose is not met; orientation error [rad], shape (..., m); the breaks.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape or holds a matrix that is no pose; the message has its index.
    ///     InvalidJointsError: A seed, weight or zone that is not finite.
    ///     InvalidModelError: The arm has no closed form or seven joints; "wrist" or "lock_axis4" for an arm without a spherical wrist.
    ///     ValueError: Another `singular`.
    #[pyo3(signature = (T, seed, weights=None, *, singular="through", zone=None))]
    fn follow<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: &Bound<'py, PyAny>,
        weights: Option<&Bound<'py, PyAny>>,
        singular: &str,
        zone: Option<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let options = FollowOptions {
            weights: read_weights(weights)?,
            crossing: read_crossing(singular)?,
            zone: zone.unwrap_or(WRIST_ZONE),
        };
        paths::follow(self.arm.follower(T.py())?, T, seed, &options)
    }

    /// ABB's confdata of joint vectors: quarter turns of axes 1, 4 and 6, and the slot.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., 6).
    ///
    /// Returns:
    ///     Configuration(cf1, cf4, cf6, cfx): integers for one joint vector, int32 arrays of shape (...) for many. cf is
    ///     floor(angle / 90 deg). cfx is the slot, 0 for an arm with coupled axes 2 and 3, whose controller does not use it.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or an angle that is not finite.
    ///     InvalidModelError: The arm has no spherical wrist: its controller counts otherwise.
    fn configuration<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        configurations::configuration(&self.arm, q)
    }

    /// The solution inside the limits that has a configuration, which chooses the turns of axes 1, 4 and 6, too.
    ///
    /// An angle within 0.01 deg of the edge of a quarter turn is taken for either side of it.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     configuration: (cf1, cf4, cf6, cfx): an `irbkin.Configuration`, or whole numbers of shape (4,) or (..., 4).
    ///     fallback: With "nearest", the solution nearest to `seed` where none has the configuration: many programs write [0, 0, 0, 0]
    ///         without having calculated it.
    ///     seed: Joint vector [rad] of the fallback, shape (6,) or (..., 6).
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (..., 6). In a batch, a row without such a solution, or whose pose or seed is invalid, is NaN.
    ///
    /// Raises:
    ///     UnreachableError: A single pose has no solution inside the limits with that configuration; the message, and its attribute
    ///         `configurations`, have those that exist.
    ///     InvalidPoseError, InvalidJointsError: A wrong shape, a pose that is none, a number of the configuration that is not whole or that
    ///         the arm does not have.
    ///     InvalidModelError: As `configuration`.
    ///     TypeError, ValueError: Another fallback, or one without a seed.
    #[pyo3(signature = (T, configuration, *, fallback=None, seed=None))]
    fn ik_configured<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        configuration: &Bound<'py, PyAny>,
        fallback: Option<&str>,
        seed: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        configurations::ik(&self.arm, T, configuration, &Fallback { name: fallback, seed })
    }

    /// Whether a pose can be reached, inside the limits or not, and why not; with seven joints, with any angle of joint 7 inside its limits.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///
    /// Returns:
    ///     PoseCheck(reachable, within_limits, reason).
    ///
    /// Raises:
    ///     InvalidPoseError, InvalidModelError: As `ik`.
    fn check_pose<'py>(&self, T: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let pose = read_pose(T, "T")?;
        let explanation = on_robot!(&self.arm, robot => robot.explain(&pose))
            .map_err(|error| to_py(T.py(), &error))?;
        let inside = matches!(explanation, Explanation::Found { .. });
        let reachable = inside
            || matches!(
                explanation,
                Explanation::OutsideLimits { .. } | Explanation::OutsideRod { .. }
            );
        errors::pose_check_class(T.py())?.call1((reachable, inside, explanation.to_string()))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Self>().is_ok_and(|other| other.get().arm == self.arm)
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        build::hash(py, &self.arm)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (State,))> {
        Ok((py.import("irbkin._core")?.getattr("_restore_robot")?, (build::state(&self.arm),)))
    }

    fn __repr__(&self) -> String {
        match self.name() {
            "" => format!("Robot({} joints, {})", self.arm.dof(), self.family()),
            name => {
                let twin = match (build::is_coupled_in_catalogue(name), self.is_coupled()) {
                    (true, false) => ".serial()",
                    (false, true) => ".coupled()",
                    _ => "",
                };
                format!("Robot(\"{name}\"){twin}")
            }
        }
    }
}
