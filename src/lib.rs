//! Kinematics of ABB IRB, Universal Robots and Franka arms: every inverse-kinematics solution, with
//! its configuration, joint limits and singularities. No solve allocates.
//!
//! All eight solutions for a pose of an IRB 2600:
//!
//! ```
//! use irbkin::Robot;
//!
//! let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
//! let pose = robot.fk(&[0.3, -0.2, 0.4, 0.5, -0.6, 0.7]);
//! let solutions = robot.ik(&pose)?;
//! assert_eq!(solutions.len(), 8);
//! for solution in &solutions {
//!     assert!(robot.residual(&solution.q, &pose).largest() < 1e-14);
//! }
//! # Ok::<(), irbkin::Error>(())
//! ```
//!
//! The solution nearest to the current joints, as a controller needs it:
//!
//! ```
//! use irbkin::{Robot, pose};
//!
//! let robot: Robot<6> = Robot::named("irb 1200 5/0.9")?;
//! let pose = pose::from_wxyz([0.45, 0.1, 0.6], [0.5, 0.0, 0.75_f64.sqrt(), 0.0])?;
//! let here = [0.2, 0.0, 0.3, 0.0, 0.5, 0.0];
//! let next = robot.ik_nearest(&pose, &here, &[1.0; 6])?;
//! assert!(next.is_within_limits());
//! # Ok::<(), irbkin::Error>(())
//! ```
//!
//! Code that is generic over the number of joints, with one of seven locked:
//!
//! ```
//! use irbkin::{Error, Pose, Robot};
//!
//! fn count<const N: usize>(robot: &Robot<N>, pose: &Pose) -> Result<usize, Error> {
//!     Ok(robot.ik_with(pose, None)?.len())
//! }
//!
//! let ur5e: Robot<6> = Robot::named("UR5e")?;
//! assert_eq!(count(&ur5e, &ur5e.fk(&[0.3, -1.2, 1.4, -0.5, 0.6, 0.7]))?, 8);
//! let panda: Robot<7> = Robot::named("Panda")?;
//! let pose = panda.fk(&[0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6]);
//! assert!(count(&panda.locked(3, 0.2)?, &pose)? > 0);
//! # Ok::<(), irbkin::Error>(())
//! ```
//!
//! | feature | default | provides |
//! |---|---|---|
//! | `std` | yes | threads in a batch, choice of the instruction set, close names |
//! | `libm` | | square roots and angles without `std` (a solve never allocates, either way) |
//! | `serde` | | `Serialize` and `Deserialize`, see below |
//!
//! Arms with bodies, cells, plans and URDF are in `irbkin-motion`, RAPID and EGM in `irbkin-abb`.
//!
//! `serde` is implemented for robots ([`Robot`], with limits, velocities, base and tool; reading one
//! runs every check of its constructors), for models ([`Definition`], [`OpwParameters`], [`Mdh`],
//! [`Sdh`], [`DhRow`], [`JointAxis`], [`JointLimits`]), for answers ([`Solutions`], [`Solution`],
//! [`Slot`], [`Status`], [`SingularityKind`], [`FreeJoint`], [`Configuration`], [`Singularity`],
//! [`SingularDistances`], [`PoseDifference`]) and for options ([`follow::FollowOptions`],
//! [`follow::SingularityMode`], [`JacobianFrame`]). In text formats, a joint without a limit is
//! `null`.
//!
//! Unoptimized, a solve is many times slower. To optimize this crate in a debug build of yours, add
//! to your `Cargo.toml`:
//!
//! ```toml
//! [profile.dev.package.irbkin]
//! opt-level = 3
//!
//! [profile.dev.package.nalgebra]
//! opt-level = 3
//! ```
//!
//! Without `std` the crate needs `alloc`. Meters, radians, `f64`. [Conventions], derivations and
//! accuracy are in the [documents] of the repository, whose paths are named here as docs/...
//!
//! [Conventions]: https://github.com/irbkin/irbkin/blob/main/docs/guide/conventions.md
//! [documents]: https://github.com/irbkin/irbkin/blob/main/docs/README.md
#![cfg_attr(docsrs, feature(doc_cfg), doc(auto_cfg(hide(feature = "std", feature = "libm"))))]
#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::float_cmp)
)]
// If another crate of the build links std, its float methods shadow those imported for no_std.
#![cfg_attr(not(feature = "std"), allow(unused_imports))]

extern crate alloc;
#[cfg(test)]
extern crate self as irbkin;
#[cfg(test)]
extern crate std;

pub mod batch;
pub mod catalog;
mod error;
mod interrupt;
mod kinematics;
mod lanes;
pub mod report;
#[cfg(test)]
#[path = "../tests/common/rng.rs"]
#[allow(dead_code, unreachable_pub)]
mod rng;
#[cfg(test)]
#[path = "../tests/common/sets.rs"]
#[allow(unreachable_pub)]
mod sets;
#[cfg(feature = "std")]
mod spelling;
#[cfg(test)]
#[path = "../tests/structures"]
#[allow(dead_code, unreachable_pub)]
mod structures {
    pub mod place;
    pub mod spherical_shoulder {
        pub mod arm;
    }
}

pub use catalog::catalog;
pub use error::Error;
pub use interrupt::{Interrupt, Interrupted, Pace};
pub use kinematics::{
    AnyRobot, ByJoints, ConfigurationRequest, Corrections, Definition, DhRow, JacobianFrame,
    JointAxis, JointLimits, Joints, Margin, Mdh, NoConfiguration, OpwParameters, Pose,
    PoseDifference, Robot, Sdh, SingularDistances, Singularity, SingularityKind, Slot, Solution,
    Solutions, Status, thresholds,
};
pub use lanes::InstructionSet;
/// The linear algebra of poses and matrices, in the version that this crate uses.
pub use nalgebra;
#[doc(inline)]
pub use report::{Configuration, Explanation, FreeJoint, Reach};

/// What the crates above this one use of it besides its public names. No stable interface: their
/// versions are equal.
#[doc(hidden)]
pub mod internal {
    pub use crate::batch::rows::{check_length, rows};
    pub use crate::error::{JointFault, ModelFault, PoseFault};
    pub use crate::kinematics::{
        Axes, Cost, MOST_SLOTS, POSTURES, Progress, Rows, angle_between, at_limit, check_joints,
        check_near, check_seed, check_snap, check_weights, checked_pose, constant_pose,
        constant_sin_cos, largest, largest_step, nearest_turn, rotation_vector, screw_x, snapped,
        steps, thresholds, unit,
    };
    pub use crate::report::{Convention, Listed, Names, OFFSET_WRIST, SNAPS, excess};
    #[cfg(feature = "std")]
    pub use crate::spelling::similar;

    /// Arithmetic on several numbers at once.
    pub mod lanes {
        pub use crate::lanes::{
            Column, Kernel, LANES, Number, Vector, VectorKernel, cross, dot, nearest_whole, run,
            run_vectors, whole_below,
        };
    }
}

/// One joint path along a path of poses: [`Robot::follow`].
pub mod follow {
    pub use crate::kinematics::{
        Break, BreakReason, FollowOptions, Followed, Follower, SingularityMode,
    };
}

/// Poses from and to quaternions, Euler angles, matrices and rows.
pub mod pose {
    pub use crate::kinematics::{
        pose_from_euler_zyx as from_euler_zyx, pose_from_isometry as from_isometry,
        pose_from_matrix as from_matrix, pose_from_rotation as from_rotation,
        pose_from_rotvec as from_rotvec, pose_from_rows as from_rows, pose_from_wxyz as from_wxyz,
        pose_from_xyzw as from_xyzw, pose_to_euler_zyx as to_euler_zyx,
        pose_to_isometry as to_isometry, pose_to_matrix as to_matrix, pose_to_rows as to_rows,
        pose_to_wxyz as to_wxyz,
    };
}

/// The Rust blocks of the README, run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeBlocks;
