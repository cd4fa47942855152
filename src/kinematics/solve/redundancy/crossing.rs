//! The other branch of a curve of self-motion that nearly crosses itself.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::Search;
use super::free_joints::Scaled;
use crate::kinematics::solve::self_motion_curve::{Joints, Point};
use crate::kinematics::thresholds::NEAR_CROSSING;

/// Crossings that are looked at, each from a point that is nearer to the seed than the last.
const CROSSINGS: u32 = 4;

/// First step of a descent near a crossing [rad]: a longer one leads past the bend of its branch.
const FIRST_STEP: f64 = 1e-5;

impl Search<'_> {
    /// Where the curve nearly crosses itself at the best point, descend on both of its branches.
    pub(super) fn look_across(&mut self) {
        for _ in 0..CROSSINGS {
            let Some((cost, q)) = self.best.filter(|(cost, q)| *cost > 0.0 && self.may_cross(q))
            else {
                return;
            };
            for start in self.branches_near(&q).into_iter().flatten().flatten() {
                self.descend(start, FIRST_STEP);
            }
            if self.best.is_none_or(|(least, _)| least >= cost) {
                return;
            }
        }
    }

    /// Whether the arm with joint 7 fixed is near a singularity: away from it, the curve does not
    /// cross itself.
    fn may_cross(&self, q: &[f64; 7]) -> bool {
        // The singular values decide where the singularities have no names.
        self.robot.singular_distances(q).is_none_or(|distances| {
            distances.wrist.min(distances.elbow).min(distances.shoulder) <= NEAR_CROSSING
        })
    }

    /// A point of the curve, and points of other branches nearby that are nearest to the seed (eq.
    /// 74); `None` if no branch is nearby.
    fn branches_near(&self, q: &[f64; 7]) -> Option<[Option<Point>; 7]> {
        let Scaled { roots, way, sizes, rows } = self.scaled(q, &self.weights)?;
        let (greatest, q) = (sizes.max(), Joints::from(*q));
        if sizes.min() > NEAR_CROSSING * greatest {
            return None;
        }
        let mut branches = [None; 7];
        for (branch, (row, size)) in branches[1..].iter_mut().zip(rows.row_iter().zip(&sizes)) {
            let across = row.transpose() * (row * way)[0];
            if *size <= NEAR_CROSSING * greatest && across.norm() > 0.0 {
                let border = across.component_mul(&roots);
                let start = q + across.component_div(&roots);
                *branch = self.curve.across(&start, &(border / border.norm()));
            }
        }
        branches[0] = self.curve.nearest(&q);
        Some(branches)
    }
}
