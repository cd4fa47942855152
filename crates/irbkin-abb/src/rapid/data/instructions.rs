//! The effects of instructions on moves.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effect {
    Nothing,
    /// It moves the robot and is not read. So does every instruction whose name continues with
    /// another word, or continues the name of a move that only some controllers have.
    Moves,
    /// It displaces the targets of the moves after it.
    Displaces(Shift),
    /// It adds something to external axes.
    Offsets(Shift),
    /// It sets how the moves after it are made.
    Sets,
    Returns,
    /// It leaves the routine, to wherever.
    Leaves,
    /// It ends the execution, which may go on behind it.
    Stops,
    /// It waits for something, and with it the program.
    Waits,
    /// It goes on at a label.
    Jumps,
}

/// What shifts the moves after an instruction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shift {
    /// What lies between two positions.
    Between,
    /// The argument.
    Given,
    Off,
}
