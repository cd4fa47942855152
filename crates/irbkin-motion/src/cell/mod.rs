//! A cell: obstacles around an arm, and whether the arm touches them or itself.

mod batch;
mod block;
mod broad_phase;
mod checker;
mod distance_bounds;
mod joint_boxes;
mod link_motion;
mod narrow_phase;
mod obstacles;
mod pairs;
mod path;
mod postures;
mod single_posture;

pub use checker::{Checker, Memory};
pub(crate) use joint_boxes::Boxes;
pub use obstacles::Cell;
pub use pairs::Other;
pub use path::{Contact, Motion, RESOLUTION};
pub use postures::{Near, Nearest};
