//! The solutions of a regular pose, in order.

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

use super::method::SLOTS;
use crate::kinematics::answer::status::Status;
use crate::kinematics::structure::closure::{BelowAndNear, Order, TIED, in_order};
use crate::kinematics::structure::lanes::{JointRow, RegularPose};
use crate::lanes::{Column, LANES, Vector};
use crate::report::Reach;

/// The solutions of a pose as they are found: rows of angles of the table [rad], with what fills the
/// lanes behind them.
pub(super) struct RootRows {
    rows: ArrayVec<Column, SLOTS>,
    /// Whether these are certain to be all.
    pub(super) is_regular: bool,
}

/// The solutions of a pose, in order.
pub(crate) struct Solved {
    /// Joint angles [rad].
    pub(super) q: ArrayVec<[f64; 6], SLOTS>,
    pub(super) status: ArrayVec<u8, SLOTS>,
    /// Whether these are certain to be all.
    pub(crate) is_regular: bool,
    pub(super) missed: Option<Reach>,
}

/// Flags of a solution, inside the limits or not.
const INSIDE: u8 = Status::FOUND.union(Status::WITHIN_LIMITS).bits();
const OUTSIDE: u8 = Status::FOUND.bits();

impl RootRows {
    #[inline(always)]
    pub(super) fn new() -> Self {
        Self { rows: ArrayVec::new(), is_regular: true }
    }

    #[inline(always)]
    pub(super) fn push<S: Simd>(&mut self, row: Vector<S>, is_regular: bool) {
        self.is_regular &= is_regular && self.rows.try_push(row.to_array()).is_ok();
    }

    /// The rows in order; `None` if two are the same.
    #[inline(always)]
    fn order<S: Simd>(&self, simd: S) -> Option<Order> {
        let (order, are_apart) = in_order(
            self.rows.len(),
            #[inline(always)]
            |joint| self.below_and_near(simd, joint),
        );
        are_apart.then_some(order)
    }

    #[inline(always)]
    fn below_and_near<S: Simd>(&self, simd: S, joint: usize) -> BelowAndNear {
        // Infinity where there is no row: neither below an angle nor near it.
        let mut column = [[f64::INFINITY; LANES]; SLOTS / LANES];
        for (angle, row) in column.as_flattened_mut().iter_mut().zip(&self.rows) {
            *angle = row[joint];
        }
        let [mut below, mut near] = [[0; SLOTS]; 2];
        for (number, row) in self.rows.iter().enumerate() {
            for (block, angles) in column.iter().enumerate() {
                let angles = Vector::load_array_ref(simd, angles);
                let first = LANES * block;
                below[number] |= angles.simd_lt(row[joint]).to_bitmask() << first;
                near[number] |= (angles - row[joint]).abs().simd_le(TIED).to_bitmask() << first;
            }
        }
        [below, near]
    }
}

impl Solved {
    pub(crate) const NEW: Self = Self {
        q: ArrayVec::new_const(),
        status: ArrayVec::new_const(),
        is_regular: false,
        missed: None,
    };

    /// Take what was found, in order, by joint angles; two that are the same are not regular.
    #[inline(always)]
    pub(super) fn take<S: Simd>(&mut self, simd: S, found: &RootRows, joints: &JointRow) {
        self.q.clear();
        self.status.clear();
        self.is_regular = false;
        if !found.is_regular {
            return;
        }
        let Some(order) = found.order(simd) else { return };
        for number in &order[..found.rows.len()] {
            let (row, is_inside) = joints.wrapped(simd, &found.rows[usize::from(*number)]);
            let [q @ .., _, _] = row.to_array();
            self.q.push(q);
            self.status.push(if is_inside { INSIDE } else { OUTSIDE });
        }
        self.is_regular = true;
    }
}

impl RegularPose<6> for Solved {
    #[inline(always)]
    fn slot(&self, slot: usize) -> Option<([f64; 6], u8)> {
        Some((*self.q.get(slot)?, self.status[slot]))
    }

    fn missed(&self) -> Option<Reach> {
        self.missed
    }
}
