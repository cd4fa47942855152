//! How far a joint vector is from the singularities.

use crate::kinematics::answer::status::SingularityKind;

/// How far a joint vector is from each singularity of an arm with a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SingularDistances {
    /// Angle of joint 5 from 0 or 180 deg [rad]; of a seven-axis arm, that between the plane of
    /// axes 5 and 6 and the line from where they meet to the shoulder.
    pub wrist: f64,
    /// Angle between upper arm and forearm from stretched or folded [rad].
    pub elbow: f64,
    /// Distance of the wrist center from the plane through axis 1 that holds axis 2's direction
    /// [m]; from axis 1 itself where b = 0. Of a seven-axis arm, that of the upper arm's end on
    /// axis 3 from axis 1.
    pub shoulder: f64,
}

/// How far a joint vector is from the singularities of its arm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Singularity {
    /// Distances from the wrist, elbow and shoulder singularity; `None` for an arm whose
    /// singularities have no such names.
    pub distances: Option<SingularDistances>,
    /// The smallest singular value of the Jacobian at the tool, its rows in m and rad as they are.
    pub min_singular_value: f64,
    /// Yoshikawa's manipulability, sqrt(det(J J^T)): the product of the singular values.
    pub manipulability: f64,
    /// The singularities at which the joint vector stands.
    pub kinds: SingularityKind,
}
