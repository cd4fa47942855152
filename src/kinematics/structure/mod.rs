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
pub(crate) mod planar_arm;
pub(crate) mod recognition;
pub(crate) mod refined;
pub(crate) mod singular_wrist;
pub(crate) mod solver;
pub(crate) mod spherical_shoulder;
pub(crate) mod spherical_wrist;
pub(crate) mod three_parallel;
pub(crate) mod triangle;
pub(crate) mod trigonometric;
pub(crate) mod zyz;

use core::fmt::Debug;

use branches::Branches;
use family::Family;
use free_choice::FreeChoice;
use joint_map::JointMap;
use lanes::LaneKernel;
use singular_wrist::SingularWrist;

use super::answer::singularity::SingularDistances;
use super::answer::slot::Slot;
use super::answer::status::SingularityKind;
use super::chain::dh::Mdh;
use super::pose::Pose;
use crate::report::{FreeJoint, Pattern, UnknownStructure};

/// Take the ends of a step along a self-motion.
pub(crate) type TakeStep<'a, const N: usize> = dyn FnMut(&[f64; N], &[f64; N]) + 'a;

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
    Clone + Debug + Send + Sync + 'static
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

    // --- For the search of self-motions. ---

    /// sin q5, signed, for a structure whose wrist is singular where it is zero.
    fn sin_5(&self, _q: &[f64; N]) -> Option<f64> {
        None
    }

    /// Search the self-motion of `q`, which reaches `t_first_last`, along a free joint without a
    /// partner, if it is known in closed form; a joint that is undetermined on the way takes its
    /// angle from `rest`.
    fn with_family(
        &self,
        _t_first_last: &Pose,
        [_q, _rest]: [&[f64; N]; 2],
        _free: FreeJoint,
        _search: &mut dyn FnMut(&dyn Family<N>),
    ) {
    }

    /// The member of the self-motion of `q`, which reaches `t_first_last`, with a joint, from 0, at
    /// an angle: of several the nearest; for a [`FreeJoint::Chain`].
    fn member(
        &self,
        _t_first_last: &Pose,
        _q: &[f64; N],
        _joint: usize,
        _value: f64,
    ) -> Option<[f64; N]> {
        None
    }

    /// Walk along the self-motion of `q`, as far as [`Self::member`] does: `pass` gets the ends of
    /// each step.
    fn walk(&self, _t_first_last: &Pose, _q: &[f64; N], _pass: &mut TakeStep<'_, N>) {}

    /// The arm as one with a spherical wrist, if it has one.
    fn singular_wrist(&self) -> Option<&dyn SingularWrist<N>> {
        None
    }
}
