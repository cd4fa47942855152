//! An arm of seven joints has one more than a pose needs: which of the joint vectors of a pose is nearest to a seed.
//!
//! docs/seven_axes.md, section 5, has the method and what it promises.

use core::cmp::Ordering;
use core::f64::consts::{PI, TAU};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::{Error, ModelFault};
use crate::kinematics::answer::select::{Cost, check_seed, check_weights};
use crate::kinematics::answer::solutions::{SLOTS, Solution};
use crate::kinematics::answer::status::{Explanation, Status};
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::self_motion_curve::{Joints, Point, SelfMotion};
use crate::kinematics::structure::free_choice::FreeChoice;

/// Distance of two angles of joint 7 at which all solutions are looked at [rad], at first and where none inside the limits was found.
const SPACINGS: [f64; 2] = [0.06, 0.015];

/// Angle by which a joint may differ between two samples that are neighbours [rad], and how often their distance is halved for that.
const LEAP: f64 = 0.5;
const DEPTH: u32 = 12;

/// How often the distance of two samples is halved between which a slot ends.
const ENDS: u32 = 3;

/// How far a pose may be out of reach on the first grid and still be looked at on the second [m].
const NEARLY: f64 = 0.02;

/// First and largest step along a curve of self-motion [rad].
const FIRST_STEP: f64 = 0.05;
const LARGEST_STEP: f64 = 0.2;

/// Step below which a curve is taken to end, and a valley to be at its bottom [rad].
const LEAST_STEP: f64 = 1e-8;

/// Steps along one curve, and rounds in which the bottom of a valley is found between two of them.
const STEPS: u32 = 120;
const ROUNDS: u32 = 40;

impl Robot<7> {
    /// The solution inside the limits that is nearest to `seed` [rad] along the redundancy: of every angle of joint 7, with turns considered.
    ///
    /// # Errors
    ///
    /// As [`Robot::<6>::ik_nearest`].
    pub fn ik_nearest(
        &self,
        pose: &Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Solution<7>, Error> {
        check_seed("seed", seed)?;
        check_weights(weights)?;
        self.nearest_along_redundancy(&checked_pose(pose)?, seed, weights)
    }

    pub(in crate::kinematics) fn nearest_along_redundancy(
        &self,
        pose: &Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Solution<7>, Error> {
        let found = self.search(pose, seed, weights)?;
        found
            .best
            .map(|(_, q)| self.solution_at(pose, q))
            .ok_or(Error::Unreachable(found.missed.explanation))?
    }

    /// The outcome of a solve over every angle of joint 7, in a sentence.
    #[cfg(feature = "python")]
    pub(crate) fn explain(&self, pose: &Pose) -> Result<Explanation, Error> {
        let found = self.search(pose, &self.limits().rest(), &[1.0; 7])?;
        let Some((_, q)) = found.best else { return Ok(found.missed.explanation) };
        Ok(match self.ik_checked(*pose, q[6])?.explain() {
            found @ Explanation::Found { .. } => found,
            // Inside only to the tolerance of the limits.
            _ => Explanation::Found { solutions: 1, inside: 1 },
        })
    }

    fn search(
        &self,
        pose: &Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Search<'_>, Error> {
        if let Some(reason) = self.no_closed_form() {
            return Err(ModelFault::NoClosedForm(reason).into());
        }
        let pose = *pose;
        let mut search = Search {
            robot: self,
            pose,
            seed: *seed,
            weights: *weights,
            best: None,
            missed: Missed::NOTHING,
        };
        search.run()?;
        Ok(search)
    }

    /// A joint vector of the pose, in its slot.
    fn solution_at(&self, pose: &Pose, q: [f64; 7]) -> Result<Solution<7>, Error> {
        let slot = self.spherical_shoulder().map_or(0, |arm| arm.slot(&q));
        let free = self
            .solve(*pose, &FreeChoice::seed(q))?
            .slot(usize::from(slot))
            .and_then(|solution| solution.free);
        let status = Status::FOUND | Status::WITHIN_LIMITS | self.singularity(&q).kinds;
        Ok(Solution { q, slot, status, free })
    }
}

/// What comes the nearest to a solution inside the limits.
struct Missed {
    /// How far the pose is out of reach [m].
    shortfall: f64,
    /// How far the joint that is outside its limits the most is outside them [rad].
    outside: f64,
    explanation: Explanation,
}

impl Missed {
    const NOTHING: Self = Self {
        shortfall: f64::INFINITY,
        outside: f64::INFINITY,
        explanation: Explanation::FilteredOut,
    };
}

/// A solution with joint 7 at an angle of the grid.
#[derive(Clone, Copy)]
struct Sample {
    q: [f64; 7],
    /// The joints that are outside their limits, a bit each, and by how much the farthest is [rad].
    joints_outside: u8,
    outside: f64,
    cost: f64,
}

impl Sample {
    fn is_better_than(&self, other: Option<&Self>) -> bool {
        let better = |other: &Self| {
            (self.outside, self.cost).partial_cmp(&(other.outside, other.cost))
                != Some(Ordering::Greater)
        };
        other.is_none_or(better)
    }
}

/// The solutions of all slots with joint 7 at an angle.
#[derive(Clone, Copy)]
struct Samples {
    q7: f64,
    slots: [Option<Sample>; SLOTS],
}

impl Samples {
    const NONE: Self = Self { q7: 0.0, slots: [None; SLOTS] };

    /// Whether a joint of some slot goes so far to the other samples that something may be missed between, or a slot ends between.
    fn leaps_to(&self, other: &Self, depth: u32) -> bool {
        let leaps = |(a, b): (&f64, &f64)| (a - b - TAU * ((a - b) / TAU).round()).abs() > LEAP;
        self.slots.iter().zip(&other.slots).any(|pair| match pair {
            (Some(from), Some(to)) => from.q.iter().zip(&to.q).any(leaps),
            (Some(_), None) | (None, Some(_)) => depth < ENDS,
            (None, None) => false,
        })
    }
}

/// A search along the redundancy, and what it has found: the cost of a joint vector, and it.
struct Search<'a> {
    robot: &'a Robot<7>,
    pose: Pose,
    seed: [f64; 7],
    weights: [f64; 7],
    best: Option<(f64, [f64; 7])>,
    missed: Missed,
}

impl Search<'_> {
    fn run(&mut self) -> Result<(), Error> {
        let pose = self.pose;
        let curve = SelfMotion { robot: self.robot, pose: &pose };
        // The solution that goes on from the seed.
        if let Some(start) = curve.nearest(&Joints::from(self.seed)) {
            self.descend(&curve, start);
        }
        let (low, high) = self.range();
        for spacing in SPACINGS {
            // Joint 7 alone makes farther angles cost more than what was found.
            let window =
                self.best.map_or(f64::INFINITY, |(cost, _)| (cost / self.weights[6]).sqrt());
            let (low, high) = (low.max(self.seed[6] - window), high.min(self.seed[6] + window));
            if low <= high {
                self.grid(&curve, low, high, spacing)?;
            }
            if self.best.is_some() || self.missed.shortfall > NEARLY {
                break;
            }
        }
        Ok(())
    }

    /// Looks at every slot on a grid of angles of joint 7, and goes down from each one's minima.
    fn grid(
        &mut self,
        curve: &SelfMotion<'_>,
        low: f64,
        high: f64,
        spacing: f64,
    ) -> Result<(), Error> {
        let intervals = ((high - low) / spacing).ceil().max(2.0);
        let step = (high - low) / intervals;
        let mut seen = [Samples::NONE, self.samples(low)?];
        let mut number = 1.0;
        while number <= intervals {
            let right = self.samples((low + number * step).min(high))?;
            let left = seen[1];
            self.between(curve, &mut seen, &left, &right, 0)?;
            number += 1.0;
        }
        self.look_at(curve, &mut seen, &Samples::NONE);
        Ok(())
    }

    /// Looks at the samples between two angles of joint 7, and at the one on the right: the more, the farther the joints go between them.
    fn between(
        &mut self,
        curve: &SelfMotion<'_>,
        seen: &mut [Samples; 2],
        left: &Samples,
        right: &Samples,
        depth: u32,
    ) -> Result<(), Error> {
        if depth < DEPTH && left.leaps_to(right, depth) {
            let middle = self.samples(0.5 * (left.q7 + right.q7))?;
            self.between(curve, seen, left, &middle, depth + 1)?;
            return self.between(curve, seen, &middle, right, depth + 1);
        }
        self.look_at(curve, seen, right);
        Ok(())
    }

    /// Goes down from the last samples that were seen, where they are better than those before and the next.
    fn look_at(&mut self, curve: &SelfMotion<'_>, seen: &mut [Samples; 2], next: &Samples) {
        let [before, here] = *seen;
        for slot in 0..SLOTS {
            let Some(sample) = here.slots[slot] else { continue };
            let (before, next) = (before.slots[slot].as_ref(), next.slots[slot].as_ref());
            // Where other joints are outside than next to it, there may be none between.
            let edge = |other: Option<&Sample>| {
                other.is_none_or(|other| other.joints_outside != sample.joints_outside)
            };
            let at_edge = sample.outside > 0.0 && (edge(before) || edge(next));
            let in_valley = sample.is_better_than(before) && sample.is_better_than(next);
            if !(at_edge || in_valley) || !self.may_gain(&sample, before, next) {
                continue;
            }
            if let Some(start) = curve.nearest(&Joints::from(sample.q)) {
                self.descend(curve, start);
            }
        }
        *seen = [here, *next];
    }

    /// Whether something between a sample and its neighbours may cost less than what was found.
    fn may_gain(&self, sample: &Sample, before: Option<&Sample>, next: Option<&Sample>) -> bool {
        let Some((least, _)) = self.best else { return true };
        // Where a slot ends, it may go as far again.
        let end = LEAP * self.weights.iter().sum::<f64>().sqrt();
        let apart = |other: Option<&Sample>| {
            other.map_or(end, |other| {
                Cost::Distance.total(&other.q, &sample.q, &self.weights).sqrt()
            })
        };
        sample.cost.sqrt() - 2.0 * apart(before).max(apart(next)) < least.sqrt()
    }

    /// The solution of each slot with joint 7 at an angle, at its turns nearest to the seed where those are inside the limits.
    fn samples(&mut self, q7: f64) -> Result<Samples, Error> {
        let mut rest = self.seed;
        rest[6] = q7;
        let solutions = self.robot.solve(self.pose, &FreeChoice::seed(rest))?;
        let slots = core::array::from_fn(|slot| {
            let solution = solutions.slot(slot)?;
            let q = self.robot.limits().turned_to(&solution.q, &self.seed).unwrap_or(solution.q);
            Some(Sample {
                q,
                joints_outside: self.joints_outside(&q),
                outside: self.outside(&q),
                cost: self.cost(&q),
            })
        });
        slots.iter().flatten().for_each(|sample: &Sample| self.keep(&sample.q));
        let shortfall = solutions.reach().shortfall();
        let outside = slots
            .iter()
            .flatten()
            .map(|sample: &Sample| sample.outside)
            .fold(f64::INFINITY, f64::min);
        if (shortfall, outside).partial_cmp(&(self.missed.shortfall, self.missed.outside))
            == Some(Ordering::Less)
        {
            self.missed = Missed { shortfall, outside, explanation: solutions.explain() };
        }
        Ok(Samples { q7, slots })
    }

    fn cost(&self, q: &[f64; 7]) -> f64 {
        Cost::Distance.total(q, &self.seed, &self.weights)
    }

    fn outside(&self, q: &[f64; 7]) -> f64 {
        if self.robot.limits().contain(q) {
            0.0
        } else {
            (0..7).map(|joint| self.robot.limits().excess(joint, q[joint])).fold(0.0, f64::max)
        }
    }

    fn joints_outside(&self, q: &[f64; 7]) -> u8 {
        (0..7)
            .filter(|joint| self.robot.limits().excess(*joint, q[*joint]) > 0.0)
            .map(|joint| 1 << joint)
            .sum()
    }

    /// How the cost changes along the curve.
    fn slope(&self, point: &Point) -> f64 {
        (0..7)
            .map(|joint| {
                self.weights[joint] * (point.q[joint] - self.seed[joint]) * point.along[joint]
            })
            .sum()
    }

    /// Down from a point of the curve; from where the curve comes back inside the limits too, if the point is outside.
    fn descend(&mut self, curve: &SelfMotion<'_>, start: Point) {
        for edge in self.edges(curve, &start).into_iter().flatten() {
            self.downhill(curve, edge);
        }
        self.downhill(curve, start);
    }

    /// Where the curve comes back inside the limits: a joint that is outside them stands at its limit, and none is outside.
    fn edges(&self, curve: &SelfMotion<'_>, point: &Point) -> [Option<Point>; 7] {
        let limits = self.robot.limits().to_array();
        core::array::from_fn(|joint| {
            let angle = point.q[joint];
            let [low, high] = limits[joint];
            let limit = if angle < low { low } else { high };
            let edge = (self.robot.limits().excess(joint, angle) > 0.0)
                .then(|| curve.with_joint_at(&point.q, joint, limit))??;
            (self.outside(&edge.q.data.0[0]) == 0.0).then_some(edge)
        })
    }

    /// Down to the bottom of the valley that a point of the curve lies in, inside the limits or not; keeps what is inside.
    fn downhill(&mut self, curve: &SelfMotion<'_>, start: Point) {
        let (mut point, mut step) = (start, FIRST_STEP);
        self.keep(&point.q.data.0[0]);
        for _ in 0..STEPS {
            let slope = self.slope(&point);
            if slope == 0.0 || step < LEAST_STEP {
                return;
            }
            let ahead = -step.copysign(slope);
            let next = curve.across(&(point.q + ahead * point.along), &point.along);
            let Some(next) = next.filter(|next| next.along.dot(&point.along) > 0.5) else {
                step *= 0.5;
                continue;
            };
            if self.joints_outside(&next.q.data.0[0]) != self.joints_outside(&point.q.data.0[0]) {
                for end in [&point, &next] {
                    self.edges(curve, end)
                        .iter()
                        .flatten()
                        .for_each(|edge| self.keep(&edge.q.data.0[0]));
                }
            }
            let slope_ahead = self.slope(&next);
            if slope_ahead * slope <= 0.0 {
                self.bottom(curve, &point, ahead, [slope, slope_ahead]);
                return;
            }
            self.keep(&next.q.data.0[0]);
            (point, step) = (next, (2.0 * step).min(LARGEST_STEP));
        }
    }

    /// The bottom of a valley between a point and one that is ahead of it, with the slopes at both: where the slope is zero, by false position.
    fn bottom(&mut self, curve: &SelfMotion<'_>, point: &Point, ahead: f64, slopes: [f64; 2]) {
        let at = |part: f64| curve.across(&(point.q + part * ahead * point.along), &point.along);
        let (mut low, mut high) = ((0.0, slopes[0]), (1.0, slopes[1]));
        for _ in 0..ROUNDS {
            let part = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            let Some(middle) = at(part) else { return };
            self.keep(&middle.q.data.0[0]);
            let slope = self.slope(&middle);
            // The cost is a square: what a step this small changes of it is below rounding.
            if slope == 0.0 || ((part - high.0) * ahead).abs() < LEAST_STEP {
                return;
            }
            // The end that stays twice weighs half (Illinois).
            if slope * high.1 < 0.0 {
                low = high;
            } else {
                low.1 *= 0.5;
            }
            high = (part, slope);
        }
    }

    /// Keeps a joint vector inside the limits that costs less than what was found.
    fn keep(&mut self, q: &[f64; 7]) {
        let cost = self.cost(q);
        if self.outside(q) == 0.0 && self.best.is_none_or(|(least, _)| cost < least) {
            self.best = Some((cost, *q));
        }
    }

    /// Between which angles joint 7 is looked for: its limits, or the full turn inside them that is nearest to the seed.
    fn range(&self) -> (f64, f64) {
        let [low, high] = self.robot.limits().to_array()[6];
        if high - low <= TAU {
            return (low, high);
        }
        let middle = self.seed[6].max(low + PI).min(high - PI);
        (middle - PI, middle + PI)
    }
}
