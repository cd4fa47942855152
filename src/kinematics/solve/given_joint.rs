//! Seven-axis arms with the angle of any one joint given: the six others are a robot of their own.

use alloc::format;
use alloc::sync::Arc;

use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Unit, Vector3};

use crate::error::{Error, JointFault, ModelFault};
use crate::kinematics::answer::check::{check_angle, check_seed, check_weights};
use crate::kinematics::answer::solutions::{Place, Solution, Solutions};
use crate::kinematics::answer::status::Status;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::joint_axes::JointAxis;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::solve::seeded::Inverse;
#[cfg(feature = "python")]
use crate::report::Explanation;

/// A seven-axis arm of which the angle of one joint is given.
///
/// The other six joints are a chain of their own, prepared once. For another angle of the first or
/// of the last joint it stays the same chain, and only the pose that it must reach turns; another
/// angle of a joint between them makes another chain, so keep this for as many poses as have it, and
/// take [`Self::at`] for another angle.
///
/// ```
/// use irbkin::Robot;
///
/// let robot = Robot::<7>::named("Panda")?;
/// let q = [0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6];
/// let given = robot.given(7, 0.6)?;
/// let solutions = given.ik(&robot.fk(&q))?;
/// assert!(solutions.iter().any(|found| (found.q[1] + 0.7).abs() < 1e-9));
/// # Ok::<(), irbkin::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct GivenJoint {
    robot: Robot<7>,
    /// The joint, from 0.
    joint: usize,
    angle: f64,
    /// The other joints, with a base or tool that the first or the last joint turns.
    six: Robot<6>,
    /// The chain that is solved, the same for every angle of the first and of the last joint, so
    /// that its slots are; and the angle that it was prepared with.
    solved: Robot<6>,
    solved_at: f64,
    /// Of a joint between them, the chain with it at [`LIKE`].
    like: Option<Arc<Robot<6>>>,
}

/// Angle of a joint between the first and the last, in no particular position, by whose chain those
/// at other angles are prepared [rad]: an angle has one chain, whichever was asked for before.
const LIKE: f64 = 0.8;

impl Robot<7> {
    /// The arm with joint `joint`, from 1, at `angle` [rad].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] for a joint that is not 1 to 7, or an angle that is not finite;
    /// [`Error::InvalidModel`] if the other six joints do not move the tool in six independent
    /// ways.
    pub fn given(&self, joint: usize, angle: f64) -> Result<GivenJoint, Error> {
        if !(1..=7).contains(&joint) {
            return Err(JointFault::NoJoint { joint, dof: 7 }.into());
        }
        check_angle("given", joint, angle)?;
        let joint = joint - 1;
        let like = (!is_end(joint)).then(|| self.without(joint, LIKE, None));
        let like = like.and_then(Result::ok).map(Arc::new);
        let solved_at = if is_end(joint) { 0.0 } else { angle };
        let solved = self.without(joint, solved_at, like.as_deref())?;
        let (robot, six) = (self.clone(), solved.clone());
        let prepared = GivenJoint { robot, joint, angle: solved_at, six, solved, solved_at, like };
        if is_end(joint) { prepared.at(angle) } else { Ok(prepared) }
    }

    /// The robot of the other six joints with joint `joint`, from 0, locked at an angle [rad],
    /// prepared by that at another angle.
    fn without(
        &self,
        joint: usize,
        angle: f64,
        like: Option<&Robot<6>>,
    ) -> Result<Robot<6>, Error> {
        let mut q = [0.0; 7];
        q[joint] = angle;
        let bare = self.clone().with_base(&Pose::identity())?.with_tool(&Pose::identity())?;
        let (frames, tip) = bare.link_frames(&q);
        let axes = others(&frames, joint).map(|frame| JointAxis {
            direction: (frame.rotation * Vector3::z()).into(),
            point: frame.translation.vector.into(),
        });
        let mdh = Mdh::from_joint_axes(&axes, &tip)
            .map_err(|error| with_names_of_seven(error, joint, angle))?;
        let six = match like {
            Some(like) => Robot::from_mdh_like(mdh, like),
            None => Robot::from_mdh(mdh),
        }?
        .with_name(format!("{}, J{} locked", self.name(), joint + 1))
        .with_limits(JointLimits::stored(others(&self.limits().to_array(), joint))?)
        .with_max_velocity(self.max_velocity().map(|velocity| others(velocity, joint)))?;
        six.with_base(self.base())?.with_tool(self.tool())
    }
}

/// An error about two axes, with their numbers in the arm and the joint that leaves them so.
fn with_names_of_seven(error: Error, joint: usize, angle: f64) -> Error {
    let Error::InvalidModel(ModelFault::NearlyParallel { axes, off, distance, bound, .. }) = error
    else {
        return error;
    };
    let number = |axis: usize| if axis <= joint { axis } else { axis + 1 };
    ModelFault::LeftNearlyParallel {
        joint: joint + 1,
        angle,
        axes: (number(axes.0), number(axes.1)),
        off,
        // The distance goes with the inverse of the angle.
        bound: off * distance / bound,
    }
    .into()
}

/// All elements but one.
fn others<T: Copy>(all: &[T; 7], left_out: usize) -> [T; 6] {
    core::array::from_fn(|i| all[if i < left_out { i } else { i + 1 }])
}

/// Whether a joint, from 0, is the first or the last.
fn is_end(joint: usize) -> bool {
    matches!(joint, 0 | 6)
}

impl GivenJoint {
    /// The arm.
    #[must_use]
    pub fn robot(&self) -> &Robot<7> {
        &self.robot
    }

    /// The joint whose angle is given, from 1.
    #[must_use]
    pub fn joint(&self) -> usize {
        self.joint + 1
    }

    /// Its angle [rad].
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// The other six joints as a robot, with the arm's base, tool, limits and velocities.
    ///
    /// Its joints are numbered 1 to 6, in its answers and its messages. Of the first and the last
    /// joint at another angle than zero this prepares a chain.
    ///
    /// # Errors
    ///
    /// As [`Robot::given`].
    pub fn six_joints(&self) -> Result<Robot<6>, Error> {
        if self.angle.to_bits() == self.solved_at.to_bits() {
            return Ok(self.solved.clone());
        }
        self.robot.without(self.joint, self.angle, None)
    }

    /// The other six joints as a robot, whose base or tool the first or the last joint turns.
    pub(crate) fn six(&self) -> &Robot<6> {
        &self.six
    }

    /// The joint vector of the arm for one of its other six joints.
    #[must_use]
    pub fn joints(&self, q: &[f64; 6]) -> [f64; 7] {
        self.joints_at(q, self.angle)
    }

    /// What belongs to the other six joints, of what belongs to the seven of the arm.
    #[must_use]
    pub fn others<T: Copy>(&self, all: &[T; 7]) -> [T; 6] {
        others(all, self.joint)
    }

    fn joints_at(&self, q: &[f64; 6], angle: f64) -> [f64; 7] {
        core::array::from_fn(|i| match i.cmp(&self.joint) {
            core::cmp::Ordering::Less => q[i],
            core::cmp::Ordering::Equal => angle,
            core::cmp::Ordering::Greater => q[i - 1],
        })
    }

    /// Whether another angle of the joint needs no other chain: the first joint and the last.
    #[must_use]
    pub fn is_at_end(&self) -> bool {
        is_end(self.joint)
    }

    /// The same with another angle [rad]. This costs a solve nothing for the first and the last
    /// joint, and prepares another chain for those between, in a fraction of the time that the first
    /// takes.
    ///
    /// # Errors
    ///
    /// As [`Robot::given`].
    pub fn at(&self, angle: f64) -> Result<Self, Error> {
        check_angle("given", self.joint(), angle)?;
        if !self.is_at_end() {
            let six = self.robot.without(self.joint, angle, self.like.as_deref())?;
            return Ok(Self { angle, solved: six.clone(), six, solved_at: angle, ..self.clone() });
        }
        let (by, six) = (self.turned_by(angle), self.solved.clone());
        let six = if self.joint == 0 {
            six.with_base(&(by * self.solved.base()))?
        } else {
            six.with_tool(&(self.solved.tool() * by))?
        };
        Ok(Self { angle, six, ..self.clone() })
    }

    /// How far the joint turns what is behind it, from its angle in the solved chain to another:
    /// about its axis in the world for the first joint, in the frame of the tool for the last.
    fn turned_by(&self, angle: f64) -> Pose {
        let (frames, tool) = self.robot.link_frames(&[0.0; 7]);
        let axis = if self.joint == 0 { frames[0] } else { tool.inverse() * frames[6] };
        let direction = Unit::new_normalize(axis.rotation * Vector3::z());
        let rotation = Rotation3::from_axis_angle(&direction, angle - self.solved_at);
        let point = axis.translation.vector;
        IsometryMatrix3::from_parts(Translation3::from(point - rotation * point), rotation)
    }

    /// The pose that the solved chain must reach for the arm to reach `pose` with its joint at an
    /// angle.
    fn seen(&self, pose: &Pose, angle: f64) -> Pose {
        if angle.to_bits() == self.solved_at.to_bits() {
            return *pose;
        }
        let back = self.turned_by(angle).inverse();
        if self.joint == 0 { back * pose } else { pose * back }
    }

    /// Every joint vector that brings the tool to `pose`, seven angles each. Limits are not
    /// regarded, flags say which are inside; if the given angle is outside, none is.
    ///
    /// A joint that a singular pose leaves free is reported by the answers of
    /// [`Self::six_joints`].
    ///
    /// # Errors
    ///
    /// As [`Robot::ik`](Robot::<6>::ik).
    pub fn ik(&self, pose: &Pose) -> Result<Solutions<7>, Error> {
        self.ik_checked(&checked_pose(pose)?, self.angle)
    }

    /// [`Self::ik`] of a pose that is checked, with the first or the last joint at any angle.
    pub(crate) fn ik_checked(&self, pose: &Pose, angle: f64) -> Result<Solutions<7>, Error> {
        let found = self.solved.ik_checked(self.seen(pose, angle), ())?;
        let mut solutions = self.unsolved(pose);
        (solutions.reach, solutions.is_certified) = (found.reach(), found.is_certified());
        for (place, from) in solutions.places_mut().iter_mut().zip(found.places()) {
            *place = match from {
                Place::Empty => Place::Empty,
                Place::Merged(flags) => Place::Merged(*flags),
                Place::Found(solution) => Place::Found(self.extended(solution, angle)),
            };
        }
        Ok(solutions)
    }

    /// An answer of a pose without solutions.
    pub(crate) fn unsolved(&self, pose: &Pose) -> Solutions<7> {
        Solutions::none(self.six.slot_count(), *pose, *self.robot.limits())
    }

    fn extended(&self, solution: &Solution<6>, angle: f64) -> Solution<7> {
        let q = self.joints_at(&solution.q, angle);
        let mut status = solution.status;
        status.set(Status::WITHIN_LIMITS, self.robot.limits().contains(&q));
        Solution { q, slot: solution.slot, status, free_joint: None }
    }

    /// The solution inside the limits that is nearest to `seed` [rad], whose given joint does not
    /// count.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`].
    pub fn ik_nearest(
        &self,
        pose: &Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Solution<7>, Error> {
        check_seed("seed", seed)?;
        check_weights(weights)?;
        self.nearest_checked(&checked_pose(pose)?, seed, weights)
    }

    /// [`Self::ik_nearest`] with arguments that are checked.
    pub(crate) fn nearest_checked(
        &self,
        pose: &Pose,
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Solution<7>, Error> {
        if self.robot.limits().excess(self.joint, self.angle) > 0.0 {
            return Err(self.unreachable(pose)?);
        }
        let [seed, weights] = [seed, weights].map(|all| self.others(all));
        let found = self.six.nearest_checked(*pose, &seed, &weights);
        match found {
            Ok(solution) => Ok(self.extended(&solution, self.angle)),
            // With the arm's numbers of joints.
            Err(Error::Unreachable(_)) => Err(self.unreachable(pose)?),
            Err(error) => Err(error),
        }
    }

    fn unreachable(&self, pose: &Pose) -> Result<Error, Error> {
        Ok(Error::Unreachable(self.ik_checked(pose, self.angle)?.explain()))
    }

    /// The outcome of a solve in a sentence, for a pose that is checked.
    #[cfg(feature = "python")]
    pub(crate) fn explain(&self, pose: &Pose) -> Result<Explanation, Error> {
        let explanation = self.ik_checked(pose, self.angle)?.explain();
        Ok(self.six.with_approach(explanation, pose))
    }
}
