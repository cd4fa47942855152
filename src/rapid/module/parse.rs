//! A module read from its text.

use alloc::borrow::Cow;
use alloc::string::String;

use crate::error::Error;
use crate::rapid::data::module::Module;
use crate::rapid::resolve::resolved;
use crate::rapid::statements::reader::StatementReader;

/// Reads the text of a module, or of declarations and moves without one.
///
/// Names that it does not declare are RAPID's own `tool0`, `wobj0` and `load0`; else they are
/// looked for in `context`: the data of these modules that are not `LOCAL`, those of the first
/// module first.
///
/// A datum that a statement of the module assigns, wherever the statement stands, has no known
/// value in moves, and no datum that refers to it has; all others have there what they are declared
/// with. `name:=` is followed so far, and instructions such as `Incr` and `SearchL` that write to
/// an argument: data handed to another routine as `INOUT` are not, nor what modules assign that are
/// not in `context`.
///
/// The time is linear in the size of the text, but for the search of names, which takes its
/// logarithm.
///
/// # Errors
///
/// [`Error::Rapid`] when the text is broken.
pub fn parse(text: &str, context: &[&Module]) -> Result<Module, Error> {
    let written = StatementReader::read(text)?;
    Ok(resolved(written, context)?)
}

/// The text of a file: UTF-16 with a byte order mark, UTF-8, else Latin-1; without its byte order
/// mark.
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

/// UTF-16; what is none becomes a replacement character, also a byte too many.
fn decode_units(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let characters = char::decode_utf16(pairs.iter().map(|pair| unit(*pair)))
        .map(|it| it.unwrap_or(char::REPLACEMENT_CHARACTER));
    characters.chain(rest.iter().map(|_| char::REPLACEMENT_CHARACTER)).collect()
}
