//! Expressions as they are written: a tree with the bytes of each part, before names are looked up.

use alloc::borrow::Cow;

use super::unread::Reason;
use super::value::Value;
use crate::prelude::*;
use crate::rapid::text::place::excerpt;

/// A name in an expression: of the text that is read or, in a module, its own.
pub(crate) type Name<'a> = Cow<'a, str>;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Expression<'a> {
    pub(crate) start: usize,
    pub(crate) end: usize,
    pub(crate) form: Form<'a>,
}

impl<'a> Expression<'a> {
    /// The name, the indices and the components of a reference.
    pub(crate) fn reference(&self) -> Option<(&Name<'a>, &[Self], &[Name<'a>])> {
        match &self.form {
            Form::Name(name) => Some((name, &[], &[])),
            Form::Reference(it) => Some((&it.name, &it.indices, &it.components)),
            _ => None,
        }
    }

    /// The name in lower case that it refers to, with its components, joined by dots.
    pub(crate) fn referred(&self) -> Option<(String, String)> {
        let (name, _, components) = self.reference()?;
        Some((name.to_lowercase(), components.join(".").to_lowercase()))
    }

    /// Add the names that it refers to, of functions too.
    pub(crate) fn collect_names(&self, names: &mut Vec<Name<'a>>) {
        match &self.form {
            Form::Name(name) => names.push(name.clone()),
            Form::Reference(it) => names.push(it.name.clone()),
            Form::Call(call) => names.push(call.name.clone()),
            _ => {}
        }
        self.parts().iter().for_each(|part| part.collect_names(names));
    }

    pub(crate) fn parts(&self) -> Vec<&Self> {
        match &self.form {
            Form::Reference(it) => it.indices.iter().collect(),
            Form::Call(call) => call.arguments.values().collect(),
            Form::Aggregate(parts) | Form::Unread(_, parts) => parts.iter().collect(),
            Form::Negated(operand) | Form::Not(operand) => Vec::from([&**operand]),
            Form::Chain(first, rest) => {
                core::iter::once(&**first).chain(rest.iter().map(|(_, it)| it)).collect()
            }
            Form::Compared(operands, _) => operands.iter().collect(),
            _ => Vec::new(),
        }
    }

    /// The expression with its own names, and with its bytes counted from `begin`.
    pub(crate) fn owned(self, begin: usize) -> Expression<'static> {
        let boxed = |it: Box<Self>| Box::new(it.owned(begin));
        let form = match self.form {
            Form::Number(value) => Form::Number(value),
            Form::Text(text) => Form::Text(owned(text)),
            Form::Bool(value) => Form::Bool(value),
            Form::Aggregate(parts) => Form::Aggregate(all_owned(parts, begin)),
            Form::Value(value) => Form::Value(value),
            Form::Name(name) => Form::Name(owned(name)),
            Form::Reference(it) => Form::Reference(Box::new(Reference {
                name: owned(it.name),
                indices: all_owned(it.indices, begin),
                components: it.components.into_iter().map(owned).collect(),
            })),
            Form::Call(call) => Form::Call(Box::new(Call {
                name: owned(call.name),
                arguments: call.arguments.owned(begin),
                components: call.components.into_iter().map(owned).collect(),
            })),
            Form::Negated(operand) => Form::Negated(boxed(operand)),
            Form::Chain(first, rest) => {
                let rest = rest.into_iter().map(|(operator, it)| (operator, it.owned(begin)));
                Form::Chain(boxed(first), rest.collect())
            }
            Form::Not(operand) => Form::Not(boxed(operand)),
            Form::Compared(operands, relation) => {
                Form::Compared(Box::new(operands.map(|it| it.owned(begin))), relation)
            }
            Form::Star => Form::Star,
            Form::Unread(reason, parts) => Form::Unread(reason, all_owned(parts, begin)),
        };
        Expression { start: self.start - begin, end: self.end - begin, form }
    }
}

fn owned(name: Name<'_>) -> Name<'static> {
    Cow::Owned(name.into_owned())
}

fn all_owned(expressions: Vec<Expression<'_>>, begin: usize) -> Vec<Expression<'static>> {
    let mut all: Vec<_> = expressions.into_iter().map(|it| it.owned(begin)).collect();
    all.shrink_to_fit();
    all
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Form<'a> {
    Number(f64),
    /// With its quotes.
    Text(Name<'a>),
    Bool(bool),
    Aggregate(Vec<Expression<'a>>),
    /// An aggregate without names, read for its type.
    Value(Box<Value>),
    /// A name by itself, the most frequent reference.
    Name(Name<'a>),
    Reference(Box<Reference<'a>>),
    Call(Box<Call<'a>>),
    Negated(Box<Expression<'a>>),
    /// Numbers that are added or multiplied, from left to right.
    Chain(Box<Expression<'a>>, Vec<(Operator, Expression<'a>)>),
    Not(Box<Expression<'a>>),
    Compared(Box<[Expression<'a>; 2]>, Relation),
    /// The teach pendant's `*`.
    Star,
    /// Not evaluated, for this reason, whatever its operands are.
    Unread(Box<Reason>, Vec<Expression<'a>>),
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Reference<'a> {
    pub(crate) name: Name<'a>,
    pub(crate) indices: Vec<Expression<'a>>,
    pub(crate) components: Vec<Name<'a>>,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Call<'a> {
    pub(crate) name: Name<'a>,
    pub(crate) arguments: Arguments<'a>,
    pub(crate) components: Vec<Name<'a>>,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Arguments<'a> {
    pub(crate) required: Vec<Expression<'a>>,
    pub(crate) optional: Vec<Optional<'a>>,
}

/// An optional argument: a switch without a value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Optional<'a> {
    pub(crate) name: Name<'a>,
    pub(crate) value: Option<Expression<'a>>,
    /// Number of required arguments before it.
    pub(crate) after: usize,
}

impl Optional<'_> {
    pub(crate) fn is(&self, name: &str) -> bool {
        self.name.eq_ignore_ascii_case(name)
    }
}

impl<'a> Arguments<'a> {
    /// The arguments with their own names, and with their bytes counted from `begin`.
    pub(crate) fn owned(self, begin: usize) -> Arguments<'static> {
        let optional = self.optional.into_iter().map(|it| Optional {
            name: owned(it.name),
            value: it.value.map(|it| it.owned(begin)),
            after: it.after,
        });
        Arguments { required: all_owned(self.required, begin), optional: optional.collect() }
    }

    /// The values of all arguments, the required ones first.
    pub(crate) fn values(&self) -> impl Iterator<Item = &Expression<'a>> {
        self.required.iter().chain(self.optional.iter().filter_map(|it| it.value.as_ref()))
    }

    /// The value of the first optional argument that has this name, in any case, and a value.
    pub(crate) fn value(&self, name: &str) -> Option<&Expression<'a>> {
        self.optional.iter().filter(|it| it.is(name)).find_map(|it| it.value.as_ref())
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
    Div,
    Mod,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Relation {
    Equal,
    Unequal,
    Less,
    AtMost,
    Greater,
    AtLeast,
}

impl Relation {
    pub(crate) fn holds(self, left: f64, right: f64) -> bool {
        match self {
            Self::Equal => left.total_cmp(&right).is_eq(),
            Self::Unequal => left.total_cmp(&right).is_ne(),
            Self::Less => left < right,
            Self::AtMost => left <= right,
            Self::Greater => left > right,
            Self::AtLeast => left >= right,
        }
    }
}

/// The text of an expression, shortened.
pub(crate) fn written(text: &str, expression: &Expression<'_>) -> String {
    excerpt(text.get(expression.start..expression.end).unwrap_or_default())
}
