//! The extremes of a trajectory between its samples too, and the limits that they keep.

use super::axis::AxisLimits;
use super::check::check_axes;
use super::piecewise::Trajectory;
use super::polynomial::{TERMS, derivative, extremes, hull, largest_size, size_bound};
use crate::error::{Error, MotionFault};
use crate::prelude::*;
use crate::trajectory::thresholds::{JOINED_POSITION, LIMIT_ROUNDING};
use irbkin::internal::check_length;

/// The largest velocity, acceleration and jerk of a joint.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peaks {
    /// Velocity [rad/s].
    pub velocity: f64,
    /// Acceleration [rad/s^2].
    pub acceleration: f64,
    /// Jerk [rad/s^3] inside the pieces: a jump of the acceleration at a knot does not count.
    pub jerk: f64,
}

impl Trajectory {
    /// The largest velocity, acceleration and jerk of each joint: exact, not of samples.
    #[must_use]
    pub fn peaks(&self) -> Vec<Peaks> {
        let mut peaks = vec![Peaks::default(); self.dof];
        for piece in 0..self.pieces() {
            let length = self.knots[piece + 1] - self.knots[piece];
            for (joint, peaks) in peaks.iter_mut().enumerate() {
                let velocity = derivative(&self.terms[piece * self.dof + joint]);
                let acceleration = derivative(&velocity);
                let jerk = derivative(&acceleration);
                for (peak, polynomial) in [
                    (&mut peaks.velocity, velocity),
                    (&mut peaks.acceleration, acceleration),
                    (&mut peaks.jerk, jerk),
                ] {
                    // Most of many pieces cannot be the one with the peak.
                    if size_bound(&polynomial, length) > *peak {
                        *peak = peak.max(largest_size(&polynomial, length));
                    }
                }
            }
        }
        peaks
    }

    /// For each piece how much slower it must be to keep limits [1]; less than one where it may be
    /// faster.
    pub(super) fn excesses(&self, limits: &[AxisLimits]) -> Vec<f64> {
        let excess = |(_, length, terms): (f64, f64, &[[f64; TERMS]])| {
            terms.iter().zip(limits).fold(0.0_f64, |most, (terms, limits)| {
                let velocity = derivative(terms);
                let acceleration = derivative(&velocity);
                let jerk = derivative(&acceleration);
                most.max(size_bound(&velocity, length) / limits.velocity)
                    .max((size_bound(&acceleration, length) / limits.acceleration).sqrt())
                    .max((size_bound(&jerk, length) / limits.jerk).cbrt())
            })
        };
        self.timed_pieces().map(excess).collect()
    }

    /// The least and the greatest angle of each joint [rad]: exact, not of samples.
    #[must_use]
    pub fn range(&self) -> Vec<[f64; 2]> {
        let mut range = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.dof];
        for (_, length, terms) in self.timed_pieces() {
            for ([least, most], terms) in range.iter_mut().zip(terms) {
                let [low, high] = hull(terms, length);
                if low < *least || high > *most {
                    let [[_, low], [_, high]] = extremes(terms, length);
                    (*least, *most) = (least.min(low), most.max(high));
                }
            }
        }
        range
    }

    /// Refuses a motion that exceeds a limit of a joint by more than rounding.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] with the joint, its largest velocity, acceleration or jerk and the
    /// limit; [`irbkin::Error::WrongLength`] for another number of limits than of joints.
    pub fn within(&self, limits: &[AxisLimits]) -> Result<(), Error> {
        check_axes(limits, self.dof)?;
        let is_open = |limits: &AxisLimits| {
            limits.velocity.min(limits.acceleration).min(limits.jerk).is_infinite()
        };
        if limits.iter().all(is_open) {
            return Ok(());
        }
        for (index, (peaks, limits)) in self.peaks().iter().zip(limits).enumerate() {
            for (what, value, limit) in [
                ("velocity", peaks.velocity, limits.velocity),
                ("acceleration", peaks.acceleration, limits.acceleration),
                ("jerk", peaks.jerk, limits.jerk),
            ] {
                if value > limit * (1.0 + LIMIT_ROUNDING) {
                    return Err(
                        MotionFault::AboveLimit { joint: index + 1, what, value, limit }.into()
                    );
                }
            }
        }
        Ok(())
    }

    /// Refuses a motion that leaves the limits of a joint by more than 1e-9 rad, between waypoints
    /// too.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] with the joint that leaves them farthest, the time, its angle there
    /// and the limit, or for limits that are not lower and upper; [`irbkin::Error::WrongLength`] for another
    /// number of limits than of joints.
    pub fn inside(&self, limits: &[[f64; 2]]) -> Result<(), Error> {
        check_length("limits", limits.len(), self.dof)?;
        for (index, [lower, upper]) in limits.iter().copied().enumerate() {
            if lower.is_nan() || upper.is_nan() || lower > upper {
                return Err(MotionFault::EmptyLimit { joint: index + 1, lower, upper }.into());
            }
        }
        let (mut farthest, mut fault) = (JOINED_POSITION, None);
        for (start, length, terms) in self.timed_pieces() {
            for (index, ([lower, upper], terms)) in limits.iter().zip(terms).enumerate() {
                let [low, high] = hull(terms, length);
                if low >= lower - farthest && high <= upper + farthest {
                    continue;
                }
                let [[at_least, least], [at_most, most]] = extremes(terms, length);
                for (excess, since, value, limit) in [
                    (lower - least, at_least, least, *lower),
                    (most - upper, at_most, most, *upper),
                ] {
                    if excess > farthest {
                        let (joint, time) = (index + 1, start + since);
                        farthest = excess;
                        fault = Some(MotionFault::Outside { joint, time, value, limit });
                    }
                }
            }
        }
        fault.map_or(Ok(()), |fault| Err(fault.into()))
    }

    /// When each piece begins, its duration, and the polynomial of each joint.
    fn timed_pieces(&self) -> impl Iterator<Item = (f64, f64, &[[f64; TERMS]])> {
        let lengths = self.knots.windows(2).map(|ends| (ends[0], ends[1] - ends[0]));
        lengths
            .zip(self.terms.chunks_exact(self.dof))
            .map(|((start, length), terms)| (start, length, terms))
    }
}
