//! The joint map: from the joints and frames of a derivation to the joints and frames of the arm.

use crate::kinematics::chain::coupling::{coupled, uncoupled};
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;

/// Signs and offsets of the joints, and the transforms before and after the frames of the
/// derivation.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct JointMap<const N: usize> {
    pub(crate) signs: [f64; N],
    pub(crate) offsets: [f64; N],
    /// Factor of q2 in the controller's q3: 1, -1 or, without a coupling, zero.
    pub(crate) coupling: f64,
    pub(crate) t_base_shoulder: Pose,
    pub(crate) t_wrist_flange: Pose,
}

impl<const N: usize> JointMap<N> {
    /// The derivation's angles theta for joint angles `q`.
    pub(crate) fn theta(&self, q: &[f64; N]) -> [f64; N] {
        let q = uncoupled(*q, self.coupling);
        core::array::from_fn(|i| self.signs[i] * q[i] - self.offsets[i])
    }

    /// The joint angles for theta, in (-pi, pi] (eq. 19, 25).
    pub(crate) fn joints(&self, theta: [f64; N]) -> [f64; N] {
        let q = core::array::from_fn(|i| self.signs[i] * (theta[i] + self.offsets[i]));
        coupled(q, self.coupling).map(wrap)
    }

    /// The joints that move if these angles theta do.
    pub(crate) fn moving(&self, mut theta: [bool; N]) -> [bool; N] {
        if let [_, second, third, ..] = &mut theta[..] {
            *third |= *second && self.coupling != 0.0;
        }
        theta
    }
}
