//! What a robot is changed in, whatever its number of joints.

use super::arm::Change;
use crate::error::{Error, ModelFault};
use crate::kinematics::{JointLimits, Pose, Robot};
use crate::report::ConfigurationRule;

/// A change of a robot.
pub(super) enum Edit<'a> {
    /// Another name.
    Name(&'a str),
    /// Other joint limits, as many as joints [rad].
    Limits(&'a [[f64; 2]]),
    /// The joint limits of a pickled robot.
    StoredLimits(&'a [[f64; 2]]),
    /// Another base.
    Base(Pose),
    /// Another tool.
    Tool(Pose),
    /// The coupled twin, or the serial one.
    Coupled(bool),
    /// Other limits of the linkage [rad], or none.
    LinkageLimits(Option<[f64; 2]>),
    /// The coupling of a pickled robot: none, or the limits of its linkage, which may be no
    /// numbers.
    Coupling(Option<&'a [f64]>),
    /// How its controller counts configurations, if in a way of its own.
    Rule(Option<ConfigurationRule>),
    /// The joint that is locked, from 1, and its angle [rad], or none.
    Lock(Option<(usize, f64)>),
    /// Other velocities, as many as joints [rad/s], or none.
    MaxVelocity(Option<&'a [f64]>),
}

impl Change for Edit<'_> {
    fn apply<const N: usize>(&self, robot: Robot<N>) -> Result<Robot<N>, Error> {
        match self {
            Self::Name(name) => Ok(robot.with_name((*name).to_owned())),
            Self::Limits(limits) => Ok(robot.with_limits(JointLimits::new(of_joints(limits)?)?)),
            Self::StoredLimits(limits) => {
                Ok(robot.with_limits(JointLimits::stored(of_joints(limits)?)?))
            }
            Self::Base(base) => robot.with_base(base),
            Self::Tool(tool) => robot.with_tool(tool),
            Self::Coupled(true) | Self::Coupling(Some([])) => robot.coupled(),
            Self::Coupled(false) => Ok(robot.uncoupled()),
            Self::LinkageLimits(linkage) => robot.with_linkage_limits(*linkage),
            Self::Coupling(None) => Ok(robot),
            Self::Coupling(Some(linkage)) => {
                let damaged = |_| Error::WrongLength {
                    field: "linkage limits",
                    found: linkage.len(),
                    wanted: 2,
                };
                let linkage = <[f64; 2]>::try_from(*linkage).map_err(damaged)?;
                robot.coupled()?.with_linkage_limits(Some(linkage))
            }
            Self::Rule(rule) => Ok(robot.with_rule(*rule)),
            Self::Lock(locked) => robot.with_lock(*locked),
            Self::MaxVelocity(velocity) => {
                robot.with_max_velocity(velocity.map(of_joints).transpose()?)
            }
        }
    }
}

/// One element a joint.
fn of_joints<T: Copy, const N: usize>(elements: &[T]) -> Result<[T; N], Error> {
    let unlike = |_| ModelFault::JointCount { found: N, wanted: elements.len() }.into();
    <[T; N]>::try_from(elements).map_err(unlike)
}
