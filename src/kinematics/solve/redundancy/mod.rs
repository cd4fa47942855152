//! Finds the joint vector of a seven-joint arm, which has one joint more than a pose needs, that is
//! nearest to a seed.
//!
//! docs/theory/spherical_shoulder.md, section 5, has the method and its guarantees. [`grid`]
//! samples joint 7 between the edges of reach, [`descent`] descends the valleys of the cost that it
//! finds, [`crossing`] continues on the other branch where the curve nearly crosses itself, and
//! [`in_line`], [`free_joints`] and [`members`] choose the joints that a pose leaves undetermined.

mod crossing;
mod descent;
mod free_joints;
mod grid;
mod in_line;
mod members;
mod proof;
mod samples;

use core::cmp::Ordering;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::Error;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::Status;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;
use crate::kinematics::robot::joints::Redundancy;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::solve::self_motion_curve::{Joints, SelfMotion};
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::thresholds::{
    JOINT_7_FINER_SPACING, JOINT_7_SPACING, POSITION_ROUNDING, ROTATION_ROUNDING,
};
use crate::report::Explanation;

/// Answers that may lack solutions, of those at a singularity, until samples are no longer refined:
/// one takes a hundred times as long as another, some milliseconds, and what it lacks looks like
/// the end of a branch.
const MOST_UNCERTAIN: u32 = 96;

impl Redundancy<7> for Robot<7> {
    fn nearest_along_redundancy(
        &self,
        pose: &Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
        accepts: &dyn Fn(&[f64; 7]) -> bool,
    ) -> Result<Solution<7>, Error> {
        let mut found = self.search(pose, seed, weights, accepts)?;
        found.run()?;
        found
            .nearest()
            .map(|q| self.solution_at(pose, q))
            .ok_or(Error::Unreachable(found.missed.explanation))?
    }

    fn continued_along_redundancy(
        &self,
        pose: &Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Option<Solution<7>>, Error> {
        let mut search = self.search(pose, seed, weights, &|_| true)?;
        search.begin();
        search.best.map(|(_, q)| self.solution_at(pose, q)).transpose()
    }

    fn explain_along_redundancy(&self, pose: &Pose) -> Result<Explanation, Error> {
        let mut found = self.search(pose, &self.limits().rest(), &[1.0; 7], &|_| true)?;
        found.run()?;
        let Some(q) = found.nearest() else {
            return Ok(self.with_approach(found.missed.explanation, pose));
        };
        Ok(match self.ik_checked(*pose, q[6])?.explain() {
            found @ Explanation::Found { .. } => found,
            // Inside the limits only within their tolerance.
            _ => Explanation::Found { solutions: 1, inside: 1 },
        })
    }
}

impl Robot<7> {
    /// A search that has not begun.
    fn search<'a>(
        &'a self,
        pose: &'a Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
        accepts: &'a dyn Fn(&[f64; 7]) -> bool,
    ) -> Result<Search<'a>, Error> {
        self.check_structure()?;
        Ok(Search {
            robot: self,
            curve: SelfMotion { robot: self, pose, rounding: self.rounding() },
            pose,
            are_named: self.slot_names().is_some(),
            seed: *seed,
            weights: *weights,
            accepts,
            best: None,
            nearly: None,
            missed: Missed::NOTHING,
            bisections: 0,
            uncertain: MOST_UNCERTAIN,
        })
    }

    /// Upper bound of the rounding of a pose of this arm [m, rad].
    pub(super) fn rounding(&self) -> f64 {
        if let Some(own) = self.inverse().and_then(|inverse| inverse.self_motions()?.rounding()) {
            return own;
        }
        let rows = self.mdh().rows.iter().map(|row| row.a.abs() + row.d.abs());
        let ends = [self.base(), &self.mdh().base, &self.mdh().flange, self.tool()];
        let ends = ends.into_iter().map(|end| end.translation.vector.norm());
        (POSITION_ROUNDING * rows.chain(ends).sum::<f64>()).max(ROTATION_ROUNDING)
    }

    /// A joint vector of the pose, in its slot.
    fn solution_at(&self, pose: &Pose, q: [f64; 7]) -> Result<Solution<7>, Error> {
        let solutions = self.solve(*pose, &FreeChoice::seed(q))?;
        // Else the ordinal of the solution that this one is.
        let nearest = || solutions.closest_to(&q).map(|nearest| nearest.slot);
        let slot = self.slot_of(&q).or_else(nearest).unwrap_or(Slot::new(0));
        let free = solutions.slot(slot.index()).and_then(|solution| solution.free_joint);
        let status =
            Status::FOUND | Status::WITHIN_LIMITS | Status::from(self.singularity(&q).kinds);
        Ok(Solution { q, slot, status, free_joint: free })
    }
}

/// The nearest approach to a solution inside the limits: none at first. Angles of joint 7 between
/// the samples may have solutions, so that it is not certain.
struct Missed {
    /// How far the pose is out of reach [m].
    shortfall: f64,
    /// How far the joint that exceeds its limits most is outside them [rad].
    outside: f64,
    explanation: Explanation,
}

impl Missed {
    const NOTHING: Self = Self {
        shortfall: f64::INFINITY,
        outside: f64::INFINITY,
        explanation: Explanation::NoRoots { certified: false, approach: None },
    };
}

/// A search along the redundancy, and its result so far.
struct Search<'a> {
    robot: &'a Robot<7>,
    curve: SelfMotion<'a>,
    pose: &'a Pose,
    /// Whether slots are the same branches at every angle of joint 7, between edges that are known.
    are_named: bool,
    seed: [f64; 7],
    weights: [f64; 7],
    /// A further condition that an answer must satisfy.
    accepts: &'a dyn Fn(&[f64; 7]) -> bool,
    /// The least cost and its joint vector.
    best: Option<(f64, [f64; 7])>,
    /// Search among joint vectors that are farther off the pose than permitted: the pose is
    /// slightly beyond reach.
    nearly: Option<(f64, [f64; 7])>,
    missed: Missed,
    /// Intervals of joint 7 that may still be bisected in this sweep.
    bisections: u32,
    /// Answers that may lack solutions, after which samples are no longer refined.
    uncertain: u32,
}

impl Search<'_> {
    fn run(&mut self) -> Result<(), Error> {
        self.begin();
        if self.is_proven_nearest() { Ok(()) } else { self.look_everywhere() }
    }

    /// Search all branches: from the solutions with the joint 7 of the seed, then with others.
    fn look_everywhere(&mut self) -> Result<(), Error> {
        let at_seed = self.samples(&self.seed.clone())?;
        if !self.are_named {
            self.start_at(&self.seed.clone());
            let chosen = at_seed.slots.iter().flatten().filter(|sample| sample.is_chosen);
            chosen.for_each(|sample| self.choose_member(sample));
        }
        self.between_edges(JOINT_7_SPACING)?;
        self.at_singular_angles()?;
        if self.best.is_none() && self.missed.shortfall == 0.0 && self.uncertain > 0 {
            self.between_edges(JOINT_7_FINER_SPACING)?;
        }
        if self.nearest().is_none() && !self.are_named {
            self.start_anywhere();
        }
        self.look_across();
        if self.nearest().is_none() && self.missed.shortfall > 0.0 {
            self.least_shortfall(JOINT_7_SPACING)?;
        }
        Ok(())
    }

    /// Keep the seed if it meets the pose: near a singularity known joints are more exact than any
    /// solve. Otherwise descend from it.
    fn begin(&mut self) {
        if self.closes(&self.seed) {
            self.keep(&self.seed.clone());
        }
        if self.best.is_none()
            && let Some(start) = self.curve.nearest(&Joints::from(self.seed))
        {
            self.descend(start, descent::STEPS.first);
        }
    }

    fn nearest(&self) -> Option<[f64; 7]> {
        self.best.or(self.nearly).map(|(_, q)| q)
    }

    /// Keep a joint vector inside the limits if it costs less than the best found.
    fn keep(&mut self, q: &[f64; 7]) {
        let cost = self.cost(q);
        let cheaper = |found: Option<(f64, [f64; 7])>| found.is_none_or(|(least, _)| cost < least);
        if !cheaper(self.best) || self.outside(q) > 0.0 || !(self.accepts)(q) {
            return;
        }
        if self.robot.residual(q, self.pose).largest() <= meets(self.pose) {
            self.best = Some((cost, *q));
        } else if cheaper(self.nearly) {
            self.nearly = Some((cost, *q));
        }
    }

    /// A joint vector at its 2 pi equivalents nearest to the seed, if those are inside the limits.
    fn turned(&self, q: &[f64; 7]) -> [f64; 7] {
        self.robot.limits().wrapped_near(q, &self.seed).unwrap_or(*q)
    }

    fn miss(&mut self, shortfall: f64, outside: f64, explanation: Explanation) {
        let missed = (self.missed.shortfall, self.missed.outside);
        if (shortfall, outside).partial_cmp(&missed) == Some(Ordering::Less) {
            self.missed = Missed { shortfall, outside, explanation };
        }
    }

    /// Whether a joint vector reaches the pose to rounding.
    fn closes(&self, q: &[f64; 7]) -> bool {
        self.robot.residual(q, self.pose).largest() <= self.curve.rounding
    }

    fn cost(&self, q: &[f64; 7]) -> f64 {
        Cost::Distance.total(q, &self.seed, &self.weights)
    }

    fn outside(&self, q: &[f64; 7]) -> f64 {
        if self.robot.limits().contains(q) {
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
}
