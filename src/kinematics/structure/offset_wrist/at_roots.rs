//! The branches at roots of the resultant, of several poses or of one, and the candidates that they
//! are.
//!
//! Docs: offset_wrist.md, section 5.

use fearless_simd::prelude::*;

use super::branch::{Branch, Plane, SIDES, SLACK};
use super::geometry::Constants;
use super::hand::{Hand, Moving};
use super::resultant::polynomial;
use super::step::Stepped;
use crate::kinematics::structure::by_roots::{AT_ROOT, ByRoots};
use crate::kinematics::structure::closure::{Candidates, Closure, Six, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{Root, RootBlock, TrigonometricPolynomial};
use crate::lanes::{Column, LANES, Number as _, Vector, sin_cos_of};
use crate::report::Reach;

/// How far the upper arm may be from its length for the condition of axis 5 to decide there, relative
/// to the lengths of the arm [1].
const NEAR: f64 = 1e-3;

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

impl ByRoots for Constants {
    type Posed = Frame;

    fn closure(&self) -> &Closure {
        &self.closure
    }

    fn per_root(&self) -> usize {
        self.lengths.per_root()
    }

    #[inline(always)]
    fn is_beyond(&self, last: &Frame) -> bool {
        self.is_circle_beyond(last)
    }

    fn reach(&self, last: &Frame) -> Reach {
        self.missed(last)
    }

    #[inline(always)]
    fn posed<S: Simd>(&self, _simd: S, last: &Frame) -> Frame {
        *last
    }

    #[inline(always)]
    fn polynomial<S: Simd>(&self, simd: S, last: &Frame) -> TrigonometricPolynomial {
        polynomial(simd, &self.lengths, &Hand::of(&self.lengths, last), &self.closure)
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
        // Few roots with two solutions each share one block: the second ones are behind.
        let is_shared = per_root == 2 && 2 * roots.count <= LANES;
        let block = if is_shared { &roots.repeated(2) } else { roots };
        let last = Frame::of_lanes(simd, all, &block.of);
        let at_roots = AtRoots::new(self, &last, Vector::load_array_ref(simd, &block.angles));
        let mut nearest = at_roots.nearest(0);
        if is_shared {
            let lane = Vector::load_array_ref(simd, &LANE);
            let (first, second) = (lane.like(LANE[roots.count] - 0.5), at_roots.nearest(1));
            nearest = Branch::where_above(lane, first, &second, &nearest);
        }
        pass(&at_roots.step(&nearest), block);
        if per_root == 2 && !is_shared {
            pass(&at_roots.step(&at_roots.nearest(1)), roots);
        }
    }

    fn most_in(&self, posed: &Frame, root: &Root) -> usize {
        self.most_near(posed, root.angle(), root.radius() + AT_ROOT).unwrap_or(usize::MAX)
    }

    fn has_every_branch(&self, posed: &Frame, root: &Root) -> bool {
        self.are_apart(posed, root.angle(), root.radius())
    }

    /// Every branch, and where the links hardly span the distance of the wrist point that which
    /// meets the condition of axis 5 instead (eq. 134).
    fn starts<S: Simd>(
        &self,
        simd: S,
        posed: &Frame,
        angles: &RootBlock,
        mut pass: impl FnMut(&Six<S>, &Six<S>, u64),
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let angles = Vector::load_array_ref(simd, &angles.angles);
                let at_roots = AtRoots::new(self, &posed.in_lanes(angles), angles);
                for branch in at_roots.branches.iter().chain(&at_roots.by_axis_5()) {
                    // Without a branch there is no number.
                    let lanes = branch.off.simd_lt(f64::INFINITY).to_bitmask();
                    if lanes != 0 {
                        let [sin, cos] = at_roots.joints(branch);
                        pass(&sin, &cos, lanes);
                    }
                }
            },
        );
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

    /// Return the branch of solution `number` of each root that is nearest to one.
    #[inline(always)]
    fn nearest(&self, number: usize) -> Branch<Vector<S>> {
        let count = self.branches.len() / self.constants.lengths.per_root();
        let [first, rest @ ..] = &self.branches[number * count..][..count] else {
            return self.branches[0];
        };
        rest.iter().fold(*first, |nearest, branch| nearest.or_nearer(branch))
    }

    /// Return the branches that meet the condition of axis 5; infinitely off where the upper arm is
    /// then far from its length.
    #[inline(always)]
    fn by_axis_5(&self) -> [Branch<Vector<S>>; 4] {
        let lengths = &self.constants.lengths;
        let one = self.sin_cos_6[0].like(1.0);
        let mut branches = self.branches;
        for (branch, sides) in branches.iter_mut().zip(SIDES) {
            let [shoulder, elbow] = sides.map(|side| one * side);
            let plane = Plane::of(lengths, self.hand.at, shoulder);
            *branch = plane.with_axis_5(lengths, elbow, SLACK);
            let (misses, most) = (branch.misses(lengths), one.like(NEAR * lengths.extent));
            branch.off = misses.if_above(most, one.like(f64::INFINITY), branch.off);
        }
        branches
    }

    /// Sines and cosines of the joint angles of a branch of each root.
    #[inline(always)]
    fn joints(&self, branch: &Branch<Vector<S>>) -> [Six<S>; 2] {
        let Constants { lengths, twists, .. } = self.constants;
        branch.joints(lengths, &self.last, self.sin_cos_6, twists)
    }

    /// Bring a branch of each root to its pose.
    fn converge(&self, branch: &Branch<Vector<S>>) -> Candidates {
        branch.off.token().vectorize(
            #[inline(always)]
            || {
                let [sin, cos] = self.joints(branch);
                self.constants.closure.converge(&self.target, &sin, &cos)
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
