//! The branches of the arm in branch-free arithmetic, which runs in lanes.
//!
//! They have the equations of `elbow` and `wrist`. A branch near a singularity or the edge of reach
//! is not regular; `solve` then decides.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::elbow::Links;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::lanes::Direction;
use crate::kinematics::structure::triangle::Triangle;
use crate::kinematics::structure::zyz::zyz_directions;
use crate::kinematics::thresholds::{REGULAR_ASIDE, REGULAR_ELBOW_SIN, REGULAR_WRIST_SIN};
use crate::lanes::{mul_add, sin_cos};

/// The precomputed constants of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Constants {
    a3: f64,
    c3: f64,
    a4: f64,
    c5: f64,
    triangle: Triangle,
    /// upper^2 + forearm^2
    squares: f64,
    sin_psi: f64,
    cos_psi: f64,
    /// Least size of m^2 (eq. 55) [m^4] and of the square of `aside` (eq. 60) [m^2] of a regular
    /// branch.
    regular_m2: f64,
    regular_aside2: f64,
    /// From the frame of joint 7 to the hand, and the sign and offset of joint 7.
    t_seven_hand: Frame,
    sign_7: f64,
    offset_7: f64,
}

impl Constants {
    pub(super) fn of(links: &Links, map: &JointMap<7>, t_seven_hand: &Pose) -> Self {
        let (upper, forearm, extent) = (links.upper, links.forearm, links.extent);
        let [sin_psi, cos_psi] = links.psi;
        let (least_m, least_aside) = (REGULAR_ELBOW_SIN * links.product(), REGULAR_ASIDE * extent);
        // How far rounding may rotate the upper arm of a regular branch (`wrist_error`, at its
        // worst).
        let moved = links.direction_rounding() * (1.0 + (upper + forearm) * extent / least_m);
        let error = moved / least_aside * (1.0 + (upper + forearm) / least_aside);
        Self {
            a3: links.a3,
            c3: links.c3,
            a4: links.a4,
            c5: links.c5,
            triangle: Triangle::new(upper, forearm),
            squares: upper * upper + forearm * forearm,
            sin_psi,
            cos_psi,
            regular_m2: least_m * least_m,
            // If that could hide branches of a shoulder, because the arm is minute relative to its
            // end frames, no branch is regular.
            regular_aside2: if error <= 0.1 * REGULAR_WRIST_SIN {
                least_aside * least_aside
            } else {
                f64::INFINITY
            },
            t_seven_hand: Frame::of(t_seven_hand),
            sign_7: map.signs[6],
            offset_7: map.offsets[6],
        }
    }

    /// The hand of a frame of joint 7, with joint 7 at `q7` (eq. 52).
    #[inline(always)]
    pub(super) fn hand<const FUSED: bool>(&self, seven: &Frame, q7: f64) -> Frame {
        let (sin_7, cos_7) = sin_cos::<FUSED>(self.sign_7 * q7 - self.offset_7);
        seven.unturned::<FUSED>(sin_7, cos_7).times::<FUSED>(&self.t_seven_hand)
    }
}

/// One branch of elbow and wrist: the directions of its angles, NaN if it does not reach.
pub(super) struct Branch {
    /// With theta_2 in 0 ..= pi; the flipped shoulder follows by eq. 64.
    pub(super) theta: [Direction; 6],
    pub(super) reached: bool,
    /// Whether the branch is regular (well conditioned).
    pub(super) regular: bool,
}

/// The branch with `elbow` (1, or -1 bent backwards) and `wrist` (1, or -1 with a negative cosine
/// of theta_5) for a hand frame.
#[inline(always)]
pub(super) fn branch<const FUSED: bool>(
    arm: &Constants,
    t_shoulder_hand: &Frame,
    elbow: f64,
    wrist: f64,
) -> Branch {
    let Frame { rotation: r, origin: w } = t_shoulder_hand;
    // The shoulder in the hand frame (eq. 53).
    let (x, y, z) = (-along::<FUSED>(r, w, 0), -along::<FUSED>(r, w, 1), -along::<FUSED>(r, w, 2));
    let rho2 = mul_add::<FUSED>(x, x, z * z);
    let (rho, high, r2) = (rho2.sqrt(), y.abs(), mul_add::<FUSED>(y, y, rho2));
    // The elbow (eq. 54 to 58).
    let m2 = arm.triangle.m2(r2);
    let (m, cosine) = (elbow * m2.sqrt(), 0.5 * (r2 - arm.squares));
    let scale = 1.0 / mul_add::<FUSED>(m, m, cosine * cosine).sqrt();
    let (sin_e, cos_e) = (scale * m, scale * cosine);
    let sin_4 = mul_add::<FUSED>(sin_e, arm.cos_psi, cos_e * arm.sin_psi);
    let cos_4 = mul_add::<FUSED>(cos_e, arm.cos_psi, -(sin_e * arm.sin_psi));
    let across = mul_add::<FUSED>(arm.c3, sin_4, -mul_add::<FUSED>(arm.a3, cos_4, arm.a4));
    let forward = -mul_add::<FUSED>(arm.a3, sin_4, mul_add::<FUSED>(arm.c3, cos_4, arm.c5));
    // The wrist (eq. 60 to 62).
    let (wide, long) = (across.abs(), forward.abs());
    let aside2 =
        if high < rho { (wide - high) * (wide + high) } else { (rho - long) * (rho + long) };
    let side = if across < 0.0 { -1.0 } else { 1.0 };
    let aside = wrist * side * aside2.sqrt();
    let (sin_5, cos_5) = unit::<FUSED>(-y * side, aside * side);
    let (sin_6, cos_6) = unit::<FUSED>(
        mul_add::<FUSED>(aside, z, -(forward * x)),
        mul_add::<FUSED>(aside, x, forward * z),
    );
    // The shoulder (eq. 63): the rotation of the hand times the transpose of Ry(theta_4)
    // Rz(theta_5) Ry(theta_6).
    let (c56, s56) = (cos_5 * cos_6, cos_5 * sin_6);
    let first = [
        mul_add::<FUSED>(cos_4, c56, -(sin_4 * sin_6)),
        -(cos_4 * sin_5),
        mul_add::<FUSED>(cos_4, s56, sin_4 * cos_6),
    ];
    let second = [sin_5 * cos_6, cos_5, sin_5 * sin_6];
    let third = [
        -mul_add::<FUSED>(sin_4, c56, cos_4 * sin_6),
        sin_4 * sin_5,
        mul_add::<FUSED>(cos_4, cos_6, -(sin_4 * s56)),
    ];
    let (m00, m01, m02) =
        (dot::<FUSED>(r[0], first), dot::<FUSED>(r[0], second), dot::<FUSED>(r[0], third));
    let (m10, m11, m12) =
        (dot::<FUSED>(r[1], first), dot::<FUSED>(r[1], second), dot::<FUSED>(r[1], third));
    let m22 = dot::<FUSED>(r[2], third);
    let [theta_1, theta_2, theta_3] =
        zyz_directions::<FUSED>([m00, m01, m02], [m10, m11, m12], m22);
    let [sin_2, _] = theta_2;
    let reached = (m2 >= 0.0) & (aside2 >= 0.0);
    Branch {
        theta: [theta_1, theta_2, theta_3, [sin_4, cos_4], [sin_5, cos_5], [sin_6, cos_6]],
        reached,
        regular: (m2.abs() >= arm.regular_m2)
            & ((m2 < 0.0) | (aside2.abs() >= arm.regular_aside2))
            & (!reached | (sin_2 >= REGULAR_WRIST_SIN)),
    }
}

/// A component of `r^T w`.
#[inline(always)]
fn along<const FUSED: bool>(r: &[[f64; 3]; 3], w: &[f64; 3], j: usize) -> f64 {
    mul_add::<FUSED>(r[0][j], w[0], mul_add::<FUSED>(r[1][j], w[1], r[2][j] * w[2]))
}

#[inline(always)]
fn dot<const FUSED: bool>(a: [f64; 3], b: [f64; 3]) -> f64 {
    mul_add::<FUSED>(a[0], b[0], mul_add::<FUSED>(a[1], b[1], a[2] * b[2]))
}

#[inline(always)]
fn unit<const FUSED: bool>(sin: f64, cos: f64) -> (f64, f64) {
    let scale = 1.0 / mul_add::<FUSED>(sin, sin, cos * cos).sqrt();
    (scale * sin, scale * cos)
}
