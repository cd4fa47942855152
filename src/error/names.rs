//! Lists in messages.

use core::fmt;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// Most names that a message lists.
const LISTED: usize = 12;

/// Names for a message: the first of them, and how many more there are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// The first names, quoted, each with a remark where there is one.
    pub listed: Vec<String>,
    /// How many more there are.
    pub more: usize,
}

impl<T: fmt::Display> FromIterator<T> for Names {
    fn from_iter<I: IntoIterator<Item = T>>(names: I) -> Self {
        let mut names = names.into_iter();
        let listed = names.by_ref().take(LISTED).map(|name| name.to_string()).collect();
        Self { listed, more: names.count() }
    }
}

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.listed.join(", "))?;
        if self.more > 0 { write!(f, " and {} more", self.more) } else { Ok(()) }
    }
}

/// "6", "6 or 7".
pub(super) struct Counts<'a>(pub(super) &'a [usize]);

impl fmt::Display for Counts<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, count) in self.0.iter().enumerate() {
            write!(f, "{}{count}", if i == 0 { "" } else { " or " })?;
        }
        Ok(())
    }
}
