//! What being near limits and singularities costs (docs/plan.md, eq. 4).

use super::options::PlanOptions;
use super::turns::PlannedJoints;
use crate::kinematics::Robot;

/// The costs of being near a limit and near a singularity [rad^2/s^2].
#[derive(Clone, Copy)]
pub(super) struct Soft<'a> {
    robot: &'a Robot<6>,
    limits: f64,
    singularities: f64,
}

impl<'a> Soft<'a> {
    /// `None` if neither costs anything.
    pub(super) fn of(robot: &'a Robot<6>, options: &PlanOptions) -> Option<Self> {
        let PlanOptions { limit_cost: limits, singularity_cost: singularities, .. } = *options;
        (limits > 0.0 || singularities > 0.0).then_some(Self { robot, limits, singularities })
    }

    /// Whether a joint has to have its turns told apart: they differ in cost.
    pub(super) fn tells(&self, joints: &PlannedJoints, joint: usize) -> bool {
        self.limits > 0.0 && joints.wraps[joint] && !joints.is_unlimited(joint)
    }

    /// The cost of joint angles at which a step ends that takes `time` [s].
    pub(super) fn cost(&self, q: &[f64; 6], time: f64) -> f64 {
        let [limits, singularities] = self.robot.nearness(q);
        (self.limits * limits + self.singularities * singularities) * time * time
    }
}
