//! A split of the loop of six links: two joints that are eliminated linearly, one that drops out,
//! two that a determinant eliminates, and one that is searched (eq. 81).

use alloc::vec::Vec;

use fearless_simd::prelude::*;

use super::annihilator::Left;
use super::moments::{MOMENTS, Moments};
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{Column, LANES, Number as _, Vector};

/// Products of a harmonic of t5 with powers of the half-angle tangents of t4 and t3.
pub(super) const PRODUCTS: usize = 27;

/// The six equations in lanes, by products.
pub(super) type Equations = [Column; PRODUCTS];

/// Number of splits: six rotations of the loop, each in two directions.
pub(super) const SPLITS: usize = 12;

/// A split of an arm, with all that does not depend on the pose.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Split {
    /// The joint, from 0, whose angle is `t_k`.
    pub(super) joints: [usize; 6],
    /// 1, or -1 where the loop is read backwards and t is the negative of the joint's angle.
    pub(super) sign: f64,
    /// The links; that of the pose is the identity.
    pub(super) links: [Frame; 6],
    inverses: [Frame; 6],
    /// The link that is the pose.
    pub(super) place: usize,
    /// The left side, for a pose on the right.
    pub(super) left: Left,
    /// What is before the pose, times the annihilator: by products of the angles before it. One
    /// entry, unused, for a pose on the left.
    before: Vec<[Column; MOMENTS]>,
    /// What is behind the pose: by products of the angles behind it. For a pose on the left, the
    /// whole right side.
    behind: Vec<Moments>,
}

/// The links of a split with a pose, its left side and its equations.
#[derive(Clone, Copy)]
pub(super) struct Posed {
    pub(super) links: [Frame; 6],
    pub(super) inverses: [Frame; 6],
    pub(super) left: Left,
    pub(super) equations: Equations,
}

impl Split {
    /// Split `number` of a loop of links; the last of them is the pose.
    pub(super) fn new(links: &[Frame; 5], number: usize) -> Self {
        let (turn, is_reversed) = (number % 6, number >= 6);
        let around = |k: usize| (turn + k) % 6;
        let joints: [usize; 6] =
            core::array::from_fn(|k| if is_reversed { 5 - around(k) } else { around(k) });
        // Link i is behind joint i; read backwards, the one behind joint i is link i - 1, inverted.
        let link = |k: usize| if is_reversed { (joints[k] + 5) % 6 } else { joints[k] };
        let all: [Frame; 6] = core::array::from_fn(|k| match links.get(link(k)) {
            Some(motion) if is_reversed => motion.inverse(),
            Some(motion) => *motion,
            None => Frame::IDENTITY,
        });
        let place = (0..6).find(|k| link(*k) == 5).unwrap_or(5);
        let sign = if is_reversed { -1.0 } else { 1.0 };
        let inverses = all.map(|link| link.inverse());
        let left = Left::of(&all[0], &all[1]);
        let mut split = Self {
            joints,
            sign,
            links: all,
            inverses,
            place,
            left,
            before: Vec::new(),
            behind: Vec::new(),
        };
        split.behind = split.behind_pose();
        if place > 1 {
            let annihilator = left.annihilator();
            split.before = split.before_pose(&annihilator);
        }
        split
    }

    /// The joint that is searched, from 0.
    pub(super) fn searched(&self) -> usize {
        self.joints[5]
    }

    /// The moments of axis 2 from the right, up to the pose: by products of the angles passed.
    fn behind_pose(&self) -> Vec<Moments> {
        let mut all = alloc::vec![Moments::AXIS];
        for k in 2..6 {
            if k == self.place {
                break;
            }
            let back = self.links[k].inverse();
            for moments in &mut all {
                *moments = moments.moved(&back);
            }
            // Behind link 5 there is no joint.
            if k < 5 {
                all = turned_back(k + 1, &all);
            }
        }
        // The joint before the pose link.
        all
    }

    /// For a pose on the right: the annihilator after what is before the pose.
    fn before_pose(&self, annihilator: &[Column; MOMENTS]) -> Vec<[Column; MOMENTS]> {
        let mut count = 1;
        for _ in self.place..5 {
            count *= 3;
        }
        let mut before = alloc::vec![[[0.0; LANES]; MOMENTS]; count];
        for k in 0..MOMENTS {
            let mut all = alloc::vec![Moments::unit(k)];
            for joint in self.place + 1..6 {
                all = turned_back(joint, &all);
                let back = self.links[joint].inverse();
                for moments in &mut all {
                    *moments = moments.moved(&back);
                }
            }
            for (weights, moments) in before.iter_mut().zip(&all) {
                for (moment, column) in moments.0.iter().zip(annihilator) {
                    for lane in 0..LANES {
                        weights[k][lane] += moment * column[lane];
                    }
                }
            }
        }
        before
    }

    /// The equations for a pose link, in the direction in which the arm is read (eq. 87).
    #[inline(always)]
    pub(super) fn posed<S: Simd>(&self, simd: S, t_last_first: &Frame) -> Posed {
        let pose = if self.sign < 0.0 { t_last_first.inverse() } else { *t_last_first };
        let mut posed = Posed {
            links: self.links,
            inverses: self.inverses,
            left: self.left,
            equations: [[0.0; LANES]; PRODUCTS],
        };
        (posed.links[self.place], posed.inverses[self.place]) = (pose, pose.inverse());
        if self.place < 2 {
            posed.left = Left::of(&posed.links[0], &posed.links[1]);
            let annihilator = posed.left.annihilator();
            for (column, moments) in posed.equations.iter_mut().zip(&self.behind) {
                *column = product(simd, &annihilator, moments);
            }
        } else {
            let back = &posed.inverses[self.place];
            let mut behind = [Moments::AXIS; PRODUCTS];
            let behind = &mut behind[..self.behind.len()];
            for (moved, moments) in behind.iter_mut().zip(&self.behind) {
                *moved = moments.moved(back);
            }
            let columns = posed.equations.chunks_mut(behind.len());
            for (columns, before) in columns.zip(&self.before) {
                for (column, moments) in columns.iter_mut().zip(behind.iter()) {
                    *column = product(simd, before, moments);
                }
            }
        }
        posed
    }
}

/// The weights' columns times moments.
#[inline(always)]
fn product<S: Simd>(simd: S, weights: &[Column; MOMENTS], moments: &Moments) -> Column {
    let mut sum = Vector::load_array_ref(simd, &weights[0]) * moments.0[0];
    for k in 1..MOMENTS {
        let column = Vector::load_array_ref(simd, &weights[k]);
        sum = column.scaled_plus(moments.0[k], sum);
    }
    sum.to_array()
}

/// Every product with those of joint k: the power of joint 4 and the harmonic of joint 5 come
/// first in the order.
fn turned_back(k: usize, all: &[Moments]) -> Vec<Moments> {
    let parts = |moments: &Moments| if k == 5 { moments.back() } else { moments.powers_back() };
    let all: Vec<_> = all.iter().map(parts).collect();
    (0..3).flat_map(|i| all.iter().map(move |parts| parts[i])).collect()
}
