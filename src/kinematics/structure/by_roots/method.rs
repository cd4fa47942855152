//! What arms whose solutions are at roots have in common.

use core::fmt::Debug;

use fearless_simd::Simd;

use crate::kinematics::answer::slot::MOST_SLOTS;
use crate::kinematics::structure::closure::{Candidates, Closure};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{RootBlock, TrigonometricPolynomial};

/// Slots of an arm whose solutions have no names: as many as six joints can have.
pub(crate) const SLOTS: usize = MOST_SLOTS;

/// A way to the solutions of a pose at the roots of a polynomial of the angle of one joint.
pub(crate) trait ByRoots: Clone + Debug + PartialEq {
    /// A pose, prepared for this arm.
    type Posed;

    /// The closure of the arm's joints.
    fn closure(&self) -> &Closure;

    /// Whether the last frame of a pose may be regular; if not, it is not prepared.
    fn may_be_regular(&self, last: &Frame) -> bool;

    /// Prepare a pose. Must be `#[inline(always)]`.
    fn posed<S: Simd>(&self, simd: S, last: &Frame) -> Self::Posed;

    /// The polynomial of a pose. Must be `#[inline(always)]`.
    fn polynomial<S: Simd>(&self, simd: S, posed: &Self::Posed) -> TrigonometricPolynomial;

    /// The joint, from 0, whose angle is a root of the polynomial, or the negative of one: a sign.
    fn searched(&self) -> (usize, f64);

    /// Bring a candidate at each root of a block to its pose, as often as a root has solutions;
    /// pass them on, with the root of each. Must be `#[inline(always)]`.
    fn candidates<S: Simd>(
        &self,
        simd: S,
        all: &[Self::Posed],
        roots: &RootBlock,
        pass: impl FnMut(&Candidates, &RootBlock),
    );
}
