//! Arms of six joints in general: every solution of any chain, by eliminating five joints from the
//! closure of the loop and searching the sixth.
//!
//! `docs/theory/general.md` has the derivation, with the equation numbers (from 81 on) cited in the
//! code.

mod annihilator;
mod at_roots;
mod back;
mod choice;
mod determinant;
mod equated;
mod geometry;
mod measure;
mod moments;
mod pose_link;
mod solve;
mod split;
#[cfg(test)]
mod tests;

pub(crate) use geometry::General;

use at_roots::AtSplit;
use geometry::RootKind;
use measure::PATTERN;

use super::Structure;
use super::branches::Branches;
use super::by_roots::{RootKernel, SLOTS};
use super::closure::{Accepted, Closure};
use super::end_frames::Frame;
use super::free_choice::FreeChoice;
use super::joint_map::JointMap;
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::Pose;
use crate::kinematics::thresholds::CLOSURE_SINGULAR;
use crate::report::{Pattern, UnknownStructure};

impl General {
    pub(crate) fn closure(&self) -> &Closure {
        &self.closure
    }
}

impl Structure<6, SLOTS> for General {
    const PATTERN: &'static Pattern = &PATTERN;
    /// Arms of this kind may pass from one branch to another without a singularity: no property of
    /// a joint vector names its branch.
    const SLOT_NAMES: Option<&'static [&'static str; SLOTS]> = None;

    type Kernel = RootKernel<AtSplit>;

    fn measure(mdh: &mut Mdh<6>) -> Result<Self, UnknownStructure> {
        Self::of(mdh)
    }

    fn like(&self, mdh: &Mdh<6>) -> Option<Self> {
        Self::measured(mdh, Some(self)).ok()
    }

    fn joint_map(&self) -> &JointMap<6> {
        &self.joint_map
    }

    fn between(mut self, base: &Pose, tool: &Pose, coupling: f64) -> Self {
        self.joint_map.coupling = coupling;
        let map = &self.joint_map;
        let fixed = [base, &map.t_base_shoulder, &map.t_wrist_flange, tool];
        let ends = fixed.iter().map(|pose| pose.translation.vector.norm()).sum();
        Self { closure: self.closure.between(ends), ..self }
    }

    fn kernel(&self) -> Option<RootKernel<AtSplit>> {
        (self.roots == RootKind::Regular).then(|| RootKernel(self.split(0)))
    }

    fn solve(&self, t_first_last: &Pose, _: f64, free: &FreeChoice<6>) -> Branches<6, SLOTS> {
        let mut accepted = Accepted::new();
        let is_certified = self.solutions(&Frame::of(t_first_last), free, &mut accepted);
        self.slots(&mut accepted, is_certified)
    }

    fn singular(&self, q: &[f64; 6]) -> (Option<SingularDistances>, SingularityKind) {
        let least = self.closure.least_singular_value(&self.joint_map.theta(q));
        let is_at_one = least < CLOSURE_SINGULAR;
        (None, if is_at_one { SingularityKind::ELBOW } else { SingularityKind::empty() })
    }

    fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        self.closure.determinant(&self.joint_map.theta(q))
    }

    fn slot(&self, _q: &[f64; 6]) -> Option<Slot> {
        None
    }
}
