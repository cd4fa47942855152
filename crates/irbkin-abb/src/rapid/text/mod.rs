//! The text: lines and columns, tokens, literals, reserved words, and skipping over brackets.

#[doc(hidden)]
pub mod fault;
pub(crate) mod place;
pub(crate) mod skipping;
pub(crate) mod tokens;
pub(crate) mod words;
