//! A split of the loop of six links: two joints that are eliminated linearly, one that drops out,
//! two that a determinant eliminates, and one that is searched (eq. 81).

use alloc::vec::Vec;

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

use super::annihilator::Left;
use super::moments::{MOMENTS, Moments};
use super::pose_link::PoseLink;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{Column, LANES, Number, Vector};

/// Products of a harmonic of t5 with powers of the half-angle tangents of t4 and t3.
pub(super) const PRODUCTS: usize = 27;

/// The six equations in lanes, by products.
pub(super) type Equations = [Column; PRODUCTS];

/// Number of splits: six rotations of the loop, each in two directions.
pub(super) const SPLITS: usize = 12;

/// Part of the moments along z up to which they do not change with the sine, or cosine, of an angle
/// [1]: rounding of a table's angles.
const OF_A_TABLE: f64 = 1e-10;

/// The bound for a pose: the root of the rounding that moves two roots which are as far apart, with
/// room.
const OF_A_POSE: f64 = 1e-6;

/// A split of an arm, with all that does not depend on the pose.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Split {
    /// Which of the [`SPLITS`].
    number: usize,
    /// The joint, from 0, whose angle is `t_k`.
    pub(super) joints: [usize; 6],
    /// 1, or -1 where the loop is read backwards and t is the negative of the joint's angle.
    pub(super) sign: f64,
    /// The links; the pose's is the identity.
    links: [Frame; 6],
    inverses: [Frame; 6],
    /// The link that is the pose.
    place: usize,
    /// The left side, for a pose on the right.
    left: Left,
    /// The links before the pose, times the annihilator: by products of the angles before it. One
    /// entry, unused, for a pose on the left.
    before: Vec<[Column; MOMENTS]>,
    /// The links behind the pose, by products of the angles behind it, in lanes; and their number.
    /// For a pose on the left, the whole right side.
    behind: Vec<Moments<Column>>,
    behind_count: usize,
    /// The least noise of the determinant, whatever its size at a pose.
    pub(super) least_noise: f64,
}

/// A pose in a split: its link, and its equations.
#[derive(Clone, Copy)]
pub(super) struct Posed {
    pub(super) link: PoseLink,
    pub(super) equations: Equations,
    /// Whether a root has no more than one solution.
    pub(super) is_single: bool,
}

impl Posed {
    pub(super) const NONE: Self =
        Self { link: PoseLink::NONE, equations: [[0.0; LANES]; PRODUCTS], is_single: true };
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
            number,
            joints,
            sign,
            links: all,
            inverses,
            place,
            left,
            before: Vec::new(),
            behind: Vec::new(),
            behind_count: 0,
            least_noise: 0.0,
        };
        let behind = split.behind_pose();
        split.behind = behind.chunks(LANES).map(Moments::columns).collect();
        split.behind_count = behind.len();
        if place > 1 {
            let annihilator = left.annihilator();
            split.before = split.before_pose(&annihilator);
        }
        split
    }

    /// Apply the split to another loop.
    pub(super) fn of(&self, links: &[Frame; 5]) -> Self {
        Self { least_noise: self.least_noise, ..Self::new(links, self.number) }
    }

    /// Link 0 or 1 of a pose, in lanes.
    #[inline(always)]
    pub(super) fn link<T: Number>(&self, k: usize, pose: &PoseLink<T>, like: T) -> Frame<T> {
        if k == self.place { pose.link } else { self.links[k].in_lanes(like) }
    }

    /// The inverse of a link of a pose, in lanes.
    #[inline(always)]
    pub(super) fn back<T: Number>(&self, k: usize, pose: &PoseLink<T>, like: T) -> Frame<T> {
        if k == self.place { pose.inverse } else { self.inverses[k].in_lanes(like) }
    }

    /// Whether a root has no more than one solution as a rule.
    pub(super) fn is_single(&self) -> bool {
        self.place <= 1 || self.left.tells_second(OF_A_TABLE)
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
            for moments in &mut all {
                *moments = moments.moved(&self.inverses[k]);
            }
            // Behind link 5 there is no joint.
            if k < 5 {
                all = all_turned_back(k + 1, &all);
            }
        }
        // The joint before the pose link.
        all
    }

    /// For a pose on the right: the annihilator after what is before the pose.
    fn before_pose(&self, annihilator: &[Column; MOMENTS]) -> Vec<[Column; MOMENTS]> {
        let mut before = alloc::vec![*annihilator];
        for joint in (self.place + 1..6).rev() {
            let mut parts = [const { [const { Sparse::new_const() }; MOMENTS] }; 3];
            for k in 0..MOMENTS {
                let of_unit = turned_back(joint, &Moments::unit(k));
                for (part, moments) in parts.iter_mut().zip(of_unit) {
                    let moved = moments.moved(&self.inverses[joint]).0.into_iter().enumerate();
                    part[k] = moved.filter(|(_, moment)| *moment != 0.0).collect();
                }
            }
            let mut longer = Vec::with_capacity(3 * before.len());
            for weights in &before {
                for part in &parts {
                    longer.push(carried_back(weights, part));
                }
            }
            before = longer;
        }
        before
    }

    /// The equations for a pose link, in the direction in which the arm is read (eq. 87).
    pub(super) fn posed<S: Simd>(&self, simd: S, t_last_first: &Frame) -> Posed {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || self.posed_at(simd, t_last_first),
        )
    }

    #[inline(always)]
    fn posed_at<S: Simd>(&self, simd: S, t_last_first: &Frame) -> Posed {
        let pose = if self.sign < 0.0 { t_last_first.inverse() } else { *t_last_first };
        let (inverse, mut left) = (pose.inverse(), self.left);
        if self.place < 2 {
            let mut links = [self.links[0], self.links[1]];
            links[self.place] = pose;
            left = Left::of(&links[0], &links[1]);
        }
        let link = PoseLink { link: pose, inverse, second: left.second() };
        let is_single = self.place > 1 || left.tells_second(OF_A_POSE);
        let mut posed = Posed { link, is_single, ..Posed::NONE };
        if self.place < 2 {
            let annihilator = left.annihilator();
            for (number, column) in posed.equations.iter_mut().enumerate() {
                *column = product(simd, &annihilator, &self.behind, number);
            }
        } else {
            let mut behind = [Moments([[0.0; LANES]; MOMENTS]); PRODUCTS.div_ceil(LANES)];
            for (moved, moments) in behind.iter_mut().zip(&self.behind) {
                *moved = moments.all_moved(simd, &inverse);
            }
            let columns = posed.equations.chunks_mut(self.behind_count);
            for (columns, before) in columns.zip(&self.before) {
                for (number, column) in columns.iter_mut().enumerate() {
                    *column = product(simd, before, &behind, number);
                }
            }
        }
        posed
    }
}

/// The weights' columns times moments of a number, in lanes of blocks.
#[inline(always)]
fn product<S: Simd>(
    simd: S,
    weights: &[Column; MOMENTS],
    blocks: &[Moments<Column>],
    number: usize,
) -> Column {
    let (moments, lane) = (&blocks[number / LANES].0, number % LANES);
    let mut sum = Vector::load_array_ref(simd, &weights[0]) * moments[0][lane];
    for k in 1..MOMENTS {
        let column = Vector::load_array_ref(simd, &weights[k]);
        sum = column.scaled_plus(moments[k][lane], sum);
    }
    sum.to_array()
}

/// The elements of a column of a matrix that are not zero, with its rows.
type Sparse = ArrayVec<(usize, f64), MOMENTS>;

/// A row of weights, six in lanes, times the matrix with these columns.
fn carried_back(weights: &[Column; MOMENTS], matrix: &[Sparse; MOMENTS]) -> [Column; MOMENTS] {
    let mut product = [[0.0; LANES]; MOMENTS];
    for (to, column) in product.iter_mut().zip(matrix) {
        let mut sum = [0.0; LANES];
        for (row, element) in column {
            let weights = &weights[*row];
            for lane in 0..LANES {
                sum[lane] += element * weights[lane];
            }
        }
        *to = sum;
    }
    product
}

/// Moments before joint k turns: by its harmonics for joint 5, for others by powers of the tangent
/// of half its angle.
fn turned_back(k: usize, moments: &Moments) -> [Moments; 3] {
    if k == 5 { moments.back() } else { moments.powers_back() }
}

/// Every product with joint k's: the power of joint 4 and the harmonic of joint 5 come
/// first in the order.
fn all_turned_back(k: usize, all: &[Moments]) -> Vec<Moments> {
    let all: Vec<_> = all.iter().map(|moments| turned_back(k, moments)).collect();
    (0..3).flat_map(|i| all.iter().map(move |parts| parts[i])).collect()
}
