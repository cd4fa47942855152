//! A cell: obstacles around an arm, and whether the arm touches them or itself.

mod apart;
mod block;
mod doubts;
mod gradient;
mod obstacles;
mod pairs;
mod path;
mod placed;
mod postures;
mod standing;

pub use obstacles::Cell;
#[cfg(feature = "python")]
pub(crate) use path::Motion;
pub use path::{Contact, RESOLUTION};
pub(crate) use placed::Placed;
pub use postures::{Near, Nearest};
