//! The nodes of layers: inverse kinematics of everything that is free, in lanes
//! (docs/theory/plan.md, eq. 1, 2).

use core::ops::Range;

use super::freedom::Freedom;
use super::graph::{Grid, Layer, Node, Waypoint, turns};
use super::joints::{NodeCost, PlannedJoints};
use super::work::Work;
use crate::error::Error;
use crate::prelude::*;
use irbkin::internal::Rows;
use irbkin::internal::lanes::LANES;
use irbkin::pose::to_rows as pose_to_rows;
use irbkin::{Interrupt, Robot, Status};

/// Poses that are solved at a time.
pub(super) const PART: usize = 512;

/// Status bits of a pose whose joint angles depend on the neighboring layers.
pub(super) const SINGULAR: Status =
    Status::WRIST.union(Status::SHOULDER).union(Status::ELBOW).union(Status::MERGED);

/// Nodes whose joint angles depend on the neighboring layers, with their layers.
#[derive(Default)]
struct Dependent {
    /// Nodes of singular poses; their slot is the first.
    singular: Vec<(usize, Node)>,
    /// Nodes with a joint that may be at either end of its limits.
    either_end: Vec<(usize, Node)>,
}

/// A robot, with everything that makes nodes of poses.
#[derive(Clone, Copy)]
pub(super) struct PlannedArm<'a> {
    pub(super) robot: &'a Robot<6>,
    pub(super) joints: &'a PlannedJoints,
    pub(super) freedom: &'a Freedom,
    pub(super) node_cost: Option<NodeCost<'a>>,
    pub(super) interrupt: Interrupt<'a>,
    pub(super) work: &'a Work,
    /// The only branch at the first pose; all if `None`.
    pub(super) first_slot: Option<usize>,
}

impl PlannedArm<'_> {
    pub(super) fn grid(&self) -> Grid {
        self.freedom.grid(self.robot.slot_count())
    }

    /// Whether slots have names, so that a branch has the same slot at every pose.
    pub(super) fn has_names(&self) -> bool {
        self.robot.slot_names().is_some()
    }

    /// Layers with the whole grid, without nodes yet.
    pub(super) fn layers(&self, grid: &Grid, path: &[Waypoint]) -> Result<Vec<Layer>, Error> {
        let first = self.freedom.first();
        let mut layers = Vec::with_capacity(path.len());
        for (point, turn) in path.iter().zip(turns(path)?) {
            let mut layer = Layer::new(point.pose, point.time, Some(point.index), grid);
            (layer.first, layer.turn) = (first, turn);
            layers.push(layer);
            if self.interrupt.ends(layers.len()) {
                break;
            }
        }
        Ok(layers)
    }

    pub(super) fn solve(&self, grid: &Grid, layers: &mut [Layer], range: Range<usize>) {
        let mut poses = Vec::with_capacity(PART);
        let mut nodes = Vec::with_capacity(PART);
        let mut q = vec![0.0; PART * grid.slots * 6];
        let mut status = vec![0; PART * grid.slots];
        let mut dependent = Dependent::default();
        for layer in self.interrupt.over(range.clone()) {
            if layers[layer].own.is_some() {
                continue;
            }
            // The search, which is next, asks too.
            if self.interrupt.ends(layer) {
                return;
            }
            for cell in 0..grid.cells {
                let values = layers[layer].values(grid, cell);
                if !self.freedom.allows(&values) {
                    continue;
                }
                poses.push(pose_to_rows(&self.freedom.tool(&layers[layer].pose, &values)));
                nodes.push((layer, Node { slot: 0, cell }));
                if poses.len() == PART {
                    self.solve_part(&poses, &mut q, &mut status);
                    self.put(grid, layers, &nodes, (&q, &status), &mut dependent);
                    poses.clear();
                    nodes.clear();
                }
            }
        }
        self.solve_part(&poses, &mut q, &mut status);
        self.put(grid, layers, &nodes, (&q, &status), &mut dependent);
        if !self.has_names() {
            for layer in range {
                self.order_branches(grid, layers, layer);
            }
        }
        self.join_singular(grid, layers, &dependent.singular);
        self.choose_ends(grid, layers, &dependent.either_end);
    }

    pub(super) fn solve_part(&self, poses: &[[f64; 16]], q: &mut [f64], status: &mut [u8]) {
        let slots = self.robot.slot_count();
        self.robot.ik_rows(Rows {
            poses,
            locked: &[],
            q: &mut q[..poses.len() * slots * 6],
            status: &mut status[..poses.len() * slots],
        });
    }

    /// At nodes with a joint that may be at either end of its limits, choose the end on the side of
    /// the layer before, or of the layer after if it is the first.
    fn choose_ends(&self, grid: &Grid, layers: &mut [Layer], nodes: &[(usize, Node)]) {
        let has_names = self.has_names();
        for (layer, node) in nodes {
            // Ordinals have been put in order since: the node may be in any slot.
            let slots = if has_names { node.slot..node.slot + 1 } else { 0..grid.slots };
            for node in slots.map(|slot| Node { slot, ..*node }) {
                let beside = |layer: usize| layers.get(layer).and_then(|at| at.joints(grid, node));
                let neighbor = layer.checked_sub(1).and_then(beside).or_else(|| beside(layer + 1));
                let own = layers[*layer].joints(grid, node);
                if let Some((own, neighbor)) = own.zip(neighbor) {
                    layers[*layer].put(grid, node, Some(self.joints.beside(&own, &neighbor)));
                }
            }
        }
    }

    /// Put answers into layers; note the nodes that depend on their neighbors.
    fn put(
        &self,
        grid: &Grid,
        layers: &mut [Layer],
        nodes: &[(usize, Node)],
        (q, status): (&[f64], &[u8]),
        dependent: &mut Dependent,
    ) {
        let inside = Status::WITHIN_LIMITS.bits();
        let rows = q.as_chunks::<6>().0.chunks(grid.slots).zip(status.chunks(grid.slots));
        for ((layer, node), (q, status)) in nodes.iter().zip(rows) {
            let mut bits = 0;
            let first = grid.number(*node);
            let columns = &mut layers[*layer].q[first / LANES..];
            for slot in 0..grid.slots {
                bits |= status[slot];
                if status[slot] & inside == 0 {
                    continue;
                }
                let columns = &mut columns[slot / LANES];
                for joint in 0..6 {
                    let angle = &mut columns[joint][slot % LANES];
                    *angle = q[slot][joint];
                    if self.joints.are_narrow[joint] {
                        continue;
                    }
                    *angle = self.joints.first_turn(joint, *angle);
                    if self.joints.is_either_end(joint, *angle) {
                        dependent.either_end.push((*layer, Node { slot, ..*node }));
                    }
                }
            }
            if bits & SINGULAR.bits() != 0 {
                dependent.singular.push((*layer, *node));
            }
        }
    }
}
