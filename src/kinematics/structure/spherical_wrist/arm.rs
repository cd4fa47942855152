//! One branch of the arm with its wrist; on a path, where the pose leaves its shoulder undetermined,
//! too.

use core::f64::consts::PI;

use nalgebra::Matrix3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::SphericalWrist;
use crate::kinematics::pose::angles::{constant_sin_cos, wrap};
use crate::kinematics::structure::free_choice::SeedPolicy;
use crate::kinematics::structure::planar_arm::{Elbow, Shoulder, Target};
use crate::kinematics::structure::zyz::{First, Zyz, zyz};
use crate::kinematics::thresholds::{PATH_WRIST_SIN, SEEDED_FREE};

/// Bisections of the interval between two planes on either side of one: to rounding.
const HALVINGS: u32 = 50;

/// One branch of the arm.
#[derive(Clone, Copy)]
pub(super) struct ArmBranch {
    pub(super) shoulder: Shoulder,
    pub(super) elbow: Elbow,
    pub(super) wrist: Zyz,
}

/// The uncertainty that rounding leaves to an elbow.
#[derive(Clone, Copy)]
pub(super) struct ElbowUncertainty {
    /// How far it may rotate the forearm [rad].
    pub(super) error: f64,
    /// Whether both elbows are one.
    pub(super) straight: bool,
}

impl SphericalWrist {
    /// The branch of a shoulder and an elbow. On a path, where the pose leaves the shoulder's angle
    /// undetermined, the one that moves the joints less: with the angle that joint 1 is heading
    /// for, or rotated so that joint 4 has the one that it is heading for.
    pub(super) fn arm_branch(
        &self,
        shoulder: &Shoulder,
        elbow: &Elbow,
        target: &Target<'_>,
        open: ElbowUncertainty,
    ) -> ArmBranch {
        let with_wrist = |(shoulder, elbow, error): (Shoulder, Elbow, f64)| {
            let m = forearm_to_flange(&shoulder, &elbow, target.rotation);
            ArmBranch { shoulder, elbow, wrist: wrist(&m, target, error) }
        };
        let from_pose = with_wrist((*shoulder, *elbow, open.error));
        if target.free.policy != SeedPolicy::Path {
            return from_pose;
        }
        let nearer = |best: ArmBranch, rotated: (Shoulder, Elbow, f64)| {
            let rotated = with_wrist(rotated);
            if motion(&rotated, target) < motion(&best, target) { rotated } else { best }
        };
        if self.planar.b == 0.0 {
            let rotated = self.rotated_for_wrist(shoulder, elbow, target);
            rotated
                .map(|shoulder| (shoulder, *elbow, open.error))
                .into_iter()
                .fold(from_pose, nearer)
        } else {
            self.rotated_within_uncertainty(shoulder, elbow, target, open).fold(from_pose, nearer)
        }
    }

    /// On a path, with b != 0: the shoulder rotated within its uncertainty, and the elbow with it,
    /// so that the wrist can keep the joint 4 that it is heading for; there the approach axis has
    /// no component across that joint's plane (eq. 27). Also where the arm is straight at the edge
    /// of reach, which leaves the forearm undetermined. Returned with the forearm's uncertainty
    /// [rad].
    fn rotated_within_uncertainty<'a>(
        &'a self,
        shoulder: &'a Shoulder,
        elbow: &Elbow,
        target: &'a Target<'a>,
        open: ElbowUncertainty,
    ) -> impl Iterator<Item = (Shoulder, Elbow, f64)> + use<'a> {
        let m = forearm_to_flange(shoulder, elbow, target.rotation);
        let near = m[(0, 2)].hypot(m[(1, 2)]) <= PATH_WRIST_SIN;
        let ends = if near { self.planar.rotation_range(shoulder, target.wxy) } else { [0.0; 2] };
        // Bent by the rotation, a straight arm may be on either side.
        let behind = self.planar.sin_elbow(elbow.theta_3) < 0.0;
        let sides = [false, true].into_iter().filter(move |side| open.straight || *side == behind);
        sides.flat_map(move |side| {
            let plane = RotatedPlane { arm: self, shoulder, target, behind: side };
            ends.into_iter().flat_map(move |end| plane.ways(end))
        })
    }

    /// On a path: a shoulder whose angle the pose leaves undetermined, rotated so that the wrist
    /// can keep the joint 4 that it is heading for.
    ///
    /// With theta_23 and theta_4 known, `R = Rz(theta_1) A Ry(theta_5) Rz(theta_6)` has the height
    /// of the approach axis on both sides: `A20 sin theta_5 + A22 cos theta_5 = R22` (eq. 24), and
    /// theta_1 follows from its direction.
    fn rotated_for_wrist(
        &self,
        shoulder: &Shoulder,
        elbow: &Elbow,
        target: &Target<'_>,
    ) -> Option<Shoulder> {
        let [_, _, _, theta_4, theta_5, _] = target.free_theta;
        let (sin_4, cos_4) = theta_4.sin_cos();
        let (a20, a22) = (-elbow.sin_23 * cos_4, elbow.cos_23);
        let height = target.rotation[(2, 2)] / a20.hypot(a22);
        if height.abs() > 1.0 {
            return None;
        }
        let (middle, spread) = (a20.atan2(a22), height.acos());
        let nearer = |a: f64, b: f64| if (theta_5 - a).cos() > (theta_5 - b).cos() { a } else { b };
        let (sin_5, cos_5) = nearer(middle + spread, middle - spread).sin_cos();
        let (x, y) = (elbow.cos_23 * cos_4 * sin_5 + elbow.sin_23 * cos_5, sin_4 * sin_5);
        let (to_x, to_y) = (target.rotation[(0, 2)], target.rotation[(1, 2)]);
        let (sin, cos) = (to_y * x - to_x * y, to_x * x + to_y * y);
        let norm = sin.hypot(cos);
        let rotated = Shoulder { sin_1: sin / norm, cos_1: cos / norm, ..*shoulder };
        let turn = (rotated.sin_1 * shoulder.cos_1 - rotated.cos_1 * shoulder.sin_1)
            .hypot(1.0 - rotated.sin_1 * shoulder.sin_1 - rotated.cos_1 * shoulder.cos_1);
        // The wrist center must not move by more than rounding or, if q1 is free, than the seed's
        // radius.
        let open = if shoulder.x.abs() <= SEEDED_FREE {
            SEEDED_FREE
        } else {
            self.planar.position_rounding()
        };
        (norm > 0.0 && turn < 0.1 && turn * shoulder.x.abs() <= open).then_some(rotated)
    }
}

/// The planes of an arm with b != 0 within the uncertainty, with one of its elbows.
#[derive(Clone, Copy)]
struct RotatedPlane<'a> {
    arm: &'a SphericalWrist,
    shoulder: &'a Shoulder,
    target: &'a Target<'a>,
    behind: bool,
}

impl RotatedPlane<'_> {
    /// The shoulder rotated by `angle`, the elbow that it then has, and the uncertainty of the
    /// forearm [rad].
    fn at(&self, angle: f64) -> Option<(Shoulder, Elbow, f64)> {
        let Self { arm, shoulder, target, behind } = self;
        let rotated = shoulder.rotated(angle, target.wxy);
        let end = [rotated.x - arm.planar.a1, target.wz];
        let (theta_2, policy) = (target.free_theta[1], target.free.policy);
        let elbows = arm.planar.elbows(end, target.tolerance, theta_2, policy).ok()?;
        let elbow = elbows.behind.filter(|_| *behind).unwrap_or(elbows.front);
        Some((rotated, elbow, rotated.error + elbows.error))
    }

    /// The component of the approach axis across the plane in which joint 5 moves it with the joint
    /// 4 that a path is heading for.
    fn across(&self, angle: f64) -> Option<f64> {
        let (shoulder, elbow, _) = self.at(angle)?;
        let m = forearm_to_flange(&shoulder, &elbow, self.target.rotation);
        let (sin_4, cos_4) = self.target.free_theta[3].sin_cos();
        Some(m[(1, 2)] * cos_4 - m[(0, 2)] * sin_4)
    }

    /// The arm in the plane before `end` in which that component is zero, and at the edge of reach
    /// if that is before `end`.
    fn ways(self, end: f64) -> impl Iterator<Item = (Shoulder, Elbow, f64)> + use<> {
        let reaches = |angle: f64| self.at(angle).is_some();
        let far = if reaches(end) { end } else { halved([0.0, end], reaches) };
        let edge = if far.total_cmp(&end).is_eq() { None } else { self.at(far) };
        let from = self.across(0.0).unwrap_or(0.0);
        let before = |angle: f64| self.across(angle).is_some_and(|across| across * from >= 0.0);
        let kept =
            (!before(far)).then(|| halved([0.0, far], before)).and_then(|angle| self.at(angle));
        edge.into_iter().chain(kept)
    }
}

/// The last place between two, to rounding, up to which `is_so` has the same value as at the first.
fn halved([mut near, mut far]: [f64; 2], is_so: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (near + far);
        if is_so(middle) {
            near = middle;
        } else {
            far = middle;
        }
    }
    near
}

/// The distance of a branch from where the joints are heading, without joints 2 and 3: the sum of
/// squares [rad^2].
fn motion(ArmBranch { shoulder, wrist, .. }: &ArmBranch, target: &Target<'_>) -> f64 {
    let [heading_1, _, _, heading_4, heading_5, heading_6] = target.free_theta;
    let [theta_4, theta_5, theta_6] = wrist.theta;
    let apart = |theta: f64, heading: f64| wrap(theta - heading).powi(2);
    let kept = apart(theta_4, heading_4) + apart(theta_5, heading_5) + apart(theta_6, heading_6);
    let flipped = apart(theta_4 + PI, heading_4)
        + apart(-theta_5, heading_5)
        + apart(theta_6 + PI, heading_6);
    apart(shoulder.sin_1.atan2(shoulder.cos_1), heading_1) + kept.min(flipped)
}

/// The wrist angles (eq. 15 to 17). `error` is how far rounding may rotate the forearm: a theta_5
/// below it is treated as zero.
pub(super) fn wrist(m: &Matrix3<f64>, target: &Target<'_>, error: f64) -> Zyz {
    zyz(m, &First { joint: 4, theta: target.free_theta[3], policy: target.free.policy }, error)
}

/// `Ry(-theta_23) Rz(-theta_1) R`, which is `Rz(theta_4) Ry(theta_5) Rz(theta_6)` (eq. 14).
pub(super) fn forearm_to_flange(
    shoulder: &Shoulder,
    elbow: &Elbow,
    rotation: &Matrix3<f64>,
) -> Matrix3<f64> {
    let (r0, r1, r2) = (rotation.row(0), rotation.row(1), rotation.row(2));
    let n0 = r0 * shoulder.cos_1 + r1 * shoulder.sin_1;
    let n1 = r1 * shoulder.cos_1 - r0 * shoulder.sin_1;
    Matrix3::from_rows(&[
        n0 * elbow.cos_23 - r2 * elbow.sin_23,
        n1,
        n0 * elbow.sin_23 + r2 * elbow.cos_23,
    ])
}

/// `Rz(theta_4) Ry(theta_5) Rz(theta_6)`; exact if theta_4 is locked at a quarter turn.
pub(super) fn wrist_rotation(theta_4: f64, theta_5: f64, theta_6: f64) -> Matrix3<f64> {
    let about_z =
        |(sin, cos): (f64, f64)| Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0);
    let (sin_5, cos_5) = theta_5.sin_cos();
    let about_y = Matrix3::new(cos_5, 0.0, sin_5, 0.0, 1.0, 0.0, -sin_5, 0.0, cos_5);
    about_z(constant_sin_cos(theta_4)) * about_y * about_z(theta_6.sin_cos())
}
