//! How many poses a path has.

use crate::error::{Error, MotionFault};
use crate::paths::thresholds::{MOST_SAMPLES, STEP_ROUNDING};
use crate::prelude::*;
use crate::trajectory::check::{check_limit, check_positive};

/// How the poses of a path are spaced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacing(Kind);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Count(usize),
    Step { length: f64, angle: f64 },
}

impl Spacing {
    /// So many poses, both ends included.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] for fewer than two or more than ten million.
    pub fn count(poses: usize) -> Result<Self, Error> {
        if !(2..=MOST_SAMPLES).contains(&poses) {
            return Err(MotionFault::Steps { found: poses, bounds: [2, MOST_SAMPLES] }.into());
        }
        Ok(Self(Kind::Count(poses)))
    }

    /// Steps of at most a length [m], in which the tool turns by at most an angle [rad]; infinity
    /// where one of them does not count.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] unless both are positive and one is finite.
    pub fn step(length: f64, angle: f64) -> Result<Self, Error> {
        check_limit("step", None, length)?;
        check_limit("turn", None, angle)?;
        check_positive("step or turn", length.min(angle))?;
        Ok(Self(Kind::Step { length, angle }))
    }

    /// Steps that the tool takes in a period [s] at a speed [m/s], in which it turns by at most an
    /// angle [rad]: [`Self::step`] of `speed * period`. So poses a period apart move the tool at
    /// that speed or, where its way has a fraction of a step, a little slower.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] unless speed and period are positive and finite and the angle is
    /// positive.
    pub fn speed(speed: f64, period: f64, angle: f64) -> Result<Self, Error> {
        for (field, value) in [("speed", speed), ("dt", period), ("speed * dt", speed * period)] {
            check_positive(field, value)?;
        }
        Self::step(speed * period, angle)
    }

    /// Whether the number of steps follows from the angles of the parts.
    pub(super) fn is_by_angle(self) -> bool {
        matches!(self.0, Kind::Step { angle, .. } if angle.is_finite())
    }

    /// The number of steps of a path of one part, by its length [m] and angle [rad].
    #[doc(hidden)]
    pub fn steps_of_one(self, part: [f64; 2]) -> Result<usize, Error> {
        match self.0 {
            Kind::Count(poses) => Ok(poses - 1),
            Kind::Step { length, angle } => counted(part, length, angle),
        }
    }

    /// The number of steps of each part of a path, by its length [m] and angle [rad].
    pub(super) fn steps(self, parts: &[[f64; 2]]) -> Result<Vec<usize>, Error> {
        match self.0 {
            Kind::Count(poses) => shared(poses - 1, parts),
            Kind::Step { length, angle } => {
                parts.iter().map(|part| counted(*part, length, angle)).collect()
            }
        }
    }
}

/// Steps that are short enough: one at least where anything moves.
fn counted([length, angle]: [f64; 2], step: f64, turn: f64) -> Result<usize, Error> {
    let steps = (length / step).max(angle / turn);
    #[expect(clippy::cast_precision_loss, reason = "exact")]
    let most = MOST_SAMPLES as f64;
    if steps > most {
        return Err(MotionFault::TooMany { found: steps, most }.into());
    }
    if length == 0.0 && angle == 0.0 {
        return Ok(0);
    }
    if steps == 0.0 {
        return Err(MotionFault::NoStep { length, angle }.into());
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 1e7")]
    let steps = (steps - STEP_ROUNDING).ceil().max(1.0) as usize;
    Ok(steps)
}

/// Steps shared among parts by their lengths, one at least for each.
fn shared(steps: usize, parts: &[[f64; 2]]) -> Result<Vec<usize>, Error> {
    if steps < parts.len() {
        return Err(MotionFault::Steps {
            found: steps + 1,
            bounds: [parts.len() + 1, MOST_SAMPLES],
        }
        .into());
    }
    let total: [f64; 2] =
        parts.iter().fold([0.0; 2], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    // A part where the tool only turns counts by its angle.
    let index = usize::from(total[0] == 0.0);
    let mut left = (total[index], steps);
    let mut counts = Vec::with_capacity(parts.len());
    for (number, part) in parts.iter().enumerate() {
        let rest = parts.len() - 1 - number;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "a part of a count"
        )]
        let share = if left.0 > 0.0 { (part[index] / left.0 * left.1 as f64).round() } else { 1.0 }
            as usize;
        let count = if rest == 0 { left.1 } else { share.clamp(1, left.1 - rest) };
        counts.push(count);
        left = ((left.0 - part[index]).max(0.0), left.1 - count);
    }
    Ok(counts)
}
