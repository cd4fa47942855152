//! The solution inside the limits that is nearest to a seed, for a pose near a singularity.
//!
//! A regular pose has at most eight solutions, and the cheapest is the answer. A singular pose also
//! has self-motions; twins half a turn apart, of which a solve keeps one; and, near two
//! singularities at once, joints that rounding leaves undetermined. Each of these yields
//! candidates. One that reaches the pose inside the limits may be the answer, and the cheapest is
//! (docs/theory/singularities.md, section 3).

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::error::Error;
use crate::kinematics::answer::select::Cost;
use crate::kinematics::answer::slot::{MOST_SLOTS, Slot};
use crate::kinematics::answer::solutions::{Solution, Solutions};
use crate::kinematics::answer::status::{SingularityKind, Status};
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::correction::DAMPED;
use crate::kinematics::solve::self_motion::meets;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::thresholds::{LIMIT_SLACK, SOLUTION_OFF};
use crate::report::FreeJoint;

/// Number of arms of a pose whose wrists are searched: by the choices of
/// [`NearestSearch::choices`], at most four each.
const ARMS: usize = 24;

/// sin q5 up to which another singularity may leave the wrist undetermined [1]: the uncertainty of
/// the arm's plane or of its forearm is at most 4e-7.
pub(super) const UNCERTAIN_SIN_5: f64 = 1e-6;

/// The requirements on a solution.
pub(in crate::kinematics) struct Wanted<'a, const N: usize> {
    /// The robot's limits, or narrower ones.
    pub(in crate::kinematics) limits: JointLimits<N>,
    pub(in crate::kinematics) seed: &'a [f64; N],
    pub(in crate::kinematics) weights: &'a [f64; N],
    /// A further condition that it must satisfy.
    pub(in crate::kinematics) accepts: &'a dyn Fn(&Solution<N>) -> bool,
}

impl<const N: usize> Robot<N> {
    /// The solution inside the limits that is nearest to `seed`: one of `solutions` or, if none of
    /// them is inside and the pose is singular, any solution of the pose.
    pub(in crate::kinematics) fn nearest_of(
        &self,
        solutions: &Solutions<N>,
        seed: &[f64; N],
        weights: &[f64; N],
    ) -> Result<Option<Solution<N>>, Error> {
        let nearest = solutions.cheapest(seed, weights, Cost::Distance);
        if nearest.is_some()
            || self.are_regular(solutions)
            || self.is_regular(solutions.pose(), seed[self.locked_index()])
        {
            return Ok(nearest);
        }
        let wanted = Wanted { limits: *self.limits(), seed, weights, accepts: &|_| true };
        self.nearest_at_singularity(solutions, &wanted)
    }

    /// Whether nothing of these solutions is left to be chosen: they are regular, and Newton's
    /// method has brought them to the pose. Solutions of a closed form may be beside a singularity
    /// that rounding hides.
    pub(super) fn are_regular(&self, solutions: &Solutions<N>) -> bool {
        let is_regular = |solution: &Solution<N>| solution.singularities().is_empty();
        !self.is_closed_form() && solutions.iter().all(is_regular)
    }

    /// The wanted solution of a pose that is not regular, of which the solutions `known` are given.
    /// It reaches the pose or, failing that, is off by at most the distance from the singularity.
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

    /// The wanted solution, at most `allowed` [rad, m] off the pose, and the slot of the solution
    /// that it was derived from.
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

/// A solution that was found, its cost, and the slot of the solution that it was derived from.
#[derive(Clone, Copy)]
pub(super) struct Candidate<const N: usize> {
    pub(super) cost: f64,
    pub(super) solution: Solution<N>,
    from: Slot,
}

/// A search through the solutions of a singular pose.
pub(super) struct NearestSearch<'a, const N: usize> {
    pub(super) robot: &'a Robot<N>,
    pub(super) known: &'a Solutions<N>,
    pub(super) wanted: &'a Wanted<'a, N>,
    /// How far a solution may be off the pose [rad, m].
    pub(super) allowed: f64,
    pub(super) best: Option<Candidate<N>>,
    /// Whether any member of a self-motion will do, of several that are tried the nearest.
    pub(super) takes_any: bool,
    /// The arms whose wrists were searched, with the side of axis 5.
    pub(super) arms: [Option<([f64; 3], bool)>; ARMS],
    /// The undetermined joints whose self-motions were searched, one bit each, by slot.
    pub(super) self_motions: [u8; MOST_SLOTS],
}

impl<'a, const N: usize> NearestSearch<'a, N> {
    pub(super) fn new(
        robot: &'a Robot<N>,
        known: &'a Solutions<N>,
        wanted: &'a Wanted<'a, N>,
        allowed: f64,
    ) -> Self {
        // Beyond reach no solution meets the pose better than the known ones.
        let off = |solution: &Solution<N>| robot.residual(&solution.q, known.pose()).largest();
        let off = known.iter().map(off).fold(0.0, f64::max);
        Self {
            robot,
            known,
            wanted,
            allowed: if off > allowed && off <= SOLUTION_OFF { 1.1 * off } else { allowed },
            best: None,
            takes_any: false,
            arms: [None; ARMS],
            self_motions: [0; MOST_SLOTS],
        }
    }

    fn run(&mut self) -> Result<(), Error> {
        let known = self.known;
        known.iter().for_each(|solution| self.take(solution, solution));
        if known.iter().all(|solution| self.is_singular_once(solution)) {
            for solution in known {
                match solution.free_joint {
                    Some(free) if free.partner().is_some() => self.look_at_wrist(solution),
                    Some(free) => self.look_along_self_motion(solution, free),
                    None => {}
                }
            }
            let seed = *self.wanted.seed;
            if let Some(next) = known.closest_to(&seed).copied() {
                self.take_if_met(&self.at(seed, &next), &next);
            }
            if self.best.is_some() {
                return Ok(());
            }
        }
        if self.robot.slot_names().is_some() {
            for q in self.choices() {
                self.look_around(&self.robot.solve(*known.pose(), &FreeChoice::seed(q))?);
            }
        } else {
            // Slots are ordinals: no branches have merged, and self-motions are walked along.
            self.look_around(known);
        }
        for solution in known {
            self.look_along(solution);
            self.look_along_chain(solution);
        }
        if self.best.is_none() && self.must_meet() {
            for solution in known {
                self.start_from_limits(solution);
                self.turn_other_joints(solution);
            }
        }
        Ok(())
    }

    /// Whether all that a solution stands for is itself or along its one self-motion, at whose
    /// corners another singularity may be met: where two meet otherwise there is more.
    fn is_singular_once(&self, solution: &Solution<N>) -> bool {
        let at_corner = match solution.free_joint {
            Some(FreeJoint::Parallel) => SingularityKind::ELBOW,
            Some(free) if [FreeJoint::Base, self.upper()].contains(&free) => SingularityKind::WRIST,
            _ => SingularityKind::empty(),
        };
        let met = solution.singularities() & !at_corner;
        let kinds = [SingularityKind::WRIST, SingularityKind::ELBOW, SingularityKind::SHOULDER];
        self.robot.slot_names().is_some() && kinds.into_iter().any(|kind| kind.contains(met))
    }

    /// Search next to solutions and to the seed, and along the solutions' undetermined joints.
    fn look_around(&mut self, solutions: &Solutions<N>) {
        for solution in solutions {
            self.move_onto_pose(&solution.q, 0.0, solution);
        }
        self.start_from_seed(solutions);
        for solution in solutions {
            self.look_along(solution);
        }
    }

    /// The seed for undetermined joints, and half a turn from it: of two merged branches the nearer
    /// is kept, so every pair of twins appears with one or the other.
    fn choices(&self) -> [[f64; N]; 4] {
        [[0.0, 0.0], [0.0, PI], [PI, 0.0], [PI, PI]].map(|[shoulder, wrist]| {
            let mut q = *self.wanted.seed;
            for (joint, angle) in q.iter_mut().enumerate().filter(|(joint, _)| *joint != 6) {
                *angle += if joint < 3 { shoulder } else { wrist };
            }
            q
        })
    }

    /// Search the solutions on each side, with the joints that only rounding leaves undetermined at
    /// their default angles.
    pub(super) fn look_at_twins(&mut self, from: &Solution<N>) -> Result<(), Error> {
        for q in self.choices() {
            for solution in &self.robot.solve(*self.known.pose(), &FreeChoice::rest(q))? {
                self.take_if_met(solution, from);
            }
        }
        Ok(())
    }

    /// Whether a solution must reach the pose to rounding, not only to its distance from the
    /// singularity.
    pub(super) fn must_meet(&self) -> bool {
        self.allowed < SOLUTION_OFF
    }

    /// By how much a start may be outside its limits [rad]; zero if the solution may be off the
    /// pose, as it is then not moved.
    fn slack(&self, slack: f64) -> f64 {
        if self.must_meet() { slack } else { 0.0 }
    }

    /// Whether no solution can be nearer than the one found.
    pub(super) fn is_done(&self) -> bool {
        self.best.is_some_and(|best| best.cost == 0.0)
    }

    /// Keep a solution if it is wanted and the nearest so far.
    pub(super) fn take(&mut self, solution: &Solution<N>, from: &Solution<N>) {
        self.take_if(solution, from, |_| true);
    }

    /// Keep a solution if it reaches the pose.
    pub(super) fn take_if_met(&mut self, solution: &Solution<N>, from: &Solution<N>) -> f64 {
        self.take_if(solution, from, |search| {
            search.robot.residual(&solution.q, search.known.pose()).largest() <= search.allowed
        })
    }

    /// Keep a solution if it is wanted, the nearest so far and `is_one`. Return how far its farthest
    /// joint is outside its limits or, inside them, less than zero and the less the nearer to the
    /// seed.
    fn take_if(
        &mut self,
        solution: &Solution<N>,
        from: &Solution<N>,
        is_one: impl Fn(&Self) -> bool,
    ) -> f64 {
        let Wanted { limits, seed, weights, accepts } = self.wanted;
        let Some(q) = limits.wrapped_near(&solution.q, seed) else {
            return limits.worst_overrun(&solution.q);
        };
        let cost = Cost::Distance.total(&q, seed, weights);
        if self.best.is_none_or(|best| cost < best.cost) && is_one(self) {
            let kinds = self.robot.inverse().map(|inverse| inverse.singular(&q).1);
            let kinds = kinds.map_or(Status::empty(), Status::from);
            let status = solution.status | kinds | Status::WITHIN_LIMITS;
            let solution = Solution { q, status, ..*solution };
            if accepts(&solution) {
                self.best = Some(Candidate { cost, solution, from: from.slot });
            }
        }
        -1.0 / (1.0 + cost)
    }

    /// Keep the joints nearest to `q` that reach the pose, on the branch of `from`; `q` may be
    /// outside its limits by `slack` [rad]. Returns whether `q` itself reaches the pose.
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

    /// The branch of `from` with other joint angles.
    pub(super) fn at(&self, q: [f64; N], from: &Solution<N>) -> Solution<N> {
        let sin_5 = self.robot.singular_wrist().and_then(|_| self.robot.sin_5(&q));
        let slot = sin_5.map_or(from.slot, |sin_5| from.slot.flipped_to(sin_5 < 0.0));
        Solution { q, slot, ..*from }
    }

    /// Search the solutions related to one: along its undetermined joint, along the wrist, and its
    /// twin.
    pub(super) fn look_along(&mut self, solution: &Solution<N>) {
        if self.is_done() {
            return;
        }
        self.look_at_wrist(solution);
        for free in self.self_motions_of(solution).into_iter().flatten() {
            let limits = &self.wanted.limits;
            // A joint that is fixed along a self-motion may be outside the limits for all members,
            // and so may the linkage: only four parallel axes move it.
            let stuck =
                |joint: &usize| limits.overrun(joint - 1, solution.q[joint - 1]) > SOLUTION_OFF;
            let stuck = free.still().iter().any(stuck);
            let moves_linkage = free == FreeJoint::Parallel;
            if !stuck && (moves_linkage || limits.linkage_overrun(&solution.q) <= SOLUTION_OFF) {
                self.look_along_self_motion(solution, free);
            }
        }
    }

    /// The joints that may be undetermined at a solution and move more than a partner: the one that
    /// it names and, near another singularity, axis 1's or 2's, which a singular wrist hides.
    fn self_motions_of(&self, solution: &Solution<N>) -> [Option<FreeJoint>; 3] {
        // A chain's is walked along.
        let is_searched =
            |free: &FreeJoint| free.partner().is_none() && !matches!(free, FreeJoint::Chain { .. });
        let named = solution.free_joint.filter(is_searched);
        if self.robot.singular_wrist().is_none() {
            let parallel = Some(FreeJoint::Parallel);
            // An undetermined plane of the arm may leave joint 6 of three parallel axes so, too.
            let hidden = (self.must_meet()
                || solution.singularities().contains(SingularityKind::WRIST))
                && self.robot.sin_5(&solution.q).is_some_and(|sin| sin.abs() <= UNCERTAIN_SIN_5)
                && named != parallel;
            return [named, parallel.filter(|_| hidden), None];
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
        FreeJoint::upper(self.robot.coupling())
    }

    /// Whether no solution on the same branches, whose slots differ in a bit, was searched along
    /// this joint before.
    pub(super) fn is_first_of(&mut self, solution: &Solution<N>, joint: usize, bit: usize) -> bool {
        let (searched, joint) = (&mut self.self_motions[solution.slot.index() & !bit], 1 << joint);
        let first = *searched & joint == 0;
        *searched |= joint;
        first
    }

    /// [`Self::move_onto_pose`] with joints (from 0) that are not moved.
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
