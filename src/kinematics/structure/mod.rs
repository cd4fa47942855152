//! Kinematic structures: what an arm is like whose inverse is known.
//!
//! A structure is a folder here that implements [`Structure`], and a variant in [`any`]. It brings
//! its pattern (what it asks of the axes), how its geometry is read off a table, the solve of one
//! pose with every singularity handled, and the distances from its singularities. A
//! [`LaneKernel`](lanes::LaneKernel), which solves regular poses in vectors, is optional. Base,
//! tool, limits, turns, flags, batches and the choice among solutions are the same for all:
//! [`solver::Solver`] and `solve` have them once.

pub(crate) mod any;
pub(crate) mod arity;
pub(crate) mod arm;
pub(crate) mod branches;
mod declare;
pub(crate) mod end_frames;
pub(crate) mod free_choice;
pub(crate) mod joint_map;
pub(crate) mod lanes;
pub(crate) mod open_wrist;
pub(crate) mod planar_arm;
pub(crate) mod recognition;
pub(crate) mod redundancy;
pub(crate) mod solver;
pub(crate) mod spherical_shoulder;
pub(crate) mod spherical_wrist;
pub(crate) mod three_parallel;
pub(crate) mod triangle;
pub(crate) mod zyz;

use core::fmt::Debug;

use branches::Branches;
use free_choice::FreeChoice;
use joint_map::JointMap;
use lanes::LaneKernel;
use open_wrist::OpenWrist;
use redundancy::Redundancy;

use super::answer::singularity::SingularDistances;
use super::answer::slot::Slot;
use super::answer::status::SingularityKind;
use super::chain::dh::Mdh;
use super::pose::Pose;
use crate::report::{FreeJoint, Pattern, UnknownStructure};

/// Why a linkage couples no axes of most structures.
pub(crate) const NO_LINKAGE: &str = "the arm has no spherical wrist";

/// A kinematic structure of `N` joints with `S` slots.
///
/// With `theta` the derivation's joint angles, `T_first_last` the last frame of the derivation seen
/// from its first, and `B` and `F` the constant transforms before and behind them, an arm between a
/// base and a tool is
///
/// ```text
/// T_world_tool(q) = T_world_base B T_first_last(theta) F T_flange_tool,    theta_i = sign_i q_i - offset_i
/// ```
///
/// [`Solver`](solver::Solver) takes `B`, `F`, base and tool off a pose and turns theta into q; a
/// structure solves `T_first_last(theta)` alone.
pub(crate) trait Structure<const N: usize, const S: usize>:
    Clone + Debug + PartialEq
{
    /// What it asks of the axes, and its name.
    const PATTERN: &'static Pattern;

    /// What each slot stands for; `None` where branches have no names and slots are ordinals.
    const SLOT_NAMES: Option<&'static [&'static str; S]>;

    /// What a caller gives with a pose.
    type Redundancy: Redundancy;

    /// Solves regular poses in lanes; [`NoKernel`](lanes::NoKernel) where every pose goes through
    /// [`Self::solve`].
    type Kernel: LaneKernel<N, S, Redundancy = Self::Redundancy>;

    /// Reads the geometry off a table that meets the pattern, and makes exact what is so within
    /// rounding.
    fn measure(mdh: &mut Mdh<N>) -> Result<Self, UnknownStructure>;

    /// Signs, offsets, `B` and `F`.
    fn joint_map(&self) -> &JointMap<N>;

    /// The same arm between a base and a tool, which add to the lengths that a pose's rounding
    /// grows with, with axes 2 and 3 coupled or not.
    fn between(self, base: &Pose, tool: &Pose, coupled: bool) -> Self;

    /// The kernel of this arm; `None` where there is none.
    fn kernel(&self) -> Option<Self::Kernel>;

    /// Every branch of `t_first_last`: in its slot, with its singularities; merged ones once.
    /// Limits are not regarded.
    fn solve(
        &self,
        t_first_last: &Pose,
        redundancy: Self::Redundancy,
        free: &FreeChoice<N>,
    ) -> Branches<N, S>;

    /// How far `q` is from each singularity.
    fn singular_distances(&self, q: &[f64; N]) -> SingularDistances;

    /// The singularities at which `q` stands, by the thresholds that merge the branches of a solve.
    fn kinds(&self, q: &[f64; N]) -> SingularityKind;

    /// The determinant of the geometric Jacobian of joints 1 to 6 in closed form: zero at
    /// singularities alone.
    fn jacobian_determinant(&self, q: &[f64; N]) -> f64;

    /// The slot of the branch that `q` is on; of two that meet at a singularity, the one in front.
    /// `None` where slots are ordinals.
    fn slot(&self, q: &[f64; N]) -> Option<Slot>;

    /// sin q5, signed, of a structure whose wrist is singular where it is zero.
    fn sin_5(&self, _q: &[f64; N]) -> Option<f64> {
        None
    }

    /// The angles of the free joint, along the self-motion of `q`, between which the arm only bends
    /// or only straightens: where it is the most bent and the least of all, and four where it may
    /// come to an edge of reach. `None` where the elbow stands still.
    fn corners(&self, _q: &[f64; N], _free: FreeJoint) -> Option<[f64; 6]> {
        None
    }

    /// The arm as one whose wrist is three axes through a point, if it is.
    fn open_wrist(&self) -> Option<&dyn OpenWrist<N>> {
        None
    }

    /// Whether a parallelogram linkage may couple axes 2 and 3, or why not.
    fn may_be_coupled(&self) -> Result<(), &'static str> {
        Err(NO_LINKAGE)
    }
}

#[cfg(test)]
mod tests;
