//! The inverse: up to eight joint vectors of a wrist frame.

use nalgebra::{Matrix3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use core::f64::consts::PI;

use super::SphericalWrist;
use crate::kinematics::angles::wrap;
use crate::kinematics::pose::Pose;
use crate::kinematics::solutions::SLOTS;
use crate::kinematics::status::{Reach, Status};
use crate::kinematics::thresholds::{ELBOW_MERGE_SIN, POSITION_ROUNDING, REACH_TOLERANCE, SEEDED_FREE, WRIST_FREE_SIN, WRIST_MERGE_SIN};

/// What to take for a joint that the pose does not determine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeChoice {
    /// Joint angles [rad], of which the free one's is taken.
    pub(crate) q: [f64; 6],
    /// How close to a singularity the pose counts as silent, beyond rounding [rad, m].
    pub(crate) radius: f64,
}

impl FreeChoice {
    /// Zero for a free joint, only where rounding hides it.
    pub(crate) const ZERO: Self = Self { q: [0.0; 6], radius: 0.0 };

    /// The seed's angle for a free joint.
    pub(crate) fn seed(q: [f64; 6]) -> Self {
        Self { q, radius: SEEDED_FREE }
    }
}

/// The joint vectors of a wrist frame, in their slots.
pub(crate) struct Branches {
    pub(crate) q: [Option<[f64; 6]>; SLOTS],
    /// Singularities of each slot's branch, and MERGED where the slot gave its solution to another.
    pub(crate) flags: [Status; SLOTS],
    pub(crate) reach: Reach,
}

/// One way for axis 1 to face the wrist centre.
#[derive(Clone, Copy)]
struct Shoulder {
    sin_1: f64,
    cos_1: f64,
    /// Wrist centre from axis 1, along the arm's plane [m]; negative behind it.
    x: f64,
}

/// One way for the elbow to stand.
#[derive(Clone, Copy)]
struct Elbow {
    theta_2: f64,
    theta_3: f64,
    sin_23: f64,
    cos_23: f64,
}

/// One branch of the wrist, with theta_5 in 0 ..= pi unless theta_4 was given; the other one is its flip.
struct Wrist {
    theta: [f64; 3],
    merged: bool,
}

impl SphericalWrist {
    /// Every branch of the wrist frame `t_shoulder_wrist`.
    pub(crate) fn solve(&self, t_shoulder_wrist: &Pose, free: &FreeChoice) -> Branches {
        let mut branches = Branches { q: [None; SLOTS], flags: [Status::empty(); SLOTS], reach: Reach::Reached };
        let w = t_shoulder_wrist.translation.vector;
        let rotation = t_shoulder_wrist.rotation.matrix();
        let free_theta = self.theta(&free.q);
        let (front, merged) = match self.front(w.x, w.y, free_theta[0], free.radius) {
            Ok(front) => front,
            Err(missed) => {
                branches.reach = missed;
                return branches;
            }
        };
        let behind = Shoulder { sin_1: -front.sin_1, cos_1: -front.cos_1, x: -front.x };
        // With b != 0 the two are not opposite: theta_1 differs by pi - 2 atan2(b, x) (eq. 4).
        let behind = if self.b == 0.0 { behind } else { self.shoulder(w.x, w.y, -front.x) };
        let first = self.fill(&mut branches, 0, &front, w.z, rotation, &free_theta, free.radius);
        if merged {
            for slot in 0..SLOTS / 2 {
                if branches.q[slot].is_some() || branches.flags[slot].contains(Status::MERGED) {
                    branches.flags[slot] |= Status::SHOULDER;
                    branches.flags[slot + 4] = branches.flags[slot] | Status::MERGED;
                }
            }
            branches.reach = first;
            return branches;
        }
        let second = self.fill(&mut branches, 4, &behind, w.z, rotation, &free_theta, free.radius);
        branches.reach = if second.shortfall() < first.shortfall() { second } else { first };
        branches
    }

    /// The shoulder that faces the wrist centre (eq. 2 to 4), and whether the one behind is the same.
    fn front(&self, wx: f64, wy: f64, free_theta_1: f64, radius: f64) -> Result<(Shoulder, bool), Reach> {
        let rho = wx.hypot(wy);
        let inside = self.b.abs() - rho;
        if inside > REACH_TOLERANCE {
            return Err(Reach::TooNear { shortfall: inside });
        }
        if self.b == 0.0 && rho <= radius.max(POSITION_ROUNDING * (self.c2 + self.k)) {
            let (sin_1, cos_1) = free_theta_1.sin_cos();
            return Ok((Shoulder { sin_1, cos_1, x: rho }, true));
        }
        let x = (-inside * (rho + self.b.abs())).max(0.0).sqrt();
        Ok((self.shoulder(wx, wy, x), x <= self.shoulder_merge()))
    }

    /// theta_1 from `Rz(theta_1) (x, b) = (wx, wy)` (eq. 4).
    fn shoulder(&self, wx: f64, wy: f64, x: f64) -> Shoulder {
        let (sin, cos) = (wy * x - wx * self.b, wx * x + wy * self.b);
        let norm = sin.hypot(cos);
        Shoulder { sin_1: sin / norm, cos_1: cos / norm, x }
    }

    /// Puts the four branches of one shoulder into slots `base` ..= `base` + 3.
    #[expect(clippy::too_many_arguments, reason = "one call for each shoulder; a struct of these would be named once and read once")]
    fn fill(
        &self,
        branches: &mut Branches,
        base: usize,
        shoulder: &Shoulder,
        wz: f64,
        rotation: &Matrix3<f64>,
        free_theta: &[f64; 6],
        radius: f64,
    ) -> Reach {
        let (elbows, elbow_merged) = match self.elbows(shoulder.x - self.a1, wz, free_theta[1], radius) {
            Ok(elbows) => elbows,
            Err(missed) => return missed,
        };
        let theta_1 = shoulder.sin_1.atan2(shoulder.cos_1);
        for (i, elbow) in elbows.into_iter().enumerate() {
            let slot = base + 2 * i;
            let Some(elbow) = elbow else {
                branches.flags[slot] = branches.flags[slot - 2] | Status::MERGED;
                branches.flags[slot + 1] = branches.flags[slot - 2] | Status::MERGED;
                continue;
            };
            let wrist = wrist(&forearm_to_flange(shoulder, &elbow, rotation), free_theta[3], radius);
            let [theta_4, theta_5, theta_6] = wrist.theta;
            let mut flags = Status::empty();
            flags.set(Status::ELBOW, elbow_merged);
            flags.set(Status::WRIST, wrist.merged);
            // A free theta_4 that was given may leave theta_5 negative: then the flipped slot is the one that is kept.
            let (kept, flipped) = if theta_5 < 0.0 { (slot + 1, slot) } else { (slot, slot + 1) };
            branches.q[kept] = Some(self.joints([theta_1, elbow.theta_2, elbow.theta_3, theta_4, theta_5, theta_6]));
            branches.flags[kept] = flags;
            branches.flags[flipped] = flags;
            if wrist.merged {
                branches.flags[flipped] |= Status::MERGED;
            } else {
                branches.q[flipped] = Some(self.joints([theta_1, elbow.theta_2, elbow.theta_3, theta_4 + PI, -theta_5, theta_6 + PI]));
            }
        }
        Reach::Reached
    }

    /// The elbow in front of and behind the line to the wrist centre (eq. 6 to 12), and whether they are the same.
    fn elbows(&self, x: f64, z: f64, free_theta_2: f64, radius: f64) -> Result<([Option<Elbow>; 2], bool), Reach> {
        let r2 = x * x + z * z;
        let r = r2.sqrt();
        let (longest, shortest) = (self.c2 + self.k, (self.c2 - self.k).abs());
        if r - longest > REACH_TOLERANCE {
            return Err(Reach::TooFar { shortfall: r - longest });
        }
        if shortest - r > REACH_TOLERANCE {
            return Err(Reach::TooNear { shortfall: shortest - r });
        }
        if r <= radius.max(POSITION_ROUNDING * longest) {
            // Folded onto axis 2: the upper arm may point anywhere.
            let (sin_2, cos_2) = free_theta_2.sin_cos();
            return Ok(([Some(self.elbow([sin_2, cos_2], [-sin_2, -cos_2])), None], true));
        }
        let (to_longest, to_shortest) = (longest * longest - r2, r2 - shortest * shortest);
        if to_longest <= 0.0 || to_shortest <= 0.0 {
            // Stretched or folded, at the edge of reach or up to the tolerance beyond: both links lie on the line to the wrist centre.
            let [dx, dz] = [x / r, z / r];
            let upper = if to_shortest <= 0.0 && self.k > self.c2 { -1.0 } else { 1.0 };
            let forearm = if to_shortest <= 0.0 && self.k <= self.c2 { -1.0 } else { 1.0 };
            return Ok(([Some(self.elbow([upper * dx, upper * dz], [forearm * dx, forearm * dz])), None], true));
        }
        let h2 = 0.5 * (r2 + (self.c2 - self.k) * (self.c2 + self.k));
        let m = 0.5 * (to_longest * to_shortest).sqrt();
        let merged = m <= ELBOW_MERGE_SIN * self.c2 * self.k;
        let elbow = |m: f64| {
            let upper = [(h2 * x - m * z) / r2, (h2 * z + m * x) / r2];
            self.elbow(upper, [(x - upper[0]) / self.k, (z - upper[1]) / self.k])
        };
        Ok(([Some(elbow(m)), (!merged).then(|| elbow(-m))], merged))
    }

    /// The angles of an elbow from the direction of the upper arm, of any length, and that of the forearm, of length one (eq. 10 to 12).
    fn elbow(&self, upper: [f64; 2], forearm: [f64; 2]) -> Elbow {
        let (sin_psi, cos_psi) = (self.a2 / self.k, self.c3 / self.k);
        let sin_23 = forearm[0] * cos_psi - forearm[1] * sin_psi;
        let cos_23 = forearm[1] * cos_psi + forearm[0] * sin_psi;
        let theta_2 = upper[0].atan2(upper[1]);
        Elbow { theta_2, theta_3: sin_23.atan2(cos_23) - theta_2, sin_23, cos_23 }
    }

    fn joints(&self, theta: [f64; 6]) -> [f64; 6] {
        core::array::from_fn(|i| wrap(self.signs[i] * (theta[i] + self.offsets[i])))
    }
}

/// `Ry(-theta_23) Rz(-theta_1) R`, which is `Rz(theta_4) Ry(theta_5) Rz(theta_6)` (eq. 14).
fn forearm_to_flange(shoulder: &Shoulder, elbow: &Elbow, rotation: &Matrix3<f64>) -> Matrix3<f64> {
    let (r0, r1, r2) = (rotation.row(0), rotation.row(1), rotation.row(2));
    let n0 = r0 * shoulder.cos_1 + r1 * shoulder.sin_1;
    let n1 = r1 * shoulder.cos_1 - r0 * shoulder.sin_1;
    Matrix3::from_rows(&[n0 * elbow.cos_23 - r2 * elbow.sin_23, n1, n0 * elbow.sin_23 + r2 * elbow.cos_23])
}

/// The wrist angles (eq. 15 to 18). Taking theta_6 and theta_5 with the sine and cosine of the theta_4 that was chosen keeps the
/// residual at rounding next to theta_5 = 0, whatever theta_4 is.
fn wrist(m: &Matrix3<f64>, free_theta_4: f64, radius: f64) -> Wrist {
    let column: Vector3<f64> = m.column(2).into();
    let sin_5 = column.x.hypot(column.y);
    let silent = sin_5 <= radius.max(WRIST_FREE_SIN);
    let (sin_4, cos_4) = if silent { free_theta_4.sin_cos() } else { (column.y / sin_5, column.x / sin_5) };
    let theta_4 = if silent { free_theta_4 } else { column.y.atan2(column.x) };
    let projected = cos_4 * column.x + sin_4 * column.y;
    let sin_5_signed = if projected.abs() <= WRIST_FREE_SIN { projected.max(0.0) } else { projected };
    let theta_5 = sin_5_signed.atan2(column.z);
    let theta_6 = (cos_4 * m[(1, 0)] - sin_4 * m[(0, 0)]).atan2(cos_4 * m[(1, 1)] - sin_4 * m[(0, 1)]);
    Wrist { theta: [theta_4, theta_5, theta_6], merged: sin_5 <= WRIST_MERGE_SIN }
}
