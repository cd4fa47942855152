//! Arms with an offset wrist: axes 2 and 3 parallel, axis 4 meets axis 5, axis 6 does not meet
//! them. Such are ABB's GoFa, FANUC's CRX, UFACTORY's xArm6 and Kinova's JACO2.
//!
//! `docs/theory/offset_wrist.md` has the derivation, with the equation numbers (from 121 on) cited
//! in the code.

mod at_roots;
mod branch;
mod counts;
mod determinant;
mod geometry;
mod hand;
mod measure;
mod reach;
mod resultant;
mod solve;
mod step;
#[cfg(test)]
mod tests;

use alloc::boxed::Box;

pub(crate) use geometry::OffsetWrist;

use geometry::Constants;

use super::Structure;
use super::branches::Branches;
use super::by_roots::{RootKernel, SLOTS};
use super::closure::Accepted;
use super::end_frames::Frame;
use super::free_choice::FreeChoice;
use super::joint_map::JointMap;
use super::self_motions::{SelfMotions, TakeStep};
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::pose::Pose;
use crate::report::{Pattern, UnknownStructure};

impl Structure<6, SLOTS> for OffsetWrist {
    const PATTERN: &'static Pattern = &measure::PATTERN;
    const SLOT_NAMES: Option<&'static [&'static str; SLOTS]> = None;

    type Kernel = RootKernel<Constants>;

    fn measure(mdh: &mut Mdh<6>) -> Result<Self, UnknownStructure> {
        measure::measure(mdh)
    }

    fn joint_map(&self) -> &JointMap<6> {
        self.general.joint_map()
    }

    fn between(self, base: &Pose, tool: &Pose, coupling: f64) -> Self {
        let general = Box::new(self.general.between(base, tool, coupling));
        let constants = Constants { closure: *general.closure(), ..self.constants };
        Self { constants, general, ..self }
    }

    fn kernel(&self) -> Option<RootKernel<Constants>> {
        Some(RootKernel(self.constants))
    }

    #[inline]
    fn solve(&self, t_first_last: &Pose, _: f64, free: &FreeChoice<6>) -> Branches<6, SLOTS> {
        let mut accepted = Accepted::new();
        let last = &Frame::of(t_first_last);
        let is_certified = self.solutions(last, free, &mut accepted);
        let mut branches = self.general.slots(&mut accepted, is_certified);
        if accepted.as_slice().is_empty() {
            branches.reach = self.constants.missed(last);
        }
        branches
    }

    /// The determinant has no factors that tell wrist, elbow and shoulder apart.
    fn singular(&self, q: &[f64; 6]) -> (Option<SingularDistances>, SingularityKind) {
        self.general.singular(q)
    }

    /// The determinant (eq. 136).
    fn jacobian_determinant(&self, q: &[f64; 6]) -> f64 {
        self.determinant(&self.joint_map().theta(q))
    }

    /// Such arms change their branch without passing a singularity: no bit of a joint vector names
    /// it.
    fn slot(&self, _q: &[f64; 6]) -> Option<Slot> {
        None
    }
}

impl SelfMotions<6> for OffsetWrist {
    fn member(&self, t: &Pose, q: &[f64; 6], joint: usize, value: f64) -> Option<[f64; 6]> {
        self.general.member(t, q, joint, value)
    }

    fn walk(&self, t: &Pose, q: &[f64; 6], pass: &mut TakeStep<'_, 6>) {
        self.general.walk(t, q, pass);
    }
}
