//! The program of a page: one module, read in spite of its faults, and what answers on it share.

use irbkin::rapid::{self, Module};
use serde::Serialize;

/// A module with its text.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) module: Module,
    pub(crate) text: String,
}

impl Program {
    pub(crate) fn read(text: &str) -> Self {
        Self { module: rapid::read(text, &[]), text: text.to_owned() }
    }
}

/// Something wrong with a move.
#[derive(Debug, Serialize)]
pub struct Finding {
    /// The code, "R101".
    pub code: &'static str,
    /// Its name, "out-of-reach".
    pub name: &'static str,
    /// "error", "warning" or "note".
    pub severity: &'static str,
    /// Whether it is shown unless codes are selected.
    pub shown: bool,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The instruction and what is wrong with it.
    pub message: String,
    /// The joint that it is about, from 1.
    pub joint: Option<usize>,
    /// The value that was found, in SI units.
    pub value: Option<f64>,
    /// Its bound.
    pub bound: Option<f64>,
}

impl From<&rapid::Finding> for Finding {
    fn from(finding: &rapid::Finding) -> Self {
        Self {
            code: finding.code.id(),
            name: finding.code.name(),
            severity: finding.code.severity().id(),
            shown: finding.code.is_default(),
            line: finding.line,
            column: finding.column,
            message: finding.message.clone(),
            joint: finding.joint,
            value: finding.value,
            bound: finding.bound,
        }
    }
}

/// A statement that is invalid and skipped.
#[derive(Debug, Serialize)]
pub struct Fault {
    /// Line, from 1; 0 of the whole text.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The reason, with its line.
    pub message: String,
}

/// The faults of the text of a module.
pub(crate) fn faults(module: &Module) -> Vec<Fault> {
    let fault = |fault: &rapid::RapidFault| Fault {
        line: fault.line,
        column: fault.column,
        message: fault.to_string(),
    };
    module.faults().iter().map(fault).collect()
}
