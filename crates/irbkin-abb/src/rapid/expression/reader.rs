//! Read expressions as trees.

use alloc::boxed::Box;
use alloc::string::ToString;
use alloc::vec::Vec;

use super::tree::{Arguments, Call, Expression, Form, Operator, Reference};
use super::whole::{DEEPEST_NESTING, WholeReader, note};
use crate::rapid::data::fit::Fit;
use crate::rapid::data::table::Entry;
use crate::rapid::data::unread::Reason;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::skipping::not_closed;
use crate::rapid::text::tokens::{Token, TokenKind, Tokens};
use crate::rapid::text::words::is_reserved;

/// Initial capacity for the components of an aggregate: most have four or six.
const USUAL_COMPONENTS: usize = 6;

pub(crate) struct ExpressionReader<'t, 'a> {
    tokens: &'t mut Tokens<'a>,
    depth: usize,
}

impl<'t, 'a> ExpressionReader<'t, 'a> {
    pub(crate) fn new(tokens: &'t mut Tokens<'a>) -> Self {
        Self { tokens, depth: 0 }
    }

    /// The expression that begins at the next token.
    pub(crate) fn expression(&mut self) -> Result<Expression<'a>, RapidFault> {
        if let Some(alone) = self.alone()? {
            return Ok(alone);
        }
        let start = self.tokens.peek().start;
        let sum = self.sum()?;
        if self.at_end_of_expression() {
            return Ok(sum);
        }
        let end = self.tokens.last_end;
        WholeReader::new(self.tokens, self.depth).rest()?;
        if self.tokens.last_end == end {
            // The end of the statement lacks.
            if self.tokens.peek().kind == TokenKind::Name && self.tokens.is_first_of_line() {
                return Ok(sum);
            }
            return Err(self.tokens.lacking("an operator, a comma or the end of the expression"));
        }
        Ok(self.made(start, Form::Unread(Box::new(Reason::Operator))))
    }

    /// A single number or name, most of a module: read without looking for operators.
    fn alone(&mut self) -> Result<Option<Expression<'a>>, RapidFault> {
        let (first, mark) = (self.tokens.peek(), self.tokens.mark());
        let form = match first.kind {
            TokenKind::Number(value) => Form::Number(value),
            TokenKind::Name if !is_reserved(self.tokens.text_of(first)) => {
                Form::Name(self.tokens.text_of(first))
            }
            _ => return Ok(None),
        };
        self.tokens.take()?;
        let TokenKind::Symbol(b',' | b';' | b']' | b')' | b'\\') = self.tokens.peek().kind else {
            self.tokens.rewind(mark);
            return Ok(None);
        };
        Ok(Some(self.made(first.start, form)))
    }

    /// The sizes of an array in braces; empty without braces.
    pub(crate) fn sizes(&mut self) -> Result<Vec<Expression<'a>>, RapidFault> {
        let open = self.tokens.peek();
        let mut sizes = Vec::new();
        if open.is(b'{') {
            self.tokens.take()?;
            sizes = self.list(open, b'}')?;
            if sizes.is_empty() {
                return Err(self.tokens.fault(
                    open.start,
                    RapidFaultKind::Unexpected { found: "{}".to_string(), wanted: "a size" },
                ));
            }
        }
        Ok(sizes)
    }

    /// Expressions between commas, up to the closing symbol; the opening one is already read.
    pub(crate) fn list(
        &mut self,
        open: Token,
        close: u8,
    ) -> Result<Vec<Expression<'a>>, RapidFault> {
        self.begin(open)?;
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

    fn begin(&mut self, open: Token) -> Result<(), RapidFault> {
        self.depth += 1;
        if self.depth > DEEPEST_NESTING {
            let kind = RapidFaultKind::TooDeep { bound: DEEPEST_NESTING };
            return Err(self.tokens.fault(open.start, kind));
        }
        Ok(())
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

    pub(crate) fn sum(&mut self) -> Result<Expression<'a>, RapidFault> {
        let operator = |tokens: &Tokens<'_>| match tokens.peek().kind {
            TokenKind::Symbol(b'+') => Some(Operator::Plus),
            TokenKind::Symbol(b'-') => Some(Operator::Minus),
            _ => None,
        };
        self.chain(operator, Self::product)
    }

    fn product(&mut self) -> Result<Expression<'a>, RapidFault> {
        let operator = |tokens: &Tokens<'_>| match tokens.peek().kind {
            TokenKind::Symbol(b'*') => Some(Operator::Times),
            TokenKind::Symbol(b'/') => Some(Operator::Over),
            TokenKind::Name if tokens.at_word("DIV") => Some(Operator::Div),
            TokenKind::Name if tokens.at_word("MOD") => Some(Operator::Mod),
            _ => None,
        };
        self.chain(operator, Self::factor)
    }

    fn chain(
        &mut self,
        operator: fn(&Tokens<'_>) -> Option<Operator>,
        operand: fn(&mut Self) -> Result<Expression<'a>, RapidFault>,
    ) -> Result<Expression<'a>, RapidFault> {
        let first = operand(self)?;
        let mut rest = Vec::new();
        while let Some(operator) = operator(self.tokens) {
            self.tokens.take()?;
            rest.push((operator, operand(self)?));
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
                Form::Unread(Box::new(Reason::Unfinished))
            }
            TokenKind::Name => self.name(token)?,
            _ => return Err(self.tokens.lacking("a value")),
        };
        Ok(self.made(token.start, form))
    }

    fn parenthesis(&mut self, open: Token) -> Result<Expression<'a>, RapidFault> {
        self.tokens.take()?;
        let mut inside = self.list(open, b')')?;
        if let (Some(only), true) = (inside.pop(), inside.is_empty()) {
            return Ok(self.made(open.start, only.form));
        }
        let (found, wanted) = ("()".to_string(), "a value");
        Err(self.tokens.fault(open.start, RapidFaultKind::Unexpected { found, wanted }))
    }

    /// TRUE, FALSE, a function or a reference.
    fn name(&mut self, token: Token) -> Result<Form<'a>, RapidFault> {
        let name = self.tokens.text_of(token);
        if name.eq_ignore_ascii_case("TRUE") || name.eq_ignore_ascii_case("FALSE") {
            self.tokens.take()?;
            return Ok(Form::Bool(name.eq_ignore_ascii_case("TRUE")));
        }
        if name.eq_ignore_ascii_case("NOT") {
            WholeReader::new(self.tokens, self.depth).expression()?;
            return Ok(Form::Unread(Box::new(Reason::Negation)));
        }
        if is_reserved(name) || self.tokens.begins_statement(false) {
            return Err(self.tokens.lacking("a value"));
        }
        self.tokens.take()?;
        let next = self.tokens.peek();
        if next.is(b'(') {
            self.tokens.take()?;
            return Ok(Form::Call(Box::new(self.call(token, next)?)));
        }
        if !next.is(b'{') && !next.is(b'.') {
            return Ok(Form::Name(name));
        }
        let indices = if next.is(b'{') {
            self.tokens.take()?;
            self.list(next, b'}')?
        } else {
            Vec::new()
        };
        let components = self.tokens.components()?;
        Ok(Form::Reference(Box::new(Reference { name, indices, components })))
    }

    fn call(&mut self, token: Token, open: Token) -> Result<Call<'a>, RapidFault> {
        self.begin(open)?;
        let name = self.tokens.text_of(token);
        let mut arguments = Arguments::default();
        let mut fit = Fit::of(Entry::function(name));
        let mut is_more = !self.tokens.peek().is(b')');
        while is_more {
            if self.tokens.take_if(b'\\')? {
                let (name, value) = self.optional()?;
                fit.optional(name, value.is_some());
                arguments.optional.push((name, value));
            } else {
                arguments.required.push(self.argument()?);
                fit.required();
            }
            is_more = self.tokens.take_if(b',')? || self.tokens.peek().is(b'\\');
        }
        self.close(open, b')')?;
        note(self.tokens, token, true, fit);
        Ok(Call { name, arguments, components: self.tokens.components()? })
    }

    /// A required argument: its value, perhaps after its name and `:=`. The name is not kept:
    /// RAPID's required arguments are in order.
    pub(crate) fn argument(&mut self) -> Result<Expression<'a>, RapidFault> {
        self.tokens.take_argument_name()?;
        self.expression()
    }

    /// `Name`, `Name:=value` or `Name?parameter`; the backslash is already read.
    pub(crate) fn optional(&mut self) -> Result<(&'a str, Option<Expression<'a>>), RapidFault> {
        let name = self.tokens.take_option_name()?;
        // \Name?parameter passes on the caller's own argument, if there is one; the question mark
        // belongs to the value.
        let mark = self.tokens.peek();
        if self.tokens.take_if(b'?')? {
            self.expression()?;
            let form = Form::Unread(Box::new(Reason::OptionalArgument));
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
