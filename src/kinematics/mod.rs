//! The kinematics of serial arms.

mod answer;
mod chain;
mod path;
mod pose;
mod robot;
mod solve;
mod structure;
pub mod thresholds;

pub use answer::check::{check_joints, check_near, check_seed, check_weights};
pub use answer::request::ConfigurationRequest;
pub use answer::select::Cost;
pub use answer::singularity::{SingularDistances, Singularity};
pub use answer::slot::{MOST_SLOTS, Slot};
pub use answer::solutions::{Solution, Solutions};
pub use answer::status::{SingularityKind, Status};
pub use chain::axes::Axes;
pub use chain::corrections::Corrections;
pub use chain::dh::{DhRow, Mdh, Sdh, check_snap, screw_x};
pub use chain::jacobian::JacobianFrame;
pub use chain::joint_axes::{JointAxis, unit};
pub use chain::limits::{JointLimits, at_limit};
pub use path::follow::{
    Break, BreakReason, Followed, Follower, Progress, largest, largest_step, steps,
};
pub use path::singularity_mode::{FollowOptions, SingularityMode};
pub use pose::angles::{angle_between, constant_sin_cos, nearest_turn, rotation_vector, snapped};
pub use pose::matrix::{pose_from_isometry, pose_from_matrix, pose_to_isometry, pose_to_matrix};
pub use pose::{
    Pose, PoseDifference, checked_pose, constant_pose, pose_from_euler_zyx, pose_from_rotation,
    pose_from_rotvec, pose_from_rows, pose_from_wxyz, pose_from_xyzw, pose_to_euler_zyx,
    pose_to_rows, pose_to_wxyz,
};
pub use robot::any::{AnyRobot, ByJoints};
pub use robot::build::POSTURES;
pub use robot::{Definition, Joints, Margin, Robot};
pub use solve::configuration::fault::NoConfiguration;
pub use structure::inverse::Rows;
pub use structure::spherical_wrist::OpwParameters;
