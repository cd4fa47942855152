//! A rotation about one axis from one orientation to another: slerp, by rotation matrices.

use nalgebra::{Matrix3, Rotation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::{Error, MotionFault};
use crate::kinematics::thresholds::{HALF_TURN_COS, LEAST_ALONG};
use crate::kinematics::{Pose, pose_to_wxyz};

/// R(s) = R0 + sin(s angle) A + (1 - cos(s angle)) B, with A = R0 K, B = R0 K^2 and K the cross
/// product with the axis (Rodrigues' formula, eq. 18).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    start: Matrix3<f64>,
    sin_part: Matrix3<f64>,
    cos_part: Matrix3<f64>,
    axis: Vector3<f64>,
    pub(crate) angle: f64,
}

impl Turn {
    /// The shortest turn; of a half turn that about the `axis` which points more the way that it
    /// is given, seen from the base. `index` is the pose that an error names.
    pub(crate) fn new(
        start: &Rotation3<f64>,
        end: &Rotation3<f64>,
        axis: Option<&Vector3<f64>>,
        index: usize,
    ) -> Result<Self, Error> {
        let relative = start.inverse() * end;
        let (_, [w, x, y, z]) =
            pose_to_wxyz(&Pose::from_parts(nalgebra::Translation3::identity(), relative));
        let (mut w, mut v) = (w, Vector3::new(x, y, z));
        if w < HALF_TURN_COS {
            let angle = 2.0 * v.norm().atan2(w);
            let axis = axis.ok_or(MotionFault::HalfTurn { index, angle })?;
            let along = (start.inverse() * axis).dot(&v) / (axis.norm() * v.norm());
            if along.is_nan() || along.abs() < LEAST_ALONG {
                return Err(MotionFault::Axis { along }.into());
            }
            if along < 0.0 {
                (w, v) = (-w, -v);
            }
        }
        let size = v.norm();
        let unit = if size > 0.0 { v / size } else { Vector3::zeros() };
        Ok(Self::about(start, &unit, 2.0 * size.atan2(w)))
    }

    /// By an angle [rad] about an axis of length 1, as seen from the orientation at the start; of
    /// an angle of 0 it may have no length.
    fn about(start: &Rotation3<f64>, unit: &Vector3<f64>, angle: f64) -> Self {
        let start = *start.matrix();
        let sin_part = start * unit.cross_matrix();
        Self { start, sin_part, cos_part: sin_part * unit.cross_matrix(), axis: *unit, angle }
    }

    /// By a rotation vector [rad], as seen from the orientation at the start.
    pub(super) fn by(start: &Rotation3<f64>, vector: &Vector3<f64>) -> Self {
        let angle = vector.norm();
        let unit = if angle > 0.0 { vector / angle } else { Vector3::zeros() };
        Self::about(start, &unit, angle)
    }

    /// The rotation vector from start to end [rad], the same as seen from either.
    pub(super) fn vector(&self) -> Vector3<f64> {
        self.axis * self.angle
    }

    /// The orientation at a part of the way, 0 to 1.
    pub(crate) fn at(&self, part: f64) -> Rotation3<f64> {
        let (sin, cos) = (part * self.angle).sin_cos();
        // 1 - cos without cancellation.
        let versine = if cos > 0.0 { sin * sin / (1.0 + cos) } else { 1.0 - cos };
        let matrix = self.start + self.sin_part * sin + self.cos_part * versine;
        Rotation3::from_matrix_unchecked(matrix)
    }
}
