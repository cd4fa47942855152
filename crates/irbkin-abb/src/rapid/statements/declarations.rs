//! Declarations of data.

use super::faults::{Faults, end_statement};
use super::types::{TypeKind, Types};
use crate::prelude::*;
use crate::rapid::data::expression::{Expression, Form, Name};
use crate::rapid::data::module::{Scope, Storage};
use crate::rapid::data::own_types::DEEPEST_TYPE;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::content::{Placed, WrittenContent};
use crate::rapid::expression::direct::read_direct;
use crate::rapid::expression::evaluate::{Evaluator, Stop};
use crate::rapid::expression::names::{At, Names, NoNames};
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::place::Place;
use crate::rapid::text::tokens::{TokenKind, Tokens};
use crate::rapid::text::words::is_name_token;

#[expect(clippy::large_enum_variant, reason = "the large one is nearly every one of a large text")]
pub(crate) enum Declaration<'a> {
    /// With its content, if that is known without looking up a name.
    Read(Declared<'a>, Option<Placed>),
    /// Of a data type that is not read, with components that are.
    Unread { name: &'a str, type_name: &'a str, parts: Vec<DatumPart<'a>> },
    /// With a placeholder, perhaps for its name.
    Unfinished { name: &'a str },
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
    let sizes = ExpressionReader::new(tokens).sizes()?;
    let (value_place, mut value) = (tokens.last_end, None);
    if tokens.peek().kind == TokenKind::Assign {
        tokens.take()?;
        value = if sizes.is_empty() { read_direct(tokens, data_type, b';') } else { None };
        if value.is_none() {
            value = Some(ExpressionReader::new(tokens).expression()?);
        }
    }
    end_statement(tokens, faults, "a semicolon")?;
    if tokens.unfinished_since(from) {
        return Ok(Declaration::Unfinished { name });
    }
    let written = WrittenContent { data_type, sizes, value, value_place };
    let place = (routine, scope, storage);
    let (declared, content) = declared(tokens, start, place, name, written, faults.is_tolerant)?;
    Ok(Declaration::Read(declared, content))
}

/// A declaration of a type that is read, before its names are looked up.
pub(crate) struct Declared<'a> {
    pub(crate) name: &'a str,
    pub(crate) data_type: DataType,
    pub(crate) scope: Scope,
    pub(crate) storage: Storage,
    /// Index of the routine, from 1; 0 for the module.
    pub(crate) routine: usize,
    /// Names that its sizes and its value refer to.
    pub(crate) names: Vec<Name<'a>>,
    /// How many of the names, the first, belong to the sizes.
    pub(crate) size_names: usize,
    /// Bytes of the statement with its semicolon.
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) line: usize,
    pub(crate) column: usize,
    /// Its sizes and its value, unless its content is known without looking up a name: they are
    /// most of the memory that a large text takes.
    pub(crate) written: Option<Box<WrittenContent<'a>>>,
}

impl<'a> Declared<'a> {
    pub(crate) fn evaluator<'r>(&self, text: &'a str, names: &'r dyn Names) -> Evaluator<'r, 'a> {
        Evaluator {
            text,
            names,
            at: At { routine: self.routine, inside_loop: None },
            thing: (self.data_type.name(), self.name),
            constant: false,
            at_move: false,
            near: Place { byte: self.start, line: self.line, column: self.column },
        }
    }
}

/// A declaration that ends here, with its content if it has no names.
fn declared<'a>(
    tokens: &Tokens<'a>,
    start: usize,
    (routine, scope, storage): (usize, Scope, Storage),
    name: &'a str,
    written: WrittenContent<'a>,
    is_tolerant: bool,
) -> Result<(Declared<'a>, Option<Placed>), RapidFault> {
    let mut names = Vec::new();
    written.sizes.iter().for_each(|size| size.collect_names(&mut names));
    let size_names = names.len();
    written.value.iter().for_each(|value| value.collect_names(&mut names));
    let (line, column) = tokens.line_and_column(start);
    let mut declared = Declared {
        name,
        data_type: written.data_type,
        scope,
        storage,
        routine,
        names,
        size_names,
        start,
        end: tokens.last_end,
        line,
        column,
        written: None,
    };
    if declared.names.is_empty() {
        match written.evaluate(&declared.evaluator(tokens.text, &NoNames)) {
            Ok(placed) => return Ok((declared, Some(placed))),
            Err(Stop::Fault(fault)) if !is_tolerant => return Err(fault),
            // The reason is determined when all names are known.
            Err(Stop::Fault(_) | Stop::Unknown(_)) => {}
        }
    }
    declared.written = Some(Box::new(written));
    Ok((declared, None))
}

/// Most components of a datum that are read: records in records could have any number.
const MOST_PARTS: usize = 64;

pub(crate) struct DatumPart<'a> {
    /// Its name in lower case behind the one of the datum, such as `p` or `tool.frame`.
    pub(crate) path: String,
    pub(crate) declared: Declared<'a>,
    pub(crate) content: Option<Placed>,
}

/// A component before it is declared.
struct Leaf<'a> {
    path: String,
    data_type: DataType,
    value: Option<Expression<'a>>,
}

/// Read the declaration of a record behind its type and its name, up to its semicolon. Components
/// of a value that is not an aggregate are not read.
pub(super) fn read_parts<'a>(
    (tokens, faults): (&mut Tokens<'a>, &mut Faults<'_>),
    (types, components): (&Types<'_>, &[(String, String)]),
    start: usize,
    place: (usize, Scope, Storage),
    name: &'a str,
) -> Result<Vec<DatumPart<'a>>, RapidFault> {
    let sizes = ExpressionReader::new(tokens).sizes()?;
    let value_place = tokens.last_end;
    let value = ExpressionReader::new(tokens).assigned()?;
    end_statement(tokens, faults, "a semicolon")?;
    let mut leaves = Vec::new();
    flatten((types, components), "", value, sizes.len(), 0, &mut leaves);
    let mut parts = Vec::with_capacity(leaves.len());
    for Leaf { path, data_type, value } in leaves {
        let written = WrittenContent { data_type, sizes: sizes.clone(), value, value_place };
        let (declared, content) = declared(tokens, start, place, name, written, true)?;
        parts.push(DatumPart { path, declared, content });
    }
    Ok(parts)
}

/// Add the components of a record that are read, with the components of records in it.
fn flatten<'a>(
    (types, components): (&Types<'_>, &[(String, String)]),
    prefix: &str,
    value: Option<Expression<'a>>,
    dimensions: usize,
    depth: usize,
    leaves: &mut Vec<Leaf<'a>>,
) {
    let mut columns: Vec<Option<Expression<'a>>> = match value {
        None => components.iter().map(|_| None).collect(),
        Some(value) => match columns(value, dimensions, components.len()) {
            Some(columns) => columns.into_iter().map(Some).collect(),
            None => return,
        },
    };
    columns.reverse();
    for (type_name, name) in components {
        let Some(value) = columns.pop() else { return };
        if leaves.len() >= MOST_PARTS || depth >= DEEPEST_TYPE {
            return;
        }
        let path = format!("{prefix}{name}");
        match types.kind(type_name) {
            TypeKind::Read(data_type) => leaves.push(Leaf { path, data_type, value }),
            TypeKind::Record(inner) => {
                let prefix = format!("{path}.");
                flatten((types, inner), &prefix, value, dimensions, depth + 1, leaves);
            }
            TypeKind::Other => {}
        }
    }
}

/// Of an array of records an array of each component; of a single record its components.
fn columns(value: Expression<'_>, dimensions: usize, count: usize) -> Option<Vec<Expression<'_>>> {
    let Expression { start, end, form: Form::Aggregate(elements) } = value else { return None };
    if dimensions == 0 {
        return (elements.len() == count).then_some(elements);
    }
    let mut columns: Vec<Vec<_>> = (0..count).map(|_| Vec::with_capacity(elements.len())).collect();
    for element in elements {
        let of_element = self::columns(element, dimensions - 1, count)?;
        columns.iter_mut().zip(of_element).for_each(|(column, part)| column.push(part));
    }
    let made = |column| Expression { start, end, form: Form::Aggregate(column) };
    Some(columns.into_iter().map(made).collect())
}
