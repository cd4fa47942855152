//! The arm: shoulders and elbows that bring the wrist centre to a point.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalWrist;
use super::target::{Target, Trust};
use crate::kinematics::status::Reach;
use crate::kinematics::thresholds::{REACH_TOLERANCE, SEEDED_FREE};

/// One way for axis 1 to face the wrist centre.
#[derive(Clone, Copy)]
pub(super) struct Shoulder {
    pub(super) sin_1: f64,
    pub(super) cos_1: f64,
    /// Wrist centre from axis 1, along the arm's plane [m]; negative behind it.
    pub(super) x: f64,
    /// How far rounding may turn it [rad].
    pub(super) error: f64,
}

/// The shoulder that faces the wrist centre, the one that has it behind, and whether they are one.
pub(super) struct Shoulders {
    pub(super) front: Shoulder,
    pub(super) behind: Shoulder,
    pub(super) merged: bool,
    /// Where they are merged: whether the one behind is kept.
    pub(super) keep_behind: bool,
}

/// One way for the elbow to stand.
#[derive(Clone, Copy)]
pub(super) struct Elbow {
    pub(super) theta_2: f64,
    pub(super) theta_3: f64,
    pub(super) sin_23: f64,
    pub(super) cos_23: f64,
}

/// The elbow in front of and behind the line to the wrist centre; without the second, they are one.
pub(super) struct Elbows {
    pub(super) front: Elbow,
    pub(super) behind: Option<Elbow>,
    /// How far rounding may turn the forearm [rad].
    pub(super) error: f64,
    /// The wrist centre is on axis 2: the upper arm may point anywhere.
    pub(super) free: bool,
}

impl Shoulder {
    /// Turned by half a turn: what was in front is behind.
    pub(super) fn turned(self) -> Self {
        Self { sin_1: -self.sin_1, cos_1: -self.cos_1, x: -self.x, error: self.error }
    }
}

impl SphericalWrist {
    /// Both shoulders (eq. 2 to 4).
    pub(super) fn shoulders(&self, target: &Target<'_>) -> Result<Shoulders, Reach> {
        let [wx, wy] = target.wxy;
        let (rho, rounding) = (wx.hypot(wy), self.position_rounding());
        let outside = rho - self.b.abs();
        if outside < -REACH_TOLERANCE {
            return Err(Reach::TooNear { shortfall: -outside });
        }
        let (sin_1, cos_1) = target.free_theta[0].sin_cos();
        let trust = target.free.trust;
        if self.b == 0.0 && (trust.forces(1) || rho <= trust.radius().max(rounding)) {
            let keep_behind = matches!(trust, Trust::Forced { behind: true, .. });
            let kept = Shoulder { sin_1, cos_1, x: if keep_behind { -rho } else { rho }, error: 0.0 };
            let (front, behind) = if keep_behind { (kept.turned(), kept) } else { (kept, kept.turned()) };
            return Ok(Shoulders { front, behind, merged: true, keep_behind });
        }
        // With b != 0 a wrist centre on the cylinder of radius b is on it to rounding: x = 0, not the square root of that rounding.
        let x = if outside <= rounding { 0.0 } else { (outside * (rho + self.b.abs())).sqrt() };
        let merged = x <= self.shoulder_merge();
        let error = if merged { 0.0 } else { self.direction_rounding() / x };
        let front = self.shoulder(wx, wy, x, error);
        // With b != 0 the two are not opposite: theta_1 differs by pi - 2 atan2(b, x) (eq. 4).
        let behind = if self.b == 0.0 { front.turned() } else { self.shoulder(wx, wy, -x, error) };
        let keep_behind = trust != Trust::Pose && front.sin_1 * sin_1 + front.cos_1 * cos_1 < 0.0;
        Ok(Shoulders { front, behind, merged, keep_behind })
    }

    /// theta_1 from `Rz(theta_1) (x, b) = (wx, wy)` (eq. 4).
    fn shoulder(&self, wx: f64, wy: f64, x: f64, error: f64) -> Shoulder {
        let (sin, cos) = (wy * x - wx * self.b, wx * x + wy * self.b);
        let norm = sin.hypot(cos);
        Shoulder { sin_1: sin / norm, cos_1: cos / norm, x, error }
    }

    /// The shoulder with x moved towards reach as far as rounding leaves it open: next to the cylinder of radius b (eq. 3) a rounding of
    /// the pose is a large part of x, and a pose at the edge of reach says by that edge which x it has.
    pub(super) fn eased(&self, shoulder: &Shoulder, target: &Target<'_>) -> Shoulder {
        let ([wx, wy], b, rounding) = (target.wxy, self.b.abs(), self.position_rounding());
        let x_of = |outside: f64| (outside.max(0.0) * (outside + 2.0 * b)).sqrt();
        let outside = wx.hypot(wy) - b;
        let sign = if shoulder.x.is_sign_negative() { -1.0 } else { 1.0 };
        let mut nearest = f64::INFINITY;
        for length in [self.c2 + self.k, self.c2 - self.k] {
            let across = (length * length - target.wz * target.wz).max(0.0).sqrt();
            for x in [self.a1 - across, self.a1 + across] {
                if (x - shoulder.x).abs() < (nearest - shoulder.x).abs() {
                    nearest = x;
                }
            }
        }
        let x = (sign * nearest).clamp(x_of(outside - rounding), x_of(outside + rounding));
        self.shoulder(wx, wy, sign * x, shoulder.error)
    }

    /// Both elbows of the wrist centre (x, z) in the plane of the arm (eq. 5 to 12).
    pub(super) fn elbows(&self, x: f64, z: f64, target: &Target<'_>) -> Result<Elbows, Reach> {
        let r2 = x * x + z * z;
        let r = r2.sqrt();
        let (longest, shortest) = (self.c2 + self.k, (self.c2 - self.k).abs());
        if r - longest > target.tolerance {
            return Err(Reach::TooFar { shortfall: r - longest });
        }
        if shortest - r > target.tolerance {
            return Err(Reach::TooNear { shortfall: shortest - r });
        }
        if r <= target.free.trust.radius().max(self.position_rounding()) {
            let (sin_2, cos_2) = target.free_theta[1].sin_cos();
            return Ok(Elbows { front: self.elbow([sin_2, cos_2], [-sin_2, -cos_2]), behind: None, error: 0.0, free: true });
        }
        let (to_longest, to_shortest) = (longest * longest - r2, r2 - shortest * shortest);
        let m2 = 0.25 * to_longest * to_shortest;
        if m2 <= self.straight_m2(r) {
            // Both links lie on the line to the wrist centre, to rounding or up to the tolerance beyond reach.
            let [dx, dz] = [x / r, z / r];
            let (upper, forearm) = match (to_longest < to_shortest, self.k > self.c2) {
                (true, _) => (1.0, 1.0),
                (false, true) => (-1.0, 1.0),
                (false, false) => (1.0, -1.0),
            };
            let front = self.elbow([upper * dx, upper * dz], [forearm * dx, forearm * dz]);
            // The arm that made the pose may have been bent by as much as counts as straight, and by rounding on top of that.
            let error = 2.0 * self.straight_m2(r).sqrt() / (self.k * r);
            return Ok(Elbows { front, behind: None, error, free: false });
        }
        let (m, h2) = (m2.sqrt(), 0.5 * (r2 + (self.c2 - self.k) * (self.c2 + self.k)));
        let elbow = |m: f64| {
            let upper = [(h2 * x - m * z) / r2, (h2 * z + m * x) / r2];
            self.elbow(upper, [(x - upper[0]) / self.k, (z - upper[1]) / self.k])
        };
        Ok(Elbows { front: elbow(m), behind: Some(elbow(-m)), error: self.direction_rounding() * (self.c2 / m + 1.0 / r), free: false })
    }

    /// The angles of an elbow from the direction of the upper arm, of any length, and that of the forearm, of length one to rounding (eq. 10 to 12).
    fn elbow(&self, upper: [f64; 2], forearm: [f64; 2]) -> Elbow {
        let (sin_psi, cos_psi) = (self.a2 / self.k, self.c3 / self.k);
        // The direction of a forearm that is much shorter than the upper arm is a small difference: it may have lost its length of one.
        let length = forearm[0].hypot(forearm[1]);
        let sin_23 = (forearm[0] * cos_psi - forearm[1] * sin_psi) / length;
        let cos_23 = (forearm[1] * cos_psi + forearm[0] * sin_psi) / length;
        let theta_2 = upper[0].atan2(upper[1]);
        Elbow { theta_2, theta_3: sin_23.atan2(cos_23) - theta_2, sin_23, cos_23 }
    }

    /// On a path, a shoulder whose angle the pose leaves open, turned so that the wrist can keep the joint 4 that it is heading for.
    ///
    /// With theta_23 and theta_4 known, `R = Rz(theta_1) A Ry(theta_5) Rz(theta_6)` has the height of the approach axis on both sides:
    /// `A20 sin theta_5 + A22 cos theta_5 = R22` (eq. 24), and theta_1 from its direction.
    pub(super) fn turned_for_wrist(&self, shoulder: &Shoulder, elbow: &Elbow, target: &Target<'_>) -> Shoulder {
        if target.free.trust != Trust::Path || self.b != 0.0 {
            return *shoulder;
        }
        let [_, _, _, theta_4, theta_5, _] = target.free_theta;
        let (sin_4, cos_4) = theta_4.sin_cos();
        let (a20, a22) = (-elbow.sin_23 * cos_4, elbow.cos_23);
        let height = target.rotation[(2, 2)] / a20.hypot(a22);
        if height.abs() > 1.0 {
            return *shoulder;
        }
        let (middle, spread) = (a20.atan2(a22), height.acos());
        let nearer = |a: f64, b: f64| if (theta_5 - a).cos() > (theta_5 - b).cos() { a } else { b };
        let (sin_5, cos_5) = nearer(middle + spread, middle - spread).sin_cos();
        let (x, y) = (elbow.cos_23 * cos_4 * sin_5 + elbow.sin_23 * cos_5, sin_4 * sin_5);
        let (to_x, to_y) = (target.rotation[(0, 2)], target.rotation[(1, 2)]);
        let (sin, cos) = (to_y * x - to_x * y, to_x * x + to_y * y);
        let norm = sin.hypot(cos);
        let turned = Shoulder { sin_1: sin / norm, cos_1: cos / norm, ..*shoulder };
        let turn = (turned.sin_1 * shoulder.cos_1 - turned.cos_1 * shoulder.sin_1)
            .hypot(1.0 - turned.sin_1 * shoulder.sin_1 - turned.cos_1 * shoulder.cos_1);
        // The wrist centre must not move by more than rounding or, where q1 is free, than the seed's radius.
        let open = if shoulder.x.abs() <= SEEDED_FREE { SEEDED_FREE } else { self.position_rounding() };
        if norm > 0.0 && turn < 0.1 && turn * shoulder.x.abs() <= open { turned } else { *shoulder }
    }
}
