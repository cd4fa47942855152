//! Two joints whose sum or difference alone a singular pose determines, such as those about
//! collinear axes 4 and 6.

use core::f64::consts::TAU;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::thresholds::LIMIT_TOLERANCE;
use crate::lanes::whole_below;
use crate::report::FreeJoint;

/// `q[first] + sign * q[partner] = fixed`, modulo 2 pi.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// Indices of the joints, from 0.
    pub(super) first: usize,
    pub(super) partner: usize,
    sign: f64,
    fixed: f64,
}

impl Pair {
    /// The pair of a solution whose free joint has a partner.
    pub(super) fn of<const N: usize>(free: FreeJoint, q: &[f64; N]) -> Option<Self> {
        let (partner, sign) = free.partner()?;
        Some(Self::at((free.joint() - 1, partner - 1, sign), q))
    }

    /// The pair of joints, from 0, whose sum by a sign is fixed.
    pub(super) fn at<const N: usize>(of: (usize, usize, f64), q: &[f64; N]) -> Self {
        let (first, partner, sign) = of;
        Self { first, partner, sign, fixed: q[first] + sign * q[partner] }
    }

    /// The angle of the partner for an angle of the first joint.
    fn partner_of(&self, angle: f64) -> f64 {
        self.sign * (self.fixed - angle)
    }

    /// `q` with the first joint at `angle` and its partner at the angle that follows.
    pub(super) fn put<const N: usize>(&self, q: &[f64; N], angle: f64) -> [f64; N] {
        let mut q = *q;
        (q[self.first], q[self.partner]) = (angle, self.partner_of(angle));
        q
    }

    /// The angles of the first joint at which it or its partner reaches a limit.
    pub(super) fn edges<const N: usize>(&self, limits: &JointLimits<N>) -> [f64; 4] {
        let limits = limits.to_array();
        let ([low, high], [other_low, other_high]) = (limits[self.first], limits[self.partner]);
        [low, high, self.fixed - self.sign * other_low, self.fixed - self.sign * other_high]
    }

    /// The angle of the first joint at which both joints are inside the limits and nearest to the
    /// seed; `None` if no angle keeps both inside.
    ///
    /// With the partner `m` turns on, the cost is a parabola of the angle `a`
    /// (docs/theory/singularities.md, eq. 81), restricted by the limits to an interval. The least
    /// cost for each `m` is a convex function of `m`, so the best turns are adjacent to the turns
    /// of the pair of angles that would be chosen if the sum were free.
    pub(super) fn nearest<const N: usize>(
        &self,
        limits: &JointLimits<N>,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Option<f64> {
        let all = limits.to_array();
        let (a, b) = (self.first, self.partner);
        let ([low_a, high_a], [low_b, high_b]) = (all[a], all[b]);
        let clipped_b = seed[b].clamp(low_b, high_b);
        let turns = whole_below((clipped_b - self.partner_of(seed[a].clamp(low_a, high_a))) / TAU);
        let mut best: Option<(f64, f64)> = None;
        for turn in [turns - 1.0, turns, turns + 1.0, turns + 2.0] {
            let fixed = self.fixed + self.sign * TAU * turn;
            // For b = sign (fixed - a) at its limits.
            let ends = [fixed - self.sign * low_b, fixed - self.sign * high_b];
            let low = low_a.max(ends[0].min(ends[1]));
            let high = high_a.min(ends[0].max(ends[1]));
            if low > high + LIMIT_TOLERANCE {
                continue;
            }
            let both = weights[a] + weights[b];
            let part = if both > 0.0 { weights[b] / both } else { 0.0 };
            // By how much the pair of the seed misses the sum (eq. 81).
            let over = fixed - (seed[a] + self.sign * seed[b]);
            let angle = (seed[a] + part * over).max(low).min(high.max(low));
            let [da, db] = [angle - seed[a], self.sign * (fixed - angle) - seed[b]];
            let cost = weights[a] * da * da + weights[b] * db * db;
            if best.is_none_or(|(least, _)| cost < least) {
                best = Some((cost, angle));
            }
        }
        best.map(|(_, angle)| angle)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares with every angle in steps of a milliradian.
    #[test]
    fn no_other_angles_of_the_pair_are_nearer_to_the_seed() {
        let mut state = 1_u64;
        let mut unit = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            #[expect(clippy::cast_precision_loss, reason = "53 bits")]
            let mantissa = (state >> 11) as f64;
            mantissa / 2.0_f64.powi(53)
        };
        let mut inside = 0;
        for case in 0..300 {
            let mut between = |low: f64, high: f64| low + (high - low) * unit();
            let mut limits = [[f64::NEG_INFINITY, f64::INFINITY]; 6];
            for joint in [3, 5] {
                if case % 3 > 0 {
                    let low = between(-7.0, 4.0);
                    limits[joint] = [low, low + between(0.0, 9.0)];
                }
            }
            let seed: [f64; 6] = core::array::from_fn(|_| between(-8.0, 8.0));
            let q: [f64; 6] = core::array::from_fn(|_| between(-3.0, 3.0));
            let weights: [f64; 6] = core::array::from_fn(|_| between(0.0, 2.0));
            let free = if case % 2 == 0 { FreeJoint::WristSum } else { FreeJoint::WristDifference };
            let pair = Pair::of(free, &q).unwrap();
            let limits = JointLimits::new(limits).unwrap();
            let cost = |angle: f64| {
                let q = limits.wrapped_near(&pair.put(&seed, angle), &seed)?;
                Some(weights[3] * (q[3] - seed[3]).powi(2) + weights[5] * (q[5] - seed[5]).powi(2))
            };
            let least = (-3200..3200)
                .filter_map(|step| cost(1e-3 * f64::from(step)))
                .fold(f64::INFINITY, f64::min);
            let found = pair.nearest(&limits, &seed, &weights).and_then(cost);
            assert!(found.unwrap_or(f64::INFINITY) <= least + 1e-9, "{case}: {found:?} {least}");
            inside += usize::from(least.is_finite());
        }
        assert!(inside > 150, "{inside}");
    }
}
