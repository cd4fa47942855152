//! Every solution of a pose: by the best split, and by others where its count is not certain.

use super::at_roots::AtSplit;
use super::geometry::{General, RootKind};
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::by_roots::{SLOTS, Search};
use crate::kinematics::structure::closure::{
    Accepted, Configuration, SelfMotion, in_order_one_by_one,
};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::self_motions::{SelfMotions, TakeStep};
use crate::kinematics::thresholds::CLOSURE_SINGULAR;
use crate::report::{FreeJoint, Reach};

impl General {
    /// Take every solution of a pose of the last frame; returns whether they are certified to be
    /// all.
    pub(crate) fn solutions(
        &self,
        last: &Frame,
        free: &FreeChoice<6>,
        accepted: &mut Accepted,
    ) -> bool {
        let near = self.joint_map.theta(&free.q);
        let wanted = if let RootKind::Pairs(wanted) = self.roots { wanted } else { 1 };
        self.search(Search::new(&self.closure, last, near, accepted, wanted))
    }

    /// Go on with a search by the splits of this arm.
    pub(crate) fn search(&self, mut search: Search<'_>) -> bool {
        for number in 0..self.splits.len() {
            search.attempt(&self.split(number));
        }
        search.finish()
    }

    /// Return a split as a method.
    pub(super) fn split(&self, number: usize) -> AtSplit {
        AtSplit::new(&self.closure, &self.splits, number)
    }

    /// Put solutions of a pose into slots.
    pub(crate) fn slots(&self, accepted: &mut Accepted, is_certified: bool) -> Branches<6, SLOTS> {
        let is_cut = accepted.cut();
        let all = accepted.as_slice();
        let reach = if all.is_empty() { Reach::NoRoots } else { Reach::Reached };
        let mut branches = Branches::empty(reach);
        branches.is_certified = is_certified && !is_cut;
        let (order, _) = in_order_one_by_one(all.len(), |number| &all[number].theta);
        for (slot, number) in order[..all.len()].iter().enumerate() {
            let one = &all[usize::from(*number)];
            branches.q[slot] = Some(self.joint_map.joints(one.theta));
            branches.flags[slot] = singularities_of(one).into();
            branches.free[slot] =
                one.moving.and_then(|moving| FreeJoint::of_chain(self.joint_map.moving(moving)));
        }
        branches
    }
}

impl SelfMotions<6> for General {
    fn member(&self, t: &Pose, q: &[f64; 6], joint: usize, value: f64) -> Option<[f64; 6]> {
        let target = self.closure.target_of(t);
        let mut near = *q;
        near[joint] = value;
        let near = self.joint_map.theta(&near);
        let motion = SelfMotion::through(&self.closure, &target, &self.joint_map.theta(q))?;
        Some(self.joint_map.joints(motion.member(joint, &near)?))
    }

    fn walk(&self, t: &Pose, q: &[f64; 6], pass: &mut TakeStep<'_, 6>) {
        let target = self.closure.target_of(t);
        let joints = |theta: &[f64; 6]| self.joint_map.joints(*theta);
        let motion = SelfMotion::through(&self.closure, &target, &self.joint_map.theta(q));
        if let Some(motion) = motion {
            motion.around(&mut |[one, next]| pass(&joints(&one.theta), &joints(&next.theta)));
        }
    }
}

/// Return the singularities of a solution: a fold counts as an elbow, a self-motion as a wrist.
fn singularities_of(one: &Configuration) -> SingularityKind {
    if one.moving.is_some() {
        SingularityKind::WRIST
    } else if one.least < CLOSURE_SINGULAR {
        SingularityKind::ELBOW
    } else {
        SingularityKind::empty()
    }
}
