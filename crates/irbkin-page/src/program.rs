//! The program of a page: its modules, read in spite of their faults, and what answers on it share.

use alloc::borrow::ToOwned;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

use irbkin_abb::rapid;
use irbkin_abb::rapid::Module;
use serde::Serialize;

use super::request::{Refusal, Request};

/// Most modules of a program.
const MOST_MODULES: usize = 100;

/// The modules of a task with their texts.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) modules: Vec<Module>,
    pub(crate) texts: Vec<String>,
}

impl Program {
    /// The modules of a request, each read with the declarations of the others.
    pub(crate) fn read(request: &Request<'_>) -> Result<Self, Refusal> {
        let given = request.objects("modules", MOST_MODULES)?;
        if given.is_empty() {
            return request.refused("modules", "has 0 items, it must have at least one");
        }
        let texts: Vec<_> =
            given.iter().map(|it| it.text("text").map(str::to_owned)).collect::<Result<_, _>>()?;
        let alone: Vec<_> = texts.iter().map(|text| rapid::read(text, &[])).collect();
        let others = |own: &Module| -> Vec<&Module> {
            alone.iter().filter(|other| !core::ptr::eq(*other, own)).collect()
        };
        let together = |(own, text): (&Module, &String)| rapid::read(text, &others(own));
        let modules = match texts.len() {
            1 => alone,
            _ => alone.iter().zip(&texts).map(together).collect(),
        };
        Ok(Self { modules, texts })
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
    /// The module, from 0.
    pub module: usize,
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
    /// What corrects it; empty where nothing does.
    pub edits: Vec<Edit>,
}

/// A text that takes the place of another one.
#[derive(Debug, Serialize)]
pub struct Edit {
    /// The module, from 0.
    pub module: usize,
    /// Its first byte in the text of the module as UTF-8.
    pub begin: usize,
    /// The byte behind it.
    pub end: usize,
    /// The new text.
    pub text: String,
}

impl From<&rapid::Edit> for Edit {
    fn from(edit: &rapid::Edit) -> Self {
        let (begin, end) = (edit.span.start, edit.span.end);
        Self { module: edit.module, begin, end, text: edit.text.clone() }
    }
}

impl From<&rapid::Finding> for Finding {
    fn from(finding: &rapid::Finding) -> Self {
        Self {
            code: finding.code.id(),
            name: finding.code.name(),
            severity: finding.severity().id(),
            shown: finding.code.is_default(),
            module: finding.module,
            line: finding.line,
            column: finding.column,
            message: finding.message.clone(),
            joint: finding.joint,
            value: finding.value,
            bound: finding.bound,
            edits: finding.edits.iter().map(Edit::from).collect(),
        }
    }
}

/// A statement that is invalid and skipped.
#[derive(Debug, Serialize)]
pub struct Fault {
    /// The module, from 0.
    pub module: usize,
    /// Line, from 1; 0 of the whole text.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// The reason, with its line.
    pub message: String,
}

/// The faults of the texts of modules.
pub(crate) fn faults(modules: &[Module]) -> Vec<Fault> {
    let of = |(module, own): (usize, &Module)| -> Vec<Fault> {
        let fault = |fault: &rapid::RapidFault| Fault {
            module,
            line: fault.line,
            column: fault.column,
            message: fault.to_string(),
        };
        own.faults().iter().map(fault).collect()
    };
    modules.iter().enumerate().flat_map(of).collect()
}
