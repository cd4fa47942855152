//! Trajectories of joints: from one joint vector to another, through many, along a path in the
//! shortest time; exact between samples. The equations are in docs/guide/motion.md.
//!
//! ```
//! use irbkin_motion::trajectory::{AxisLimits, Profile, Synchronization, joint_within};
//!
//! let limits = [AxisLimits { velocity: 3.0, acceleration: 8.0, jerk: 60.0 }; 6];
//! let motion = joint_within(
//!     Profile::SCurve,
//!     &[0.0; 6],
//!     &[0.5, -0.4, 0.3, 1.0, 0.2, -2.0],
//!     &limits,
//!     Synchronization::Time,
//! )?;
//! assert!(motion.peaks()[5].velocity <= 3.0 * (1.0 + 1e-12));
//! # Ok::<(), irbkin_motion::Error>(())
//! ```

mod axis;
pub(crate) mod check;
mod extremes;
mod grid;
mod jerk;
mod joint;
mod phase;
mod piece;
mod piecewise;
mod polynomial;
mod retime;
mod rounded;
mod sampling;
pub mod state;
pub(crate) mod thresholds;
mod tool_speed;
mod waypoints;

pub use axis::{AxisLimits, AxisMotion, Profile};
pub use extremes::Peaks;
pub use joint::{Synchronization, joint, joint_within};
pub use phase::AxisState;
pub use piecewise::Trajectory;
pub use retime::{Retiming, evenly, retime, retime_tool, within_times};
pub(crate) use rounded::{distance, paced, rounded};
pub use tool_speed::{ToolSpeedLimits, at_tool_speed, tool_lengths, tool_speed_limits};
pub use waypoints::{SplineKind, spline, through};

#[cfg(test)]
mod jerk_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tool_speed_tests;
