//! Expressions as they are written: a tree with the bytes of each part, before anything is looked up.

use alloc::boxed::Box;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use super::skipping::{is_unread_operator, not_closed, skip_to_end_of_argument};
use super::tokens::{Token, TokenKind, Tokens, excerpt};
use super::words::is_reserved;
use crate::error::{RapidFault, RapidFaultKind};

/// The deepest nesting of brackets and of blocks that is read.
pub const DEEPEST_NESTING: usize = 64;

/// Room that is made at first for the components of an aggregate: most have four or six.
const USUAL_COMPONENTS: usize = 6;

/// An expression and the bytes that it takes.
#[derive(Debug)]
pub(super) struct Expression<'a> {
    pub(super) start: usize,
    pub(super) end: usize,
    pub(super) form: Form<'a>,
}

#[derive(Debug)]
pub(super) enum Form<'a> {
    Number(f64),
    /// With its quotes.
    Text(&'a str),
    Bool(bool),
    Aggregate(Vec<Expression<'a>>),
    Reference(Box<Reference<'a>>),
    Call(Box<Call<'a>>),
    Negated(Box<Expression<'a>>),
    /// Numbers that are added or multiplied, from left to right.
    Chain(Box<Expression<'a>>, Vec<(Operator, Expression<'a>)>),
    /// The teach pendant's `*`.
    Star,
    /// What is not calculated, in words.
    Unread(&'static str),
}

/// A name, perhaps with indices, perhaps with components.
#[derive(Debug)]
pub(super) struct Reference<'a> {
    pub(super) name: &'a str,
    pub(super) indices: Vec<Expression<'a>>,
    pub(super) components: Vec<&'a str>,
}

/// A function with its arguments.
#[derive(Debug)]
pub(super) struct Call<'a> {
    pub(super) name: &'a str,
    pub(super) required: Vec<Expression<'a>>,
    pub(super) optional: Vec<(&'a str, Option<Expression<'a>>)>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operator {
    Plus,
    Minus,
    Times,
    Over,
}

/// Reads expressions and collects the names that they refer to.
pub(super) struct ExpressionReader<'t, 'a> {
    tokens: &'t mut Tokens<'a>,
    /// Names in the expressions read, those of functions too, in order.
    pub(super) names: Vec<&'a str>,
    depth: usize,
}

impl<'t, 'a> ExpressionReader<'t, 'a> {
    pub(super) fn new(tokens: &'t mut Tokens<'a>) -> Self {
        Self { tokens, names: Vec::new(), depth: 0 }
    }

    /// The expression that begins at the next token.
    pub(super) fn expression(&mut self) -> Result<Expression<'a>, RapidFault> {
        let first = self.tokens.peek();
        if let TokenKind::Number(value) = first.kind {
            // Most of a module: a number by itself.
            self.tokens.take()?;
            if matches!(self.tokens.peek().kind, TokenKind::Symbol(b',' | b']')) {
                return Ok(self.made(first.start, Form::Number(value)));
            }
            self.tokens.step_back(first);
        }
        let start = first.start;
        let sum = self.sum()?;
        if self.at_end_of_expression() {
            return Ok(sum);
        }
        if !is_unread_operator(self.tokens) {
            return Err(self
                .tokens
                .unexpected("an operator, a comma or the end of the expression"));
        }
        skip_to_end_of_argument(self.tokens)?;
        Ok(self.made(start, Form::Unread("this operator is not calculated")))
    }

    /// The sizes of an array in braces, none without braces, and the names in them.
    pub(super) fn sizes(mut self) -> Result<(Vec<Expression<'a>>, Vec<&'a str>), RapidFault> {
        let open = self.tokens.peek();
        let mut sizes = Vec::new();
        if open.is(b'{') {
            self.tokens.take()?;
            sizes = self.list(open, b'}')?;
            if sizes.is_empty() {
                return Err(self.tokens.fault(
                    open.start,
                    RapidFaultKind::Unexpected {
                        found: "{}".to_string(),
                        wanted: "a size".to_string(),
                    },
                ));
            }
        }
        Ok((sizes, self.names))
    }

    /// Expressions between commas, up to the closing symbol; the opening one was taken.
    pub(super) fn list(
        &mut self,
        open: Token,
        close: u8,
    ) -> Result<Vec<Expression<'a>>, RapidFault> {
        self.depth += 1;
        if self.depth > DEEPEST_NESTING {
            return Err(self
                .tokens
                .fault(open.start, RapidFaultKind::TooDeep { bound: DEEPEST_NESTING }));
        }
        let mut expressions = Vec::new();
        if !self.tokens.peek().is(close) {
            expressions.reserve_exact(USUAL_COMPONENTS);
            expressions.push(self.expression()?);
            while self.tokens.take_if(b',')? {
                expressions.push(self.expression()?);
            }
        }
        self.close(open, close)?;
        Ok(expressions)
    }

    fn close(&mut self, open: Token, close: u8) -> Result<(), RapidFault> {
        self.depth -= 1;
        if self.tokens.take_if(close)? { Ok(()) } else { Err(not_closed(self.tokens, open, close)) }
    }

    fn at_end_of_expression(&self) -> bool {
        match self.tokens.peek().kind {
            TokenKind::Symbol(symbol) => b",;])}\\:(".contains(&symbol),
            TokenKind::End | TokenKind::Assign => true,
            _ => false,
        }
    }

    fn sum(&mut self) -> Result<Expression<'a>, RapidFault> {
        self.chain([(b'+', Operator::Plus), (b'-', Operator::Minus)], Self::product)
    }

    fn product(&mut self) -> Result<Expression<'a>, RapidFault> {
        self.chain([(b'*', Operator::Times), (b'/', Operator::Over)], Self::factor)
    }

    fn chain(
        &mut self,
        operators: [(u8, Operator); 2],
        operand: fn(&mut Self) -> Result<Expression<'a>, RapidFault>,
    ) -> Result<Expression<'a>, RapidFault> {
        let first = operand(self)?;
        let mut rest = Vec::new();
        while let Some((_, operator)) =
            operators.iter().find(|(symbol, _)| self.tokens.peek().is(*symbol))
        {
            self.tokens.take()?;
            rest.push((*operator, operand(self)?));
        }
        if rest.is_empty() {
            return Ok(first);
        }
        Ok(self.made(first.start, Form::Chain(Box::new(first), rest)))
    }

    fn factor(&mut self) -> Result<Expression<'a>, RapidFault> {
        let start = self.tokens.peek().start;
        let mut negative = false;
        loop {
            match self.tokens.peek().kind {
                TokenKind::Symbol(b'-') => negative = !negative,
                TokenKind::Symbol(b'+') => {}
                _ => break,
            }
            self.tokens.take()?;
        }
        let mut operand = self.operand()?;
        operand.start = start;
        if !negative {
            return Ok(operand);
        }
        let form = match operand.form {
            Form::Number(value) => Form::Number(-value),
            _ => Form::Negated(Box::new(operand)),
        };
        Ok(self.made(start, form))
    }

    fn operand(&mut self) -> Result<Expression<'a>, RapidFault> {
        let token = self.tokens.peek();
        let form = match token.kind {
            TokenKind::Number(value) => {
                self.tokens.take()?;
                Form::Number(value)
            }
            TokenKind::Text => {
                self.tokens.take()?;
                Form::Text(self.tokens.text_of(token))
            }
            TokenKind::Symbol(b'*') => {
                self.tokens.take()?;
                Form::Star
            }
            TokenKind::Symbol(b'[') => {
                self.tokens.take()?;
                Form::Aggregate(self.list(token, b']')?)
            }
            TokenKind::Symbol(b'(') => return self.parenthesis(token),
            TokenKind::Placeholder => {
                self.tokens.take()?;
                Form::Unread("it is not finished")
            }
            TokenKind::Name => self.name(token)?,
            _ => return Err(self.tokens.unexpected("a value")),
        };
        Ok(self.made(token.start, form))
    }

    fn parenthesis(&mut self, open: Token) -> Result<Expression<'a>, RapidFault> {
        self.tokens.take()?;
        let mut inside = self.list(open, b')')?;
        match (inside.pop(), inside.is_empty()) {
            (Some(only), true) => Ok(self.made(open.start, only.form)),
            _ => Err(self.tokens.fault(open.start, expected_value("()"))),
        }
    }

    /// TRUE, FALSE, a function or a reference.
    fn name(&mut self, token: Token) -> Result<Form<'a>, RapidFault> {
        let name = self.tokens.text_of(token);
        if name.eq_ignore_ascii_case("TRUE") || name.eq_ignore_ascii_case("FALSE") {
            self.tokens.take()?;
            return Ok(Form::Bool(name.eq_ignore_ascii_case("TRUE")));
        }
        if name.eq_ignore_ascii_case("NOT") {
            skip_to_end_of_argument(self.tokens)?;
            return Ok(Form::Unread("NOT is not calculated"));
        }
        if is_reserved(name) {
            return Err(self.tokens.unexpected("a value"));
        }
        self.tokens.take()?;
        let next = self.tokens.peek();
        self.names.push(name);
        if next.is(b'(') {
            self.tokens.take()?;
            return Ok(Form::Call(Box::new(self.call(name, next)?)));
        }
        let indices = if next.is(b'{') {
            self.tokens.take()?;
            self.list(next, b'}')?
        } else {
            Vec::new()
        };
        let mut components = Vec::new();
        while self.tokens.take_if(b'.')? {
            if self.tokens.peek().kind != TokenKind::Name {
                return Err(self.tokens.unexpected("the name of a component"));
            }
            let component = self.tokens.take()?;
            components.push(self.tokens.text_of(component));
        }
        Ok(Form::Reference(Box::new(Reference { name, indices, components })))
    }

    fn call(&mut self, name: &'a str, open: Token) -> Result<Call<'a>, RapidFault> {
        self.depth += 1;
        if self.depth > DEEPEST_NESTING {
            return Err(self
                .tokens
                .fault(open.start, RapidFaultKind::TooDeep { bound: DEEPEST_NESTING }));
        }
        let mut call = Call { name, required: Vec::new(), optional: Vec::new() };
        while !self.tokens.peek().is(b')') {
            if self.tokens.take_if(b'\\')? {
                call.optional.push(self.optional()?);
            } else {
                call.required.push(self.argument()?);
            }
            let more = self.tokens.take_if(b',')? || self.tokens.peek().is(b'\\');
            if !more {
                break;
            }
        }
        self.close(open, b')')?;
        Ok(call)
    }

    /// A required argument: its value, perhaps after its name and `:=`. The name is not kept: RAPID has them in their order.
    pub(super) fn argument(&mut self) -> Result<Expression<'a>, RapidFault> {
        if self.tokens.at_assigned_name() {
            self.tokens.take()?;
            self.tokens.take()?;
        }
        self.expression()
    }

    /// `Name`, `Name:=value` or `Name?parameter`; the backslash was taken.
    pub(super) fn optional(&mut self) -> Result<(&'a str, Option<Expression<'a>>), RapidFault> {
        if self.tokens.peek().kind != TokenKind::Name {
            return Err(self.tokens.unexpected("the name of an optional argument"));
        }
        let token = self.tokens.take()?;
        let name = self.tokens.text_of(token);
        // \Name?parameter passes the caller's own argument on, if there is one; the question mark belongs to the value.
        let mark = self.tokens.peek();
        if self.tokens.take_if(b'?')? {
            self.expression()?;
            let form = Form::Unread("it depends on whether an optional argument is there");
            return Ok((name, Some(self.made(mark.start, form))));
        }
        if self.tokens.peek().kind != TokenKind::Assign {
            return Ok((name, None));
        }
        self.tokens.take()?;
        Ok((name, Some(self.expression()?)))
    }

    fn made(&self, start: usize, form: Form<'a>) -> Expression<'a> {
        Expression { start, end: self.tokens.last_end, form }
    }
}

fn expected_value(found: &str) -> RapidFaultKind {
    RapidFaultKind::Unexpected { found: found.to_string(), wanted: "a value".to_string() }
}

/// The text of an expression, short.
pub(super) fn written(text: &str, expression: &Expression<'_>) -> String {
    excerpt(text.get(expression.start..expression.end).unwrap_or_default())
}
