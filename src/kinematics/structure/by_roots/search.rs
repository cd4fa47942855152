//! Every solution of a pose that is not regular: at all roots and clusters of one polynomial after
//! another, and from starts all over the joints.
//!
//! Docs: general.md, section 7.

use core::slice;

use arrayvec::ArrayVec;
use fearless_simd::Simd;

use super::method::ByRoots;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::{Accepted, Closure, Configuration, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{Root, RootBlock, Roots};
use crate::lanes::{Column, LANES, VectorKernel, run_vectors};

/// Places in a cluster of roots from which solutions are searched, as parts of its radius.
const PLACES: Column = [0.0, -0.15, 0.15, -0.4, 0.4, -0.7, 0.7, 1.0];

/// The whole circle: a polynomial that is noise may have a root anywhere.
const ANYWHERE: Root = Root {
    low: -core::f64::consts::PI,
    high: core::f64::consts::PI,
    is_simple: false,
    most: usize::MAX,
};

/// How far from its root the searched joint of a solution may be [rad].
const AT_ROOT: f64 = 1e-5;

/// Joint vectors from which Newton's method starts where no polynomial shows all solutions, and how
/// often it goes on from there.
const STARTS: usize = 128;
const ROUNDS: usize = 4;

/// The search for all solutions of a pose.
pub(crate) struct Search<'a> {
    closure: &'a Closure,
    last: &'a Frame,
    target: Target,
    /// The angles at which self-motions are to be represented [rad].
    near: [f64; 6],
    accepted: &'a mut Accepted,
    shown: Shown,
}

/// How much a polynomial shows of the solutions.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Shown {
    /// There may be more.
    Some,
    /// As many as there are roots, some of them singular.
    Counted,
    /// Every one: as many regular solutions as there are roots, and no other (eq. 104).
    All,
}

impl<'a> Search<'a> {
    pub(crate) fn new(
        closure: &'a Closure,
        last: &'a Frame,
        near: [f64; 6],
        accepted: &'a mut Accepted,
    ) -> Self {
        let target = closure.target(*last);
        // Nothing is beyond the sum of the lengths.
        let shown = if target.is_beyond() { Shown::All } else { Shown::Some };
        Self { closure, last, target, near, accepted, shown }
    }

    /// Take what is at the roots of a polynomial, unless earlier ones have shown enough.
    pub(crate) fn attempt(&mut self, method: &impl ByRoots) {
        if self.shown == Shown::Some {
            let Self { last, target, accepted, .. } = self;
            self.shown = run_vectors(Attempt { method, last, target, accepted });
        }
    }

    /// Take what Newton's method leads to from all over the joints, if no polynomial has shown
    /// enough, and represent self-motions. Returns whether the solutions are certified to be all.
    pub(crate) fn finish(mut self) -> bool {
        if self.shown == Shown::Some {
            self.represent();
            self.start_anywhere();
            self.accepted.take_closest(self.closure, &self.target);
        }
        self.represent();
        self.shown == Shown::All
    }

    fn represent(&mut self) {
        if self.accepted.has_self_motion() {
            self.accepted.represent(self.closure, &self.target, &self.near);
        }
    }

    /// Start Newton's method all over the joints (eq. 104a).
    #[cold]
    fn start_anywhere(&mut self) {
        let Self { closure, target, accepted, .. } = self;
        let mut starts = (0..STARTS).map(quasi_random);
        // Rounds that are left in each lane: one that closes, or has none left, takes a new start.
        let (mut theta, mut left) = ([[0.0; LANES]; 6], [0; LANES]);
        loop {
            for lane in 0..LANES {
                if left[lane] == 0
                    && let Some(start) = starts.next()
                {
                    left[lane] = ROUNDS;
                    for joint in 0..6 {
                        theta[joint][lane] = start[joint];
                    }
                }
            }
            if left == [0; LANES] {
                break;
            }
            let mut candidates = closure.converged(target, &theta);
            theta = candidates.theta;
            for (residual, left) in candidates.residual.iter_mut().zip(&mut left) {
                let is_done = *left == 1 || *left > 0 && *residual <= closure.accepts();
                *left = if is_done { 0 } else { left.saturating_sub(1) };
                if !is_done {
                    *residual = f64::INFINITY;
                }
            }
            accepted.take(closure, target, &candidates, LANES);
        }
    }
}

/// Angles of a quasi-random sequence: multiples of powers of the inverse of the root of
/// x^7 = x + 1. Reference: Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.
pub(crate) fn quasi_random(index: usize) -> [f64; 6] {
    let root = 1.112_775_684_278_705_5_f64;
    let mut step = 1.0;
    core::array::from_fn(|_| {
        step /= root;
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let part = 0.5 + step * (index + 1) as f64;
        let whole = crate::lanes::whole_below(part);
        core::f64::consts::PI * (2.0 * (part - whole) - 1.0)
    })
}

/// Whether the solutions of a target that one polynomial shows are certified to be all; takes them.
pub(crate) fn certifies(method: &impl ByRoots, last: &Frame, accepted: &mut Accepted) -> bool {
    let target = &method.closure().target(*last);
    run_vectors(Attempt { method, last, target, accepted }) == Shown::All
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
        let mut shown = Shown::Some;
        // The noise alone may show what doubt hides, without certainty.
        for (polynomial, most) in
            [(polynomial.in_doubt(), Shown::All), (polynomial, Shown::Counted)]
        {
            let roots = polynomial.roots(simd);
            let all = roots.as_slice();
            // The best candidate at simple roots, every one in the middle of clusters.
            for block in blocks(all.iter().filter(|root| root.is_simple).map(|root| root.angle())) {
                let posed = slice::from_ref(&posed);
                method.candidates(simd, posed, &RootBlock::of_one(&block), |candidates, block| {
                    accepted.take(method.closure(), target, candidates, block.count);
                });
            }
            let look = |accepted: &mut Accepted, angles: &[f64]| {
                method.every_candidate(simd, &posed, &RootBlock::of_one(angles), |candidates| {
                    accepted.take(method.closure(), target, candidates, angles.len());
                });
            };
            let clusters = || all.iter().filter(|root| !root.is_simple);
            for block in blocks(clusters().map(|root| root.angle())) {
                look(accepted, &block);
            }
            if shown_by(method, &roots, accepted) != Shown::All {
                let is_noise = !roots.is_complete && all.is_empty();
                let places = clusters().chain(is_noise.then_some(&ANYWHERE)).flat_map(|root| {
                    PLACES.into_iter().map(|place| root.angle() + place * root.radius())
                });
                let simple = all.iter().filter(|root| root.is_simple).map(|root| root.angle());
                for block in blocks(simple.chain(places)) {
                    look(accepted, &block);
                }
            }
            shown = shown_by(method, &roots, accepted).min(most);
            if shown == most || polynomial.doubt <= polynomial.noise {
                break;
            }
        }
        shown
    }
}

/// Angles in blocks of lanes.
fn blocks(mut angles: impl Iterator<Item = f64>) -> impl Iterator<Item = ArrayVec<f64, LANES>> {
    core::iter::from_fn(move || {
        let block: ArrayVec<f64, LANES> = angles.by_ref().take(LANES).collect();
        (!block.is_empty()).then_some(block)
    })
}

/// Return what the roots of a polynomial show of the solutions.
fn shown_by(method: &impl ByRoots, roots: &Roots, accepted: &Accepted) -> Shown {
    let (joint, sign) = method.searched();
    let (mut total, mut is_counted) = (0, roots.is_complete);
    for root in roots.as_slice() {
        let is_here = |one: &&Configuration| {
            wrap(sign * one.theta[joint] - root.angle()).abs() <= root.radius() + AT_ROOT
        };
        let here = accepted.as_slice().iter().filter(is_here);
        let most = root.most.saturating_mul(method.per_root());
        is_counted &= here.map(Configuration::weight).sum::<usize>() >= most;
        total += most.min(Accepted::ROOM);
    }
    match accepted.as_slice().len() == total && accepted.are_regular() {
        true if is_counted => Shown::All,
        _ if is_counted => Shown::Counted,
        _ => Shown::Some,
    }
}
