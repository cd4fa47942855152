//! Moves joints near a singularity onto the pose, inside the limits.
//!
//! Where two singularities meet, rounding of the pose leaves joints undetermined that no single
//! formula names: a straight elbow leaves the forearm undetermined, and with it the split of q4 and
//! q6. A joint vector with the undetermined joint at a desired value is off the pose by about that
//! much; a few damped Newton steps move the other joints until it reaches the pose
//! (docs/theory/singularities.md, section 3).
//!
//! Reference: Nakamura and Hanafusa, Inverse Kinematic Solutions with Singularity Robustness, 1986.

use nalgebra::{SMatrix, SVector, Vector3};

use crate::kinematics::chain::jacobian::JacobianFrame;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::robot::Robot;

/// Newton steps: near the pose each squares the distance, and in some of them a joint may reach its
/// limit.
const ROUNDS: u32 = 20;

/// Largest fraction of the distance that a step may leave to be followed by another.
const GAIN: f64 = 0.8;

/// Square of the singular value below which a step is damped [1]: joints that the pose determines
/// only to 1e-5 are not moved.
pub(super) const DAMPED: f64 = 1e-10;

/// The damping if the kept joints leave nothing undetermined: damps only what no joint moves.
pub(super) const DETERMINED: f64 = 1e-18;

/// Largest step of a joint [rad]: farther away, the Jacobian differs too much.
const LARGEST_STEP: f64 = 0.5;

impl<const N: usize> Robot<N> {
    /// The joint vector near `q`, inside `limits` if `q` is, that meets the pose best, and its
    /// distance from the pose [rad, m]. The joints `kept`, from 0, are not moved, nor is joint 7;
    /// `damping` is [`DAMPED`] or [`DETERMINED`].
    pub(in crate::kinematics) fn corrected(
        &self,
        pose: &Pose,
        mut q: [f64; N],
        limits: &JointLimits<N>,
        kept: &[usize],
        damping: f64,
    ) -> ([f64; N], f64) {
        let limits = limits.to_array();
        let (mut best, mut least) = (q, self.residual(&q, pose).largest());
        let mut locked: [bool; N] =
            core::array::from_fn(|joint| joint == 6 || kept.contains(&joint));
        for _ in 0..ROUNDS {
            let Some(step) = self.step_towards(pose, &q, &locked, damping) else { break };
            let step = step * (LARGEST_STEP / step.amax()).min(1.0);
            let mut at_limit = false;
            for joint in 0..N {
                if locked[joint] {
                    continue;
                }
                let [low, high] = limits[joint];
                let stepped = q[joint] + step[joint];
                // A joint that starts on its limit, or beyond it within the tolerance, stays there
                // if the step would move it outward.
                let inside = stepped.max(low.min(q[joint])).min(high.max(q[joint]));
                if (inside - stepped).abs() > 0.0 {
                    (locked[joint], at_limit) = (true, true);
                }
                q[joint] = inside;
            }
            let off = self.residual(&q, pose).largest();
            let gain = off < GAIN * least;
            if off < least {
                (best, least) = (q, off);
            }
            if !(gain || at_limit) {
                break;
            }
        }
        (best, least)
    }

    /// The damped step from `q` towards the pose, of the joints that are not `locked`.
    fn step_towards(
        &self,
        pose: &Pose,
        q: &[f64; N],
        locked: &[bool; N],
        damping: f64,
    ) -> Option<SVector<f64, N>> {
        let mut jacobian = self.jacobian(q, JacobianFrame::Base);
        for joint in (0..N).filter(|joint| locked[*joint]) {
            jacobian.column_mut(joint).fill(0.0);
        }
        let damping = SMatrix::<f64, 6, 6>::identity() * damping;
        let factor = (jacobian * jacobian.transpose() + damping).cholesky()?;
        let step = jacobian.tr_mul(&factor.solve(&self.off(pose, q)));
        step.iter().all(|angle| angle.is_finite()).then_some(step)
    }

    /// The difference from the tool pose at `q` to the pose: translation [m] and, for small angles,
    /// rotation [rad].
    pub(super) fn off(&self, pose: &Pose, q: &[f64; N]) -> SVector<f64, 6> {
        let at = self.fk(q);
        let turn = (pose.rotation * at.rotation.inverse()).into_inner();
        let turn = 0.5
            * Vector3::new(
                turn[(2, 1)] - turn[(1, 2)],
                turn[(0, 2)] - turn[(2, 0)],
                turn[(1, 0)] - turn[(0, 1)],
            );
        let shift = pose.translation.vector - at.translation.vector;
        SVector::<f64, 6>::new(shift.x, shift.y, shift.z, turn.x, turn.y, turn.z)
    }
}
