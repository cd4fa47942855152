//! Ranges of joint angles around a part of a motion (docs/theory/cell.md).

use core::array;

/// Joint angles `middle + u turns + e` with |u| <= 1 and |e| <= `beside` [rad].
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct Range<const N: usize> {
    pub(super) middle: [f64; N],
    pub(super) turns: [f64; N],
    pub(super) beside: [f64; N],
}

impl<const N: usize> Range<N> {
    /// How far the joints turn from the middle to either side at most.
    pub(super) fn spans(&self) -> [f64; N] {
        array::from_fn(|joint| self.turns[joint].abs() + self.beside[joint])
    }
}
