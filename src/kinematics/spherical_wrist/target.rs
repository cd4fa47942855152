//! What a solve is asked: where the wrist frame stands, and what to take where it leaves a joint open.

use nalgebra::Matrix3;

use crate::kinematics::free_choice::FreeChoice;

/// What one shoulder's branches are made from.
pub(super) struct Target<'a> {
    pub(super) wxy: [f64; 2],
    pub(super) wz: f64,
    pub(super) rotation: &'a Matrix3<f64>,
    pub(super) free: &'a FreeChoice<6>,
    pub(super) free_theta: [f64; 6],
    /// How far beyond reach the wrist centre may be and still get the stretched or folded arm [m].
    pub(super) tolerance: f64,
}
