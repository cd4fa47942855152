//! Seven-axis arms with a spherical shoulder and an offset elbow, with the angle of joint 7 given:
//! axes 1, 2, 3 through one point, axes 5 and 6 intersecting, axis 7 anywhere.
//!
//! `docs/theory/spherical_shoulder.md` has the derivation, with the equation numbers cited in the
//! code.

mod branch;
mod elbow;
mod geometry;
mod joint_7;
mod lanes;
mod solve;
mod wrist;

pub(crate) use geometry::SphericalShoulder;
pub(crate) use joint_7::NEARLY_IN_LINE;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use branch::Constants;
use geometry::PATTERN;

use super::Structure;
use super::branches::Branches;
use super::free_choice::FreeChoice;
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::distance_from_half_turns;
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::thresholds::WRIST_MERGE_SIN;
use crate::report::{Pattern, UnknownStructure};

impl Structure<7, 8> for SphericalShoulder {
    const PATTERN: &'static Pattern = &PATTERN;

    const SLOT_NAMES: Option<&'static [&'static str; 8]> = Some(&[
        "theta_2 >= 0, elbow forwards, cos theta_5 >= 0",
        "theta_2 >= 0, elbow forwards, cos theta_5 < 0",
        "theta_2 >= 0, elbow backwards, cos theta_5 >= 0",
        "theta_2 >= 0, elbow backwards, cos theta_5 < 0",
        "theta_2 < 0, elbow forwards, cos theta_5 >= 0",
        "theta_2 < 0, elbow forwards, cos theta_5 < 0",
        "theta_2 < 0, elbow backwards, cos theta_5 >= 0",
        "theta_2 < 0, elbow backwards, cos theta_5 < 0",
    ]);

    type Kernel = Constants;

    fn measure(mdh: &mut Mdh<7>) -> Result<Self, UnknownStructure> {
        geometry::measure(mdh)
    }

    fn joint_map(&self) -> &JointMap<7> {
        &self.joint_map
    }

    fn between(self, base: &Pose, tool: &Pose, _coupling: f64) -> Self {
        let JointMap { t_base_shoulder, t_wrist_flange, .. } = &self.joint_map;
        let fixed = [base, t_base_shoulder, &self.t_seven_hand, t_wrist_flange, tool];
        Self { links: self.links.between(fixed), ..self }
    }

    fn kernel(&self) -> Option<Constants> {
        Some(Constants::of(&self.links, &self.joint_map, &self.t_seven_hand))
    }

    #[inline]
    fn solve(&self, t_shoulder_seven: &Pose, q7: f64, free: &FreeChoice<7>) -> Branches<7> {
        self.solve_hand(&self.hand(t_shoulder_seven, q7), free)
    }

    /// A solve, which does not know `q`, also merges shoulders within the uncertainty of elbow and
    /// wrist.
    #[inline]
    fn singular(&self, q: &[f64; 7]) -> (Option<SingularDistances>, SingularityKind) {
        let [_, theta_2, _, theta_4, theta_5, ..] = self.theta(q);
        let elbow = self.links.elbow_at(theta_4);
        let distances = SingularDistances {
            wrist: self.aside(q).abs().atan2((elbow.across * theta_5.sin()).hypot(elbow.along)),
            elbow: distance_from_half_turns(self.links.elbow_angle(theta_4)),
            shoulder: self.links.c3 * theta_2.sin().abs(),
        };
        let mut singularities = SingularityKind::empty();
        let is_one = self.links.wrist_is_one(&elbow, theta_5);
        singularities.set(SingularityKind::WRIST, is_one);
        singularities.set(SingularityKind::ELBOW, self.links.is_straight(theta_4));
        singularities.set(SingularityKind::SHOULDER, theta_2.sin().abs() <= WRIST_MERGE_SIN);
        (Some(distances), singularities)
    }

    /// Computed by eq. 66.
    fn jacobian_determinant(&self, q: &[f64; 7]) -> f64 {
        let [_, theta_2, _, theta_4, ..] = self.theta(q);
        let signs = self.joint_map.signs[..6].iter().product::<f64>();
        let links = self.links.product() * self.links.elbow_angle(theta_4).sin();
        -signs * links * self.aside(q) * theta_2.sin()
    }

    /// Determined by the signs of eq. 65.
    fn slot(&self, q: &[f64; 7]) -> Option<Slot> {
        let [_, theta_2, _, theta_4, theta_5, ..] = self.theta(q);
        let backwards = self.links.elbow_angle(theta_4).sin() < 0.0;
        Some(Slot::of_bits([theta_2.sin() < 0.0, backwards, theta_5.cos() < 0.0]))
    }
}

#[cfg(test)]
mod tests;
