//! The options of a plan, and the questions that it asks its caller.

use alloc::sync::Arc;

use super::answer::StrandReason;
use super::axes::{ExternalAxis, ToolCone, ToolRotation};
use super::graph::Values;
use crate::cell::Cell;
use crate::error::Error;
use crate::paths::line::part;
use crate::plan::fault::PlanFault;
use crate::plan::thresholds::MOST_EXTERNAL;
use crate::prelude::*;
use crate::trajectory::check::check_limits;
use irbkin::Interrupt;
use irbkin::internal::{check_length, check_weights};

/// The order in which bottleneck and sum make one joint path better than another.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlanOrder {
    /// The smaller bottleneck; if they are equal, the smaller sum.
    #[default]
    Bottleneck,
    /// The smaller sum.
    Sum,
}

impl PlanOrder {
    /// The two costs, in the order in which they count.
    pub(super) fn cost(self, bottleneck: f64, sum: f64) -> (f64, f64) {
        match self {
            Self::Bottleneck => (bottleneck, sum),
            Self::Sum => (sum, bottleneck),
        }
    }
}

/// The options of a plan of six joints, or of seven.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanOptions<const N: usize = 6> {
    /// Number of angles of joint 7 that are searched first, of a robot of seven joints of which
    /// none is locked: as an external axis, it is refined and smoothed then.
    pub redundancy: usize,
    /// The free rotation of the tool; `None` if each pose fixes the orientation.
    pub rotation: Option<ToolRotation>,
    /// Axes that carry the robot or the work object; of positioners, each carries those after it.
    pub external: Vec<ExternalAxis>,
    /// How far the tool may be tilted.
    pub cone: Option<ToolCone>,
    /// The time of each pose [s]. Then no joint may be faster than its limit. `None`: the poses are
    /// equally far apart in time, and nothing is too fast.
    pub times: Option<Vec<f64>>,
    /// The joint angles at the first pose [rad].
    pub start: Option<[f64; N]>,
    /// The joint angles at the last pose [rad].
    pub end: Option<[f64; N]>,
    /// The values of the external axes at the first pose, if `start` is given [m, rad].
    pub start_external: Vec<f64>,
    /// The values of the external axes at the last pose, if `end` is given [m, rad].
    pub end_external: Vec<f64>,
    /// Whether the joints end where they start, turns included.
    pub closed: bool,
    /// Cost of moving each joint.
    pub weights: [f64; N],
    /// Whether the bottleneck or the sum comes first.
    pub order: PlanOrder,
    /// Cost of a joint at its limit [rad^2/s^2]: as much as one of weight 1 that moves with the
    /// root of it. Half way from the middle to the limit it costs a quarter.
    pub limit_cost: f64,
    /// The cost of being at one of the singularities of wrist, elbow and shoulder, or of another
    /// structure at any [rad^2/s^2]: see [`Margin`](irbkin::Margin).
    pub singularity_cost: f64,
    /// Limits of the accelerations of the joints [rad/s^2], then of the external axes: then the
    /// plan is the one whose motion takes the shortest time with
    /// [`retime`](crate::trajectory::retime). `None`: the plan is judged at an even pace, or at its
    /// times.
    pub max_acceleration: Option<Vec<f64>>,
    /// Obstacles that the plan stays out of: no joint vector collides, and no motion to the next one in which
    /// each joint moves evenly. Not with external axes, which move the base.
    pub cell: Option<Arc<Cell>>,
}

impl<const N: usize> Default for PlanOptions<N> {
    fn default() -> Self {
        Self {
            redundancy: 36,
            rotation: None,
            external: Vec::new(),
            cone: None,
            times: None,
            start: None,
            end: None,
            start_external: Vec::new(),
            end_external: Vec::new(),
            closed: false,
            weights: [1.0; N],
            order: PlanOrder::Bottleneck,
            limit_cost: 0.0,
            singularity_cost: 0.0,
            max_acceleration: None,
            cell: None,
        }
    }
}

impl<const N: usize> PlanOptions<N> {
    /// Check what does not depend on the robot, for a path of `count` poses.
    pub(super) fn check(&self, count: usize) -> Result<(), Error> {
        check_weights(&self.weights)?;
        if self.external.len() > MOST_EXTERNAL {
            let (found, most) = (self.external.len(), MOST_EXTERNAL);
            return Err(PlanFault::External { found, most }.into());
        }
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
        if let Some(limits) = &self.max_acceleration {
            let field = "max_acceleration";
            check_length(field, limits.len(), N + self.external.len())?;
            check_limits(field, limits)?;
            if self.times.is_some() {
                return Err(PlanFault::TimedTwice.into());
            }
        }
        let Some(times) = &self.times else { return Ok(()) };
        check_length("times", times.len(), count)?;
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
        match &self.times {
            Some(times) => times.clone(),
            None => (0..count).map(|index| part(index, count.max(2) - 1)).collect(),
        }
    }
}

/// A caller's own test of joint vectors, asked for many at a time: whether each is accepted, or
/// nothing to stop.
pub type Accept<'a, const N: usize = 6> = dyn FnMut(&[[f64; N]]) -> Option<Vec<bool>> + 'a;

/// The tests of joint vectors, with the values of the free axes.
pub(super) trait Test {
    /// Whether each joint vector passes; nothing to stop.
    fn postures(&mut self, q: &[[f64; 6]], values: &[Values]) -> Option<Vec<bool>>;

    /// Whether the motion from each joint vector to the next one passes.
    fn motions(&mut self, q: &[[f64; 6]], values: &[Values]) -> Vec<bool>;

    /// The reason why a joint vector, or the motion between two, does not pass.
    fn reason(&mut self, q: &[[f64; 6]], values: &[Values]) -> StrandReason;
}

/// A caller: its tests, if it has any, and whether it ends the plan.
pub(super) struct Caller<'a> {
    pub(super) tests: Option<&'a mut dyn Test>,
    pub(super) interrupt: Interrupt<'a>,
}
