//! An arm with a spherical shoulder by its lengths: its table, and an independent geometry.

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{DhRow, Mdh, Pose, thresholds};
use nalgebra::{Rotation3, Translation3, Vector3};

use crate::rng::Rng;
use crate::structures::place::{At, Place};

/// Lengths [m], signs and offsets: theta = sign * q - offset is zero when the arm is upright, axes
/// 2, 4 and 6 to the side, offsets of axis 4 to the front.
#[derive(Clone, Debug)]
pub struct ShoulderArm {
    /// Height of the shoulder.
    pub c1: f64,
    /// Axis 4 from axis 3, and upper arm along axis 3.
    pub a3: f64,
    pub c3: f64,
    /// Axis 5 from axis 4, and forearm along axis 5.
    pub a4: f64,
    pub c5: f64,
    /// Along axis 6.
    pub d6: f64,
    /// Axis 7 from axis 6 (turning as theta_6 does): angle [rad], distance, and along axis 7.
    pub alpha7: f64,
    pub a7: f64,
    pub d7: f64,
    pub signs: [f64; 7],
    pub offsets: [f64; 7],
    /// The transforms before axis 1 and after frame 7.
    pub base: Pose,
    pub flange: Pose,
}

/// The shoulder in the hand frame, at the intersection of axes 5 and 6: perpendicular to axis 5 and
/// along it [m].
#[derive(Clone, Copy, Debug)]
pub struct Elbow {
    pub across: f64,
    pub along: f64,
}

/// Along z.
pub fn raised(z: f64) -> Pose {
    Pose::from_parts(Translation3::new(0.0, 0.0, z), Rotation3::identity())
}

impl ShoulderArm {
    pub fn panda() -> Self {
        Self {
            c1: 0.333,
            a3: 0.0825,
            c3: 0.316,
            a4: -0.0825,
            c5: 0.384,
            d6: 0.0,
            alpha7: -FRAC_PI_2,
            a7: 0.088,
            d7: 0.0,
            signs: [1.0, 1.0, 1.0, -1.0, 1.0, -1.0, 1.0],
            offsets: [0.0; 7],
            base: Pose::identity(),
            flange: raised(0.107),
        }
    }

    /// KUKA LBR iiwa 7 R800: axes 5, 6 and 7 intersect too.
    pub fn iiwa() -> Self {
        Self {
            c1: 0.34,
            a3: 0.0,
            c3: 0.4,
            a4: 0.0,
            c5: 0.4,
            alpha7: FRAC_PI_2,
            a7: 0.0,
            d7: 0.126,
            signs: [1.0; 7],
            offsets: [0.0, 0.0, PI, 0.0, PI, 0.0, 0.0],
            flange: Pose::identity(),
            ..Self::panda()
        }
    }

    /// A long upper arm, so that the shoulder can reach axis 6, joint 7 at an angle, no two lengths
    /// equal.
    pub fn oblique() -> Self {
        Self {
            c1: 0.3,
            a3: 0.06,
            c3: 0.45,
            a4: 0.04,
            c5: 0.35,
            d6: 0.05,
            alpha7: 70.0_f64.to_radians(),
            a7: 0.03,
            d7: 0.12,
            signs: [1.0, 1.0, -1.0, 1.0, -1.0, 1.0, -1.0],
            offsets: [0.2, 0.3, -0.4, 0.5, -0.1, 0.7, 0.6],
            flange: raised(0.1),
            ..Self::panda()
        }
    }

    /// Offsets, and upper arm as long as forearm: the shoulder can reach the intersection of axes 5
    /// and 6.
    pub fn onto_itself() -> Self {
        Self {
            c1: 0.3,
            a3: 0.05,
            c3: 0.4,
            a4: -0.05,
            c5: 0.4,
            a7: 0.08,
            flange: raised(0.1),
            ..Self::panda()
        }
    }

    pub fn q(&self, theta: [f64; 7]) -> [f64; 7] {
        std::array::from_fn(|i| self.signs[i] * (theta[i] + self.offsets[i]))
    }

    pub fn theta(&self, q: &[f64; 7]) -> [f64; 7] {
        std::array::from_fn(|i| self.signs[i] * q[i] - self.offsets[i])
    }

    /// The table. Its zero pose and the directions of its joints follow the offsets and the signs:
    /// a joint of sign -1 has its frame flipped, `Rz(-q) = Rx(pi) Rz(q) Rx(-pi)`.
    pub fn mdh(&self) -> Mdh<7> {
        let mut rows = [
            DhRow::new(0.0, 0.0, self.c1, 0.0),
            DhRow::new(-FRAC_PI_2, 0.0, 0.0, 0.0),
            DhRow::new(FRAC_PI_2, 0.0, self.c3, 0.0),
            DhRow::new(-FRAC_PI_2, self.a3, 0.0, 0.0),
            DhRow::new(FRAC_PI_2, self.a4, self.c5, 0.0),
            DhRow::new(-FRAC_PI_2, 0.0, self.d6, 0.0),
            DhRow::new(self.alpha7, self.a7, self.d7, 0.0),
        ];
        let mut turned = false;
        for (i, row) in rows.iter_mut().enumerate() {
            row.theta -= self.offsets[i];
            let turns = self.signs[i] < 0.0;
            if turns != turned {
                row.alpha += if row.alpha > 0.0 { -PI } else { PI };
            }
            if turns {
                (row.d, row.theta) = (-row.d, -row.theta);
            }
            turned = turns;
        }
        let half = if turned { PI } else { 0.0 };
        let over = Pose::from_parts(
            Translation3::identity(),
            Rotation3::from_axis_angle(&Vector3::x_axis(), half),
        );
        Mdh { base: self.base, rows, flange: over * self.flange }
    }

    pub fn upper(&self) -> f64 {
        self.a3.hypot(self.c3)
    }

    pub fn forearm(&self) -> f64 {
        self.a4.hypot(self.c5)
    }

    /// The lengths that a position of the flange is summed from [m].
    pub fn reach(&self) -> f64 {
        let ends = [self.base, self.flange].map(|end| end.translation.vector.norm());
        self.c1
            + self.upper()
            + self.forearm()
            + self.d6.abs()
            + self.a7.hypot(self.d7)
            + ends.iter().sum::<f64>()
    }

    pub fn position_rounding(&self) -> f64 {
        thresholds::POSITION_ROUNDING * self.reach()
    }

    /// theta_4 of the stretched arm.
    pub fn psi(&self) -> f64 {
        self.a3.atan2(self.c3) - self.a4.atan2(self.c5)
    }

    /// Angle between upper arm and forearm from stretched.
    pub fn elbow_angle(&self, theta_4: f64) -> f64 {
        theta_4 - self.psi()
    }

    pub fn elbow(&self, theta_4: f64) -> Elbow {
        let (sin_4, cos_4) = theta_4.sin_cos();
        Elbow {
            across: self.c3 * sin_4 - self.a3 * cos_4 - self.a4,
            along: -(self.a3 * sin_4 + self.c3 * cos_4) - self.c5,
        }
    }

    /// Distance of the shoulder from the plane of axes 5 and 6, signed [m].
    pub fn aside(&self, theta: &[f64; 7]) -> f64 {
        self.elbow(theta[3]).across * theta[4].cos()
    }

    /// The bits of the slot: shoulder 4, elbow 2, wrist 1.
    ///
    /// The shoulder counts as joint 2 turns; the wrist counts from the side of axis 6 at q = 0; an
    /// arm without an offset at the elbow has its elbow on the side that joint 4 turns to.
    pub fn slot(&self, theta: &[f64; 7]) -> usize {
        let elbow = if self.a3 == 0.0 { self.signs[3] } else { 1.0 };
        let wrist = self.offsets[4].cos();
        4 * usize::from(self.signs[1] * theta[1].sin() < 0.0)
            + 2 * usize::from(elbow * self.elbow_angle(theta[3]).sin() < 0.0)
            + usize::from(wrist * theta[4].cos() < 0.0)
    }

    /// Angles near the singularities of a place; `None` if this arm cannot get there.
    pub fn at(&self, place: &Place, rng: &mut Rng) -> Option<[f64; 7]> {
        let mut theta = rng.angles();
        for (at, off) in &place.0 {
            self.move_to(&mut theta, *at, *off, rng)?;
        }
        Some(theta)
    }

    fn move_to(&self, theta: &mut [f64; 7], at: At, off: f64, rng: &mut Rng) -> Option<()> {
        let upper = self.a3.atan2(self.c3);
        let off = off * rng.sign();
        let half = rng.half_turn();
        match at {
            At::Shoulder => theta[1] = half + off,
            At::Elbow => theta[3] = self.psi() + half + off,
            At::Stretched => theta[3] = self.psi() + off,
            At::Folded => theta[3] = self.psi() + PI + off,
            At::Wrist => theta[4] = half - FRAC_PI_2 + off,
            At::Forearm => {
                let sine = (self.a4 + off) / self.upper();
                (sine.abs() <= 1.0).then_some(())?;
                theta[3] = upper + if half == 0.0 { sine.asin() } else { PI - sine.asin() };
            }
            At::Hand => {
                let around = rng.between(0.0, PI);
                let cosine = -(self.c5 + off * around.cos()) / self.upper();
                (cosine.abs() <= 1.0).then_some(())?;
                theta[3] = upper + rng.sign() * cosine.acos();
                let across = self.elbow(theta[3]).across;
                let cosine = off * around.sin() / across;
                let turn = if cosine.abs() <= 1.0 { cosine.acos() } else { rng.angle() };
                theta[4] = rng.sign() * turn;
            }
        }
        Some(())
    }

    /// How far the joints of a solution may be from those that made the pose [rad]: joint 4; joints
    /// 5 and 6; joint 2 and the sum or difference of 1 and 3; joints 1 and 3 individually.
    ///
    /// A distance that is known to `p` is the cosine of an angle: near its extremes, the angle is
    /// known to the root of `p`. On axis 5 or 6 a joint that is given is kept as far as `kept` from
    /// it.
    pub fn bounds(&self, theta: &[f64; 7], kept: f64) -> [f64; 4] {
        let [_, theta_2, _, theta_4, theta_5, ..] = *theta;
        let elbow = self.elbow(theta_4);
        let p = 4.0 * self.position_rounding();
        let root = |p: f64, at: f64| (2.0 * p / at.abs().max(1e-300)).min(2.0 * p.sqrt());
        let (r, sin_e) = (elbow.across.hypot(elbow.along), self.elbow_angle(theta_4).sin());
        let joint_4 = p + root(p * r / (self.upper() * self.forearm()), sin_e);
        let (across, aside) = (elbow.across.abs(), self.aside(theta));
        let rho = aside.hypot(elbow.along);
        let speeds = [-(elbow.along + self.c5), elbow.across + self.a4];
        let lever = if (across * theta_5.sin()).abs() < rho { across } else { rho };
        let moved = p + speeds[0].abs().max(speeds[1].abs()) * joint_4;
        let aside_error = p + root(moved * lever, aside).min(2.0 * (moved * lever).sqrt());
        // A merged twin may represent the other one.
        let of = |distance: f64| {
            if distance <= 0.9 * kept { 2.0 * kept + p } else { (p + aside_error) / distance }
        };
        let joints_56 = of(across) + of(rho) + joint_4;
        let turned = self.forearm() * joint_4 / r.max(p) + joints_56;
        let sine = theta_2.sin().abs();
        let split = if turned + sine <= 0.9 * kept { 3e-9 } else { (turned + p) / sine };
        [joint_4, joints_56, turned + 3e-9, split].map(|bound| bound.max(1e-9))
    }

    /// Whether angles are the branch of those that made the pose.
    pub fn is_branch(a: &[f64; 7], b: &[f64; 7], bounds: &[f64; 4]) -> bool {
        let wrapped = |angle: f64| (angle - 2.0 * PI * (angle / (2.0 * PI)).round()).abs();
        let off = |i: usize| wrapped(a[i] - b[i]);
        let sum = |t: &[f64; 7]| if t[1].cos() > 0.0 { t[0] + t[2] } else { t[0] - t[2] };
        let merged_2 = wrapped(wrapped(a[1]) - wrapped(b[1]));
        let split = off(0).max(off(2)) <= bounds[3];
        off(3) <= bounds[0]
            && off(4).max(off(5)) <= bounds[1]
            && (off(1).min(merged_2) <= bounds[2])
            && (split || bounds[3] > 0.1)
            && (wrapped(sum(a) - sum(b)) <= bounds[2] + bounds[3] * b[1].sin().abs() || split)
    }
}
