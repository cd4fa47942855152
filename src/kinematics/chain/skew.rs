//! Two nearly parallel axes, skew in both directions: as a table has them, with a common normal
//! that may be far away, and with Hayati's rotation instead (docs/theory/calibrate.md, eq. 7 to 9,
//! 20 to 22).

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::chain::dh::DhRow;
use crate::kinematics::pose::angles::sign_of;
use crate::kinematics::thresholds::FARTHEST_NORMAL;

/// The factors of `Rx(alpha) Tx(a) Ry(beta)` as a table has them (eq. 7):
/// `Rz(before.0) Tz(before.1) Rx(alpha) Tx(a) Rz(behind.0) Tz(behind.1)`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Unskewed {
    /// Turn [rad] and shift [m] about and along the axis before.
    pub(super) before: (f64, f64),
    pub(super) alpha: f64,
    pub(super) a: f64,
    /// Turn [rad] and shift [m] about and along the axis behind.
    pub(super) behind: (f64, f64),
}

impl Unskewed {
    /// `None` if there is nothing to remove, or if the axes are so nearly parallel that their
    /// common normal is farther than [`FARTHEST_NORMAL`] away: then they are taken as they are
    /// without beta.
    pub(super) fn new(alpha: f64, a: f64, beta: f64) -> Option<Self> {
        let (sin_alpha, cos_alpha) = alpha.sin_cos();
        let (sin_beta, cos_beta) = beta.sin_cos();
        let sin = sin_beta.hypot(sin_alpha * cos_beta);
        let cos = cos_alpha * cos_beta;
        // (8): from the origin behind to the foot of the common normal.
        let foot = a * sin_beta / (sin * sin);
        let is_near = foot.abs() <= FARTHEST_NORMAL;
        if sin_beta == 0.0 || !is_near {
            return None;
        }
        // (9): the unit common normal (x, y, 0), less than a right angle from the row's x.
        let sign = sign_of(sin_alpha * cos_beta);
        let (x, y) = (sign * sin_alpha * cos_beta / sin, sign * sin_beta / sin);
        let turn = (-y * cos_alpha).atan2(x * cos_beta + y * sin_alpha * sin_beta);
        Some(Self {
            before: (y.atan2(x), -foot * cos),
            alpha: (sign * sin).atan2(cos),
            a: a * x,
            behind: (turn, foot),
        })
    }
}

/// |sin alpha| below which axes may be nearly parallel [1].
const PARALLEL_SIN: f64 = 0.1;

/// Distance of a common normal, as a part of all lengths along x, from which it is far [1].
const FAR: f64 = 10.0;

/// A row with Hayati's rotation: `Rx(alpha) Tx(a) Ry(beta) Rz(theta + q) Tz(d)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TiltedRow {
    pub(crate) row: DhRow,
    /// Rotation about y [rad].
    pub(crate) beta: f64,
}

impl From<DhRow> for TiltedRow {
    fn from(row: DhRow) -> Self {
        Self { row, beta: 0.0 }
    }
}

/// The rows of a table without common normals that are far away: of nearly parallel axes, the
/// second is met in the plane across the first. Offsets that cancel would cost the arm its digits.
pub(in crate::kinematics) fn tilted_rows<const N: usize>(rows: &[DhRow; N]) -> [TiltedRow; N] {
    let far = FAR * rows.iter().map(|row| row.a.abs()).sum::<f64>();
    let mut tilted = rows.map(TiltedRow::from);
    for i in 1..N {
        let before = tilted[i - 1].row.d;
        let (sin, cos) = tilted[i].row.alpha.sin_cos();
        if sin == 0.0 || sin.abs() > PARALLEL_SIN || before.abs() <= far {
            continue;
        }
        let DhRow { a, d, theta, .. } = tilted[i].row;
        // (20): where axis i crosses the plane across axis i - 1, at (a, across, 0).
        let across = before * sin / cos;
        let turn = across.atan2(a);
        let (sin_turn, cos_turn) = turn.sin_cos();
        // (21): the direction of axis i, seen along the way there.
        let alpha = (sin * cos_turn).atan2(cos);
        let sin_beta = -sin * sin_turn;
        let cos_beta = cos.hypot(sin * cos_turn);
        let (sin_alpha, cos_alpha) = alpha.sin_cos();
        // (22): from the new x to the old one.
        let back =
            (-sin_turn * cos_alpha).atan2(cos_turn * cos_beta - sin_turn * sin_alpha * sin_beta);
        tilted[i - 1].row.theta += turn;
        tilted[i - 1].row.d = 0.0;
        tilted[i] = TiltedRow {
            row: DhRow::new(alpha, a.hypot(across), d + before / cos, theta + back),
            beta: sin_beta.atan2(cos_beta),
        };
    }
    tilted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::chain::corrections::{Corrections, about_y, about_z};
    use crate::kinematics::chain::dh::{Mdh, screw_x};
    use crate::kinematics::pose::{Pose, translation_z};
    use crate::rng::Rng;

    fn product(rows: &[TiltedRow; 6], q: &[f64; 6]) -> Pose {
        rows.iter().zip(q).fold(Pose::identity(), |frame, (TiltedRow { row, beta }, q)| {
            let link = screw_x(row.alpha, row.a) * about_y(*beta) * about_z(row.theta + q);
            frame * link * translation_z(row.d)
        })
    }

    #[test]
    fn rows_without_far_normals_are_the_same_arm() {
        let mut rng = Rng::new(3);
        for skew in [1e-5, 1e-4, 1e-3, 1e-2] {
            for _ in 0..50 {
                let mut rows = [DhRow::default(); 6];
                for (row, alpha) in rows.iter_mut().zip([0.0, -1.6, 0.0, 0.0, 1.6, -1.6]) {
                    let [a, d, theta] = [0.7, 0.5, 3.0].map(|size| rng.between(-size, size));
                    *row = DhRow::new(alpha, a, d, theta);
                }
                let mut corrections = Corrections::<6>::NONE;
                for value in corrections.rows.as_flattened_mut() {
                    *value = rng.between(-skew, skew);
                }
                // The first row's is next to the base, which has no row.
                corrections.rows[0] = [0.0; 5];
                let (base, flange) = (Pose::identity(), Pose::identity());
                let table = corrections.table(&Mdh { base, rows, flange }).rows;
                let farthest = table.iter().fold(1.0, |most: f64, row| most.max(row.d.abs()));
                let tilted = tilted_rows(&table);
                let longest = tilted.iter().fold(0.0, |most: f64, row| most.max(row.row.d.abs()));
                assert!(longest <= FAR * 4.2, "{longest} of {farthest}");
                for _ in 0..5 {
                    let q = core::array::from_fn(|_| rng.between(-3.0, 3.0));
                    let plain = table.map(TiltedRow::from);
                    let off = product(&tilted, &q).to_homogeneous()
                        - product(&plain, &q).to_homogeneous();
                    assert!(off.amax() < 40.0 * farthest * f64::EPSILON, "{off} {farthest}");
                }
            }
        }
    }

    #[test]
    fn rows_without_nearly_parallel_axes_are_kept() {
        let rows = [0.0, -1.6, 0.0, 1e-3, 1.6, -1.6].map(|alpha| DhRow::new(alpha, 0.3, 0.4, 0.5));
        assert_eq!(tilted_rows(&rows), rows.map(TiltedRow::from));
    }
}
