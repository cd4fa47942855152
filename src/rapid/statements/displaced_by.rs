//! Instructions that displace the moves which follow them.

use crate::rapid::data::moves::MoveKind;

/// Line of the instruction that displaces the following moves to poses in a routine. `MoveAbsJ` is
/// not displaced, and external axes do not concern the arm.
#[derive(Clone, Copy, Default)]
pub(crate) struct DisplacedBy {
    line: Option<usize>,
}

impl DisplacedBy {
    pub(crate) fn line(self, kind: MoveKind) -> Option<usize> {
        self.line.filter(|_| kind != MoveKind::MoveAbsJ)
    }

    /// Record an instruction on a line.
    pub(crate) fn see(&mut self, name: &str, line: usize) {
        if ["PDispOn", "PDispSet"].iter().any(|word| word.eq_ignore_ascii_case(name)) {
            self.line = Some(line);
        } else if name.eq_ignore_ascii_case("PDispOff") {
            self.line = None;
        }
    }
}
