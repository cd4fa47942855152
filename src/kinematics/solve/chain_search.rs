//! The self-motion of a chain without a closed form: its member nearest to a seed.

use crate::kinematics::answer::solutions::Solution;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::solve::correction::DETERMINED;
use crate::kinematics::solve::minimum::minimum;
use crate::kinematics::solve::nearest::NearestSearch;
use crate::report::FreeJoint;

/// How far below a member its valley may be, as a multiple of how far the way rises beside it [1]:
/// once where it bends sharply, less where it is smooth.
const MOST_DEPTH: f64 = 2.0;

/// Valleys of a self-motion that are looked into.
const VALLEYS: u32 = 16;

/// The last two members that were passed, with their heights.
struct Passed<const N: usize> {
    before: Option<([f64; N], f64)>,
    here: Option<([f64; N], f64)>,
    /// Valleys that may still be looked into.
    valleys: u32,
}

impl<const N: usize> NearestSearch<'_, N> {
    /// Walk along the self-motion of a chain.
    pub(super) fn look_along_chain(&mut self, from: &Solution<N>) {
        if self.is_done() || !matches!(from.free_joint, Some(FreeJoint::Chain { .. })) {
            return;
        }
        let mut passed = Passed { before: None, here: None, valleys: VALLEYS };
        let Some((motions, pose)) = self.robot.self_motions(self.known.pose()) else { return };
        motions.walk(&pose, &from.q, &mut |start, end| {
            self.pass(&mut passed, start, end, from);
        });
    }

    /// Take the next member, and look into the valley that it ends.
    fn pass(
        &mut self,
        passed: &mut Passed<N>,
        start: &[f64; N],
        end: &[f64; N],
        from: &Solution<N>,
    ) {
        let is_start = |(here, _): ([f64; N], f64)| {
            here.iter().zip(start).all(|(angle, start)| angle.total_cmp(start).is_eq())
        };
        if !passed.here.is_some_and(is_start) {
            let height = self.take_if_met(&Solution { q: *start, ..*from }, from);
            (passed.before, passed.here) = (None, Some((*start, height)));
        }
        let next = (*end, self.take_if_met(&Solution { q: *end, ..*from }, from));
        if let (Some(before), Some(here)) = (passed.before, passed.here)
            && here.1 < before.1
            && here.1 <= next.1
            && here.1 < MOST_DEPTH * (before.1.max(next.1) - here.1)
            && passed.valleys > 0
        {
            passed.valleys -= 1;
            let at = |part: f64| {
                let to = if part < 0.0 { &before.0 } else { &next.0 };
                let between = core::array::from_fn(|joint| {
                    here.0[joint] + part.abs() * wrap(to[joint] - here.0[joint])
                });
                let (pose, free) = (self.known.pose(), &JointLimits::UNLIMITED);
                let (q, _) = self.robot.corrected(pose, between, free, &[], DETERMINED);
                self.take_if_met(&Solution { q, ..*from }, from)
            };
            minimum(at, [-1.0, 0.0, 1.0], here.1);
        }
        (passed.before, passed.here) = (passed.here, Some(next));
    }
}
