//! Distances of a joint vector from the singularities.

use crate::kinematics::answer::status::SingularityKind;

/// Distances of a joint vector from the singularities of an arm with a closed form, each by its
/// name.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SingularDistances {
    /// Angle of joint 5 from 0 or 180 deg [rad]. For a seven-axis arm: the angle between the plane
    /// of axes 5 and 6 and the line from their intersection to the shoulder.
    pub wrist: f64,
    /// Angle between upper arm and forearm from stretched or folded [rad].
    pub elbow: f64,
    /// Distance of the wrist center from the plane that contains axis 1 and the direction of axis 2
    /// [m]; with b = 0, from axis 1 itself. For a seven-axis arm: the distance of the end of the
    /// upper arm, on axis 3, from axis 1.
    pub shoulder: f64,
}

/// How near a joint vector is to the singularities of its arm.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Singularity {
    /// Distances from the wrist, elbow and shoulder singularity; `None` for an arm whose
    /// singularities have no such names.
    pub distances: Option<SingularDistances>,
    /// Smallest singular value of the Jacobian at the tool, with its rows in m and rad, unscaled.
    pub min_singular_value: f64,
    /// Yoshikawa's manipulability, sqrt(det(J J^T)): the product of the singular values.
    pub manipulability: f64,
    /// The singularities that the joint vector is at: those at which branches merge. Empty beside
    /// them, however near; [`Singularity::near`] has a zone.
    pub kinds: SingularityKind,
}

impl Singularity {
    /// The singularities that the joint vector is at or near: [`Singularity::kinds`], the wrist and
    /// the elbow whose distance is at most `angle` [rad], the shoulder within `length` [m].
    ///
    /// Of an arm whose singularities have no names: [`SingularityKind::ELBOW`] if the least singular
    /// value is at most `angle`. Some motion of the joints by 1 rad then moves the tool by no more
    /// than that, in meters and radians.
    #[must_use]
    pub fn near(&self, angle: f64, length: f64) -> SingularityKind {
        let is_near = self.distances.map_or(
            [false, self.min_singular_value <= angle, false],
            |SingularDistances { wrist, elbow, shoulder }| {
                [wrist <= angle, elbow <= angle, shoulder <= length]
            },
        );
        let mut near = self.kinds;
        for ((kind, _), is_near) in SingularityKind::NAMED.into_iter().zip(is_near) {
            near |= if is_near { kind } else { SingularityKind::empty() };
        }
        near
    }
}
