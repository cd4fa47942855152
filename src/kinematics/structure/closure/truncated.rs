//! Newton's method by truncated singular value decomposition: next to configurations that are
//! singular in several directions, where the whole step points anywhere (general.md, eq. 104b).

use nalgebra::SVector;

use super::chain::{Closure, Target};
use super::configuration::Configuration;

/// Singular value below which a direction is left out [1]. Next to three solutions that merge, one
/// is the residual to the power of two thirds: 1e-9 where it closes.
const LEAST: f64 = 1e-11;

/// Largest step [rad].
const MOST_STEP: f64 = 0.1;

/// Steps at most: where solutions merge, a step goes part of the way.
const MOST_STEPS: usize = 40;

/// Sweeps of a singular value decomposition, at most.
const SWEEPS: usize = 60;

impl Closure {
    /// Return a configuration that closes next to an approximate one, if steps lead to one.
    pub(super) fn closing(&self, target: &Target, theta: &[f64; 6]) -> Option<Configuration> {
        let (mut theta, mut best) = (SVector::from(*theta), None::<Configuration>);
        for _ in 0..MOST_STEPS {
            let (jacobian, missing) = self.linear(target, &theta.into());
            let svd = jacobian.try_svd(true, true, f64::EPSILON, SWEEPS)?;
            let least = svd.singular_values[5];
            let residual = self.residual(target, &theta.into());
            if residual <= self.accepts() {
                // As long as it gets better.
                if best.is_some_and(|best| best.residual < 2.0 * residual) {
                    break;
                }
                best = Some(Configuration { theta: theta.into(), residual, least, moving: None });
            }
            let (u, v_t) = (svd.u?, svd.v_t?);
            let mut step = SVector::<f64, 6>::zeros();
            for (row, value) in svd.singular_values.iter().enumerate() {
                if *value > LEAST {
                    step += v_t.row(row).transpose() * (u.column(row).dot(&missing) / value);
                }
            }
            theta += step * (MOST_STEP / step.norm().max(MOST_STEP));
        }
        best
    }
}
