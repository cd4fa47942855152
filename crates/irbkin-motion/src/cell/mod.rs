//! A cell: obstacles around an arm, and whether the arm touches them or itself.

mod apart;
mod batch;
mod block;
mod boxes;
mod checker;
mod doubts;
mod drift;
mod edges;
mod gradient;
mod near;
mod obstacles;
mod one;
mod pairs;
mod path;
mod postures;
mod range;
mod standing;

pub(crate) use boxes::Boxes;
pub use checker::{Checker, Memory};
pub use obstacles::Cell;
pub use pairs::Other;
pub use path::{Contact, Motion, RESOLUTION};
pub use postures::{Near, Nearest};
