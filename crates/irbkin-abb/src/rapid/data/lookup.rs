//! RAPID's instructions looked up by their names.

use super::fit::parts;
use super::instructions::Effect;
use super::moving::MoveInstruction;
use super::table::Entry;

impl MoveInstruction {
    /// The instruction of a name, in any case.
    pub(crate) fn named(name: &str) -> Option<&'static Self> {
        Entry::instruction(name)?.movement.as_ref()
    }
}

impl Effect {
    pub(crate) fn of(instruction: &str) -> Self {
        match Entry::instruction(instruction) {
            Some(entry) if entry.moves_unread() => Self::Moves,
            Some(entry) => entry.effect,
            None if continues_a_move(instruction) => Self::Moves,
            None => Self::Nothing,
        }
    }
}

impl Entry {
    /// Whether it moves the robot and is not on every controller, or not read.
    fn moves_unread(&self) -> bool {
        self.effect == Effect::Moves || self.movement.as_ref().is_some_and(|it| !it.is_basic())
    }
}

/// The number of the argument that an instruction writes to.
pub(crate) fn written_argument(instruction: &str) -> Option<usize> {
    let arguments = Entry::instruction(instruction)?.arguments;
    let mut required = parts(arguments).filter(|(sign, _)| *sign == b',');
    Some(required.position(|(_, part)| part.starts_with("INOUT "))? + 1)
}

/// Whether a name begins with the name of such a move, in whole words: `ArcLStart` with `ArcL`, but
/// not `DisplayText` with `DispL`.
fn continues_a_move(name: &str) -> bool {
    let ends = name.char_indices().skip(1).filter(|(_, next)| !next.is_lowercase() && *next != '_');
    let mut entries = ends.filter_map(|(end, _)| Entry::instruction(&name[..end]));
    entries.any(Entry::moves_unread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_that_move_are_recognized_by_whole_words() {
        for name in ["MoveLDO", "movejdo", "TriggLIOs", "ArcLStart", "ArcL", "EGMMoveL", "ArcL1"] {
            assert!(Effect::of(name) == Effect::Moves, "{name}");
        }
        for name in
            ["DisplayText", "PaintColor", "ArcCheck", "Set", "MoveHome", "SearchLine", "searchl_1"]
        {
            assert!(Effect::of(name) != Effect::Moves, "{name}");
        }
    }

    #[test]
    fn arguments_that_are_written_to_are_counted_without_options() {
        let places =
            [("Incr", 1), ("SearchL", 2), ("getdataval", 2), ("MToolRotCalib", 3), ("MoveL", 0)];
        for (name, place) in places {
            assert_eq!(written_argument(name).unwrap_or(0), place, "{name}");
        }
        let five = ["MToolTCPCalib", "SToolTCPCalib"].map(written_argument);
        assert_eq!(five, [Some(5), Some(5)]);
    }
}
