//! Kinematics of ABB IRB robots and their kin: every inverse-kinematics solution, in a named slot,
//! without allocating.
//!
//! All eight ways to bring an IRB 2600's tool to a pose:
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
//! The one a controller wants, next to where the arm stands:
//!
//! ```
//! use irbkin::{Robot, pose_from_wxyz};
//!
//! let robot: Robot<6> = Robot::named("irb 1200 5/0.9")?;
//! let pose = pose_from_wxyz([0.45, 0.1, 0.6], [0.5, 0.0, 0.75_f64.sqrt(), 0.0])?;
//! let here = [0.2, 0.0, 0.3, 0.0, 0.5, 0.0];
//! let next = robot.ik_nearest(&pose, &here, &[1.0; 6])?;
//! assert!(next.is_within_limits());
//! # Ok::<(), irbkin::Error>(())
//! ```
//!
//! Code for any number of joints names what that number must have, and passes what a redundant arm
//! needs besides:
//!
//! ```
//! use irbkin::{Arity, Error, Joints, Pose, RedundancyOf, Robot};
//!
//! fn count<const N: usize>(robot: &Robot<N>, pose: &Pose, redundancy: RedundancyOf<N>) -> Result<usize, Error>
//! where
//!     Joints<N>: Arity<N>,
//! {
//!     Ok(robot.ik_with(pose, redundancy)?.len())
//! }
//!
//! let ur5e: Robot<6> = Robot::named("UR5e")?;
//! assert_eq!(count(&ur5e, &ur5e.fk(&[0.3, -1.2, 1.4, -0.5, 0.6, 0.7]), ())?, 8);
//! let panda: Robot<7> = Robot::named("Panda")?;
//! assert!(count(&panda, &panda.fk(&[0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6]), 0.6)? > 0);
//! # Ok::<(), irbkin::Error>(())
//! ```
//!
//! | feature | default | brings |
//! |---|---|---|
//! | `std` | yes | threads in a batch, the choice of an instruction set, the search for names spelled alike |
//! | `libm` | | square roots and angles without `std`; a solve takes nothing from the heap either way |
//! | `urdf` | yes | `Robot::from_urdf` |
//! | `rapid` | yes | [`rapid`]: robtargets and moves of RAPID modules, read, solved and rewritten |
//! | `serde` | | models ([`OpwParameters`], [`Mdh`], [`Sdh`], [`JointAxis`]), answers ([`Solution`], [`Configuration`], [`Singularity`]) and options are written and read |
//! | `python` | | the extension module of the Python package; no use to a crate |
//!
//! Meters, radians, `f64`. `docs/` of the repository has the conventions, the derivations and the
//! accuracy.
#![cfg_attr(not(feature = "std"), no_std)]
#![cfg_attr(
    test,
    allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::float_cmp)
)]
// Where another crate of the build links std, its own float methods come before those imported for
// no_std.
#![cfg_attr(not(feature = "std"), allow(unused_imports))]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("irbkin needs the feature `std` or, without the standard library, `libm`");

extern crate alloc;
#[cfg(test)]
extern crate self as irbkin;
#[cfg(test)]
extern crate std;

pub mod batch;
mod catalog;
mod error;
mod kinematics;
mod lanes;
#[cfg(feature = "python")]
mod python;
#[cfg(feature = "rapid")]
pub mod rapid;
mod report;
// What unit tests share with the tests of the public interface.
#[cfg(test)]
#[allow(dead_code, unreachable_pub)]
#[path = "../tests/common/rng.rs"]
mod rng;
#[cfg(test)]
#[allow(dead_code, unreachable_pub)]
#[path = "../tests/structures"]
mod structures {
    pub mod place;
    #[path = "spherical_shoulder/arm.rs"]
    pub mod shoulder_arm;
}
#[cfg(feature = "urdf")]
mod urdf;

pub use catalog::{AngleUnit, CatalogArm, CatalogGeometry, catalog, find};
pub use error::{
    Error, JointFault, ModelFault, Names, NoConfiguration, PoseFault, UnknownRobot, UrdfFault,
};
#[cfg(feature = "rapid")]
pub use error::{FrameFault, Missing, RapidFault, RapidFaultKind};
pub use kinematics::{
    Arity, Break, BreakReason, Definition, DhRow, FollowOptions, Followed, Follower, Inverse,
    JacobianFrame, JointAxis, JointLimits, Joints, MOST_SLOTS, Mdh, OpwParameters, Pose,
    PoseDifference, Redundancy, RedundancyOf, Robot, Sdh, SingularDistances, Singularity,
    SingularityKind, SingularityMode, Slot, SlotStatus, Solution, Solutions, Status,
    pose_from_euler_zyx, pose_from_isometry, pose_from_matrix, pose_from_rotation, pose_from_rows,
    pose_from_wxyz, pose_from_xyzw, pose_to_euler_zyx, pose_to_isometry, pose_to_matrix,
    pose_to_rows, pose_to_wxyz, thresholds,
};
pub use lanes::InstructionSet;
/// The linear algebra of poses and matrices, in the version that this crate has.
pub use nalgebra;
pub use report::{
    Condition, Configuration, Explanation, FreeJoint, Reach, Relation, UnknownStructure,
};

/// The Rust blocks of the README, run as documentation tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct ReadmeBlocks;
