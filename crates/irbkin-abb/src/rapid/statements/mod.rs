//! Statements, as they are written: declarations, moves, routines, blocks, and what is not read.

pub(crate) mod blocks;
pub(crate) mod declarations;
pub(crate) mod faults;
mod instructions;
pub(crate) mod moves;
mod own_types;
pub(crate) mod reader;
pub(crate) mod recovery;
mod statement;
mod types;
