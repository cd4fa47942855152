//! Read expressions as trees.

use crate::prelude::*;
use crate::rapid::data::expression::{
    Arguments, Call, Expression, Form, Name, Operator, Optional, Reference, Relation,
};
use crate::rapid::data::fit::misfit;
use crate::rapid::data::table::Entry;
use crate::rapid::data::unread::Reason;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::skipping::not_closed;
use crate::rapid::text::tokens::{Called, Token, TokenKind, Tokens, behind_blanks};
use crate::rapid::text::words::is_reserved;

/// The deepest nesting of brackets and of blocks that is read.
pub const DEEPEST_NESTING: usize = 64;

/// Initial capacity for the components of an aggregate: most have four or six.
const USUAL_COMPONENTS: usize = 6;

/// Where an expression is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Within {
    /// In a declaration or a move.
    Value,
    /// In another statement, which says what it lacks.
    Statement,
    /// Between the words of a branch or a loop: an instruction may follow.
    Condition,
}

/// What is between two operands of a condition.
#[derive(Clone, Copy)]
enum Connective {
    Relation(Relation),
    Logical,
}

pub(crate) struct ExpressionReader<'t, 'a> {
    tokens: &'t mut Tokens<'a>,
    depth: usize,
    within: Within,
}

impl<'t, 'a> ExpressionReader<'t, 'a> {
    pub(crate) fn new(tokens: &'t mut Tokens<'a>) -> Self {
        Self { tokens, depth: 0, within: Within::Value }
    }

    /// A reader of what is in a statement that is no declaration and no move.
    pub(crate) fn of_statement(tokens: &'t mut Tokens<'a>) -> Self {
        Self { tokens, depth: 0, within: Within::Statement }
    }

    /// A reader of what is between the words of a branch or a loop.
    pub(crate) fn of_condition(tokens: &'t mut Tokens<'a>) -> Self {
        Self { tokens, depth: 0, within: Within::Condition }
    }

    pub(crate) fn expression(&mut self) -> Result<Expression<'a>, RapidFault> {
        if self.within == Within::Value
            && let Some(alone) = self.alone()?
        {
            return Ok(alone);
        }
        let start = self.tokens.peek().start;
        let left = self.sum()?;
        let Some(first) = self.connective()? else {
            return if self.may_end() {
                Ok(left)
            } else {
                Err(self.tokens.lacking("an operator, a comma or the end of the expression"))
            };
        };
        let right = self.sum()?;
        let mut next = self.connective()?;
        let is_negation = matches!(left.form, Form::Not(_));
        if let (Connective::Relation(relation), None, false) = (first, next, is_negation) {
            return Ok(self.made(start, Form::Compared(Box::new([left, right]), relation)));
        }
        let mut operands = Vec::from([left, right]);
        while next.is_some() {
            operands.push(self.sum()?);
            next = self.connective()?;
        }
        let reason = if is_negation { Reason::Negation } else { Reason::Operator };
        Ok(self.made(start, Form::Unread(Box::new(reason), operands)))
    }

    /// Read what is between two operands of a condition, if it is next.
    fn connective(&mut self) -> Result<Option<Connective>, RapidFault> {
        let token = self.tokens.peek();
        let logical = ["AND", "OR", "XOR"];
        let relation = match token.kind {
            TokenKind::Symbol(b'=') => Relation::Equal,
            TokenKind::Symbol(b'<') => Relation::Less,
            TokenKind::Symbol(b'>') => Relation::Greater,
            TokenKind::Name if logical.iter().any(|word| self.tokens.at_word(word)) => {
                self.tokens.take()?;
                return Ok(Some(Connective::Logical));
            }
            _ => return Ok(None),
        };
        self.tokens.take()?;
        let second = self.tokens.peek();
        let of_two = match (relation, second.kind) {
            _ if second.start != token.end => None,
            (Relation::Less, TokenKind::Symbol(b'>')) => Some(Relation::Unequal),
            (Relation::Less, TokenKind::Symbol(b'=')) => Some(Relation::AtMost),
            (Relation::Greater, TokenKind::Symbol(b'=')) => Some(Relation::AtLeast),
            _ => None,
        };
        if of_two.is_some() {
            self.tokens.take()?;
        }
        Ok(Some(Connective::Relation(of_two.unwrap_or(relation))))
    }

    /// A single number or name, most of a module: read without looking for operators.
    fn alone(&mut self) -> Result<Option<Expression<'a>>, RapidFault> {
        let first = self.tokens.peek();
        let content = self.tokens.content();
        let behind = content.get(behind_blanks(content, first.end));
        if !matches!(behind, Some(b',' | b';' | b']' | b')' | b'\\')) {
            return Ok(None);
        }
        let form = match first.kind {
            TokenKind::Number(value) => Form::Number(value),
            TokenKind::Name if !is_reserved(self.tokens.text_of(first)) => {
                Form::Name(self.tokens.text_of(first).into())
            }
            _ => return Ok(None),
        };
        self.tokens.take()?;
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

    /// The value behind `:=`, if there is one.
    pub(crate) fn assigned(&mut self) -> Result<Option<Expression<'a>>, RapidFault> {
        if self.tokens.peek().kind != TokenKind::Assign {
            return Ok(None);
        }
        self.tokens.take()?;
        self.expression().map(Some)
    }

    /// Expressions between commas, up to the closing symbol; the opening one is already read.
    pub(crate) fn list(
        &mut self,
        open: Token,
        close: u8,
    ) -> Result<Vec<Expression<'a>>, RapidFault> {
        self.begin(open)?;
        let mut expressions = Vec::new();
        if self.within != Within::Value || !self.tokens.peek().is(close) {
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

    fn may_end(&self) -> bool {
        match self.tokens.peek().kind {
            _ if self.within != Within::Value => true,
            TokenKind::Symbol(symbol) => b",;])}\\:(".contains(&symbol),
            TokenKind::End | TokenKind::Assign => true,
            // The end of the statement lacks.
            TokenKind::Name => self.tokens.is_first_of_line(),
            _ => false,
        }
    }

    fn sum(&mut self) -> Result<Expression<'a>, RapidFault> {
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
        let mut negations = 0;
        loop {
            match self.tokens.peek().kind {
                TokenKind::Symbol(b'-') => negative = !negative,
                TokenKind::Symbol(b'+') => {}
                TokenKind::Name if self.tokens.at_word("NOT") => negations += 1,
                _ => break,
            }
            self.tokens.take()?;
        }
        let mut operand = self.operand()?;
        operand.start = start;
        let form = match (negations, negative, operand.form) {
            (0, false, form) => form,
            (0, true, Form::Number(value)) => Form::Number(-value),
            (0, true, form) => Form::Negated(Box::new(Expression { form, ..operand })),
            (1, false, form) => Form::Not(Box::new(Expression { form, ..operand })),
            (_, _, form) => {
                let operand = Expression { form, ..operand };
                Form::Unread(Box::new(Reason::Negation), Vec::from([operand]))
            }
        };
        Ok(Expression { form, ..operand })
    }

    fn operand(&mut self) -> Result<Expression<'a>, RapidFault> {
        let token = self.tokens.peek();
        let form = match token.kind {
            TokenKind::Number(value) => Form::Number(value),
            TokenKind::Text => Form::Text(self.tokens.text_of(token).into()),
            TokenKind::Symbol(b'*') => Form::Star,
            TokenKind::Placeholder => Form::Unread(Box::new(Reason::Unfinished), Vec::new()),
            TokenKind::Symbol(b'[') => {
                self.tokens.take()?;
                let parts = self.list(token, b']')?;
                return Ok(self.made(token.start, Form::Aggregate(parts)));
            }
            TokenKind::Symbol(b'(') => return self.parenthesis(token),
            TokenKind::Name => return self.name(token),
            _ => return Err(self.tokens.lacking("a value")),
        };
        self.tokens.take()?;
        Ok(self.made(token.start, form))
    }

    fn parenthesis(&mut self, open: Token) -> Result<Expression<'a>, RapidFault> {
        self.tokens.take()?;
        self.begin(open)?;
        let inside = self.expression()?;
        if self.tokens.peek().is(b',') {
            return Err(self.tokens.unexpected("an operator or )"));
        }
        self.close(open, b')')?;
        Ok(self.made(open.start, inside.form))
    }

    /// TRUE, FALSE, a function or a reference.
    fn name(&mut self, token: Token) -> Result<Expression<'a>, RapidFault> {
        let name = self.tokens.text_of(token);
        let is_true = name.eq_ignore_ascii_case("TRUE");
        if is_true || name.eq_ignore_ascii_case("FALSE") {
            self.tokens.take()?;
            return Ok(self.made(token.start, Form::Bool(is_true)));
        }
        let is_unfinished = self.within != Within::Condition && self.tokens.begins_statement(false);
        if is_reserved(name) || is_unfinished {
            return Err(self.tokens.lacking("a value"));
        }
        self.tokens.take()?;
        let next = self.tokens.peek();
        if next.is(b'(') {
            self.tokens.take()?;
            let call = self.call(token, next)?;
            return Ok(self.made(token.start, Form::Call(Box::new(call))));
        }
        self.behind_name(token)
    }

    /// A reference, of which the name is read.
    pub(crate) fn behind_name(&mut self, token: Token) -> Result<Expression<'a>, RapidFault> {
        let name = self.tokens.text_of(token);
        let next = self.tokens.peek();
        if !next.is(b'{') && !next.is(b'.') {
            return Ok(self.made(token.start, Form::Name(name.into())));
        }
        let indices = if next.is(b'{') {
            self.tokens.take()?;
            self.list(next, b'}')?
        } else {
            Vec::new()
        };
        let components = self.tokens.components()?;
        let reference = Reference { name: name.into(), indices, components };
        Ok(self.made(token.start, Form::Reference(Box::new(reference))))
    }

    fn call(&mut self, token: Token, open: Token) -> Result<Call<'a>, RapidFault> {
        self.begin(open)?;
        let name = self.tokens.text_of(token);
        let arguments = self.arguments(None)?;
        self.close(open, b')')?;
        note(self.tokens, token.start, token, true, &arguments);
        Ok(Call { name: name.into(), arguments, components: self.tokens.components()? })
    }

    /// The arguments of a function, an instruction or a call, up to what ends them; perhaps the first
    /// is already read.
    pub(crate) fn arguments(
        &mut self,
        first: Option<Expression<'a>>,
    ) -> Result<Arguments<'a>, RapidFault> {
        let mut found = Arguments::default();
        found.required.extend(first);
        for count in found.required.len().. {
            let token = self.tokens.peek();
            let is_outside = self.depth == 0;
            let is_end =
                token.is(b')') || token.is(b';') || self.tokens.begins_statement(is_outside);
            if count == 0 && is_end || count > 0 && !token.is(b',') && !token.is(b'\\') {
                break;
            }
            if count > 0 {
                self.tokens.take_if(b',')?;
            }
            if self.tokens.take_if(b'\\')? {
                let (name, value) = self.optional()?;
                found.optional.push(Optional { name, value, after: found.required.len() });
            } else {
                found.required.push(self.argument()?);
            }
        }
        Ok(found)
    }

    /// A required argument: its value, perhaps after its name and `:=`. The name is not kept:
    /// RAPID's required arguments are in order.
    pub(crate) fn argument(&mut self) -> Result<Expression<'a>, RapidFault> {
        self.tokens.take_argument_name()?;
        self.expression()
    }

    /// `Name`, `Name:=value` or `Name?parameter`; the backslash is already read.
    fn optional(&mut self) -> Result<(Name<'a>, Option<Expression<'a>>), RapidFault> {
        let name = self.tokens.take_option_name()?.into();
        // \Name?parameter passes on the caller's own argument, if there is one; the question mark
        // belongs to the value.
        let mark = self.tokens.peek();
        if self.tokens.take_if(b'?')? {
            self.expression()?;
            let form = Form::Unread(Box::new(Reason::OptionalArgument), Vec::new());
            return Ok((name, Some(self.made(mark.start, form))));
        }
        Ok((name, self.assigned()?))
    }

    fn made(&self, start: usize, form: Form<'a>) -> Expression<'a> {
        Expression { start, end: self.tokens.last_end, form }
    }
}

/// Note a call that begins at a byte, of a routine that RAPID does not have, or does not have with
/// these arguments; `name` may be the text of a call by name.
pub(crate) fn note(
    tokens: &mut Tokens<'_>,
    start: usize,
    name: Token,
    is_function: bool,
    arguments: &Arguments<'_>,
) {
    let quote = usize::from(name.kind == TokenKind::Text);
    let name = name.start + quote..name.end - quote;
    let text = &tokens.text[name.clone()];
    let entry = if is_function { Entry::function(text) } else { Entry::instruction(text) };
    let required = arguments.required.len();
    let given = arguments.optional.iter().map(|it| (&*it.name, it.value.is_some()));
    let of_entry = |it: &Entry| misfit((it.name, it.arguments), required, given.clone());
    let wrong = entry.and_then(of_entry);
    if entry.is_none() || wrong.is_some() {
        let optional = given.map(|(name, has_value)| (String::from(name), has_value)).collect();
        tokens.calls.push(Called { start, name, is_function, required, optional, wrong });
    }
}
