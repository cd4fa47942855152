//! The solutions at all roots and clusters of one polynomial, and how much these show.
//!
//! Docs: general.md, section 7.

use core::f64::consts::PI;
use core::slice;

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

use super::method::ByRoots;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::{Accepted, Closure, Configuration, Six, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{NARROW, Root, RootBlock, Roots, WIDE};
use crate::lanes::{Column, LANES, Vector, VectorKernel, atan2_of, run_vectors};

/// Places in a cluster of roots from which solutions are searched, beside its middle, as parts of
/// its radius.
const PLACES: [f64; 7] = [-0.15, 0.15, -0.4, 0.4, -0.7, 0.7, 1.0];

/// The whole circle: a polynomial that is noise may have a root anywhere.
const ANYWHERE: Root = Root { low: -PI, high: PI, is_simple: false, most: usize::MAX };

/// How far from its root the searched joint of a solution may be [rad].
pub(crate) const AT_ROOT: f64 = 1e-5;

/// How much a polynomial shows of the solutions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Shown {
    /// There may be more.
    Some,
    /// As many as there are roots, some of them singular.
    Counted,
    /// As many, on branches that are apart, and folds to rounding where they are not regular.
    Closed,
    /// Every one: as many regular solutions as there are roots, and no other (eq. 104).
    All,
}

/// Take the solutions of a target that one polynomial has as roots.
pub(super) fn attempt(
    method: &impl ByRoots,
    last: &Frame,
    target: &Target,
    accepted: &mut Accepted,
) -> Shown {
    run_vectors(Attempt { method, last, target, accepted })
}

/// Whether the solutions that one polynomial shows are certified to be all; takes them.
pub(crate) fn certifies(method: &impl ByRoots, last: &Frame, accepted: &mut Accepted) -> bool {
    let target = &method.closure().target(*last);
    attempt(method, last, target, accepted) == Shown::All
}

/// The search at the roots of one polynomial, compiled for each instruction set.
struct Attempt<'a, M: ByRoots> {
    method: &'a M,
    last: &'a Frame,
    target: &'a Target,
    /// Solutions of earlier attempts, and those that this one adds.
    accepted: &'a mut Accepted,
}

impl<M: ByRoots> VectorKernel for Attempt<'_, M> {
    type Answer = Shown;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Shown {
        let Self { method, last, target, accepted } = self;
        let posed = method.posed(simd, last);
        let polynomial = method.polynomial(simd, &posed);
        let closure = method.closure();
        let mut shown = Shown::Some;
        // In doubt first; then the noise alone may show what doubt hides, without certainty.
        let most = if polynomial.doubt > polynomial.noise { Shown::Counted } else { Shown::All };
        for (polynomial, width, most) in
            [(polynomial.in_doubt(), WIDE, Shown::All), (polynomial, NARROW, most)]
        {
            let mut roots = polynomial.roots(simd, width);
            roots.limit(|root| {
                let most = root.most.saturating_mul(method.per_root());
                if root.is_simple { most } else { most.min(method.most_in(&posed, root)) }
            });
            let all = roots.as_slice();
            let left = lacking(method, all, accepted);
            let simple = left.iter().filter(|root| root.is_simple);
            for block in blocks(simple.map(|root| root.angle())) {
                let block = RootBlock::of_one(&block);
                method.candidates(simd, slice::from_ref(&posed), &block, |candidates, block| {
                    accepted.take(closure, target, candidates, block.count);
                });
            }
            let mut starts = Starts::new(closure, target, accepted);
            let clusters = left.iter().filter(|root| !root.is_simple);
            starts.at(simd, method, &posed, clusters.map(|root| root.angle()));
            if width == NARROW {
                // From every branch, and all over the clusters.
                let left = lacking(method, all, starts.accepted);
                let is_noise = !roots.is_complete && all.is_empty();
                let simple = left.iter().filter(|root| root.is_simple).map(|root| root.angle());
                let clusters = left.iter().filter(|root| !root.is_simple);
                let places = clusters.chain(is_noise.then_some(&ANYWHERE)).flat_map(|root| {
                    PLACES.into_iter().map(|place| root.angle() + place * root.radius())
                });
                starts.at(simd, method, &posed, simple.chain(places));
            }
            let is_apart = |root: &Root| method.has_every_branch(&posed, root);
            let is_merged = |root: &Root| width == NARROW && is_apart(root);
            shown = shown_by(method, &roots, accepted, is_merged).min(most);
            if shown == Shown::Counted && accepted.are_folds() && all.iter().all(is_apart) {
                shown = Shown::Closed;
            }
            if shown >= Shown::Counted {
                break;
            }
        }
        shown
    }
}

/// Joint angles from which Newton's method starts, lane beside lane, and what takes its solutions.
struct Starts<'a> {
    closure: &'a Closure,
    target: &'a Target,
    accepted: &'a mut Accepted,
    sin: [Column; 6],
    cos: [Column; 6],
    count: usize,
}

impl<'a> Starts<'a> {
    fn new(closure: &'a Closure, target: &'a Target, accepted: &'a mut Accepted) -> Self {
        let zero = [[0.0; LANES]; 6];
        Self { closure, target, accepted, sin: zero, cos: zero, count: 0 }
    }

    /// Take the solutions next to angles.
    #[inline(always)]
    fn at<S: Simd, M: ByRoots>(
        &mut self,
        simd: S,
        method: &M,
        posed: &M::Posed,
        angles: impl Iterator<Item = f64>,
    ) {
        for block in blocks(angles) {
            let used = (1 << block.len()) - 1;
            method.starts(simd, posed, &RootBlock::of_one(&block), |sin, cos, lanes| {
                self.push(simd, (sin, cos), lanes & used);
            });
        }
        self.converge(simd);
    }

    /// Put lanes, as bits, in a block: a full one is brought to the target.
    #[inline(always)]
    fn push<S: Simd>(&mut self, simd: S, (sin, cos): (&Six<S>, &Six<S>), mut lanes: u64) {
        let mut block = [[[0.0; LANES]; 6]; 3];
        for joint in 0..6 {
            block[0][joint] = atan2_of(sin[joint], cos[joint]).to_array();
            block[1][joint] = sin[joint].to_array();
            block[2][joint] = cos[joint].to_array();
        }
        let [theta, sin, cos] = block;
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            lanes &= lanes - 1;
            if self.accepted.attracts(&theta, lane) {
                continue;
            }
            for joint in 0..6 {
                self.sin[joint][self.count] = sin[joint][lane];
                self.cos[joint][self.count] = cos[joint][lane];
            }
            self.count += 1;
            if self.count == LANES {
                self.converge(simd);
            }
        }
    }

    /// Bring what is in the block to the target.
    fn converge<S: Simd>(&mut self, simd: S) {
        if self.count == 0 {
            return;
        }
        for column in self.sin.iter_mut().chain(&mut self.cos) {
            // The first is in the lanes that are left.
            let first = column[0];
            column[self.count..].fill(first);
        }
        let zero = Vector::splat(simd, 0.0);
        let (mut sin, mut cos) = ([zero; 6], [zero; 6]);
        for joint in 0..6 {
            sin[joint] = Vector::load_array_ref(simd, &self.sin[joint]);
            cos[joint] = Vector::load_array_ref(simd, &self.cos[joint]);
        }
        let target = self.target.in_lanes(sin[0]);
        let candidates = self.closure.converge(&target, &sin, &cos);
        self.accepted.take(self.closure, self.target, &candidates, self.count);
        self.count = 0;
    }
}

/// Angles in blocks of lanes.
fn blocks(mut angles: impl Iterator<Item = f64>) -> impl Iterator<Item = ArrayVec<f64, LANES>> {
    core::iter::from_fn(move || {
        let block: ArrayVec<f64, LANES> = angles.by_ref().take(LANES).collect();
        (!block.is_empty()).then_some(block)
    })
}

/// Return the solutions that are at a root.
fn those_at<'a>(
    method: &impl ByRoots,
    root: &'a Root,
    accepted: &'a Accepted,
) -> impl Iterator<Item = &'a Configuration> {
    let (joint, sign) = method.searched();
    let far = move |one: &Configuration| wrap(sign * one.theta[joint] - root.angle()).abs();
    accepted.as_slice().iter().filter(move |one| far(one) <= root.radius() + AT_ROOT)
}

/// Return how many solutions are at a root.
fn found_at(method: &impl ByRoots, root: &Root, accepted: &Accepted) -> usize {
    those_at(method, root, accepted).map(Configuration::weight).sum()
}

/// Return the roots that may have more solutions.
fn lacking(
    method: &impl ByRoots,
    all: &[Root],
    accepted: &Accepted,
) -> ArrayVec<Root, { Roots::ROOM }> {
    let is_lacking = |root: &&Root| found_at(method, root, accepted) < root.most;
    all.iter().filter(is_lacking).copied().collect()
}

/// Return what the roots of a polynomial show of the solutions. What a cluster lacks may be known to
/// be one with its fold.
fn shown_by(
    method: &impl ByRoots,
    roots: &Roots,
    accepted: &Accepted,
    is_merged: impl Fn(&Root) -> bool,
) -> Shown {
    if !roots.is_complete {
        return Shown::Some;
    }
    let (mut total, mut shown) = (0, Shown::All);
    for root in roots.as_slice() {
        if found_at(method, root, accepted) < root.most {
            let has_fold = those_at(method, root, accepted).any(Configuration::is_fold);
            let is_known = has_fold && is_merged(root);
            shown = shown.min(if is_known { Shown::Counted } else { Shown::Some });
        }
        total += root.most.min(Accepted::ROOM);
    }
    let is_all = accepted.as_slice().len() == total && accepted.are_regular();
    if is_all { shown } else { shown.min(Shown::Counted) }
}
