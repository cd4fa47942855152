//! Resolve names to values: data after the data that they refer to, then the moves.

mod moves;
pub(crate) mod resolver;

use alloc::boxed::Box;
use alloc::collections::BTreeMap;
use alloc::string::{String, ToString};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::cell::RefCell;
use core::ops::Range;

use self::resolver::{Causes, Resolver};
use crate::rapid::data::module::{Datum, Module, routine_name};
use crate::rapid::data::statement::{Statement, StatementKind};
use crate::rapid::data::unread::Reason;
use crate::rapid::expression::content::Placed;
use crate::rapid::statements::declarations::Declared;
use crate::rapid::statements::reader::Written;
use crate::rapid::text::fault::RapidFault;

/// The module of a text with every name resolved.
pub(crate) fn resolved(written: Written<'_>, context: &[&Module]) -> Result<Module, RapidFault> {
    let Written {
        text,
        name,
        attributes,
        routines,
        declared,
        contents,
        parts,
        types,
        mut moves,
        mut statements,
        faults,
        assignments,
        scopes,
        blocks,
        mut calls,
    } = written;
    // What is read twice is noted twice.
    calls.sort_by_key(|call| call.name.start);
    calls.dedup_by_key(|call| call.name.start);
    // Data with unknown parts are not resolved yet: none of their reasons is used before.
    let contents = contents.into_iter().map(|known| known.ok_or(Reason::Unfinished)).collect();
    let mut causes = Causes::new(&assignments, &declared, &scopes, &blocks);
    causes.add_assigned_elsewhere(name, context, &declared, &scopes);
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
    let moves = resolver.moves(&mut moves, &mut statements, &routines)?;
    let Resolver { contents, causes, faults, .. } = resolver;
    let mut faults = faults.kept;
    faults.sort_by_key(|fault| (fault.line, fault.column));
    let mut all = ResolvedData { statements, ..ResolvedData::default() };
    all.data.reserve_exact(declared.len());
    for (i, (datum, content)) in declared.iter().zip(contents).enumerate() {
        if let Some(name) = parts.get(&i) {
            all.add_part(name, datum, content);
            continue;
        }
        let routine = routine_name(&routines, datum.routine);
        all.add(text, datum, routine, content, causes.of_datum(i).is_some());
    }
    let ResolvedData { data, parts: of_records, places, mut statements, expressions } = all;
    statements.sort_by_key(|statement| (statement.line, statement.column));
    let assigned = causes.names(&declared, parts);
    let index = scopes
        .module_data()
        .filter_map(|(name, declared)| Some((name, places.get(declared).copied()??)))
        .collect();
    let name = name.map(ToString::to_string);
    Ok(Module {
        name,
        attributes,
        routines,
        data,
        moves,
        statements,
        faults,
        index,
        assigned,
        expressions,
        types,
        parts: of_records,
        calls,
        text_length: text.len(),
    })
}

/// The data of a module, and what is not read.
#[derive(Default)]
struct ResolvedData {
    data: Vec<Datum>,
    /// Components of data of records.
    parts: BTreeMap<String, Datum>,
    /// The place of each declaration among the data.
    places: Vec<Option<usize>>,
    statements: Vec<Statement>,
    /// The values that refer to assigned data, as they are written, by the place of the datum.
    expressions: BTreeMap<usize, String>,
}

impl ResolvedData {
    /// Add a component of a datum, if it is known and not of a routine.
    fn add_part(&mut self, name: &str, declared: &Declared<'_>, content: Result<Placed, Reason>) {
        self.places.push(None);
        if let (Ok(placed), 0) = (content, declared.routine) {
            self.parts.insert(name.to_string(), datum_of(name.to_string(), declared, None, placed));
        }
    }

    /// Add a declaration, which may refer to assigned data.
    fn add(
        &mut self,
        text: &str,
        declared: &Declared<'_>,
        routine: Option<String>,
        content: Result<Placed, Reason>,
        is_assigned: bool,
    ) {
        let source = |span: Range<usize>| text.get(span).unwrap_or_default().to_string();
        let name = declared.name.to_string();
        self.places.push(content.is_ok().then_some(self.data.len()));
        let placed = match content {
            Ok(placed) => placed,
            Err(reason) => {
                let kind = StatementKind::Datum { name, reason: Box::new(reason) };
                let text = source(declared.start..declared.end);
                let Declared { line, column, start, .. } = *declared;
                let routine = routine.map(Arc::from);
                self.statements.push(Statement { line, column, routine, kind, text, start });
                return;
            }
        };
        // Names of the sizes do not count: they are constants.
        if is_assigned && declared.names.len() > declared.size_names {
            self.expressions.insert(self.data.len(), source(placed.value_span.clone()));
        }
        self.data.push(datum_of(name, declared, routine, placed));
    }
}

/// The datum of a declaration and its content.
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
