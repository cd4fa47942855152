//! A member of a self-motion, and the next one.
//!
//! Docs: general.md, eq. 103.

use nalgebra::{SMatrix, SVector};

use super::chain::{Closure, Target, largest, sines};
use super::curve::SECOND;

/// Steps of Newton's method to a member, at most.
const MOST_CORRECTIONS: usize = 8;

/// Sweeps of a singular value decomposition, at most.
pub(super) const SWEEPS: usize = 60;

/// Correction of a member that is its last [rad]: the next would be its square.
const CONVERGED: f64 = 1e-8;

/// A member of a self-motion.
#[derive(Clone, Copy)]
pub(crate) struct Member {
    pub(crate) theta: [f64; 6],
    /// By how much each joint moves there, as a unit vector.
    pub(super) direction: [f64; 6],
}

impl Member {
    /// Whether no joint differs by more than this [rad].
    pub(super) fn is_within(&self, radius: f64, theta: &[f64; 6]) -> bool {
        self.theta.iter().zip(theta).all(|(a, b)| (a - b).abs() <= radius)
    }
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
            let done: f64 = (0..6).map(|i| along[i] * (theta[i] - from.theta[i])).sum();
            let (correction, ahead) = least_squares(&jacobian, &missing, &along, s - done)?;
            let size = correction.amax();
            if size.is_nan() || size > 1.0 {
                return None;
            }
            for joint in 0..6 {
                theta[joint] += correction[joint];
            }
            if size < CONVERGED {
                let direction = ahead.normalize().into();
                return self.closes(target, &theta).then_some(Member { theta, direction });
            }
        }
        None
    }

    pub(super) fn closes(&self, target: &Target, theta: &[f64; 6]) -> bool {
        let (sin, cos) = sines(theta);
        largest(&self.missing(target, &sin, &cos)) <= self.accepts()
    }
}

/// The correction that meets the conditions and the step along a direction best, and its derivative
/// by the step: by the normal equations. Where self-motions cross, of all that do the shortest.
fn least_squares(
    jacobian: &SMatrix<f64, 6, 6>,
    missing: &SVector<f64, 6>,
    along: &SVector<f64, 6>,
    step: f64,
) -> Option<(SVector<f64, 6>, SVector<f64, 6>)> {
    let normal = jacobian.transpose() * jacobian + along * along.transpose();
    if let Some(triangle) = normal.cholesky()
        && triangle.l_dirty().diagonal().amin() > SECOND
    {
        let right = jacobian.transpose() * missing + along * step;
        return Some((triangle.solve(&right), triangle.solve(along)));
    }
    let svd = jacobian.try_svd(true, true, f64::EPSILON, SWEEPS)?;
    let (u, v_t) = (svd.u?, svd.v_t?);
    let mut shortest = SVector::<f64, 6>::zeros();
    for (row, value) in svd.singular_values.iter().enumerate().filter(|(_, value)| **value > SECOND)
    {
        shortest += v_t.row(row).transpose() * (u.column(row).dot(missing) / value);
    }
    Some((shortest + along * (step - along.dot(&shortest)), *along))
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
