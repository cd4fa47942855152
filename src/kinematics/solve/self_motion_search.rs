//! The self-motion along a free joint that moves more than a partner: axis 1 if the wrist center is
//! on it, axis 2 if the arm is folded onto it, axis 6 of three parallel axes.

use core::f64::consts::{PI, TAU};

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::error::Error;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::slot::MOST_SLOTS;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::solve::golden_section::golden_section;
use crate::kinematics::solve::nearest::{NearestSearch, Wanted};
use crate::kinematics::thresholds::LIMIT_SLACK;
use crate::report::FreeJoint;

/// Steps of a turn in which a family is searched for a place inside the limits.
pub(super) const STEPS: u32 = 360;

/// Steps of a turn in which it is searched for one that is nearer than what was found.
pub(super) const COARSE_STEPS: u32 = 72;

/// Steps per turn of joint 6 at which a plane of the arm is tried that rounding leaves
/// undetermined.
const PLANE_STEPS: u32 = 72;

/// Least number of steps in which a part of a turn is searched.
pub(super) const LEAST_STEPS: u32 = 8;

/// How much faster than the free joint the joints together move, at most, where no wrist is singular
/// [1].
const MOST_SPEED: f64 = 10.0;

/// Valleys between steps that are looked into.
pub(super) const VALLEYS: u32 = 16;

/// One number per slot.
type OfSlots = [f64; MOST_SLOTS];

/// The self-motion at one angle of the free joint.
#[derive(Clone, Copy)]
pub(super) struct Sample {
    pub(super) angle: f64,
    /// Its place on the way, along which the joints move steadily [rad].
    pub(super) place: f64,
    /// How far the farthest joint is outside its limits or, inside them, less than zero and the
    /// less the nearer to the seed.
    pub(super) heights: OfSlots,
    /// Size of sin q5 of an arm whose wrist may be singular as well.
    wrists: OfSlots,
}

/// Return the least of the heights.
fn least(heights: &OfSlots) -> f64 {
    heights.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Whether the middle one of three values is the least.
fn is_valley(of: [f64; 3]) -> bool {
    of[1].is_finite() && of[1] < of[0] && of[1] <= of[2]
}

impl Sample {
    /// One at which nothing is met.
    pub(super) fn nothing(angle: f64) -> Self {
        let nothing = [f64::INFINITY; MOST_SLOTS];
        Self { angle, place: angle, heights: nothing, wrists: nothing }
    }

    pub(super) fn least_height(&self) -> f64 {
        least(&self.heights)
    }
}

/// A part of a turn of the free joint.
struct Window {
    low: f64,
    step: f64,
    steps: u32,
}

impl<const N: usize> NearestSearch<'_, N> {
    /// Search the self-motion of a solution, on all its branches.
    pub(super) fn look_along_self_motion(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
    ) -> Result<(), Error> {
        let joint = free.joint() - 1;
        for angle in [from.q[joint], self.wanted.seed[joint]] {
            for rotated in [angle, angle + PI] {
                for member in &self.members(from, free, rotated)?.0 {
                    self.move_onto_pose(&member.q, LIMIT_SLACK, member);
                }
            }
        }
        let inverse = self.robot.known_inverse()?;
        if let Some(corners) = inverse.corners(&from.q, free) {
            return self.look_between_corners(from, free, corners);
        }
        if !self.is_undetermined(from, free)? {
            return Ok(());
        }
        let Window { low, step, steps } = self.window(from, free);
        let mut before = self.sample(from, free, low - step)?;
        let mut here = self.sample(from, free, low)?;
        let mut valleys = VALLEYS;
        for number in 1..=steps + 1 {
            let next = self.sample(from, free, low + f64::from(number) * step)?;
            let samples = [&before, &here, &next];
            for slot in (0..self.known.slot_count()).step_by(2) {
                // sin q5 changes no faster than the free joint does.
                if is_valley(samples.map(|sample| sample.wrists[slot])) && here.wrists[slot] <= step
                {
                    self.look_at_wrist_between(from, free, slot, [before.angle, next.angle])?;
                }
            }
            self.look_into_valleys(from, free, samples, &mut valleys)?;
            (before, here) = (here, next);
        }
        Ok(())
    }

    /// Looks where between three angles the joints of a slot are the least outside the limits, or
    /// the nearest to the seed.
    pub(super) fn look_into_valleys(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        samples: [&Sample; 3],
        left: &mut u32,
    ) -> Result<(), Error> {
        let between = [samples[0].angle, samples[2].angle];
        let width = samples[2].place - samples[0].place;
        for slot in 0..self.known.slot_count() {
            let heights = samples.map(|sample| sample.heights[slot]);
            if is_valley(heights) && self.may_be_nearer(heights[1], width) && *left > 0 {
                *left -= 1;
                self.look_into_valley(from, free, between, |heights| heights[slot])?;
            }
        }
        // If another joint is singular as well, rounding moves a branch from slot to slot.
        let heights = samples.map(Sample::least_height);
        if is_valley(heights) && self.may_be_nearer(heights[1], width) {
            self.look_into_valley(from, free, between, least)?;
        }
        Ok(())
    }

    /// Whether a valley of this height and width may have a member that is nearer than what was
    /// found.
    fn may_be_nearer(&self, height: f64, width: f64) -> bool {
        let Some(best) = self.best.filter(|_| height < 0.0) else { return true };
        let cost = -1.0 / height - 1.0;
        let heaviest = self.wanted.weights.iter().copied().fold(0.0, f64::max);
        cost.sqrt() - best.cost.sqrt() < MOST_SPEED * heaviest.sqrt() * width.abs()
    }

    /// Whether the free joint can move with the tool on the pose: near the singularity it cannot.
    pub(super) fn is_undetermined(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
    ) -> Result<bool, Error> {
        let own = from.q[free.joint() - 1];
        for part in [0.05, -0.05, 0.8, -0.8, 1.6, -1.6, 2.4, -2.4] {
            if least(&self.members(from, free, own + part)?.1).is_finite() {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// How far from the seed a joint, from 0, may be without costing more than what was found by
    /// itself [rad].
    pub(super) fn farthest(&self, joint: usize) -> f64 {
        self.best.map_or(f64::INFINITY, |best| {
            (best.cost / self.wanted.weights[joint]).sqrt().max(f64::MIN_POSITIVE)
        })
    }

    /// The angles of the free joint that may cost less than what was found.
    fn window(&self, from: &Solution<N>, free: FreeJoint) -> Window {
        let joint = free.joint() - 1;
        let seed = self.wanted.seed[joint];
        let half = self.farthest(joint);
        let coarse = TAU / f64::from(COARSE_STEPS);
        if half < PI - coarse {
            let steps = (LEAST_STEPS..COARSE_STEPS)
                .find(|steps| f64::from(*steps) * coarse >= 2.0 * half)
                .unwrap_or(COARSE_STEPS);
            return Window { low: seed - half, step: 2.0 * half / f64::from(steps), steps };
        }
        let steps = if self.best.is_some() { COARSE_STEPS } else { STEPS };
        // From the angle of the solution on, which may be at the edge of reach.
        Window { low: from.q[joint], step: TAU / f64::from(steps), steps }
    }

    /// Try joint 6 of three parallel axes at several angles, if rounding of the shoulder leaves the
    /// plane of the arm undetermined, and with it a nearly singular wrist.
    pub(super) fn search_uncertain_plane(&mut self, from: &Solution<N>) -> Result<(), Error> {
        let free = FreeJoint::Parallel;
        let [low, high] = self.wanted.limits.to_array()[5];
        let own = from.q[5];
        let known =
            [self.wanted.seed[5], low, high].map(|at| if at.is_finite() { at } else { own });
        let steps = if self.best.is_none() { PLANE_STEPS } else { 0 };
        let others = (0..steps).map(|step| own + f64::from(step) * TAU / f64::from(PLANE_STEPS));
        for angle in known.into_iter().chain(others) {
            let seeded = Solution { q: self.others, ..*from };
            let solutions =
                self.robot.solve_with_free_joint(self.known.pose(), &seeded, free, angle)?;
            for solution in &solutions {
                self.move_onto_pose(&solution.q, LIMIT_SLACK, solution);
            }
        }
        Ok(())
    }

    /// The solutions with the free joint at `angle`, of which the nearest is taken, and the heights
    /// of those that meet the pose.
    pub(super) fn members(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        angle: f64,
    ) -> Result<(Solutions<N>, OfSlots), Error> {
        let mut q = self.others;
        if let (Some(last), Some(given)) = (q.get_mut(6), from.q.get(6)) {
            *last = *given;
        }
        let seeded = Solution { q, ..*from };
        let pose = self.known.pose();
        let solutions = self.robot.solve_with_free_joint(pose, &seeded, free, angle)?;
        let mut heights = [f64::INFINITY; MOST_SLOTS];
        for solution in &solutions {
            if self.robot.residual(&solution.q, pose).largest() <= self.allowed {
                heights[solution.slot.index()] = self.height_of(&solution.q);
                self.take(solution, from);
            }
        }
        Ok((solutions, heights))
    }

    pub(super) fn sample(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        angle: f64,
    ) -> Result<Sample, Error> {
        let (solutions, heights) = self.members(from, free, angle)?;
        let wrists = core::array::from_fn(|slot| self.wrist(&solutions, slot));
        Ok(Sample { angle, place: angle, heights, wrists })
    }

    /// How far the farthest joint is outside its limits or, inside them, less than zero and the
    /// less the nearer to the seed.
    pub(super) fn height_of(&self, q: &[f64; N]) -> f64 {
        let Wanted { limits, seed, weights, .. } = self.wanted;
        match limits.wrapped_near(q, seed) {
            Some(q) => -1.0 / (1.0 + Cost::Distance.total(&q, seed, weights)),
            None => limits.worst_overrun(q),
        }
    }

    fn wrist(&self, solutions: &Solutions<N>, slot: usize) -> f64 {
        let Some(wrist) = self.robot.singular_wrist() else {
            return f64::INFINITY;
        };
        let solution = solutions.slot(slot).or_else(|| solutions.slot(slot ^ 1));
        solution.map_or(f64::INFINITY, |found| wrist.sin_5(&found.q).abs())
    }

    /// Search between two angles where the members exceed the limits least, or are nearest to the
    /// seed.
    fn look_into_valley(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        [low, high]: [f64; 2],
        height: impl Fn(&OfSlots) -> f64,
    ) -> Result<(), Error> {
        let at = |angle| Ok(height(&self.members(from, free, angle)?.1));
        golden_section(at, low, high).map(|_| ())
    }

    /// Search between two angles where the wrist of a slot is singular as well: there axes 4 and 6
    /// may share their sum in any way.
    fn look_at_wrist_between(
        &mut self,
        from: &Solution<N>,
        free: FreeJoint,
        slot: usize,
        [low, high]: [f64; 2],
    ) -> Result<(), Error> {
        let wrist = |angle| {
            let (solutions, _) = self.members(from, free, angle)?;
            Ok(self.wrist(&solutions, slot))
        };
        let (angle, _) = golden_section(wrist, low, high)?;
        let (solutions, _) = self.members(from, free, angle)?;
        for twin in [slot, slot ^ 1] {
            if let Some(solution) = solutions.slot(twin) {
                self.look_at_wrist(solution);
            }
        }
        Ok(())
    }
}
