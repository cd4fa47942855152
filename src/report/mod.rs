//! Data that answers and errors share. Nothing here calculates.

mod answer;
mod free_joint;
mod names;
mod unknown_structure;

pub use answer::{Approach, Configuration, ConfigurationRule, Explanation, Reach};
pub use free_joint::FreeJoint;
pub use names::{Listed, Names, excess};
pub(crate) use unknown_structure::{
    Columns, Freedom, MOST_CONDITIONS, ORDERS, Pattern, Reading, Relation,
};
pub use unknown_structure::{Convention, OFFSET_WRIST, SNAPS, UnknownStructure};
