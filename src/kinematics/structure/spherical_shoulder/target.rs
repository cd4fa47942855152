//! The target of a solve: the hand's pose, and the choice for an undetermined joint.

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::pose::Pose;
use crate::kinematics::structure::free_choice::FreeChoice;

/// The input of the branches of one pose.
pub(super) struct Target<'a> {
    /// The hand in the shoulder frame.
    pub(super) rotation: &'a Matrix3<f64>,
    /// The shoulder in the hand frame (eq. 53) [m].
    pub(super) seen: [f64; 3],
    /// Distance of the shoulder from axis 6 [m].
    pub(super) rho: f64,
    /// Distance of the shoulder from the intersection of axes 5 and 6 [m].
    pub(super) r: f64,
    pub(super) free: &'a FreeChoice<7>,
    pub(super) free_theta: [f64; 7],
    /// Largest distance of the shoulder from where the arm can bring it at which the pose counts as
    /// reached [m].
    pub(super) tolerance: f64,
}

impl<'a> Target<'a> {
    pub(super) fn new(
        t_shoulder_hand: &'a Pose,
        free: &'a FreeChoice<7>,
        free_theta: [f64; 7],
        tolerance: f64,
    ) -> Self {
        let rotation = t_shoulder_hand.rotation.matrix();
        let w = t_shoulder_hand.translation.vector;
        let [x, y, z] = (-rotation.tr_mul(&w)).into();
        let rho: f64 = x.hypot(z);
        Self { rotation, seen: [x, y, z], rho, r: w.norm(), free, free_theta, tolerance }
    }
}
