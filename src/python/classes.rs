//! The exceptions, enumerations and records that `irbkin` defines in Python, looked up once.

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
package_object!(catalog_entry_class, "irbkin.records", "CatalogEntry");
package_object!(configuration_class, "irbkin.records", "Configuration");
package_object!(configuration_batch_class, "irbkin.records", "ConfigurationBatch");
package_object!(rob_target_class, "irbkin.rapid.records", "RobTarget");
package_object!(joint_target_class, "irbkin.rapid.records", "JointTarget");
package_object!(tool_data_class, "irbkin.rapid.records", "ToolData");
package_object!(wobj_data_class, "irbkin.rapid.records", "WobjData");
package_object!(rapid_pose_class, "irbkin.rapid.records", "Pose");
package_object!(load_data_class, "irbkin.rapid.records", "LoadData");
package_object!(speed_data_class, "irbkin.rapid.records", "SpeedData");
package_object!(zone_data_class, "irbkin.rapid.records", "ZoneData");
package_object!(declaration_class, "irbkin.rapid.program", "Declaration");
package_object!(argument_class, "irbkin.rapid.program", "Argument");
package_object!(move_class, "irbkin.rapid.program", "Move");
package_object!(motion_move_class, "irbkin.rapid.program", "MotionMove");
package_object!(finding_class, "irbkin.rapid.program", "Finding");
package_object!(motion_settings_class, "irbkin.rapid.program", "MotionSettings");
package_object!(diagnostic_class, "irbkin.rapid.program", "Diagnostic");
package_object!(skipped_class, "irbkin.rapid.program", "Skipped");
package_object!(target_table_class, "irbkin.rapid.program", "TargetTable");
package_object!(kind_class, "irbkin.records", "SingularityKind");
package_object!(status_class, "irbkin.records", "Status");
package_object!(reach_class, "irbkin.records", "Reach");
package_object!(ik_batch_class, "irbkin.records", "IkBatch");
package_object!(margin_class, "irbkin.records", "Margin");
package_object!(ik_margin_class, "irbkin.records", "IkMargin");
package_object!(singularity_class, "irbkin.records", "Singularity");
package_object!(singularity_batch_class, "irbkin.records", "SingularityBatch");
package_object!(free_joint_class, "irbkin.records", "FreeJoint");
package_object!(break_class, "irbkin.records", "Break");
package_object!(break_reason_class, "irbkin.records", "BreakReason");
package_object!(follow_result_class, "irbkin.records", "FollowResult");
package_object!(trajectory_sample_class, "irbkin.records", "TrajectorySample");
package_object!(motion_peaks_class, "irbkin.records", "MotionPeaks");
package_object!(tool_speed_limits_class, "irbkin.records", "ToolSpeedLimits");
package_object!(path_error, "irbkin.errors", "PathError");
package_object!(plan_class, "irbkin.records", "Plan");
package_object!(plan_break_class, "irbkin.records", "PlanBreak");
package_object!(tool_rotation_class, "irbkin.freedom", "ToolRotation");
package_object!(tool_cone_class, "irbkin.freedom", "ToolCone");
package_object!(tool_offset_class, "irbkin.freedom", "ToolOffset");
package_object!(track_class, "irbkin.freedom", "Track");
package_object!(positioner_class, "irbkin.freedom", "Positioner");
package_object!(strand_end_class, "irbkin.records", "StrandEnd");
package_object!(pose_check_class, "irbkin.records", "PoseCheck");
