//! One branch of the arm with both of its wrists, in branch-free arithmetic, which runs in lanes.
//!
//! It has the equations of `arm` without a division: directions are not normalized, which an arc
//! tangent does not need. A branch near a singularity or the edge of reach is not regular; `solve`
//! and `arm` then decide.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::lanes::Direction;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::structure::triangle::Triangle;
use crate::kinematics::structure::zyz::zyz_directions;
use crate::kinematics::thresholds::{
    PATH_SHOULDER, PATH_WRIST_SIN, REACH_TOLERANCE, REGULAR_FOREARM, REGULAR_REACH,
    REGULAR_SHOULDER, REGULAR_WRIST_SIN, SHOULDER_MERGE,
};
use crate::lanes::mul_add;

/// The precomputed constants of an arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Constants {
    a1: f64,
    pub(super) b: f64,
    k: f64,
    triangle: Triangle,
    sin_psi: f64,
    cos_psi: f64,
    /// Least x of the shoulder [m] and least size of m^2 (eq. 8) [m^4] of a regular branch.
    regular_x: f64,
    regular_m2: f64,
    /// Least sin theta_5 of a regular branch [1].
    regular_sin_5: f64,
}

impl Constants {
    pub(super) fn of(arm: &PlanarArm) -> Self {
        let (c2, k, extent) = (arm.c2, arm.k, arm.extent);
        let regular_x = (REGULAR_SHOULDER * extent).max(10.0 * SHOULDER_MERGE);
        let regular_m2 =
            2.0 * (REGULAR_REACH * extent).max(10.0 * REACH_TOLERANCE) * extent * c2 * k;
        // How far rounding may rotate the forearm of a regular branch, with the least r for such an
        // m (eq. 7 and 8).
        let (least_m, least_r) = (regular_m2.sqrt(), 2.0 * regular_m2.sqrt() / (c2 + k));
        let error = arm.direction_rounding() * (1.0 / regular_x + c2 / least_m + 1.0 / least_r);
        Self {
            a1: arm.a1,
            b: arm.b,
            k,
            triangle: Triangle::new(c2, k),
            sin_psi: arm.a2 / k,
            cos_psi: arm.c3 / k,
            // If that could hide branches of a wrist, because the arm is minute relative to its end
            // frames, no branch is regular; nor if the forearm is so short that eq. 10 loses its
            // length.
            regular_x: if error <= 0.1 * REGULAR_WRIST_SIN && k >= REGULAR_FOREARM * c2 {
                regular_x
            } else {
                f64::INFINITY
            },
            regular_m2,
            regular_sin_5: REGULAR_WRIST_SIN,
        }
    }

    /// Narrow the arm to regular branches that leave a path nothing to choose.
    pub(super) fn on_path(self) -> Self {
        let regular_x = self.regular_x * (PATH_SHOULDER / REGULAR_SHOULDER);
        Self { regular_x, regular_sin_5: PATH_WRIST_SIN, ..self }
    }
}

/// One branch of the arm: the directions of its angles, NaN if it does not reach.
pub(super) struct Branch {
    /// theta_1, theta_2, theta_23 and theta_4 to theta_6, with theta_5 in 0 ..= pi; the flipped
    /// wrist follows by eq. 18.
    pub(super) theta: [Direction; 6],
    pub(super) reached: bool,
    /// Whether the branch is regular (well conditioned).
    pub(super) regular: bool,
}

/// The branch with `shoulder` (1, or -1 with the wrist center behind axis 1) and `elbow` (1, or -1
/// behind the lower arm) for a wrist frame; `LATERAL` if the arm has a lateral offset.
#[inline(always)]
pub(super) fn branch<const FUSED: bool, const LATERAL: bool>(
    arm: &Constants,
    t_shoulder_wrist: &Frame,
    shoulder: f64,
    elbow: f64,
) -> Branch {
    let Frame { rotation: r, origin: [wx, wy, wz] } = *t_shoulder_wrist;
    // Axis 1 (eq. 2 to 4); sine and cosine times `length_1`.
    let rho = mul_add::<FUSED>(wx, wx, wy * wy).sqrt();
    let size = if LATERAL { ((rho - arm.b.abs()) * (rho + arm.b.abs())).sqrt() } else { rho };
    let x = shoulder * size;
    let (sin_1, cos_1, length_1) = if LATERAL {
        (mul_add::<FUSED>(wy, x, -(wx * arm.b)), mul_add::<FUSED>(wx, x, wy * arm.b), rho * rho)
    } else {
        (shoulder * wy, shoulder * wx, rho)
    };
    // The elbow (eq. 5 to 12); upper arm times r2, forearm times `length_23`.
    let x = x - arm.a1;
    let r2 = mul_add::<FUSED>(x, x, wz * wz);
    let m2 = arm.triangle.m2(r2);
    let reached = m2 >= 0.0;
    let [upper_x, upper_z] = arm.triangle.upper_arm::<FUSED>([x, wz], r2, elbow * m2.sqrt());
    let (forearm_x, forearm_z) =
        (mul_add::<FUSED>(r2, x, -upper_x), mul_add::<FUSED>(r2, wz, -upper_z));
    let sin_23 = mul_add::<FUSED>(forearm_x, arm.cos_psi, -(forearm_z * arm.sin_psi));
    let cos_23 = mul_add::<FUSED>(forearm_z, arm.cos_psi, forearm_x * arm.sin_psi);
    let length_23 = r2 * arm.k;
    // The wrist (eq. 14 to 17); M times `length`.
    let length = length_1 * length_23;
    let (down, along) = (length_1 * sin_23, length_1 * cos_23);
    let n0 = combined::<FUSED>(r[0], cos_1, r[1], sin_1);
    let m0 = combined::<FUSED>(n0, cos_23, r[2], -down);
    let n1 = combined::<FUSED>(r[1], cos_1, r[0], -sin_1);
    let m1 = [n1[0] * length_23, n1[1] * length_23, n1[2] * length_23];
    let m22 = mul_add::<FUSED>(n0[2], sin_23, r[2][2] * along);
    let [theta_4, theta_5, theta_6] = zyz_directions::<FUSED>(m0, m1, m22);
    let [sin_5, _] = theta_5;
    let theta_1 = [sin_1, if reached { cos_1 } else { f64::NAN }];
    Branch {
        theta: [theta_1, [upper_x, upper_z], [sin_23, cos_23], theta_4, theta_5, theta_6],
        reached,
        regular: (size >= arm.regular_x)
            & (m2.abs() >= arm.regular_m2)
            & (!reached | (sin_5 >= arm.regular_sin_5 * length)),
    }
}

/// `a p + b s`, element by element.
#[inline(always)]
fn combined<const FUSED: bool>(a: [f64; 3], p: f64, b: [f64; 3], s: f64) -> [f64; 3] {
    [
        mul_add::<FUSED>(a[0], p, b[0] * s),
        mul_add::<FUSED>(a[1], p, b[1] * s),
        mul_add::<FUSED>(a[2], p, b[2] * s),
    ]
}
