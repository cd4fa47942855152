//! Joints that a pose leaves undetermined besides joint 7: at a singularity, whole self-motions
//! reach it.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{SMatrix, SVector};

use super::Search;
use super::samples::Sample;
use crate::error::Error;
use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::solve::self_motion_curve::Joints;

/// Steps to the nearest joint vector that leaves the tool in place: each of the seven joints may
/// reach a limit.
const SLIDES: u32 = 16;

/// Sweeps of the singular value decomposition of a Jacobian.
const SWEEPS: usize = 100;

/// Least relative gain of a step in cost to be followed by another [1].
pub(super) const LEAST_GAIN: f64 = 1e-12;

/// Singular values of the Jacobian, relative to the greatest, below which joints do not move the
/// tool [1]: values between rounding and this belong to a curve that descents follow.
const STILL: f64 = 1e-6;

/// Least weight of a joint relative to the greatest [1]: a joint of zero weight has no measure.
const LEAST_WEIGHT: f64 = 1e-8;

/// Weight of a joint that is locked at its limit [1].
pub(super) const LOCKED: f64 = 1e24;

/// The motions of the joints in the metric of the weights: each angle times the root of its weight.
pub(super) struct Scaled {
    pub(super) roots: Joints,
    /// From the joints to the seed.
    pub(super) way: Joints,
    /// How far the tool moves with each of the six motions in `rows`, its singular values.
    pub(super) sizes: SVector<f64, 6>,
    pub(super) rows: SMatrix<f64, 6, 7>,
}

/// Weights of which none is zero.
pub(super) fn measured(weights: &[f64; 7]) -> [f64; 7] {
    let most = weights.iter().copied().fold(0.0, f64::max);
    weights.map(|weight| weight.max(LEAST_WEIGHT * most))
}

/// A Jacobian in the metric of the weights with these roots.
pub(super) fn in_metric(mut jacobian: SMatrix<f64, 6, 7>, roots: &Joints) -> SMatrix<f64, 6, 7> {
    for mut row in jacobian.row_iter_mut() {
        row.component_div_assign(&roots.transpose());
    }
    jacobian
}

impl Search<'_> {
    /// Search the nearest of the joint vectors among which the undetermined joints choose, starting
    /// from a sample's.
    pub(super) fn choose_free_joints(&mut self, sample: &Sample) -> Result<(), Error> {
        if !self.are_named {
            self.choose_member(sample);
            return Ok(());
        }
        self.turn_in_line(&sample.q)?;
        self.slide(*sample)
    }

    /// Move to the point nearest to the seed that leaves the tool in place, and continue from
    /// there. Several undetermined joints at once, joint 7 among them, turn about one line, so the
    /// pose determines only the sum of their angles: the first step is the last. A joint that
    /// reaches a limit is locked there.
    pub(super) fn slide(&mut self, from: Sample) -> Result<(), Error> {
        let (mut best, mut weights) = (from, self.weights);
        for _ in 0..SLIDES {
            let Some(way) = self.still_tool(&best.q, &weights) else { return Ok(()) };
            let (part, blocked) = self.inside_part(&best.q, &way, &weights);
            let rest = core::array::from_fn(|joint| best.q[joint] + part * way[joint]);
            let found = self.samples(&rest)?.best();
            let gains = found.is_some_and(|found| {
                (found.outside, found.cost) < (best.outside, best.cost * (1.0 - LEAST_GAIN))
            });
            if let Some(found) = found.filter(|_| gains) {
                best = found;
            }
            match blocked {
                Some(joint) => weights[joint] = LOCKED,
                None if gains => {}
                None => return Ok(()),
            }
        }
        Ok(())
    }

    /// The part of the way to the seed that does not move the tool, without small moves of it: in
    /// the metric of `weights`, the nearest point in the seed's linear neighborhood.
    pub(super) fn still_tool(&self, q: &[f64; 7], weights: &[f64; 7]) -> Option<[f64; 7]> {
        let Scaled { roots, mut way, sizes, rows } = self.scaled(q, weights)?;
        let greatest = sizes.max();
        for (row, size) in rows.row_iter().zip(&sizes) {
            if *size > STILL * greatest {
                way -= row.transpose() * (row * way)[0];
            }
        }
        Some(way.component_div(&roots).into())
    }

    /// The motions of the joints at `q` in the metric of `weights`.
    pub(super) fn scaled(&self, q: &[f64; 7], weights: &[f64; 7]) -> Option<Scaled> {
        let roots = Joints::from(measured(weights).map(f64::sqrt));
        let way = (Joints::from(self.seed) - Joints::from(*q)).component_mul(&roots);
        let jacobian = in_metric(self.robot.jacobian(q, JacobianFrame::Base), &roots);
        let svd = jacobian.try_svd(false, true, f64::EPSILON, SWEEPS)?;
        Some(Scaled { roots, way, sizes: svd.singular_values, rows: svd.v_t? })
    }

    /// The fraction of a way that stays inside the limits, and the joint that ends it.
    pub(super) fn inside_part(
        &self,
        q: &[f64; 7],
        way: &[f64; 7],
        weights: &[f64; 7],
    ) -> (f64, Option<usize>) {
        let mut first = (1.0, None);
        for (joint, [low, high]) in self.robot.limits().to_array().into_iter().enumerate() {
            let limit = if way[joint] < 0.0 { low } else { high };
            let part = ((limit - q[joint]) / way[joint]).max(0.0);
            if part < first.0 && weights[joint] != LOCKED {
                first = (part, Some(joint));
            }
        }
        first
    }
}
