//! The kinematics of serial arms.

mod angles;
mod axes;
mod block;
mod branches;
mod chain;
mod configuration;
mod crossing;
mod dh;
mod family;
mod follow;
mod forward;
mod free_choice;
mod geometry;
mod inverse;
mod jacobian;
mod joint_axes;
mod limits;
mod placement;
mod planar_arm;
mod pose;
mod recognition;
mod redundancy;
mod robot;
mod rotation;
mod select;
mod self_motion;
mod singularity;
mod solutions;
mod spherical_shoulder;
mod spherical_wrist;
mod status;
mod surroundings;
mod three_parallel;
pub mod thresholds;
mod zyz;

pub(crate) use angles::constant_sin_cos;
pub use chain::Chain;
pub use configuration::Configuration;
pub use crossing::{Crossing, FollowOptions};
pub use dh::{DhRow, Mdh, Sdh};
pub use follow::{Break, BreakReason, Followed, Follower};
pub(crate) use inverse::Inverse;
#[cfg(feature = "python")]
pub(crate) use inverse::check_given;
pub use jacobian::JacobianFrame;
pub use joint_axes::JointAxis;
#[cfg(feature = "urdf")]
pub(crate) use joint_axes::unit;
pub use limits::JointLimits;
#[cfg(feature = "urdf")]
pub(crate) use pose::constant_pose;
pub use pose::{
    Pose, PoseError, pose_from_euler_zyx, pose_from_quaternion, pose_from_rows, pose_to_euler_zyx, pose_to_quaternion, pose_to_rows,
};
pub use recognition::{Condition, NotRecognised, Relation};
pub use robot::{Definition, Robot};
#[cfg(feature = "python")]
pub(crate) use select::Cost;
pub(crate) use select::{check_joints, check_weights};
pub use singularity::{SingularDistances, Singularity};
pub use solutions::{FreeJoint, SLOTS, Solution, Solutions};
pub use spherical_shoulder::SphericalShoulder;
pub use spherical_wrist::{OpwParameters, SphericalWrist};
pub use status::{Explanation, Reach, Status};
pub use three_parallel::ThreeParallel;
