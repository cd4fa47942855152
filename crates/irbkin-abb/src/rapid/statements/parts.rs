//! Data of records that a program defines: each component of a type that is read is a datum of its
//! own, with a name such as `station.p`.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::declared::{Declared, known_at_once};
use super::faults::{Faults, end_statement};
use super::types::{TypeKind, Types};
use crate::rapid::data::expression::{Expression, Form};
use crate::rapid::data::module::{Scope, Storage};
use crate::rapid::data::own_types::DEEPEST_TYPE;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::content::{Placed, WrittenContent};
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::tokens::Tokens;

/// Most components of a datum that are read: records in records could have any number.
const MOST_PARTS: usize = 64;

/// A component of a datum.
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
    (routine, scope, storage): (usize, Scope, Storage),
    name: &'a str,
) -> Result<Vec<DatumPart<'a>>, RapidFault> {
    let sizes = ExpressionReader::new(tokens).sizes()?;
    let value_place = tokens.last_end;
    let value = ExpressionReader::new(tokens).assigned()?;
    end_statement(tokens, faults, "a semicolon")?;
    let end = tokens.last_end;
    let (line, column) = tokens.line_and_column(start);
    let mut leaves = Vec::new();
    flatten((types, components), "", value, sizes.len(), 0, &mut leaves);
    let mut parts = Vec::with_capacity(leaves.len());
    for Leaf { path, data_type, value } in leaves {
        let mut names = Vec::new();
        for size in &sizes {
            size.collect_names(&mut names);
        }
        let size_names = names.len();
        if let Some(value) = &value {
            value.collect_names(&mut names);
        }
        let declared = Declared {
            name,
            data_type,
            scope,
            storage,
            routine,
            names,
            size_names,
            start,
            end,
            line,
            column,
            written: None,
        };
        let sizes = sizes.clone();
        let written = WrittenContent { data_type, sizes, value, value_place };
        let (declared, content) = known_at_once(tokens.text, declared, written, true)?;
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
