//! Records of what a check finds.

use pyo3::basic::CompareOp;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use crate::python::outputs::column as column_of;
use crate::python::record::{self, record, record_methods};
use crate::python::records::Array;
use crate::rapid;

record! {
    "irbkin.rapid";
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
        /// The joints at its target [rad], shape (6,); None if it has none or is not checked.
        q: Option<Array>,
        /// The code of the finding for which it is not checked; None if its target, tool and work
        /// object are known.
        unchecked: Option<String>,
    }
}

record! {
    "irbkin.rapid";
    /// What a check finds: findings on moves, and the moves.
    Checked {
        /// What is wrong, in the order of the modules and of their texts: a tuple of `Finding`.
        findings: Py<PyTuple>,
        /// The moves in the same order, each place once: a tuple of `CheckedMove`.
        moves: Py<PyTuple>,
    }
}

impl CheckedMove {
    pub(super) fn of(py: Python<'_>, step: rapid::CheckedMove) -> Self {
        let rapid::CheckedMove { module, line, column, routine, target, q, unchecked } = step;
        let q = q.map(|q| column_of(py, q));
        let unchecked = unchecked.map(|code| code.id().into());
        Self { module, line, column, routine, target, q, unchecked }
    }
}
