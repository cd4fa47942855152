//! The inverse of a robot: of one pose, of rows, next to a seed, by configuration, along the
//! redundancy.

pub(crate) mod configuration;
mod corner_search;
mod correction;
mod golden_section;
mod inside;
pub(crate) mod inverse;
pub(crate) mod nearest;
mod open_wrist;
mod pair;
pub(crate) mod redundancy;
pub(crate) mod seeded;
pub(crate) mod self_motion;
pub(crate) mod self_motion_curve;
mod self_motion_search;
mod starts;
