//! Lists and sizes in messages.

use core::fmt;

use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;

/// Most names that a message lists.
const LISTED: usize = 12;

/// Names for a message: the first of them, quoted, and how many more there are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    listed: Vec<String>,
    more: usize,
}

impl<T: fmt::Display> FromIterator<T> for Names {
    fn from_iter<I: IntoIterator<Item = T>>(names: I) -> Self {
        let mut names = names.into_iter();
        let listed = names.by_ref().take(LISTED).map(|name| name.to_string()).collect();
        Self { listed, more: names.count() }
    }
}

impl Names {
    #[doc(hidden)]
    pub fn is_empty(&self) -> bool {
        self.listed.is_empty()
    }
}

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Listed(&self.listed, ", ").fmt(f)?;
        if self.more > 0 { write!(f, " and {} more", self.more) } else { Ok(()) }
    }
}

/// Elements with a separator between them.
pub struct Listed<'a, T>(pub &'a [T], pub &'static str);

impl<T: fmt::Display> fmt::Display for Listed<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0
            .iter()
            .enumerate()
            .try_for_each(|(i, element)| write!(f, "{}{element}", if i == 0 { "" } else { self.1 }))
    }
}

/// How far a value is beyond its bounds, in words: both may look equal.
pub fn excess(value: f64, [lower, upper]: [f64; 2]) -> String {
    let size = (lower - value).max(value - upper);
    if size < 1e-3 { format!("by {size:.1e}") } else { format!("by {size:.3}") }
}
