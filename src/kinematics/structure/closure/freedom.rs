//! Whether six joints move the last frame in six independent ways.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::chain::Closure;
use crate::kinematics::chain::dh::DhRow;
use crate::kinematics::thresholds::FORM_TOLERANCE;
use crate::report::{Freedom, UnknownStructure};

/// Least singular value that is a freedom [1]. Arms with lengths of some use have more than
/// 1e-3 somewhere.
const LEAST: f64 = 1e-8;

/// Joint angles at which the freedoms are counted [rad]: in no particular position.
const PLACES: [[f64; 6]; 4] = [
    [0.3, 0.7, -1.1, 0.9, 1.3, -0.4],
    [-1.9, 1.2, 0.8, -2.2, 0.6, 1.7],
    [2.6, -0.5, 1.9, 1.4, -1.6, 0.2],
    [0.9, 2.3, -2.7, -0.6, 2.1, 2.9],
];

impl Closure {
    /// Check that the joints are independent somewhere; otherwise what of the rows is the reason.
    pub(crate) fn check_freedom(&self, rows: &[DhRow; 6]) -> Result<(), UnknownStructure> {
        let count = |theta: &[f64; 6]| {
            let values = self.derivatives(theta).singular_values();
            values.iter().filter(|value| **value > LEAST).count()
        };
        let mut freedoms = 0;
        for theta in &PLACES {
            freedoms = freedoms.max(count(theta));
            if freedoms == 6 {
                return Ok(());
            }
        }
        Err(UnknownStructure::freedom(reason(rows), freedoms))
    }
}

/// The first reason why joints are not independent.
fn reason(rows: &[DhRow; 6]) -> Freedom {
    let is_zero = |length: f64| length.abs() <= FORM_TOLERANCE;
    if rows.iter().all(|row| is_zero(row.a) && is_zero(row.d)) {
        return Freedom::NoLengths;
    }
    let is_parallel = |row: &DhRow| {
        let turns = row.alpha / PI;
        (turns - turns.round()).abs() * PI <= FORM_TOLERANCE
    };
    let parallel: [bool; 6] = rows.map(|row| is_parallel(&row));
    for (joint, row) in rows.iter().enumerate().skip(1) {
        if parallel[joint] && is_zero(row.a) {
            return Freedom::OneLine(joint);
        }
    }
    for joint in 1..4 {
        if parallel[joint..joint + 3].iter().all(|is_parallel| *is_parallel) {
            return Freedom::FourParallel(joint);
        }
    }
    Freedom::Other
}
