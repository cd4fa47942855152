//! The inverse of a robot: for one pose, for rows, near a seed, by configuration, along the
//! redundancy.

mod approach;
mod chain_search;
pub(crate) mod configuration;
mod correction;
mod inside;
pub(crate) mod inverse;
mod minimum;
pub(crate) mod nearest;
mod pair;
pub(crate) mod redundancy;
pub(crate) mod seeded;
pub(crate) mod self_motion;
pub(crate) mod self_motion_curve;
mod self_motion_search;
mod singular_wrist;
mod starts;
