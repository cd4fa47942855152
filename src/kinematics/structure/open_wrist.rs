//! Arms whose wrist is three axes through a point.

use crate::kinematics::pose::Pose;
use crate::report::FreeJoint;

/// What a search next to the singularities of an arm with a spherical wrist moves. A wrist may be
/// open because another singularity leaves the forearm open, and then neither its own angle nor the
/// solve tells of it.
pub(crate) trait OpenWrist<const N: usize> {
    /// sin q5, signed: zero where axes 4 and 6 are one.
    fn sin_5(&self, q: &[f64; N]) -> f64;

    /// What stays fixed where axes 4 and 6 act as one, as they nearly do next to a joint 5 like
    /// that of `q`.
    fn wrist_pair(&self, q: &[f64; N]) -> FreeJoint;

    /// `q` with joint 5 at its singularity, to one or the other side of it by the least that is
    /// seen of it.
    fn with_straight_wrist(&self, q: &[f64; N], side: f64) -> [f64; N];

    /// `q` with an elbow that is just not straight any more, behind the lower arm or in front of
    /// it.
    fn with_bent_elbow(&self, q: &[f64; N], behind: bool) -> [f64; N];

    /// `q` with the wrist, or the flipped one, that the arm of `q` needs for the rotation of the
    /// last frame.
    fn with_wrist_of(&self, t_first_last: &Pose, q: &[f64; N], flipped: bool) -> [f64; N];
}
