//! Kinematic structures: arms with a closed-form inverse, and any other six joints.
//!
//! A structure is a folder here that implements [`Structure`], and a line in [`known`]. It contains
//! its pattern (the conditions on the axes), the measurement of its geometry from a table, the
//! solve of one pose with every singularity handled, a [`LaneKernel`](lanes::LaneKernel), which
//! solves regular poses in vectors, and the distances from its singularities. Base, tool, limits,
//! turns, flags, batches and the choice among solutions are common to all: [`solver::Solver`] and
//! `solve` implement them once, behind [`inverse::Inverse`].

pub(crate) mod branches;
pub(crate) mod by_roots;
pub(crate) mod closure;
pub(crate) mod continuum;
pub(crate) mod end_frames;
pub(crate) mod family;
pub(crate) mod free_choice;
pub(crate) mod general;
pub(crate) mod inverse;
pub(crate) mod joint_map;
pub(crate) mod known;
pub(crate) mod lanes;
pub(crate) mod locked;
pub(crate) mod offset_wrist;
pub(crate) mod pan_roll;
pub(crate) mod planar_arm;
pub(crate) mod recognition;
pub(crate) mod refined;
pub(crate) mod self_motions;
pub(crate) mod solver;
pub(crate) mod spherical_shoulder;
pub(crate) mod spherical_wrist;
pub(crate) mod three_parallel;
pub(crate) mod triangle;
pub(crate) mod trigonometric;
pub(crate) mod zyz;

use core::fmt::Debug;

use branches::Branches;
use free_choice::FreeChoice;
use joint_map::JointMap;
use lanes::LaneKernel;
use self_motions::SelfMotions;

use super::answer::singularity::SingularDistances;
use super::answer::slot::Slot;
use super::answer::status::SingularityKind;
use super::chain::dh::Mdh;
use super::pose::Pose;
use crate::report::{Pattern, UnknownStructure};

/// A kinematic structure of `N` joints with `S` slots.
///
/// Let `theta` be the derivation's joint angles, `T_first_last` the last frame of the derivation in
/// its first, and `B` and `F` the constant transforms before and after them. An arm between a base
/// and a tool is then
///
/// ```text
/// T_world_tool(q) = T_world_base B T_first_last(theta) F T_flange_tool,
/// theta_i = sign_i q_i - offset_i
/// ```
///
/// [`Solver`](solver::Solver) removes `B`, `F`, base and tool from a pose and converts theta to q;
/// a structure solves `T_first_last(theta)` alone.
pub(crate) trait Structure<const N: usize, const S: usize>:
    SelfMotions<N> + Clone + Debug + Send + Sync + 'static
{
    /// The conditions on the axes, and the name.
    const PATTERN: &'static Pattern;

    /// The name of each slot; `None` if branches have no names and slots are ordinals.
    const SLOT_NAMES: Option<&'static [&'static str; S]>;

    /// Solves regular poses in lanes.
    type Kernel: LaneKernel<N, S> + Send + Sync + 'static;

    /// Measure the geometry of a table that meets the pattern, and remove deviations within
    /// rounding.
    fn measure(mdh: &mut Mdh<N>) -> Result<Self, UnknownStructure>;

    /// Measure a table that differs by a link from this arm's, if that takes less.
    fn like(&self, _mdh: &Mdh<N>) -> Option<Self> {
        None
    }

    /// Signs, offsets, `B` and `F`.
    fn joint_map(&self) -> &JointMap<N>;

    /// Place the arm between a base and a tool, whose lengths add to the rounding of a pose, with
    /// q2 added by a factor to the controller's q3.
    fn between(self, base: &Pose, tool: &Pose, coupling: f64) -> Self;

    /// The kernel of this arm; `None` if most of its poses are not regular.
    fn kernel(&self) -> Option<Self::Kernel>;

    /// Find every branch of `t_first_last`: in its slot, with its singularities; merged ones once.
    /// Limits are not checked. `locked` is the angle of joint 7, of an arm of seven joints [rad].
    fn solve(&self, t_first_last: &Pose, locked: f64, free: &FreeChoice<N>) -> Branches<N, S>;

    /// Distances of `q` from the singularities, or `None` if those have no names; and those that it
    /// is at, by the thresholds that merge the branches of a solve.
    fn singular(&self, q: &[f64; N]) -> (Option<SingularDistances>, SingularityKind);

    /// The determinant of the geometric Jacobian of joints 1 to 6 in closed form: zero at
    /// singularities only.
    fn jacobian_determinant(&self, q: &[f64; N]) -> f64;

    /// The slot of the branch that `q` is on; the one in front if two meet at a singularity. `None`
    /// if slots are ordinals.
    fn slot(&self, q: &[f64; N]) -> Option<Slot>;
}
