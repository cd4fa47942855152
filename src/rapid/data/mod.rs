//! The content of a module: types, records, values, data, moves, and reasons why something is not
//! read.

pub(crate) mod data_type;
pub(crate) mod literals;
pub(crate) mod module;
pub(crate) mod moves;
pub(crate) mod parts;
pub(crate) mod reason;
pub(crate) mod records;
pub(crate) mod settings;
pub(crate) mod skipped;
pub(crate) mod value;
