//! ABB's RAPID: targets, tools, work objects and moves of a module, read and written.
//!
//! ```
//! use irbkin::rapid::{self, Content, Value};
//!
//! let text = "MODULE Weld
//!     CONST robtarget p10 := [[600,0,800],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
//!     PROC main()
//!         MoveL Offs(p10,0,0,50), v100, fine, tool0;
//!     ENDPROC
//! ENDMODULE";
//! let module = rapid::parse(text, &[])?;
//! let Content::Single(Value::RobTarget(p10)) = &module.find("P10").unwrap().content else { unreachable!() };
//! assert_eq!(p10.trans_mm, [600.0, 0.0, 800.0]);
//! assert_eq!(module.moves()[0].target.text, "Offs(p10,0,0,50)");
//! assert_eq!(rapid::parse(&module.to_string(), &[])?.without_positions(), module.without_positions());
//! # Ok::<(), irbkin::Error>(())
//! ```
//!
//! What is not known is skipped and told ([`Module::skipped`]), never guessed; a broken text is an error with its line and column. Data have
//! the values of their declarations; those that the module assigns have none where it moves. A negative zero is read as zero.

mod assigned;
mod blocks;
mod build;
mod calc;
mod declarations;
mod displaced;
mod evaluate;
mod expression;
mod frames;
mod instructions;
mod kind;
mod module;
mod moves;
mod record;
mod resolve;
mod rewrite;
mod routines;
mod skipping;
mod statements;
mod table;
#[cfg(test)]
mod tests;
mod tokens;
mod values;
mod words;
mod write;

use alloc::borrow::Cow;
use alloc::string::String;

pub use self::calc::{calc_joint_t, calc_joint_t_or_nearest, calc_rob_t, error_name};
pub use self::expression::DEEPEST_NESTING;
pub use self::kind::DataType;
pub use self::module::{Content, Datum, Module, Routine, RoutineKind, Scope, Skipped, Storage};
pub use self::moves::{Argument, Move, MoveKind, MoveOption, Target};
pub use self::record::parse_record;
pub use self::rewrite::{NewValue, rewrite};
use self::statements::StatementReader;
pub use self::table::{Fallback, TableRow, calc_moves, calc_targets};
pub use self::values::{
    JointTarget, LoadData, NOT_THERE, RapidPose, RobTarget, ToolData, Value, WobjData,
};
use crate::error::Error;

/// Reads the text of a module, or of declarations and moves without one.
///
/// Names that it does not declare are RAPID's own `tool0`, `wobj0` and `load0`; else they are looked for in `context`: the data of these modules
/// that are not `LOCAL`, those of the first module first.
///
/// A datum that a statement of the module assigns, wherever the statement stands, has no known value in moves, and no datum that refers to it
/// has; all others have there what they are declared with. `name:=` is followed so far, and instructions such as `Incr` and `SearchL` that write to an
/// argument: data handed to another routine as `INOUT` are not, nor what modules assign that are not in `context`.
///
/// The time is linear in the size of the text, but for the search of names, which takes its logarithm.
///
/// # Errors
///
/// [`Error::Rapid`] when the text is broken.
pub fn parse(text: &str, context: &[&Module]) -> Result<Module, Error> {
    let written = StatementReader::read(text)?;
    Ok(resolve::resolved(written, context)?)
}

/// The text of a file: UTF-16 with a byte order mark, UTF-8, else Latin-1; without its byte order mark.
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
