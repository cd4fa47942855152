//! What names refer to, as an expression looks them up.

use alloc::borrow::Cow;
use alloc::string::{String, ToString};

use crate::rapid::data::module::Content;
use crate::rapid::data::parts::Part;
use crate::rapid::data::reason::{AssignedBy, Unresolved};

/// Looks names up.
pub(crate) trait Names {
    /// What a name refers to at a place.
    fn find(&self, at: At, name: &str) -> Found<'_>;
}

/// Where a name is used.
#[derive(Clone, Copy, Default)]
pub(crate) struct At {
    /// Index of the routine, from 1; 0 for the module.
    pub(crate) routine: usize,
    /// The innermost loop around it.
    pub(crate) inside_loop: Option<usize>,
}

/// What a name refers to, where it is used.
pub(crate) enum Found<'r> {
    Datum {
        content: &'r Content,
        can_change: bool,
        /// Why its value may be different where the program moves.
        cause: Option<Cause<'r>>,
    },
    /// Of RAPID's own data.
    Predefined(Part<'static>),
    /// Nothing declares it.
    NotHere,
    /// It has no value, for this reason.
    Unknown(Unresolved),
}

/// The reason why a datum has no known value where the program moves.
#[derive(Clone, Copy)]
pub(crate) struct Cause<'a> {
    /// What is assigned: the datum or one that its declaration refers to.
    pub(crate) name: &'a str,
    pub(crate) by: By<'a>,
}

/// What assigns it.
#[derive(Clone, Copy)]
pub(crate) enum By<'a> {
    Line(usize),
    /// Another module.
    Module(Option<&'a str>),
}

impl Cause<'_> {
    /// The cause as the reason why the name that is referred to has no value.
    pub(crate) fn of(&self, referred: &str) -> Unresolved {
        let by = match self.by {
            By::Line(line) => AssignedBy::Line(line),
            By::Module(module) => AssignedBy::Module(module.map(String::from)),
        };
        let is_itself = lower(self.name) == lower(referred);
        Unresolved::Assigned { through: (!is_itself).then(|| self.name.to_string()), by }
    }
}

/// A name in lower case, as names are looked up.
pub(crate) fn lower(name: &str) -> Cow<'_, str> {
    if name.bytes().all(|byte| byte.is_ascii() && !byte.is_ascii_uppercase()) {
        Cow::Borrowed(name)
    } else {
        Cow::Owned(name.to_lowercase())
    }
}

/// Knows no names: for expressions that have none.
pub(crate) struct NoNames;

impl Names for NoNames {
    fn find(&self, _: At, _: &str) -> Found<'_> {
        Found::NotHere
    }
}
