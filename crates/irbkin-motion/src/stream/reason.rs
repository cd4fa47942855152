//! Why a reference was refused.

use thiserror::Error;

use crate::cell::Other;
use crate::prelude::*;
use irbkin::internal::excess;
use irbkin::{Explanation, Slot};

/// A bounded quantity of the motion of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bound {
    /// Velocity [rad/s].
    Velocity,
    /// Acceleration [rad/s^2].
    Acceleration,
    /// Jerk [rad/s^3].
    Jerk,
    /// The velocity that the joint has when its acceleration has gone to zero [rad/s].
    VelocityAhead,
}

impl Bound {
    /// Its name and its unit.
    fn words(self) -> [&'static str; 2] {
        match self {
            Self::Velocity => ["a velocity", "rad/s"],
            Self::Acceleration => ["an acceleration", "rad/s^2"],
            Self::Jerk => ["a jerk", "rad/s^3"],
            Self::VelocityAhead => ["a velocity, before its acceleration can end,", "rad/s"],
        }
    }
}

/// Why a reference was refused; joints count from 1. What depends on obstacles is in words by
/// [`Guard::words`](super::Guard::words).
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Reason {
    /// There was none in this cycle.
    #[error("no reference in this cycle")]
    Missing,
    /// An angle is not finite.
    #[error("joint {joint} is {value}, it must be finite")]
    NotFinite {
        /// The joint.
        joint: usize,
        /// Its angle [rad].
        value: f64,
    },
    /// The pose is not a rigid transform.
    #[error("the pose is not a rigid transform of finite numbers")]
    NotRigid,
    /// A joint is outside its limits.
    #[error(
        "joint {joint} is {value:.6} rad, its limits are {:.6} to {:.6} rad, exceeded {} rad",
        .limits[0], .limits[1], excess(*.value, *.limits)
    )]
    Outside {
        /// The joint.
        joint: usize,
        /// Its angle [rad].
        value: f64,
        /// Its limits [rad].
        limits: [f64; 2],
    },
    /// Axes 2 and 3 are, or would while braking be, outside the limits of the linkage.
    #[error(
        "the linkage of axes 2 and 3 would be outside its limits by {excess:.2e} rad, here or \
         while braking"
    )]
    Linkage {
        /// By how much [rad].
        excess: f64,
    },
    /// A joint would exceed a bound.
    #[error(
        "joint {joint} would need {} of {value:.4} {unit}, its bound is {limit:.4} {unit}",
        .bound.words()[0], unit = .bound.words()[1]
    )]
    Beyond {
        /// The joint.
        joint: usize,
        /// The bound.
        bound: Bound,
        /// The value that the joint would need.
        value: f64,
        /// The bound.
        limit: f64,
    },
    /// A joint could not brake inside its limits any more.
    #[error(
        "joint {joint} could not brake before {value:.6} rad, its limits are {:.6} to {:.6} rad",
        .limits[0], .limits[1]
    )]
    NoWayToBrake {
        /// The joint.
        joint: usize,
        /// Where it would be at rest, or turn back [rad].
        value: f64,
        /// Its limits [rad].
        limits: [f64; 2],
    },
    /// A joint slows down, so that it comes to rest at the reference.
    #[error("joint {joint} slows down to come to rest at the reference")]
    Arriving {
        /// The joint.
        joint: usize,
    },
    /// The tool is not proven to stay within its speed.
    #[error(
        "the tool may reach {value:.4} m/s, here or while braking, its bound is {limit:.4} m/s"
    )]
    ToolSpeed {
        /// The bound of the speed that is proven [m/s].
        value: f64,
        /// The limit [m/s].
        limit: f64,
    },
    /// No solution of the pose inside the limits.
    #[error("{0}")]
    Unreachable(Explanation),
    /// No solution of the pose inside the limits is on the branch of the joints.
    #[error(
        "the pose is reached in slot {} only, the joints are in slot {}: no way without a \
         singularity between them",
        .to.index(), .from.index()
    )]
    Branch {
        /// The slot of the joints.
        from: Slot,
        /// The slot of the nearest solution.
        to: Slot,
    },
    /// No solution of the pose inside the limits continues the joints, of seven.
    #[error("no solution of the pose inside the limits continues the joints")]
    NotContinued,
    /// The arm has no inverse kinematics.
    #[error("the arm has no inverse kinematics: give joint angles")]
    NoInverse,
    /// The way to the reference, or the braking motion after it, is not proven free.
    #[error("{NOT_FREE}{}", too_near(*.pair))]
    Blocked {
        /// A link, and what it comes too near to; `None` if no pair of them was found again.
        pair: Option<(usize, Other)>,
    },
}

/// What comes too near to a link, if it was found again.
fn too_near(pair: Option<(usize, Other)>) -> String {
    let Some((link, other)) = pair else { return String::new() };
    let other = match other {
        Other::Link(other) => format!("link {other}"),
        Other::Obstacle(place) => format!("obstacle {place}"),
    };
    format!(": link {link} and {other} come too near to each other")
}

/// How words of what is not proven free begin.
pub(super) const NOT_FREE: &str = "the way, or braking after it, is not proven free";
