//! A module read from its text.

use alloc::borrow::Cow;
use alloc::string::String;

use crate::error::Error;
use crate::rapid::data::module::Module;
use crate::rapid::resolve::resolved;
use crate::rapid::statements::reader::StatementReader;

/// Read the text of a module, or of declarations and moves without one.
///
/// Names that it does not declare are looked up in `context`: the data of these modules that are
/// not `LOCAL`, those of the first module first. What none declares is RAPID's own: `tool0`,
/// `wobj0`, `load0`, the speeds `v5` to `v7000` and `vmax`, the zones `fine` and `z0` to `z200`. A
/// controller's `vmax` is that of its robot; here it is 10 m/s.
///
/// A datum that a statement of the module assigns, wherever the statement is, has no known value in
/// moves, nor has a datum that refers to it; all others have their declared values there. `name:=`
/// is recognized, and instructions such as `Incr` and `SearchL` that write to an argument. Data
/// passed to another routine as `INOUT` are not, nor are assignments in modules that are not in
/// `context`.
///
/// The time is linear in the size of the text, except for the lookup of names, which is
/// logarithmic.
///
/// # Errors
///
/// [`Error::Rapid`] when the text is invalid.
pub fn parse(text: &str, context: &[&Module]) -> Result<Module, Error> {
    let written = StatementReader::read(text)?;
    Ok(resolved(written, context)?)
}

/// Decode the text of a file: UTF-16 with a byte order mark, UTF-8, otherwise Latin-1. The byte
/// order mark is removed.
#[must_use]
pub fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match bytes {
        [0xff, 0xfe, units @ ..] => return Cow::Owned(decode_units(units, u16::from_le_bytes)),
        [0xfe, 0xff, units @ ..] => return Cow::Owned(decode_units(units, u16::from_be_bytes)),
        _ => {}
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match core::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|byte| char::from(*byte)).collect::<String>()),
    }
}

/// Decode UTF-16; invalid units become replacement characters, as does a trailing byte.
fn decode_units(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let characters = char::decode_utf16(pairs.iter().map(|pair| unit(*pair)))
        .map(|it| it.unwrap_or(char::REPLACEMENT_CHARACTER));
    characters.chain(rest.iter().map(|_| char::REPLACEMENT_CHARACTER)).collect()
}
