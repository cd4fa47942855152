//! Whether an arm can go from node to node without a jump: the steps of a way are halved until they
//! shrink, as those of `follow` are (docs/plan.md, eq. 8).

use alloc::vec;
use alloc::vec::Vec;

use nalgebra::Translation3;

use super::freedom::Values;
use super::layer::{Grid, Layer, Node};
use super::nodes::Arm;
use super::way::Way;
use crate::kinematics::thresholds::{CONTINUOUS_STEP, EXAMINED_STEP};
use crate::kinematics::{Pose, Slot, Solution, Status, largest, nearest_turn, pose_to_rows, steps};

/// How often a step is halved in search of a continuous way: down to a millionth of it.
pub(super) const HALVINGS: u32 = 20;

/// How much of a step its halves may have [1].
const HALF: f64 = 0.75;

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

/// How far a way that was followed may end from the joint angles that it leads to [rad].
pub(super) const ARRIVED: f64 = 1e-6;

/// What is between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Between {
    /// A continuous motion.
    Continuous,
    /// A continuous motion that leads elsewhere: to another turn or branch.
    Elsewhere,
    /// A jump, or a part of the way that no joint vector inside the limits reaches.
    Jump,
}

/// Two nodes of neighboring layers, with joint angles whose difference is the step.
#[derive(Clone, Copy)]
pub(super) struct Hop<'a> {
    layers: [&'a Layer; 2],
    nodes: [Node; 2],
    q: [[f64; 6]; 2],
    angles: [f64; 2],
    values: [Values; 2],
}

impl<'a> Hop<'a> {
    pub(super) fn new(
        arm: &Arm<'_>,
        grid: &Grid,
        layers: [&'a Layer; 2],
        nodes: [Node; 2],
        q: [[f64; 6]; 2],
    ) -> Self {
        let [first, second] = [0, 1].map(|end| layers[end].tool_angle(grid, nodes[end].bin));
        let turn = arm.freedom.angle_step(first, second);
        let values = [0, 1].map(|end| layers[end].values(grid, nodes[end].station));
        Self { layers, nodes, q, angles: [first, first + turn], values }
    }

    /// The pose of the tool at a part of the way, 0 to 1: straight, at an even rate of rotation.
    fn pose(&self, arm: &Arm<'_>, part: f64) -> Pose {
        let [first, last] = self.angles;
        let [from, to] = &self.values;
        let values = core::array::from_fn(|axis| from[axis] + part * (to[axis] - from[axis]));
        arm.freedom.tool(&self.path_pose(part), &values, first + part * (last - first))
    }

    fn path_pose(&self, part: f64) -> Pose {
        let [from, to] = self.layers;
        let rotation = to.turn.map_or(from.pose.rotation, |turn| turn.at(part));
        let way = to.pose.translation.vector - from.pose.translation.vector;
        Pose::from_parts(Translation3::from(from.pose.translation.vector + way * part), rotation)
    }

    /// The pose half way, without the turn of the tool.
    pub(super) fn middle(&self) -> Pose {
        self.path_pose(0.5)
    }

    fn step(&self) -> f64 {
        largest(&steps(&self.q[0], &self.q[1]))
    }

    /// Whether the branch has, half way, joint angles between those of both nodes (eq. 8). Where it
    /// has not, the way has to be followed.
    fn is_halved_by(&self, arm: &Arm<'_>, grid: &Grid, q: &[[f64; 6]], status: &[u8]) -> bool {
        let [from, to] = &self.q;
        let slot = self.nodes[0].slot;
        if slot != self.nodes[1].slot || status[slot] & Status::WITHIN_LIMITS.bits() == 0 {
            return false;
        }
        let whole = self.step();
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

    /// Follow the branch from the first node to the second, in steps that are halved until they are
    /// small; a jump does not shrink.
    pub(super) fn followed(&self, arm: &Arm<'_>) -> Between {
        let bound = (self.step() / 4.0).clamp(CONTINUOUS_STEP, EXAMINED_STEP);
        match self.end(arm, bound, arm.has_names()) {
            None => Between::Jump,
            Some(q) if largest(&steps(&q, &self.q[1])) <= ARRIVED => Between::Continuous,
            Some(_) => Between::Elsewhere,
        }
    }

    /// Where the branch of the first node leads, in steps up to a bound; `None` if it jumps. If the
    /// folds of branches are asked for, no step is taken over one, and none to another branch but
    /// through the singularity that they share.
    pub(super) fn end(&self, arm: &Arm<'_>, bound: f64, at_folds: bool) -> Option<[f64; 6]> {
        let (mut q, mut slot) = (self.q[0], Slot::new(self.nodes[0].slot));
        let mut room = if at_folds { arm.room(&self.pose(arm, 0.0), &q) } else { f64::INFINITY };
        let widest = if arm.has_names() { 1.0 } else { WIDEST_OF_ORDINALS };
        let (mut done, mut width, mut depth) = (0.0, widest, 0);
        while done < 1.0 {
            let end = if done + width >= 1.0 { 1.0 } else { done + width };
            let nearest = arm.robot.ik_nearest(&self.pose(arm, end), &q, &[1.0; 6]);
            let next = nearest.ok().and_then(|Solution { q: next, slot: at, .. }| {
                let moved = largest(&steps(&q, &next));
                let ahead = if at_folds { arm.room(&self.pose(arm, end), &next) } else { room };
                let is_change = at_folds && at != slot && moved > AT_CHANGE;
                let is_clear = moved <= (OF_FOLD * (room + ahead)).max(AT_FOLD) && !is_change;
                (moved <= bound && is_clear).then_some((next, at, ahead))
            });
            match next {
                Some((next, at, ahead)) => {
                    (q, slot, room, done) = (next, at, ahead, end);
                    if depth > 0 {
                        (width, depth) = (width * 2.0, depth - 1);
                    }
                }
                None if depth == HALVINGS => return None,
                None => (width, depth) = (width / 2.0, depth + 1),
            }
        }
        Some(q)
    }
}

/// Whether no joint differs by more than a distance, whole turns apart [rad].
fn are_within(distance: f64, q: &[f64; 6], other: &[f64; 6]) -> bool {
    (0..6).all(|joint| (nearest_turn(other[joint], q[joint]) - q[joint]).abs() <= distance)
}

impl Arm<'_> {
    /// How far the other branches are from a joint vector at a pose, the nearest one [rad].
    fn room(&self, pose: &Pose, q: &[f64; 6]) -> f64 {
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

    /// The steps of a way that are not continuous, by the layer that they lead to. Not all, if the
    /// caller stops it.
    pub(super) fn doubts(&self, grid: &Grid, layers: &[Layer], way: &Way) -> Vec<(usize, Between)> {
        /// Steps that are looked at together, of named slots and of ordinals: those are followed.
        const PARTS: [usize; 2] = [512, 16];
        let has_names = self.has_names();
        let count = PARTS[usize::from(!has_names)];
        let mut doubts = Vec::new();
        let mut q = vec![0.0; count * grid.slots * 6];
        let mut status = vec![0; count * grid.slots];
        let hops = (1..way.nodes.len()).map(|step| {
            let layer = way.from + step;
            let nodes = [way.nodes[step - 1], way.nodes[step]];
            let q = [way.q[step - 1], way.q[step]];
            (layer, Hop::new(self, grid, [&layers[layer - 1], &layers[layer]], nodes, q))
        });
        let mut part: Vec<(usize, Hop<'_>)> = Vec::with_capacity(count);
        let mut poses = Vec::with_capacity(count);
        let mut hops = hops.peekable();
        while hops.peek().is_some() && self.watch.goes_on() {
            part.clear();
            part.extend(hops.by_ref().take(count));
            if has_names {
                poses.clear();
                poses.extend(part.iter().map(|(_, hop)| pose_to_rows(&hop.pose(self, 0.5))));
                self.solve_part(&poses, &mut q, &mut status);
            }
            let rows = q.as_chunks::<6>().0.chunks(grid.slots).zip(status.chunks(grid.slots));
            for ((layer, hop), (q, status)) in part.iter().zip(rows) {
                if has_names && hop.is_halved_by(self, grid, q, status) {
                    continue;
                }
                match hop.followed(self) {
                    Between::Continuous => {}
                    doubt => doubts.push((*layer, doubt)),
                }
            }
        }
        doubts
    }
}
