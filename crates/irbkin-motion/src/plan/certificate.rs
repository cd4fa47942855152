//! Whether an arm can go from node to node without a jump: the steps of a joint path are halved
//! until they shrink, as `follow` does (docs/theory/plan.md, eq. 8).

use nalgebra::Translation3;

use super::graph::{Grid, Layer, Node, Values};
use super::nodes::PlannedArm;
use crate::plan::thresholds::CONTINUOUS_STEP;
use crate::prelude::*;
use irbkin::internal::thresholds::EXAMINED_STEP;
use irbkin::internal::{largest, nearest_turn, steps};
use irbkin::pose::to_rows as pose_to_rows;
use irbkin::{Pose, Slot, Solution, Status};

/// How often a step is halved in search of a continuous motion: down to a millionth of it.
pub(super) const HALVINGS: u32 = 20;

/// Solves along a step, at most [1]: a motion that takes more is a jump.
const MOST_SOLVES: usize = 4096;

/// How often the distance to a singular pose is halved: to 1e-8 of a step, where a pose still
/// determines joint angles to 1e-7 rad.
const APPROACHES: u32 = 26;

/// How much of a step its halves may have [1].
pub(super) const HALF: f64 = 0.75;

/// Part of a step that is followed at once, at most, of an arm whose slots are ordinals [1]: its
/// branches may end at a fold, and others begin next to it.
const WIDEST_OF_ORDINALS: f64 = 1.0 / 16.0;

/// Part of the distance of two branches that a motion next to their fold may have [1]: to the fold
/// and back would be as much as half of it at either end.
const OF_FOLD: f64 = 0.25;

/// Motion next to a fold that is not looked into [rad].
const AT_FOLD: f64 = 1e-4;

/// Motion in which a branch may pass into another, through the singularity that they share [rad].
const AT_CHANGE: f64 = 1e-5;

/// How far a step that was followed may end from the joint angles that it leads to [rad].
pub(super) const ARRIVED: f64 = 1e-6;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Between {
    Continuous,
    /// A continuous motion that leads elsewhere: to another turn or branch.
    Elsewhere,
    /// A jump, or a part that no joint vector inside the limits reaches.
    Jump,
    /// Not known: the work was used up.
    Unknown,
}

/// Two nodes of neighboring layers, with joint angles whose difference is the step.
#[derive(Clone, Copy)]
pub(super) struct Step<'a> {
    layers: [&'a Layer; 2],
    nodes: [Node; 2],
    q: [[f64; 6]; 2],
    values: [Values; 2],
}

impl<'a> Step<'a> {
    pub(super) fn new(
        grid: &Grid,
        layers: [&'a Layer; 2],
        nodes: [Node; 2],
        q: [[f64; 6]; 2],
    ) -> Self {
        let values = [0, 1].map(|end| layers[end].values(grid, nodes[end].cell));
        Self { layers, nodes, q, values }
    }

    /// The pose of the tool at a part of the step, 0 to 1: straight, at an even rate of rotation.
    fn pose(&self, arm: &PlannedArm<'_>, part: f64) -> Pose {
        let [from, to] = &self.values;
        arm.freedom.tool(&self.path_pose(part), &arm.freedom.between(from, to, part))
    }

    /// The pose of the path at a part of the step, without the turn of the tool.
    pub(super) fn path_pose(&self, part: f64) -> Pose {
        let [from, to] = self.layers;
        let rotation = to.turn.map_or(from.pose.rotation, |turn| turn.at(part));
        let shift = to.pose.translation.vector - from.pose.translation.vector;
        Pose::from_parts(Translation3::from(from.pose.translation.vector + shift * part), rotation)
    }

    fn size(&self) -> f64 {
        largest(&steps(&self.q[0], &self.q[1]))
    }

    /// Whether the branch has, half way, joint angles between both nodes (eq. 8). Where it
    /// has not, the step has to be followed.
    fn is_halved_by(
        &self,
        arm: &PlannedArm<'_>,
        grid: &Grid,
        q: &[[f64; 6]],
        status: &[u8],
    ) -> bool {
        let [from, to] = &self.q;
        let slot = self.nodes[0].slot;
        if slot != self.nodes[1].slot || status[slot] & Status::WITHIN_LIMITS.bits() == 0 {
            return false;
        }
        let whole = self.size();
        let middle = core::array::from_fn(|joint| nearest_turn(q[slot][joint], from[joint]));
        let bound = (HALF * whole).max(CONTINUOUS_STEP);
        whole <= EXAMINED_STEP
            && arm.joints.contain(&middle)
            && largest(&steps(from, &middle)) <= bound
            && largest(&steps(&middle, to)) <= bound
            && !(0..q.len()).any(|other| other != slot && are_within(whole, &q[slot], &q[other]))
            && !(0..2).any(|end| self.is_at_fold(grid, end, whole))
    }

    /// Whether another branch is nearer than a distance to one of the nodes.
    fn is_at_fold(&self, grid: &Grid, end: usize, distance: f64) -> bool {
        let (layer, node) = (self.layers[end], self.nodes[end]);
        (0..grid.slots).filter(|slot| *slot != node.slot).any(|slot| {
            let other = layer.joints(grid, Node { slot, ..node });
            other.is_some_and(|other| are_within(distance, &self.q[end], &other))
        })
    }

    /// The joint angles that a branch tends to on the way to the end of the step at part `to`, 0 or
    /// 1, from joint angles at part `from`. Where the arm is singular there, the pose leaves some
    /// free: halved again and again, the distance to it leaves less and less so. Along a path on
    /// which every pose is singular, they are those nearest to the joint angles that are given.
    pub(super) fn limit(
        &self,
        arm: &PlannedArm<'_>,
        q: [f64; 6],
        [from, to]: [f64; 2],
    ) -> Option<Solution<6>> {
        let near = |part: f64, q: &[f64; 6]| {
            let pose = arm.work.solves().then(|| self.pose(arm, part))?;
            arm.robot.ik_nearest(&pose, q, &[1.0; 6]).ok()
        };
        let end = near(to, &q)?;
        if end.singularities().is_empty() {
            return Some(end);
        }
        let (mut at, mut q) = (from, q);
        for approach in 0..APPROACHES {
            at = 0.5 * (at + to);
            match near(at, &q).filter(|next| next.singularities().is_empty()) {
                Some(next) => q = next.q,
                None if approach == 0 => return Some(end),
                None => break,
            }
        }
        near(to, &q)
    }

    /// Follow the branch from the first node to the second, in steps that are halved until they are
    /// small; a jump does not shrink.
    pub(super) fn followed(&self, arm: &PlannedArm<'_>) -> Between {
        let bound = (self.size() / 4.0).clamp(CONTINUOUS_STEP, EXAMINED_STEP);
        match self.end(arm, bound, arm.has_names()) {
            None if arm.work.is_done() => Between::Unknown,
            None => Between::Jump,
            Some(q) if largest(&steps(&q, &self.q[1])) <= ARRIVED => Between::Continuous,
            Some(_) => Between::Elsewhere,
        }
    }

    /// Where the branch of the first node leads, in steps up to a bound; `None` if it jumps. If the
    /// folds of branches are asked for, no step is taken over one, and none to another branch but
    /// through the singularity that they share.
    pub(super) fn end(&self, arm: &PlannedArm<'_>, bound: f64, at_folds: bool) -> Option<[f64; 6]> {
        let (mut q, mut slot) = (self.q[0], Slot::new(self.nodes[0].slot));
        let mut clear = if at_folds {
            arm.distance_of_branches(&self.pose(arm, 0.0), &q)
        } else {
            f64::INFINITY
        };
        let widest = if arm.has_names() { 1.0 } else { WIDEST_OF_ORDINALS };
        let (mut done, mut width, mut depth) = (0.0, widest, 0);
        for _ in 0..MOST_SOLVES {
            if done >= 1.0 {
                return Some(q);
            }
            if !arm.work.solves() {
                return None;
            }
            let end = if done + width >= 1.0 { 1.0 } else { done + width };
            let nearest = if end < 1.0 {
                arm.robot.ik_nearest(&self.pose(arm, end), &q, &[1.0; 6]).ok()
            } else {
                self.limit(arm, q, [done, 1.0])
            };
            if nearest.is_none() {
                arm.work.fails();
            }
            let next = nearest.and_then(|Solution { q: next, slot: at, .. }| {
                let moved = largest(&steps(&q, &next));
                let ahead = if at_folds {
                    arm.distance_of_branches(&self.pose(arm, end), &next)
                } else {
                    clear
                };
                let is_change = at_folds && at != slot && moved > AT_CHANGE;
                let is_clear = moved <= (OF_FOLD * (clear + ahead)).max(AT_FOLD) && !is_change;
                (moved <= bound && is_clear).then_some((next, at, ahead))
            });
            match next {
                Some((next, at, ahead)) => {
                    (q, slot, clear, done) = (next, at, ahead, end);
                    if depth > 0 {
                        (width, depth) = (width * 2.0, depth - 1);
                    }
                }
                None if depth == HALVINGS => return None,
                None => (width, depth) = (width / 2.0, depth + 1),
            }
        }
        None
    }
}

/// Whether no joint differs by more than a distance, whole turns apart [rad].
fn are_within(distance: f64, q: &[f64; 6], other: &[f64; 6]) -> bool {
    (0..6).all(|joint| (nearest_turn(other[joint], q[joint]) - q[joint]).abs() <= distance)
}

impl PlannedArm<'_> {
    /// How far the other branches are from a joint vector at a pose, the nearest one [rad].
    fn distance_of_branches(&self, pose: &Pose, q: &[f64; 6]) -> f64 {
        let Ok(solutions) = self.robot.ik(pose) else { return f64::INFINITY };
        let apart = |other: [f64; 6]| {
            let parts = other.iter().zip(q).map(|(other, q)| (nearest_turn(*other, *q) - q).abs());
            parts.fold(0.0, f64::max)
        };
        // The branch itself is the nearest of all.
        let mut two = [f64::INFINITY; 2];
        for distance in solutions.iter().map(|solution| apart(solution.q)) {
            two =
                if distance < two[0] { [distance, two[0]] } else { [two[0], two[1].min(distance)] };
        }
        two[1]
    }

    /// The steps along nodes of `layers` that had to be followed, by the number of the node that
    /// they lead to; the others are continuous. Not all, if the caller stops it.
    pub(super) fn followed(
        &self,
        grid: &Grid,
        layers: &[Layer],
        (nodes, q): (&[Node], &[[f64; 6]]),
    ) -> Vec<(usize, Between)> {
        /// Steps that are examined together, of named slots and of ordinals, which are followed.
        const PARTS: [usize; 2] = [512, 16];
        let has_names = self.has_names();
        let count = PARTS[usize::from(!has_names)].min(nodes.len());
        let mut found = Vec::new();
        let mut solved = vec![0.0; count * grid.slots * 6];
        let mut status = vec![0; count * grid.slots];
        let mut part: Vec<(usize, Step<'_>)> = Vec::with_capacity(count);
        let mut poses = Vec::with_capacity(count);
        let mut steps = self.interrupt.over(1..nodes.len()).map(|at| {
            let (layers, nodes) = ([&layers[at - 1], &layers[at]], [nodes[at - 1], nodes[at]]);
            (at, Step::new(grid, layers, nodes, [q[at - 1], q[at]]))
        });
        while !self.interrupt.is_raised() {
            part.clear();
            part.extend(steps.by_ref().take(count));
            if part.is_empty() {
                break;
            }
            if has_names {
                poses.clear();
                poses.extend(part.iter().map(|(_, step)| pose_to_rows(&step.pose(self, 0.5))));
                self.solve_part(&poses, &mut solved, &mut status);
            }
            let rows = solved.as_chunks::<6>().0.chunks(grid.slots);
            for ((at, step), (q, status)) in part.iter().zip(rows.zip(status.chunks(grid.slots))) {
                if has_names && step.is_halved_by(self, grid, q, status) {
                    continue;
                }
                if !layers[*at].proven.contains(&step.q) {
                    found.push((*at, step.followed(self)));
                }
            }
        }
        found
    }
}
