//! The self-motions that a structure knows, for searches along them.

use super::end_frames::EndFrames;
use super::family::Family;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::report::FreeJoint;

/// Largest number of angles at which a quartic is zero or stationary.
pub(crate) const MOST_ANGLES: usize = 4 + 3;

/// Largest number of edges: four of the elbow, four zeros and three stationary points for each sign
/// of the wrist.
pub(crate) const EDGES: usize = 4 + 2 * MOST_ANGLES;

/// Largest number of angles at which axes 1 and 3 may be in line, with the upper arm either way.
pub(crate) const SINGULAR_ANGLES: usize = 2 * MOST_ANGLES;

/// Take the ends of a step along a self-motion.
pub(crate) type TakeStep<'a, const N: usize> = dyn FnMut(&[f64; N], &[f64; N]) + 'a;

/// The joint vectors of a pose of the derivation's frames, `t_first_last`, next to one of them.
pub(crate) trait SelfMotions<const N: usize> {
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

    /// Upper bound of the rounding of a pose [m, rad], if the structure knows one.
    fn rounding(&self) -> Option<f64> {
        None
    }

    /// The angles of joint 7 [rad], in (-pi, pi], between which no branch begins or ends, for the
    /// frame of joint 7 before its rotation.
    fn edges_of_joint_7(&self, _t_first_last: &Pose) -> [Option<f64>; EDGES] {
        [None; EDGES]
    }

    /// The angles of joint 7 [rad], in (-pi, pi], at which axis 3 may be in line with axis 1 (eq.
    /// 73c), for the frame of joint 7 before its rotation.
    fn singular_angles_of_joint_7(&self, _t_first_last: &Pose) -> [Option<f64>; SINGULAR_ANGLES] {
        [None; SINGULAR_ANGLES]
    }

    /// The arm as one with a spherical wrist, if it has one.
    fn singular_wrist(&self) -> Option<&dyn SingularWrist<N>> {
        None
    }
}

/// The part of a wrist that is locked.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum LockedWrist {
    Axis4,
    Axes4And5,
    All,
}

/// The motions of an arm with a spherical wrist near its singularities, and with a part of its
/// wrist locked. The wrist may be undetermined because another singularity leaves the forearm
/// undetermined; neither its own angle nor the solve shows that.
pub(crate) trait SingularWrist<const N: usize> {
    /// The combination of joints that is fixed where axes 4 and 6 act as one, as they nearly do
    /// near a joint 5 as in `q`.
    fn wrist_pair(&self, q: &[f64; N]) -> FreeJoint;

    /// `q` with joint 5 at its singularity, on one or the other side of it by the least amount that
    /// is still distinguished.
    fn with_straight_wrist(&self, q: &[f64; N], side: f64) -> [f64; N];

    /// `q` with an elbow that is just not straight, behind the lower arm or in front of it.
    fn with_bent_elbow(&self, q: &[f64; N], behind: bool) -> [f64; N];

    /// The angle of joint 4, nearest to `q`, at which axis 5 is parallel to axes 2 and 3
    /// [rad]: 0 or 180 deg for ABB's arms.
    fn axis_4_in_plane(&self, q: &[f64; N]) -> f64;

    /// The joint vector inside the limits, nearest to `q`, that brings the tool to the point of a
    /// pose, and as near to its rotation as it can, with a part of the wrist locked as in `q`.
    fn with_locked_wrist(
        &self,
        end_frames: &EndFrames,
        limits: &JointLimits<N>,
        pose: &Pose,
        q: &[f64; N],
        locked: LockedWrist,
    ) -> Option<[f64; N]>;
}
