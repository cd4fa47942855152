//! Expressions and arguments that are not evaluated: read, and kept nowhere.

use crate::rapid::data::fit::Fit;
use crate::rapid::data::table::Entry;
use crate::rapid::data::types::Type;
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::skipping::not_closed;
use crate::rapid::text::tokens::{Called, Token, TokenKind, Tokens};
use crate::rapid::text::words::is_reserved;

/// The deepest nesting of brackets and of blocks that is read.
pub const DEEPEST_NESTING: usize = 64;

/// Words between operands, besides the one before an operand.
const OPERATORS: [&str; 5] = ["AND", "OR", "XOR", "DIV", "MOD"];

/// A reader that allocates nothing.
pub(crate) struct WholeReader<'t, 'a> {
    tokens: &'t mut Tokens<'a>,
    depth: usize,
    /// Whether an instruction may follow an expression, as behind the condition of an IF.
    is_condition: bool,
}

impl<'t, 'a> WholeReader<'t, 'a> {
    pub(crate) fn new(tokens: &'t mut Tokens<'a>, depth: usize) -> Self {
        Self { tokens, depth, is_condition: false }
    }

    /// A reader of what is between the words of a branch or a loop.
    pub(crate) fn of_condition(tokens: &'t mut Tokens<'a>) -> Self {
        Self { tokens, depth: 0, is_condition: true }
    }

    /// An expression: operands with operators between them.
    pub(crate) fn expression(&mut self) -> Result<(), RapidFault> {
        self.operand()?;
        self.rest()
    }

    /// The operators and operands behind the first operand of an expression.
    pub(crate) fn rest(&mut self) -> Result<(), RapidFault> {
        while self.operator()? {
            self.operand()?;
        }
        Ok(())
    }

    /// An expression of a type: an aggregate in it with another number of components is kept with
    /// the first byte of it, its type and that number.
    pub(crate) fn value_of(
        &mut self,
        of: &'static Type,
        wrong: &mut Option<(usize, &'static Type, usize)>,
    ) -> Result<(), RapidFault> {
        let (components, mut count) = (of.components(), 0);
        if components.is_empty() || !self.tokens.peek().is(b'[') {
            return self.expression();
        }
        let open = self.begin()?;
        loop {
            match components.get(count) {
                Some((_, part)) => self.value_of(part, wrong)?,
                None => self.expression()?,
            }
            count += 1;
            if !self.tokens.take_if(b',')? {
                break;
            }
        }
        self.end(open, b']')?;
        if count != components.len() {
            wrong.get_or_insert((open.start, of, count));
        }
        self.rest()
    }

    fn operator(&mut self) -> Result<bool, RapidFault> {
        let token = self.tokens.peek();
        match token.kind {
            TokenKind::Symbol(b'+' | b'-' | b'*' | b'/' | b'=') => {}
            TokenKind::Symbol(symbol @ (b'<' | b'>')) => {
                self.tokens.take()?;
                let next = self.tokens.peek();
                let is_one =
                    next.start == token.end && (next.is(b'=') || symbol == b'<' && next.is(b'>'));
                if !is_one {
                    return Ok(true);
                }
            }
            TokenKind::Name if OPERATORS.iter().any(|word| self.tokens.at_word(word)) => {}
            _ => return Ok(false),
        }
        self.tokens.take()?;
        Ok(true)
    }

    fn operand(&mut self) -> Result<(), RapidFault> {
        while matches!(self.tokens.peek().kind, TokenKind::Symbol(b'-' | b'+'))
            || self.tokens.at_word("NOT")
        {
            self.tokens.take()?;
        }
        let token = self.tokens.peek();
        match token.kind {
            TokenKind::Number(_)
            | TokenKind::Text
            | TokenKind::Placeholder
            | TokenKind::Symbol(b'*') => self.tokens.take().map(|_| ()),
            TokenKind::Symbol(b'[') => self.list(b']'),
            TokenKind::Symbol(b'(') => self.list(b')'),
            TokenKind::Name => self.name(token),
            _ => Err(self.tokens.lacking("a value")),
        }
    }

    fn name(&mut self, token: Token) -> Result<(), RapidFault> {
        let name = self.tokens.text_of(token);
        let is_truth = name.eq_ignore_ascii_case("TRUE") || name.eq_ignore_ascii_case("FALSE");
        let is_unfinished = !self.is_condition && self.tokens.begins_statement(false);
        if !is_truth && is_reserved(name) || is_unfinished {
            return Err(self.tokens.lacking("a value"));
        }
        self.tokens.take()?;
        match self.tokens.peek().kind {
            _ if is_truth => Ok(()),
            TokenKind::Symbol(b'(') => self.call(token),
            TokenKind::Symbol(b'{' | b'.') => self.behind_name(),
            _ => Ok(()),
        }
    }

    /// The indices and the components behind a name.
    pub(crate) fn behind_name(&mut self) -> Result<(), RapidFault> {
        if self.tokens.peek().is(b'{') {
            self.list(b'}')?;
        }
        while self.tokens.component()?.is_some() {}
        Ok(())
    }

    /// The rest of a declaration behind its name: perhaps sizes, perhaps a value.
    pub(crate) fn sizes_and_value(&mut self) -> Result<(), RapidFault> {
        if self.tokens.peek().is(b'{') {
            self.list(b'}')?;
        }
        if self.tokens.peek().kind == TokenKind::Assign {
            self.tokens.take()?;
            self.expression()?;
        }
        Ok(())
    }

    /// A list in brackets, of which the next token is the opening one.
    pub(crate) fn list(&mut self, close: u8) -> Result<(), RapidFault> {
        let open = self.begin()?;
        self.expression()?;
        if close == b')' && self.tokens.peek().is(b',') {
            return Err(self.tokens.unexpected("an operator or )"));
        }
        while self.tokens.take_if(b',')? {
            self.expression()?;
        }
        self.end(open, close)
    }

    /// The arguments of a function, whose name was read.
    fn call(&mut self, name: Token) -> Result<(), RapidFault> {
        let open = self.begin()?;
        let mut fit = Fit::of(Entry::function(self.tokens.text_of(name)));
        self.arguments(&mut fit, None)?;
        self.end(open, b')')?;
        note(self.tokens, name, true, fit);
        self.behind_name()
    }

    /// Arguments up to what ends them; returns the name that the required one with a number begins
    /// with.
    pub(crate) fn arguments(
        &mut self,
        fit: &mut Fit<'_>,
        wanted: Option<usize>,
    ) -> Result<Option<&'a str>, RapidFault> {
        let mut found = None;
        for count in 0.. {
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
                self.optional(fit)?;
                continue;
            }
            self.tokens.take_argument_name()?;
            let first = self.tokens.peek();
            self.expression()?;
            if Some(fit.required()) == wanted && first.kind == TokenKind::Name {
                found = Some(self.tokens.text_of(first));
            }
        }
        Ok(found)
    }

    /// `Name`, `Name:=value` or `Name?parameter`; the backslash is already read.
    fn optional(&mut self, fit: &mut Fit<'_>) -> Result<(), RapidFault> {
        let name = self.tokens.take_option_name()?;
        let next = self.tokens.peek();
        let has_value = next.kind == TokenKind::Assign || next.is(b'?');
        fit.optional(name, has_value);
        if has_value {
            self.tokens.take()?;
            self.expression()?;
        }
        Ok(())
    }

    fn begin(&mut self) -> Result<Token, RapidFault> {
        let open = self.tokens.take()?;
        self.depth += 1;
        if self.depth > DEEPEST_NESTING {
            let kind = RapidFaultKind::TooDeep { bound: DEEPEST_NESTING };
            return Err(self.tokens.fault(open.start, kind));
        }
        Ok(open)
    }

    fn end(&mut self, open: Token, close: u8) -> Result<(), RapidFault> {
        self.depth -= 1;
        if self.tokens.take_if(close)? { Ok(()) } else { Err(not_closed(self.tokens, open, close)) }
    }
}

/// Note a call that RAPID does not have as it is written; `name` may be the text of a call by name.
pub(crate) fn note(tokens: &mut Tokens<'_>, name: Token, is_function: bool, fit: Fit<'_>) {
    let quote = usize::from(name.kind == TokenKind::Text);
    let name = name.start + quote..name.end - quote;
    if fit.arguments.is_none() {
        tokens.calls.push(Called { name, is_function, wrong: None });
    } else if let Some(wrong) = fit.finished() {
        tokens.calls.push(Called { name, is_function, wrong: Some(wrong) });
    }
}
