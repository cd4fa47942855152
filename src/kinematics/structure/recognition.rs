//! Whether a table has a structure, and the steps to measure its geometry.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::Pose;
use crate::kinematics::thresholds::{FORM_TOLERANCE, LEAST_LINK};
use crate::report::{MOST_CONDITIONS, Pattern, Relation, UnknownStructure};

impl Pattern {
    /// Check that each of the lengths (name and meaning, value [m]) is positive.
    pub(crate) fn check_lengths<const N: usize>(
        &'static self,
        lengths: [(&'static str, f64); N],
    ) -> Result<(), UnknownStructure> {
        match lengths.into_iter().find(|(_, value)| *value < LEAST_LINK) {
            Some(length) => Err(UnknownStructure::too_short(self, length, LEAST_LINK)),
            None => Ok(()),
        }
    }

    /// The table with deviations from the structure within [`FORM_TOLERANCE`] removed: row `i + 1`
    /// holds the angle and the distance between axes `i` and `i + 1`.
    pub(crate) fn square_up<const N: usize>(
        &'static self,
        mdh: &Mdh<N>,
    ) -> Result<Mdh<N>, UnknownStructure> {
        let mut squared = mdh.clone();
        let mut failed = [0.0; MOST_CONDITIONS];
        for ((relation, axes), failed) in self.conditions.iter().zip(&mut failed) {
            let row = &mut squared.rows[axes.0];
            let alpha = row.alpha;
            let (value, exact) = match relation {
                Relation::Parallel => (&mut row.alpha, nearest_of(alpha, 0.0)),
                Relation::Perpendicular => (&mut row.alpha, nearest_of(alpha, FRAC_PI_2)),
                // Between its neighbors' feet on it, the middle axis runs for d of its own row,
                // which is the row before the last axis.
                Relation::Meeting | Relation::Coplanar if axes.1 == axes.0 + 2 => (&mut row.d, 0.0),
                Relation::Meeting | Relation::Coplanar => (&mut row.a, 0.0),
            };
            let off = (*value - exact).abs();
            if off > FORM_TOLERANCE {
                *failed = off;
            } else {
                *value = exact;
            }
        }
        let met = failed.iter().all(|off| *off <= FORM_TOLERANCE);
        if met { Ok(squared) } else { Err(UnknownStructure::off(self, failed)) }
    }
}

/// The angle nearest to `alpha` that is `base` plus half turns.
pub(crate) fn nearest_of(alpha: f64, base: f64) -> f64 {
    base + PI * ((alpha - base) / PI).round()
}

/// The angle of a unit vector from `zero` towards `quarter`.
pub(crate) fn angle(direction: &Vector3<f64>, zero: &Vector3<f64>, quarter: &Vector3<f64>) -> f64 {
    direction.dot(quarter).atan2(direction.dot(zero))
}

pub(crate) fn axes(x: &Vector3<f64>, y: &Vector3<f64>, z: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_columns(&[*x, *y, *z])
}

pub(crate) fn rotation_pose(rotation: Matrix3<f64>) -> Pose {
    IsometryMatrix3::from_parts(
        Translation3::identity(),
        Rotation3::from_matrix_unchecked(rotation),
    )
}

/// The frame of a joint as its axes and its origin.
pub(crate) struct JointFrame {
    pub(crate) x: Vector3<f64>,
    pub(crate) y: Vector3<f64>,
    pub(crate) z: Vector3<f64>,
    pub(crate) origin: Vector3<f64>,
}

impl JointFrame {
    pub(crate) fn of(pose: &Pose) -> Self {
        let axes = pose.rotation.matrix();
        Self {
            x: axes.column(0).into(),
            y: axes.column(1).into(),
            z: axes.column(2).into(),
            origin: pose.translation.vector,
        }
    }
}
