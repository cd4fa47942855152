//! ABB's confdata, as a program writes it.

use core::fmt;

/// ABB's confdata `[cf1, cf4, cf6, cfx]`: quarter turns of axes 1, 4 and 6, and the slot.
///
/// A quarter turn's number is `floor(angle / 90 deg)`. `cfx` is 4 (wrist center behind axis 1) + 2
/// (behind the lower arm) + 1 (q5 < 0).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Configuration {
    /// Quarter turn of axis 1.
    pub cf1: i32,
    /// Quarter turn of axis 4.
    pub cf4: i32,
    /// Quarter turn of axis 6.
    pub cf6: i32,
    /// The slot of an arm that bends backwards; zero for one with coupled axes 2 and 3.
    pub cfx: i32,
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cf1, cf4, cf6, cfx } = self;
        write!(f, "[{cf1}, {cf4}, {cf6}, {cfx}]")
    }
}
