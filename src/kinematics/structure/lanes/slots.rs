//! Joint angles in lanes, a column for each joint of each slot.

use super::columns::JointColumn;
use super::{AnswerRow, BlockSlots, RegularPose, StatusRow};
use crate::lanes::{Column, Flags, LANES};

/// The slots of a block of poses: theta, later the joint angles, and the status.
pub(crate) struct SlotColumns<const N: usize, const S: usize> {
    pub(crate) q: [[Column; S]; N],
    pub(crate) status: [Flags; S],
}

impl<const N: usize, const S: usize> SlotColumns<N, S> {
    pub(crate) const NEW: Self = Self { q: [[[0.0; LANES]; S]; N], status: [[0; LANES]; S] };

    /// Convert theta to joint angles and check them against the limits.
    #[inline(always)]
    pub(crate) fn wrap(&mut self, columns: &[JointColumn; N]) {
        for joint in 0..N {
            columns[joint].wrap(self.q[joint].as_flattened_mut(), self.status.as_flattened_mut());
        }
    }

    /// Write with the last joint equal to `given` in every slot that is found.
    #[inline(always)]
    pub(crate) fn wrap_given(&mut self, columns: &[JointColumn; N], given: &Column) {
        for joint in 0..N - 1 {
            columns[joint].wrap(self.q[joint].as_flattened_mut(), self.status.as_flattened_mut());
        }
        let last = columns[N - 1];
        for slot in 0..S {
            for lane in 0..LANES {
                self.q[N - 1][slot][lane] =
                    if self.status[slot][lane] == 0 { f64::NAN } else { given[lane] };
                self.status[slot][lane] &= last.limited(given[lane]);
            }
        }
    }

    /// The column with an index in a row.
    #[inline(always)]
    fn column(&self, number: usize) -> &Column {
        &self.q[number % N][number / N]
    }
}

impl<const N: usize, const S: usize> BlockSlots<N, S> for SlotColumns<N, S> {
    /// Two numbers at a time.
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    fn write(&self, q: &mut [AnswerRow<N, S>; LANES], status: &mut [StatusRow<S>; LANES]) {
        for pair in 0..S * N / 2 {
            let (left, right) = (self.column(2 * pair), self.column(2 * pair + 1));
            for lane in 0..LANES {
                q[lane].as_flattened_mut().as_chunks_mut::<2>().0[pair] = [left[lane], right[lane]];
            }
        }
        for slot in 0..S {
            for lane in 0..LANES {
                status[lane][slot] = self.status[slot][lane] as u8;
            }
        }
    }

    #[inline(always)]
    fn angles(&self, slot: usize, joint: usize) -> Column {
        self.q[joint][slot]
    }

    #[inline(always)]
    fn status(&self, slot: usize) -> Flags {
        self.status[slot]
    }
}

/// Joint angles and status of the slots of a regular pose.
pub(crate) struct RegularSlots<const N: usize, const S: usize> {
    pub(crate) q: [[f64; S]; N],
    pub(crate) status: [u64; S],
}

impl<const N: usize, const S: usize> RegularSlots<N, S> {
    pub(crate) const NEW: Self = Self { q: [[0.0; S]; N], status: [0; S] };

    /// Write theta of joint `joint`, from 0, to a slot as the joint's angle.
    #[inline(always)]
    pub(crate) fn wrap(&mut self, slot: usize, joint: usize, theta: f64, column: JointColumn) {
        let (angle, inside) = column.wrapped(theta);
        self.q[joint][slot] = angle;
        self.status[slot] &= if inside { u64::MAX } else { JointColumn::OUTSIDE };
    }
}

impl<const N: usize, const S: usize> RegularPose<N> for RegularSlots<N, S> {
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "flags of a byte")]
    fn slot(&self, slot: usize) -> Option<([f64; N], u8)> {
        let status = self.status[slot] as u8;
        (status != 0).then(|| (core::array::from_fn(|joint| self.q[joint][slot]), status))
    }
}
