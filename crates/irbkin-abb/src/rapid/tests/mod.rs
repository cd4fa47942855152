//! Reading, construct by construct.

mod assigned;
mod build;
mod calls;
mod cases;
mod check;
mod direct;
mod functions;
mod loading;
mod motion;
mod moves;
mod names;
mod place;
mod program;
mod records;
mod recovery;
mod statements;
mod tasks;
mod texts;
mod unfinished;
mod whole;

use std::string::String;
use std::string::ToString;
use std::vec::Vec;

use super::data::unread::Reason;
use super::{Content, Module, Value, parse};

fn read(text: &str) -> Module {
    parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// The message for an invalid text.
fn fault(text: &str) -> String {
    parse(text, &[]).map(|module| panic!("no fault: {module}")).unwrap_err().to_string()
}

fn single(module: &Module, name: &str) -> Value {
    match &module.find(name).unwrap_or_else(|| panic!("no {name}: {:?}", module.skipped())).content
    {
        Content::Single(value) => value.clone(),
        other => panic!("{name} is {other:?}"),
    }
}

fn number(module: &Module, name: &str) -> f64 {
    let Value::Num(number) = single(module, name) else { panic!("{name} is no num") };
    number
}

fn not_read(module: &Module) -> Vec<String> {
    module.skipped().iter().map(|it| it.what()).collect()
}

/// The words of the reason why a value is unknown; empty if it is known.
fn words<T>(value: &Result<T, Reason>) -> String {
    value.as_ref().err().map(ToString::to_string).unwrap_or_default()
}

/// The module written and read again, which must be equal.
fn again(module: &Module, context: &[&Module]) -> Module {
    let text = module.to_string();
    let again = parse(&text, context).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(again.clone().without_positions(), module.clone().without_positions(), "{text}");
    again
}
