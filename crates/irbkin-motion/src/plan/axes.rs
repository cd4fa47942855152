//! Free axes of a plan: the angle of the tool, its tilt, a track under the robot, a positioner that
//! holds the work object.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Rotation3, Translation3, Unit, Vector3};

use crate::error::Error;
use crate::plan::fault::PlanFault;
use crate::plan::thresholds::{FULL_TURN, MOST_AXIS_STEPS, MOST_EXTERNAL_VALUE, MOST_TOOL_ANGLES};
use irbkin::Pose;
use irbkin::internal::lanes::whole_below;

/// An axis of the tool frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ToolAxis {
    /// x
    X,
    /// y
    Y,
    /// z, in which a tool points.
    Z,
}

impl ToolAxis {
    /// The other two, so that the three are right-handed.
    pub(super) fn others(self) -> [usize; 2] {
        [(self as usize + 1) % 3, (self as usize + 2) % 3]
    }
}

/// Check the range of an axis and its number of values.
pub(super) fn checked_steps(
    field: &'static str,
    [lower, upper]: [f64; 2],
    steps: usize,
    most: usize,
) -> Result<usize, Error> {
    let fits = lower < upper && lower.abs().max(upper.abs()) <= MOST_EXTERNAL_VALUE;
    if !fits {
        return Err(PlanFault::AxisRange { field, lower, upper, most: MOST_EXTERNAL_VALUE }.into());
    }
    if !(2..=most).contains(&steps) {
        return Err(PlanFault::AxisSteps { field, found: steps, bounds: [2, most] }.into());
    }
    Ok(steps)
}

/// The angles by which the tool may be turned about one of its axes at each pose of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolRotation {
    steps: usize,
    lower: f64,
    upper: f64,
    axis: ToolAxis,
}

impl ToolRotation {
    /// `steps` angles from `lower` to `upper` [rad] about an axis of the tool.
    ///
    /// Of a full turn, the upper end is the lower one and does not count twice: 36 steps are 10
    /// degrees apart. Of less, both ends count: 7 steps from -30 to 30 degrees are 10 apart.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPlan`] for no steps or more than 3600, a range that is
    /// empty, not finite or more than a full turn, and one step of a range that has a width.
    pub fn new(steps: usize, lower: f64, upper: f64, axis: ToolAxis) -> Result<Self, Error> {
        let width = upper - lower;
        // NaN is in no range.
        let fits = (0.0..=TAU + FULL_TURN).contains(&width) && lower.abs() <= 2.0 * TAU;
        if !fits {
            return Err(PlanFault::RotationRange { lower, upper }.into());
        }
        let least = if width == 0.0 { 1 } else { 2 };
        if !(least..=MOST_TOOL_ANGLES).contains(&steps) {
            let bounds = [least, MOST_TOOL_ANGLES];
            return Err(PlanFault::RotationSteps { found: steps, bounds }.into());
        }
        Ok(Self { steps: if width == 0.0 { 1 } else { steps }, lower, upper, axis })
    }

    /// `steps` angles all around the tool's z axis.
    ///
    /// # Errors
    ///
    /// As [`Self::new`].
    pub fn full(steps: usize) -> Result<Self, Error> {
        Self::new(steps, -PI, PI, ToolAxis::Z)
    }

    /// Number of angles.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Return the range with angles that are at least `step` apart [rad].
    pub(super) fn coarser(self, step: f64) -> Self {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a small count"
        )]
        let most = whole_below((self.upper - self.lower) / step + FULL_TURN) as usize;
        let ends = usize::from(!self.is_full());
        let least = if self.steps == 1 { 1 } else { 2 };
        Self { steps: self.steps.min((most + ends).max(least)), ..self }
    }

    /// The lower and the upper end [rad].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        [self.lower, self.upper]
    }

    /// The axis.
    #[must_use]
    pub fn axis(&self) -> ToolAxis {
        self.axis
    }

    /// Whether the angles go all around.
    #[must_use]
    pub fn is_full(&self) -> bool {
        self.upper - self.lower >= TAU - FULL_TURN
    }

    /// The angle between two neighbors [rad].
    #[must_use]
    pub fn step(&self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "a small count")]
        let steps = self.steps as f64;
        match self.steps {
            1 => 0.0,
            _ if self.is_full() => TAU / steps,
            _ => (self.upper - self.lower) / (steps - 1.0),
        }
    }
}

/// A cone of directions in which the tool may point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolCone {
    angle: f64,
    steps: usize,
}

impl ToolCone {
    /// Directions within `angle` [rad] of the direction at a pose, on a grid of `steps` tilts
    /// across: an odd number, so that the pose itself is one of them.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPlan`] for an angle that is not positive or above a quarter turn, and for
    /// steps that are even, fewer than 3 or more than 1001.
    pub fn new(angle: f64, steps: usize) -> Result<Self, Error> {
        if !(angle > 0.0 && angle <= FRAC_PI_2) {
            return Err(PlanFault::ConeAngle { angle, most: FRAC_PI_2 }.into());
        }
        let field = "tool cone";
        if steps < 3 || steps.is_multiple_of(2) {
            let bounds = [3, MOST_AXIS_STEPS];
            return Err(PlanFault::AxisSteps { field, found: steps, bounds }.into());
        }
        checked_steps(field, [-angle, angle], steps, MOST_AXIS_STEPS)?;
        Ok(Self { angle, steps })
    }

    /// The largest tilt [rad].
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Number of tilts across.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }
}

/// The motion of an external axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Carried {
    /// The robot, along a direction.
    Robot(Unit<Vector3<f64>>),
    /// The work object, about a line through a point.
    Object(Unit<Vector3<f64>>, Vector3<f64>),
    /// The other joints of seven, by the first one, about a line through a point in the world.
    Arm(Unit<Vector3<f64>>, Vector3<f64>),
    /// The tool, by the last joint of seven, about a line through a point in the tool's frame.
    Tool(Unit<Vector3<f64>>, Vector3<f64>),
}

/// An axis outside of the arm, with the values that a plan may give it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExternalAxis {
    pub(super) carried: Carried,
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

    /// A rail of which a plan tries 21 places at first.
    #[cfg(any(feature = "urdf", feature = "serde"))]
    pub(crate) fn rail(direction: [f64; 3], range: [f64; 2], velocity: f64) -> Result<Self, Error> {
        Self::track(direction, range[0], range[1], 21)?.with_max_velocity(velocity)
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

    /// A joint of seven that is planned as an external axis.
    pub(super) fn joint(carried: Carried, range: [f64; 2], steps: usize) -> Result<Self, Error> {
        let steps = checked_steps("redundancy", range, steps, MOST_AXIS_STEPS)?;
        Ok(Self { carried, range, steps, max_velocity: 1.0, weight: 1.0 })
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
        // A unit direction keeps its digits when it is given again.
        let length = if (length - 1.0).abs() <= 1e-15 { 1.0 } else { length };
        let direction = Unit::new_unchecked(Vector3::from(direction) / length);
        Ok(Self { carried: carried(direction), range, steps, max_velocity: 1.0, weight: 1.0 })
    }

    /// Return the axis with a velocity limit [m/s, rad/s].
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

    /// Return the axis with another cost of moving it, beside the weights of the joints.
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

    /// Direction of a track, or of the line about which the object turns.
    #[must_use]
    pub fn direction(&self) -> [f64; 3] {
        use Carried::{Arm, Object, Robot, Tool};
        let (Robot(axis) | Object(axis, _) | Arm(axis, _) | Tool(axis, _)) = self.carried;
        axis.into_inner().into()
    }

    /// The track in another frame.
    pub(super) fn turned(self, rotation: &Rotation3<f64>) -> Self {
        let direction = Unit::new_normalize(rotation * Vector3::from(self.direction()));
        Self { carried: Carried::Robot(direction), ..self }
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
}

impl Carried {
    /// A pose of the tool seen from the robot, the axis at a value.
    pub(super) fn seen(self, pose: &Pose, value: f64) -> Pose {
        let (position, rotation) = match self {
            Self::Robot(direction) => {
                (pose.translation.vector - direction.into_inner() * value, pose.rotation)
            }
            Self::Object(direction, point) | Self::Arm(direction, point) => {
                let is_arm = matches!(self, Self::Arm(..));
                let turn =
                    Rotation3::from_axis_angle(&direction, if is_arm { -value } else { value });
                (point + turn * (pose.translation.vector - point), turn * pose.rotation)
            }
            Self::Tool(direction, point) => {
                let back = Rotation3::from_axis_angle(&direction, -value);
                let shift = pose.rotation * (point - back * point);
                (pose.translation.vector + shift, pose.rotation * back)
            }
        };
        Pose::from_parts(Translation3::from(position), rotation)
    }
}
