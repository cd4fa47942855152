//! Instructions that are not read: those that move the robot, displace its targets, or write to
//! their arguments.

use alloc::string::ToString;

use super::blocks::begins_another;
use super::reader::{Assignment, StatementReader};
use crate::error::RapidFault;
use crate::rapid::data::settings::{MotionSettings, Setting};
use crate::rapid::data::skipped::NotRead;
use crate::rapid::text::skipping::skip_balanced;
use crate::rapid::text::tokens::{Token, TokenKind};

/// Beginnings of the names of instructions that move the robot.
const MOVING: [&str; 32] = [
    "MoveLDO",
    "MoveJDO",
    "MoveCDO",
    "MoveLAO",
    "MoveJAO",
    "MoveCAO",
    "MoveLGO",
    "MoveJGO",
    "MoveCGO",
    "MoveLSync",
    "MoveJSync",
    "MoveCSync",
    "MoveExtJ",
    "TriggL",
    "TriggJ",
    "TriggC",
    "TriggAbsJ",
    "SearchL",
    "SearchC",
    "SearchExtJ",
    "ArcL",
    "ArcC",
    "ArcRepL",
    "SpotL",
    "SpotJ",
    "PaintL",
    "PaintC",
    "DispL",
    "DispC",
    "EGMMove",
    "EGMRun",
    "FCPress",
];

/// Instructions that write to a required argument, with its number.
const WRITING: [(&str, usize); 17] = [
    ("Incr", 1),
    ("Decr", 1),
    ("Add", 1),
    ("Clear", 1),
    ("TPReadNum", 1),
    ("TPReadDnum", 1),
    ("TPReadFK", 1),
    ("GetSysData", 1),
    ("SearchL", 2),
    ("SearchC", 2),
    ("SearchExtJ", 2),
    ("GetDataVal", 2),
    ("MToolRotCalib", 3),
    ("UnpackRawBytes", 3),
    ("SToolRotCalib", 4),
    ("MToolTCPCalib", 5),
    ("SToolTCPCalib", 5),
];

/// Whether an instruction moves the robot: the beginning of its name is followed by another word,
/// so that `DisplayText` is not `DispL`.
fn moves_the_robot(name: &str) -> bool {
    MOVING.iter().any(|beginning| {
        let is_it =
            name.get(..beginning.len()).is_some_and(|it| it.eq_ignore_ascii_case(beginning));
        is_it
            && !name[beginning.len()..].starts_with(|next: char| next.is_lowercase() || next == '_')
    })
}

impl<'a> StatementReader<'a> {
    /// An instruction that is not read, a call, an assignment or a label.
    pub(crate) fn other(&mut self, first: Token) -> Result<(), RapidFault> {
        self.tokens.take()?;
        self.rest_of_other(first)
    }

    pub(crate) fn rest_of_other(&mut self, first: Token) -> Result<(), RapidFault> {
        let name = self.tokens.text_of(first);
        let next = self.tokens.peek();
        let is_assignment = next.kind == TokenKind::Assign || next.is(b'{') || next.is(b'.');
        if next.is(b':') {
            self.tokens.take()?;
            self.skip(first, NotRead::Label { name: name.to_string() });
            return Ok(());
        }
        if first.kind == TokenKind::Placeholder && !is_assignment {
            // With or without a semicolon.
            self.tokens.take_if(b';')?;
            self.skip_unfinished(first);
            return Ok(());
        }
        // Two of them begin a header, which is valid at the beginning only.
        if first.is(b'%') && next.is(b'%') {
            return Err(self.tokens.unexpected("the name of a procedure"));
        }
        if !is_assignment && self.setting(first)? {
            return Ok(());
        }
        let assigned = if is_assignment { Some(name) } else { self.written_argument(name)? };
        skip_balanced(&mut self.tokens, |tokens, _| begins_another(tokens))?;
        self.tokens.demand(b';', "a semicolon")?;
        let what = {
            let name = name.to_string();
            match is_assignment {
                true => NotRead::Assignment { name },
                false if moves_the_robot(&name) => NotRead::Motion { name },
                false => NotRead::Instruction { name },
            }
        };
        let line = self.skip(first, what);
        if !is_assignment {
            self.displaced_by.see(name, line);
        }
        if let Some(name) = assigned {
            self.written.assignments.push(Assignment { at: self.at(), name, line });
        }
        Ok(())
    }

    /// Read an instruction that sets how moves are made, whose name is already read. False, with
    /// nothing read, for another instruction or one that is not as RAPID has it.
    fn setting(&mut self, first: Token) -> Result<bool, RapidFault> {
        let name = self.tokens.text_of(first);
        if !MotionSettings::INSTRUCTIONS.iter().any(|own| own.eq_ignore_ascii_case(name)) {
            return Ok(false);
        }
        let mark = self.tokens.mark();
        let mut switch = None;
        if self.tokens.take_if(b'\\')? && self.tokens.peek().kind == TokenKind::Name {
            let token = self.tokens.take()?;
            switch = Some(self.tokens.text_of(token));
        }
        if !self.tokens.peek().is(b';') || !self.settings.set(name, switch) {
            self.tokens.rewind(mark);
            return Ok(false);
        }
        self.tokens.take()?;
        let (line, column) = self.tokens.line_and_column(first.start);
        let text = self.written.text[first.start..self.tokens.last_end].to_string();
        let routine = self.current_routine().map(|routine| routine.name.clone());
        self.written.settings.push(Setting { line, column, routine, text });
        Ok(true)
    }

    /// The name in the argument that an instruction writes to; reads up to it.
    fn written_argument(&mut self, instruction: &str) -> Result<Option<&'a str>, RapidFault> {
        let Some((_, place)) =
            WRITING.iter().find(|(name, _)| name.eq_ignore_ascii_case(instruction))
        else {
            return Ok(None);
        };
        let mut required = 0;
        loop {
            if !self.tokens.peek().is(b'\\') && self.tokens.peek().kind != TokenKind::End {
                required += 1;
            }
            if required == *place {
                if self.tokens.at_assigned_name() {
                    self.tokens.take()?;
                    self.tokens.take()?;
                }
                let token = self.tokens.peek();
                return Ok((token.kind == TokenKind::Name).then(|| self.tokens.text_of(token)));
            }
            skip_balanced(&mut self.tokens, |tokens, _| {
                tokens.peek().is(b',') || begins_another(tokens)
            })?;
            if !self.tokens.take_if(b',')? {
                return Ok(None);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_that_move_are_recognized_by_whole_words() {
        for name in [
            "MoveLDO",
            "movejdo",
            "TriggLIOs",
            "ArcLStart",
            "ArcL",
            "EGMMoveL",
            "EGMMoveC",
            "SpotL",
            "DispL",
            "ArcL1",
        ] {
            assert!(moves_the_robot(name), "{name}");
        }
        for name in
            ["DisplayText", "PaintColor", "ArcCheck", "Set", "MoveHome", "SearchLine", "searchl_1"]
        {
            assert!(!moves_the_robot(name), "{name}");
        }
    }
}
