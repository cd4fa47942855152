//! Every solution of a pose: by the best split, and by others where its count is not certain.

use core::ops::ControlFlow;

use super::attempt::Attempt;
use super::choice::quasi_random;
use super::geometry::General;
use super::split::Split;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::TakeStep;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::by_roots::{InCluster, SLOTS};
use crate::kinematics::structure::closure::{
    Accepted, Configuration, Kind, Target, in_order_one_by_one,
};
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::thresholds::CLOSURE_SINGULAR;
use crate::lanes::{LANES, run_vectors};
use crate::report::{FreeJoint, Reach};

/// Joint vectors from which Newton's method starts where no count is certain.
const STARTS: usize = 128;

/// How often Newton's method, which takes eight steps, goes on from there.
const ROUNDS: usize = 4;

impl General {
    /// Take every solution of a pose; returns whether their number is certain.
    pub(crate) fn solutions(
        &self,
        t_first_last: &Pose,
        free: &FreeChoice<6>,
        accepted: &mut Accepted,
    ) -> bool {
        let target = self.closure.target_of(t_first_last);
        // The kernel has tried the first split.
        let left = &self.splits[usize::from(self.is_mostly_regular)..];
        self.attempt(left, &target, InCluster::Nowhere, accepted)
            || self.search(t_first_last, free, accepted)
    }

    /// Take every solution of a pose with clusters of roots; returns whether their number is
    /// certain.
    pub(crate) fn search(
        &self,
        t_first_last: &Pose,
        free: &FreeChoice<6>,
        accepted: &mut Accepted,
    ) -> bool {
        let target = self.closure.target_of(t_first_last);
        // What is double in one split is seldom so in another: no cluster is searched everywhere
        // before all splits were tried.
        let is_certain = [InCluster::Middle, InCluster::Everywhere]
            .into_iter()
            .any(|in_cluster| self.attempt(&self.splits, &target, in_cluster, accepted));
        if !is_certain {
            self.complete(t_first_last, free, accepted);
        }
        is_certain
    }

    /// Take what splits find, until one is certain to find all; returns whether one is, or nothing is
    /// in reach.
    fn attempt(
        &self,
        splits: &[Split],
        target: &Target,
        in_cluster: InCluster,
        accepted: &mut Accepted,
    ) -> bool {
        let closure = &self.closure;
        target.is_beyond()
            || splits.iter().any(|split| {
                accepted.begin();
                run_vectors(Attempt { split, closure, target, in_cluster, accepted })
            })
    }

    /// Keep one member of each self-motion, that which the free joint's angle of `free` chooses.
    /// Without one look for solutions all over the joints.
    #[cold]
    fn complete(&self, t_first_last: &Pose, free: &FreeChoice<6>, accepted: &mut Accepted) {
        let target = self.closure.target_of(t_first_last);
        let near = self.joint_map.theta(&free.q);
        if accepted.has_self_motion() {
            accepted.represent(&self.closure, &target, &near);
        }
        if !accepted.has_self_motion() {
            self.start_anywhere(&target, accepted);
            if accepted.has_self_motion() {
                accepted.represent(&self.closure, &target, &near);
            }
        }
        accepted.take_undecided(&self.closure, &target);
    }

    /// Take what Newton's method leads to from all over the joints (eq. 104a).
    #[cold]
    fn start_anywhere(&self, target: &Target, accepted: &mut Accepted) {
        accepted.begin();
        let mut starts = (0..STARTS).map(quasi_random);
        // Rounds that are left in each lane: one that closes, or has none left, takes a new start.
        let (mut theta, mut left) = ([[0.0; LANES]; 6], [0; LANES]);
        loop {
            for lane in 0..LANES {
                if left[lane] == 0
                    && let Some(start) = starts.next()
                {
                    left[lane] = ROUNDS;
                    for joint in 0..6 {
                        theta[joint][lane] = start[joint];
                    }
                }
            }
            if left == [0; LANES] {
                break;
            }
            let mut candidates = self.closure.converged(target, &theta);
            theta = candidates.theta;
            for (residual, left) in candidates.residual.iter_mut().zip(&mut left) {
                let is_done = *left == 1 || *left > 0 && *residual <= self.closure.accepts();
                *left = if is_done { 0 } else { left.saturating_sub(1) };
                if !is_done {
                    *residual = f64::INFINITY;
                }
            }
            accepted.take(&self.closure, target, &candidates, LANES);
        }
    }

    /// The solutions as slots, which are ordinals.
    pub(super) fn branches(&self, t_first_last: &Pose, free: &FreeChoice<6>) -> Branches<6, SLOTS> {
        let mut accepted = Accepted::NONE;
        let is_certain = self.solutions(t_first_last, free, &mut accepted);
        self.slots(t_first_last, &mut accepted, is_certain)
    }

    /// Solutions of a pose in slots.
    pub(crate) fn slots(
        &self,
        t_first_last: &Pose,
        accepted: &mut Accepted,
        is_certain: bool,
    ) -> Branches<6, SLOTS> {
        let is_flat = accepted.has_singular()
            && accepted.merge_flat(&self.closure, &self.closure.target_of(t_first_last));
        let is_cut = accepted.cut();
        let all = accepted.as_slice();
        let reach = if all.is_empty() { Reach::NoRoots } else { Reach::Reached };
        let mut branches = Branches::empty(reach);
        branches.is_certified = is_certain && !is_flat && !is_cut;
        let (order, _) = in_order_one_by_one(all.len(), |number| &all[number].theta);
        for (slot, number) in order[..all.len()].iter().enumerate() {
            let one = &all[usize::from(*number)];
            branches.q[slot] = Some(self.joint_map.joints(one.theta));
            branches.flags[slot] = kinds_of(one).into();
            if let Kind::Free(moving) | Kind::Surface(moving) = one.kind {
                branches.free[slot] = FreeJoint::of_chain(moving);
            }
        }
        branches
    }

    /// The member of the self-motion of a joint vector of a pose with a joint at an angle: of
    /// several the nearest.
    pub(super) fn member_of(
        &self,
        t_first_last: &Pose,
        q: &[f64; 6],
        joint: usize,
        value: f64,
    ) -> Option<[f64; 6]> {
        let target = self.closure.target_of(t_first_last);
        let mut near = *q;
        near[joint] = value;
        let near = self.joint_map.theta(&near);
        let theta = self.joint_map.theta(q);
        let on_surface = self.closure.member_of_surface(&target, &theta, joint, near[joint]);
        let mut motions = self.closure.self_motions(&target, &theta);
        let member =
            on_surface.or_else(|| motions.find_map(|motion| motion.member(joint, &near)))?;
        Some(self.joint_map.joints(member.theta))
    }

    /// Walk along the self-motions of a joint vector of a pose.
    pub(super) fn walk_along(&self, t_first_last: &Pose, q: &[f64; 6], pass: &mut TakeStep<'_, 6>) {
        let target = self.closure.target_of(t_first_last);
        let joints = |theta: &[f64; 6]| self.joint_map.joints(*theta);
        for motion in self.closure.self_motions(&target, &self.joint_map.theta(q)) {
            motion.around(&mut |one, next| {
                pass(&joints(&one.theta), &joints(&next.theta));
                ControlFlow::Continue(())
            });
        }
    }

    /// The singularities of a joint vector.
    pub(super) fn kinds(&self, q: &[f64; 6]) -> SingularityKind {
        let least = self.closure.least_singular_value(&self.joint_map.theta(q));
        if least < CLOSURE_SINGULAR { SingularityKind::ELBOW } else { SingularityKind::empty() }
    }
}

/// The singularities of a solution: two that merge are as those of an elbow, a self-motion as that
/// of a wrist.
fn kinds_of(one: &Configuration) -> SingularityKind {
    match one.kind {
        Kind::Regular if one.least >= CLOSURE_SINGULAR => SingularityKind::empty(),
        Kind::Regular | Kind::Merged(_) => SingularityKind::ELBOW,
        Kind::Free(_) | Kind::Surface(_) => SingularityKind::WRIST,
    }
}
