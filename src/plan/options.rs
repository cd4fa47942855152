//! What a plan is asked for.

use alloc::vec::Vec;
use core::f64::consts::{PI, TAU};

use super::axis::ToolAxis;
use super::carrier::{ExternalAxis, checked_count};
use super::tolerance::{ToolCone, ToolOffset};
use crate::error::{Error, PlanFault};
use crate::kinematics::check_weights;
use crate::kinematics::thresholds::{FULL_TURN, MOST_TOOL_ANGLES};
use crate::lanes::whole_below;

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

    /// The same range with angles that are at least so far apart [rad].
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

/// What of two ways without a break makes the better one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlanOrder {
    /// The smaller bottleneck; if they are equal, the smaller sum.
    #[default]
    Bottleneck,
    /// The smaller sum.
    Sum,
}

impl PlanOrder {
    /// What is to be as small as possible, what comes first in front.
    pub(super) fn cost(self, bottleneck: f64, sum: f64) -> (f64, f64) {
        match self {
            Self::Bottleneck => (bottleneck, sum),
            Self::Sum => (sum, bottleneck),
        }
    }
}

/// What a plan is asked for besides the path.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanOptions {
    /// The free rotation of the tool; `None` if each pose fixes the orientation.
    pub rotation: Option<ToolRotation>,
    /// Axes that carry the robot or the work object; of positioners, each carries those after it.
    pub external: Vec<ExternalAxis>,
    /// How far the tool may be tilted.
    pub cone: Option<ToolCone>,
    /// How far the tool may be shifted.
    pub offset: Option<ToolOffset>,
    /// The time of each pose [s]. Then no joint may be faster than its limit. `None`: the poses are
    /// equally far apart in time, and nothing is too fast.
    pub times: Option<Vec<f64>>,
    /// The joint angles at the first pose [rad].
    pub start: Option<[f64; 6]>,
    /// The joint angles at the last pose [rad].
    pub end: Option<[f64; 6]>,
    /// The values of the external axes at the first pose, if `start` is given [m, rad].
    pub start_external: Vec<f64>,
    /// The values of the external axes at the last pose, if `end` is given [m, rad].
    pub end_external: Vec<f64>,
    /// Whether the joints end where they start, turns included.
    pub closed: bool,
    /// Cost of moving each joint.
    pub weights: [f64; 6],
    /// What of two ways makes the better one.
    pub order: PlanOrder,
    /// What a joint at its limit costs [rad^2/s^2]: as much as one of weight 1 that moves with the
    /// root of it. Half way from the middle to the limit it costs a quarter.
    pub limit_cost: f64,
    /// The same of each of the singularities of wrist, elbow and shoulder [rad^2/s^2]; nothing of
    /// an arm whose structure does not have these.
    pub singularity_cost: f64,
}

impl Default for PlanOptions {
    fn default() -> Self {
        Self {
            rotation: None,
            external: Vec::new(),
            cone: None,
            offset: None,
            times: None,
            start: None,
            end: None,
            start_external: Vec::new(),
            end_external: Vec::new(),
            closed: false,
            weights: [1.0; 6],
            order: PlanOrder::Bottleneck,
            limit_cost: 0.0,
            singularity_cost: 0.0,
        }
    }
}

impl PlanOptions {
    /// Check what does not depend on the robot, for a path of `count` poses.
    pub(super) fn check(&self, count: usize) -> Result<(), Error> {
        check_weights(&self.weights)?;
        checked_count(&self.external)?;
        let costs = [("limit_cost", self.limit_cost), ("singularity_cost", self.singularity_cost)];
        for (field, value) in costs {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(PlanFault::Cost { field, value }.into());
            }
        }
        if count == 0 {
            return Err(PlanFault::NoPoses.into());
        }
        if self.closed && self.end.is_some() {
            return Err(PlanFault::ClosedEnd.into());
        }
        let Some(times) = &self.times else { return Ok(()) };
        if times.len() != count {
            return Err(Error::WrongLength { field: "times", found: times.len(), wanted: count });
        }
        let mut before = f64::NEG_INFINITY;
        for (index, value) in times.iter().enumerate() {
            if !(value.is_finite() && *value > before) {
                return Err(PlanFault::Time { index, value: *value, before }.into());
            }
            before = *value;
        }
        Ok(())
    }

    /// The time of each of `count` poses [s].
    pub(super) fn times_of(&self, count: usize) -> Vec<f64> {
        #[expect(clippy::cast_precision_loss, reason = "counts of poses are small")]
        let even = |index: usize| index as f64 / (count.max(2) - 1) as f64;
        match &self.times {
            Some(times) => times.clone(),
            None => (0..count).map(even).collect(),
        }
    }
}
