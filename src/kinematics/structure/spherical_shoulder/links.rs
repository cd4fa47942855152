//! The lengths of the arm, and the position of the shoulder for an angle of joint 4.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::pose::Pose;
use crate::kinematics::thresholds::{POSITION_ROUNDING, SHOULDER_MERGE};

/// Upper arm and forearm. Both run along z of the upright arm; x points to the side on which axis 4
/// is offset from axis 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Links {
    /// Distance of axis 4 from axis 3 [m].
    pub(super) a3: f64,
    /// Upper arm, along axis 3 [m].
    pub(super) c3: f64,
    /// Distance of axis 5 from axis 4 [m]; negative towards axis 3 where a3 is positive.
    pub(super) a4: f64,
    /// Forearm, along axis 5 [m].
    pub(super) c5: f64,
    /// Length of the upper arm, hypot(a3, c3) [m].
    pub(super) upper: f64,
    /// Length of the forearm, hypot(a4, c5) [m].
    pub(super) forearm: f64,
    /// Sine and cosine of the angle of joint 4 of the stretched arm.
    pub(super) psi: [f64; 2],
    /// The sum of the lengths that contribute to a position of the tool [m].
    pub(super) extent: f64,
}

/// One configuration of the elbow, with the position of the shoulder in the forearm frame: in the
/// plane of axes 3 and 5.
#[derive(Clone, Copy, Debug)]
pub(super) struct Elbow {
    pub(super) sin_4: f64,
    pub(super) cos_4: f64,
    /// From axis 5 to the shoulder [m].
    pub(super) across: f64,
    /// From axis 6 to the shoulder, along axis 5 [m].
    pub(super) along: f64,
    /// Stretched or folded: it represents both elbows.
    pub(super) straight: bool,
    /// How far rounding may rotate joint 4 [rad].
    pub(super) error: f64,
}

impl Links {
    /// Links with the given lengths [m].
    pub(super) fn new([a3, c3, a4, c5]: [f64; 4]) -> Self {
        let (upper, forearm) = (a3.hypot(c3), a4.hypot(c5));
        let psi =
            [(a3 * c5 - c3 * a4) / (upper * forearm), (a3 * a4 + c3 * c5) / (upper * forearm)];
        Self { a3, c3, a4, c5, upper, forearm, psi, extent: upper + forearm }
    }

    /// The same links between fixed transforms, whose lengths add to the rounding of a position.
    pub(super) fn between(self, fixed: [&Pose; 5]) -> Self {
        let fixed: f64 = fixed.map(|pose| pose.translation.vector.norm()).iter().sum();
        Self { extent: self.upper + self.forearm + fixed, ..self }
    }

    /// Upper bound of the rounding of a position of this arm [m].
    pub(super) fn position_rounding(&self) -> f64 {
        POSITION_ROUNDING * self.extent
    }

    /// Typical rounding of a position of this arm [m]: a link with lever l is rotated by this over
    /// l.
    pub(super) fn direction_rounding(&self) -> f64 {
        2.0 * f64::EPSILON * self.extent
    }

    pub(super) fn product(&self) -> f64 {
        self.upper * self.forearm
    }

    /// The square of m (eq. 55) below which a straight arm reaches the shoulder too, to half the
    /// rounding of a position.
    pub(super) fn straight_m2(&self, r: f64) -> f64 {
        self.position_rounding() * r * self.product()
    }

    /// Whether the shoulder, at distance `r` from the intersection of axes 5 and 6, counts as being
    /// there; distances below `radius` count as zero [m]. Neither elbow then determines joints 5
    /// and 6: the shoulder may be that far from each of their axes, at a right angle, and the
    /// rounding of eq. 58 is at most a tenth of it.
    pub(super) fn is_onto_itself(&self, r: f64, radius: f64) -> bool {
        r <= 1.5 * radius.max(self.position_rounding())
    }

    /// Angle between upper arm and forearm from stretched, for the angle of axis 4 [rad].
    pub(super) fn elbow_angle(&self, theta_4: f64) -> f64 {
        theta_4 - self.psi[0].atan2(self.psi[1])
    }

    /// Sine and cosine of joint 4 for those of the elbow angle (eq. 57).
    pub(super) fn joint_4(&self, [sin_e, cos_e]: [f64; 2]) -> [f64; 2] {
        let [sin_psi, cos_psi] = self.psi;
        [sin_e * cos_psi + cos_e * sin_psi, cos_e * cos_psi - sin_e * sin_psi]
    }

    /// Sine of the elbow angle for sine and cosine of joint 4.
    pub(super) fn sin_elbow(&self, [sin_4, cos_4]: [f64; 2]) -> f64 {
        sin_4 * self.psi[1] - cos_4 * self.psi[0]
    }

    /// The position of the shoulder in the forearm frame (eq. 58), for sine and cosine of joint 4.
    pub(super) fn elbow(&self, [sin_4, cos_4]: [f64; 2]) -> Elbow {
        Elbow {
            sin_4,
            cos_4,
            across: self.c3 * sin_4 - self.a3 * cos_4 - self.a4,
            along: -(self.a3 * sin_4 + self.c3 * cos_4) - self.c5,
            straight: false,
            error: 0.0,
        }
    }

    pub(super) fn elbow_at(&self, theta_4: f64) -> Elbow {
        let (sin_4, cos_4) = theta_4.sin_cos();
        self.elbow([sin_4, cos_4])
    }

    /// How fast the shoulder moves across and along the forearm with joint 4 [m/rad].
    pub(super) fn speeds(&self, elbow: &Elbow) -> [f64; 2] {
        [-(elbow.along + self.c5), elbow.across + self.a4]
    }

    /// Whether the arm counts as stretched or folded.
    pub(super) fn is_straight(&self, theta_4: f64) -> bool {
        let elbow = self.elbow_at(theta_4);
        let (r, sin_e) = (elbow.across.hypot(elbow.along), self.elbow_angle(theta_4).sin());
        self.is_onto_itself(r, 0.0) || (self.product() * sin_e).powi(2) <= self.straight_m2(r)
    }

    /// Whether both branches of the wrist count as one: on axis 5, on axis 6, or at their
    /// intersection.
    pub(super) fn wrist_is_one(&self, elbow: &Elbow, theta_5: f64) -> bool {
        let (sin_5, cos_5) = theta_5.sin_cos();
        let (aside, high) = (elbow.across * cos_5, (elbow.across * sin_5).abs());
        let rho = aside.hypot(elbow.along);
        let off = (aside * aside / (elbow.across.abs() + high))
            .hypot(aside * aside / (rho + elbow.along.abs()));
        elbow.across.abs() <= SHOULDER_MERGE
            || rho <= SHOULDER_MERGE
            || off <= self.position_rounding()
    }
}
