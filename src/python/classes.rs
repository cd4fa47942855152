//! Exceptions, enumerations and options that `irbkin` defines in Python, looked up once.

use pyo3::prelude::*;
use pyo3::sync::PyOnceLock;

/// An attribute of a Python module of the package, looked up once.
macro_rules! package_object {
    ($name:ident, $module:literal, $attribute:literal) => {
        pub(super) fn $name(py: Python<'_>) -> PyResult<&Bound<'_, PyAny>> {
            static OBJECT: PyOnceLock<Py<PyAny>> = PyOnceLock::new();
            looked_up(py, &OBJECT, [$module, $attribute])
        }
    };
}

/// The body of all of them, compiled once.
#[inline(never)]
fn looked_up<'py>(
    py: Python<'py>,
    object: &'static PyOnceLock<Py<PyAny>>,
    [module, attribute]: [&str; 2],
) -> PyResult<&'py Bound<'py, PyAny>> {
    object
        .get_or_try_init(py, || Ok(py.import(module)?.getattr(attribute)?.unbind()))
        .map(|object| object.bind(py))
}

package_object!(irbkin_error, "irbkin.errors", "IrbkinError");
package_object!(invalid_pose_error, "irbkin.errors", "InvalidPoseError");
package_object!(invalid_joints_error, "irbkin.errors", "InvalidJointsError");
package_object!(invalid_model_error, "irbkin.errors", "InvalidModelError");
package_object!(invalid_motion_error, "irbkin.errors", "InvalidMotionError");
package_object!(unknown_robot_error, "irbkin.errors", "UnknownRobotError");
package_object!(unreachable_error, "irbkin.errors", "UnreachableError");
package_object!(rapid_error, "irbkin.errors", "RapidError");
package_object!(unknown_name_error, "irbkin.errors", "UnknownNameError");
package_object!(kind_class, "irbkin.records", "SingularityKind");
package_object!(status_class, "irbkin.records", "Status");
package_object!(reach_class, "irbkin.records", "Reach");
package_object!(break_reason_class, "irbkin.records", "BreakReason");
package_object!(path_error, "irbkin.errors", "PathError");
package_object!(tool_rotation_class, "irbkin.freedom", "ToolRotation");
package_object!(tool_cone_class, "irbkin.freedom", "ToolCone");
package_object!(tool_offset_class, "irbkin.freedom", "ToolOffset");
package_object!(track_class, "irbkin.freedom", "Track");
package_object!(positioner_class, "irbkin.freedom", "Positioner");
