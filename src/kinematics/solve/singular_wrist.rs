//! The wrist of a singular pose: twins, the pair of joints about axes 4 and 6, and the uncertainty
//! that another singularity adds.

use core::f64::consts::{PI, TAU};

use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::solve::correction::DAMPED;
use crate::kinematics::solve::nearest::{NearestSearch, Wanted};
use crate::kinematics::solve::pair::Pair;
use crate::kinematics::thresholds::{LIMIT_SLACK, PATH_WRIST_SIN};

/// Steps per turn in the search of a wrist that is undetermined near another singularity.
const WRIST_STEPS: u32 = 24;

/// Difference of the joints of two arms below which they are the same [rad].
const SAME_ARM: f64 = 1e-9;

impl<const N: usize> NearestSearch<'_, N> {
    /// Search near joint vectors with joint 5 at its singularity, on either side.
    pub(super) fn start_with_straight_wrist(&mut self, start: &[f64; N], solution: &Solution<N>) {
        let Some(wrist) = self.robot.singular_wrist() else { return };
        for side in [1.0, -1.0] {
            let straight = wrist.with_straight_wrist(start, side);
            self.move_keeping(&straight, &[4], DAMPED, solution);
        }
    }

    /// Search the angles of two joints whose sum alone the pose determines or, near another
    /// singularity, hardly more.
    pub(super) fn look_at_wrist(&mut self, solution: &Solution<N>) {
        let Some(pair) = self.pair(solution) else { return };
        if !self.is_new(solution) {
            return;
        }
        let Wanted { limits, seed, weights, .. } = self.wanted;
        let own = solution.q[pair.first];
        if let Some(nearest) = pair.nearest(limits, seed, weights)
            && self.move_onto_pose(&pair.put(&solution.q, nearest), 0.0, solution)
            && self.best.is_some()
        {
            return;
        }
        // If rounding leaves a part of the turn undetermined, that part contains one of the twins
        // and ends inside the limits or at one of their ends.
        let ends = pair.edges(limits).map(|edge| if edge.is_finite() { edge } else { own });
        for angle in [seed[pair.first], own, own + PI].into_iter().chain(ends) {
            self.move_with_wrist_at(&pair, angle, solution);
        }
        // A further condition may exclude the parts in which an angle is known.
        if self.best.is_none() && self.must_meet() && solution.free_joint.is_none() {
            for step in 0..WRIST_STEPS {
                let angle = own + f64::from(step) * TAU / f64::from(WRIST_STEPS);
                self.move_with_wrist_at(&pair, angle, solution);
            }
        }
    }

    /// Search with the first joint of a pair at an angle; joint 5 and the elbow, which another
    /// singularity may leave undetermined, keep theirs.
    fn move_with_wrist_at(&mut self, pair: &Pair, angle: f64, from: &Solution<N>) {
        let q = pair.put(&from.q, angle);
        self.move_onto_pose(&q, LIMIT_SLACK, from);
        if self.best.is_some() && from.singularities().is_empty() {
            return;
        }
        self.move_keeping(&q, &[2], DAMPED, from);
        if let Some(wrist) = self.robot.singular_wrist() {
            let straight = wrist.with_straight_wrist(&q, 0.0);
            self.move_keeping(&straight, &[4], DAMPED, from);
            self.move_keeping(&straight, &[2, 4], DAMPED, from);
        }
    }

    /// The pair of joints that a solution leaves undetermined, or that may be so near another
    /// singularity.
    fn pair(&self, solution: &Solution<N>) -> Option<Pair> {
        let declared = solution.free_joint.and_then(|free| Pair::of(free, &solution.q));
        if declared.is_some() {
            return declared;
        }
        let wrist = self.robot.singular_wrist()?;
        let q = &solution.q;
        // If it is off the pose by more than rounding, it must be a wrist whose branches are
        // merged.
        let may_be_undetermined =
            self.must_meet() || solution.singularities().contains(SingularityKind::WRIST);
        (may_be_undetermined && self.robot.sin_5(q)?.abs() <= PATH_WRIST_SIN)
            .then(|| Pair::of(wrist.wrist_pair(q), &solution.q))?
    }

    /// Whether the wrist of this arm was not searched before.
    fn is_new(&mut self, solution: &Solution<N>) -> bool {
        let side = solution.slot.index() % 2 == 1;
        let arm: [f64; 3] =
            core::array::from_fn(|joint| solution.q.get(joint).copied().unwrap_or(0.0));
        let same = |(other, other_side): &([f64; 3], bool)| {
            side == *other_side && arm.iter().zip(other).all(|(a, b)| wrap(a - b).abs() <= SAME_ARM)
        };
        if N == 6 && self.arms.iter().flatten().any(same) {
            return false;
        }
        if let Some(place) = self.arms.iter_mut().find(|place| place.is_none()) {
            *place = Some((arm, side));
        }
        true
    }
}
