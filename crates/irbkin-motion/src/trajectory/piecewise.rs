//! A trajectory of several joints: a polynomial in time for each joint between two knots.

use super::axis::AxisMotion;
use super::check::{check_limit, check_positive};
use super::polynomial::{TERMS, derivatives, line, shifted};
use super::sampling::Samples;
use crate::error::{Error, MotionFault};
use crate::paths::thresholds::{MOST_SAMPLES, STEP_ROUNDING};
use crate::prelude::*;
use crate::trajectory::thresholds::{JOINED_POSITION, LIMIT_ROUNDING};
use irbkin::internal::check_length;
use irbkin::internal::lanes::run;

/// Joint angles, velocities and accelerations over time, exact at any time.
///
/// Between two knots each joint is a polynomial of degree six at most, so what lies between two
/// samples is known: limits are checked on the polynomials, not on samples.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "TrajectoryParts")
)]
pub struct Trajectory {
    pub(super) dof: usize,
    /// Where each piece begins [s], and the end: one more than there are pieces.
    pub(super) knots: Vec<f64>,
    /// By piece, by joint: the coefficients in the time since the piece began.
    pub(super) terms: Vec<[f64; TERMS]>,
}

/// A trajectory as it is stored: reading checks it.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(rename = "Trajectory")]
struct TrajectoryParts {
    dof: usize,
    knots: Vec<f64>,
    terms: Vec<[f64; TERMS]>,
}

#[cfg(feature = "serde")]
impl TryFrom<TrajectoryParts> for Trajectory {
    type Error = Error;

    fn try_from(TrajectoryParts { dof, knots, terms }: TrajectoryParts) -> Result<Self, Error> {
        if dof == 0 || knots.len() < 2 {
            return Err(MotionFault::NoJoints { field: "terms" }.into());
        }
        let wanted = dof.saturating_mul(knots.len() - 1);
        check_length("terms", terms.len(), wanted)?;
        let mut before = 0.0;
        for (index, value) in knots.iter().copied().enumerate() {
            if value < before || (index == 0 && value > 0.0) {
                return Err(MotionFault::Order { index, value, before }.into());
            }
            before = value;
        }
        Self::new(dof, knots, terms).checked()
    }
}

impl Trajectory {
    pub(super) fn new(dof: usize, knots: Vec<f64>, terms: Vec<[f64; TERMS]>) -> Self {
        Self { dof, knots, terms }
    }

    /// No motion, over no time.
    pub(super) fn still(q: &[f64]) -> Self {
        let terms = q.iter().map(|position| [*position, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        Self::new(q.len(), vec![0.0, 0.0], terms.collect())
    }

    /// Refuses a trajectory that a double cannot hold: velocities of 1e300, knots of 1e-300 s.
    pub(super) fn checked(self) -> Result<Self, Error> {
        // Without a way out, so that it runs in vectors.
        let are_finite = |numbers: &[f64]| {
            numbers.iter().fold(true, |finite, number| finite & number.is_finite())
        };
        if are_finite(&self.knots) & are_finite(self.terms.as_flattened()) {
            Ok(self)
        } else {
            Err(MotionFault::Overflow.into())
        }
    }

    /// The motions of joints that begin together. A joint that arrives early waits.
    #[must_use]
    pub fn of_axes(axes: &[AxisMotion]) -> Self {
        let mut knots: Vec<f64> = axes.iter().flat_map(AxisMotion::knots).copied().collect();
        knots.push(0.0);
        knots.sort_unstable_by(f64::total_cmp);
        knots.dedup();
        if knots.len() == 1 {
            knots.push(0.0);
        }
        let mut terms = Vec::with_capacity((knots.len() - 1) * axes.len());
        for &start in &knots[..knots.len() - 1] {
            terms.extend(axes.iter().map(|axis| {
                let own = axis.knots();
                let piece = own[..own.len() - 1].iter().rposition(|knot| *knot <= start);
                let piece = piece.unwrap_or(0);
                if start >= axis.duration() && start > 0.0 {
                    let mut still = [0.0; TERMS];
                    still[0] = axis.state(axis.duration()).position;
                    return still;
                }
                match start - own[piece] {
                    0.0 => *axis.terms(piece),
                    since => shifted(axis.terms(piece), since),
                }
            }));
        }
        Self { dof: axes.len(), knots, terms }
    }

    /// The time at a part of a piece, from 0 to 1 [s].
    pub(crate) fn time(&self, piece: usize, part: f64) -> f64 {
        let [from, to] = [self.knots[piece], self.knots[piece + 1]];
        from + part * (to - from)
    }

    /// The line near which a joint is from one part of a piece to another: its angle is `middle + u
    /// turn + e` with |u| <= 1, the same in all joints, and |e| <= `beside` [rad].
    pub(crate) fn line(&self, joint: usize, piece: usize, [from, to]: [f64; 2]) -> [f64; 3] {
        let length = self.knots[piece + 1] - self.knots[piece];
        let terms = &self.terms[piece * self.dof + joint];
        line(&shifted(terms, 0.5 * (from + to) * length), 0.5 * (to - from) * length)
    }

    /// Number of joints.
    #[must_use]
    pub fn dof(&self) -> usize {
        self.dof
    }

    /// So many times from 0 to the duration, evenly spaced [s].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] for fewer than two or more than ten million.
    pub fn times(&self, steps: usize) -> Result<Vec<f64>, Error> {
        let count = u32::try_from(steps).ok().filter(|_| (2..=MOST_SAMPLES).contains(&steps));
        let Some(count) = count else {
            return Err(MotionFault::Steps { found: steps, bounds: [2, MOST_SAMPLES] }.into());
        };
        let (last, duration) = (f64::from(count - 1), self.duration());
        Ok((0..count).map(|step| f64::from(step) / last * duration).collect())
    }

    /// How many of [`Self::times`] are at most `dt` [s] apart.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] unless `dt` is positive.
    pub fn steps_of(&self, dt: f64) -> Result<usize, Error> {
        check_limit("dt", None, dt)?;
        let steps = (self.duration() / dt - STEP_ROUNDING).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 or more")]
        let steps = steps as usize;
        Ok(steps.saturating_add(1))
    }

    /// Duration [s].
    #[must_use]
    pub fn duration(&self) -> f64 {
        self.knots[self.knots.len() - 1]
    }

    /// Where each piece begins [s], and the end.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    pub(crate) fn pieces(&self) -> usize {
        self.knots.len() - 1
    }

    /// Writes joint angles [rad], velocities [rad/s] and accelerations [rad/s^2] at each of `times`
    /// [s], one row of `dof` numbers a time. Before the start and after the end the joints rest.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] for a time that is NaN; [`irbkin::Error::WrongLength`] for a slice of
    /// another length than `times` times `dof`.
    pub fn sample(
        &self,
        times: &[f64],
        q: &mut [f64],
        dq: &mut [f64],
        ddq: &mut [f64],
    ) -> Result<(), Error> {
        for (field, found) in [("q", q.len()), ("dq", dq.len()), ("ddq", ddq.len())] {
            let wanted = times.len() * self.dof;
            check_length(field, found, wanted)?;
        }
        if let Some(index) = times.iter().position(|time| time.is_nan()) {
            return Err(MotionFault::NotFinite { field: "t", index, value: times[index] }.into());
        }
        let Self { dof, ref knots, ref terms } = *self;
        run(Samples { dof, knots, terms, times, rows: [q, dq, ddq] });
        Ok(())
    }

    /// The joint angles at the start and at the end [rad].
    #[must_use]
    pub fn ends(&self) -> [Vec<f64>; 2] {
        let last = self.pieces() - 1;
        let at = |piece: usize, since: f64| {
            let terms = &self.terms[piece * self.dof..][..self.dof];
            terms.iter().map(|terms| derivatives(terms, since)[0]).collect()
        };
        [at(0, 0.0), at(last, self.knots[last + 1] - self.knots[last])]
    }

    /// Change the pace: multiply every time by `factor`.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] when `factor` is not positive and finite.
    pub fn stretched(mut self, factor: f64) -> Result<Self, Error> {
        check_positive("factor", factor)?;
        for knot in &mut self.knots {
            *knot *= factor;
        }
        for terms in &mut self.terms {
            let mut power = 1.0;
            for term in terms {
                *term /= power;
                power *= factor;
            }
        }
        self.checked()
    }

    /// This trajectory, then another one that begins where this one ends.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] when a joint is apart by more than 1e-9 rad, or the
    /// numbers of joints differ.
    pub fn then(mut self, next: &Self) -> Result<Self, Error> {
        check_length("joints", next.dof, self.dof)?;
        let ([_, end], [start, _]) = (self.ends(), next.ends());
        for (index, (end, start)) in end.iter().zip(&start).enumerate() {
            let gap = start - end;
            if gap.abs() > JOINED_POSITION {
                let bound = JOINED_POSITION;
                return Err(MotionFault::Apart { joint: index + 1, gap, bound }.into());
            }
        }
        let offset = self.duration();
        self.knots.extend(next.knots[1..].iter().map(|knot| offset + knot));
        self.terms.extend_from_slice(&next.terms);
        Ok(self)
    }

    pub(super) fn reversed(&self) -> Self {
        let duration = self.duration();
        let knots = self.knots.iter().rev().map(|knot| duration - knot).collect();
        let mut terms = Vec::with_capacity(self.terms.len());
        for piece in (0..self.pieces()).rev() {
            let length = self.knots[piece + 1] - self.knots[piece];
            terms.extend(self.terms[piece * self.dof..][..self.dof].iter().map(|own| {
                let mut own = shifted(own, length);
                own.iter_mut().skip(1).step_by(2).for_each(|odd| *odd = -*odd);
                own
            }));
        }
        Self { dof: self.dof, knots, terms }
    }

    /// The part from one time to another [s], which begins at 0.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidMotion`] unless 0 <= `start` < `end` <= duration.
    pub fn slice(&self, start: f64, end: f64) -> Result<Self, Error> {
        let bound = self.duration();
        // A sum of times may be behind the end by rounding.
        let end = if end <= bound * (1.0 + LIMIT_ROUNDING) { end.min(bound) } else { end };
        if !(0.0 <= start && start < end && end <= bound) {
            return Err(MotionFault::Slice { start, end, bound }.into());
        }
        // A knot belongs to the piece that begins there.
        let first = self.knots[1..self.pieces()].partition_point(|knot| *knot <= start);
        let last = self.knots[..self.pieces()].partition_point(|knot| *knot < end) - 1;
        let mut knots = Vec::with_capacity(last - first + 2);
        knots.push(0.0);
        knots.extend(self.knots[first + 1..=last].iter().map(|knot| knot - start));
        knots.push(end - start);
        let mut terms = self.terms[first * self.dof..(last + 1) * self.dof].to_vec();
        for terms in &mut terms[..self.dof] {
            *terms = shifted(terms, start - self.knots[first]);
        }
        Ok(Self { dof: self.dof, knots, terms })
    }
}
