//! The stored geometry of an arm with a spherical wrist, and what follows from it for joint angles.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::opw::OpwParameters;
use crate::kinematics::pose::translation_z;
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::lanes::{Kernel, MOST_SIN_COS, run, sin_cos};

/// The geometry between the shoulder (on axis 1, at the height of axis 2) and the wrist center.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SphericalWrist {
    pub(super) planar: PlanarArm,
    pub(super) joint_map: JointMap<6>,
}

impl SphericalWrist {
    pub(crate) fn from_opw(opw: &OpwParameters) -> Self {
        Self {
            planar: PlanarArm::new([opw.a1, opw.a2, opw.b, opw.c2, opw.c3]),
            joint_map: JointMap {
                signs: opw.signs.map(f64::from),
                offsets: opw.offsets,
                coupled: false,
                t_base_shoulder: translation_z(opw.c1),
                t_wrist_flange: translation_z(opw.c4),
            },
        }
    }

    #[inline]
    pub(super) fn theta(&self, q: &[f64; 6]) -> [f64; 6] {
        self.joint_map.theta(q)
    }

    /// The sine of the elbow angle, x of the wrist center in the plane of the arm [m], and the sine
    /// of joint 5, signed (eq. 21).
    #[inline]
    pub(super) fn factors(&self, q: &[f64; 6]) -> [f64; 3] {
        let [_, theta_2, theta_3, _, theta_5, _] = self.theta(q);
        let theta = [theta_2, theta_3, theta_5];
        let [second, third, fifth] = if theta.iter().all(|angle| angle.abs() <= MOST_SIN_COS) {
            run(Sines { theta })
        } else {
            theta.map(f64::sin_cos)
        };
        let [elbow, x] = self.planar.elbow_and_end(second, third);
        [elbow, x, fifth.0]
    }

    /// The angle of joint 4 nearest to that of `q` at which axis 5 is parallel to axes 2 and 3
    /// [rad]: 0 or 180 deg for ABB's arms.
    pub(crate) fn axis_4_in_plane(&self, q: &[f64; 6]) -> f64 {
        let theta_4 = self.theta(q)[3];
        q[3] + self.joint_map.signs[3] * (PI * (theta_4 / PI).round() - theta_4)
    }
}

/// Sines and cosines of three angles, side by side.
struct Sines {
    theta: [f64; 3],
}

impl Kernel for Sines {
    type Answer = [(f64, f64); 3];
    const WIDE: bool = false;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> [(f64, f64); 3] {
        // Four fill a vector.
        let (mut angles, mut sin, mut cos) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        angles[..3].copy_from_slice(&self.theta);
        for lane in 0..4 {
            (sin[lane], cos[lane]) = sin_cos::<FUSED>(angles[lane]);
        }
        [(sin[0], cos[0]), (sin[1], cos[1]), (sin[2], cos[2])]
    }
}
