//! Data that answers and errors share. Nothing here calculates.

mod answer;
mod free_joint;
mod names;
mod unknown_structure;

pub use answer::{Approach, Configuration, ConfigurationRule, Explanation, Reach};
pub use free_joint::FreeJoint;
pub use names::Names;
pub(crate) use names::{Listed, excess};
pub(crate) use unknown_structure::{
    Columns, Freedom, MOST_CONDITIONS, OFFSET_WRIST, ORDERS, Pattern, Reading, Relation, SNAPS,
    Snap,
};
pub use unknown_structure::{Convention, UnknownStructure};
