//! Declarations of data.

use alloc::vec::Vec;

pub(crate) use super::declared::Declared;
use super::declared::known_at_once;
use super::faults::{Faults, end_statement};
use super::parts::{DatumPart, read_parts};
use super::types::{TypeKind, Types};
use crate::rapid::data::module::{Scope, Storage};
use crate::rapid::expression::content::{Placed, WrittenContent};
use crate::rapid::expression::direct::read_direct;
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::tokens::{TokenKind, Tokens};
use crate::rapid::text::words::is_name_token;

/// The result of reading a declaration.
#[expect(clippy::large_enum_variant, reason = "the large one is nearly every one of a large text")]
pub(crate) enum Declaration<'a> {
    /// With its content, if that is known without looking up a name.
    Read(Declared<'a>, Option<Placed>),
    /// Of a data type that is not read, with components that are.
    Unread { name: &'a str, type_name: &'a str, parts: Vec<DatumPart<'a>> },
    /// With a placeholder, perhaps for its name.
    Unfinished { name: &'a str },
}

/// The storage class that the next token names, if any.
pub(crate) fn storage_at(tokens: &Tokens<'_>) -> Option<Storage> {
    let token = tokens.peek();
    Storage::named(tokens.text_of(token)).filter(|_| token.kind == TokenKind::Name)
}

/// The name in a declaration, or its placeholder: the next token.
pub(crate) fn read_name<'a>(
    tokens: &mut Tokens<'a>,
    wanted: &'static str,
) -> Result<&'a str, RapidFault> {
    let token = tokens.peek();
    let may = match token.kind {
        TokenKind::Name => is_name_token(tokens.text_of(token)),
        kind => kind == TokenKind::Placeholder,
    };
    if !may {
        return Err(tokens.unexpected(wanted));
    }
    tokens.take()?;
    Ok(tokens.text_of(token))
}

/// Read a declaration from its storage class to its semicolon; it begins, perhaps with LOCAL or
/// TASK, at byte `start`. With tolerance an invalid value is left for when names are looked up.
pub(crate) fn read_declaration<'a>(
    tokens: &mut Tokens<'a>,
    faults: &mut Faults<'_>,
    start: usize,
    (routine, scope, storage): (usize, Scope, Storage),
    types: &Types<'_>,
) -> Result<Declaration<'a>, RapidFault> {
    let from = tokens.take()?.start;
    let type_name = read_name(tokens, "a type")?;
    let name = read_name(tokens, "a name")?;
    let data_type = match types.kind(type_name) {
        TypeKind::Read(data_type) => data_type,
        kind => {
            let place = (routine, scope, storage);
            let mut parts = Vec::new();
            if let TypeKind::Record(components) = kind {
                parts = read_parts((tokens, faults), (types, components), start, place, name)?;
            } else {
                let mut reader = ExpressionReader::of_statement(tokens);
                reader.sizes()?;
                reader.assigned()?;
                end_statement(tokens, faults, "a semicolon")?;
            }
            let unfinished = tokens.unfinished_since(from);
            return Ok(if unfinished {
                Declaration::Unfinished { name }
            } else {
                Declaration::Unread { name, type_name, parts }
            });
        }
    };
    let (line, column) = tokens.line_and_column(start);
    let mut names = Vec::new();
    let sizes = ExpressionReader::new(tokens).sizes()?;
    for size in &sizes {
        size.collect_names(&mut names);
    }
    let size_names = names.len();
    let (value_place, mut value) = (tokens.last_end, None);
    if tokens.peek().kind == TokenKind::Assign {
        tokens.take()?;
        value = if sizes.is_empty() { read_direct(tokens, data_type, b';') } else { None };
        if value.is_none() {
            let read = ExpressionReader::new(tokens).expression()?;
            read.collect_names(&mut names);
            value = Some(read);
        }
    }
    end_statement(tokens, faults, "a semicolon")?;
    if tokens.unfinished_since(from) {
        return Ok(Declaration::Unfinished { name });
    }
    let declared = Declared {
        name,
        data_type,
        scope,
        storage,
        routine,
        size_names,
        names,
        start,
        end: tokens.last_end,
        line,
        column,
        written: None,
    };
    let written = WrittenContent { data_type, sizes, value, value_place };
    let (declared, content) = known_at_once(tokens.text, declared, written, faults.is_tolerant)?;
    Ok(Declaration::Read(declared, content))
}
