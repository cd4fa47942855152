//! The determinant of the Jacobian, which is zero at singularities only.

use nalgebra::{Matrix3, Vector3};

use super::geometry::OffsetWrist;

impl OffsetWrist {
    /// The determinant of the geometric Jacobian of all joints (eq. 66).
    ///
    /// Axes 4 and 5 run through the wrist point, so that joints 1 to 3 alone hold it against joint
    /// 6; what the hand then turns about the normal of axes 4 and 5 remains.
    pub(super) fn determinant(&self, theta: &[f64; 6]) -> f64 {
        let (frames, _) = self.chain.link_frames(theta);
        let axis = |joint: usize| -> Vector3<f64> {
            frames[joint].rotation.matrix().column(2).into_owned()
        };
        let origin = |joint: usize| frames[joint].translation.vector;
        let wrist = origin(3);
        let moves = |joint: usize| axis(joint).cross(&(wrist - origin(joint)));
        let carry = Matrix3::from_columns(&[moves(0), moves(1), moves(2)]);
        let turn = Matrix3::from_columns(&[axis(0), axis(1), axis(2)]);
        // The adjugate, which exists where the carry is singular.
        let [x, y, z] = [carry.column(0), carry.column(1), carry.column(2)];
        let adjugate = Matrix3::from_rows(&[
            y.cross(&z).transpose(),
            z.cross(&x).transpose(),
            x.cross(&y).transpose(),
        ]);
        let normal = axis(3).cross(&axis(4));
        let held = turn * (adjugate * moves(5));
        carry.determinant() * normal.dot(&axis(5)) - normal.dot(&held)
    }
}
