//! The solution inside the limits that is nearest to a seed, where the pose is next to a
//! singularity.
//!
//! A regular pose has at most eight solutions, and the cheapest is the answer. A singular one has
//! families of them, twins half a turn apart of which a solve keeps one, and, next to two
//! singularities at once, joints that rounding leaves open. Each of these gives candidates; one
//! that meets the pose inside the limits may be the answer, and the cheapest is
//! (docs/singularities.md, section 3).

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::error::Error;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::answer::status::{SingularityKind, Status};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::correction::DAMPED;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::structure::any::AnyStructure;
use crate::kinematics::structure::arity::{Arity, Joints};
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::redundancy::Redundancy;
use crate::kinematics::thresholds::{LIMIT_SLACK, SOLUTION_OFF};
use crate::report::FreeJoint;

/// Arms of a pose whose wrists are looked at: those of the choices of [`NearestSearch::choices`],
/// four each at most.
const ARMS: usize = 24;

/// |sin q5| up to which the wrist of three parallel axes may be open because the plane of the arm is [1]: that is open by 1e-7 or less.
const OPEN_PLANE_SIN: f64 = 1e-6;

/// What is asked of a solution.
pub(in crate::kinematics) struct Wanted<'a, const N: usize> {
    /// The robot's limits, or narrower ones.
    pub(in crate::kinematics) limits: JointLimits<N>,
    pub(in crate::kinematics) seed: &'a [f64; N],
    pub(in crate::kinematics) weights: &'a [f64; N],
    /// What it must be besides.
    pub(in crate::kinematics) accepts: &'a dyn Fn(&Solution<N>) -> bool,
}

impl<const N: usize> Robot<N>
where
    Joints<N>: Arity<N>,
{
    /// The solution inside the limits that is nearest to `seed`: of `solutions` or, where none of
    /// them is inside and the pose is singular, of all that it has.
    pub(in crate::kinematics) fn nearest_of(
        &self,
        solutions: &Solutions<N>,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Option<Solution<N>>, Error> {
        let nearest = solutions.cheapest(seed, weights, Cost::Distance);
        if nearest.is_some() || self.is_regular(solutions.pose(), Redundancy::of(seed)) {
            return Ok(nearest);
        }
        let wanted = Wanted { limits: *self.limits(), seed, weights, accepts: &|_| true };
        self.nearest_at_singularity(solutions, &wanted)
    }

    /// What is wanted, of a pose that is not regular and has `known` solutions among others. One
    /// that meets the pose, or else one that meets it to its distance from the singularity.
    pub(in crate::kinematics) fn nearest_at_singularity(
        &self,
        known: &Solutions<N>,
        wanted: &Wanted<'_, N>,
    ) -> Result<Option<Solution<N>>, Error> {
        for allowed in [meets(known.pose()), SOLUTION_OFF] {
            let nearest = self.nearest_within(known, wanted, allowed)?;
            if nearest.is_some() {
                return Ok(nearest.map(|(_, solution)| solution));
            }
        }
        Ok(None)
    }

    /// What is wanted, at most `allowed` [rad, m] off the pose, and the slot of the solution that
    /// it came from.
    pub(in crate::kinematics) fn nearest_within(
        &self,
        known: &Solutions<N>,
        wanted: &Wanted<'_, N>,
        allowed: f64,
    ) -> Result<Option<(Slot, Solution<N>)>, Error> {
        let mut search = NearestSearch::new(self, known, wanted, allowed);
        search.run()?;
        Ok(search.best.map(|best| (best.from, best.solution)))
    }
}

/// A solution that was found, what it costs, and the slot of the one that it came from.
#[derive(Clone, Copy)]
pub(super) struct Candidate<const N: usize> {
    pub(super) cost: f64,
    pub(super) solution: Solution<N>,
    from: Slot,
}

/// A search through the solutions of a singular pose.
pub(super) struct NearestSearch<'a, const N: usize>
where
    Joints<N>: Arity<N>,
{
    pub(super) robot: &'a Robot<N>,
    pub(super) known: &'a Solutions<N>,
    pub(super) wanted: &'a Wanted<'a, N>,
    /// How far a solution may be off the pose [rad, m].
    pub(super) allowed: f64,
    pub(super) best: Option<Candidate<N>>,
    /// What other joints take that the pose leaves open, along a family.
    pub(super) others: [f64; N],
    /// The arms whose wrists were looked at, and on which side axis 5 stood.
    pub(super) arms: [Option<([f64; 3], bool)>; ARMS],
    /// The free joints whose families were looked at, a bit each, of either shoulder.
    families: [u8; 2],
}

impl<'a, const N: usize> NearestSearch<'a, N>
where
    Joints<N>: Arity<N>,
{
    pub(super) fn new(
        robot: &'a Robot<N>,
        known: &'a Solutions<N>,
        wanted: &'a Wanted<'a, N>,
        allowed: f64,
    ) -> Self {
        // Beyond reach no solution meets the pose better than those that are known.
        let off = |solution: &Solution<N>| robot.residual(&solution.q, known.pose()).largest();
        let off = known.iter().map(off).fold(0.0, f64::max);
        Self {
            robot,
            known,
            wanted,
            allowed: if off > allowed && off <= SOLUTION_OFF { 1.1 * off } else { allowed },
            best: None,
            others: *wanted.seed,
            arms: [None; ARMS],
            families: [0; 2],
        }
    }

    fn run(&mut self) -> Result<(), Error> {
        let known = self.known;
        known.iter().for_each(|solution| self.take(solution, solution));
        for q in self.choices() {
            let solutions = self.robot.solve(*known.pose(), &FreeChoice::seed(q))?;
            for solution in &solutions {
                self.move_onto_pose(&solution.q, 0.0, solution);
            }
            self.start_from_seed(&solutions);
            for solution in &solutions {
                self.look_along(solution)?;
            }
        }
        for solution in known {
            self.look_along(solution)?;
        }
        if self.best.is_none() && self.must_meet() {
            for solution in known {
                self.start_from_limits(solution);
                self.bend_elbow(solution);
                self.turn_other_joints(solution)?;
            }
        }
        Ok(())
    }

    /// The seed for joints that the pose leaves open, and half a turn from it: of two branches that
    /// are one the nearer is kept, so that every pair of twins comes with one or the other.
    fn choices(&self) -> [[f64; N]; 4] {
        [[0.0, 0.0], [0.0, PI], [PI, 0.0], [PI, PI]].map(|[shoulder, wrist]| {
            let mut q = *self.wanted.seed;
            for (joint, angle) in q.iter_mut().enumerate().filter(|(joint, _)| *joint != 6) {
                *angle += if joint < 3 { shoulder } else { wrist };
            }
            q
        })
    }

    /// Looks at the solutions of each side, with joints that the pose leaves open to rounding alone
    /// where they rest.
    pub(super) fn look_at_twins(&mut self, from: &Solution<N>) -> Result<(), Error> {
        for q in self.choices() {
            for solution in &self.robot.solve(*self.known.pose(), &FreeChoice::rest(q))? {
                self.take_if_met(solution, from);
            }
        }
        Ok(())
    }

    /// Whether a solution must meet the pose, and not only to its distance from the singularity.
    pub(super) fn must_meet(&self) -> bool {
        self.allowed < SOLUTION_OFF
    }

    /// By how much a start may be outside its limits [rad]: what is off the pose is not moved.
    fn slack(&self, slack: f64) -> f64 {
        if self.must_meet() { slack } else { 0.0 }
    }

    /// Whether nothing can be nearer than what was found.
    pub(super) fn is_done(&self) -> bool {
        self.best.is_some_and(|best| best.cost == 0.0)
    }

    /// Takes a solution if it is wanted and the nearest.
    fn take(&mut self, solution: &Solution<N>, from: &Solution<N>) {
        let Wanted { limits, seed, weights, accepts } = self.wanted;
        let Some(q) = limits.turned_to(&solution.q, seed) else { return };
        let cost = Cost::Distance.total(&q, seed, weights);
        if self.best.is_some_and(|best| best.cost <= cost) {
            return;
        }
        let status = solution.status | Status::WITHIN_LIMITS;
        let solution = Solution { q, status, ..*solution };
        if accepts(&solution) {
            self.best = Some(Candidate { cost, solution, from: from.slot });
        }
    }

    /// Takes a solution that is on the pose.
    pub(super) fn take_if_met(&mut self, solution: &Solution<N>, from: &Solution<N>) {
        if self.robot.residual(&solution.q, self.known.pose()).largest() <= self.allowed {
            self.take(solution, from);
        }
    }

    /// Takes the joints nearest to `q` that meet the pose, of the branch of `from`; `q` may be
    /// outside its limits by `slack` [rad]. Tells whether `q` itself meets the pose.
    pub(super) fn move_onto_pose(&mut self, q: &[f64; N], slack: f64, from: &Solution<N>) -> bool {
        let limits = &self.wanted.limits;
        let Some(q) = limits.clamped_to(q, self.wanted.seed, self.slack(slack)) else {
            return false;
        };
        let pose = self.known.pose();
        if self.robot.residual(&q, pose).largest() <= self.allowed {
            self.take(&self.at(q, from), from);
            return true;
        }
        let (q, off) = self.robot.corrected(pose, q, limits, &[], DAMPED);
        if off <= self.allowed {
            self.take(&self.at(q, from), from);
        }
        false
    }

    /// The branch of `from` with other joints.
    fn at(&self, q: [f64; N], from: &Solution<N>) -> Solution<N> {
        let wrist = self.robot.solver().arm().spherical_wrist();
        let slot = wrist.map_or(from.slot, |wrist| from.slot.flipped_to(wrist.sin_5(&q) < 0.0));
        Solution { q, slot, ..*from }
    }

    /// Looks at the solutions that belong to one: along the joint that it leaves free, along the
    /// wrist, and its twin.
    pub(super) fn look_along(&mut self, solution: &Solution<N>) -> Result<(), Error> {
        if self.is_done() {
            return Ok(());
        }
        self.look_at_wrist(solution);
        let arm = self.robot.solver().arm();
        if arm.spherical_wrist().is_none()
            && (self.must_meet() || solution.singularities().contains(SingularityKind::WRIST))
            && arm.sin_5(&solution.q).is_some_and(|sin_5| sin_5.abs() <= OPEN_PLANE_SIN)
            && self.is_first_of(solution, 0)
        {
            self.look_at_open_plane(solution)?;
        }
        for free in self.self_motions_of(solution).into_iter().flatten() {
            let limits = &self.wanted.limits;
            // What stands still along a family may be outside the limits for good; no member of one
            // moves the linkage.
            let stuck =
                |joint: &usize| limits.overrun(joint - 1, solution.q[joint - 1]) > SOLUTION_OFF;
            let stuck = free.still().iter().any(stuck);
            if !stuck
                && limits.linkage_overrun(&solution.q) <= SOLUTION_OFF
                && self.is_first_of(solution, free.joint())
            {
                self.look_along_self_motion(solution, free)?;
            }
        }
        Ok(())
    }

    /// The joints that may be free along a solution and move more than a partner: the one that it
    /// names and, next to another singularity, that of axis 1 or 2, which a wrist hides.
    fn self_motions_of(&self, solution: &Solution<N>) -> [Option<FreeJoint>; 3] {
        let named = solution.free_joint.filter(|free| free.partner().is_none());
        if self.robot.solver().arm().spherical_wrist().is_none() {
            return [named, None, None];
        }
        let hidden = |kind: SingularityKind, free: FreeJoint| {
            (solution.singularities().contains(kind) && named != Some(free)).then_some(free)
        };
        [
            named,
            hidden(SingularityKind::SHOULDER, FreeJoint::Base),
            hidden(SingularityKind::ELBOW, self.upper()),
        ]
    }

    /// The free joint of an arm that is folded onto axis 2.
    pub(super) fn upper(&self) -> FreeJoint {
        if self.robot.is_coupled() { FreeJoint::UpperCoupled } else { FreeJoint::Upper }
    }

    /// Whether no solution of the same shoulder was looked at along this joint before.
    fn is_first_of(&mut self, solution: &Solution<N>, joint: usize) -> bool {
        let shoulder = solution.slot.index() / (self.known.slot_count() / 2);
        let (families, bit) = (&mut self.families[shoulder], 1 << joint);
        let first = *families & bit == 0;
        *families |= bit;
        first
    }

    /// [`Self::move_onto_pose`] with joints that stay where they are, from 0.
    pub(super) fn move_keeping(
        &mut self,
        q: &[f64; N],
        kept: &[usize],
        damping: f64,
        from: &Solution<N>,
    ) {
        let limits = &self.wanted.limits;
        let Some(q) = limits.clamped_to(q, self.wanted.seed, self.slack(LIMIT_SLACK)) else {
            return;
        };
        let (q, off) = self.robot.corrected(self.known.pose(), q, limits, kept, damping);
        if off <= self.allowed {
            self.take(&self.at(q, from), from);
        }
    }
}
