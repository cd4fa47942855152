//! Arms with a spherical wrist: three axes through one point.

use crate::kinematics::pose::Pose;
use crate::report::FreeJoint;

/// The motions of a search near the singularities of an arm with a spherical wrist. The wrist may
/// be undetermined because another singularity leaves the forearm undetermined; neither its own
/// angle nor the solve shows that.
pub(crate) trait SingularWrist<const N: usize> {
    /// sin q5, signed: zero where axes 4 and 6 coincide.
    fn sin_5(&self, q: &[f64; N]) -> f64;

    /// The combination of joints that is fixed where axes 4 and 6 act as one, as they nearly do
    /// near a joint 5 as in `q`.
    fn wrist_pair(&self, q: &[f64; N]) -> FreeJoint;

    /// `q` with joint 5 at its singularity, on one or the other side of it by the least amount that
    /// is still distinguished.
    fn with_straight_wrist(&self, q: &[f64; N], side: f64) -> [f64; N];

    /// `q` with an elbow that is just not straight, behind the lower arm or in front of it.
    fn with_bent_elbow(&self, q: &[f64; N], behind: bool) -> [f64; N];

    /// `q` with the wrist, or the flipped one, that the arm of `q` needs for the rotation of the
    /// last frame.
    fn with_wrist_of(&self, t_first_last: &Pose, q: &[f64; N], flipped: bool) -> [f64; N];
}
