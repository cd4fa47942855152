//! The exceptions, enumerations and records that `irbkin` defines in Python, raised and made from here.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;
use pyo3::types::PyTuple;

use super::configurations::record;
use crate::error::{Error, FrameFault, NoConfiguration, RapidFault};
use crate::kinematics::Status;
use crate::report::Reach;

/// An attribute of a Python module of the package, looked up once.
macro_rules! package_object {
    ($name:ident, $module:literal, $attribute:literal) => {
        pub(super) fn $name(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
            static OBJECT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
            OBJECT
                .get_or_try_init(py, || Ok(py.import($module)?.getattr($attribute)?.unbind()))
                .map(|object| object.bind(py))
        }
    };
}

package_object!(invalid_pose_error, "irbkin.errors", "InvalidPoseError");
package_object!(invalid_joints_error, "irbkin.errors", "InvalidJointsError");
package_object!(invalid_model_error, "irbkin.errors", "InvalidModelError");
package_object!(unknown_robot_error, "irbkin.errors", "UnknownRobotError");
package_object!(unreachable_error, "irbkin.errors", "UnreachableError");
package_object!(configuration_class, "irbkin.records", "Configuration");
package_object!(rapid_error, "irbkin.errors", "RapidError");
package_object!(rob_target_class, "irbkin.rapid.records", "RobTarget");
package_object!(joint_target_class, "irbkin.rapid.records", "JointTarget");
package_object!(tool_data_class, "irbkin.rapid.records", "ToolData");
package_object!(wobj_data_class, "irbkin.rapid.records", "WobjData");
package_object!(rapid_pose_class, "irbkin.rapid.records", "Pose");
package_object!(load_data_class, "irbkin.rapid.records", "LoadData");
package_object!(declaration_class, "irbkin.rapid.program", "Declaration");
package_object!(argument_class, "irbkin.rapid.program", "Argument");
package_object!(move_class, "irbkin.rapid.program", "Move");
package_object!(skipped_class, "irbkin.rapid.program", "Skipped");
package_object!(target_table_class, "irbkin.rapid.program", "TargetTable");
package_object!(kind_class, "irbkin.records", "Kind");
package_object!(status_class, "irbkin.records", "Status");
package_object!(reach_class, "irbkin.records", "Reach");
package_object!(ik_batch_class, "irbkin.records", "IkBatch");
package_object!(singularity_class, "irbkin.records", "Singularity");
package_object!(free_joint_class, "irbkin.records", "FreeJoint");
package_object!(break_class, "irbkin.records", "Break");
package_object!(follow_result_class, "irbkin.records", "FollowResult");
package_object!(pose_check_class, "irbkin.records", "PoseCheck");

/// What kind of input was wrong: which exception tells of it.
#[derive(Clone, Copy)]
pub(super) enum Fault {
    Pose,
    Joints,
    Model,
}

impl Fault {
    /// The exception for this input with a message.
    pub(super) fn error(self, py: Python<'_>, message: String) -> PyErr {
        let class = match self {
            Self::Pose => invalid_pose_error(py),
            Self::Joints => invalid_joints_error(py),
            Self::Model => invalid_model_error(py),
        };
        raised(class, message)
    }
}

fn raised(class: PyResult<&Bound<'_, PyAny>>, message: String) -> PyErr {
    class
        .and_then(|class| class.call1((message,)))
        .map_or_else(|failure| failure, PyErr::from_value)
}

/// The Python exception of a core error.
pub(super) fn to_py(py: Python<'_>, error: &Error) -> PyErr {
    let class = match error {
        Error::InvalidPose(_) | Error::Frame(FrameFault::Pose { .. }) => invalid_pose_error(py),
        Error::InvalidJoints(_) => invalid_joints_error(py),
        Error::InvalidModel(_) | Error::WrongLength { .. } => invalid_model_error(py),
        Error::UnknownRobot(_) => unknown_robot_error(py),
        Error::Unreachable(_) => unreachable_error(py),
        Error::NoConfiguration(fault) => return no_configuration(py, fault),
        Error::Rapid(fault) => return broken_text(py, fault),
        Error::Frame(_) => rapid_error(py),
        Error::NoInstructionSet { .. } => return PyValueError::new_err(error.to_string()),
    };
    raised(class, error.to_string())
}

/// A `RapidError` that has no place in a text.
pub(super) fn rapid_fault(py: Python<'_>, message: String) -> PyErr {
    raised(rapid_error(py), message)
}

/// With the line and the column as attributes.
fn broken_text(py: Python<'_>, fault: &RapidFault) -> PyErr {
    let error = rapid_fault(py, fault.to_string());
    let value = error.value(py);
    let told =
        value.setattr("line", fault.line).and_then(|()| value.setattr("column", fault.column));
    told.map_or_else(|failure| failure, |()| error)
}

/// With the configurations that exist as an attribute.
fn no_configuration(py: Python<'_>, fault: &NoConfiguration) -> PyErr {
    let error = raised(unreachable_error(py), fault.to_string());
    let existing =
        fault.existing.iter().map(|existing| record(py, existing)).collect::<PyResult<Vec<_>>>();
    let told = existing.and_then(|existing| {
        error.value(py).setattr("configurations", PyTuple::new(py, existing)?)
    });
    told.map_or_else(|failure| failure, |()| error)
}

pub(super) fn kinds(py: Python<'_>, status: Status) -> PyResult<Bound<'_, PyAny>> {
    kind_class(py)?.call1(((status & Status::KINDS).bits(),))
}

pub(super) fn status(py: Python<'_>, status: Status) -> PyResult<Bound<'_, PyAny>> {
    status_class(py)?.call1((status.bits(),))
}

pub(super) fn reach(py: Python<'_>, reach: Reach) -> PyResult<Bound<'_, PyAny>> {
    reach_class(py)?.getattr(match reach {
        Reach::Reached => "REACHED",
        Reach::TooFar { .. } => "TOO_FAR",
        Reach::TooNear { .. } => "TOO_NEAR",
    })
}
