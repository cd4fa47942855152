//! The solutions of a regular pose, in order.

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

use super::method::SLOTS;
use crate::kinematics::answer::status::Status;
use crate::kinematics::structure::closure::{TIED, in_order};
use crate::kinematics::structure::lanes::{JointRow, RegularPose};
use crate::lanes::{Column, LANES, Vector};

/// The solutions of a pose as they are found: rows of angles of the table [rad], with what fills the
/// lanes behind them.
pub(super) struct Found {
    rows: ArrayVec<Column, SLOTS>,
    /// Whether these are certain to be all.
    pub(super) is_regular: bool,
}

/// The solutions of a pose, by their first angles of the table that differ.
pub(crate) struct Solved {
    /// Joint angles [rad].
    pub(super) q: ArrayVec<[f64; 6], SLOTS>,
    pub(super) status: ArrayVec<u8, SLOTS>,
    /// Whether these are certain to be all.
    pub(crate) is_regular: bool,
}

/// Flags of a solution, inside the limits or not.
const INSIDE: u8 = Status::FOUND.union(Status::WITHIN_LIMITS).bits();
const OUTSIDE: u8 = Status::FOUND.bits();

/// Numbers of rows.
type Order = [u8; SLOTS];

impl Found {
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
        let mut first = [[f64::INFINITY; LANES]; SLOTS / LANES];
        for (angle, row) in first.as_flattened_mut().iter_mut().zip(&self.rows) {
            *angle = row[0];
        }
        let (mut order, mut are_apart) = ([0; SLOTS], true);
        for (number, row) in (0..).zip(&self.rows) {
            let (mut place, mut near) = (0, 0);
            for column in &first {
                let column = Vector::load_array_ref(simd, column);
                place += column.simd_lt(row[0]).to_bitmask().count_ones();
                near += (column - row[0]).abs().simd_le(TIED).to_bitmask().count_ones();
            }
            order[place as usize] = number;
            are_apart &= near == 1;
        }
        if are_apart { Some(order) } else { self.order_by_all() }
    }

    /// The same where the first angles do not tell.
    #[cold]
    fn order_by_all(&self) -> Option<Order> {
        let mut order = [0; SLOTS];
        for (place, number) in order.iter_mut().zip(0..) {
            *place = number;
        }
        let compare = |a: &u8, b: &u8| in_order(self.theta(*a), self.theta(*b));
        let numbers = &mut order[..self.rows.len()];
        numbers.sort_unstable_by(compare);
        let are_apart = numbers.windows(2).all(|pair| compare(&pair[0], &pair[1]).is_ne());
        are_apart.then_some(order)
    }

    fn theta(&self, number: u8) -> &[f64; 6] {
        let [theta @ .., _, _] = &self.rows[usize::from(number)];
        theta
    }
}

impl Solved {
    pub(crate) const NEW: Self =
        Self { q: ArrayVec::new_const(), status: ArrayVec::new_const(), is_regular: false };

    /// Take what was found, in order, by joint angles; two that are the same are not regular.
    #[inline(always)]
    pub(super) fn take<S: Simd>(&mut self, simd: S, found: &Found, joints: &JointRow) {
        self.q.clear();
        self.status.clear();
        self.is_regular = false;
        if !found.is_regular {
            return;
        }
        let Some(order) = found.order(simd) else { return };
        for number in &order[..found.rows.len()] {
            let row = Vector::load_array_ref(simd, &found.rows[usize::from(*number)]);
            let (row, is_inside) = joints.wrapped(row);
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
}
