//! Parameters of routines, and the arguments of calls as they are written.

use alloc::string::String;
use alloc::vec::Vec;

use crate::rapid::data::module::Routine;
use crate::rapid::data::value::DataType;
use crate::rapid::expression::reader::ExpressionReader;
use crate::rapid::expression::tree::Expression;
use crate::rapid::text::fault::RapidFault;
use crate::rapid::text::tokens::{TokenKind, Tokens};

/// A parameter of a routine.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Parameter {
    /// Name in lower case.
    pub(super) name: String,
    /// Its type; `None` for a switch and for types that are not read.
    pub(super) data_type: Option<DataType>,
    pub(super) is_optional: bool,
    /// Whether what the routine assigns to it is assigned to its argument.
    pub(super) is_reference: bool,
    /// Whether it is one of the alternatives of the parameter before it, as in `\A | \B`.
    pub(super) is_alternative: bool,
}

/// The parameters of a routine, by its header.
pub(super) fn parameters(routine: &Routine) -> Vec<Parameter> {
    let open = routine.header.find('(');
    let Some(mut tokens) = open.and_then(|at| Tokens::new(&routine.header[at..]).ok()) else {
        return Vec::new();
    };
    let mut found = Vec::new();
    let (mut words, mut is_optional, mut is_alternative) = (Vec::new(), false, false);
    while let Ok(token) = tokens.take() {
        match token.kind {
            TokenKind::Name => words.push(tokens.text_of(token)),
            TokenKind::End | TokenKind::Symbol(b',' | b'|' | b'\\' | b')') => {
                found.extend(parameter(&words, is_optional, is_alternative));
                words.clear();
                match token.kind {
                    TokenKind::Symbol(b'\\') => is_optional = true,
                    TokenKind::Symbol(b'|') => (is_optional, is_alternative) = (true, true),
                    TokenKind::Symbol(b',') => (is_optional, is_alternative) = (false, false),
                    _ => return found,
                }
            }
            _ => {}
        }
    }
    found
}

/// A parameter by its words: perhaps a mode, a type, a name.
fn parameter(words: &[&str], is_optional: bool, is_alternative: bool) -> Option<Parameter> {
    let (name, before) = words.split_last()?;
    let is_mode = |word: &&str| {
        ["INOUT", "VAR", "PERS", "REF"].iter().any(|mode| mode.eq_ignore_ascii_case(word))
    };
    let is_reference = before.first().is_some_and(is_mode);
    let data_type = before.last().and_then(|of| DataType::named(of));
    let name = name.to_lowercase();
    Some(Parameter { name, data_type, is_optional, is_reference, is_alternative })
}

/// The arguments of an instruction or a call.
pub(super) struct Arguments<'a> {
    pub(super) required: Vec<Expression<'a>>,
    pub(super) optional: Vec<(&'a str, Option<Expression<'a>>)>,
}

/// The arguments of a statement, which begins with its name.
pub(super) fn arguments(statement: &str) -> Result<Arguments<'_>, RapidFault> {
    let mut tokens = Tokens::new(statement)?;
    // The name, or the text of a call by name between percent signs.
    if tokens.take()?.is(b'%') {
        while tokens.peek().kind != TokenKind::End && !tokens.take()?.is(b'%') {}
    }
    let mut found = Arguments { required: Vec::new(), optional: Vec::new() };
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
    use crate::rapid::expression::tree::Form;
    match &expression.form {
        Form::Name(name) => Some((name.to_lowercase(), String::new())),
        Form::Reference(it) => {
            Some((it.name.to_lowercase(), it.components.join(".").to_lowercase()))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use alloc::string::ToString;

    use super::*;
    use crate::rapid::data::module::RoutineKind;

    fn of(header: &str) -> Vec<Parameter> {
        let header = header.to_string();
        let (kind, name) = (RoutineKind::Proc, "GoL".to_string());
        parameters(&Routine { kind, name, header, line: 1, column: 1 })
    }

    #[test]
    fn parameters_have_types_modes_and_alternatives() {
        let found = of("PROC GoL(robtarget p,speeddata v{*} \\ zonedata Z | switch Fine, \
            PERS tooldata t \\PERS wobjdata WObj)");
        let names: Vec<&str> = found.iter().map(|it| it.name.as_str()).collect();
        assert_eq!(names, ["p", "v", "z", "fine", "t", "wobj"]);
        let are = |of: fn(&Parameter) -> bool| found.iter().map(of).collect::<Vec<bool>>();
        assert_eq!(are(|it| it.is_optional), [false, false, true, true, false, true]);
        assert_eq!(are(|it| it.is_reference), [false, false, false, false, true, true]);
        assert_eq!(are(|it| it.is_alternative), [false, false, false, true, false, false]);
        assert_eq!(found[3].data_type, None);
        assert_eq!(found[4].data_type, Some(DataType::ToolData));
        assert!(of("PROC main()").is_empty() && of("TRAP t").is_empty());
    }

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
