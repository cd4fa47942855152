//! The closure of a chain of six joints between two frames: Newton's method on its six conditions,
//! and the configurations that it accepts.
//!
//! Lengths are in units of the chain's own, so that positions and rotations weigh the same. Angles
//! are those of the table, theta = q + offset (docs/general.md, eq. 97 to 104).
//!
//! The way of a candidate: `newton` brings it to the pose. [`Accepted`] takes what is regular there;
//! next to a singularity `fold` settles what is on the `curve` through it: two solutions or none,
//! one in which several have `merged`, as many as its `powers` tell, a `self_motion` or a `surface`.
//! Of a self-motion, `walked` keeps one `member`, of a surface `surfaces` does; `flat` unites what
//! rounding keeps apart. One candidate that could not be decided goes on by `truncated` singular
//! values. `members` are those where a joint has an angle, `freedom` is what moves.

mod accepted;
mod chain;
mod configuration;
mod crossing;
mod curve;
mod flat;
mod fold;
mod freedom;
mod member;
mod members;
mod merged;
mod newton;
mod order;
mod placed;
mod powers;
mod reflections;
mod self_motion;
mod surface;
mod surfaces;
#[cfg(test)]
mod tests;
mod truncated;
mod walked;

pub(crate) use accepted::Accepted;
pub(crate) use chain::{Closure, Target};
pub(crate) use configuration::{Configuration, Kind, Missed};
pub(crate) use newton::{Candidates, Six};
pub(crate) use order::{BelowAndNear, Order, TIED, in_order, in_order_one_by_one};
pub(crate) use placed::Placed;
pub(crate) use reflections::reflect;
