//! Paths of the tool: lines, arcs and polylines with rounded corners, as poses. The equations are
//! in docs/motion.md.
//!
//! ```
//! use irbkin::paths::{Spacing, line};
//! use irbkin::pose_from_euler_zyx;
//!
//! let start = pose_from_euler_zyx([0.8, -0.2, 0.6], [0.0, 3.1, 0.0])?;
//! let end = pose_from_euler_zyx([0.8, 0.2, 0.6], [1.0, 3.1, 0.0])?;
//! assert_eq!(line(&start, &end, Spacing::count(41)?, None)?.len(), 41);
//! # Ok::<(), irbkin::Error>(())
//! ```

mod arc;
mod line;
mod polyline;
mod spacing;
mod turn;
mod zone;

pub use arc::{ArcOrientation, arc};
pub use line::line;
pub use polyline::{corner_distance, polyline};
pub use spacing::Spacing;
pub(crate) use turn::Turn;
pub use zone::Zone;

#[cfg(test)]
mod tests;
