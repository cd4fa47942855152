//! What irbkin reports, as data: the words that answers and errors have in common.
//!
//! Nothing here calculates. A structure, a solve and an error all speak of the same joints, reaches
//! and conditions, so these stand below all of them.

mod configuration;
mod explanation;
mod free_joint;
mod unknown_structure;

pub use configuration::{Configuration, ConfigurationRule};
pub use explanation::{Approach, Explanation, Reach};
pub use free_joint::FreeJoint;
#[cfg(test)]
pub(crate) use unknown_structure::Condition;
pub use unknown_structure::UnknownStructure;
pub(crate) use unknown_structure::{
    Columns, Convention, Freedom, MOST_CONDITIONS, ORDERS, Pattern, Reading, Relation,
};
