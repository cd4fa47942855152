//! Instructions that are not read, by their effect on moves.

use self::Effect::{
    Displaces, EndsDisplacement, Jumps, Leaves, Moves, Offsets, Sets, Stops, Waits, Writes,
};
use super::moving::MoveInstruction;
use super::settings::MotionSettings;

/// The effect of an instruction on the moves of a program.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Effect {
    /// It moves the robot and is not read. So does every instruction whose name continues with
    /// another word, or continues the name of a move that only some controllers have.
    Moves,
    /// It writes to a required argument, by its number.
    Writes(usize),
    /// It displaces the targets of the moves after it.
    Displaces,
    /// It ends the displacement.
    EndsDisplacement,
    /// It adds something to external axes, or ends that.
    Offsets,
    /// It sets how the moves after it are made.
    Sets,
    /// It leaves the routine.
    Leaves,
    /// It ends the execution, which may go on behind it.
    Stops,
    /// It waits for something, and with it the program.
    Waits,
    /// It goes on at a label.
    Jumps,
}

#[rustfmt::skip]
const INSTRUCTIONS: [(Effect, &[&str]); 14] = [
    (Moves, &[
        "ArcRepL", "ArcAdaptRepL", "EGMMove", "EGMRun", "FCPress", "MovePnP", "PathRecMoveBwd",
        "PathRecMoveFwd", "StepBwdPath",
    ]),
    (Writes(1), &[
        "Incr", "Decr", "Add", "Clear", "TPReadNum", "TPReadDnum", "TPReadFK", "GetSysData",
    ]),
    (Writes(2), &["SearchL", "SearchC", "SearchExtJ", "GetDataVal"]),
    (Writes(3), &["MToolRotCalib", "UnpackRawBytes"]),
    (Writes(4), &["SToolRotCalib"]),
    (Writes(5), &["MToolTCPCalib", "SToolTCPCalib"]),
    (Displaces, &["PDispOn", "PDispSet"]),
    (EndsDisplacement, &["PDispOff"]),
    (Offsets, &["EOffsOn", "EOffsSet", "EOffsOff"]),
    (Sets, &MotionSettings::INSTRUCTIONS),
    (Leaves, &["RETURN", "EXIT", "ExitCycle", "RAISE", "RETRY", "TRYNEXT"]),
    (Stops, &["Stop", "Break", "SystemStopAction"]),
    (Waits, &[
        "WaitTime", "WaitUntil", "WaitDI", "WaitDO", "WaitGI", "WaitGO", "WaitAI", "WaitAO",
        "WaitRob", "WaitSyncTask", "WaitTestAndSet", "WaitWObj", "SocketAccept", "SocketConnect",
        "SocketReceive", "TPReadNum", "TPReadFK", "UIMsgBox",
    ]),
    (Jumps, &["GOTO"]),
];

impl Effect {
    /// Whether an instruction has the effect.
    pub(crate) fn is_of(self, instruction: &str) -> bool {
        let named = |name: &&str| match self {
            Moves => begins_with(instruction, name),
            _ => name.eq_ignore_ascii_case(instruction),
        };
        INSTRUCTIONS.iter().any(|(effect, names)| *effect == self && names.iter().any(named))
            || self == Moves && MoveInstruction::optional_names().any(|name| named(&name))
    }
}

/// The number of the argument that an instruction writes to.
pub(crate) fn written_argument(instruction: &str) -> Option<usize> {
    INSTRUCTIONS.iter().find_map(|(effect, names)| match effect {
        Writes(number) if names.iter().any(|it| it.eq_ignore_ascii_case(instruction)) => {
            Some(*number)
        }
        _ => None,
    })
}

/// Whether a name is one that begins with whole words: `ArcLStart` with `ArcL`, but not
/// `DisplayText` with `DispL`.
fn begins_with(name: &str, words: &str) -> bool {
    name.get(..words.len()).is_some_and(|it| it.eq_ignore_ascii_case(words))
        && !name[words.len()..].starts_with(|next: char| next.is_lowercase() || next == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn instructions_that_move_are_recognized_by_whole_words() {
        for name in ["MoveLDO", "movejdo", "TriggLIOs", "ArcLStart", "ArcL", "EGMMoveL", "ArcL1"] {
            assert!(Moves.is_of(name), "{name}");
        }
        for name in
            ["DisplayText", "PaintColor", "ArcCheck", "Set", "MoveHome", "SearchLine", "searchl_1"]
        {
            assert!(!Moves.is_of(name), "{name}");
        }
    }
}
