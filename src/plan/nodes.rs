//! The nodes of layers: inverse kinematics of everything that is free, in lanes (docs/plan.md,
//! eq. 1, 2).

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::TAU;
use core::ops::Range;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::caller::Watch;
use super::freedom::{Freedom, Values};
use super::layer::{Grid, Layer, Node, Waypoint, turns};
use super::soft::Soft;
use super::stations::Stations;
use super::turns::PlannedJoints;
use crate::error::Error;
use crate::kinematics::thresholds::{CONTINUOUS_STEP, CROSSING_JUMP, CROSSING_STEP};
use crate::kinematics::{Robot, Rows, Status, largest, pose_to_rows};
use crate::lanes::{Kernel, nearest_whole, run};

/// Poses that are solved at a time.
const PART: usize = 512;

/// What the status of a pose has whose joint angles depend on those of the layers next to it.
pub(super) const SPECIAL: Status =
    Status::WRIST.union(Status::SHOULDER).union(Status::ELBOW).union(Status::MERGED);

/// Nodes whose joint angles depend on those of the layers next to theirs.
#[derive(Default)]
struct Special {
    /// Layers, with the nodes of singular poses; their slot is the first.
    singular: Vec<(usize, Node)>,
    /// Nodes with a joint that may be at either end of its limits.
    either_end: Vec<(usize, Node)>,
}

/// A robot with what turns poses and angles into nodes.
#[derive(Clone, Copy)]
pub(super) struct Arm<'a> {
    pub(super) robot: &'a Robot<6>,
    pub(super) joints: &'a PlannedJoints,
    pub(super) freedom: &'a Freedom,
    pub(super) soft: Option<Soft<'a>>,
    pub(super) watch: Watch<'a>,
}

impl Arm<'_> {
    /// The whole grid of a layer.
    pub(super) fn grid(&self) -> Grid {
        let (bins, step, cyclic) = match self.freedom.rotation {
            None => (1, 0.0, false),
            Some(rotation) => (rotation.steps(), rotation.step(), rotation.is_full()),
        };
        let stations = Stations::of(&self.freedom.axes);
        Grid { slots: self.robot.slot_count(), stations, bins, step, cyclic }
    }

    /// Layers with the whole grid, without nodes yet.
    pub(super) fn layers(&self, grid: &Grid, path: &[Waypoint]) -> Result<Vec<Layer>, Error> {
        let base = self.freedom.rotation.map_or(0.0, |rotation| rotation.range()[0]);
        let mut bases = Values::default();
        for (base, axis) in bases.iter_mut().zip(&self.freedom.axes) {
            *base = axis.range[0];
        }
        let mut layers = Vec::with_capacity(path.len());
        for (point, turn) in path.iter().zip(turns(path)?) {
            let mut layer = Layer::new(point.pose, point.time, Some(point.index), grid);
            (layer.base, layer.bases, layer.turn) = (base, bases, turn);
            layers.push(layer);
            if self.watch.ends_at(layers.len()) {
                break;
            }
        }
        Ok(layers)
    }

    /// Solve everything that is free of a range of layers.
    pub(super) fn solve(&self, grid: &Grid, layers: &mut [Layer], range: Range<usize>) {
        let mut poses = Vec::with_capacity(PART);
        let mut places = Vec::with_capacity(PART);
        let mut q = vec![0.0; PART * grid.slots * 6];
        let mut status = vec![0; PART * grid.slots];
        let mut special = Special::default();
        let solved = range.clone();
        let angles = self.freedom.angles();
        let mut directions: Vec<(f64, f64)> = Vec::new();
        let mut base = f64::NAN;
        for layer in range {
            if layers[layer].own.is_some() {
                continue;
            }
            // The search, which is next, asks too.
            if self.watch.ends_at(layer) {
                return;
            }
            if layers[layer].base.to_bits() != base.to_bits() {
                base = layers[layer].base;
                directions.clear();
                let angle = |bin| layers[layer].tool_angle(grid, bin);
                directions.extend((0..grid.bins).map(|bin| angle(bin).sin_cos()));
            }
            for station in 0..grid.stations.len() {
                let values = layers[layer].values(grid, station);
                if !self.freedom.allows(&values) {
                    continue;
                }
                let placed = self.freedom.placed(&layers[layer].pose, &values);
                for (bin, direction) in directions.iter().enumerate() {
                    let angle = layers[layer].tool_angle(grid, bin);
                    if angles.is_some_and(|[low, high]| angle < low || angle > high) {
                        continue;
                    }
                    poses.push(pose_to_rows(&self.freedom.turned(&placed, *direction)));
                    places.push((layer, Node { slot: 0, station, bin }));
                    if poses.len() == PART {
                        self.solve_part(&poses, &mut q, &mut status);
                        self.put(grid, layers, &places, (&q, &status), &mut special);
                        poses.clear();
                        places.clear();
                    }
                }
            }
        }
        self.solve_part(&poses, &mut q, &mut status);
        self.put(grid, layers, &places, (&q, &status), &mut special);
        if !self.has_names() {
            for layer in solved {
                self.join_strands(grid, layers, layer);
            }
        }
        self.join_singular(grid, layers, &special.singular);
        self.choose_ends(grid, layers, &special.either_end);
    }

    /// Solve poses into slots.
    pub(super) fn solve_part(&self, poses: &[[f64; 16]], q: &mut [f64], status: &mut [u8]) {
        let slots = self.robot.slot_count();
        self.robot.ik_rows(Rows {
            poses,
            locked: &[],
            q: &mut q[..poses.len() * slots * 6],
            status: &mut status[..poses.len() * slots],
        });
    }

    /// At nodes with a joint that may be at either end of its limits, choose that on the side of the
    /// layer before, or of that after where there is none.
    fn choose_ends(&self, grid: &Grid, layers: &mut [Layer], nodes: &[(usize, Node)]) {
        let has_names = self.has_names();
        for (layer, node) in nodes {
            // Strands have been joined since: it may stand in any slot.
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

    /// Put answers into layers; note those that are special.
    fn put(
        &self,
        grid: &Grid,
        layers: &mut [Layer],
        places: &[(usize, Node)],
        (q, status): (&[f64], &[u8]),
        special_nodes: &mut Special,
    ) {
        let inside = Status::WITHIN_LIMITS.bits();
        let rows = q.as_chunks::<6>().0.chunks(grid.slots).zip(status.chunks(grid.slots));
        for ((number, node), (q, status)) in places.iter().zip(rows) {
            let mut is_singular = 0;
            let layer = &mut layers[*number];
            for slot in 0..grid.slots {
                is_singular |= status[slot] & SPECIAL.bits();
                if status[slot] & inside == 0 {
                    continue;
                }
                let row = grid.row(slot, node.station);
                layer.present[row] = true;
                let start = row * grid.bins + node.bin;
                for joint in 0..6 {
                    let at = joint * grid.len() + start;
                    if self.joints.has_one_angle(joint) {
                        layer.q[at] = q[slot][joint];
                        continue;
                    }
                    let angle = self.joints.first_turn(joint, q[slot][joint]);
                    layer.q[at] = angle;
                    if self.joints.is_either_end(joint, angle) {
                        special_nodes.either_end.push((*number, Node { slot, ..*node }));
                    }
                }
            }
            if is_singular != 0 {
                special_nodes.singular.push((*number, *node));
            }
        }
    }

    /// At singular poses, choose the joint angles on each branch that continue those before, or
    /// those after where there are none.
    fn join_singular(&self, grid: &Grid, layers: &mut [Layer], singular: &[(usize, Node)]) {
        let mut open = Vec::new();
        for (layer, node) in singular {
            for slot in 0..grid.slots {
                let node = Node { slot, ..*node };
                let before = layer.checked_sub(1);
                if !self.join(grid, layers, *layer, before, node) {
                    open.push((*layer, node));
                }
            }
        }
        for (layer, node) in open.into_iter().rev() {
            self.join(grid, layers, layer, Some(layer + 1), node);
        }
    }

    /// Put the joint angles at a node that are nearest to those of the same node of a neighboring
    /// layer; whether there are such.
    fn join(
        &self,
        grid: &Grid,
        layers: &mut [Layer],
        layer: usize,
        neighbor: Option<usize>,
        node: Node,
    ) -> bool {
        let seed = neighbor.and_then(|neighbor| layers.get(neighbor));
        let seed = seed.and_then(|layer| layer.joints(grid, node));
        let Some(seed) = seed else { return false };
        let at = &layers[layer];
        let (values, angle) = (at.values(grid, node.station), at.tool_angle(grid, node.bin));
        let pose = self.freedom.tool(&at.pose, &values, angle);
        let Ok(nearest) = self.robot.ik_nearest(&pose, &seed, &[1.0; 6]) else { return false };
        if largest(&self.joints.steps(&seed, &nearest.q)) > CROSSING_STEP {
            return false;
        }
        let q = core::array::from_fn(|joint| self.joints.first_turn(joint, nearest.q[joint]));
        layers[layer].put(grid, node, Some(q));
        true
    }

    /// Find the edges into layers that lead from one branch to another: where a branch ends or
    /// jumps, and another one continues it.
    pub(super) fn find_crossings(&self, grid: &Grid, layers: &mut [Layer], range: Range<usize>) {
        let mut most = vec![0.0; grid.len()];
        let has_names = self.has_names();
        // A strand may go on in any other slot: where that is nearer.
        let jump = if has_names { CROSSING_JUMP } else { CONTINUOUS_STEP };
        for layer in range {
            if self.watch.ends_at(layer) {
                return;
            }
            let (before, after) = layers.split_at_mut(layer);
            let (before, after) = (&before[layer - 1], &mut after[0]);
            let (wraps, most) = (self.joints.wraps, &mut most[..]);
            run(LargestSteps { before: &before.q, after: &after.q, wraps, most: &mut *most });
            let mut crossings = Vec::new();
            for row in (0..grid.rows()).filter(|row| before.present[*row]) {
                let most = &most[row * grid.bins..(row + 1) * grid.bins];
                // Of a node that is not there, the step is NaN.
                let ends =
                    most.iter().enumerate().filter(|(_, most)| most.is_nan() || **most > jump);
                for (bin, own) in ends {
                    let node = grid.node(row * grid.bins + bin);
                    let bound = if has_names { CROSSING_STEP } else { own.min(CROSSING_STEP) };
                    let Some(q) = before.joints(grid, node) else { continue };
                    for other in (0..grid.slots).filter(|other| *other != node.slot) {
                        let to = Node { slot: other, ..node };
                        let Some(next) = after.joints(grid, to) else { continue };
                        if largest(&self.joints.steps(&q, &next)) <= bound {
                            crossings.push([grid.number(node), grid.number(to)]);
                        }
                    }
                }
            }
            after.crossings = crossings;
        }
    }
}

/// The largest step of a joint from each node of a layer to that of the next one with the same
/// number; NaN where one is missing.
struct LargestSteps<'a> {
    /// Joint angles, of each joint, of each node [rad].
    before: &'a [f64],
    after: &'a [f64],
    /// Whether the step of a joint is taken modulo a turn.
    wraps: [bool; 6],
    /// The answer for each node [rad].
    most: &'a mut [f64],
}

impl Kernel for LargestSteps<'_> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let nodes = self.most.len();
        self.most.fill(0.0);
        for joint in 0..6 {
            let column = joint * nodes..(joint + 1) * nodes;
            let (from, to) = (&self.before[column.clone()], &self.after[column]);
            let turn = if self.wraps[joint] { TAU } else { 0.0 };
            for ((most, from), to) in self.most.iter_mut().zip(from).zip(to) {
                let step = to - from;
                let size = (step - turn * nearest_whole(step * (1.0 / TAU))).abs();
                *most = if size <= *most { *most } else { size };
            }
        }
    }
}
