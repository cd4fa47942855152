//! The best joint path along a whole path of poses: over every branch, every turn and, where the
//! tool may be turned, every tool angle. The equations are in docs/plan.md.
//!
//! ```
//! use irbkin::paths::{Spacing, line};
//! use irbkin::plan::{PlanOptions, ToolRotation};
//! use irbkin::{Robot, pose_from_euler_zyx};
//!
//! let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
//! let start = pose_from_euler_zyx([0.9, -0.3, 0.7], [0.0, 2.8, 0.0])?;
//! let end = pose_from_euler_zyx([0.9, 0.3, 0.7], [0.0, 2.8, 0.0])?;
//! let seam = line(&start, &end, Spacing::count(101)?, None)?;
//! let rotation = Some(ToolRotation::full(36)?);
//! let plan = robot.plan(&seam, &PlanOptions { rotation, ..PlanOptions::default() })?;
//! assert!(plan.certified && plan.breaks.is_empty());
//! # Ok::<(), Box<dyn core::error::Error>>(())
//! ```

mod answer;
mod axis;
mod caller;
mod carrier;
mod certificate;
mod closed;
mod edges;
mod ends;
mod field;
mod freedom;
mod guide;
mod layer;
mod nodes;
mod options;
mod planner;
mod reasons;
mod refine;
mod robot;
mod search;
mod sieve;
mod soft;
mod stations;
mod step;
mod strands;
mod tolerance;
mod turns;
mod way;
mod window;

pub use answer::{NoPlan, Plan, PlanBreak, PlanError, StrandEnd, StrandReason};
pub use axis::ToolAxis;
pub use caller::Accept;
#[cfg(feature = "python")]
pub(crate) use caller::{Caller, Watch};
pub use carrier::ExternalAxis;
pub use options::{PlanOptions, PlanOrder, ToolRotation};
pub use tolerance::{ToolCone, ToolOffset};

#[cfg(test)]
mod carrier_tests;
#[cfg(test)]
mod exhaustive;
#[cfg(test)]
mod sieve_tests;
#[cfg(test)]
mod strand_tests;
#[cfg(test)]
mod tests;
