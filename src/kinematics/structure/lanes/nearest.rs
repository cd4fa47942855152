//! The solution nearest to a seed, chosen in lanes.

use core::f64::consts::{PI, TAU};

use super::BlockSlots;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::thresholds::{LIMIT_TOLERANCE, MOST_ANGLE};
use crate::lanes::{Column, Flags, LANES, nearest_whole};

/// How near to a limit or to half a turn an angle is left to the scalar choice, which rounds in an
/// order of its own [rad].
const MARGIN: f64 = 1e-9;

/// How much the cost of a solution may depend, as a part of it, on which of two turns is taken that
/// are half a turn from the seed, to [`MARGIN`] [1]: ten times what that may change.
const TIE: f64 = 1e-8;

/// Limits and weights of a choice among solutions.
#[derive(Clone, Copy)]
pub(crate) struct Choice<const N: usize> {
    weights: [f64; N],
    low: [f64; N],
    high: [f64; N],
    /// Lower and upper limit of the serial joint 3 [rad], and the middle between them.
    linkage: Option<[f64; 3]>,
    /// Factor of q2 in the controller's q3.
    coupling: f64,
}

/// A solution and its cost, a column of lanes for each number.
struct Priced<const N: usize> {
    q: [Column; N],
    cost: Column,
    /// Whether the solution has a turn inside the limits.
    inside: Flags,
    /// Whether that is for the scalar choice to say.
    open: Flags,
    /// Whether two turns of a joint are equally near: the flipped wrist of a solution at the seed
    /// is half a turn from it.
    tied: Flags,
}

impl<const N: usize> Choice<N> {
    pub(crate) fn new(limits: &JointLimits<N>, weights: &[f64; N]) -> Self {
        let [low, high] = limits.bounds();
        let linkage = limits
            .linkage()
            .map(|[lower, upper]| [lower, upper, 0.5 * (lower + upper)])
            .filter(|[_, _, middle]| middle.is_finite());
        Self { weights: *weights, low, high, linkage, coupling: limits.coupling() }
    }

    /// Writes the nearest solution of each pose of a block, NaN where none is inside the limits;
    /// returns the lanes in which the choice is certain. Chooses as
    /// [`Solutions::cheapest`](crate::Solutions::nearest) does, to the bit.
    #[inline(always)]
    pub(super) fn nearest<const S: usize>(
        &self,
        slots: &impl BlockSlots<N, S>,
        seeds: &[[f64; N]; LANES],
        q: &mut [[f64; N]; LANES],
    ) -> Flags {
        let (mut seed, mut certain) = ([[0.0; LANES]; N], [1; LANES]);
        for joint in 0..N {
            for lane in 0..LANES {
                seed[joint][lane] = seeds[lane][joint];
                // NaN is in no bound.
                certain[lane] &= u64::from(seed[joint][lane].abs() <= MOST_ANGLE);
            }
        }
        let (mut best, mut least) = ([[f64::NAN; LANES]; N], [f64::INFINITY; LANES]);
        let mut least_tied = [f64::INFINITY; LANES];
        for slot in 0..slots.used() {
            let status = slots.status(slot);
            let priced = self.priced(slots, slot, &seed);
            for lane in 0..LANES {
                let found = u64::from(status[lane] != 0) & priced.inside[lane];
                let cost = priced.cost[lane];
                certain[lane] &= !(found & (priced.open[lane] | u64::from(cost >= f64::INFINITY)));
                let is_tied = (found & priced.tied[lane] != 0) & (cost < least_tied[lane]);
                least_tied[lane] = if is_tied { cost } else { least_tied[lane] };
                let better = (found != 0) & (cost < least[lane]);
                least[lane] = if better { cost } else { least[lane] };
                for joint in 0..N {
                    let (new, old) = (priced.q[joint][lane], best[joint][lane]);
                    best[joint][lane] = if better { new } else { old };
                }
            }
        }
        for lane in 0..LANES {
            // Whichever turn a tied solution takes, it costs more.
            let is_clear = (least_tied[lane] >= f64::INFINITY)
                | (least_tied[lane] > least[lane] * (1.0 + TIE));
            certain[lane] &= u64::from(is_clear);
            for joint in 0..N {
                q[lane][joint] = best[joint][lane];
            }
        }
        certain
    }

    /// The solution of a slot at its turn nearest to the seed.
    #[inline(always)]
    fn priced<const S: usize>(
        &self,
        slots: &impl BlockSlots<N, S>,
        slot: usize,
        seed: &[Column; N],
    ) -> Priced<N> {
        let mut priced = Priced {
            q: [[0.0; LANES]; N],
            cost: [0.0; LANES],
            inside: [1; LANES],
            open: [0; LANES],
            tied: [0; LANES],
        };
        for joint in 0..N {
            let (low, high, weight) = (self.low[joint], self.high[joint], self.weights[joint]);
            let angles = slots.angles(slot, joint);
            for lane in 0..LANES {
                let (angle, seed) = (angles[lane], seed[joint][lane]);
                let apart = seed - angle;
                let size = apart.abs();
                let holds = (angle >= low) & (angle <= high);
                // The kernel has turned the angle into the limits where a turn of it is inside.
                let outside = ((angle < low) & (angle + TAU > high + MARGIN))
                    | ((angle > high) & (angle - TAU < low - MARGIN));
                // The turn nearest to the seed is none, one or two away; limits may end before it.
                let (far, farther) = (size >= PI, size >= 3.0 * PI);
                let turn = TAU.copysign(apart);
                let (one, two) = (angle + turn, angle + 2.0 * turn);
                let one_in = (one >= low + MARGIN) & (one <= high - MARGIN);
                let two_in = (two >= low + MARGIN) & (two <= high - MARGIN);
                let one_out = (one < low - MARGIN) | (one > high + MARGIN);
                let two_out = (two < low - MARGIN) | (two > high + MARGIN);
                let tied = ((size - PI).abs() <= MARGIN) | ((size - 3.0 * PI).abs() <= MARGIN);
                let clear = (size < 5.0 * PI - MARGIN)
                    & (one_in | one_out)
                    & (!farther | one_out | two_in | two_out);
                priced.inside[lane] &= u64::from(!outside);
                priced.open[lane] |= u64::from(!holds | (far & !clear));
                priced.tied[lane] |= u64::from(far & tied);
                let nearest = if far & one_in { one } else { angle };
                let nearest = if farther & one_in & two_in { two } else { nearest };
                priced.q[joint][lane] = nearest;
                let step = nearest - seed;
                priced.cost[lane] += weight * (step * step);
            }
        }
        if let Some([lower, upper, middle]) = self.linkage {
            let (second, third) = (slots.angles(slot, 1), slots.angles(slot, 2));
            for lane in 0..LANES {
                let angle = third[lane] - self.coupling * second[lane];
                let angle = angle + TAU * nearest_whole((middle - angle) / TAU);
                let excess = (lower - angle).max(angle - upper);
                priced.inside[lane] &= u64::from(excess <= LIMIT_TOLERANCE);
            }
        }
        priced
    }
}
