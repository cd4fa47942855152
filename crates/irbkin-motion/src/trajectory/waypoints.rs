//! Through many joint vectors.

use super::axis::AxisLimits;
use super::check::{check_axes, check_duration, check_finite, check_rows};
use super::piecewise::Trajectory;
use crate::error::{Error, MotionFault};
use crate::prelude::*;
use crate::spline::{Ends, cubic, quintic};
use irbkin::internal::check_length;

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
/// [`Error::InvalidMotion`] for an angle or a time that is not finite, no joints, fewer than two
/// waypoints, times that do not increase or lie too close, or a duration out of bounds;
/// [`irbkin::Error::WrongLength`] for slices that do not fit.
pub fn spline(
    kind: SplineKind,
    waypoints: &[f64],
    dof: usize,
    times: &[f64],
) -> Result<Trajectory, Error> {
    check_rows("q", waypoints, dof)?;
    let wanted = dof * times.len();
    check_length("q", waypoints.len(), wanted)?;
    if times.len() < 2 {
        return Err(MotionFault::TooFew { field: "q", found: times.len(), least: 2 }.into());
    }
    check_finite("t", times)?;
    if let Some(index) = (1..times.len()).find(|index| times[*index] <= times[index - 1]) {
        let (value, before) = (times[index], times[index - 1]);
        return Err(MotionFault::Order { index, value, before }.into());
    }
    let knots: Vec<f64> = times.iter().map(|time| time - times[0]).collect();
    check_duration(knots[knots.len() - 1])?;
    curve(kind, waypoints, dof, knots).checked()
}

/// The curve through waypoints at knots, the first of which is 0.
fn curve(kind: SplineKind, waypoints: &[f64], dof: usize, knots: Vec<f64>) -> Trajectory {
    let rest = vec![0.0; dof];
    let terms = match kind {
        SplineKind::Cubic => cubic(&knots, waypoints, dof, Ends::Clamped([&rest, &rest])),
        SplineKind::Quintic => quintic(&knots, waypoints, dof),
    };
    Trajectory::new(dof, knots, terms)
}

/// A curve through waypoints at times of its own, or by a duration [s], or as fast as limits allow.
///
/// Without times the waypoints are spaced by their distances: by the time that the slowest joint
/// takes at full velocity or, without limits of velocity, by the length of the polygon.
///
/// # Errors
///
/// As [`spline`]; [`Error::InvalidMotion`] too for waypoints that repeat the one before them, a
/// limit that is not positive or that is exceeded, and a motion that nothing limits.
pub fn through(
    kind: SplineKind,
    waypoints: &[f64],
    dof: usize,
    times: Option<&[f64]>,
    duration: Option<f64>,
    limits: &[AxisLimits],
) -> Result<Trajectory, Error> {
    check_axes(limits, dof)?;
    if let Some(times) = times {
        let motion = spline(kind, waypoints, dof, times)?;
        return motion.within(limits).map(|()| motion);
    }
    let motion = curve(kind, waypoints, dof, spaced(waypoints, dof, limits)?);
    if let Some(duration) = duration {
        check_duration(duration)?;
        let motion = motion.stretched(duration)?;
        return motion.within(limits).map(|()| motion);
    }
    // A pace k times slower has k, k^2 and k^3 times smaller derivatives.
    let peaks = motion.peaks();
    let factor = peaks.iter().zip(limits).map(|(peaks, limits)| {
        (peaks.velocity / limits.velocity)
            .max((peaks.acceleration / limits.acceleration).sqrt())
            .max((peaks.jerk / limits.jerk).cbrt())
    });
    let factor = factor.fold(0.0, f64::max);
    if factor == 0.0 {
        return Err(MotionFault::NoDuration { joint: 1 }.into());
    }
    check_duration(factor)?;
    motion.stretched(factor)
}

/// Times of waypoints by their distances, of a duration of 1 s.
fn spaced(waypoints: &[f64], dof: usize, limits: &[AxisLimits]) -> Result<Vec<f64>, Error> {
    check_rows("q", waypoints, dof)?;
    let found = waypoints.len() / dof;
    if found < 2 {
        return Err(MotionFault::TooFew { field: "q", found, least: 2 }.into());
    }
    let has_velocity = limits.iter().all(|limits| limits.velocity.is_finite());
    let mut times = vec![0.0];
    let rows = waypoints.chunks_exact(dof);
    for (index, (row, before)) in rows.clone().skip(1).zip(rows).enumerate() {
        let ways = row.iter().zip(before).map(|(to, from)| (to - from).abs());
        let time = if has_velocity {
            ways.zip(limits).map(|(way, own)| way / own.velocity).fold(0.0, f64::max)
        } else {
            ways.map(|way| way * way).sum::<f64>().sqrt()
        };
        if time == 0.0 {
            return Err(MotionFault::Repeats { index: index + 1 }.into());
        }
        times.push(times[index] + time);
    }
    let whole = times[times.len() - 1];
    Ok(times.into_iter().map(|time| time / whole).collect())
}
