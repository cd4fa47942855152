//! Arms with an ortho-parallel basis and a spherical wrist: axis 1 perpendicular to axis 2, axes 2
//! and 3 parallel, axes 4, 5, 6 through one point.
//!
//! `docs/theory/spherical_wrist.md` has the derivation, with the equation numbers cited in the
//! code.

mod arm;
mod branch;
mod geometry;
mod lanes;
mod locked;
mod solve;

pub use geometry::OpwParameters;
pub(crate) use geometry::SphericalWrist;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use branch::Constants;
use geometry::PATTERN;

use super::Structure;
use super::branches::Branches;
use super::family::{Family, Following, about_y, turned_back, y_to_z};
use super::free_choice::FreeChoice;
use super::self_motions::{SelfMotions, SingularWrist};
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::distance_from_half_turns;
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::thresholds::WRIST_MERGE_SIN;
use crate::report::{FreeJoint, Pattern, UnknownStructure};

impl Structure<6, 8> for SphericalWrist {
    const PATTERN: &'static Pattern = &PATTERN;

    const SLOT_NAMES: Option<&'static [&'static str; 8]> = Some(&[
        "facing, wrist center in front of the lower arm, q5 >= 0",
        "facing, wrist center in front of the lower arm, q5 < 0",
        "facing, wrist center behind the lower arm, q5 >= 0",
        "facing, wrist center behind the lower arm, q5 < 0",
        "reaching backwards, wrist center in front of the lower arm, q5 >= 0",
        "reaching backwards, wrist center in front of the lower arm, q5 < 0",
        "reaching backwards, wrist center behind the lower arm, q5 >= 0",
        "reaching backwards, wrist center behind the lower arm, q5 < 0",
    ]);

    type Kernel = Constants;

    fn measure(mdh: &mut Mdh<6>) -> Result<Self, UnknownStructure> {
        geometry::measure(mdh)
    }

    fn joint_map(&self) -> &JointMap<6> {
        &self.joint_map
    }

    fn between(mut self, base: &Pose, tool: &Pose, coupling: f64) -> Self {
        self.joint_map.coupling = coupling;
        let fixed = [base, &self.joint_map.t_base_shoulder, &self.joint_map.t_wrist_flange, tool];
        Self { planar: self.planar.between(fixed), ..self }
    }

    fn kernel(&self) -> Option<Constants> {
        Some(Constants::of(&self.planar))
    }

    #[inline]
    fn solve(&self, t_shoulder_wrist: &Pose, _: f64, free: &FreeChoice<6>) -> Branches<6> {
        self.solve_wrist(t_shoulder_wrist, free)
    }

    /// A solve, which does not know `q`, also merges wrists within the uncertainty of the forearm.
    #[inline]
    fn singular(&self, q: &[f64; 6]) -> (Option<SingularDistances>, SingularityKind) {
        let ([_, _, theta_3, _, theta_5, _], [_, x, wrist]) = (self.theta(q), self.factors(q));
        let distances = SingularDistances {
            wrist: distance_from_half_turns(theta_5),
            elbow: distance_from_half_turns(self.planar.elbow_angle(theta_3)),
            shoulder: x.abs(),
        };
        let mut singularities = SingularityKind::empty();
        singularities.set(SingularityKind::WRIST, wrist.abs() <= WRIST_MERGE_SIN);
        singularities.set(SingularityKind::ELBOW, self.planar.is_straight(theta_3));
        singularities.set(SingularityKind::SHOULDER, x.abs() <= self.planar.shoulder_merge());
        (Some(distances), singularities)
    }

    /// The determinant at the wrist center, which equals that at the tool (eq. 21).
    fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        let [elbow, x, wrist] = self.factors(q);
        let links = self.planar.c2 * self.planar.k;
        -self.joint_map.signs.iter().product::<f64>() * links * elbow * x * wrist
    }

    /// Determined by the signs of eq. 13.
    fn slot(&self, q: &[f64; 6]) -> Option<Slot> {
        let [elbow, x, wrist] = self.factors(q);
        let behind_axis_1 = x < -self.planar.shoulder_merge();
        let behind_lower_arm = elbow < 0.0 && !self.planar.is_straight(self.theta(q)[2]);
        Some(Slot::of_bits([behind_axis_1, behind_lower_arm, wrist < 0.0]))
    }
}

impl SelfMotions<6> for SphericalWrist {
    fn with_family(
        &self,
        t_shoulder_wrist: &Pose,
        [q, rest]: [&[f64; 6]; 2],
        free: FreeJoint,
        search: &mut dyn FnMut(&dyn Family<6>),
    ) {
        let (theta, rotation) = (self.theta(q), *t_shoulder_wrist.rotation.matrix());
        let [theta_1, theta_2, theta_3, ..] = theta;
        let (free, left, right) = match free {
            FreeJoint::Base => (0, about_y(-theta_2 - theta_3), rotation),
            FreeJoint::Upper | FreeJoint::UpperCoupled | FreeJoint::UpperOpposed => {
                let seen = turned_back(theta_1, &rotation);
                (1, about_y(-theta_3) * y_to_z().transpose(), y_to_z() * seen)
            }
            _ => return,
        };
        let (map, rest) = (&self.joint_map, self.theta(rest)[3]);
        search(&Following { map, theta, free, first: 3, left, right, rest, bit: 1 });
    }

    fn sin_5(&self, q: &[f64; 6]) -> Option<f64> {
        Some(self.theta(q)[4].sin())
    }

    fn singular_wrist(&self) -> Option<&dyn SingularWrist<6>> {
        Some(self)
    }
}
