//! What a check finds at a place of the text, and how it is corrected.

use core::ops::Range;

use alloc::string::String;
use alloc::vec::Vec;

use super::code::Code;
use crate::rapid::data::module::Module;
use crate::rapid::expression::predefined::predefined_names;

/// Something that is wrong at a place of a module.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What it is.
    pub code: Code,
    /// Line of the instruction, from 1.
    pub line: usize,
    /// Column of the instruction, from 1, in characters.
    pub column: usize,
    /// The routine that it is in.
    pub routine: Option<String>,
    /// What is wrong, the value, the bound and what to do.
    pub message: String,
    /// The name that nothing declares.
    pub unknown: Option<String>,
    /// What corrects it, in the order of the text; empty where nothing does.
    pub edits: Vec<Edit>,
}

impl Diagnostic {
    /// The names that could be meant where one is unknown: those of a module and of its context,
    /// and RAPID's own.
    #[must_use]
    pub fn candidates(&self, modules: &[&Module]) -> Vec<String> {
        let data_type = self.code.data_type();
        let data = modules.iter().flat_map(|module| module.data());
        let fitting = data.filter(|datum| data_type.is_none_or(|wanted| datum.data_type == wanted));
        let mut names: Vec<String> = fitting.map(|datum| datum.name.clone()).collect();
        names.extend(data_type.map(predefined_names).unwrap_or_default());
        names
    }
}

/// A part of a text, replaced.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// Bytes of the text.
    pub span: Range<usize>,
    /// What takes their place.
    pub text: String,
}
