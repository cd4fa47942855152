//! Seven-axis arms with one joint locked: the six others are a robot of their own.

use alloc::format;
use alloc::sync::Arc;

use nalgebra::{Unit, Vector3};

use super::{Lock, Released, Robot};
use crate::error::{Error, JointFault, ModelFault};
use crate::kinematics::answer::check::check_angle;
use crate::kinematics::chain::Chain;
use crate::kinematics::chain::dh::Mdh;
use crate::kinematics::chain::joint_axes::JointAxis;
use crate::kinematics::chain::limits::JointLimits;
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::inverse::Inverse;
use crate::kinematics::structure::locked::{Locked, LockedJoint, others};

/// Angle of a joint between the first and the last, in no particular position, by whose chain those
/// at other angles are prepared [rad]: an angle has one chain, whichever was locked before.
const LIKE: f64 = 0.8;

impl Robot<7> {
    /// Lock joint `joint`, from 1, at `angle` [rad]: the answers of the robot that is returned have
    /// seven angles, and a pose needs no redundancy parameter.
    ///
    /// The other six joints are a chain of their own, prepared once. Another angle of the first or
    /// of the last joint costs a solve nothing; one of a joint between them prepares another chain,
    /// in a fraction of the time if the locked robot is locked anew. A joint that was locked before
    /// is released.
    ///
    /// Slots and structure belong to the six joints or, if the last is locked, to the arm. A
    /// joint that a singular pose leaves free is reported by [`Robot::six_joints`].
    ///
    /// ```
    /// use irbkin::Robot;
    ///
    /// let robot = Robot::<7>::named("Panda")?;
    /// let q = [0.1, -0.7, 0.2, -2.2, 0.1, 1.7, 0.6];
    /// let locked = robot.locked(3, 0.2)?;
    /// let solutions = locked.ik(&robot.fk(&q), None)?;
    /// assert!(solutions.iter().any(|found| (found.q[1] + 0.7).abs() < 1e-9));
    /// # Ok::<(), irbkin::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::InvalidJoints`] for a joint that is not 1 to 7, or an angle that is not finite;
    /// [`Error::InvalidModel`] if the other six joints do not move the tool in six independent
    /// ways.
    pub fn locked(&self, joint: usize, angle: f64) -> Result<Self, Error> {
        self.clone().with_lock(Some((joint, angle)))
    }
}

impl<const N: usize> Robot<N> {
    /// The joint that is locked, from 1, and its angle [rad].
    #[must_use]
    pub fn locked_joint(&self) -> Option<(usize, f64)> {
        self.lock.as_ref().map(|lock| (lock.joint.joint() + 1, lock.angle))
    }

    /// Release the locked joint, if there is one.
    #[must_use]
    pub fn unlocked(self) -> Self {
        let Some(Lock { released: Released { inverse, missing_form }, .. }) = self.lock else {
            return self;
        };
        Self { inverse, missing_form, lock: None, ..self }.joined()
    }

    /// Lower and upper limit of each joint [rad]; of a locked one its angle.
    #[doc(hidden)]
    pub fn free_ranges(&self) -> [[f64; 2]; N] {
        let mut ranges = self.limits.to_array();
        if let Some((joint, angle)) = self.locked_joint() {
            ranges[joint - 1] = [angle; 2];
        }
        ranges
    }

    /// The other six joints of an arm with a locked one as a robot, with the arm's base, tool, limits
    /// and velocities; `None` if no joint is locked.
    ///
    /// Its joints are numbered 1 to 6, in its answers and its messages. Of the first and the last
    /// joint at another angle than zero this prepares a chain.
    ///
    /// # Errors
    ///
    /// As [`Robot::locked`].
    pub fn six_joints(&self) -> Result<Option<Robot<6>>, Error> {
        let Some(Lock { joint, angle, six, .. }) = &self.lock else { return Ok(None) };
        let left_out = joint.joint();
        let six = if angle.to_bits() == joint.at().to_bits() || !LockedJoint::is_end(left_out) {
            Robot::clone(six)
        } else {
            self.without(left_out, *angle, None)?
        };
        let name = format!("{}, J{} locked", self.name(), left_out + 1);
        let velocities = self.max_velocity.map(|velocities| others(&velocities, left_out));
        six.with_name(name).with_max_velocity(velocities).map(Some)
    }

    /// The other six joints as a robot whose base the first joint turns, or whose tool the last one
    /// does: nothing is prepared.
    #[doc(hidden)]
    pub fn six_turned(&self) -> Result<Option<Robot<6>>, Error> {
        let Some(Lock { joint, angle, six, .. }) = &self.lock else { return Ok(None) };
        let (six, turned) = (Robot::clone(six), joint.turned(joint.at(), *angle));
        match joint.joint() {
            0 => six.with_base(&(turned * self.base())).map(Some),
            6 => six.with_tool(&(self.tool() * turned)).map(Some),
            _ => Ok(Some(six)),
        }
    }

    /// The angles of the other six joints.
    #[doc(hidden)]
    pub fn others(&self, q: &[f64; N]) -> [f64; 6] {
        others(q, self.locked_index())
    }

    /// The joint vector for one of the other six joints, with the locked joint at its angle.
    #[doc(hidden)]
    pub fn with_others(&self, six: &[f64; 6]) -> [f64; N] {
        self.lock.as_ref().map_or([f64::NAN; N], |lock| lock.joint.joints(six, lock.angle))
    }

    /// The axis of the locked joint and a point on it [m]: of the first joint in the world, of the
    /// last in the frame of the tool.
    #[doc(hidden)]
    pub fn locked_axis(&self) -> Option<(Unit<Vector3<f64>>, Vector3<f64>)> {
        self.lock.as_ref().map(|lock| lock.joint.axis())
    }

    #[inline]
    pub(in crate::kinematics) fn lock(&self) -> Option<&Lock<N>> {
        self.lock.as_ref()
    }

    /// The index of the joint whose angle a caller or a lock determines.
    #[doc(hidden)]
    pub fn locked_index(&self) -> usize {
        self.lock.as_ref().map_or(N - 1, |lock| lock.joint.joint())
    }

    /// Lock a joint, from 1, at an angle [rad], or release it.
    pub(crate) fn with_lock(self, locked: Option<(usize, f64)>) -> Result<Self, Error> {
        let Some((joint, angle)) = locked else { return Ok(self.unlocked()) };
        if N != 7 || !(1..=N).contains(&joint) {
            return Err(JointFault::NoJoint { joint, dof: N }.into());
        }
        check_angle("locked", joint, angle)?;
        let joint = joint - 1;
        let is_end = LockedJoint::is_end(joint);
        let mut before = self.lock.clone().filter(|lock| lock.joint.joint() == joint);
        if is_end && let Some(lock) = before.take() {
            return Ok(Self { lock: Some(Lock { angle, ..lock }), ..self });
        }
        let like = match before {
            Some(Lock { like, .. }) => like,
            None if is_end => None,
            None => self.without(joint, LIKE, None).ok().map(Arc::new),
        };
        let at = if is_end { 0.0 } else { angle };
        let six = Arc::new(self.without(joint, at, like.as_deref())?);
        let Self { inverse, missing_form, lock, .. } = self;
        let released = lock.map_or(Released { inverse, missing_form }, |lock| lock.released);
        let missing_form = if joint == 6 { released.missing_form } else { six.missing_form };
        let locked = LockedJoint::new(&self.chain, joint, at);
        let lock = Lock { joint: locked, angle, six, like, released };
        let inverse = lock.inverse(&self.chain, &self.limits);
        Ok(Self { inverse, missing_form, lock: Some(lock), ..self })
    }

    /// The robot of the other six joints with joint `joint`, from 0, locked at an angle [rad],
    /// prepared by that at another angle.
    fn without(
        &self,
        joint: usize,
        angle: f64,
        like: Option<&Robot<6>>,
    ) -> Result<Robot<6>, Error> {
        let mut q = [0.0; N];
        q[joint] = angle;
        let bare = self.chain.clone().with_base(Pose::identity()).with_tool(Pose::identity());
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
        }?;
        Ok(six.placed(joint, &self.chain, &self.limits))
    }
}

impl Robot<6> {
    /// The robot of six joints of seven between the base and the tool of the arm, with its limits.
    fn placed<const N: usize>(
        mut self,
        left_out: usize,
        chain: &Chain<N>,
        limits: &JointLimits<N>,
    ) -> Self {
        self.chain = self.chain.with_base(*chain.base()).with_tool(*chain.tool());
        self.limits = limits.without(left_out);
        self.joined()
    }
}

impl<const N: usize> Lock<N> {
    /// The lock between the base and the tool of a chain, with limits.
    pub(super) fn between(self, chain: &Chain<N>, limits: &JointLimits<N>) -> Self {
        let left_out = self.joint.joint();
        Self {
            joint: LockedJoint::new(chain, left_out, self.joint.at()),
            six: Arc::new(Robot::clone(&self.six).placed(left_out, chain, limits)),
            ..self
        }
    }

    /// The inverse of the arm with the joint locked.
    fn inverse(&self, chain: &Chain<N>, limits: &JointLimits<N>) -> Option<Arc<dyn Inverse<N>>> {
        if self.joint.joint() == 6 {
            // The arm's own, of which a caller locks the last joint.
            let own = self.released.inverse.as_ref()?;
            return Some(own.between(chain, limits));
        }
        let inverse = self.six.inverse.clone()?;
        Some(Locked::of(inverse, self.six.chain.clone(), self.joint, self.six.limits))
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
