//! The contract of a method whose solutions are at the roots of a polynomial.

use core::fmt::Debug;

use fearless_simd::Simd;

use crate::kinematics::answer::slot::MOST_SLOTS;
use crate::kinematics::structure::closure::{Candidates, Closure, Six};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{Root, RootBlock, TrigonometricPolynomial};
use crate::report::Reach;

/// Slots of an arm whose solutions have no names: as many as six joints can have.
pub(crate) const SLOTS: usize = MOST_SLOTS;

/// A polynomial of the angle of one joint that is zero at every solution of a pose, and the
/// candidates at an angle.
pub(crate) trait ByRoots: Clone + Debug + PartialEq {
    /// A pose, prepared for this arm.
    type Posed;

    fn closure(&self) -> &Closure;

    /// Whether a pose is certain to be out of reach, without its polynomial. Must be
    /// `#[inline(always)]`.
    fn is_beyond(&self, last: &Frame) -> bool {
        self.closure().target(*last).is_beyond()
    }

    /// Return how far a pose without solutions is out of reach.
    fn reach(&self, _last: &Frame) -> Reach {
        Reach::NoRoots
    }

    /// How many solutions a simple root has.
    fn per_root(&self) -> usize;

    /// The joint, from 0, whose angle is a root of the polynomial, or the negative of one: a sign.
    fn searched(&self) -> (usize, f64);

    /// Prepare a pose. Must be `#[inline(always)]`.
    fn posed<S: Simd>(&self, simd: S, last: &Frame) -> Self::Posed;

    /// Return the polynomial of a pose. Must be `#[inline(always)]`.
    fn polynomial<S: Simd>(&self, simd: S, posed: &Self::Posed) -> TrigonometricPolynomial;

    /// Bring the best candidate at each simple root of a block to its pose, or as many as a root has
    /// solutions; pass them on, with the root of each. Must be `#[inline(always)]`.
    fn candidates<S: Simd>(
        &self,
        simd: S,
        all: &[Self::Posed],
        roots: &RootBlock,
        pass: impl FnMut(&Candidates, &RootBlock),
    );

    /// The most solutions in the interval of a cluster, besides what its roots show: the roots of a
    /// cluster may be complex, or of a branch that does not reach.
    fn most_in(&self, _posed: &Self::Posed, _root: &Root) -> usize {
        usize::MAX
    }

    /// Whether every solution in the interval of a cluster is on one of few branches that are apart,
    /// all of which are started from: nothing is left of a self-motion, and what its roots lack is
    /// one with its singular solution.
    fn has_every_branch(&self, _posed: &Self::Posed, _root: &Root) -> bool {
        false
    }

    /// Pass sines and cosines of joint angles from which Newton's method leads to the solutions at
    /// or next to angles, and the lanes, as bits, that have some.
    fn starts<S: Simd>(
        &self,
        simd: S,
        posed: &Self::Posed,
        angles: &RootBlock,
        pass: impl FnMut(&Six<S>, &Six<S>, u64),
    );
}
