//! The content of a module: types, records, values, expressions, statements, data, moves, and
//! reasons why something is not read.

pub(crate) mod expression;
pub(crate) mod finding;
pub(crate) mod fit;
pub(crate) mod instructions;
pub(crate) mod lookup;
pub(crate) mod module;
pub(crate) mod moves;
pub(crate) mod moving;
pub(crate) mod own_types;
pub(crate) mod records;
pub(crate) mod settings;
pub(crate) mod statement;
pub(crate) mod table;
pub(crate) mod types;
pub(crate) mod unread;
pub(crate) mod value;
