//! Samples joint 7 from one edge of reach to the next.

use core::f64::consts::{PI, TAU};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::Search;
use super::samples::{Sample, Samples};
use crate::error::Error;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::slot::MOST_SLOTS;
use crate::kinematics::structure::self_motions::EDGES;
use crate::kinematics::thresholds::SAMPLE_LEAP;

/// How often the interval between two samples is bisected where a joint moves far between them.
const DEPTH: u32 = 12;

/// Bisections of one sweep, at most: those that find where each of 16 branches begins and ends.
/// Random poses take up to two thirds of them.
const BISECTIONS: u32 = 2 * 16 * DEPTH;

/// Least number of intervals between two marks: half a turn of joint 5 in steps far below
/// [`SAMPLE_LEAP`], so that two valleys near an edge are resolved.
const LEAST_INTERVALS: f64 = 16.0;

/// Angles of joint 7 in ascending order.
struct Marks {
    angles: [f64; EDGES + 2],
    count: usize,
}

impl Marks {
    fn sort(&mut self) {
        let angles = &mut self.angles[..self.count];
        angles.sort_unstable_by(f64::total_cmp);
    }

    fn put(&mut self, angle: f64) {
        if let Some(place) = self.angles.get_mut(self.count) {
            *place = angle;
            self.count += 1;
        }
    }

    fn pairs(&self) -> impl Iterator<Item = (f64, f64)> {
        self.angles[..self.count].windows(2).map(|pair| (pair[0], pair[1]))
    }
}

impl Search<'_> {
    /// Sample every slot between the edges of reach, at angles at most `spacing` [rad] apart, and
    /// descend from the minima of each slot.
    pub(super) fn between_edges(&mut self, spacing: f64) -> Result<(), Error> {
        let Some(marks) = self.marks() else { return Ok(()) };
        self.bisections = BISECTIONS;
        let mut left = self.samples_at(marks.angles[0])?;
        self.at_edge(&left)?;
        let mut seen = [Samples::NONE, left];
        for (low, high) in marks.pairs() {
            if high <= low {
                continue;
            }
            let right = self.samples_at(high)?;
            self.at_edge(&right)?;
            let is_unreachable = self.are_named && self.samples_at(0.5 * (low + high))?.are_none();
            if is_unreachable {
                // The edges may touch: the only reachable angle is then the mark itself.
                self.step(&mut seen, &Samples::NONE)?;
                seen = [Samples::NONE, right];
            } else {
                self.interval(&mut seen, &left, &right, spacing)?;
            }
            left = right;
        }
        self.step(&mut seen, &Samples::NONE)
    }

    /// Sample from one edge to the next, more densely near an edge: there the other joints move
    /// with the square root of joint 7.
    fn interval(
        &mut self,
        seen: &mut [Samples; 2],
        first: &Samples,
        last: &Samples,
        spacing: f64,
    ) -> Result<(), Error> {
        let (from, length, mut left) = (first.q7, last.q7 - first.q7, *first);
        let intervals = (2.0 * (0.75 * length / spacing).ceil()).max(LEAST_INTERVALS);
        let mut number = 1.0;
        while number < intervals {
            let part: f64 = number / intervals;
            let right = self.samples_at(from + length * part * part * (3.0 - 2.0 * part))?;
            self.between(seen, &left, &right, 0)?;
            left = right;
            number += 1.0;
        }
        self.between(seen, &left, last, 0)
    }

    /// Sample between two angles of joint 7, and at the right one: more densely the farther the
    /// joints move between them.
    fn between(
        &mut self,
        seen: &mut [Samples; 2],
        left: &Samples,
        right: &Samples,
        depth: u32,
    ) -> Result<(), Error> {
        let may_bisect = depth < DEPTH && self.bisections > 0 && self.uncertain > 0;
        if may_bisect && left.leap_to(right) {
            self.bisections -= 1;
            let middle = self.samples_at(0.5 * (left.q7 + right.q7))?;
            self.between(seen, left, &middle, depth + 1)?;
            return self.between(seen, &middle, right, depth + 1);
        }
        self.step(seen, right)
    }

    /// Advance by one sample: the last one then has both its neighbors.
    fn step(&mut self, seen: &mut [Samples; 2], next: &Samples) -> Result<(), Error> {
        let [before, here] = *seen;
        *seen = [here, *next];
        self.look_at(&here, [&before, next])
    }

    /// Descend from samples that are better than both neighbors.
    pub(super) fn look_at(
        &mut self,
        here: &Samples,
        neighbors: [&Samples; 2],
    ) -> Result<(), Error> {
        let mut free: Option<Sample> = None;
        for slot in 0..MOST_SLOTS {
            let Some(sample) = here.slots[slot] else { continue };
            let neighbors = neighbors.map(|samples| samples.same_branch(slot, &sample));
            // If more joints are outside than at the neighbor, there may be no sample between.
            let edge = |other: Option<&Sample>| {
                other.is_none_or(|other| other.joints_outside != sample.joints_outside)
            };
            let at_edge = sample.outside > 0.0 && neighbors.into_iter().any(edge);
            let in_valley = neighbors.into_iter().all(|other| sample.is_better_than(other));
            if !(at_edge || in_valley) {
                continue;
            }
            if sample.is_free && sample.is_better_than(free.as_ref()) {
                free = Some(sample);
            }
            if self.may_gain(&sample, neighbors) {
                self.descend_from(&sample, neighbors);
            }
        }
        free.map_or(Ok(()), |sample| self.choose_free_joints(&sample))
    }

    /// Whether a point between a sample and its neighbors may cost less than the best found.
    fn may_gain(&self, sample: &Sample, neighbors: [Option<&Sample>; 2]) -> bool {
        let Some((least, _)) = self.best else { return true };
        // Where a slot ends, it may extend by as much again.
        let end = SAMPLE_LEAP * self.weights.iter().sum::<f64>().sqrt();
        let apart = |other: Option<&Sample>| {
            other.map_or(end, |other| {
                Cost::Distance.total(&other.q, &sample.q, &self.weights).sqrt()
            })
        };
        let farthest = neighbors.map(apart).into_iter().fold(0.0, f64::max);
        sample.cost.sqrt() - 2.0 * farthest < least.sqrt()
    }

    /// How far a pose that no angle of joint 7 reaches is out of reach.
    pub(super) fn least_shortfall(&mut self, spacing: f64) -> Result<(), Error> {
        let (low, high) = self.range();
        let intervals = ((high - low) / spacing).ceil().max(2.0);
        let mut number = 0.0;
        while number <= intervals {
            self.samples_at((low + (high - low) * number / intervals).min(high))?;
            number += 1.0;
        }
        Ok(())
    }

    /// The edges of reach within the range in which joint 7 alone does not exceed the best cost,
    /// and the ends of that range.
    fn marks(&self) -> Option<Marks> {
        let window = self.best.map_or(f64::INFINITY, |(cost, _)| (cost / self.weights[6]).sqrt());
        let (low, high) = self.range();
        let (low, high) = (low.max(self.seed[6] - window), high.min(self.seed[6] + window));
        if low > high {
            return None;
        }
        let mut marks = Marks { angles: [0.0; EDGES + 2], count: 0 };
        marks.put(low);
        marks.put(high);
        let motions = self.robot.self_motions(self.pose);
        let edges = motions.map(|(motions, pose)| motions.edges_of_joint_7(&pose));
        for edge in edges.into_iter().flatten().flatten() {
            let edge = edge + TAU * ((low - edge) / TAU).ceil();
            if edge < high {
                marks.put(edge);
            }
        }
        marks.sort();
        Some(marks)
    }

    /// The range of joint 7 to search: its limits, or the turn inside them that is nearest to the
    /// seed.
    fn range(&self) -> (f64, f64) {
        let [low, high] = self.robot.limits().to_array()[6];
        if high - low <= TAU {
            return (low, high);
        }
        let middle = self.seed[6].max(low + PI).min(high - PI);
        (middle - PI, middle + PI)
    }
}
