//! Data that a module assigns: when it moves, they need not hold what their declarations say.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::format;
use alloc::string::{String, ToString};

use super::blocks::Blocks;
use super::declarations::{Declared, Named, Scopes};
use super::module::{Datum, Module, Scope, Storage};

/// What stands around the line in the words of a cause.
const BEFORE_LINE: &str = "which line ";

/// A statement that gives a datum another value.
pub(super) struct Assignment<'a> {
    /// Index of the routine, from 1; 0 for the module.
    pub(super) routine: usize,
    /// The innermost loop around it.
    pub(super) inside_loop: Option<usize>,
    pub(super) name: &'a str,
    pub(super) line: usize,
}

/// Why a datum has no known value where the program moves.
#[derive(Clone, Copy)]
pub(super) struct Cause<'a> {
    /// What is assigned: the datum or one that its declaration refers to.
    name: &'a str,
    by: By<'a>,
}

#[derive(Clone, Copy)]
enum By<'a> {
    Line(usize),
    /// Another module.
    Module(Option<&'a str>),
}

impl Cause<'_> {
    /// What is said of the name that is referred to.
    pub(super) fn words(&self, referred: &str) -> String {
        let by = match self.by {
            By::Line(line) => format!("{BEFORE_LINE}{line} assigns"),
            By::Module(Some(module)) => format!("which module {module} assigns"),
            By::Module(None) => "which another module assigns".to_string(),
        };
        if self.name.to_lowercase() == referred.to_lowercase() {
            by
        } else {
            format!("which depends on {}, {by}", self.name)
        }
    }
}

/// The words of a cause, as they are of any line.
pub(super) fn without_line(reason: &mut String) {
    let Some(at) = reason.find(BEFORE_LINE) else { return };
    let from = at + BEFORE_LINE.len();
    let digits = reason[from..].bytes().take_while(u8::is_ascii_digit).count();
    reason.replace_range(from..from + digits, "0");
}

/// What is assigned, by data.
pub(super) struct Causes<'a> {
    /// By the index of the datum.
    of_data: BTreeMap<usize, Cause<'a>>,
    /// Names in lower case that are not declared in the module.
    of_others: BTreeMap<String, Cause<'a>>,
}

impl<'a> Causes<'a> {
    pub(super) fn none() -> Self {
        Self { of_data: BTreeMap::new(), of_others: BTreeMap::new() }
    }

    /// Those of assignments: each goes to the datum that its name stands for where it stands. A CONST cannot be assigned.
    pub(super) fn new(
        assignments: &[Assignment<'a>],
        declared: &[Declared<'_>],
        scopes: &Scopes,
        blocks: &Blocks<'_>,
    ) -> Self {
        let mut causes = Self::none();
        for Assignment { routine, inside_loop, name, line } in assignments {
            let lower = name.to_lowercase();
            if blocks.is_variable(*inside_loop, &lower) {
                continue;
            }
            let cause = Cause { name, by: By::Line(*line) };
            match scopes.find(*routine, &lower) {
                Some(Named::Datum(datum))
                    if declared.get(*datum).is_some_and(|it| it.storage != Storage::Const) =>
                {
                    causes.add(*datum, cause);
                }
                Some(_) => {}
                None => {
                    causes.of_others.entry(lower).or_insert(cause);
                }
            }
        }
        causes
    }

    pub(super) fn add(&mut self, datum: usize, cause: Cause<'a>) {
        self.of_data.entry(datum).or_insert(cause);
    }

    pub(super) fn of_datum(&self, datum: usize) -> Option<Cause<'a>> {
        self.of_data.get(&datum).copied()
    }

    /// That of a datum of another module, by its name in lower case: this module assigns it, its own does, or one that does not mean its own.
    pub(super) fn of_other(
        &self,
        lower: &str,
        home: &'a Module,
        context: &[&'a Module],
    ) -> Option<Cause<'a>> {
        let assigns = |module: &&&Module| {
            module.assigned.contains(lower)
                && (core::ptr::eq(**module, home) || module.find(lower).is_none())
        };
        let of_context = || {
            let module = context.iter().find(assigns)?;
            let name = home.find(lower)?.name.as_str();
            Some(Cause { name, by: By::Module(module.name()) })
        };
        self.of_others.get(lower).copied().or_else(of_context)
    }

    /// The names in lower case of what other modules could see that it is assigned.
    pub(super) fn names(self, declared: &[Declared<'_>]) -> BTreeSet<String> {
        let data = self
            .of_data
            .keys()
            .filter_map(|datum| declared.get(*datum))
            .filter(|datum| datum.routine == 0);
        data.map(|datum| datum.name.to_lowercase()).chain(self.of_others.into_keys()).collect()
    }
}

/// The datum of other modules that a name in lower case means, with its module.
pub(super) fn found_elsewhere<'a>(
    lower: &str,
    context: &[&'a Module],
) -> Option<(&'a Datum, &'a Module)> {
    let mut found = context.iter().filter_map(|module| Some((module.find(lower)?, *module)));
    found.find(|(datum, _)| datum.scope != Scope::Local)
}
