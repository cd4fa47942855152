//! Regular poses of arms whose solutions are at the roots of a trigonometric polynomial: several
//! poses share the lanes.
//!
//! A pose is regular if every root is simple and a candidate at it closes away from every
//! singularity, next to the root. No two of the solutions being the same, there are as many as
//! roots, which are all that there can be.
//!
//! Docs: offset_wrist.md, section 6, and general.md, section 7.

mod block;
mod regular;
#[cfg(test)]
pub(crate) mod tests;

pub(crate) use block::RootKernel;
pub(crate) use regular::regular_of;
#[cfg(test)]
use regular::{Eight, One};

use core::fmt::Debug;

use fearless_simd::Simd;

use super::closure::{Candidates, Closure};
use super::end_frames::Frame;
use super::trigonometric::{RootBlock, TrigonometricPolynomial};
use crate::kinematics::answer::slot::MOST_SLOTS;

/// Slots of an arm whose solutions have no names: as many as six joints can have.
pub(crate) const SLOTS: usize = MOST_SLOTS;

/// A way to the solutions of a pose at the roots of a polynomial of the angle of one joint.
pub(crate) trait ByRoots: Clone + Debug + PartialEq {
    /// A pose, prepared for this arm.
    type Posed: Copy;

    /// Some pose, prepared: what is in a place before there is one.
    const NONE: Self::Posed;

    /// The closure of the arm's joints.
    fn closure(&self) -> &Closure;

    /// Whether the last frame of a pose may be regular; if not, it is not prepared.
    fn may_be_regular(&self, last: &Frame) -> bool;

    /// Prepare a pose. Must be `#[inline(always)]`.
    fn posed<S: Simd>(&self, simd: S, last: &Frame) -> Self::Posed;

    /// The polynomial of a pose. Must be `#[inline(always)]`.
    fn polynomial<S: Simd>(&self, simd: S, posed: &Self::Posed) -> TrigonometricPolynomial;

    /// The angle that is a root of the polynomial, by the angles of the table [rad].
    fn root_of(&self, theta: &[f64; 6]) -> f64;

    /// Bring a candidate at each root of a block to its pose, as often as a root has solutions;
    /// pass them on. Must be `#[inline(always)]`.
    fn candidates<S: Simd>(
        &self,
        simd: S,
        all: &[Self::Posed],
        roots: &RootBlock,
        pass: &mut impl FnMut(&Candidates),
    );
}
