//! A split as a method: candidates at the roots of its determinant.

use alloc::sync::Arc;
use alloc::vec::Vec;

use fearless_simd::prelude::*;

use super::back::{Angle, completed, eliminated, pencil};
use super::determinant::Rest;
use super::equated::Equated;
use super::pose_link::PoseLink;
use super::split::{Posed, Split};
use crate::kinematics::structure::by_roots::ByRoots;
use crate::kinematics::structure::closure::{Candidates, Closure, Six, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{RootBlock, TrigonometricPolynomial};
use crate::lanes::{LANES, Vector, same, sin_cos_of};

/// One of the splits of an arm.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AtSplit {
    closure: Closure,
    splits: Arc<Vec<Split>>,
    number: usize,
}

impl AtSplit {
    pub(super) fn new(closure: &Closure, splits: &Arc<Vec<Split>>, number: usize) -> Self {
        Self { closure: *closure, splits: Arc::clone(splits), number }
    }

    fn split(&self) -> &Split {
        &self.splits[self.number]
    }
}

/// A pose in a split.
#[derive(Clone, Copy)]
pub(crate) struct AtTarget {
    target: Target,
    posed: Posed,
}

impl ByRoots for AtSplit {
    type Posed = AtTarget;

    fn closure(&self) -> &Closure {
        &self.closure
    }

    fn per_root(&self) -> usize {
        1
    }

    #[inline(always)]
    fn posed<S: Simd>(&self, simd: S, last: &Frame) -> AtTarget {
        let target = self.closure.target(*last);
        AtTarget { target, posed: self.split().posed(simd, &target.frame.inverse()) }
    }

    #[inline(always)]
    fn polynomial<S: Simd>(&self, simd: S, pose: &AtTarget) -> TrigonometricPolynomial {
        pose.posed.polynomial(simd, self.closure.rounding, self.split().least_noise)
    }

    fn searched(&self) -> (usize, f64) {
        (self.split().searched(), self.split().sign)
    }

    #[inline(always)]
    fn candidates<S: Simd>(
        &self,
        simd: S,
        all: &[AtTarget],
        roots: &RootBlock,
        mut pass: impl FnMut(&Candidates, &RootBlock),
    ) {
        let (sin, cos) = sin_cos_of(Vector::load_array_ref(simd, &roots.angles));
        let t5 = Angle { sin, cos };
        let (target, link, equations) = if let Some(one) = same(&roots.of) {
            let AtTarget { target, posed: Posed { link, equations, .. } } = &all[one];
            (target.in_lanes(sin), link.in_lanes(sin), Equated::One(equations))
        } else {
            let mut frames = [&all[0].target.frame; LANES];
            let mut links = [&all[0].posed.link; LANES];
            let mut equations = [&all[0].posed.equations; LANES];
            for lane in 0..LANES {
                let AtTarget { target, posed } = &all[roots.of[lane]];
                (frames[lane], links[lane]) = (&target.frame, &posed.link);
                equations[lane] = &posed.equations;
            }
            let target = Target { frame: Frame::of_each(simd, &frames) };
            (target, PoseLink::of_each(simd, &links), Equated::Each(equations))
        };
        let [t4, t3] = eliminated(&Rest::at(&equations, &sin, &cos, false).null_vector());
        let [sin, cos] = completed(self.split(), &link, &[t3, t4, t5]);
        pass(&self.closure.converge(&target, &sin, &cos), roots);
    }

    /// From one null vector, and from the pencil of two (eq. 90).
    fn starts<S: Simd>(
        &self,
        simd: S,
        AtTarget { posed: Posed { link, equations, .. }, .. }: &AtTarget,
        angles: &RootBlock,
        mut pass: impl FnMut(&Six<S>, &Six<S>, u64),
    ) {
        simd.vectorize(
            #[inline(always)]
            || {
                let (sin, cos) = sin_cos_of(Vector::load_array_ref(simd, &angles.angles));
                let t5 = Angle { sin, cos };
                let link = link.in_lanes(sin);
                let rest = Rest::at(&Equated::One(equations), &sin, &cos, false);
                let null = rest.null_vectors();
                let [one, other] = pencil(&null);
                for powers in [null[0], one, other] {
                    let [t4, t3] = eliminated(&powers);
                    let [sin, cos] = completed(self.split(), &link, &[t3, t4, t5]);
                    pass(&sin, &cos, u64::MAX);
                }
            },
        );
    }
}
