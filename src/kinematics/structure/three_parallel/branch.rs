//! The branches of the arm in branch-free arithmetic, which runs in lanes.
//!
//! They have the equations of `planar_arm`, `wrist` and `solve`. Directions are not normalized,
//! which an arc tangent does not need. A branch near a singularity or the edge of reach is not
//! regular; `solve` and `reaching` then decide.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::geometry::ThreeParallel;
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::Direction;
use crate::kinematics::structure::triangle::Triangle;
use crate::kinematics::thresholds::{
    PATH_SHOULDER, PATH_WRIST_SIN, REACH_TOLERANCE, REGULAR_FOREARM, REGULAR_REACH,
    REGULAR_SHOULDER, REGULAR_WRIST_SIN, SHOULDER_MERGE,
};
use crate::lanes::mul_add;

/// The precomputed constants of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Constants {
    a1: f64,
    b: f64,
    d5: f64,
    triangle: Triangle,
    /// Least x of the shoulder [m] and least size of m^2 (eq. 8) [m^4] of a regular branch.
    regular_x: f64,
    regular_m2: f64,
    /// Least x sin theta_5 of a regular branch [m]: a rounding of the pose over this rotates joint
    /// 6, and moves the end of the planar arm.
    regular_turn: f64,
    /// Least sin theta_5 of a regular branch [1].
    regular_sin_5: f64,
}

impl Constants {
    pub(super) fn of(arm: &ThreeParallel) -> Self {
        let (planar, c2, k, extent) = (arm.planar, arm.planar.c2, arm.planar.k, arm.planar.extent);
        let regular_x = (REGULAR_SHOULDER * extent).max(10.0 * SHOULDER_MERGE);
        let regular_reach = (REGULAR_REACH * extent).max(10.0 * REACH_TOLERANCE);
        // How far rounding may rotate the plane of a regular branch; a forearm that is short loses
        // its length in eq. 10.
        let sound = planar.direction_rounding() / regular_x <= 0.1 * REGULAR_WRIST_SIN
            && k >= REGULAR_FOREARM * c2;
        Self {
            a1: planar.a1,
            b: planar.b,
            d5: arm.d5,
            triangle: Triangle::new(c2, k),
            regular_x: if sound { regular_x } else { f64::INFINITY },
            regular_m2: 2.0 * regular_reach * extent * c2 * k,
            regular_turn: 10.0 * planar.position_rounding() * arm.d5 / regular_reach,
            regular_sin_5: REGULAR_WRIST_SIN,
        }
    }

    /// Narrow the arm to regular branches that leave a path nothing to choose.
    pub(super) fn on_path(self) -> Self {
        let regular_x = self.regular_x * (PATH_SHOULDER / REGULAR_SHOULDER);
        Self { regular_x, regular_sin_5: PATH_WRIST_SIN, ..self }
    }
}

/// One shoulder with its wrist unflipped: the directions of its angles.
#[derive(Clone, Copy)]
pub(super) struct Facing {
    pub(super) theta_1: Direction,
    /// With theta_5 in 0 ..= pi; the flipped wrist follows by eq. 40.
    pub(super) theta_5: Direction,
    pub(super) theta_6: Direction,
    /// A unit vector.
    pub(super) phi: Direction,
    x: f64,
    pub(super) regular: bool,
}

/// The shoulder 1, or -1 with the wrist behind axis 1, for a wrist frame (eq. 32 to 36).
#[inline(always)]
pub(super) fn facing<const FUSED: bool>(
    arm: &Constants,
    t_shoulder_wrist: &Frame,
    shoulder: f64,
) -> Facing {
    let Frame { rotation: r, origin: [wx, wy, _] } = *t_shoulder_wrist;
    // Sine and cosine of theta_1 times rho^2, and with them the upper two rows of M.
    let rho2 = mul_add::<FUSED>(wx, wx, wy * wy);
    let rho = rho2.sqrt();
    let size = ((rho - arm.b) * (rho + arm.b)).sqrt();
    let x = shoulder * size;
    let (sin_1, cos_1) =
        (mul_add::<FUSED>(wy, x, -(wx * arm.b)), mul_add::<FUSED>(wx, x, wy * arm.b));
    let (m00, m02) = (
        mul_add::<FUSED>(r[0][0], cos_1, r[1][0] * sin_1),
        mul_add::<FUSED>(r[0][2], cos_1, r[1][2] * sin_1),
    );
    let m10 = mul_add::<FUSED>(r[1][0], cos_1, -(r[0][0] * sin_1));
    let m11 = mul_add::<FUSED>(r[1][1], cos_1, -(r[0][1] * sin_1));
    let m12 = mul_add::<FUSED>(r[1][2], cos_1, -(r[0][2] * sin_1));
    let sin_5 = mul_add::<FUSED>(m10, m10, m12 * m12).sqrt();
    let scale = 1.0 / (sin_5 * rho2);
    let sin_phi = scale * mul_add::<FUSED>(m10, m02, -(m12 * m00));
    let cos_phi = scale * rho2 * mul_add::<FUSED>(m10, r[2][2], -(m12 * r[2][0]));
    Facing {
        theta_1: [sin_1, cos_1],
        theta_5: [sin_5, m11],
        theta_6: [m12, m10],
        phi: [sin_phi, cos_phi],
        x,
        regular: (size >= arm.regular_x)
            & (sin_5 >= arm.regular_sin_5 * rho2)
            & (size * sin_5 >= arm.regular_turn * rho2),
    }
}

/// The arm of a shoulder and a wrist: the directions of its angles, NaN if it does not reach.
pub(super) struct Branch {
    pub(super) theta_2: Direction,
    pub(super) theta_23: Direction,
    pub(super) reached: bool,
    /// Whether the branch is regular (well conditioned).
    pub(super) regular: bool,
}

/// The branch with `wrist` (1, or -1 flipped) and `elbow` (1, or -1 with a negative theta_3) for a
/// shoulder (eq. 37, 5 to 12).
#[inline(always)]
pub(super) fn branch<const FUSED: bool>(
    arm: &Constants,
    facing: &Facing,
    wz: f64,
    wrist: f64,
    elbow: f64,
) -> Branch {
    let [sin_phi, cos_phi] = facing.phi;
    let reach = wrist * arm.d5;
    let (x, z) = (
        mul_add::<FUSED>(-reach, sin_phi, facing.x - arm.a1),
        mul_add::<FUSED>(-reach, cos_phi, wz),
    );
    let r2 = mul_add::<FUSED>(x, x, z * z);
    let m2 = arm.triangle.m2(r2);
    let reached = m2 >= 0.0;
    let [upper_x, upper_z] = arm.triangle.upper_arm::<FUSED>([x, z], r2, elbow * m2.sqrt());
    Branch {
        theta_2: [upper_x, upper_z],
        theta_23: [mul_add::<FUSED>(r2, x, -upper_x), mul_add::<FUSED>(r2, z, -upper_z)],
        reached,
        regular: facing.regular & (m2.abs() >= arm.regular_m2),
    }
}
