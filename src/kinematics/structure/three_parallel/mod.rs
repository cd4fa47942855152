//! Arms with three parallel axes, as Universal Robots makes them: axis 1 perpendicular to the
//! parallel axes 2, 3 and 4, axis 5 perpendicular to them and axis 6 perpendicular to axis 5.
//!
//! `docs/theory/three_parallel.md` has the derivation, with the equation numbers (from 31 on) cited
//! in the code.

mod branch;
mod family;
mod geometry;
mod lanes;
mod reaching;
mod solve;
mod wrist;

pub(crate) use geometry::ThreeParallel;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use branch::Constants;
use family::FourParallel;
use geometry::PATTERN;

use super::Structure;
use super::branches::Branches;
use super::family::Family;
use super::free_choice::FreeChoice;
use super::self_motions::SelfMotions;
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::distance_from_half_turns;
use crate::kinematics::structure::joint_map::JointMap;
use crate::kinematics::structure::planar_arm::PlanarArm;
use crate::kinematics::thresholds::WRIST_MERGE_SIN;
use crate::report::{FreeJoint, Pattern, UnknownStructure};

impl Structure<6, 8> for ThreeParallel {
    const PATTERN: &'static Pattern = &PATTERN;

    const SLOT_NAMES: Option<&'static [&'static str; 8]> = Some(&[
        "wrist in front of axis 1, q3 forwards, q5 >= 0",
        "wrist in front of axis 1, q3 forwards, q5 < 0",
        "wrist in front of axis 1, q3 backwards, q5 >= 0",
        "wrist in front of axis 1, q3 backwards, q5 < 0",
        "wrist behind axis 1, q3 forwards, q5 >= 0",
        "wrist behind axis 1, q3 forwards, q5 < 0",
        "wrist behind axis 1, q3 backwards, q5 >= 0",
        "wrist behind axis 1, q3 backwards, q5 < 0",
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
        let planar = self.planar.between(fixed);
        Self { planar: PlanarArm { extent: planar.extent + self.d5, ..planar }, ..self }
    }

    fn kernel(&self) -> Option<Constants> {
        Some(Constants::of(self))
    }

    #[inline]
    fn solve(&self, t_shoulder_wrist: &Pose, _: f64, free: &FreeChoice<6>) -> Branches<6> {
        self.solve_wrist(t_shoulder_wrist, free)
    }

    /// A solve, which does not know `q`, also merges wrists within the uncertainty of axis 1.
    #[inline]
    fn singular(&self, q: &[f64; 6]) -> (Option<SingularDistances>, SingularityKind) {
        let ([_, _, theta_3, _, theta_5, _], x) = (self.joint_map.theta(q), self.x_of_wrist(q));
        let distances = SingularDistances {
            wrist: distance_from_half_turns(theta_5),
            elbow: distance_from_half_turns(self.planar.elbow_angle(theta_3)),
            shoulder: x.abs(),
        };
        let mut singularities = SingularityKind::empty();
        singularities.set(SingularityKind::WRIST, theta_5.sin().abs() <= WRIST_MERGE_SIN);
        singularities.set(SingularityKind::ELBOW, self.planar.is_straight(theta_3));
        singularities.set(SingularityKind::SHOULDER, x.abs() <= self.planar.shoulder_merge());
        (Some(distances), singularities)
    }

    /// The determinant at the wrist, which equals that at the tool (eq. 41).
    fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        let [_, _, theta_3, _, theta_5, _] = self.joint_map.theta(q);
        let links = self.planar.c2 * self.planar.k * self.planar.sin_elbow(theta_3);
        let signs = self.joint_map.signs.iter().product::<f64>();
        -signs * links * self.x_of_wrist(q) * theta_5.sin()
    }

    /// Determined by the signs that the solve assigns to a slot: of x (eq. 32), of theta_3 and of
    /// sin theta_5.
    fn slot(&self, q: &[f64; 6]) -> Option<Slot> {
        let [_, _, theta_3, _, theta_5, _] = self.joint_map.theta(q);
        let (_, met) = self.singular(q);
        let behind = self.x_of_wrist(q) < 0.0 && !met.contains(SingularityKind::SHOULDER);
        let backwards =
            self.planar.sin_elbow(theta_3) < 0.0 && !met.contains(SingularityKind::ELBOW);
        Some(Slot::of_bits([behind, backwards, theta_5.sin() < 0.0]))
    }
}

impl SelfMotions<6> for ThreeParallel {
    fn sin_5(&self, q: &[f64; 6]) -> Option<f64> {
        Some(self.joint_map.theta(q)[4].sin())
    }

    fn with_family(
        &self,
        t_shoulder_wrist: &Pose,
        [q, rest]: [&[f64; 6]; 2],
        free: FreeJoint,
        search: &mut dyn FnMut(&dyn Family<6>),
    ) {
        if free == FreeJoint::Parallel {
            let rest = FreeChoice::seed(*rest);
            search(&FourParallel::of(self, t_shoulder_wrist, *q, &rest));
        }
    }
}
