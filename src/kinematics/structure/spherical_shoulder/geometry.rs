//! The stored geometry of an arm with a spherical shoulder, and what follows from it for joint
//! angles.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Rotation3, Vector3};

use super::links::Links;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::thresholds::ROTATION_ROUNDING;

/// The geometry between the shoulder, where axes 1, 2 and 3 meet, and the flange.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SphericalShoulder {
    pub(super) links: Links,
    /// Its last frame is that of joint 7: the transform after it is constant.
    pub(super) joint_map: JointMap<7>,
    /// From the frame of joint 7 at theta_7 = 0 to the hand, at the intersection of axes 5 and 6.
    pub(super) t_seven_hand: Pose,
}

impl SphericalShoulder {
    /// Upper bound of the rounding of a pose of this arm [m, rad].
    pub(crate) fn rounding(&self) -> f64 {
        self.links.position_rounding().max(ROTATION_ROUNDING)
    }

    pub(super) fn theta(&self, q: &[f64; 7]) -> [f64; 7] {
        self.joint_map.theta(q)
    }

    /// Distance of the shoulder from the plane of axes 5 and 6 (eq. 60), signed [m].
    pub(super) fn aside(&self, q: &[f64; 7]) -> f64 {
        let [_, _, _, theta_4, theta_5, ..] = self.theta(q);
        self.links.elbow_at(theta_4).across * theta_5.cos()
    }

    /// The hand with joint 7 at `q7`, from the frame of joint 7 before its rotation (eq. 52).
    pub(crate) fn hand(&self, t_shoulder_seven: &Pose, q7: f64) -> Pose {
        let theta_7 = self.joint_map.signs[6] * q7 - self.joint_map.offsets[6];
        let unturned = Rotation3::from_axis_angle(&Vector3::z_axis(), -theta_7);
        t_shoulder_seven * unturned * self.t_seven_hand
    }
}
