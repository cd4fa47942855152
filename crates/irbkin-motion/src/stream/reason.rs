//! Why a reference was refused.

use core::fmt;

use crate::cell::Other;
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
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Reason {
    /// There was none in this cycle.
    Missing,
    /// An angle is not finite.
    NotFinite {
        /// The joint.
        joint: usize,
        /// Its angle [rad].
        value: f64,
    },
    /// The pose is not a rigid transform.
    NotRigid,
    /// A joint is outside its limits.
    Outside {
        /// The joint.
        joint: usize,
        /// Its angle [rad].
        value: f64,
        /// Its limits [rad].
        limits: [f64; 2],
    },
    /// Axes 2 and 3 are, or would while braking be, outside the limits of the linkage.
    Linkage {
        /// By how much [rad].
        excess: f64,
    },
    /// A joint would exceed a bound.
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
    NoWayToBrake {
        /// The joint.
        joint: usize,
        /// Where it would be at rest, or turn back [rad].
        value: f64,
        /// Its limits [rad].
        limits: [f64; 2],
    },
    /// A joint slows down, so that it comes to rest at the reference.
    Arriving {
        /// The joint.
        joint: usize,
    },
    /// The tool is not proven to stay within its speed.
    ToolSpeed {
        /// The bound of the speed that is proven [m/s].
        value: f64,
        /// The limit [m/s].
        limit: f64,
    },
    /// No solution of the pose inside the limits.
    Unreachable(Explanation),
    /// No solution of the pose inside the limits is on the branch of the joints.
    Branch {
        /// The slot of the joints.
        from: Slot,
        /// The slot of the nearest solution.
        to: Slot,
    },
    /// No solution of the pose inside the limits continues the joints, of seven.
    NotContinued,
    /// The arm has no inverse kinematics.
    NoInverse,
    /// The way to the reference, or the braking motion after it, is not proven free.
    Blocked {
        /// A link, and what it comes too near to; `None` if no pair of them was found again.
        pair: Option<(usize, Other)>,
    },
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing => f.write_str("no reference in this cycle"),
            Self::NotFinite { joint, value } => {
                write!(f, "joint {joint} is {value}, it must be finite")
            }
            Self::NotRigid => f.write_str("the pose is not a rigid transform of finite numbers"),
            Self::Outside { joint, value, limits } => write!(
                f,
                "joint {joint} is {value:.6} rad, its limits are {:.6} to {:.6} rad, exceeded {} \
                 rad",
                limits[0],
                limits[1],
                excess(*value, *limits)
            ),
            Self::Linkage { excess } => write!(
                f,
                "the linkage of axes 2 and 3 would be outside its limits by {excess:.2e} rad, here \
                 or while braking"
            ),
            Self::Beyond { joint, bound, value, limit } => {
                let [what, unit] = bound.words();
                write!(
                    f,
                    "joint {joint} would need {what} of {value:.4} {unit}, its bound is {limit:.4} \
                     {unit}"
                )
            }
            Self::NoWayToBrake { joint, value, limits } => write!(
                f,
                "joint {joint} could not brake before {value:.6} rad, its limits are {:.6} to \
                 {:.6} rad",
                limits[0], limits[1]
            ),
            Self::Arriving { joint } => {
                write!(f, "joint {joint} slows down to come to rest at the reference")
            }
            Self::ToolSpeed { value, limit } => write!(
                f,
                "the tool may reach {value:.4} m/s, here or while braking, its bound is {limit:.4} \
                 m/s"
            ),
            Self::Unreachable(explanation) => explanation.fmt(f),
            Self::Branch { from, to } => write!(
                f,
                "the pose is reached in slot {} only, the joints are in slot {}: no way without a \
                 singularity between them",
                to.index(),
                from.index()
            ),
            Self::NotContinued => {
                f.write_str("no solution of the pose inside the limits continues the joints")
            }
            Self::NoInverse => f.write_str("the arm has no inverse kinematics: give joint angles"),
            Self::Blocked { pair: None } => f.write_str(NOT_FREE),
            Self::Blocked { pair: Some((link, Other::Link(other))) } => {
                write!(f, "{NOT_FREE}: link {link} and link {other} come too near to each other")
            }
            Self::Blocked { pair: Some((link, Other::Obstacle(place))) } => write!(
                f,
                "{NOT_FREE}: link {link} and obstacle {place} come too near to each other"
            ),
        }
    }
}

/// How words of what is not proven free begin.
pub(super) const NOT_FREE: &str = "the way, or braking after it, is not proven free";
