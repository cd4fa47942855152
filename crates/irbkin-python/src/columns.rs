//! Answers as columns that tables of other packages are made of and as files, and a trajectory as a
//! message: `irbkin._columns` makes them of the arrays.

use pyo3::prelude::*;

use super::arm::on;
use super::rapid::program::TargetTable;
use super::records::{CatalogEntry, FollowResult, IkBatch, Plan};
use super::solutions::PySolutions;
use super::trajectory::PyTrajectory;
use irbkin::Status;

/// Call a function of `irbkin._columns`.
fn made<'py, A>(py: Python<'py>, function: &str, arguments: A) -> PyResult<Bound<'py, PyAny>>
where
    A: pyo3::call::PyCallArgs<'py>,
{
    py.import("irbkin._columns")?.call_method1(function, arguments)
}

/// Let answers be columns, which a function of `irbkin._columns` makes.
macro_rules! to_dict {
    ($($(#[$doc:meta])* $answer:ident: $function:literal,)+) => {$(
        #[pymethods]
        impl $answer {
            $(#[$doc])*
            fn to_dict<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
                made(slf.py(), $function, (slf,))
            }
        }
    )+};
}

to_dict! {
    /// Return the slots as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
    /// table: a row for each slot of each pose, empty or not.
    ///
    /// Returns:
    ///     Arrays of shape (poses * slots,) by name: `pose`, its index in row-major order; `slot`;
    ///     `found` and `within_limits`, bool; `status`, uint8; `q1` .. [rad], NaN where the slot is
    ///     empty.
    IkBatch: "of_ik_batch",

    /// Return the rows as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a table.
    ///
    /// Returns:
    ///     Arrays of shape (paths * m,) by name: `path`, its index in row-major order; `pose`;
    ///     `q1` .. [rad] and `orientation_error` [rad], NaN where a pose is not met.
    FollowResult: "of_follow_result",

    /// Return the plan as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a table.
    ///
    /// Returns:
    ///     Arrays of shape (m,) by name: `q1` .. [rad]; `tool_angle` [rad]; `slot`; `external1` ..
    ///     [m, rad] and `tolerance1` .. [rad, m] of a plan that has them; `x`, `y`, `z` of `T` [m].
    Plan: "of_plan",

    /// Return the targets as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
    /// table.
    ///
    /// Returns:
    ///     Columns of m elements by name: `kind`, `name`, `line`; `q1` .. [rad]; `cf1`, `cf4`,
    ///     `cf6`, `cfx`; `wrist` and `elbow` [rad], `shoulder` [m]; `finding`, the message or None.
    TargetTable: "of_targets",

    /// Return the figures of the arm by name, a row of a table: `pandas.DataFrame` and
    /// `polars.DataFrame` take a list of them, `[irbkin.catalog_entry(name).to_dict() for name in
    /// irbkin.catalog()]`.
    ///
    /// Returns:
    ///     `name`, `maker`, `dof`, `payload` [kg], `reach` [m], `is_coupled` and `sources`.
    CatalogEntry: "of_catalog_entry",

    /// Return the samples as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
    /// table.
    ///
    /// Returns:
    ///     Arrays of shape (m,) by name: `t` [s], `q1` .. [rad], `dq1` .. [rad/s], `ddq1` ..
    ///     [rad/s^2].
    PyTrajectory: "of_trajectory",
}

/// Let answers be written as files.
macro_rules! to_csv {
    ($($answer:ty),+) => {$(
        #[pymethods]
        impl $answer {
            /// Write comma-separated values: the columns of `to_dict` under their names, each
            /// number with all of its digits, nothing for None.
            ///
            /// Args:
            ///     path_or_file: Path of the file, or a file that is open for text.
            ///
            /// Raises:
            ///     OSError: The file cannot be written.
            fn to_csv(slf: &Bound<'_, Self>, path_or_file: &Bound<'_, PyAny>) -> PyResult<()> {
                made(slf.py(), "write_csv", (slf, path_or_file)).map(drop)
            }
        }
    )+};
}

to_csv!(PySolutions, IkBatch, FollowResult, Plan, TargetTable, PyTrajectory);

#[pymethods]
impl PySolutions {
    /// Return the solutions as columns, of which `pandas.DataFrame` and `polars.DataFrame` make a
    /// table.
    ///
    /// Returns:
    ///     Arrays of shape (k,) by name: `slot`; `q1` .. [rad]; `within_limits`, bool;
    ///     `singularities`, the values of `irbkin.SingularityKind`; and `cf1`, `cf4`, `cf6`, `cfx`
    ///     of an arm that has confdata.
    fn to_dict<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        let has_confdata = on!(&slf.get().found, found => found.robot.configuration_rule().is_ok());
        made(slf.py(), "of_solutions", (slf, has_confdata))
    }
}

#[pymethods]
impl IkBatch {
    /// Whether each slot holds a solution, bool, shape (..., slots).
    #[getter]
    fn found<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        made(py, "has_flag", (&self.status, Status::FOUND.bits()))
    }

    /// Whether each slot holds a solution inside the joint limits, bool, shape (..., slots).
    #[getter]
    fn within_limits<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        made(py, "has_flag", (&self.status, Status::WITHIN_LIMITS.bits()))
    }
}

#[pymethods]
impl PyTrajectory {
    /// Return the samples with the fields of ROS' `trajectory_msgs/JointTrajectory`. It needs no
    /// ROS; `rosidl_runtime_py.set_message_fields` fills a message with it.
    ///
    /// Args:
    ///     joint_names: Names of the joints in ROS; when not given, as in the file of the robot
    ///         whose `go` made the motion, else `joint_1` .. as in `robot.to_urdf()`.
    ///
    /// Returns:
    ///     {"joint_names": [..], "points": [..]}. A point has `positions` [rad], `velocities`
    ///     [rad/s] and `accelerations` [rad/s^2], lists of n floats, and `time_from_start`:
    ///     {"sec": .., "nanosec": ..}.
    ///
    /// Raises:
    ///     InvalidJointsError: There is not one name for each joint.
    #[pyo3(signature = (joint_names=None))]
    fn to_joint_trajectory<'py>(
        slf: &Bound<'py, Self>,
        joint_names: Option<Vec<String>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        made(slf.py(), "of_joint_trajectory", (slf, joint_names))
    }
}
