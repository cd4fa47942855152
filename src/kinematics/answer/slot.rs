//! The slot of a solution: which branch of the arm it is on.

use core::fmt;
use core::ops::Deref;

use super::status::Status;

/// Largest number of slots of any structure: a general chain of six joints has up to 16 solutions.
#[doc(hidden)]
pub const MOST_SLOTS: usize = 16;

/// Index of a solution's slot, from 0: always the same for a branch of the arm.
///
/// The structure defines what a slot means. For spherical-wrist arms it is 4 (wrist center behind
/// axis 1) + 2 (behind the lower arm) + 1 (q5 < 0). `Robot::slot_names` has the names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Slot(u8);

impl Slot {
    /// A slot from an index below [`MOST_SLOTS`].
    #[expect(clippy::cast_possible_truncation, reason = "no structure has more than 16 slots")]
    #[inline(always)]
    #[doc(hidden)]
    pub const fn new(index: usize) -> Self {
        Self(index as u8)
    }

    /// A slot from three signs: 4 [first] + 2 [second] + 1 [third].
    pub(crate) fn of_bits([first, second, third]: [bool; 3]) -> Self {
        Self(4 * u8::from(first) + 2 * u8::from(second) + u8::from(third))
    }

    /// Return the branch with the wrist, the last of the three signs, flipped or not.
    pub(crate) const fn flipped_to(self, flipped: bool) -> Self {
        Self(self.0 & !1 | flipped as u8)
    }

    /// Its number, as in ABB's `cfx`.
    pub(crate) fn number(self) -> i32 {
        self.0.into()
    }

    /// The slot as an index into rows of slots.
    #[must_use]
    #[inline(always)]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

impl From<Slot> for usize {
    fn from(slot: Slot) -> Self {
        slot.index()
    }
}

impl From<Slot> for u8 {
    fn from(slot: Slot) -> Self {
        slot.0
    }
}

impl fmt::Display for Slot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The status of every slot of a structure, in slot order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotStatus {
    flags: [Status; MOST_SLOTS],
    count: usize,
}

impl SlotStatus {
    pub(crate) fn new(flags: [Status; MOST_SLOTS], count: usize) -> Self {
        Self { flags, count }
    }
}

impl Deref for SlotStatus {
    type Target = [Status];

    fn deref(&self) -> &[Status] {
        &self.flags[..self.count]
    }
}
