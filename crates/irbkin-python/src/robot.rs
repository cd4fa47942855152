//! `irbkin.Robot`: the class, what it has and how it is changed. Its other methods are in `models`,
//! `bodies`, `queries` and `inverse`.

use std::sync::{Arc, OnceLock};

use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyAttributeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arm::{SharedArm, changed, named, on};
use super::arrays::{Rows, vector};
use super::errors::{Fault, exception};
use super::freedoms::{class, read_carrier};
use super::outputs::read_only;
use super::rapid::class::ToolData;
use super::rapid::records::carried_tool;
use super::state::{Reduced, hash_of, reduced};
use super::targets::{pose_array, read_frame};
use irbkin::Robot;
use irbkin::pose::to_rows as pose_to_rows;
use irbkin_motion::Arm;

/// A robot arm of six or seven joints: `Robot("IRB 2600-12/1.65")`.
///
/// Frozen, hashable, equal by value, picklable. Other arms come from `from_mdh`, `from_sdh`,
/// `from_opw`, `from_urdf` and `from_robotstudio`. Its arrays are read-only: change a copy, and
/// pass that to `with_limits`, `with_tool` or `with_base`.
///
/// Args:
///     name: Catalog name or alias, the maker's name before it or not; case, blanks, -, _, /,
///         commas and parentheses do not matter. `irbkin.catalog()` lists the names.
///     tool: As of `with_tool`; the flange when not given.
///     base: As of `with_base`; the world when not given.
///
/// Raises:
///     UnknownRobotError: No arm of that name; the message has up to six close ones, the closest
///         first, or why the arm is left out of the catalog.
///     InvalidPoseError, RapidError: As `with_tool` and `with_base`.
#[pyclass(name = "Robot", module = "irbkin", eq, frozen, weakref)]
pub(super) struct PyRobot {
    arm: SharedArm,
    /// By joint: the arm with it locked, as it was prepared first.
    pub(super) locked: [OnceLock<Arc<Arm<7>>>; 7],
}

impl PyRobot {
    pub(super) fn arm(&self) -> &SharedArm {
        &self.arm
    }
}

impl PartialEq for PyRobot {
    fn eq(&self, other: &Self) -> bool {
        self.arm == other.arm
    }
}

impl From<SharedArm> for PyRobot {
    fn from(arm: SharedArm) -> Self {
        Self { arm, locked: Default::default() }
    }
}

#[pymethods]
#[expect(non_snake_case, reason = "T is the name that users pass")]
impl PyRobot {
    #[new]
    #[pyo3(signature = (name, *, tool=None, base=None))]
    fn new(
        name: &str,
        tool: Option<&Bound<'_, PyAny>>,
        base: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let mut robot = Self::from(named(name).map_err(exception)?);
        if let Some(tool) = tool {
            robot = robot.with_tool(tool)?;
        }
        if let Some(base) = base {
            robot = robot.with_base(base)?;
        }
        Ok(robot)
    }

    /// Catalog name, or the name given by the caller.
    #[getter]
    fn name(&self) -> &str {
        on!(&self.arm, robot => robot.name())
    }

    /// Number of joints.
    #[getter]
    fn dof(&self) -> usize {
        self.arm.dof()
    }

    /// Names of the joints, as in the URDF that the robot was read from; "J1" .. of any other.
    #[getter]
    fn joint_names<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let names = self.file_joint_names();
        let numbered = || (1..=self.arm.dof()).map(|joint| format!("J{joint}")).collect();
        PyTuple::new(py, names.unwrap_or_else(numbered))
    }

    /// The names that a file gives the joints; None without a file.
    #[getter(_file_joint_names)]
    pub(super) fn file_joint_names(&self) -> Option<Vec<String>> {
        on!(&self.arm, robot => robot.joint_names().map(<[String]>::to_vec))
    }

    /// Kinematic structure: "spherical wrist", "three parallel axes", "spherical shoulder", "offset
    /// wrist", "pan, three parallel axes, roll", or "general" for any other; "refined spherical
    /// wrist" or "refined three parallel axes" after `with_nominal`; "unknown" if the first six
    /// joints are not independent. `print(robot)` shows what keeps the arm from a closed form, which
    /// is faster, and a `snap` or another reading of its table that would give it one.
    #[getter]
    fn structure(&self) -> &'static str {
        on!(&self.arm, robot => robot.structure())
    }

    /// Modified Denavit-Hartenberg rows: alpha [rad], a [m], d [m], theta offset [rad], shape (n,
    /// 4). `flange` follows the last row. Read-only: `from_mdh` takes another table.
    #[getter]
    fn mdh(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let rows: Vec<f64> = on!(&self.arm, robot => {
            robot.mdh().rows.iter().flat_map(|row| row.to_array()).collect()
        });
        PyArray1::from_vec(py, rows).reshape([self.arm.dof(), 4]).map(read_only)
    }

    /// Fixed transform from the base to the frame before the first row of `mdh`, shape (4, 4).
    #[getter]
    fn _root(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        on!(&self.arm, robot => read_only(pose_array(py, &robot.mdh().base)))
    }

    /// Fixed transform from the last frame of `mdh` to the flange, shape (4, 4).
    #[getter]
    fn flange(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        on!(&self.arm, robot => read_only(pose_array(py, &robot.mdh().flange)))
    }

    /// Pose of the base in the world, shape (4, 4). Read-only: `with_base` takes another one.
    #[getter]
    fn base(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        on!(&self.arm, robot => read_only(pose_array(py, robot.base())))
    }

    /// Pose of the tool center point in the flange frame, shape (4, 4). Read-only: `with_tool`
    /// takes another one.
    #[getter]
    fn tool(&self, py: Python<'_>) -> Py<PyArray2<f64>> {
        on!(&self.arm, robot => read_only(pose_array(py, robot.tool())))
    }

    /// Lower and upper limit of each joint [rad], shape (n, 2); infinite where a joint has none.
    /// Read-only: change a copy, and pass that to `with_limits`.
    #[getter]
    fn limits(&self, py: Python<'_>) -> PyResult<Py<PyArray2<f64>>> {
        let flat = on!(&self.arm, robot => robot.limits().to_array().concat());
        PyArray1::from_vec(py, flat).reshape([self.arm.dof(), 2]).map(read_only)
    }

    /// Largest velocity of each joint [rad/s], shape (n,), or None where it is not known. Read-only.
    #[getter]
    fn max_velocity(&self, py: Python<'_>) -> Option<Py<PyArray1<f64>>> {
        on!(&self.arm, robot => {
            robot.max_velocity().map(|velocity| read_only(PyArray1::from_slice(py, velocity)))
        })
    }

    /// Draw joint vectors uniformly inside the limits, of a linkage too. A joint without limits is
    /// within +-180 deg, one with a single limit within a full turn of it; a joint of `locked`
    /// stays at its angle.
    ///
    /// Args:
    ///     n: Number of joint vectors; one alone, without a leading dimension, when not given.
    ///     rng: A `numpy.random.Generator`, or a seed for one; a seed of the system's when not
    ///         given.
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (n, dof), or (dof,) without n.
    ///
    /// Raises:
    ///     InvalidModelError: The limits of axes 2 and 3 leave a linkage no room.
    #[pyo3(signature = (n=None, rng=None))]
    fn random<'py>(
        slf: &Bound<'py, Self>,
        n: Option<&Bound<'py, PyAny>>,
        rng: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, arm) = (slf.py(), slf.get().arm());
        let rows: Vec<_> = on!(arm, robot => robot.free_ranges().concat());
        let limits = PyArray1::from_vec(py, rows).reshape([arm.dof(), 2])?;
        py.import("irbkin._random_joints")?.call_method1("draw", (slf, limits, n, rng))
    }

    /// Return the robot with another tool, in place of the one that it had.
    ///
    /// Args:
    ///     T: Pose of the tool center point in the flange frame, shape (4, 4), translation [m]; or
    ///         its translation alone, shape (3,); or a `rapid.ToolData` that the robot holds.
    ///
    /// Raises:
    ///     InvalidPoseError: T is not a rigid transform, has a wrong shape, or is longer than ten
    ///         times the size of the arm.
    ///     RapidError: The tool is stationary.
    fn with_tool(&self, T: &Bound<'_, PyAny>) -> PyResult<Self> {
        let tool = match T.extract() {
            Ok(ToolData(tool)) => carried_tool(&tool)?,
            Err(_) => read_frame(T, "with_tool")?,
        };
        on!(&self.arm, arm => Ok(changed(arm, |robot| robot.with_tool(&tool))?.into()))
    }

    /// Return the robot with another base, in place of the one that it had; poses are then given in
    /// the world. A rail moves and turns with the base, which stays at its position there.
    ///
    /// Args:
    ///     T: Pose of the base in the world, shape (4, 4), translation [m]; or its translation
    ///         alone, shape (3,).
    ///
    /// Raises:
    ///     InvalidPoseError: T is not a rigid transform or has a wrong shape.
    fn with_base(&self, T: &Bound<'_, PyAny>) -> PyResult<Self> {
        let base = read_frame(T, "with_base")?;
        on!(&self.arm, arm => Ok(changed(arm, |robot| robot.with_base(&base))?.into()))
    }

    /// The rail or lift that carries the base, an `irbkin.Track` for `plan`, of a robot whose URDF
    /// or MJCF has a prismatic joint before all that turn; None of any other robot. `at` moves the
    /// base along it.
    #[getter]
    fn carrier<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyAny>>> {
        let Some(track) = on!(self.arm(), robot => robot.carrier()) else { return Ok(None) };
        let [lower, upper] = track.range();
        let [x, y, z] = track.direction().map(|part| part + 0.0);
        let fields = ((x, y, z), lower, upper, track.steps(), track.max_velocity(), track.weight());
        class(py, "Track")?.call1(fields).map(Some)
    }

    /// Return the robot with its base at a position on the rail or lift that carries it.
    ///
    /// Args:
    ///     position: Where the file's joint is [m], within the limits of `carrier`, shape () or
    ///         (1,), as a row of `Plan.external`.
    ///
    /// Raises:
    ///     InvalidJointsError: position is not finite or outside the limits, or has a wrong shape.
    ///     InvalidModelError: The robot has no carrier: `with_base` moves it.
    fn at(&self, position: &Bound<'_, PyAny>) -> PyResult<Self> {
        let fits = |shape: &[usize]| matches!(shape, [] | [1]);
        let read = Rows::shaped(position, || "() or (1,)", "position", Fault::Joints, fits)?;
        let moved = on!(&self.arm, arm => arm.at(read.data()?[0]).map(SharedArm::from));
        Ok(moved.map_err(exception)?.into())
    }

    /// Return the robot as the work object sees it, with carriers at their values [m, rad].
    fn _carried(&self, carrier: &Bound<'_, PyAny>, values: Vec<f64>) -> PyResult<Self> {
        let axes = read_carrier(carrier)?;
        let carried = on!(&self.arm, arm => arm.carried(&axes, values).map(SharedArm::from));
        Ok(carried.map_err(exception)?.into())
    }

    /// Whether axes 2 and 3 are coupled, by a parallelogram linkage or by the controller: q3 is then
    /// measured from the base.
    #[getter]
    fn is_coupled(&self) -> bool {
        on!(&self.arm, robot => robot.is_coupled())
    }

    /// Lower and upper limit of the serial joint 3 [rad], shape (2,), of a robot with coupled axes 2
    /// and 3: of q3 of `uncoupled()`. None where none are known.
    #[getter]
    fn linkage_limits(&self, py: Python<'_>) -> Option<Py<PyArray1<f64>>> {
        on!(&self.arm, robot => robot.limits().linkage())
            .map(|linkage| read_only(PyArray1::from_slice(py, &linkage)))
    }

    /// Return the robot, whose axes 2 and 3 are coupled, with other limits of the serial joint 3,
    /// the angle of a parallelogram linkage.
    ///
    /// Args:
    ///     limits: Lower and upper limit of q3 of `uncoupled()` [rad], shape (2,), met by any 2 pi
    ///         equivalent; None for none.
    ///
    /// Raises:
    ///     InvalidModelError: A limit is NaN, the lower one is above the upper one, or axes 2 and 3
    ///         are not coupled.
    fn with_linkage_limits(&self, limits: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let limits = limits.map(|limits| vector(limits, "limits", Fault::Model)).transpose()?;
        on!(&self.arm, arm => Ok(changed(arm, |robot| robot.with_linkage_limits(limits))?.into()))
    }

    /// Return the twin without the coupling of axes 2 and 3: its q3 is this robot's q3 - q2 or, if
    /// the axes turn in opposite senses, q3 + q2. The robot itself where it has no coupling.
    ///
    /// The limits of its joint 3 are `linkage_limits` or, where these are not known, the range of
    /// its q3 inside the limits of both axes. Its velocity is the sum of both. `coupled()` of the
    /// twin therefore has wider limits and a higher velocity than this robot.
    fn uncoupled(&self) -> PyResult<Self> {
        on!(&self.arm, arm => Ok(changed(arm, |robot| Ok(robot.uncoupled()))?.into()))
    }

    /// Return the twin whose axes 2 and 3 are coupled: it measures q3 from the base, as controllers
    /// do of arms with a parallelogram linkage, and Fanuc's pendants of all. Its q3 is this robot's
    /// q3 + q2 or, if axes 2 and 3 turn in opposite senses, as in Fanuc's URDFs, q3 - q2.
    ///
    /// The limits of joint 3 become `linkage_limits`. The limits of its joint 3 are the range that
    /// axis 2 and the linkage allow, and its velocity is the sum of both. `uncoupled()` of the twin
    /// therefore has wider limits and a higher velocity than this robot.
    ///
    /// Raises:
    ///     InvalidModelError: Axes 2 and 3 are not parallel, the arm has seven joints, or it is a
    ///         GoFa, whose controller measures joint 3 from the upper arm.
    fn coupled(&self) -> PyResult<Self> {
        on!(&self.arm, arm => Ok(changed(arm, Robot::coupled)?.into()))
    }

    #[expect(clippy::unused_self, reason = "the arguments of Python's slot")]
    fn __setattr__(&self, name: &str, _value: &Bound<'_, PyAny>) -> PyResult<()> {
        let own = match name {
            "tool" | "base" | "limits" | "body" => format!("with_{name}"),
            "name" | "max_velocity" => "from_mdh or from_urdf".to_owned(),
            _ => "a name of your own".to_owned(),
        };
        let message = format!("a Robot is frozen, '{name}' cannot be set: use {own}");
        Err(PyAttributeError::new_err(message))
    }

    fn __hash__(&self) -> u64 {
        on!(&self.arm, robot => {
            let rows = robot.mdh().rows.iter().flat_map(|row| row.to_array());
            let frames = [robot.base(), robot.tool()].into_iter().flat_map(pose_to_rows);
            let limits = robot.limits().to_array().into_iter().flatten();
            hash_of(robot.name(), rows.chain(frames).chain(limits))
        })
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Robot", &self.arm)
    }

    fn __repr__(&self) -> String {
        on!(&self.arm, robot => {
            if let Some((joint, angle)) = robot.locked_joint() {
                let arm = self.unlocked().unwrap_or_else(|_| self.arm.clone());
                return format!("{}.locked({{{joint}: {angle:?}}})", Self::from(arm).__repr__());
            }
            let name = robot.name();
            if named(name).is_ok_and(|named| named == self.arm) {
                return format!("Robot({name:?})");
            }
            let label = if name.is_empty() { String::new() } else { format!(" {name:?}") };
            let coupled = if robot.is_coupled() { ", coupled" } else { "" };
            let snap = robot.missing_form().and_then(|missing| missing.helpful_snap());
            let snap = snap.map_or_else(String::new, |it| format!(" (by rounded angles: {it})"));
            let (dof, structure) = (self.arm.dof(), robot.structure());
            let remark = robot.tip_remark().map_or_else(String::new, |it| format!(", {it}"));
            let limits = robot.joint_names().and_then(|_| robot.limits_of_the_catalog());
            let limits = limits.map_or_else(String::new, |it| format!(", {it}"));
            let rail = robot.carrier().map(|it| it.range());
            let rail = rail.map_or_else(String::new, |[a, b]| format!(" on a rail of {a} to {b} m"));
            format!("<Robot{label}{rail}: {dof} joints, {structure}{snap}{coupled}{remark}{limits}>")
        })
    }

    /// The representation, the table of the joints and, for an arm without a closed form, what
    /// keeps it from one.
    fn __str__(slf: &Bound<'_, Self>) -> PyResult<String> {
        let table = slf.py().import("irbkin._shown")?.call_method1("of_robot", (slf,))?;
        let missing =
            on!(&slf.get().arm, robot => robot.missing_form().map(|form| form.to_string()));
        let form = missing.map_or_else(String::new, |form| format!("\n{form}"));
        Ok(format!("{}\n{table}{form}", slf.get().__repr__()))
    }
}
