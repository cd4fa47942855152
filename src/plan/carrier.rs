//! Axes outside of the arm: a track under the robot, a positioner that holds the work object.

use nalgebra::{Rotation3, Translation3, Unit, Vector3};

use super::axis::checked_steps;
use crate::error::{Error, PlanFault};
use crate::kinematics::Pose;
use crate::kinematics::thresholds::{MOST_AXIS_STEPS, MOST_EXTERNAL};

/// What an external axis moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Carried {
    /// The robot, along a direction.
    Robot(Unit<Vector3<f64>>),
    /// The work object, about a line through a point.
    Object(Unit<Vector3<f64>>, Vector3<f64>),
}

/// An axis outside of the arm, with the values that a plan may give it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExternalAxis {
    carried: Carried,
    range: [f64; 2],
    steps: usize,
    max_velocity: f64,
    weight: f64,
}

impl ExternalAxis {
    /// A track that shifts the robot along `direction`, by one of `steps` values from `lower` to
    /// `upper` [m]; at most 1 m/s fast.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPlan`] for a direction of length zero or that is not finite, an empty range,
    /// and fewer than 2 or more than 1001 steps.
    pub fn track(direction: [f64; 3], lower: f64, upper: f64, steps: usize) -> Result<Self, Error> {
        Self::new("track", Carried::Robot, direction, [lower, upper], steps)
    }

    /// An axis of a positioner that turns the work object about the line through `point` [m] along
    /// `direction`, by one of `steps` angles from `lower` to `upper` [rad]; at most 1 rad/s fast.
    ///
    /// The poses of the path are those that the tool has where all axes of the positioner are at
    /// zero, and so are point and direction. Of several axes, each carries those that come later.
    ///
    /// # Errors
    ///
    /// As [`Self::track`], and for a point that is not finite.
    pub fn positioner(
        point: [f64; 3],
        direction: [f64; 3],
        lower: f64,
        upper: f64,
        steps: usize,
    ) -> Result<Self, Error> {
        if let Some(index) = point.iter().position(|value| !value.is_finite()) {
            let (field, value) = ("positioner point", point[index]);
            return Err(PlanFault::AxisVector { field, index, value }.into());
        }
        let about = |direction| Carried::Object(direction, Vector3::from(point));
        Self::new("positioner", about, direction, [lower, upper], steps)
    }

    fn new(
        field: &'static str,
        carried: impl FnOnce(Unit<Vector3<f64>>) -> Carried,
        direction: [f64; 3],
        range: [f64; 2],
        steps: usize,
    ) -> Result<Self, Error> {
        let length = Vector3::from(direction).norm();
        if !(length > 0.0 && length.is_finite()) {
            let index = direction.iter().position(|value| !value.is_finite()).unwrap_or(0);
            let value = direction[index];
            return Err(PlanFault::AxisVector { field, index, value }.into());
        }
        let steps = checked_steps(field, range, steps, MOST_AXIS_STEPS)?;
        let direction = Unit::new_unchecked(Vector3::from(direction) / length);
        Ok(Self { carried: carried(direction), range, steps, max_velocity: 1.0, weight: 1.0 })
    }

    /// The same axis with a velocity limit [m/s, rad/s].
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPlan`] for one that is not positive and finite.
    pub fn with_max_velocity(self, max_velocity: f64) -> Result<Self, Error> {
        if !(max_velocity > 0.0 && max_velocity.is_finite()) {
            return Err(PlanFault::AxisVelocity { value: max_velocity }.into());
        }
        Ok(Self { max_velocity, ..self })
    }

    /// The same axis with another cost of moving it, beside the weights of the joints.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPlan`] for one that is negative or not finite.
    pub fn with_weight(self, weight: f64) -> Result<Self, Error> {
        if !(weight >= 0.0 && weight.is_finite()) {
            return Err(PlanFault::AxisWeight { value: weight }.into());
        }
        Ok(Self { weight, ..self })
    }

    /// The least and the largest value [m, rad].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Number of values.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// The velocity limit [m/s, rad/s].
    #[must_use]
    pub fn max_velocity(&self) -> f64 {
        self.max_velocity
    }

    /// The cost of moving it.
    #[must_use]
    pub fn weight(&self) -> f64 {
        self.weight
    }

    pub(super) fn carried(&self) -> Carried {
        self.carried
    }
}

/// Check how many external axes there are.
pub(super) fn checked_count(axes: &[ExternalAxis]) -> Result<(), Error> {
    if axes.len() > MOST_EXTERNAL {
        return Err(PlanFault::External { found: axes.len(), most: MOST_EXTERNAL }.into());
    }
    Ok(())
}

impl Carried {
    /// A pose of the tool seen from the robot, the axis at a value.
    pub(super) fn seen(self, pose: &Pose, value: f64) -> Pose {
        match self {
            Self::Robot(direction) => {
                let position = pose.translation.vector - direction.into_inner() * value;
                Pose::from_parts(Translation3::from(position), pose.rotation)
            }
            Self::Object(direction, point) => {
                let turn = Rotation3::from_axis_angle(&direction, value);
                let position = point + turn * (pose.translation.vector - point);
                Pose::from_parts(Translation3::from(position), turn * pose.rotation)
            }
        }
    }
}
