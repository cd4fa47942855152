//! The arguments of instructions and calls, and assignments, as they are written.

use alloc::string::String;

use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::expression::tree::{Arguments, Expression};
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::tokens::{TokenKind, Tokens};

/// The arguments of a statement, which begins with its name.
pub(super) fn arguments(statement: &str) -> Result<Arguments<'_>, RapidFault> {
    let mut tokens = Tokens::new(statement)?;
    // The name, or the text of a call by name between percent signs.
    if tokens.take()?.is(b'%') {
        while tokens.peek().kind != TokenKind::End && !tokens.take()?.is(b'%') {}
    }
    let mut found = Arguments::default();
    while tokens.peek().kind != TokenKind::End && !tokens.peek().is(b';') {
        tokens.take_if(b',')?;
        if tokens.take_if(b'\\')? {
            found.optional.push(ExpressionReader::new(&mut tokens).optional()?);
        } else {
            found.required.push(ExpressionReader::new(&mut tokens).argument()?);
        }
    }
    Ok(found)
}

/// The target and the value of an assignment, with the text behind `:=`.
pub(super) fn assignment(statement: &str) -> Result<(Expression<'_>, Expression<'_>), RapidFault> {
    let mut tokens = Tokens::new(statement)?;
    let target = ExpressionReader::new(&mut tokens).expression()?;
    if tokens.peek().kind == TokenKind::Assign {
        tokens.take()?;
    }
    let value = ExpressionReader::new(&mut tokens).expression()?;
    Ok((target, value))
}

/// The name of the procedure that a statement calls: its first word or, of a call by name, the text
/// that is written there.
pub(in crate::rapid) fn called(statement: &str) -> Option<String> {
    let mut tokens = Tokens::new(statement).ok()?;
    let first = tokens.take().ok()?;
    let name = if first.is(b'%') { tokens.take().ok()? } else { first };
    match name.kind {
        TokenKind::Name if !first.is(b'%') => Some(tokens.text_of(name).to_lowercase()),
        TokenKind::Text if tokens.peek().is(b'%') => {
            // It may name the module, too: "Part:rGo".
            let name = tokens.text_of(name).trim_matches('"');
            Some(name.rsplit(':').next().unwrap_or(name).trim().to_lowercase())
        }
        _ => None,
    }
}

/// The name in lower case that an expression refers to, with its components, joined by dots.
pub(super) fn referred(expression: &Expression<'_>) -> Option<(String, String)> {
    let (name, _, components) = expression.reference()?;
    Some((name.to_lowercase(), components.join(".").to_lowercase()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_are_read_behind_names_and_calls_by_name() {
        let found = arguments("GoL pA, v100 \\Z:=z10, tG \\WObj:=w1;").unwrap();
        assert_eq!((found.required.len(), found.optional.len()), (3, 2));
        assert_eq!(arguments("%\"rGo\"% p1, 2;").unwrap().required.len(), 2);
        assert_eq!(called("%\"rGo\"% p1;").as_deref(), Some("rgo"));
        assert_eq!(called("%\"Part:rGo\"% p1;").as_deref(), Some("rgo"));
        assert_eq!(called("%\"r\"+n% p1;"), None);
        assert_eq!(called("RGO;").as_deref(), Some("rgo"));
    }

    #[test]
    fn assignments_have_a_target_with_components() {
        let (target, _) = assignment("t.tframe.trans:=[0,0,1];").unwrap();
        assert_eq!(referred(&target), Some(("t".into(), "tframe.trans".into())));
        let (target, _) = assignment("p{i}:=Offs(p{1},1,2,3);").unwrap();
        assert_eq!(referred(&target), Some(("p".into(), String::new())));
    }
}
