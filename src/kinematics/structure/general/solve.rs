//! Every solution of a pose: by the best split, and by others where its count is not certain.

use super::General;
use super::attempt::Attempt;
use super::moments::Motion;
use crate::kinematics::answer::slot::MOST_SLOTS;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::branches::Branches;
use crate::kinematics::structure::closure::{Accepted, Configuration, Kind};
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::lanes::run;
use crate::report::Reach;

/// Least singular value of the closure, lengths in units of the arm, below which a joint vector is
/// singular [1]: the root of rounding, at which two solutions merge.
const SINGULAR: f64 = 1e-7;

/// Difference of two angles that are the same for the order of solutions [rad].
const TIED: f64 = 1e-6;

impl General {
    /// Every solution of a pose, and whether their number is certain.
    pub(crate) fn solve_all(&self, t_first_last: &Pose) -> (Accepted, bool) {
        let target = self.closure.target_of(t_first_last);
        let t_last_first = Motion { r: target.frame.rotation, t: target.frame.origin }.inverse();
        let mut accepted = Accepted::NONE;
        let mut is_certain = false;
        for split in self.splits.iter() {
            accepted.begin();
            is_certain = run(Attempt {
                split,
                closure: &self.closure,
                target: &target,
                t_last_first: &t_last_first,
                accepted: &mut accepted,
            });
            if is_certain {
                break;
            }
        }
        if accepted.has_self_motion() {
            accepted.thin(&self.closure, &target);
        }
        (accepted, is_certain)
    }

    /// The solutions as slots, which are ordinals.
    pub(super) fn branches(
        &self,
        t_first_last: &Pose,
        _free: &FreeChoice<6>,
    ) -> Branches<6, MOST_SLOTS> {
        let (accepted, is_certain) = self.solve_all(t_first_last);
        self.slots(accepted, is_certain)
    }

    /// Solutions in slots.
    pub(crate) fn slots(
        &self,
        mut accepted: Accepted,
        is_certain: bool,
    ) -> Branches<6, MOST_SLOTS> {
        accepted.as_mut_slice().sort_unstable_by(in_order);
        let is_empty = accepted.as_slice().is_empty();
        let reach = if is_empty { Reach::NoRoots } else { Reach::Reached };
        let mut branches = Branches::empty(reach);
        branches.is_certified = is_certain;
        for (slot, one) in accepted.as_slice().iter().enumerate() {
            branches.q[slot] = Some(self.joint_map.joints(one.theta));
            branches.flags[slot] = kinds_of(one).into();
        }
        branches
    }

    /// The singularities of a joint vector.
    pub(super) fn kinds(&self, q: &[f64; 6]) -> SingularityKind {
        let least = self.closure.least_singular_value(&self.joint_map.theta(q));
        if least < SINGULAR { SingularityKind::ELBOW } else { SingularityKind::empty() }
    }
}

/// The singularities of a solution: two that merge are as those of an elbow, a self-motion as that
/// of a wrist.
fn kinds_of(one: &Configuration) -> SingularityKind {
    match one.kind {
        Kind::Regular if one.least >= SINGULAR => SingularityKind::empty(),
        Kind::Regular | Kind::Fold => SingularityKind::ELBOW,
        Kind::Free { .. } => SingularityKind::WRIST,
    }
}

/// The order of solutions: by their first angles that differ.
fn in_order(a: &Configuration, b: &Configuration) -> core::cmp::Ordering {
    let pairs = a.theta.iter().zip(&b.theta);
    let differ = |(a, b): &(&f64, &f64)| (**a - **b).abs() > TIED;
    pairs.into_iter().find(differ).map_or(core::cmp::Ordering::Equal, |(a, b)| a.total_cmp(b))
}
