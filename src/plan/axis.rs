//! Axes of a tool, and what the range of any free axis must be.

use crate::error::{Error, PlanFault};
use crate::kinematics::thresholds::MOST_EXTERNAL_VALUE;

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
    pub(super) fn index(self) -> usize {
        match self {
            Self::X => 0,
            Self::Y => 1,
            Self::Z => 2,
        }
    }

    /// The other two, so that the three are right-handed.
    pub(super) fn others(self) -> [usize; 2] {
        [(self.index() + 1) % 3, (self.index() + 2) % 3]
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
