//! Records of a check: what is wrong with moves, and what was checked.

use pyo3::basic::CompareOp;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::outputs::column as column_of;
use crate::record;
use crate::record::{record, record_methods};
use crate::records::{Array, Configuration};
use irbkin_abb::rapid;

record! {
    "irbkin.rapid";
    /// Something wrong with a move, in a table, a motion or a check. `str` has the line, too.
    Finding {
        /// A letter for the group and three digits, such as "C201"; `irbkin rule`
        /// explains it.
        code: String,
        /// The code in words, such as "wrong-confdata".
        name: String,
        /// How much it matters: "error", "warning" or, where nothing is wrong, "note".
        severity: String,
        /// Index of the module among those that are checked.
        module: usize,
        /// Line of the instruction, from 1.
        line: usize,
        /// Column of the instruction, from 1.
        column: usize,
        /// The routine that contains it.
        routine: Option<String>,
        /// Index of the move in `RoutineMotion.moves`, or of the row in a TargetTable; for an
        /// instruction that is not read, of the next move.
        move_index: usize,
        /// The instruction and what is wrong with it, in one line.
        message: String,
        /// The joint that it is about, from 1.
        joint: Option<usize>,
        /// The value that was found, in SI units: the speed of a joint, its step in a flip, how far
        /// outside limits or reach, the distance from a singularity, a duration.
        value: Option<f64>,
        /// The bound that the value must not exceed or, of a singularity, must not be below.
        bound: Option<f64>,
        /// The corrections: index of the module, first byte and end in its `source` as UTF-8, and
        /// the text that takes their place. Empty if nothing corrects it.
        edits: Py<PyTuple>,
        /// Where else its cause shows, and the calls that lead to it: index of the module, line and
        /// column, both from 1.
        related: Py<PyTuple>,
    }

    /// A place at which a program moves, checked.
    CheckedMove {
        /// Index of the module among those that are checked.
        module: usize,
        /// Line of the instruction, or of the call that its target is an argument of, from 1.
        line: usize,
        /// Column of it, from 1.
        column: usize,
        /// The routine that contains it.
        routine: Option<String>,
        /// The target as it is written.
        target: String,
        /// The joints at its target [rad], one an axis; None if it has none or is not checked.
        q: Option<Array>,
        /// The confdata of its target; None for joint angles, or if the target is not known.
        confdata: Option<Configuration>,
        /// The code of the finding for which it is not checked; None if its target, tool and work
        /// object are known in each pass.
        unchecked: Option<String>,
        /// Whether it is checked with the saved value of a PERS or with a given tool in some pass.
        assumed: bool,
    }

    /// The result of a check: findings on moves, and the moves.
    Checked {
        /// The findings, in the order of the modules and of their texts: a tuple of `Finding`.
        findings: Py<PyTuple>,
        /// The moves in the same order, passes of a loop as one; those that depend on calls are at
        /// the innermost text of their target, one for each call: a tuple of `CheckedMove`.
        moves: Py<PyTuple>,
    }
}

#[pymethods]
impl Finding {
    fn __str__(&self) -> String {
        if self.line > 0 {
            format!("line {}: {}", self.line, self.message)
        } else {
            self.message.clone()
        }
    }
}

impl Finding {
    pub(super) fn of(py: Python<'_>, finding: &rapid::Finding) -> PyResult<Self> {
        let rapid::Finding { code, module, line, column, move_index, joint, value, bound, .. } =
            *finding;
        let edit =
            |edit: &rapid::Edit| (edit.module, edit.span.start, edit.span.end, edit.text.clone());
        let edits = finding.edits.iter().map(edit);
        Ok(Self {
            code: code.id().into(),
            name: code.name().into(),
            module,
            severity: finding.severity().id().into(),
            line,
            column,
            routine: finding.routine.clone(),
            move_index,
            message: finding.message.clone(),
            joint,
            value,
            bound,
            edits: PyTuple::new(py, edits)?.unbind(),
            related: PyTuple::new(py, &finding.related)?.unbind(),
        })
    }
}

impl CheckedMove {
    pub(super) fn of<const N: usize>(py: Python<'_>, step: rapid::CheckedMove<N>) -> Self {
        let rapid::CheckedMove { module, line, column, routine, target, assumed, .. } = step;
        let rapid::CheckedMove { q, confdata, unchecked, .. } = step;
        let (routine, target) = (routine.as_deref().map(Into::into), target.to_string());
        let q = q.map(|q| column_of(py, q));
        let unchecked = unchecked.map(|code| code.id().into());
        let confdata = confdata.map(Configuration::from);
        Self { module, line, column, routine, target, q, confdata, unchecked, assumed }
    }
}
