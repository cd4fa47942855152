//! Upper arm and forearm, and joint 4 between them: the two triangles with the line from the
//! shoulder to the intersection of axes 5 and 6.

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::structure::free_choice::FreeChoice;
use crate::kinematics::structure::triangle::Triangle;
use crate::kinematics::thresholds::{POSITION_ROUNDING, SHOULDER_MERGE};
use crate::report::Reach;

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

    /// Place the links between fixed transforms, whose lengths add to the rounding of a position.
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

    /// Sine and cosine of joint 4 from the elbow angle's (eq. 57).
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

/// The elbow bent forwards and backwards; without the second, they are one.
pub(super) struct Elbows {
    pub(super) forwards: Elbow,
    pub(super) backwards: Option<Elbow>,
}

impl Links {
    /// Both elbows for a shoulder at distance r, or up to the tolerance beyond reach (eq. 54 to
    /// 57).
    pub(super) fn elbows(&self, target: &Target<'_>) -> Result<Elbows, Reach> {
        let (r, r2) = (target.r, target.r * target.r);
        let triangle = Triangle::reaching([self.upper, self.forearm], r, target.tolerance)?;
        let m2 = triangle.m2(r2);
        if self.is_onto_itself(r, target.free.policy.radius()) || m2 <= self.straight_m2(r) {
            let cos_e = if triangle.is_stretched(r2) { 1.0 } else { -1.0 };
            // The arm that made the pose may have been bent by as much as still counts as straight,
            // and by rounding on top of that.
            let error = 2.0 * self.straight_m2(r).sqrt() / self.product();
            let straight =
                Elbow { straight: true, error, ..self.elbow(self.joint_4([0.0, cos_e])) };
            return Ok(Elbows { forwards: straight, backwards: None });
        }
        let m = m2.sqrt();
        let cosine = 0.5 * (r2 - self.upper * self.upper - self.forearm * self.forearm);
        let norm = m.hypot(cosine);
        let error = self.direction_rounding() * r / m;
        let bent = |m: f64| Elbow { error, ..self.elbow(self.joint_4([m / norm, cosine / norm])) };
        Ok(Elbows { forwards: bent(m), backwards: Some(bent(-m)) })
    }

    /// The elbow rotated within its rounding, so that the wrist just reaches (eq. 67): near a
    /// straight arm a rounding of the pose is a large part of joint 4, and for a pose at the edge
    /// of the wrist's reach that edge determines joint 4.
    pub(super) fn eased(&self, elbow: &Elbow, target: &Target<'_>) -> Option<Elbow> {
        let (high, rho) = (target.seen[1].abs(), target.rho);
        let to_edge = |elbow: &Elbow| {
            let [across, along] = self.speeds(elbow);
            if high < rho {
                (high - elbow.across.abs()) / (across * sign_of(elbow.across))
            } else {
                (rho - elbow.along.abs()) / (along * sign_of(elbow.along))
            }
        };
        self.rotated(elbow, to_edge, target)
    }

    /// The straight elbow bent within its rounding, so that joint 5 keeps the angle of a seed,
    /// which a shoulder on axis 5 to rounding does not determine.
    pub(super) fn bent_for_seed(&self, elbow: &Elbow, target: &Target<'_>) -> Option<Elbow> {
        let open = self.speeds(elbow)[0].abs() * elbow.error;
        if !elbow.straight || target.free.policy.radius() == 0.0 || elbow.across.abs() > open {
            return None;
        }
        let across = -target.seen[1] / target.free_theta[4].sin();
        self.rotated(elbow, |elbow| (across - elbow.across) / self.speeds(elbow)[0], target)
    }

    /// The elbow after three steps of joint 4, if that leaves it the same to rounding.
    fn rotated(
        &self,
        elbow: &Elbow,
        step: impl Fn(&Elbow) -> f64,
        target: &Target<'_>,
    ) -> Option<Elbow> {
        let mut rotated = *elbow;
        for _ in 0..3 {
            let turn = step(&rotated);
            // Not finite if joint 4 does not move the shoulder in that direction.
            if turn.is_nan() || turn.abs() > MOST_EASING {
                return None;
            }
            let [sin_4, cos_4] =
                [rotated.sin_4 + rotated.cos_4 * turn, rotated.cos_4 - rotated.sin_4 * turn];
            let norm = sin_4.hypot(cos_4);
            rotated = Elbow {
                straight: elbow.straight,
                error: elbow.error,
                ..self.elbow([sin_4 / norm, cos_4 / norm])
            };
        }
        let bent = |elbow: &Elbow| self.sin_elbow([elbow.sin_4, elbow.cos_4]) < 0.0;
        let off = (rotated.across.hypot(rotated.along) - target.r).abs();
        ((elbow.straight || bent(&rotated) == bent(elbow)) && off <= target.tolerance)
            .then_some(rotated)
    }
}

/// Greatest rotation of joint 4 that may still be due to rounding [rad]: the square root of the
/// rounding of a position, with a margin.
const MOST_EASING: f64 = 1e-6;
