//! Newton's method on the closure, for eight candidates at once.

use fearless_simd::prelude::*;

use super::chain::{Closure, Target, largest};
use super::configuration::{Configuration, ISOLATED, REGULAR};
use super::reflections::Triangle;
use crate::lanes::{
    Column, LANES, Number as _, Vector, VectorKernel, atan2_of, run_vectors, sin_cos_of,
};

/// Sizes of the step after which a candidate has converged [rad]: the next would be its square.
const CONVERGED: f64 = 1e-8;

/// Largest step [rad]: the series of a turn is then good to 1e-9, and the method is far from its
/// goal.
const MOST_STEP: f64 = 0.3;

/// Steps at most. Candidates are within 1e-3 rad of a solution, from where three are enough; more
/// are left to those that are not, or are next to a fold.
const MOST_STEPS: usize = 8;

/// Steps beyond that for a candidate whose last one was below [`NEAR`]: a step is halved until it
/// is below the least singular value, 1e-5 for one that is not examined, then squared.
const LAST_STEPS: usize = 6;

/// Size of a step from which on the next is its square, away from a fold [rad].
const NEAR: f64 = 1e-3;

/// Residual up to which two differ by rounding [1].
const ROUNDING: f64 = 1e-15;

/// Lower bound of the least singular value, as a part of the determinant [1]: `(5 / 12)^(5 / 2)`
/// (eq. 98a).
const OF_DETERMINANT: f64 = 0.112;

/// Joint angles of eight candidates, and how well they close.
#[derive(Clone, Copy)]
pub(crate) struct Candidates {
    /// Angles of the table [rad].
    pub(crate) theta: [Column; 6],
    /// The largest of the six conditions that is left [1].
    pub(crate) residual: Column,
    /// The least singular value of the conditions' derivatives, to a small factor, or a lower bound
    /// of it that is above [`REGULAR`] [1].
    pub(crate) least: Column,
}

impl Candidates {
    /// Whether what is in a lane closes, away from every singularity.
    pub(crate) fn is_regular(&self, closure: &Closure, lane: usize) -> bool {
        self.residual[lane] <= closure.accepts() && self.least[lane] > REGULAR
    }

    /// Replace lanes, as bits, by the lanes of others.
    pub(crate) fn take_lanes(&mut self, others: &Self, mut lanes: u64) {
        while lanes != 0 {
            let lane = lanes.trailing_zeros() as usize;
            for joint in 0..6 {
                self.theta[joint][lane] = others.theta[joint][lane];
            }
            self.residual[lane] = others.residual[lane];
            self.least[lane] = others.least[lane];
            lanes &= lanes - 1;
        }
    }

    /// The angles in a lane [rad].
    pub(crate) fn theta(&self, lane: usize) -> [f64; 6] {
        core::array::from_fn(|joint| self.theta[joint][lane])
    }

    /// Return the candidate in a lane, as it is.
    pub(super) fn configuration(&self, lane: usize) -> Configuration {
        let (residual, least) = (self.residual[lane], self.least[lane]);
        Configuration { theta: self.theta(lane), residual, least, moving: None }
    }
}

/// Six numbers for each lane.
pub(crate) type Six<S> = [Vector<S>; 6];

/// Newton's method from angles of the table [rad].
struct Converge<'a> {
    closure: &'a Closure,
    target: &'a Target,
    theta: &'a [Column; 6],
}

impl VectorKernel for Converge<'_> {
    type Answer = Candidates;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Candidates {
        let zero = Vector::splat(simd, 0.0);
        let (mut sin, mut cos) = ([zero; 6], [zero; 6]);
        for joint in 0..6 {
            let angle = Vector::load_array_ref(simd, &self.theta[joint]);
            (sin[joint], cos[joint]) = sin_cos_of(angle);
        }
        self.closure.converge(&self.target.in_lanes(zero), &sin, &cos)
    }
}

impl Closure {
    /// Bring configurations, by angles of the table [rad], to the target.
    pub(crate) fn converged(&self, target: &Target, theta: &[Column; 6]) -> Candidates {
        run_vectors(Converge { closure: self, target, theta })
    }

    /// Bring candidates to their targets (eq. 98). One that does not converge keeps its last angles.
    pub(crate) fn converge<S: Simd>(
        &self,
        target: &Target<Vector<S>>,
        sin: &Six<S>,
        cos: &Six<S>,
    ) -> Candidates {
        // A function of its own for each instruction set: it is long.
        sin[0].token().vectorize(
            #[inline(always)]
            || self.converge_from(target, *sin, *cos),
        )
    }

    /// Candidates as they are, and the lanes, as bits, in which they do not close to rounding, or
    /// may be next to a singularity by the size of the geometric Jacobian's determinant [m^3]
    /// (eq. 98a).
    #[inline(always)]
    pub(crate) fn arrived<S: Simd>(
        &self,
        target: &Target<Vector<S>>,
        mut sin: Six<S>,
        mut cos: Six<S>,
        determinant: Vector<S>,
    ) -> (Candidates, u64) {
        for joint in 0..6 {
            (sin[joint], cos[joint]) = nearly_unit(sin[joint], cos[joint]);
        }
        let residual = largest(&self.missing(target, &sin, &cos));
        let least = determinant * (OF_DETERMINANT / (self.reach * self.reach * self.reach));
        let has_arrived = residual.simd_le(0.5 * self.rounding) & least.simd_gt(REGULAR);
        let mut candidates = Candidates {
            theta: [[0.0; LANES]; 6],
            residual: residual.to_array(),
            least: least.to_array(),
        };
        for joint in 0..6 {
            candidates.theta[joint] = atan2_of(sin[joint], cos[joint]).to_array();
        }
        (candidates, (!has_arrived).to_bitmask())
    }

    #[inline(always)]
    fn converge_from<S: Simd>(
        &self,
        target: &Target<Vector<S>>,
        mut sin: Six<S>,
        mut cos: Six<S>,
    ) -> Candidates {
        let zero = sin[0].like(0.0);
        let (mut least, mut best) = (zero, zero.like(f64::INFINITY));
        let (mut best_sin, mut best_cos) = (sin, cos);
        // A lane stops by itself: its answer does not depend on the others.
        let mut is_moving = zero.simd_eq(zero);
        for count in 1..=MOST_STEPS + LAST_STEPS {
            let conditions = self.conditions(target, &sin, &cos);
            let residual = largest(&conditions.missing);
            let is_better = residual.simd_lt(best);
            best = is_better.select(residual, best);
            let triangle = Triangle::of(conditions.columns, [conditions.missing]);
            let step = triangle.back(triangle.right[0]);
            let size = largest(&step);
            let was_moving = is_moving;
            // A singular candidate stays where it is.
            is_moving &= size.simd_lt(f64::INFINITY);
            let part = size.like(MOST_STEP) / size;
            let part = part.if_above(zero.like(1.0), zero.like(1.0), part);
            for joint in 0..6 {
                let (s, c) = (sin[joint], cos[joint]);
                best_sin[joint] = is_better.select(s, best_sin[joint]);
                best_cos[joint] = is_better.select(c, best_cos[joint]);
                let (next_s, next_c) = turned(s, c, part * step[joint]);
                sin[joint] = is_moving.select(next_s, s);
                cos[joint] = is_moving.select(next_c, c);
            }
            is_moving &= size.simd_gt(CONVERGED);
            if count >= MOST_STEPS {
                is_moving &= size.simd_lt(NEAR);
            }
            let has_stopped = (was_moving ^ is_moving).any_true();
            if has_stopped || count == MOST_STEPS + LAST_STEPS {
                least = was_moving.select(triangle.least(), least);
            }
            if !is_moving.any_true() {
                break;
            }
        }
        // One that wanders about a singularity returns to where it closed best.
        let last = largest(&self.missing(target, &sin, &cos));
        let is_last = last.simd_le(best * 2.0);
        let mut candidates = Candidates {
            theta: [[0.0; LANES]; 6],
            residual: is_last.select(last, best).to_array(),
            least: least.to_array(),
        };
        for joint in 0..6 {
            let sin = is_last.select(sin[joint], best_sin[joint]);
            let cos = is_last.select(cos[joint], best_cos[joint]);
            candidates.theta[joint] = atan2_of(sin, cos).to_array();
        }
        // A singular one is examined anyway, and rounding moves none far.
        let is_elsewhere = !is_last & last.simd_gt(ROUNDING);
        let may_be_regular = best.simd_le(self.accepts()) & least.simd_gt(ISOLATED);
        let mut returned = (is_elsewhere & may_be_regular).to_bitmask();
        while returned != 0 {
            self.measure_again(&mut candidates, returned.trailing_zeros() as usize);
            returned &= returned - 1;
        }
        candidates
    }

    /// The least singular value of a lane that has returned to where it was.
    #[cold]
    fn measure_again(&self, candidates: &mut Candidates, lane: usize) {
        let theta = candidates.theta(lane);
        let is_there = theta.iter().all(|angle| angle.is_finite());
        candidates.least[lane] = if is_there { self.least_singular_value(&theta) } else { 0.0 };
    }
}

/// Sine and cosine of an angle after a small turn.
#[inline(always)]
fn turned<S: Simd>(s: Vector<S>, c: Vector<S>, turn: Vector<S>) -> (Vector<S>, Vector<S>) {
    let z = turn * turn;
    let one = z.like(1.0);
    let sin = z.mul_add(z.mul_add(1.0 / 120.0, z.like(-1.0 / 6.0)), one) * turn;
    let cos = z.mul_add(z.mul_add(1.0 / 24.0, z.like(-0.5)), one);
    nearly_unit(s.mul_add(cos, c * sin), c.mul_add(cos, -(s * sin)))
}

/// A unit vector from one that is nearly one: its error is squared.
#[inline(always)]
fn nearly_unit<S: Simd>(s: Vector<S>, c: Vector<S>) -> (Vector<S>, Vector<S>) {
    let factor = s.mul_add(s, c * c).mul_add(-0.5, c.like(1.5));
    (s * factor, c * factor)
}
