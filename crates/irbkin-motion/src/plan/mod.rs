//! The best joint path along a whole path of poses: over every branch, every turn and every value
//! of what is free, such as the tool angle. The equations are in docs/guide/plan.md.
//!
//! ```
//! use irbkin_motion::paths::{Spacing, line};
//! use irbkin_motion::plan::{PlanOptions, ToolRotation};
//! use irbkin_motion::Arm;
//! use irbkin::pose;
//!
//! let arm: Arm<6> = Arm::named("IRB 2600-12/1.65")?;
//! let start = pose::from_euler_zyx([0.9, -0.3, 0.7], [0.0, 2.8, 0.0])?;
//! let end = pose::from_euler_zyx([0.9, 0.3, 0.7], [0.0, 2.8, 0.0])?;
//! let seam = line(&start, &end, Spacing::count(101)?, None)?;
//! let rotation = Some(ToolRotation::full(36)?);
//! let plan = arm.plan(&seam, &PlanOptions { rotation, ..PlanOptions::default() })?;
//! assert!(plan.certified && plan.breaks.is_empty());
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

// The arguments and the answer.
mod answer;
mod axes;
pub(crate) mod fault;
mod options;
pub(crate) mod thresholds;

// The ladder graph: what is free, the nodes of each pose, the branches between them.
mod branches;
mod ends;
mod freedom;
mod graph;
mod joints;
mod ladder;
mod nodes;

// The best joint path through it.
mod best;
mod lanes;
mod search;
mod windows;
mod work;

// The plan: proven between the poses, refined and smoothed, or explained.
mod banded;
mod certificate;
mod five;
mod followed;
mod planner;
pub(crate) mod rail;
mod reasons;
mod refine;
mod robot;
mod roughness;
mod seven;
mod smooth;
mod tested;
mod timed;

pub use answer::{NoPlan, Plan, PlanBreak, PlanError, StrandEnd, StrandReason};
pub use axes::{ExternalAxis, ToolAxis, ToolCone, ToolRotation};
pub use options::{Accept, PlanOptions, PlanOrder};

#[cfg(test)]
mod exhaustive;
#[cfg(test)]
mod free_axes_tests;
#[cfg(test)]
mod interrupted_tests;
#[cfg(test)]
mod ordinals_tests;
#[cfg(test)]
mod tests;
