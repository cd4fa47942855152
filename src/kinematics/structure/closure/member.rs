//! A member of a self-motion, and the next one.
//!
//! Docs: general.md, eq. 103.

use nalgebra::{SMatrix, SVector};

use super::chain::{Closure, Target, largest, sines};
use super::fold::{SECOND, SWEEPS};

/// Steps of Newton's method to a member, at most.
const MOST_CORRECTIONS: usize = 8;

/// Correction of a member that is its last [rad]: the next would be its square.
const CONVERGED: f64 = 1e-8;

/// A member of a self-motion.
#[derive(Clone, Copy)]
pub(crate) struct Member {
    pub(crate) theta: [f64; 6],
    /// By how much each joint moves there, as a unit vector.
    pub(super) direction: [f64; 6],
}

impl Closure {
    /// The member that is s ahead of another one along its direction (eq. 103), by Newton's method
    /// from a guess.
    pub(super) fn member_ahead(
        &self,
        target: &Target,
        from: &Member,
        s: f64,
        guess: [f64; 6],
    ) -> Option<Member> {
        let along = SVector::from(from.direction);
        let mut theta = guess;
        for _ in 0..MOST_CORRECTIONS {
            let (jacobian, missing) = self.linear(target, &theta);
            let mut conditions = SMatrix::<f64, 7, 6>::zeros();
            conditions.fixed_rows_mut::<6>(0).copy_from(&jacobian);
            conditions.fixed_rows_mut::<1>(6).copy_from(&along.transpose());
            // The correction, and the derivatives by s.
            let mut right = SMatrix::<f64, 7, 2>::zeros();
            right.fixed_view_mut::<6, 1>(0, 0).copy_from(&missing);
            let done: f64 = (0..6).map(|i| along[i] * (theta[i] - from.theta[i])).sum();
            (right[(6, 0)], right[(6, 1)]) = (s - done, 1.0);
            let solved = least_squares(&conditions, right)?;
            let correction = solved.column(0).amax();
            if correction.is_nan() || correction > 1.0 {
                return None;
            }
            for joint in 0..6 {
                theta[joint] += solved[(joint, 0)];
            }
            if correction < CONVERGED {
                let direction = solved.column(1).normalize().into();
                return self.closes(target, &theta).then_some(Member { theta, direction });
            }
        }
        None
    }

    fn closes(&self, target: &Target, theta: &[f64; 6]) -> bool {
        let (sin, cos) = sines(theta);
        largest(&self.missing(target, &sin, &cos)) <= self.accepts()
    }
}

/// The joint vectors that meet the conditions best. Where self-motions cross, of all that do the
/// shortest.
fn least_squares(
    conditions: &SMatrix<f64, 7, 6>,
    mut right: SMatrix<f64, 7, 2>,
) -> Option<SMatrix<f64, 6, 2>> {
    let qr = conditions.qr();
    let triangle = qr.r();
    if triangle.diagonal().amin() < SECOND {
        let svd = conditions.try_svd(true, true, f64::EPSILON, SWEEPS)?;
        return svd.solve(&right, SECOND).ok();
    }
    qr.q_tr_mul(&mut right);
    triangle.solve_upper_triangular(&right.fixed_rows::<6>(0).into_owned())
}

/// The place at a part of the way between two members, by a cubic polynomial.
pub(super) fn interpolated(ends: [&Member; 2], part: f64) -> SVector<f64, 6> {
    let [one, next] = ends.map(|end| SVector::from(end.theta));
    let [ahead, behind] = ends.map(|end| SVector::from(end.direction));
    // The arc is longer than its chord, by what its direction changes.
    let length = (next - one).norm() * (1.0 + (behind - ahead).norm_squared() / 24.0);
    let rest = 1.0 - part;
    one * (rest * rest * (1.0 + 2.0 * part))
        + next * (part * part * (1.0 + 2.0 * rest))
        + (ahead * rest - behind * part) * (part * rest * length)
}
