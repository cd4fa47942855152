//! Instructions: moves, and those that are not read but move the robot, displace its targets, or
//! write to their arguments.

use super::blocks::demand_word;
use super::faults::end_statement;
use super::moves::{WrittenMove, read_move};
use super::reader::{Assignment, Named, StatementReader};
use crate::prelude::*;
use crate::rapid::data::expression::{Arguments, Expression, Form, Name};
use crate::rapid::data::instructions::{Effect, Shift};
use crate::rapid::data::lookup::written_argument;
use crate::rapid::data::module::Content;
use crate::rapid::data::moves::MoveKind;
use crate::rapid::data::moving::MoveInstruction;
use crate::rapid::data::statement::{self, Instruction, StatementKind};
use crate::rapid::data::types::Type;
use crate::rapid::expression::content::Placed;
use crate::rapid::expression::reader::{ExpressionReader, note};
use crate::rapid::text::fault::{RapidFault, RapidFaultKind};
use crate::rapid::text::tokens::{Token, TokenKind};

impl<'a> StatementReader<'a> {
    /// A call by name: of what a constant text names, or of what is calculated.
    pub(super) fn late_bound(&mut self, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        let name = self.tokens.peek();
        // Two of them begin a header, which is valid at the beginning only.
        if name.is(b'%') {
            return Err(self.tokens.unexpected("the name of a procedure"));
        }
        ExpressionReader::of_statement(&mut self.tokens).expression()?;
        let is_constant = name.kind == TokenKind::Text && self.tokens.last_end == name.end;
        self.tokens.demand(b'%', "%")?;
        if is_constant { self.instruction(first, name) } else { self.call(first, None) }
    }

    /// An instruction, behind its name, which may be a text.
    pub(super) fn instruction(&mut self, first: Token, name: Token) -> Result<(), RapidFault> {
        let word = self.tokens.text_of(name).trim_matches('"');
        match MoveInstruction::named(word) {
            Some(instruction) => self.move_instruction(instruction, first, name),
            None if first == name => self.rest_of_other(first),
            None => self.call(first, Some(name)),
        }
    }

    fn move_instruction(
        &mut self,
        instruction: &'static MoveInstruction,
        token: Token,
        name: Token,
    ) -> Result<(), RapidFault> {
        let next = self.tokens.peek();
        // A label or a datum may have the name of an instruction that only some controllers have.
        let is_other = next.kind == TokenKind::Assign || b":.{".iter().any(|it| next.is(*it));
        if is_other && !instruction.is_basic() {
            return self.rest_of_other(token);
        }
        let (tokens, faults) = (&mut self.tokens, &mut self.written.faults);
        let Some(step) = read_move(tokens, faults, instruction, (token.start, name))? else {
            self.add_unfinished(token);
            return Ok(());
        };
        let at = self.at();
        // External axes do not concern the arm.
        let is_pose = !matches!(instruction.way, MoveKind::MoveAbsJ | MoveKind::MoveExtJ);
        let displaced = self.displaced_by.filter(|_| is_pose);
        let place = (!instruction.is_basic()).then(|| written_argument(instruction.name)).flatten();
        let written = place.and_then(|place| step.arguments.required.get(place - 1));
        if let Some((name, ..)) = written.and_then(Expression::reference) {
            self.assign(name.clone(), Vec::new(), step.line);
        }
        let settings = self.settings;
        let kind = StatementKind::Move(self.written.moves.len());
        self.add_at(step.start, kind, String::new());
        self.written.moves.push(WrittenMove { at, displaced, settings, ..step });
        Ok(())
    }

    /// An instruction that is not read, a call, an assignment or a label, behind its name.
    pub(crate) fn rest_of_other(&mut self, first: Token) -> Result<(), RapidFault> {
        let name = self.tokens.text_of(first);
        let next = self.tokens.peek();
        if next.is(b':') {
            self.tokens.take()?;
            self.add(first, StatementKind::Label { name: name.to_string() });
            return Ok(());
        }
        if next.kind == TokenKind::Assign || next.is(b'{') || next.is(b'.') {
            return self.assignment(first);
        }
        if first.kind == TokenKind::Placeholder {
            // With or without a semicolon.
            self.tokens.take_if(b';')?;
            self.add_unfinished(first);
            return Ok(());
        }
        self.call(first, Some(first))
    }

    fn assignment(&mut self, first: Token) -> Result<(), RapidFault> {
        let name = self.tokens.text_of(first);
        let is_element = self.tokens.peek().is(b'{');
        let mut reader = ExpressionReader::of_statement(&mut self.tokens);
        let target = reader.behind_name(first)?;
        let Some(value) = reader.assigned()? else { return Err(self.tokens.lacking(":=")) };
        let components = target.reference().map_or(Vec::new(), |(.., it)| it.to_vec());
        let of = self.type_of_assigned(name, is_element, &components);
        if let Some((byte, of, found)) = of.and_then(|of| wrong_part(&value, of)) {
            let (thing, part) = (name.to_string(), of.name.to_string());
            let (wanted, missing) = (of.components().len(), "");
            let kind = RapidFaultKind::ComponentCount { thing, part, found, wanted, missing };
            self.complain(self.tokens.fault(byte, kind))?;
        }
        self.end("an operator or a semicolon")?;
        let assignment = statement::Assignment {
            name: name.to_string(),
            to: target.referred().unwrap_or_default(),
            target: target.owned(first.start),
            value: value.owned(first.start),
        };
        let line = self.add(first, StatementKind::Assignment(Box::new(assignment)));
        self.assign(name.into(), components, line);
        Ok(())
    }

    /// The type of what is assigned, if the datum is declared above.
    fn type_of_assigned(
        &self,
        name: &str,
        is_element: bool,
        components: &[Name<'_>],
    ) -> Option<&'static Type> {
        let named = self.written.scopes.find(self.routine, &name.to_lowercase());
        let Some(Named::Datum(index)) = named else { return None };
        let is_single = |it: &Placed| match &it.content {
            Content::Single(_) => true,
            Content::Uninitialized { sizes } => sizes.is_empty(),
            Content::Array { .. } => is_element,
        };
        self.written.contents.get(*index)?.as_ref().filter(|it| is_single(it))?;
        let of = self.written.declared.get(*index)?.data_type.described();
        of.part(components).map(|(part, _)| part)
    }

    /// An instruction that begins with a reserved word, in capitals.
    pub(super) fn reserved(&mut self, word: &str, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        let is_alone = self.tokens.peek().is(b';') || self.tokens.begins_statement(true);
        let has_value = match word {
            "RETURN" | "RAISE" => !is_alone,
            _ => matches!(word, "GOTO" | "CONNECT"),
        };
        let mut arguments = Arguments::default();
        if has_value {
            let value = ExpressionReader::of_statement(&mut self.tokens).expression()?;
            arguments.required.push(value);
        }
        if word == "CONNECT" {
            demand_word(&mut self.tokens, "WITH")?;
            let trap = ExpressionReader::of_statement(&mut self.tokens).expression()?;
            arguments.required.push(trap);
        }
        self.end("a semicolon")?;
        let first_word = self.tokens.text_of(first);
        let arguments = arguments.owned(first.start);
        let instruction = Instruction::new(first_word, Some(first_word), arguments);
        self.add(first, StatementKind::Instruction(Box::new(instruction)));
        Ok(())
    }

    /// An instruction or a call, behind its name; without one the name is calculated.
    pub(super) fn call(&mut self, first: Token, named: Option<Token>) -> Result<(), RapidFault> {
        let name = named.map(|it| self.tokens.text_of(it).trim_matches('"'));
        let arguments = ExpressionReader::of_statement(&mut self.tokens).arguments(None)?;
        self.end("a comma or a semicolon")?;
        if let Some(name) = named {
            note(&mut self.tokens, first.start, name, false, &arguments);
        }
        let place = name.and_then(written_argument);
        let written = place.and_then(|place| arguments.required.get(place - 1));
        let assigned = written.and_then(Expression::reference).map(|(name, ..)| name.clone());
        let first_word = self.tokens.text_of(first);
        let instruction = Instruction::new(first_word, name, arguments.owned(first.start));
        let effect = instruction.effect;
        let is_read = effect == Effect::Sets && instruction.set(&mut self.settings);
        let of = if is_read { StatementKind::Setting } else { StatementKind::Instruction };
        let line = self.add(first, of(Box::new(instruction)));
        match effect {
            Effect::Displaces(Shift::Off) => self.displaced_by = None,
            Effect::Displaces(_) => self.displaced_by = Some(line),
            _ => {}
        }
        if let Some(name) = assigned {
            self.assign(name, Vec::new(), line);
        }
        Ok(())
    }

    fn assign(&mut self, name: Name<'a>, components: Vec<Name<'a>>, line: usize) {
        let at = self.at();
        self.written.assignments.push(Assignment { at, name, components, line });
    }

    fn end(&mut self, wanted: &'static str) -> Result<(), RapidFault> {
        end_statement(&mut self.tokens, &mut self.written.faults, wanted)
    }
}

/// The first aggregate in a value of a type that has another number of components: its first byte,
/// its type and that number.
fn wrong_part(value: &Expression<'_>, of: &'static Type) -> Option<(usize, &'static Type, usize)> {
    let Form::Aggregate(parts) = &value.form else { return None };
    let components = of.components();
    if components.is_empty() {
        return None;
    }
    let mut inside = parts.iter().zip(components);
    let inside = inside.find_map(|(part, (_, of))| wrong_part(part, of));
    let is_wrong = parts.len() != components.len();
    inside.or_else(|| is_wrong.then_some((value.start, of, parts.len())))
}
