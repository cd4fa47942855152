//! Paths of the tool: lines, arcs, polylines with rounded corners and splines, as poses. The
//! equations are in docs/guide/motion.md.
//!
//! ```
//! use irbkin_motion::paths::{Spacing, line};
//! use irbkin::pose;
//!
//! let start = pose::from_euler_zyx([0.8, -0.2, 0.6], [0.0, 3.1, 0.0])?;
//! let end = pose::from_euler_zyx([0.8, 0.2, 0.6], [1.0, 3.1, 0.0])?;
//! assert_eq!(line(&start, &end, Spacing::count(41)?, None)?.len(), 41);
//! # Ok::<(), irbkin_motion::Error>(())
//! ```

mod arc;
#[doc(hidden)]
pub mod line;
#[doc(hidden)]
pub mod polyline;
mod spacing;
mod spline;
pub(crate) mod thresholds;

pub use arc::{ArcOrientation, arc};
pub(crate) use line::Turn;
pub use line::line;
pub use polyline::{Zone, corner_distance, polyline};
pub use spacing::Spacing;
pub use spline::spline;

#[cfg(test)]
mod spline_tests;
#[cfg(test)]
mod tests;
