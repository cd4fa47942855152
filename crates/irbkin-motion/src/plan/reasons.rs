//! Why the branches of a path end.

use core::f64::consts::{PI, TAU};

use super::answer::{StrandEnd, StrandReason};
use super::best::JointPath;
use super::branches::nearest_solution;
use super::graph::{Layer, Node, Posture};
use super::options::Caller;
use super::planner::Planner;
use super::search::SlotReach;
use crate::error::Error;
use crate::plan::thresholds::{CROSSING_JUMP, CROSSING_STEP};
use crate::prelude::*;
use irbkin::Explanation;
use irbkin::internal::{largest, nearest_turn};

/// Two nodes of neighboring layers, with the steps of the joints between them [rad].
type Step = (Node, Node, [f64; 6]);

impl Planner<'_> {
    /// Where and why each branch that begins at the first layer of a joint path ends.
    pub(super) fn branch_ends(
        &self,
        path: &JointPath,
        caller: &mut Caller<'_>,
    ) -> Result<Vec<StrandEnd>, Error> {
        let mut ends = Vec::new();
        for slot in 0..self.grid.slots {
            let reach = &path.slots[slot];
            let layer = reach.layer + 1;
            let begins = !self.layers[path.from].of_slot(&self.grid, slot).is_empty();
            if reach.layer == path.from && !begins {
                continue;
            }
            let pose_index = self.index_of(layer.min(self.layers.len() - 1));
            let reason = if layer < self.layers.len() {
                match self.reason(slot, reach)? {
                    StrandReason::Rejected => self.rejection(slot, layer, caller),
                    reason => reason,
                }
            } else {
                StrandReason::NotAtEnd
            };
            ends.push(StrandEnd { slot, pose_index, reason });
        }
        Ok(ends)
    }

    /// The index of the pose of a layer, or of the next one that has an index.
    pub(super) fn index_of(&self, layer: usize) -> usize {
        let index = self.layers[layer..].iter().find_map(|layer| layer.index);
        index.unwrap_or_default()
    }

    /// Why a branch ends where it does.
    fn reason(&self, slot: usize, reach: &SlotReach) -> Result<StrandReason, Error> {
        let layer = reach.layer + 1;
        let (before, after) = (&self.layers[layer - 1], &self.layers[layer]);
        if after.cap < 0.0 {
            return Ok(StrandReason::Unknown);
        }
        if after.of_slot(&self.grid, slot).is_empty() {
            if self.failed(slot, after).is_some() {
                return Ok(StrandReason::Rejected);
            }
            if after.own.is_some() {
                return Ok(StrandReason::NotAtEnd);
            }
            return self.unreachable(slot, [before, after]);
        }
        let all = before.of_slot(&self.grid, slot);
        let smallest = self.least_step(slot, (&all, after), |(_, _, steps)| largest(steps));
        let Some((first, to, steps)) = smallest else {
            return self.unreachable(slot, [before, after]);
        };
        if let Some(too_fast) = self.too_fast(slot, reach) {
            return Ok(too_fast);
        }
        let edge = [first, to].map(|node| self.grid.number(node));
        let q = before.joints(&self.grid, first).unwrap_or_default();
        if after.failed.iter().any(|(failed, _)| *failed == edge) {
            return Ok(StrandReason::Rejected);
        }
        if after.refused.contains(&edge) || largest(&steps) > CROSSING_JUMP {
            let joint = (0..6).max_by(|a, b| steps[*a].abs().total_cmp(&steps[*b].abs()));
            let joint = joint.unwrap_or_default();
            if steps[joint].abs() > PI {
                // The short way round leads through the limits.
                let value = q[joint] + steps[joint] - TAU.copysign(steps[joint]);
                let bounds = self.arm.joints.limits(joint);
                return Ok(StrandReason::Limit { joint: joint + 1, value, bounds });
            }
            let next = after.joints(&self.grid, to).unwrap_or_default();
            // A jump is next to a singularity: of its ends, or of the angles between them.
            let middle = core::array::from_fn(|joint| 0.5 * (q[joint] + next[joint]));
            let kinds = [q, next, middle].map(|q| self.arm.robot.singularity(&q).kinds);
            let kinds = kinds[0] | kinds[1] | kinds[2];
            return Ok(StrandReason::Jump { joint: joint + 1, by: steps[joint], kinds });
        }
        let at_limit = self.at_limit(&q, &steps);
        let is_outside = matches!(at_limit, StrandReason::Limit { joint, value, .. }
            if self.arm.robot.limits().excess(joint - 1, value) > 0.0);
        let is_rejected = !is_outside && self.failed(slot, after).is_some();
        Ok(if is_rejected { StrandReason::Rejected } else { at_limit })
    }

    /// The part of a branch that does not pass the caller's tests at a layer.
    fn failed<'a>(&self, slot: usize, layer: &'a Layer) -> Option<&'a [Posture]> {
        let own = layer.failed.iter().find(|(edge, _)| self.grid.node(edge[1]).slot == slot);
        own.map(|(_, parts)| &parts[..])
    }

    /// Why a branch does not pass the caller's tests at a layer.
    fn rejection(&self, slot: usize, layer: usize, caller: &mut Caller<'_>) -> StrandReason {
        let parts = self.failed(slot, &self.layers[layer]).unwrap_or_default();
        let (q, values): (Vec<_>, Vec<_>) = parts.iter().copied().unzip();
        let tests = caller.tests.as_mut();
        tests.map_or(StrandReason::Rejected, |tests| tests.reason(&q, &values))
    }

    /// Why a branch has no node at a layer.
    fn unreachable(
        &self,
        slot: usize,
        [before, after]: [&Layer; 2],
    ) -> Result<StrandReason, Error> {
        let last = before.of_slot(&self.grid, slot).first().copied();
        let cell = last.map_or(0, |(node, _)| node.cell);
        let pose = self.arm.freedom.tool(&after.pose, &after.values(&self.grid, cell));
        let solutions = self.arm.robot.ik(&pose)?;
        let continued = if self.arm.has_names() {
            solutions.slot(slot).copied()
        } else {
            last.and_then(|(_, q)| nearest_solution(&solutions, &q))
                .filter(|(_, off)| *off <= CROSSING_STEP)
                .map(|(solution, _)| solution)
        };
        let Some(solution) = continued else {
            return Ok(match solutions.explain() {
                Explanation::Found { .. } => StrandReason::Ended,
                explanation => StrandReason::Unreachable(explanation),
            });
        };
        let limits = self.arm.robot.limits();
        let over = |joint: &usize| limits.overrun(*joint, solution.q[*joint]);
        let joint = (0..6).max_by(|a, b| over(a).total_cmp(&over(b))).unwrap_or_default();
        if over(&joint) <= 0.0 {
            return Ok(StrandReason::Unreachable(solutions.explain()));
        }
        let bounds = self.arm.joints.limits(joint);
        let middle = 0.5 * (bounds[0] + bounds[1]);
        let value = nearest_turn(solution.q[joint], middle);
        Ok(StrandReason::Limit { joint: joint + 1, value, bounds })
    }

    /// The joint or axis that is too fast in the slowest step of a branch from the nodes that
    /// were reached.
    fn too_fast(&self, slot: usize, reach: &SlotReach) -> Option<StrandReason> {
        if self.speed.is_infinite() {
            return None;
        }
        let layer = reach.layer + 1;
        let (before, after) = (&self.layers[layer - 1], &self.layers[layer]);
        let (time, rates) = (self.ladder().time(layer), self.ladder().rates(layer));
        let fastest = |(from, to, steps): &Step| {
            let values = [(before, from), (after, to)];
            let [from, to] = values.map(|(layer, node)| layer.values(&self.grid, node.cell));
            let joints = steps.iter().zip(rates.parts).map(|(step, rate)| step.abs() * rate);
            let axes = self.arm.freedom.axes[..self.arm.freedom.external].iter();
            let axes = axes.zip(from.iter().zip(to));
            let axes = axes.map(|(axis, (from, to))| (to - from).abs() / (axis.velocity * time));
            let parts = joints.chain(axes).enumerate();
            parts.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
        };
        let mut sources = before.of_slot(&self.grid, slot);
        sources.retain(|(node, _)| reach.nodes.contains(&self.grid.number(*node)));
        let slowest = self.least_step(slot, (&sources, after), |step| fastest(step).1)?;
        let (number, ratio) = fastest(&slowest);
        (ratio > self.speed).then_some(match number.checked_sub(6) {
            None => StrandReason::Speed { joint: number + 1, ratio },
            Some(axis) => StrandReason::AxisSpeed { axis: axis + 1, ratio },
        })
    }

    /// The least step from nodes of a branch to the nodes of a layer.
    fn least_step(
        &self,
        slot: usize,
        (sources, layer): (&[(Node, [f64; 6])], &Layer),
        size: impl Fn(&Step) -> f64,
    ) -> Option<Step> {
        let ends = layer.of_slot(&self.grid, slot);
        let pairs = sources.iter().flat_map(|from| ends.iter().map(move |to| (from, to)));
        let steps =
            pairs.map(|((from, q), (to, next))| (*from, *to, self.arm.joints.steps(q, next)));
        steps.min_by(|a, b| size(a).total_cmp(&size(b)))
    }

    /// The joint whose turns end at a step.
    fn at_limit(&self, q: &[f64; 6], steps: &[f64; 6]) -> StrandReason {
        let joints = self.arm.joints;
        let over = |joint: &usize| {
            let [lower, upper] = joints.limits(*joint);
            let last = joints.last_turn(*joint, q[*joint]);
            let next = joints.angle(*joint, q[*joint], last) + steps[*joint];
            let first = q[*joint] + steps[*joint];
            (next - upper).max(lower - first)
        };
        let limited = (0..6).filter(|joint| !joints.is_unlimited(*joint) && joints.wraps[*joint]);
        let Some(joint) = limited.max_by(|a, b| over(a).total_cmp(&over(b))) else {
            return StrandReason::NotAtEnd;
        };
        let bounds = joints.limits(joint);
        let last = joints.angle(joint, q[joint], joints.last_turn(joint, q[joint])) + steps[joint];
        let first = q[joint] + steps[joint];
        let value = if last > bounds[1] { last } else { first };
        StrandReason::Limit { joint: joint + 1, value, bounds }
    }

    /// Why no branch has a node at the first layer, if none has.
    pub(super) fn none_at_start(&self, caller: &mut Caller<'_>) -> Result<Vec<StrandEnd>, Error> {
        let first = &self.layers[0];
        let slots = (0..self.grid.slots).filter(|slot| first.of_slot(&self.grid, *slot).is_empty());
        let end = |slot| {
            let reason = if self.failed(slot, first).is_some() {
                self.rejection(slot, 0, caller)
            } else {
                self.unreachable(slot, [first, first])?
            };
            Ok(StrandEnd { slot, pose_index: 0, reason })
        };
        slots.map(end).collect()
    }
}
