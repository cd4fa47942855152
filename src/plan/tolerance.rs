//! How far the tool may be from the poses of a path: tilted, or shifted.

use core::f64::consts::FRAC_PI_2;

use super::axis::{ToolAxis, checked_steps};
use crate::error::{Error, PlanFault};
use crate::kinematics::thresholds::MOST_AXIS_STEPS;

/// A cone of directions in which the tool may point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolCone {
    angle: f64,
    steps: usize,
}

impl ToolCone {
    /// Directions within `angle` [rad] of that of a pose, on a grid of `steps` tilts across: an odd
    /// number, so that the pose itself is one of them.
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

/// How far the tool may be shifted along an axis of each pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolOffset {
    range: [f64; 2],
    steps: usize,
    axis: ToolAxis,
}

impl ToolOffset {
    /// One of `steps` shifts from `lower` to `upper` [m] along an axis of the pose.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidPlan`] for an empty range, and fewer than 2 or more than
    /// 1001 steps.
    pub fn new(lower: f64, upper: f64, steps: usize, axis: ToolAxis) -> Result<Self, Error> {
        let range = [lower, upper];
        Ok(Self {
            range,
            steps: checked_steps("tool offset", range, steps, MOST_AXIS_STEPS)?,
            axis,
        })
    }

    /// The least and the largest shift [m].
    #[must_use]
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// Number of shifts.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// The axis.
    #[must_use]
    pub fn axis(&self) -> ToolAxis {
        self.axis
    }
}
