//! The stored geometry of an arm with three parallel axes, and what follows from it for joint
//! angles.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::planar_arm::PlanarArm;

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist, the
/// intersection of axes 5 and 6.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ThreeParallel {
    /// The arm up to axis 4.
    pub(super) planar: PlanarArm,
    /// Distance of the wrist from axis 4, along axis 5 [m].
    pub(super) d5: f64,
    pub(super) joint_map: JointMap<6>,
}

impl ThreeParallel {
    /// x of the wrist in the plane of the arm (eq. 41) [m].
    pub(super) fn x_of_wrist(&self, q: &[f64; 6]) -> f64 {
        let [_, theta_2, theta_3, theta_4, ..] = self.joint_map.theta(q);
        self.planar.x_of_end(theta_2, theta_3) + self.d5 * (theta_2 + theta_3 + theta_4).sin()
    }
}
