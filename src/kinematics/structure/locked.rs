//! The inverse of seven joints with one of them locked: the six others are an arm of their own, of
//! whatever structure they have.
//!
//! ```text
//! T_base_6(q1 .. q6) = T_base_7 (Rx(alpha7) Tx(a7) Rz(theta7 + q7) Tz(d7))^-1
//! ```
//!
//! The last joint only moves the pose that the six must reach, and so does the first one: nothing
//! is prepared for another angle of either. Another angle of a joint between them is another chain.

use alloc::sync::Arc;

use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Unit, Vector3};

use super::free_choice::FreeChoice;
use super::inverse::Inverse;
use super::self_motions::{SelfMotions, TakeStep};
use crate::kinematics::answer::singularity::SingularDistances;
use crate::kinematics::answer::slot::Slot;
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::{SingularityKind, Status};
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;

/// All elements but one, of what belongs to seven joints.
pub(crate) fn others<T: Copy, const N: usize>(all: &[T; N], left_out: usize) -> [T; 6] {
    core::array::from_fn(|i| all[if i < left_out { i } else { i + 1 }])
}

/// A locked joint among seven, and the pose that the six others must reach.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LockedJoint {
    /// The joint, from 0.
    joint: usize,
    /// The angle at which the other six joints are prepared [rad].
    at: f64,
    /// Its axis and a point on it: in the world for the first joint, in the frame of the tool for
    /// the last.
    axis: Unit<Vector3<f64>>,
    point: Vector3<f64>,
}

impl LockedJoint {
    /// Joint `joint`, from 0, of a chain whose six others are prepared with it at an angle.
    pub(crate) fn new<const N: usize>(chain: &Chain<N>, joint: usize, at: f64) -> Self {
        let (frames, tool) = chain.link_frames(&[0.0; N]);
        let frame = if joint == 0 { frames[0] } else { tool.inverse() * frames[N - 1] };
        let axis = Unit::new_normalize(frame.rotation * Vector3::z());
        Self { joint, at, axis, point: frame.translation.vector }
    }

    pub(crate) fn joint(&self) -> usize {
        self.joint
    }

    /// The angle at which the other six joints are prepared [rad].
    pub(crate) fn at(&self) -> f64 {
        self.at
    }

    /// Its axis and a point on it: of the first joint in the world, of the last in the tool's frame.
    pub(crate) fn axis(&self) -> (Unit<Vector3<f64>>, Vector3<f64>) {
        (self.axis, self.point)
    }

    /// Whether another angle of a joint, from 0, needs no other chain: the first joint and the
    /// last.
    pub(crate) fn is_end(joint: usize) -> bool {
        matches!(joint, 0 | 6)
    }

    /// The pose that the six joints must reach for the arm to reach `pose` with its joint at an
    /// angle [rad].
    pub(crate) fn seen(&self, pose: &Pose, angle: f64) -> Pose {
        if angle.to_bits() == self.at.to_bits() || !Self::is_end(self.joint) {
            return *pose;
        }
        let back = self.turned(angle, self.at);
        if self.joint == 0 { back * pose } else { pose * back }
    }

    /// The motion of a world or a tool with the joint from one angle to another [rad].
    pub(crate) fn turned(&self, from: f64, to: f64) -> Pose {
        let rotation = Rotation3::from_axis_angle(&self.axis, to - from);
        let shift = Translation3::from(self.point - rotation * self.point);
        IsometryMatrix3::from_parts(shift, rotation)
    }

    /// The joint vector of the arm for one of the other six joints.
    pub(crate) fn joints<const N: usize>(&self, q: &[f64; 6], angle: f64) -> [f64; N] {
        core::array::from_fn(|i| match i.cmp(&self.joint) {
            core::cmp::Ordering::Less => q[i],
            core::cmp::Ordering::Equal => angle,
            core::cmp::Ordering::Greater => q[i - 1],
        })
    }

    /// A solution of the arm for one of the other six joints.
    pub(crate) fn solution<const N: usize>(
        &self,
        six: &Solution<6>,
        angle: f64,
        limits: &JointLimits<N>,
    ) -> Solution<N> {
        let q = self.joints(&six.q, angle);
        let mut status = six.status;
        status.set(Status::WITHIN_LIMITS, limits.contains(&q));
        // The six joints have other numbers, unless the last one is locked.
        let free_joint = six.free_joint.filter(|_| self.joint == 6);
        Solution { q, slot: six.slot, status, free_joint }
    }

    /// Take the answer of the other six joints.
    pub(crate) fn extend<const N: usize>(
        &self,
        six: &Solutions<6>,
        angle: f64,
        solutions: &mut Solutions<N>,
    ) {
        let limits = solutions.limits;
        (solutions.reach, solutions.is_certified) = (six.reach(), six.is_certified());
        for (place, from) in solutions.places_mut().iter_mut().zip(six.places()) {
            *place = match from {
                Place::Empty => Place::Empty,
                Place::Merged(flags) => Place::Merged(*flags),
                Place::Found(six) => Place::Found(self.solution(six, angle, &limits)),
            };
        }
    }
}

/// The inverse of an arm with a locked joint.
#[derive(Clone, Debug)]
pub(crate) struct Locked {
    six: Arc<dyn Inverse<6>>,
    /// The other six joints.
    chain: Chain<6>,
    joint: LockedJoint,
    limits: JointLimits<6>,
}

impl Locked {
    /// The inverse of one joint more, of an arm of six that has their base, tool and limits.
    pub(crate) fn of<const N: usize>(
        six: Arc<dyn Inverse<6>>,
        chain: Chain<6>,
        locked: LockedJoint,
        limits: JointLimits<6>,
    ) -> Arc<dyn Inverse<N>> {
        Arc::new(Self { six, chain, joint: locked, limits })
    }

    fn others<const N: usize>(&self, q: &[f64; N]) -> [f64; 6] {
        others(q, self.joint.joint)
    }

    /// An answer of the six joints without solutions.
    fn unsolved(&self, pose: &Pose, angle: f64) -> Solutions<6> {
        Solutions::none(self.six.slot_count(), self.joint.seen(pose, angle), self.limits)
    }
}

impl<const N: usize> Inverse<N> for Locked {
    /// The six joints may have a structure, the seven have none.
    fn name(&self) -> &'static str {
        if self.joint.joint == 6 { "general" } else { self.six.name() }
    }

    fn slot_count(&self) -> usize {
        self.six.slot_count()
    }

    fn slot_names(&self) -> Option<&'static [&'static str]> {
        self.six.slot_names()
    }

    fn between(&self, chain: &Chain<N>, limits: &JointLimits<N>) -> Arc<dyn Inverse<N>> {
        let six_chain = self.chain.clone().with_base(*chain.base()).with_tool(*chain.tool());
        let limits = limits.without(self.joint.joint);
        let six = self.six.between(&six_chain, &limits);
        let locked = LockedJoint::new(chain, self.joint.joint, self.joint.at);
        Arc::new(Self { six, chain: six_chain, joint: locked, limits })
    }

    fn solve_in_lanes(&self, solutions: &mut Solutions<N>, locked: f64) -> bool {
        let mut six = self.unsolved(&solutions.pose, locked);
        let is_regular = self.six.solve_in_lanes(&mut six, f64::NAN);
        if is_regular {
            self.joint.extend(&six, locked, solutions);
        }
        is_regular
    }

    fn solve_on_path(&self, _: &mut Solutions<N>, _: f64) -> bool {
        false
    }

    fn solve(&self, solutions: &mut Solutions<N>, locked: f64, free: &FreeChoice<N>) {
        let mut six = self.unsolved(&solutions.pose, locked);
        let free = FreeChoice { q: self.others(&free.q), policy: free.policy };
        self.six.solve(&mut six, f64::NAN, &free);
        self.joint.extend(&six, locked, solutions);
    }

    fn singular(&self, q: &[f64; N]) -> (Option<SingularDistances>, SingularityKind) {
        self.six.singular(&self.others(q))
    }

    fn jacobian_determinant(&self, q: &[f64; N]) -> Option<f64> {
        self.six.jacobian_determinant(&self.others(q))
    }

    fn slot(&self, q: &[f64; N]) -> Option<Slot> {
        self.six.slot(&self.others(q))
    }

    #[cfg(test)]
    fn without_lanes(&self) -> Arc<dyn Inverse<N>> {
        Arc::new(Self { six: self.six.without_lanes(), ..self.clone() })
    }

    fn self_motions(&self) -> Option<&dyn SelfMotions<N>> {
        self.six.self_motions().map(|_| self as _)
    }
}

/// The self-motions of the other six joints.
impl<const N: usize> SelfMotions<N> for Locked {
    fn member(&self, pose: &Pose, q: &[f64; N], joint: usize, value: f64) -> Option<[f64; N]> {
        let angle = q[self.joint.joint];
        let pose = self.six.wrist_pose(&self.joint.seen(pose, angle));
        let six = self.six.self_motions()?.member(&pose, &self.others(q), joint, value)?;
        Some(self.joint.joints(&six, angle))
    }

    fn walk(&self, pose: &Pose, q: &[f64; N], pass: &mut TakeStep<'_, N>) {
        let Some(motions) = self.six.self_motions() else { return };
        let angle = q[self.joint.joint];
        let seven = |six: &[f64; 6]| self.joint.joints(six, angle);
        let pass = &mut |start: &[f64; 6], end: &[f64; 6]| pass(&seven(start), &seven(end));
        let pose = self.six.wrist_pose(&self.joint.seen(pose, angle));
        motions.walk(&pose, &self.others(q), pass);
    }
}
