//! From names to values: data after those that they refer to, then the moves.

mod assigned;
mod moves;
mod resolver;

use alloc::collections::BTreeMap;
use alloc::string::ToString;
use alloc::vec::Vec;

use self::assigned::Causes;
use self::resolver::Resolver;
use crate::error::RapidFault;
use crate::rapid::data::module::{Datum, Module, routine_name};
use crate::rapid::data::reason::Reason;
use crate::rapid::data::skipped::{NotRead, Skipped};
use crate::rapid::expression::content::Placed;
use crate::rapid::statements::declarations::Declared;
use crate::rapid::statements::reader::Written;

/// The module of a text with every name looked up.
pub(crate) fn resolved(written: Written<'_>, context: &[&Module]) -> Result<Module, RapidFault> {
    let Written {
        text,
        name,
        attributes,
        routines,
        declared,
        contents,
        mut moves,
        mut skipped,
        assignments,
        scopes,
        blocks,
    } = written;
    // Those that hold something unknown are not resolved yet: no reason of theirs is seen before.
    let contents = contents.into_iter().map(|known| known.ok_or(Reason::Unfinished)).collect();
    let causes = Causes::new(&assignments, &declared, &scopes, &blocks);
    let mut resolver = Resolver {
        text,
        declared: &declared,
        scopes: &scopes,
        blocks: &blocks,
        context,
        contents,
        causes,
    };
    resolver.resolve_all()?;
    let mut resolved_moves = Vec::with_capacity(moves.len());
    for step in &mut moves {
        resolved_moves.extend(resolver.step(step, &routines)?);
    }
    let Resolver { contents, causes, .. } = resolver;
    let mut data = Vec::with_capacity(declared.len());
    let mut places = Vec::with_capacity(declared.len());
    let mut expressions = BTreeMap::new();
    for (i, (datum, content)) in declared.iter().zip(contents).enumerate() {
        let routine = routine_name(&routines, datum.routine);
        let Declared { data_type, scope, storage, line, column, .. } = *datum;
        let name = datum.name.to_string();
        places.push(content.is_ok().then_some(data.len()));
        let Placed { content, value_span, element_spans } = match content {
            Ok(placed) => placed,
            Err(reason) => {
                let what = NotRead::Datum { name, reason };
                let text = text.get(datum.start..datum.end).unwrap_or_default().to_string();
                skipped.push(Skipped { line, column, routine, what, text });
                continue;
            }
        };
        if causes.of_datum(i).is_some() && !datum.names.is_empty() {
            let expression = text.get(value_span.clone()).unwrap_or_default().to_string();
            expressions.insert(data.len(), expression);
        }
        data.push(Datum {
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
        });
    }
    skipped.sort_by_key(|skipped| (skipped.line, skipped.column));
    let assigned = causes.names(&declared);
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
        moves: resolved_moves,
        skipped,
        index,
        assigned,
        expressions,
        text_length: text.len(),
    })
}
