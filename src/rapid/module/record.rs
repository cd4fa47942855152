//! Reads a single record.

use alloc::format;

use super::parse::parse;
use crate::error::{Error, RapidFault, RapidFaultKind};
use crate::rapid::data::data_type::DataType;
use crate::rapid::data::module::Content;
use crate::rapid::data::value::Value;
use crate::rapid::text::place::excerpt;

/// Types whose shapes differ from those of all others.
const BY_SHAPE: [DataType; 6] = [
    DataType::RobTarget,
    DataType::JointTarget,
    DataType::ToolData,
    DataType::WobjData,
    DataType::Pose,
    DataType::LoadData,
];

/// Read a text that is one robtarget, jointtarget, tooldata, wobjdata, pose or loaddata; its shape
/// determines the type.
///
/// # Errors
///
/// [`Error::Rapid`] when the text is invalid, is none of these, or is followed by more text.
pub fn parse_record(text: &str) -> Result<Value, Error> {
    let mut broken = None;
    for data_type in BY_SHAPE {
        // The text keeps its own lines, after one that is not reported.
        match parse(&format!("VAR {} value:=\n{text}\n;", data_type.name()), &[]) {
            Ok(module) => {
                let alone = module.moves().is_empty() && module.skipped().is_empty();
                if let ([datum], true) = (module.data(), alone)
                    && let Content::Single(value) = &datum.content
                {
                    return Ok(value.clone());
                }
            }
            Err(Error::Rapid(fault)) if is_of_another_type(&fault.kind) => {}
            Err(Error::Rapid(fault)) => {
                broken = Some(RapidFault { line: fault.line.saturating_sub(1), ..fault });
            }
            Err(error) => return Err(error),
        }
    }
    let none = || RapidFault::nowhere(RapidFaultKind::NoRecord { text: excerpt(text) });
    Err(broken.unwrap_or_else(none).into())
}

/// Whether the text may be a value of another type.
fn is_of_another_type(kind: &RapidFaultKind) -> bool {
    use RapidFaultKind::{ComponentCount, ComponentType, NotWhole};
    matches!(kind, ComponentCount { .. } | ComponentType { .. } | NotWhole { .. })
}
