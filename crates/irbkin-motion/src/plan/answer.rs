//! The answer of a plan: joints at each pose, breaks, and the reasons for them.

use core::fmt;

use crate::cell::Near;
use crate::error::Error;
use crate::prelude::*;
use irbkin::internal::excess;
use irbkin::{Explanation, SingularityKind};

/// A joint path along a path of poses.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan<const N: usize = 6> {
    /// Joint angles at each pose [rad]; `None` where a plan with breaks has none.
    pub q: Vec<Option<[f64; N]>>,
    /// The angle that the tool is turned by at each pose [rad], without jumps of a full turn; 0
    /// without a free rotation.
    pub tool_angle: Vec<f64>,
    /// The values of the external axes at each pose [m, rad]; none where a plan with breaks has no
    /// joint angles.
    pub external: Vec<Vec<f64>>,
    /// The part of the tolerance that is used at each pose: the tilts about the two axes that the
    /// tool does not point in [rad], if there is a cone.
    pub tolerance: Vec<Vec<f64>>,
    /// The slot of the branch at each pose.
    pub slot: Vec<Option<usize>>,
    /// Weighted sum of the squares of all joint steps, with what being near limits and
    /// singularities costs [rad^2].
    pub cost: f64,
    /// The largest velocity of a joint, as a part of its limit. Without times, the time [s] that
    /// the path takes at least, if its poses are equally far apart in time.
    pub bottleneck: f64,
    /// Where the joints cannot follow; empty of a whole plan.
    pub breaks: Vec<PlanBreak>,
    /// Whether every step, apart from breaks, was shown to be continuous between its two poses.
    pub certified: bool,
}

/// A part of a path that the joints cannot follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlanBreak {
    /// The last pose before it; `None` if the path begins with it.
    pub leave: Option<usize>,
    /// The first pose after it; `None` if the path ends with it.
    pub enter: Option<usize>,
}

/// Where and why a branch ends.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("slot {slot} at pose {pose_index}: {reason}")]
pub struct StrandEnd {
    /// Its slot.
    pub slot: usize,
    /// The first pose that it does not reach.
    pub pose_index: usize,
    /// The reason.
    pub reason: StrandReason,
}

/// Why a branch ends.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StrandReason {
    /// It has no solution inside the limits at that pose.
    #[error("{0}")]
    Unreachable(Explanation),
    /// The joint would leave its limits.
    #[error(
        "J{joint} would have to be at {:.1} deg, its limits are {:.1} to {:.1} deg{}",
        .value.to_degrees(), .bounds[0].to_degrees(), .bounds[1].to_degrees(),
        exceeded(*.value, *.bounds)
    )]
    Limit {
        /// The joint, from 1.
        joint: usize,
        /// The angle that it would have [rad].
        value: f64,
        /// Its limits [rad].
        bounds: [f64; 2],
    },
    /// The joint would be faster than its limit.
    #[error("J{joint} would have to move at {ratio:.2} of its velocity limit")]
    Speed {
        /// The joint, from 1.
        joint: usize,
        /// Its velocity as a part of the limit.
        ratio: f64,
    },
    /// An external axis would be faster than its limit.
    #[error("external axis {axis} would have to move at {ratio:.2} of its velocity limit")]
    AxisSpeed {
        /// The axis, from 1.
        axis: usize,
        /// Its velocity as a part of the limit.
        ratio: f64,
    },
    /// The joint would turn while the tool does not move, or the path leads out of reach between
    /// two poses.
    #[error(
        "J{joint} would jump by {:.1} deg{}",
        .by.to_degrees(),
        .kinds.word().map_or_else(
            || String::from(" between two poses"),
            |kind| format!(" at the {kind} singularity"),
        )
    )]
    Jump {
        /// The joint, from 1.
        joint: usize,
        /// The angle by which it turns [rad].
        by: f64,
        /// The singularities that are next to it.
        kinds: SingularityKind,
    },
    /// It ends at a singularity or at the edge of reach: other branches reach that pose.
    #[error("the branch has ended, other branches reach this pose")]
    Ended,
    /// The bound on the work was reached before the motion to that pose was known to be continuous.
    #[error("the search was given up before the motion to this pose was known to be continuous")]
    Unknown,
    /// The caller's own test rejected it.
    #[error("rejected by accept")]
    Rejected,
    /// It collides.
    #[error(
        "link {link} and {near}{}",
        if *.is_between { ", on the way from the pose before" } else { "" }
    )]
    Collides {
        /// The link.
        link: usize,
        /// The other link or the obstacle.
        near: Near,
        /// Whether it does so between the pose before and that pose.
        is_between: bool,
    },
    /// It does not lead to the joint angles that were asked for at the end.
    #[error("does not lead to the joint angles at the end")]
    NotAtEnd,
}

/// There is no plan without breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct NoPlan<const N: usize = 6> {
    /// The first pose that no branch reaches from the start.
    pub pose_index: usize,
    /// The last pose from which no branch reaches the end.
    pub end_index: usize,
    /// Where and why each branch ends.
    pub ends: Vec<StrandEnd>,
    /// The plan with the fewest breaks, the best one between any two of them.
    pub plan: Plan<N>,
}

/// Why there is no plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError<const N: usize = 6> {
    /// The path or the options are invalid.
    #[error(transparent)]
    Invalid(#[from] Error),
    /// The path cannot be followed without a break.
    #[error("{0}")]
    NoPlan(Box<NoPlan<N>>),
    /// The caller's own test did not answer.
    #[error("the plan was stopped")]
    Stopped,
}

impl<const N: usize> From<irbkin::Error> for PlanError<N> {
    fn from(error: irbkin::Error) -> Self {
        Self::Invalid(error.into())
    }
}

impl<const N: usize> fmt::Display for NoPlan<N> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no branch reaches pose {} from the start", self.pose_index)?;
        for (number, end) in self.ends.iter().enumerate() {
            write!(f, "{} {end}", if number == 0 { ":" } else { ";" })?;
        }
        let breaks = self.plan.breaks.len();
        write!(f, " (the plan with the fewest breaks has {breaks})")
    }
}

/// By how much an angle [rad] exceeds its limits, where both may look equal with one decimal [deg].
fn exceeded(value: f64, bounds: [f64; 2]) -> String {
    let [value, lower, upper] = [value, bounds[0], bounds[1]].map(f64::to_degrees);
    if value < lower - 0.2 || value > upper + 0.2 {
        return String::new();
    }
    format!(", exceeded {} deg", excess(value, [lower, upper]))
}
