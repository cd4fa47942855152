//! Resolve names to values: data after the data that they refer to, then the moves.

mod moves;
pub(crate) mod resolver;

use alloc::sync::Arc;
use core::cell::RefCell;
use core::ops::Range;

use self::resolver::{Causes, Resolver};
use crate::prelude::*;
use crate::rapid::data::module::{Datum, Module, routine_name};
use crate::rapid::data::statement::{Statement, StatementKind};
use crate::rapid::data::unread::Reason;
use crate::rapid::expression::content::Placed;
use crate::rapid::statements::declarations::Declared;
use crate::rapid::statements::reader::Written;
use crate::rapid::text::fault::RapidFault;

pub(crate) fn resolved(written: Written<'_>, context: &[&Module]) -> Result<Module, RapidFault> {
    let Written {
        text,
        mut module,
        declared,
        contents,
        parts,
        mut moves,
        faults,
        assignments,
        scopes,
        blocks,
    } = written;
    // What is read twice is noted twice.
    module.calls.sort_by_key(|call| call.name.start);
    module.calls.dedup_by_key(|call| call.name.start);
    // Data with unknown parts are not resolved yet: none of their reasons is used before.
    let contents = contents.into_iter().map(|known| known.ok_or(Reason::Unfinished)).collect();
    let mut causes = Causes::new(&assignments, &declared, &scopes, &blocks);
    causes.add_assigned_elsewhere(module.name(), context, &declared, &scopes);
    let parts = &parts;
    let mut resolver = Resolver {
        text,
        declared: &declared,
        scopes: &scopes,
        blocks: &blocks,
        context,
        contents,
        parts,
        causes,
        elsewhere: RefCell::default(),
        routines_elsewhere: RefCell::default(),
        faults,
    };
    resolver.resolve_all()?;
    module.moves = resolver.moves(&mut moves, &mut module.statements)?;
    let Resolver { contents, causes, faults, .. } = resolver;
    module.faults = faults.kept;
    module.faults.sort_by_key(|fault| (fault.line, fault.column));
    module.data.reserve_exact(declared.len());
    let mut places = Vec::with_capacity(declared.len());
    for (i, (datum, content)) in declared.iter().zip(contents).enumerate() {
        let is_assigned = causes.of_datum(i).is_some();
        places.push(match parts.get(&i) {
            Some(name) => {
                // A component of a datum of a record is no datum by itself.
                if let (Ok(placed), 0) = (content, datum.routine) {
                    let part = datum_of(name.clone(), datum, None, placed);
                    module.parts.insert(name.clone(), part);
                }
                None
            }
            None => add(&mut module, text, datum, content, is_assigned),
        });
    }
    module.statements.sort_by_key(|statement| (statement.line, statement.column));
    module.assigned = causes.names(&declared, parts);
    module.index = scopes
        .module_data()
        .filter_map(|(name, declared)| Some((name, places.get(declared).copied()??)))
        .collect();
    module.text_length = text.len();
    Ok(module)
}

/// Add a declaration, which may refer to assigned data; its place among the data, if its value is
/// known.
fn add(
    module: &mut Module,
    text: &str,
    declared: &Declared<'_>,
    content: Result<Placed, Reason>,
    is_assigned: bool,
) -> Option<usize> {
    let source = |span: Range<usize>| text.get(span).unwrap_or_default().to_string();
    let name = declared.name.to_string();
    let routine = routine_name(&module.routines, declared.routine);
    let placed = match content {
        Ok(placed) => placed,
        Err(reason) => {
            let kind = StatementKind::Datum { name, reason: Box::new(reason) };
            let text = source(declared.start..declared.end);
            let Declared { line, column, start, .. } = *declared;
            let routine = routine.map(Arc::from);
            module.statements.push(Statement { line, column, routine, kind, text, start });
            return None;
        }
    };
    // Names of the sizes do not count: they are constants.
    let place = module.data.len();
    if is_assigned && declared.names.len() > declared.size_names {
        module.expressions.insert(place, source(placed.value_span.clone()));
    }
    module.data.push(datum_of(name, declared, routine, placed));
    Some(place)
}

fn datum_of(
    name: String,
    declared: &Declared<'_>,
    routine: Option<String>,
    placed: Placed,
) -> Datum {
    let Declared { data_type, scope, storage, line, column, .. } = *declared;
    let Placed { content, value_span, element_spans } = placed;
    Datum {
        name,
        data_type,
        scope,
        storage,
        routine,
        content,
        line,
        column,
        value_span,
        element_spans,
    }
}
