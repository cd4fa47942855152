//! Joint 4: the two triangles of upper arm, forearm and the line from the shoulder to the
//! intersection of axes 5 and 6.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::links::{Elbow, Links};
use super::target::Target;
use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::structure::triangle::Triangle;
use crate::report::Reach;

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

/// Greatest rotation of joint 4 that may still be due to rounding [rad]: the square root of that of
/// a position, with a margin.
const MOST_EASING: f64 = 1e-6;
