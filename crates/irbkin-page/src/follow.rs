//! `follow`: one step of a tool that is dragged.

use alloc::string::{String, ToString};

use irbkin::Robot;
use irbkin::cell::Cell;
use irbkin::follow::{BreakReason, Follower};
use serde::Serialize;

use super::inverse::Solution;
use super::request::{Refusal, Request};

/// The joints that continue others to a new pose.
#[derive(Debug, Serialize)]
pub struct Step {
    /// The solution inside the limits that continues the joints; null if there is none.
    pub solution: Option<Solution>,
    /// Why the joints get there by a jump only; null if they get there evenly.
    pub jump: Option<String>,
    /// Why there is no solution.
    pub reason: Option<String>,
}

impl Step {
    /// The step from the tool's pose at `q` to `T`.
    pub(crate) fn read<const N: usize>(
        robot: &Robot<N>,
        cell: &Cell,
        request: &Request<'_>,
    ) -> Result<Self, Refusal> {
        let (pose, q) = (request.pose("T")?, request.joints::<N>("q")?);
        let cell = request.flag("collide")?.then_some(cell);
        let mut follower = Follower::new(robot, &q, &[1.0; N])?;
        // Without a solution where the joints are, outside limits, the next one is the nearest.
        follower.step(&robot.fk(&q))?;
        let (solution, broken) = follower.step(&pose)?;
        let words = broken.map(|broken| broken.to_string());
        let is_jump = !matches!(broken, Some(BreakReason::Unreachable(_)));
        let (jump, reason) = if is_jump { (words, None) } else { (None, words) };
        let solution = solution.map(|it| Solution::of(robot, cell, &it)).transpose()?;
        Ok(Self { solution, jump, reason })
    }
}
