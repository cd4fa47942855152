//! The kinematics of serial arms.

mod angles;
mod axes;
mod chain;
mod crossing;
mod dh;
mod family;
mod follow;
mod forward;
mod inverse;
mod jacobian;
mod joint_axes;
mod limits;
mod pose;
mod robot;
mod rotation;
mod select;
mod singularity;
mod solutions;
mod spherical_wrist;
mod status;
pub mod thresholds;

pub use chain::Chain;
pub use crossing::{Crossing, FollowOptions};
pub use dh::{DhRow, Mdh, Sdh};
pub use follow::{Break, BreakReason, Followed, Follower};
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
pub use robot::{Definition, Robot};
pub(crate) use select::check_weights;
#[cfg(feature = "python")]
pub(crate) use select::{Cost, check_joints};
pub use singularity::Singularity;
pub use solutions::{FreeJoint, SLOTS, Solution, Solutions};
pub use spherical_wrist::{Condition, NotRecognised, OpwParameters, Relation, SingularDistances, SphericalWrist};
pub use status::{Explanation, Reach, Status};
