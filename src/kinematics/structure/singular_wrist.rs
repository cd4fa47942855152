//! Arms with a spherical wrist: three axes through one point.

use crate::report::FreeJoint;

/// The motions of a search near the singularities of an arm with a spherical wrist. The wrist may
/// be undetermined because another singularity leaves the forearm undetermined; neither its own
/// angle nor the solve shows that.
pub(crate) trait SingularWrist<const N: usize> {
    /// The combination of joints that is fixed where axes 4 and 6 act as one, as they nearly do
    /// near a joint 5 as in `q`.
    fn wrist_pair(&self, q: &[f64; N]) -> FreeJoint;

    /// `q` with joint 5 at its singularity, on one or the other side of it by the least amount that
    /// is still distinguished.
    fn with_straight_wrist(&self, q: &[f64; N], side: f64) -> [f64; N];
}
