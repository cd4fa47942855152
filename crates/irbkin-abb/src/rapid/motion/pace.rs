//! The times of a motion: programmed speeds, slowed where a joint would be too fast.

use alloc::string::ToString;
use alloc::vec::Vec;
use alloc::{format, vec};

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::drive::{Drive, Made};
use super::goal::Goal;
use super::joints::Samples;
use crate::Error;
use crate::rapid::data::finding::{Code, Finding};
use crate::rapid::motion::thresholds::{JOINED_MOVES, MOST_ACCELERATION};
use irbkin_motion::internal::{
    LEAST_WAY, LIMIT_ROUNDING, MOST_DURATION, MotionFault, evenly, within_times,
};
use irbkin_motion::trajectory::Trajectory;

/// A motion to be timed.
pub(super) struct Pace<'a, 'm, const N: usize> {
    pub(super) samples: &'a Samples<N>,
    pub(super) goals: &'a [Goal<'m, N>],
    pub(super) made: &'a [Made<N>],
    pub(super) max_velocity: &'a [f64; N],
    pub(super) findings: &'a mut Vec<Finding>,
}

/// A joint that is too fast at the programmed speed, or at what the length of a line allows.
#[derive(Clone, Copy)]
struct TooFast {
    joint: usize,
    /// Its speed as a part of its limit [1].
    excess: f64,
    /// The speed that the length allows there, if it is below the programmed one [m/s].
    allowed: Option<f64>,
}

impl<const N: usize> Drive<'_, '_, N> {
    /// Find a joint that is too fast at the programmed speed of a move.
    pub(in crate::rapid) fn check_speed(&mut self, index: usize, max_velocity: &[f64; N]) {
        let Self { goals, samples, made, findings, .. } = self;
        let mut least = vec![0.0; samples.q.len()];
        Pace { samples, goals, made, max_velocity, findings }.add_times(index, &mut least);
    }
}

impl<const N: usize> Pace<'_, '_, N> {
    /// The trajectory, and the time of each sample [s].
    pub(super) fn timed(
        mut self,
        max_acceleration: Option<&[f64; N]>,
    ) -> Result<(Trajectory, Vec<f64>), Error> {
        let mut least = vec![0.0; self.samples.q.len().saturating_sub(1)];
        for index in 0..self.goals.len() {
            self.add_times(index, &mut least);
        }
        let timed = if let Some(max_acceleration) = max_acceleration {
            self.between_rests(&least, max_acceleration)?
        } else {
            let mut times = Vec::with_capacity(self.samples.q.len());
            times.push(0.0);
            for (index, least) in least.iter().enumerate() {
                times.push(times[index] + least);
            }
            (evenly(&times, &self.samples.q), times)
        };
        let value = timed.0.duration();
        if value.is_nan() || value > MOST_DURATION {
            let bounds = [0.0, MOST_DURATION];
            return Err(MotionFault::Duration { value, bounds }.into());
        }
        self.check_times(&timed.1);
        Ok(timed)
    }

    /// The joint (from 1) that takes longest at its limit from the sample before one, and how long
    /// [s].
    fn slowest(&self, sample: usize) -> (usize, f64) {
        let (from, to) = (&self.samples.q[sample - 1], &self.samples.q[sample]);
        let time = |joint: usize| (to[joint] - from[joint]).abs() / self.max_velocity[joint];
        let (mut slowest, mut longest) = (0, time(0));
        for joint in 1..N {
            if time(joint) > longest {
                (slowest, longest) = (joint, time(joint));
            }
        }
        (slowest + 1, longest)
    }

    /// The times of the intervals of a move [s], the first one at index 0 for sample 1; a joint that
    /// is too fast is found.
    fn add_times(&mut self, index: usize, least: &mut [f64]) {
        let (intervals, goal) = (self.samples.intervals(index), &self.goals[index]);
        let mut sums = [0.0; 2];
        for way in &self.samples.ways[intervals.clone()] {
            sums = [sums[0] + way[0], sums[1] + way[1]];
        }
        let as_programmed = self.made[index].as_programmed;
        let mut speed = goal.speed;
        if let Some(time) = goal.time {
            // By the length of the tool's way or, if it has none, by its turn.
            speed = if sums[0] > 0.0 {
                [sums[0] / time, f64::INFINITY]
            } else {
                [f64::INFINITY, sums[1] / time]
            };
        }
        let too_fast = if !as_programmed {
            for sample in intervals {
                least[sample - 1] = self.slowest(sample).1;
            }
            None
        } else if goal.is_cartesian() {
            self.add_cartesian(index, speed, least)
        } else {
            let programmed =
                goal.time.unwrap_or_else(|| (sums[0] / speed[0]).max(sums[1] / speed[1]));
            let too_fast = self.add_even(intervals, programmed, least);
            // Without \T a joint move is as slow as its slowest joint.
            too_fast.filter(|_| goal.time.is_some())
        };
        if let Some(TooFast { joint, excess, allowed }) = too_fast {
            let bound = self.max_velocity[joint - 1];
            let value = bound * excess;
            let reached = allowed.unwrap_or(speed[0]) * 1e3;
            let of =
                if reached.is_finite() { format!("{reached:.0} mm/s") } else { "it".to_string() };
            let at = if allowed.is_some() {
                "at the speed that its length allows"
            } else {
                "at the programmed speed"
            };
            let words = format!(
                "J{joint} must turn at {:.1} deg/s {at}, its limit is {:.1} deg/s: slowed down to \
                 {:.0} % of {of}",
                value.to_degrees(),
                bound.to_degrees(),
                excess.recip() * 1e2
            );
            let finding = Finding::new(Code::JointTooFast, words).of_joint(joint);
            self.findings.push(finding.with_value(value, bound).at(goal.step, index));
        }
    }

    /// A line or an arc: each interval takes what the programmed speeds and the joints need
    /// (eq. 31).
    fn add_cartesian(&self, index: usize, speed: [f64; 2], least: &mut [f64]) -> Option<TooFast> {
        let mut too_fast = None;
        let mut most = 1.0 + LIMIT_ROUNDING;
        let intervals = self.samples.intervals(index);
        let is_timed = self.goals[index].time.is_some();
        let starts = !is_timed && index > 0 && self.goals[index - 1].stops;
        let stops = !is_timed && self.goals[index].stops;
        let total: f64 = self.samples.ways[intervals.clone()].iter().map(|way| way[0]).sum();
        let mut gone = 0.0;
        // The time that the tool takes for a way, from rest or to rest.
        let time = |way: f64| (2.0 * way.max(0.0) / MOST_ACCELERATION).sqrt();
        for sample in intervals {
            let [length, angle] = self.samples.ways[sample];
            let programmed = (length / speed[0]).max(angle / speed[1]);
            let (joint, needed) = self.slowest(sample);
            least[sample - 1] = programmed.max(needed);
            let mut duration = programmed;
            if starts {
                duration = duration.max(time(gone + length) - time(gone));
            }
            gone += length;
            if stops {
                duration = duration.max(time(total - gone + length) - time(total - gone));
            }
            let excess = needed / duration;
            // Of a speed that was left out nothing can be too fast.
            let is_known = programmed > 0.0 && (length == 0.0 || speed[0].is_finite());
            // Nor where the rounding of joints is more than what the tool goes.
            let is_known = is_known && (length > LEAST_WAY || angle > JOINED_MOVES);
            if is_known && excess > most {
                let allowed = (duration > programmed).then(|| length / duration);
                (most, too_fast) = (excess, Some(TooFast { joint, excess, allowed }));
            }
        }
        too_fast
    }

    /// A joint move: all joints arrive together, at a constant pace of the slowest (eq. 32).
    fn add_even(
        &self,
        intervals: core::ops::Range<usize>,
        programmed: f64,
        least: &mut [f64],
    ) -> Option<TooFast> {
        let mut total = 0.0;
        let mut longest = (1, 0.0);
        for sample in intervals.clone() {
            let (joint, needed) = self.slowest(sample);
            total += needed;
            if needed > longest.1 {
                longest = (joint, needed);
            }
        }
        let slower = if total > 0.0 { (programmed / total).max(1.0) } else { 1.0 };
        for sample in intervals {
            least[sample - 1] = self.slowest(sample).1 * slower;
        }
        let excess = total / programmed;
        (programmed > 0.0 && excess > 1.0 + LIMIT_ROUNDING).then_some(TooFast {
            joint: longest.0,
            excess,
            allowed: None,
        })
    }

    /// With accelerations: from rest to rest, where the robot stops and where it does not go on
    /// smoothly.
    fn between_rests(
        &self,
        least: &[f64],
        max_acceleration: &[f64; N],
    ) -> Result<(Trajectory, Vec<f64>), Error> {
        let q = &self.samples.q;
        let mut times = vec![0.0];
        let mut motion = evenly(&[0.0], &q[..1]);
        let mut begin = 0;
        for (index, goal) in self.goals.iter().enumerate() {
            let end = self.samples.ends[index];
            let next = self.made.get(index + 1);
            let is_smooth = self.made[index].is_rounded && !goal.stops;
            let goes_on = is_smooth && next.is_some_and(|next| next.as_programmed);
            if goes_on || end <= begin + 1 {
                continue;
            }
            let rows = &q[begin..end];
            let (part, own) =
                within_times(rows, &least[begin..end - 1], self.max_velocity, max_acceleration)?;
            let offset = times[begin];
            times.extend(own.iter().skip(1).map(|time| offset + time));
            motion = if begin == 0 { part } else { motion.then(&part)? };
            begin = end - 1;
        }
        Ok((motion, times))
    }

    /// Report moves that take longer than `\T` says.
    fn check_times(&mut self, times: &[f64]) {
        for (index, goal) in self.goals.iter().enumerate() {
            let (own, Some(bound)) = (self.samples.intervals(index), goal.time) else { continue };
            if own.is_empty() || !self.made[index].as_programmed {
                continue;
            }
            let value = times[own.end - 1] - times[own.start - 1];
            if value > bound * (1.0 + LIMIT_ROUNDING) {
                let words = format!("takes {value:.3} s, \\T asks for {bound:.3} s");
                let finding = Finding::new(Code::JointTooFast, words).with_value(value, bound);
                self.findings.push(finding.at(goal.step, index));
            }
        }
    }
}
