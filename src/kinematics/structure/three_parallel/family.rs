//! The self-motion of four parallel axes: axis 6 turns, and the planar arm follows.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::geometry::ThreeParallel;
use super::reaching::Circle;
use super::wrist::{PlaneUncertainty, Turn};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::family::Family;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::planar_arm::{Shoulder, Target};

/// The self-motion of `q`, whose axis 6 is parallel to axes 2, 3 and 4.
pub(super) struct FourParallel<'a> {
    pub(super) arm: &'a ThreeParallel,
    pub(super) target: Target<'a>,
    pub(super) shoulder: Shoulder,
    pub(super) q: [f64; 6],
}

impl<'a> FourParallel<'a> {
    pub(super) fn of(
        arm: &'a ThreeParallel,
        t_shoulder_wrist: &'a Pose,
        q: [f64; 6],
        rest: &'a FreeChoice<6>,
    ) -> Self {
        let target = arm.planar.target(t_shoulder_wrist, rest, arm.joint_map.theta(&rest.q));
        let (sin_1, cos_1) = arm.joint_map.theta(&q)[0].sin_cos();
        let x = target.wxy[0] * cos_1 + target.wxy[1] * sin_1;
        Self { arm, target, shoulder: Shoulder { sin_1, cos_1, x, error: 0.0 }, q }
    }
}

impl Family<6> for FourParallel<'_> {
    fn at(&self, angle: f64) -> [Option<([f64; 6], bool)>; 2] {
        let Self { arm, target, shoulder, .. } = self;
        let theta_6 = arm.joint_map.signs[5] * angle - arm.joint_map.offsets[5];
        let plane = PlaneUncertainty::of(arm, shoulder, target);
        let determining = plane.determining(theta_6);
        let nearest = || plane.nearest_to_wrist(target).0;
        let shoulder = determining.map_or_else(nearest, |turned| plane.rotated(turned));
        let Ok(reaching) = arm.at(shoulder, Turn::Taken(theta_6), target) else { return [None; 2] };
        let elbows = &reaching.elbows;
        let behind = elbows.behind.as_ref().unwrap_or(&elbows.front);
        [(&elbows.front, false), (behind, true)].map(|(elbow, is_behind)| {
            Some((arm.joints(&reaching.shoulder, elbow, &reaching.wrist), is_behind))
        })
    }

    /// The angles between which the arm only bends or only straightens: where it is the most bent
    /// and the least of all, and four where it may come to an edge of reach.
    fn corners(&self) -> [f64; 6] {
        let Self { arm, q, .. } = self;
        let [_, theta_2, theta_3, theta_4, theta_5, _] = arm.joint_map.theta(q);
        let (c2, k) = (arm.planar.c2, arm.planar.k);
        let (theta_23, phi) = (theta_2 + theta_3, theta_2 + theta_3 + theta_4);
        let wrist = [
            c2 * theta_2.sin() + k * theta_23.sin() + arm.d5 * phi.sin(),
            c2 * theta_2.cos() + k * theta_23.cos() + arm.d5 * phi.cos(),
        ];
        let (towards, beyond) = ([phi.sin(), phi.cos()], 0.5 * arm.planar.position_rounding());
        let circle = Circle::about(arm, wrist, towards, beyond);
        let Some(Circle { from_line, least, most }) = circle else { return [q[5]; 6] };
        // phi + theta_6 is fixed at theta_5 = 0, phi - theta_6 at 180 deg.
        let sign = -arm.joint_map.signs[5] * theta_5.cos().signum();
        [0.0, PI, least, -least, most, -most].map(|at| q[5] + sign * (at - from_line))
    }

    fn bit(&self) -> usize {
        2
    }

    /// An arm that is folded onto axis 2 turns about it.
    fn pair(&self, _: &[f64; 6]) -> (usize, usize, f64) {
        let signs = self.arm.joint_map.signs;
        (1, 3, signs[1] * signs[3])
    }
}
