//! All solutions that one split finds, and whether their number is certain (eq. 95 to 104).

use core::f64::consts::PI;

use fearless_simd::prelude::*;

use super::back::{Angle, completed, eliminated, pencil};
use super::determinant::Rest;
use super::equated::Equated;
use super::split::{Posed, Split};
use crate::kinematics::structure::by_roots::{BESIDE, InCluster};
use crate::kinematics::structure::closure::{Accepted, Closure, Missed, Target};
use crate::kinematics::structure::trigonometric::Root;
use crate::lanes::{Column, LANES, Vector, VectorKernel, sin_cos_of};

/// Places in the interval of a cluster from which solutions are searched, as parts of its radius.
const PLACES: Column = [0.0, -0.15, 0.15, -0.4, 0.4, -0.7, 0.7, 1.0];

/// Radius of a simple root above which it is searched for like a cluster [rad].
const UNCERTAIN: f64 = 1e-3;

/// Radius below which an interval is one place [rad].
const NARROW: f64 = 1e-7;

/// The whole circle.
const ANYWHERE: Root = Root { low: -PI, high: PI, is_simple: false, most: usize::MAX };

/// A split applied to a pose.
pub(super) struct Attempt<'a> {
    pub(super) split: &'a Split,
    pub(super) closure: &'a Closure,
    pub(super) target: &'a Target,
    pub(super) in_cluster: InCluster,
    /// Solutions of earlier attempts, and those that this one adds.
    pub(super) accepted: &'a mut Accepted,
}

impl VectorKernel for Attempt<'_> {
    /// Whether the accepted solutions are certain to be all.
    type Answer = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        let Self { split, closure, target, in_cluster, accepted } = self;
        let posed = split.posed(simd, &target.frame.inverse());
        let polynomial = posed.polynomial(simd, closure.rounding);
        let roots = if in_cluster == InCluster::Nowhere {
            let Some(roots) = polynomial.simple_roots(simd) else { return false };
            roots
        } else {
            polynomial.roots(simd, &[])
        };
        // A determinant that is zero at every angle: each may have a solution.
        let is_free = !roots.is_complete && roots.as_slice().is_empty();
        let search = Search { split, closure, target, posed: &posed };
        let all = roots.as_slice();
        let root_of = |theta: &[f64; 6]| split.root_of(theta);
        let mut simple = all.iter().filter(|root| root.is_simple);
        while let Some((angles, lanes)) = next_angles(&mut simple) {
            search.look(simd, &angles, lanes, false, accepted);
        }
        let mut clusters = all.iter().filter(|root| is_cluster(root));
        if in_cluster != InCluster::Everywhere {
            while let Some((angles, lanes)) = next_angles(&mut clusters) {
                search.look(simd, &angles, lanes, true, accepted);
            }
            return accepted.are_at_all(&roots, root_of);
        }
        let mut is_certain = roots.is_complete;
        let mut expected = all.iter().filter(|root| root.is_simple).count();
        for root in clusters.chain(is_free.then_some(&ANYWHERE)) {
            let places = PLACES.map(|place| root.angle() + place * root.radius());
            // Where the interval is narrow, its places are one.
            let lanes = if root.radius() < NARROW { 1 } else { LANES };
            search.look(simd, &places, lanes, true, accepted);
            if !root.is_simple {
                let found = accepted.at(root, root_of);
                let missed = root.most.wrapping_sub(found);
                // Roots that come and go in pairs.
                let is_fold = |missed: &Missed| split.holds_missed(root, missed);
                is_certain &= missed == 0 || missed == 2 && accepted.missed().iter().any(is_fold);
                expected += found;
            }
        }
        is_certain && accepted.are_certain(expected)
    }
}

/// Angles of the next roots, up to eight, and how many these are: other lanes repeat the last.
fn next_angles<'a>(roots: &mut impl Iterator<Item = &'a Root>) -> Option<(Column, usize)> {
    let (mut angles, mut lanes) = ([0.0; LANES], 0);
    for root in roots.by_ref().take(LANES) {
        angles[lanes..].fill(root.angle());
        lanes += 1;
    }
    (lanes > 0).then_some((angles, lanes))
}

/// Whether a root is searched for in its whole interval.
fn is_cluster(root: &Root) -> bool {
    !root.is_simple || root.radius() > UNCERTAIN
}

impl Split {
    /// Whether a missed fold is what an interval without solutions is about: both complex ones are
    /// within it.
    fn holds_missed(&self, root: &Root, missed: &Missed) -> bool {
        let aside = missed.aside[self.searched()];
        aside <= root.radius() + BESIDE && root.is_at(self.root_of(&missed.theta))
    }
}

/// The search for solutions at angles of the searched joint.
struct Search<'a> {
    split: &'a Split,
    closure: &'a Closure,
    target: &'a Target,
    posed: &'a Posed,
}

impl Search<'_> {
    /// Take what is at these angles of the searched joint: from one null vector, in a cluster from
    /// the pencil of two as well.
    fn look<S: Simd>(
        &self,
        simd: S,
        angles: &Column,
        lanes: usize,
        is_cluster: bool,
        accepted: &mut Accepted,
    ) {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || self.look_at(simd, angles, lanes, is_cluster, accepted),
        );
    }

    #[inline(always)]
    fn look_at<S: Simd>(
        &self,
        simd: S,
        angles: &Column,
        lanes: usize,
        is_cluster: bool,
        accepted: &mut Accepted,
    ) {
        let (sin, cos) = sin_cos_of(Vector::load_array_ref(simd, angles));
        let t5 = Angle { sin, cos };
        let Posed { link, equations, .. } = self.posed;
        let (pose, equations) = (link.in_lanes(sin), Equated::One(equations));
        let rest = Rest::at(&equations, &sin, &cos, false);
        let ways = if is_cluster {
            let null = rest.null_vectors();
            let [one, other] = pencil(&null);
            [null[0], one, other]
        } else {
            [rest.null_vector(); 3]
        };
        let target = self.target.in_lanes(t5.sin);
        for powers in &ways[..if is_cluster { 3 } else { 1 }] {
            let [t4, t3] = eliminated(powers);
            let [sin, cos] = completed(self.split, &pose, &[t3, t4, t5]);
            let candidates = self.closure.converge(&target, &sin, &cos);
            accepted.take(self.closure, self.target, &candidates, lanes);
        }
    }
}
