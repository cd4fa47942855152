//! The branches at roots of the resultant, of several poses or of one, and the candidates that they
//! are.
//!
//! Docs: offset_wrist.md, section 5.

use fearless_simd::prelude::*;

use super::branch::{Branch, Plane, SLACK};
use super::geometry::Constants;
use super::hand::{Hand, Moving};
use super::resultant::polynomial;
use super::step::Stepped;
use crate::kinematics::structure::by_roots::ByRoots;
use crate::kinematics::structure::closure::{Candidates, Closure, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{RootBlock, TrigonometricPolynomial};
use crate::lanes::{Column, LANES, Number as _, Vector, sin_cos_of};

/// Size of z4 . z5 - cos alpha_4 at a root, by which a branch may be worse than the best one and
/// still be a candidate: at once [1], and as a multiple of the radius of the root [1/rad].
const ALSO: f64 = 1e-9;
const ALSO_BY_RADIUS: f64 = 30.0;

/// Up to eight roots, each of a pose.
pub(super) struct AtRoots<'a, S: Simd> {
    constants: &'a Constants,
    last: Frame<Vector<S>>,
    target: Target<Vector<S>>,
    hand: Moving<Vector<S>>,
    sin_cos_6: [Vector<S>; 2],
    /// In the order of [`SIDES`](super::branch::SIDES).
    branches: [Branch<Vector<S>>; 4],
}

/// The branches of which a root serves one: the nearest to a solution.
pub(super) struct Served<'a, S: Simd> {
    pub(super) branches: &'a [Branch<Vector<S>>],
    pub(super) nearest: Branch<Vector<S>>,
}

impl ByRoots for Constants {
    type Posed = Frame;

    fn closure(&self) -> &Closure {
        &self.closure
    }

    fn may_be_regular(&self, last: &Frame) -> bool {
        !self.lengths.is_parallel_at(last)
    }

    #[inline(always)]
    fn posed<S: Simd>(&self, _simd: S, last: &Frame) -> Frame {
        *last
    }

    #[inline(always)]
    fn polynomial<S: Simd>(&self, simd: S, last: &Frame) -> TrigonometricPolynomial {
        polynomial(simd, &self.lengths, &Hand::of(&self.lengths, last))
    }

    fn searched(&self) -> (usize, f64) {
        (5, 1.0)
    }

    #[inline(always)]
    fn candidates<S: Simd>(
        &self,
        simd: S,
        all: &[Frame],
        roots: &RootBlock,
        mut pass: impl FnMut(&Candidates, &RootBlock),
    ) {
        let per_root = self.lengths.per_root();
        // Few roots with two solutions each share one block: those of the second are behind.
        let is_shared = per_root == 2 && 2 * roots.count <= LANES;
        let block = if is_shared { &roots.repeated(2) } else { roots };
        let last = Frame::of_lanes(simd, all, &block.of);
        let at_roots = AtRoots::new(self, &last, Vector::load_array_ref(simd, &block.angles));
        let mut nearest = at_roots.served(0).nearest;
        if is_shared {
            let lane = Vector::load_array_ref(simd, &LANE);
            let (first, second) = (lane.like(LANE[roots.count] - 0.5), at_roots.served(1).nearest);
            nearest = Branch::where_above(lane, first, &second, &nearest);
        }
        pass(&at_roots.step(&nearest), block);
        if per_root == 2 && !is_shared {
            pass(&at_roots.step(&at_roots.served(1).nearest), roots);
        }
    }
}

/// Numbers of the lanes.
const LANE: Column = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0];

impl<'a, S: Simd> AtRoots<'a, S> {
    /// At angles of joint 6 [rad], of poses of frame 6.
    pub(super) fn new(
        constants: &'a Constants,
        last: &Frame<Vector<S>>,
        angles: Vector<S>,
    ) -> Self {
        // A function of its own for each instruction set: it is long.
        angles.token().vectorize(
            #[inline(always)]
            || Self::at(constants, last, angles),
        )
    }

    #[inline(always)]
    fn at(constants: &'a Constants, last: &Frame<Vector<S>>, angles: Vector<S>) -> Self {
        let lengths = &constants.lengths;
        let (sin, cos) = sin_cos_of(angles);
        let hand = Hand::of(lengths, last).moving([sin, cos]);
        let (one, other) = (sin.like(1.0), sin.like(-1.0));
        let (front, behind) =
            (Plane::of(lengths, hand.at, one), Plane::of(lengths, hand.at, other));
        let branches = [
            front.with_elbow(lengths, one, SLACK),
            front.with_elbow(lengths, other, SLACK),
            behind.with_elbow(lengths, one, SLACK),
            behind.with_elbow(lengths, other, SLACK),
        ];
        let target = constants.closure.target(*last);
        Self { constants, last: *last, target, hand, sin_cos_6: [sin, cos], branches }
    }

    /// The branches of solution `number` of each root.
    #[inline(always)]
    pub(super) fn served(&self, number: usize) -> Served<'_, S> {
        let count = self.branches.len() / self.constants.lengths.per_root();
        let branches = &self.branches[number * count..][..count];
        let mut nearest = branches[0];
        for branch in &branches[1..] {
            nearest = nearest.or_nearer(branch);
        }
        Served { branches, nearest }
    }

    /// Bring a branch of each root to its pose.
    pub(super) fn converge(&self, branch: &Branch<Vector<S>>) -> Candidates {
        branch.off.token().vectorize(
            #[inline(always)]
            || {
                let Constants { lengths, twists, closure } = self.constants;
                let [sin, cos] = branch.joints(lengths, &self.last, self.sin_cos_6, twists);
                closure.converge(&self.target, &sin, &cos)
            },
        )
    }

    /// Bring a branch of each root to its pose by a step of joint 6 alone, or, where that is not
    /// enough, by [`Self::converge`].
    fn step(&self, branch: &Branch<Vector<S>>) -> Candidates {
        branch.off.token().vectorize(
            #[inline(always)]
            || {
                let Constants { lengths, twists, closure } = self.constants;
                let stepped = branch.stepped(lengths, &self.hand, self.sin_cos_6);
                let Stepped { branch: next, sin_cos_6, determinant } = stepped;
                let [sin, cos] = next.joints(lengths, &self.last, sin_cos_6, twists);
                let (mut candidates, left) = closure.arrived(&self.target, sin, cos, determinant);
                if left != 0 {
                    candidates.take_lanes(&self.converge(branch), left);
                }
                candidates
            },
        )
    }
}

impl<S: Simd> Served<'_, S> {
    /// How far from a solution branches are candidates, for roots with these radii [rad], and how
    /// many are.
    #[inline(always)]
    pub(super) fn candidates(&self, radii: &Column) -> [Vector<S>; 2] {
        let off = self.nearest.off;
        let radii = Vector::load_array_ref(off.token(), radii);
        let most = off.abs() + radii.scaled_plus(ALSO_BY_RADIUS, off.like(ALSO));
        let (mut count, one) = (off.like(0.0), off.like(1.0));
        for branch in self.branches {
            count += branch.off.abs().if_above(most, off.like(0.0), one);
        }
        [most, count]
    }
}
