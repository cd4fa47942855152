//! The first three joints: a shoulder that turns about axis 1 and an elbow in the plane
//! perpendicular to the parallel axes 2 and 3.
//!
//! Both structures of six-axis arms use it. The equations have their numbers in
//! docs/theory/spherical_wrist.md.

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::pose::Pose;
use crate::kinematics::structure::free_choice::{FreeChoice, SeedPolicy};
use crate::kinematics::structure::triangle::Triangle;
use crate::kinematics::thresholds::{POSITION_ROUNDING, REACH_TOLERANCE, SHOULDER_MERGE};
use crate::report::Reach;

/// The lengths from axis 1 to the end of the forearm, measured from the shoulder (on axis 1, at the
/// height of axis 2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlanarArm {
    /// Distance of axis 2 from axis 1 [m].
    pub(crate) a1: f64,
    /// Elbow offset: distance of the forearm's line from axis 3 [m].
    pub(crate) a2: f64,
    /// Distance of the arm's end from the plane through axis 1 [m].
    pub(crate) b: f64,
    /// Upper arm [m].
    pub(crate) c2: f64,
    /// Forearm, along its line [m].
    pub(crate) c3: f64,
    /// Length of the forearm, hypot(a2, c3) [m].
    pub(crate) k: f64,
    /// The sum of the lengths that contribute to a position of the tool [m].
    pub(crate) extent: f64,
}

/// One way for axis 1 to face the wrist center.
#[derive(Clone, Copy)]
pub(crate) struct Shoulder {
    pub(crate) sin_1: f64,
    pub(crate) cos_1: f64,
    /// Wrist center from axis 1, along the arm's plane [m]; negative behind it.
    pub(crate) x: f64,
    /// How far rounding may rotate it [rad].
    pub(crate) error: f64,
}

/// The shoulder that faces the wrist center, the one that has it behind, and whether they are one.
pub(crate) struct Shoulders {
    pub(crate) front: Shoulder,
    pub(crate) behind: Shoulder,
    pub(crate) merged: bool,
    /// If they are merged: whether the one behind is kept.
    pub(crate) keep_behind: bool,
}

/// One configuration of the elbow.
#[derive(Clone, Copy)]
pub(crate) struct Elbow {
    pub(crate) theta_2: f64,
    pub(crate) theta_3: f64,
    pub(crate) sin_23: f64,
    pub(crate) cos_23: f64,
}

/// The elbow in front of and behind the line to the wrist center; without the second, they are one.
pub(crate) struct Elbows {
    pub(crate) front: Elbow,
    pub(crate) behind: Option<Elbow>,
    /// How far rounding may rotate the forearm [rad].
    pub(crate) error: f64,
    /// The wrist center is on axis 2: the direction of the upper arm is undetermined.
    pub(crate) free: bool,
}

/// The target of a solve on this arm.
#[derive(Clone, Copy)]
pub(crate) struct Target<'a> {
    pub(crate) wxy: [f64; 2],
    pub(crate) wz: f64,
    pub(crate) rotation: &'a Matrix3<f64>,
    pub(crate) free: &'a FreeChoice<6>,
    pub(crate) free_theta: [f64; 6],
    /// How far beyond reach the arm's end may be and still get the stretched or folded arm [m].
    pub(crate) tolerance: f64,
}

impl Target<'_> {
    /// Stretch or fold an arm up to `tolerance` beyond reach [m].
    pub(crate) fn beyond(&self, tolerance: f64) -> Self {
        Self { tolerance, ..*self }
    }
}

impl Shoulder {
    /// Rotated by half a turn: front and behind are exchanged.
    fn opposite(self) -> Self {
        Self { sin_1: -self.sin_1, cos_1: -self.cos_1, x: -self.x, error: self.error }
    }

    /// Rotated by `angle` about axis 1, with the wrist center unchanged.
    pub(crate) fn rotated(&self, angle: f64, [wx, wy]: [f64; 2]) -> Self {
        let ((sin, cos), Self { sin_1, cos_1, .. }) = (angle.sin_cos(), *self);
        let (sin_1, cos_1) = (sin_1 * cos + cos_1 * sin, cos_1 * cos - sin_1 * sin);
        Self { sin_1, cos_1, x: wx * cos_1 + wy * sin_1, ..*self }
    }
}

impl PlanarArm {
    /// An arm with the given lengths [m].
    pub(crate) fn new([a1, a2, b, c2, c3]: [f64; 5]) -> Self {
        Self { a1, a2, b, c2, c3, k: a2.hypot(c3), extent: 0.0 }
    }

    /// Place the arm between fixed transforms, whose lengths add to the rounding of a position.
    pub(crate) fn between(self, fixed: [&Pose; 4]) -> Self {
        let fixed: f64 = fixed.map(|pose| pose.translation.vector.norm()).iter().sum();
        Self { extent: self.a1.abs() + self.b.abs() + self.c2 + self.k + fixed, ..self }
    }

    /// Upper bound of the rounding of a position of this arm [m].
    pub(crate) fn position_rounding(&self) -> f64 {
        POSITION_ROUNDING * self.extent
    }

    /// Typical rounding of a position of this arm [m]: a link with lever l is rotated by this over
    /// l.
    pub(crate) fn direction_rounding(&self) -> f64 {
        2.0 * f64::EPSILON * self.extent
    }

    /// The square of m (eq. 8) below which a straight arm reaches the wrist center too, to half the
    /// rounding of a position.
    pub(crate) fn straight_m2(&self, r: f64) -> f64 {
        self.position_rounding() * r * self.c2 * self.k
    }

    /// x of the wrist center up to which front and back are one [m]. With b != 0 they meet where
    /// the wrist center is on the cylinder of radius b to rounding (eq. 3).
    pub(crate) fn shoulder_merge(&self) -> f64 {
        if self.b == 0.0 {
            return SHOULDER_MERGE;
        }
        let rounding = self.position_rounding();
        (rounding * (2.0 * self.b.abs() + rounding)).sqrt()
    }

    /// How far the plane of a shoulder may be rotated about axis 1, for b != 0, with the wrist
    /// center off it by no more than rounding: the least and the greatest angle [rad] (eq. 42).
    pub(crate) fn rotation_range(&self, shoulder: &Shoulder, [wx, wy]: [f64; 2]) -> [f64; 2] {
        let (rho, b, x) = (wx.hypot(wy), self.b.abs(), shoulder.x.abs());
        let (x2, rounding) = ((rho - b) * (rho + b), 2.0 * b * self.position_rounding());
        // The squares of the greatest and the least x: the remaining x is not a difference of
        // roots.
        let (farther, nearer) = ((x2 + rounding).max(0.0), x2 - rounding);
        let (outward, inward) = if x == 0.0 {
            (farther.sqrt() / b, farther.sqrt() / b)
        } else if nearer > 0.0 {
            (rounding / (b * (x + farther.sqrt())), rounding / (b * (x + nearer.sqrt())))
        } else {
            (rounding / (b * (x + farther.sqrt())), (x + farther.sqrt()) / b)
        };
        let turns_outward = shoulder.x.is_sign_negative() == self.b.is_sign_negative();
        if turns_outward { [-inward, outward] } else { [-outward, inward] }
    }

    /// Whether the plane of a shoulder, turned to the other one's, leaves the wrist center off
    /// by no more than `off` on the way [m], for b != 0 (eq. 46).
    pub(crate) fn is_one_shoulder(&self, shoulder: &Shoulder, off: f64) -> bool {
        self.b != 0.0 && shoulder.x * shoulder.x <= 2.0 * self.b.abs() * off
    }

    /// Angle between upper arm and forearm from stretched, for the angle of axis 3 [rad].
    #[inline]
    pub(crate) fn elbow_angle(&self, theta_3: f64) -> f64 {
        theta_3 + self.a2.atan2(self.c3)
    }

    /// Its sine.
    #[inline]
    pub(crate) fn sin_elbow(&self, theta_3: f64) -> f64 {
        let (sin_3, cos_3) = theta_3.sin_cos();
        (self.a2 * cos_3 + self.c3 * sin_3) / self.k
    }

    /// How far straightening the arm moves its end [m], to first order: m^2 / (2 r c2 k), from
    /// stretched or from folded.
    pub(crate) fn straightening(&self, theta_3: f64) -> f64 {
        let (c2, k, elbow) = (self.c2, self.k, self.elbow_angle(theta_3));
        let r = (c2 * c2 + k * k + 2.0 * c2 * k * elbow.cos()).max(0.0).sqrt();
        let longest_or_shortest = if elbow.cos() > 0.0 { c2 + k } else { (c2 - k).abs() };
        (r - longest_or_shortest).abs()
    }

    /// [`Self::sin_elbow`], and the distance of the arm's end from axis 1 along the plane of the arm
    /// [m], negative behind it: from sines and cosines of theta_2 and theta_3.
    #[inline]
    pub(crate) fn elbow_and_end(
        &self,
        (sin_2, cos_2): (f64, f64),
        (sin_3, cos_3): (f64, f64),
    ) -> [f64; 2] {
        let (sin_23, cos_23) = (sin_2 * cos_3 + cos_2 * sin_3, cos_2 * cos_3 - sin_2 * sin_3);
        let elbow = (self.a2 * cos_3 + self.c3 * sin_3) / self.k;
        [elbow, self.a1 + self.c2 * sin_2 + self.c3 * sin_23 + self.a2 * cos_23]
    }

    /// Whether the arm counts as stretched or folded (eq. 8).
    #[inline]
    pub(crate) fn is_straight(&self, theta_3: f64) -> bool {
        let (c2, k) = (self.c2, self.k);
        // The arm is no longer than stretched: far from straight, its length need not be known.
        if (c2 * k * self.sin_elbow(theta_3)).powi(2) > 2.0 * self.straight_m2(c2 + k) {
            return false;
        }
        let r = (c2 * c2 + k * k + 2.0 * c2 * k * self.elbow_angle(theta_3).cos()).max(0.0).sqrt();
        let folded_onto_axis_2 = r <= self.position_rounding();
        folded_onto_axis_2 || (c2 * k * self.sin_elbow(theta_3)).powi(2) <= self.straight_m2(r)
    }

    /// The target of this arm for the frame `t_shoulder_wrist`.
    pub(crate) fn target<'a>(
        &self,
        t_shoulder_wrist: &'a Pose,
        free: &'a FreeChoice<6>,
        free_theta: [f64; 6],
    ) -> Target<'a> {
        let w = t_shoulder_wrist.translation.vector;
        Target {
            wxy: [w.x, w.y],
            wz: w.z,
            rotation: t_shoulder_wrist.rotation.matrix(),
            free,
            free_theta,
            tolerance: self.position_rounding(),
        }
    }

    /// Both shoulders that face the point (eq. 2 to 4), with the angle of axis 1 to choose if it is
    /// undetermined.
    pub(crate) fn shoulders(
        &self,
        [wx, wy]: [f64; 2],
        free_theta_1: f64,
        policy: SeedPolicy,
    ) -> Result<Shoulders, Reach> {
        let (rho, rounding) = (wx.hypot(wy), self.position_rounding());
        let outside = rho - self.b.abs();
        if outside < -REACH_TOLERANCE {
            return Err(Reach::TooNear { shortfall: -outside });
        }
        let (sin_1, cos_1) = free_theta_1.sin_cos();
        if self.b == 0.0 && (policy.forces(1) || rho <= policy.radius().max(rounding)) {
            // Whichever is kept has that angle. A seed's plane determines x, and the side of axis
            // 1.
            let (x, keep_behind) = match policy {
                SeedPolicy::Forced { behind, .. } => (rho, behind),
                SeedPolicy::Pose => (rho, false),
                SeedPolicy::Seed | SeedPolicy::Path => {
                    let x = wx * cos_1 + wy * sin_1;
                    (x.abs(), x < 0.0)
                }
            };
            let at = |x: f64| Shoulder { sin_1, cos_1, x, error: 0.0 };
            return Ok(Shoulders { front: at(x), behind: at(-x), merged: true, keep_behind });
        }
        // With b != 0 a wrist center on the cylinder of radius b is on it to rounding: x = 0, not
        // the square root of that rounding.
        let x = if outside <= rounding { 0.0 } else { (outside * (rho + self.b.abs())).sqrt() };
        let merged = x == 0.0 || (self.b == 0.0 && x <= SHOULDER_MERGE);
        let error = if merged { 0.0 } else { self.direction_rounding() / x };
        let front = self.shoulder(wx, wy, x, error);
        // With b != 0 the two are not opposite: theta_1 differs by pi - 2 atan2(b, x) (eq. 4).
        let behind =
            if self.b == 0.0 { front.opposite() } else { self.shoulder(wx, wy, -x, error) };
        let keep_behind =
            policy != SeedPolicy::Pose && front.sin_1 * sin_1 + front.cos_1 * cos_1 < 0.0;
        Ok(Shoulders { front, behind, merged, keep_behind })
    }

    /// theta_1 from `Rz(theta_1) (x, b) = (wx, wy)` (eq. 4).
    fn shoulder(&self, wx: f64, wy: f64, x: f64, error: f64) -> Shoulder {
        let (sin, cos) = (wy * x - wx * self.b, wx * x + wy * self.b);
        let norm = sin.hypot(cos);
        Shoulder { sin_1: sin / norm, cos_1: cos / norm, x, error }
    }

    /// The shoulder with x moved towards reach within its rounding: near the cylinder of radius b
    /// (eq. 3) a rounding of the pose is a large part of x, and for a pose at the edge of reach
    /// that edge determines x. The arm's end is at `x - a1`, `wz`.
    pub(crate) fn eased(
        &self,
        shoulder: &Shoulder,
        [wx, wy]: [f64; 2],
        a1: f64,
        wz: f64,
    ) -> Shoulder {
        let (b, rounding) = (self.b.abs(), self.position_rounding());
        let x_of = |outside: f64| (outside.max(0.0) * (outside + 2.0 * b)).sqrt();
        let outside = wx.hypot(wy) - b;
        let sign = if shoulder.x.is_sign_negative() { -1.0 } else { 1.0 };
        let mut nearest = f64::INFINITY;
        for length in [self.c2 + self.k, self.c2 - self.k] {
            let across = (length * length - wz * wz).max(0.0).sqrt();
            for x in [a1 - across, a1 + across] {
                if (x - shoulder.x).abs() < (nearest - shoulder.x).abs() {
                    nearest = x;
                }
            }
        }
        let x = (sign * nearest).clamp(x_of(outside - rounding), x_of(outside + rounding));
        self.shoulder(wx, wy, sign * x, shoulder.error)
    }

    /// Both elbows for the arm's end at (x, z) from axis 2 in the plane of the arm, or up to
    /// `tolerance` beyond reach (eq. 5 to 12); with the angle of axis 2 to choose if it is
    /// undetermined.
    pub(crate) fn elbows(
        &self,
        [x, z]: [f64; 2],
        tolerance: f64,
        free_theta_2: f64,
        policy: SeedPolicy,
    ) -> Result<Elbows, Reach> {
        let r2 = x * x + z * z;
        let r = r2.sqrt();
        let triangle = Triangle::reaching([self.c2, self.k], r, tolerance)?;
        if policy.forces(2) || r <= policy.radius().max(self.position_rounding()) {
            let (sin_2, cos_2) = free_theta_2.sin_cos();
            return Ok(Elbows {
                front: self.elbow([sin_2, cos_2], [-sin_2, -cos_2]),
                behind: None,
                error: 0.0,
                free: true,
            });
        }
        let m2 = triangle.m2(r2);
        if m2 <= self.straight_m2(r) {
            // Both links are on the line to the wrist center, to rounding or up to the tolerance
            // beyond reach.
            let [dx, dz] = [x / r, z / r];
            let (upper, forearm) = match (triangle.is_stretched(r2), self.k > self.c2) {
                (true, _) => (1.0, 1.0),
                (false, true) => (-1.0, 1.0),
                (false, false) => (1.0, -1.0),
            };
            let front = self.elbow([upper * dx, upper * dz], [forearm * dx, forearm * dz]);
            // The arm that made the pose may have been bent by as much as still counts as straight,
            // and by rounding on top of that.
            let error = 2.0 * self.straight_m2(r).sqrt() / (self.k * r);
            return Ok(Elbows { front, behind: None, error, free: false });
        }
        let m = m2.sqrt();
        let elbow = |m: f64| {
            let upper = triangle.upper_arm::<false>([x, z], r2, m).map(|times_r2| times_r2 / r2);
            self.elbow(upper, [(x - upper[0]) / self.k, (z - upper[1]) / self.k])
        };
        Ok(Elbows {
            front: elbow(m),
            behind: Some(elbow(-m)),
            error: self.direction_rounding() * (self.c2 / m + 1.0 / r),
            free: false,
        })
    }

    /// The angles of an elbow from the direction of the upper arm, of any length, and the direction
    /// of the forearm, of unit length to rounding (eq. 10 to 12).
    fn elbow(&self, upper: [f64; 2], forearm: [f64; 2]) -> Elbow {
        let (sin_psi, cos_psi) = (self.a2 / self.k, self.c3 / self.k);
        // The direction of a forearm that is much shorter than the upper arm is a small difference:
        // it may have lost its unit length.
        let length = forearm[0].hypot(forearm[1]);
        let sin_23 = (forearm[0] * cos_psi - forearm[1] * sin_psi) / length;
        let cos_23 = (forearm[1] * cos_psi + forearm[0] * sin_psi) / length;
        let theta_2 = upper[0].atan2(upper[1]);
        Elbow { theta_2, theta_3: sin_23.atan2(cos_23) - theta_2, sin_23, cos_23 }
    }
}
