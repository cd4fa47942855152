//! Through many joint vectors.

use alloc::vec::Vec;

use super::limits::check_finite;
use super::piecewise::Trajectory;
use super::spline::{Ends, cubic, quintic};
use crate::error::{Error, MotionFault};

/// How smooth a curve through waypoints is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum SplineKind {
    /// Cubic pieces: acceleration is continuous, and jumps at the ends.
    Cubic,
    /// Quintic pieces: acceleration is zero at the ends; jerk and its derivative are continuous.
    Quintic,
}

/// A curve through waypoints, a row of `dof` numbers each [rad], at given times [s], at rest at
/// both ends.
///
/// # Errors
///
/// [`Error::InvalidMotion`] for a number that is not finite, fewer than two waypoints, or times
/// that do not increase; [`Error::WrongLength`] for slices that do not fit.
pub fn spline(
    kind: SplineKind,
    waypoints: &[f64],
    dof: usize,
    times: &[f64],
) -> Result<Trajectory, Error> {
    let wanted = dof * times.len();
    if dof == 0 || waypoints.len() != wanted {
        return Err(Error::WrongLength { field: "q", found: waypoints.len(), wanted });
    }
    if times.len() < 2 {
        return Err(MotionFault::TooFew { field: "q", found: times.len(), least: 2 }.into());
    }
    check_finite("q", waypoints)?;
    check_finite("t", times)?;
    if let Some(index) = (1..times.len()).find(|index| times[*index] <= times[index - 1]) {
        let (value, before) = (times[index], times[index - 1]);
        return Err(MotionFault::Order { index, value, before }.into());
    }
    let knots: Vec<f64> = times.iter().map(|time| time - times[0]).collect();
    let rest = alloc::vec![0.0; dof];
    let terms = match kind {
        SplineKind::Cubic => cubic(&knots, waypoints, dof, Ends::Clamped([&rest, &rest])),
        SplineKind::Quintic => quintic(&knots, waypoints, dof),
    };
    Ok(Trajectory::new(dof, knots, terms))
}
