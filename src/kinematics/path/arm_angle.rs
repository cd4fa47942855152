//! Paths of programs: of a `YuMi`, the arm angle goes along evenly.

use alloc::vec::Vec;

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::kinematics::path::follow::{Break, BreakReason, Followed, between, largest_step};
use crate::kinematics::path::singularity_mode::SingularityMode;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::robot::Robot;
use crate::kinematics::thresholds::WRIST_ZONE;
use crate::report::Explanation;

/// Number of times that the way between two poses is halved to find a smaller step.
const HALVINGS: u32 = 8;

impl<const N: usize> Robot<N> {
    /// Follow a path from the joints [rad] at its first pose. Of a `YuMi`, the arm angle goes
    /// evenly to one at its end [rad]; a singularity mode is for six joints.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`]; a pose that cannot be reached is a break, not an error.
    #[doc(hidden)]
    pub fn follow_at(
        &self,
        path: &[Pose],
        from: &[f64; N],
        arm_angle: Option<f64>,
        singularity_mode: SingularityMode,
        interrupt: Interrupt<'_>,
    ) -> Result<Followed<N>, Error> {
        if self.with_redundancy().is_some() {
            return self.follow_arm_angle(path, from, arm_angle);
        }
        self.follow_in_mode(path, [from, &[1.0; N]], (singularity_mode, WRIST_ZONE), interrupt)
    }

    /// The joints at the end of a way, of which `halvings` more may be halved.
    fn walk_to(
        &self,
        from: &[f64; N],
        [start, end]: [(&Pose, f64); 2],
        halvings: u32,
    ) -> Option<[f64; N]> {
        if let Some(q) = self.with_configurations().ok()?.step_to(from, end.0, end.1) {
            return Some(q);
        }
        let halvings = halvings.checked_sub(1)?;
        let middle = (&between(start.0, end.0, 0.5), f64::midpoint(start.1, end.1));
        let q = self.walk_to(from, [start, middle], halvings)?;
        self.walk_to(&q, [middle, end], halvings)
    }

    /// Follow a path from the joints at its first pose, the arm angle going evenly to another.
    fn follow_arm_angle(
        &self,
        path: &[Pose],
        from: &[f64; N],
        arm_angle: Option<f64>,
    ) -> Result<Followed<N>, Error> {
        let own = self.arm_angle(from)?.or(arm_angle).unwrap_or_default();
        let change = wrap(arm_angle.unwrap_or(own) - own);
        #[expect(clippy::cast_precision_loss, reason = "there are fewer than 2^52 poses")]
        let part = |index: usize| index as f64 / (path.len().max(2) - 1) as f64;
        let (mut joints, mut breaks) = (Vec::with_capacity(path.len()), Vec::new());
        let mut q = *from;
        joints.extend(path.first().map(|_| Some(q)));
        for (index, poses) in path.windows(2).enumerate() {
            let angles = [part(index), part(index + 1)].map(|part| own + part * change);
            let way = [(&poses[0], angles[0]), (&poses[1], angles[1])];
            let next = self.walk_to(&q, way, HALVINGS);
            if let Some(next) = next.filter(|next| self.limits().contains(next)) {
                q = next;
                joints.push(Some(q));
                continue;
            }
            let reason = self.reason(&q, next, &poses[1], angles[1])?;
            breaks.push(Break { pose_index: index + 1, reason });
            break;
        }
        joints.resize(path.len(), None);
        Ok(Followed { q: joints, orientation_error: Vec::new(), breaks })
    }

    /// The reason why no way leads from joints to a pose and an arm angle, or only one outside the
    /// limits.
    fn reason(
        &self,
        q: &[f64; N],
        outside: Option<[f64; N]>,
        pose: &Pose,
        arm_angle: f64,
    ) -> Result<BreakReason, Error> {
        if let Some(outside) = outside {
            let excess = |joint: usize| self.limits().excess(joint, outside[joint]);
            let joint = (0..N).max_by(|a, b| excess(*a).total_cmp(&excess(*b))).unwrap_or(0);
            let (joint, excess) = (joint + 1, excess(joint));
            let explanation = Explanation::OutsideLimits { solutions: 1, joint, excess };
            return Ok(BreakReason::Unreachable(explanation));
        }
        match self.ik_nearest_at(pose, q, Some(arm_angle)) {
            Ok(other) => {
                let (joint, by) = largest_step(q, &other);
                Ok(BreakReason::Jump { joint, by, kinds: self.singularity(q).kinds })
            }
            Err(Error::Unreachable(explanation)) => Ok(BreakReason::Unreachable(explanation)),
            Err(error) => Err(error),
        }
    }
}
