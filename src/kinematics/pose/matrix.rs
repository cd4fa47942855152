//! Conversions between poses and nalgebra's other types for them.

use nalgebra::{Isometry3, Matrix4};

use super::{Pose, checked_pose, pose_from_rows};
use crate::error::Error;

/// The pose of a 4x4 homogeneous matrix; a rotation with rounding errors is repaired.
///
/// # Errors
///
/// [`Error::InvalidPose`] when an element is not finite, the last row is not 0 0 0 1, or the
/// rotation is mirrored or off by more than 1e-5.
pub fn pose_from_matrix(matrix: &Matrix4<f64>) -> Result<Pose, Error> {
    // nalgebra stores columns.
    let mut rows = [0.0; 16];
    rows.copy_from_slice(matrix.transpose().as_slice());
    pose_from_rows(&rows)
}

/// The 4x4 homogeneous matrix of a pose.
#[must_use]
pub fn pose_to_matrix(pose: &Pose) -> Matrix4<f64> {
    pose.to_homogeneous()
}

/// The pose of an isometry, whose rotation is a quaternion.
///
/// # Errors
///
/// [`Error::InvalidPose`] when a number is not finite, or the quaternion is too far from length
/// one.
pub fn pose_from_isometry(isometry: &Isometry3<f64>) -> Result<Pose, Error> {
    checked_pose(&nalgebra::convert(*isometry))
}

/// The isometry of a pose, whose rotation is a quaternion.
#[must_use]
pub fn pose_to_isometry(pose: &Pose) -> Isometry3<f64> {
    nalgebra::convert(*pose)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::pose::{PoseDifference, pose_from_euler_zyx};

    #[test]
    fn matrices_and_isometries_round_trip() {
        let pose = pose_from_euler_zyx([0.4, -0.2, 1.1], [0.3, -1.2, 2.5]).unwrap();
        let apart = |other: &Pose| PoseDifference::between(&pose, other).largest();
        assert_eq!(pose_to_matrix(&pose)[(0, 3)], 0.4);
        assert!(apart(&pose_from_matrix(&pose_to_matrix(&pose)).unwrap()) < 1e-15);
        assert!(apart(&pose_from_isometry(&pose_to_isometry(&pose)).unwrap()) < 1e-15);
        let refused = pose_from_matrix(&pose_to_matrix(&pose).transpose()).unwrap_err();
        assert!(matches!(refused, Error::InvalidPose(_)), "{refused}");
        let stretched = pose_to_matrix(&pose) * Matrix4::new_scaling(1.01);
        assert!(matches!(pose_from_matrix(&stretched).unwrap_err(), Error::InvalidPose(_)));
    }
}
