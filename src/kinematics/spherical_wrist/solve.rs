//! The inverse: up to eight joint vectors of a wrist frame.

use nalgebra::{Matrix3, Rotation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use core::f64::consts::PI;

use super::SphericalWrist;
use crate::kinematics::angles::wrap;
use crate::kinematics::pose::Pose;
use crate::kinematics::solutions::{FreeJoint, SLOTS};
use crate::kinematics::status::{Reach, Status};
use crate::kinematics::thresholds::{REACH_TOLERANCE, SEEDED_FREE, WRIST_FREE_SIN, WRIST_MERGE_SIN};

/// What to take for a joint that the pose does not determine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FreeChoice {
    /// Joint angles [rad], of which the free one's is taken.
    q: [f64; 6],
    /// How close to a singularity the pose counts as silent, beyond rounding [rad, m]; above zero, the merged branch nearer to q is kept.
    radius: f64,
    /// A joint that is taken from q whatever the pose says, from 1.
    forced: Option<usize>,
    /// Whether a free q1 is that of the shoulder that has the wrist centre behind it.
    behind: bool,
}

impl FreeChoice {
    /// Zero for a free joint, only where rounding hides it.
    pub(crate) const ZERO: Self = Self { q: [0.0; 6], radius: 0.0, forced: None, behind: false };

    /// The seed's angle for a free joint.
    pub(crate) fn seed(q: [f64; 6]) -> Self {
        Self { q, radius: SEEDED_FREE, forced: None, behind: false }
    }

    /// The angle that `q` has for joint `joint`, from 1; for another one only where rounding hides it.
    pub(crate) fn forced(q: [f64; 6], joint: usize, behind: bool) -> Self {
        Self { q, radius: f64::MIN_POSITIVE, forced: Some(joint), behind }
    }
}

/// The joint vectors of a wrist frame, in their slots.
pub(crate) struct Branches {
    pub(crate) q: [Option<[f64; 6]>; SLOTS],
    /// Singularities of each slot's branch, and MERGED where the slot gave its solution to another.
    pub(crate) flags: [Status; SLOTS],
    /// The joint that the pose leaves free in each slot.
    pub(crate) free: [Option<FreeJoint>; SLOTS],
    pub(crate) reach: Reach,
}

/// One way for axis 1 to face the wrist centre.
#[derive(Clone, Copy)]
struct Shoulder {
    sin_1: f64,
    cos_1: f64,
    /// Wrist centre from axis 1, along the arm's plane [m]; negative behind it.
    x: f64,
    /// How far rounding may turn it [rad].
    error: f64,
}

/// The shoulder that faces the wrist centre, the one that has it behind, and whether they are one.
struct Shoulders {
    front: Shoulder,
    behind: Shoulder,
    merged: bool,
    /// Where they are merged: whether the one behind is kept.
    keep_behind: bool,
}

/// One way for the elbow to stand.
#[derive(Clone, Copy)]
struct Elbow {
    theta_2: f64,
    theta_3: f64,
    sin_23: f64,
    cos_23: f64,
}

/// The elbow in front of and behind the line to the wrist centre; without the second, they are one.
struct Elbows {
    front: Elbow,
    behind: Option<Elbow>,
    /// How far rounding may turn the forearm [rad].
    error: f64,
    /// The wrist centre is on axis 2: the upper arm may point anywhere.
    free: bool,
}

/// One branch of the wrist, with theta_5 in 0 ..= pi unless theta_4 was given; the other one is its flip.
struct Wrist {
    theta: [f64; 3],
    merged: bool,
    /// Singular by its own angle, whatever is known of the forearm.
    free: bool,
}

/// What one shoulder's branches are made from.
struct Target<'a> {
    wxy: [f64; 2],
    wz: f64,
    rotation: &'a Matrix3<f64>,
    free: &'a FreeChoice,
    free_theta: [f64; 6],
    /// How far beyond reach the wrist centre may be and still get the stretched or folded arm [m].
    tolerance: f64,
}

impl SphericalWrist {
    /// Every branch of the wrist frame `t_shoulder_wrist`.
    pub(crate) fn solve(&self, t_shoulder_wrist: &Pose, free: &FreeChoice) -> Branches {
        let w = t_shoulder_wrist.translation.vector;
        let mut target = Target {
            wxy: [w.x, w.y],
            wz: w.z,
            rotation: t_shoulder_wrist.rotation.matrix(),
            free,
            free_theta: self.theta(&free.q),
            tolerance: self.position_rounding(),
        };
        let shoulders = match self.shoulders(&target) {
            Ok(shoulders) => shoulders,
            Err(missed) => return Branches::empty(missed),
        };
        let branches = self.branches(&shoulders, &target);
        let shortfall = branches.reach.shortfall();
        if shortfall == 0.0 || shortfall > REACH_TOLERANCE {
            return branches;
        }
        // No branch reaches, the nearest one by less than anyone could see: it gets the stretched or folded arm.
        target.tolerance = shortfall;
        self.branches(&shoulders, &target)
    }

    fn branches(&self, shoulders: &Shoulders, target: &Target<'_>) -> Branches {
        let mut branches = Branches::empty(Reach::Reached);
        let mut fill = |base: usize, shoulder: &Shoulder| match self.fill(&mut branches, base, shoulder, target) {
            missed if missed == Reach::Reached || self.b == 0.0 => missed,
            missed => match self.fill(&mut branches, base, &self.eased(shoulder, target), target) {
                Reach::Reached => Reach::Reached,
                _ => missed,
            },
        };
        let (front, behind) = (fill(0, &shoulders.front), fill(4, &shoulders.behind));
        branches.reach = if behind.shortfall() < front.shortfall() { behind } else { front };
        if shoulders.merged {
            branches.merge_shoulders(shoulders.keep_behind, self.b == 0.0);
        }
        branches
    }

    /// Both shoulders (eq. 2 to 4).
    fn shoulders(&self, target: &Target<'_>) -> Result<Shoulders, Reach> {
        let [wx, wy] = target.wxy;
        let (rho, rounding) = (wx.hypot(wy), self.position_rounding());
        let outside = rho - self.b.abs();
        if outside < -REACH_TOLERANCE {
            return Err(Reach::TooNear { shortfall: -outside });
        }
        let (sin_1, cos_1) = target.free_theta[0].sin_cos();
        if self.b == 0.0 && (target.free.forced == Some(1) || rho <= target.free.radius.max(rounding)) {
            let keep_behind = target.free.behind;
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
        let keep_behind = target.free.radius > 0.0 && front.sin_1 * sin_1 + front.cos_1 * cos_1 < 0.0;
        Ok(Shoulders { front, behind, merged, keep_behind })
    }

    /// The joint vectors that bring a point of the tool to `point` with the wrist angles of `q`: up to four, the wrist's as they are.
    ///
    /// With the wrist held, forearm and tool are one link that ends at the point: the same arm with other a2, b and c3 (eq. 20).
    pub(crate) fn to_point(&self, point: &Vector3<f64>, tool_in_wrist: &Vector3<f64>, q: &[f64; 6]) -> impl Iterator<Item = [f64; 6]> {
        let theta = self.theta(q);
        let lever = wrist_rotation(theta[3], theta[4], theta[5]) * tool_in_wrist;
        let (a2, c3) = (self.a2 + lever.x, self.c3 + lever.z);
        let arm = Self { a2, b: self.b + lever.y, c3, k: a2.hypot(c3), ..self.clone() };
        let still = Pose::from_parts((*point).into(), Rotation3::identity());
        let branches = arm.solve(&still, &FreeChoice::seed(*q));
        // Slots that differ in their last bit differ in the wrist of the point, which is not looked at.
        let wrist = [q[3], q[4], q[5]];
        [0, 2, 4, 6].into_iter().filter_map(move |slot| branches.q[slot].or(branches.q[slot + 1])).map(move |found| {
            let [q1, q2, q3, ..] = found;
            [q1, q2, q3, wrist[0], wrist[1], wrist[2]]
        })
    }

    /// The wrist angles with which the tool comes nearest to the rotation `m` of the flange in the forearm, theta_4 held: the approach axis
    /// in the plane that theta_5 moves it in, then the best turn about it. They are exact where the plane holds that axis.
    pub(crate) fn with_axis_4_held(&self, m: &Matrix3<f64>, q: &[f64; 6]) -> [f64; 6] {
        let mut theta = self.theta(q);
        let n = wrist_rotation(-theta[3], 0.0, 0.0) * m;
        let theta_5 = n[(0, 2)].atan2(n[(2, 2)]);
        let (sin_5, cos_5) = theta_5.sin_cos();
        let cosine = n[(0, 0)] * cos_5 + n[(1, 1)] - n[(2, 0)] * sin_5;
        let sine = n[(1, 0)] - n[(0, 1)] * cos_5 + n[(2, 1)] * sin_5;
        (theta[4], theta[5]) = (theta_5, sine.atan2(cosine));
        let [_, _, _, _, q5, q6] = self.joints(theta);
        [q[0], q[1], q[2], q[3], q5, q6]
    }

    /// The flange's rotation in the forearm, for the arm angles of `q` (eq. 14).
    pub(crate) fn rotation_in_forearm(&self, rotation: &Matrix3<f64>, q: &[f64; 6]) -> Matrix3<f64> {
        let [theta_1, theta_2, theta_3, ..] = self.theta(q);
        let ((sin_1, cos_1), (sin_23, cos_23)) = (theta_1.sin_cos(), (theta_2 + theta_3).sin_cos());
        let shoulder = Shoulder { sin_1, cos_1, x: 0.0, error: 0.0 };
        forearm_to_flange(&shoulder, &Elbow { theta_2, theta_3, sin_23, cos_23 }, rotation)
    }

    /// theta_1 from `Rz(theta_1) (x, b) = (wx, wy)` (eq. 4).
    fn shoulder(&self, wx: f64, wy: f64, x: f64, error: f64) -> Shoulder {
        let (sin, cos) = (wy * x - wx * self.b, wx * x + wy * self.b);
        let norm = sin.hypot(cos);
        Shoulder { sin_1: sin / norm, cos_1: cos / norm, x, error }
    }

    /// The shoulder with x moved towards reach as far as rounding leaves it open: next to the cylinder of radius b (eq. 3) a rounding of
    /// the pose is a large part of x, and a pose at the edge of reach says by that edge which x it has.
    fn eased(&self, shoulder: &Shoulder, target: &Target<'_>) -> Shoulder {
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

    /// Puts the four branches of one shoulder into slots `base` ..= `base` + 3.
    fn fill(&self, branches: &mut Branches, base: usize, shoulder: &Shoulder, target: &Target<'_>) -> Reach {
        let elbows = match self.elbows(shoulder.x - self.a1, target.wz, target) {
            Ok(elbows) => elbows,
            Err(missed) => return missed,
        };
        let theta_1 = shoulder.sin_1.atan2(shoulder.cos_1);
        let merged = if elbows.behind.is_none() { Status::ELBOW } else { Status::empty() };
        let error = shoulder.error + elbows.error;
        for (elbow, slot) in [(Some(elbows.front), base), (elbows.behind, base + 2)] {
            let Some(elbow) = elbow else {
                for twin in [slot, slot + 1] {
                    branches.flags[twin] = branches.flags[base] | Status::MERGED;
                }
                continue;
            };
            let Elbow { theta_2, theta_3, .. } = elbow;
            let wrist = wrist(&forearm_to_flange(shoulder, &elbow, target.rotation), target, error);
            let [theta_4, theta_5, theta_6] = wrist.theta;
            let flags = if wrist.merged { merged | Status::WRIST } else { merged };
            // A free theta_4 that was given may leave theta_5 negative: then the flipped slot is the one that is kept.
            let (kept, flipped) = if theta_5 < 0.0 { (slot + 1, slot) } else { (slot, slot + 1) };
            branches.q[kept] = Some(self.joints([theta_1, theta_2, theta_3, theta_4, theta_5, theta_6]));
            branches.flags[kept] = flags;
            branches.flags[flipped] = flags;
            if elbows.free {
                branches.free[kept] = Some(FreeJoint::Upper);
                branches.free[flipped] = Some(FreeJoint::Upper);
            }
            if wrist.free {
                branches.free[kept] = Some(self.free_wrist(theta_5));
            }
            if wrist.merged {
                branches.flags[flipped] |= Status::MERGED;
            } else {
                branches.q[flipped] = Some(self.joints([theta_1, theta_2, theta_3, theta_4 + PI, -theta_5, theta_6 + PI]));
            }
        }
        Reach::Reached
    }

    /// Both elbows (eq. 6 to 12).
    fn elbows(&self, x: f64, z: f64, target: &Target<'_>) -> Result<Elbows, Reach> {
        let r2 = x * x + z * z;
        let r = r2.sqrt();
        let (longest, shortest) = (self.c2 + self.k, (self.c2 - self.k).abs());
        if r - longest > target.tolerance {
            return Err(Reach::TooFar { shortfall: r - longest });
        }
        if shortest - r > target.tolerance {
            return Err(Reach::TooNear { shortfall: shortest - r });
        }
        if r <= target.free.radius.max(self.position_rounding()) {
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

    /// The angles of an elbow from the direction of the upper arm, of any length, and that of the forearm, of length one (eq. 10 to 12).
    fn elbow(&self, upper: [f64; 2], forearm: [f64; 2]) -> Elbow {
        let (sin_psi, cos_psi) = (self.a2 / self.k, self.c3 / self.k);
        let sin_23 = forearm[0] * cos_psi - forearm[1] * sin_psi;
        let cos_23 = forearm[1] * cos_psi + forearm[0] * sin_psi;
        let theta_2 = upper[0].atan2(upper[1]);
        Elbow { theta_2, theta_3: sin_23.atan2(cos_23) - theta_2, sin_23, cos_23 }
    }

    /// What the pose leaves open at theta_5 = 0 or 180 deg, in terms of the joints.
    fn free_wrist(&self, theta_5: f64) -> FreeJoint {
        let sum = (theta_5.cos() > 0.0) == (self.signs[3] * self.signs[5] > 0.0);
        if sum { FreeJoint::WristSum } else { FreeJoint::WristDifference }
    }

    fn joints(&self, theta: [f64; 6]) -> [f64; 6] {
        core::array::from_fn(|i| wrap(self.signs[i] * (theta[i] + self.offsets[i])))
    }
}

impl Branches {
    fn empty(reach: Reach) -> Self {
        Self { q: [None; SLOTS], flags: [Status::empty(); SLOTS], free: [None; SLOTS], reach }
    }

    /// The wrist centre is on axis 1: an elbow that both shoulders have is one branch, turned. With b = 0, q1 is free.
    fn merge_shoulders(&mut self, keep_behind: bool, free: bool) {
        for slot in 0..SLOTS {
            if self.q[slot].is_some() {
                self.flags[slot] |= Status::SHOULDER;
                if free {
                    self.free[slot] = self.free[slot].or(Some(FreeJoint::Base));
                }
            }
        }
        let exists = |branches: &Self, elbow: usize| branches.q[elbow].is_some() || !branches.flags[elbow].is_empty();
        for elbow in [0, 2] {
            let (kept, turned) = if keep_behind { (elbow + 4, elbow) } else { (elbow, elbow + 4) };
            let (kept, turned) = if exists(self, kept) { (kept, turned) } else { (turned, kept) };
            if !exists(self, kept) {
                continue;
            }
            for wrist in [0, 1] {
                self.q[turned + wrist] = None;
                self.flags[turned + wrist] = self.flags[kept + wrist] | Status::SHOULDER | Status::MERGED;
            }
        }
    }
}

impl Shoulder {
    /// Turned by half a turn: what was in front is behind.
    fn turned(self) -> Self {
        Self { sin_1: -self.sin_1, cos_1: -self.cos_1, x: -self.x, error: self.error }
    }
}

/// `Rz(theta_4) Ry(theta_5) Rz(theta_6)`.
fn wrist_rotation(theta_4: f64, theta_5: f64, theta_6: f64) -> Matrix3<f64> {
    let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
    let rotation = about(Vector3::z_axis(), theta_4) * about(Vector3::y_axis(), theta_5) * about(Vector3::z_axis(), theta_6);
    rotation.into_inner()
}

/// `Ry(-theta_23) Rz(-theta_1) R`, which is `Rz(theta_4) Ry(theta_5) Rz(theta_6)` (eq. 14).
fn forearm_to_flange(shoulder: &Shoulder, elbow: &Elbow, rotation: &Matrix3<f64>) -> Matrix3<f64> {
    let (r0, r1, r2) = (rotation.row(0), rotation.row(1), rotation.row(2));
    let n0 = r0 * shoulder.cos_1 + r1 * shoulder.sin_1;
    let n1 = r1 * shoulder.cos_1 - r0 * shoulder.sin_1;
    Matrix3::from_rows(&[n0 * elbow.cos_23 - r2 * elbow.sin_23, n1, n0 * elbow.sin_23 + r2 * elbow.cos_23])
}

/// The wrist angles (eq. 15 to 18). Taking theta_6 and theta_5 with the sine and cosine of the theta_4 that was chosen keeps the
/// residual at rounding next to theta_5 = 0, whatever theta_4 is. `error` is how far rounding may turn the forearm: a theta_5 below it
/// is none.
fn wrist(m: &Matrix3<f64>, target: &Target<'_>, error: f64) -> Wrist {
    let column: Vector3<f64> = m.column(2).into();
    let sin_5 = column.x.hypot(column.y);
    let merged = sin_5 <= WRIST_MERGE_SIN.max(error);
    let silent = target.free.forced == Some(4) || sin_5 <= target.free.radius.max(WRIST_FREE_SIN);
    let (free_sin, free_cos) = target.free_theta[3].sin_cos();
    let (sin_4, cos_4) = if silent {
        (free_sin, free_cos)
    } else {
        // Of merged branches, the one nearer to the seed is kept.
        let flips = merged && target.free.radius > 0.0 && free_sin * column.y + free_cos * column.x < 0.0;
        let sign = if flips { -1.0 } else { 1.0 };
        (sign * column.y / sin_5, sign * column.x / sin_5)
    };
    let theta_4 = if silent { target.free_theta[3] } else { sin_4.atan2(cos_4) };
    let projected = cos_4 * column.x + sin_4 * column.y;
    let sin_5_signed = if projected.abs() <= WRIST_FREE_SIN { projected.max(0.0) } else { projected };
    let theta_5 = sin_5_signed.atan2(column.z);
    let theta_6 = (cos_4 * m[(1, 0)] - sin_4 * m[(0, 0)]).atan2(cos_4 * m[(1, 1)] - sin_4 * m[(0, 1)]);
    Wrist { theta: [theta_4, theta_5, theta_6], merged, free: sin_5 <= WRIST_MERGE_SIN }
}
