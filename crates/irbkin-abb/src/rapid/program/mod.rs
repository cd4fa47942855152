//! A program: modules that know each other, and the moves of their routines in the order in which
//! they are executed, with the values that arguments, assignments and loops give them.
//!
//! Signals are not read. A condition on known numbers decides; else each part of a branch begins with
//! what is known before it, and behind it each datum has one of the values that the parts give it,
//! in a case. A value that is not determined by the text stays unknown, with the reason.

mod calls;
mod cases;
mod effects;
pub(super) mod index;
mod moves;
mod state;
pub(super) mod tree;
mod values;
pub(super) mod walk;
pub(super) mod walker;
pub(super) mod whole;
