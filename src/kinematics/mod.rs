//! The kinematics of serial arms.

mod answer;
mod chain;
mod path;
mod pose;
mod robot;
mod solve;
mod structure;
pub mod thresholds;

#[cfg(feature = "python")]
pub(crate) use answer::select::Cost;
pub(crate) use answer::select::{check_joints, check_weights};
pub use answer::singularity::{SingularDistances, Singularity};
pub use answer::solutions::{FreeJoint, SLOTS, Solution, Solutions};
pub use answer::status::{Explanation, Reach, Status};
pub use chain::Chain;
pub use chain::dh::{DhRow, Mdh, Sdh};
pub use chain::jacobian::JacobianFrame;
pub use chain::joint_axes::JointAxis;
#[cfg(feature = "urdf")]
pub(crate) use chain::joint_axes::unit;
pub use chain::limits::JointLimits;
pub use path::crossing::{Crossing, FollowOptions};
pub use path::follow::{Break, BreakReason, Followed, Follower};
#[cfg(feature = "rapid")]
pub(crate) use pose::angles::constant_sin_cos;
#[cfg(feature = "urdf")]
pub(crate) use pose::constant_pose;
pub use pose::{
    Pose, PoseError, pose_from_euler_zyx, pose_from_quaternion, pose_from_rows, pose_to_euler_zyx,
    pose_to_quaternion, pose_to_rows,
};
pub use robot::{Definition, Robot};
pub use solve::configuration::Configuration;
pub(crate) use solve::inverse::Inverse;
#[cfg(feature = "python")]
pub(crate) use solve::inverse::check_given;
pub use structure::recognition::{Condition, NotRecognised, Relation};
pub use structure::spherical_shoulder::SphericalShoulder;
pub use structure::spherical_wrist::{OpwParameters, SphericalWrist};
pub use structure::three_parallel::ThreeParallel;
