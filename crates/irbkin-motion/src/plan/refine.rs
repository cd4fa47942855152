//! Finer grids around a joint path, and long paths: planned along some of their poses first, then
//! along more and more of them in bands around that plan (docs/theory/plan.md, section 5).

use super::answer::PlanError;
use super::best::JointPath;
use super::ends::EndNode;
use super::freedom::Freedom;
use super::graph::{Grid, Layer, Node, Own, Values, Waypoint, turns};
use super::nodes::PlannedArm;
use super::options::{Caller, PlanOptions, PlanOrder};
use super::planner::Planner;
use crate::error::Error;
use crate::paths::Turn;
use crate::plan::thresholds::{BOTTLENECK_ROUNDING, MOST_FREE_AXES};
use crate::prelude::*;

/// Values of a refined layer to each side of the one that was found.
const BAND: usize = 5;

/// How many finer steps are one coarser step [1]: so that a band reaches to the next values.
#[expect(clippy::cast_precision_loss, reason = "a small count")]
const FINER: f64 = BAND as f64;

/// A band of values, to each side of its middle.
const WIDTH: usize = 2 * BAND + 1;

/// Gain of the cost that comes first below which a grid is not searched once more [1].
const GAIN: f64 = 0.02;

/// Most searches of grids that are as fine as the one before.
const AGAIN: usize = 8;

/// Poses of the first, coarsest path, about.
const FEWEST: usize = 16;

/// How many times as many poses each next path has.
const FINER_STRIDE: usize = 4;

/// Plan along some poses of a long path, refine, then plan along more and more of them; `None` if
/// nothing is free, the path is short, or that finds no plan.
///
/// A fine path leaves no time to go from one value of a coarse grid to the next: between poses that
/// are farther apart it is slower, and the values of the poses between are a ramp.
pub(super) fn coarse_to_fine<'a>(
    arm: PlannedArm<'a>,
    points: &[Waypoint],
    options: &PlanOptions,
    caller: &mut Caller<'_>,
) -> Result<Option<(Planner<'a>, JointPath)>, PlanError> {
    if arm.freedom.axes.is_empty() || !is_long(points) {
        return Ok(None);
    }
    let mut stride = 1;
    while is_long(&points[..points.len() / stride]) {
        stride *= FINER_STRIDE;
    }
    let ends = EndNode::both(&arm, points, options)?;
    // Neighbors may be half a turn apart now: the whole grid is searched instead.
    let Ok(mut planner) = Planner::new(arm, &every(points, stride), options, &ends) else {
        return Ok(None);
    };
    let Some(path) = planner.whole_path(caller)? else { return Ok(None) };
    let mut path = planner.refined(path, caller)?;
    while stride > 1 {
        stride = (stride / FINER_STRIDE).max(1);
        if stride == 1
            && options.order == PlanOrder::Bottleneck
            && let Some(smooth) = planner.smoothed_along(&path, points, caller)?
        {
            return Ok(Some((planner, smooth)));
        }
        let mut steps = planner.steps_of_angle();
        if !arm.freedom.axes[0].is_rotation() {
            steps[0] = planner.finest(0);
        }
        if planner.follow(&path, &every(points, stride), &steps).is_err() {
            return Ok(None);
        }
        let within = match planner.middle_bottleneck(&path) {
            Some(most) => planner.path_within(most, caller)?,
            None => None,
        };
        let finer = if within.is_some() { within } else { planner.whole_path(caller)? };
        let Some(finer) = finer else { return Ok(None) };
        path = planner.polished(finer, caller)?;
    }
    path = planner.smoothed(path, caller)?;
    Ok(Some((planner, path)))
}

/// Whether a path is first planned along some of its poses.
pub(super) fn is_long(points: &[Waypoint]) -> bool {
    points.len() / FINER_STRIDE >= FEWEST
}

/// Every so many poses of a path, and the last one.
fn every(points: &[Waypoint], stride: usize) -> Vec<Waypoint> {
    let last = points.len() - 1;
    let on_grid = points.iter().filter(|point| point.index % stride == 0 || point.index == last);
    on_grid.copied().collect()
}

/// A layer that is to be made, with the middle of its bands.
pub(super) struct Middle {
    pose: irbkin::Pose,
    time: f64,
    index: Option<usize>,
    pub(super) values: Values,
    /// The slot and the joint angles of a joint vector that is given.
    given: Option<(usize, [f64; 6])>,
    depth: u32,
    turn: Option<Turn>,
}

impl Middle {
    /// Where a joint path goes through a layer.
    pub(super) fn of(grid: &Grid, layer: &Layer, node: Node) -> Self {
        Self {
            pose: layer.pose,
            time: layer.time,
            index: layer.index,
            values: layer.values(grid, node.cell),
            given: layer.own.and(layer.joints(grid, node)).map(|q| (node.slot, q)),
            depth: layer.depth,
            turn: layer.turn,
        }
    }

    /// The middle at a pose between two that are known, or at one of them.
    fn toward(&self, to: &Self, point: &Waypoint, turn: Option<Turn>, freedom: &Freedom) -> Self {
        let (pose, time, index) = (point.pose, point.time, Some(point.index));
        let part = (time - self.time) / (to.time - self.time);
        let (values, given) = match [self, to].into_iter().find(|end| end.index == index) {
            Some(end) => (end.values, end.given),
            None => (freedom.between(&self.values, &to.values, part), None),
        };
        Self { pose, time, index, values, given, depth: 0, turn }
    }
}

impl Planner<'_> {
    /// The best joint path, if it goes through all layers. From then on, no others are searched.
    pub(super) fn whole_path(
        &mut self,
        caller: &mut Caller<'_>,
    ) -> Result<Option<JointPath>, PlanError> {
        self.whole = true;
        self.proven_path(0, caller)
    }

    /// The best joint path through all layers; where the bottleneck comes first, `None` if that is
    /// larger than one that is known.
    pub(super) fn path_within(
        &mut self,
        bottleneck: f64,
        caller: &mut Caller<'_>,
    ) -> Result<Option<JointPath>, PlanError> {
        let speed = self.speed;
        if self.order == PlanOrder::Bottleneck {
            self.speed = speed.min(bottleneck * (1.0 + BOTTLENECK_ROUNDING));
            self.expected = Some(self.speed);
        }
        let path = self.whole_path(caller);
        self.speed = speed;
        path
    }

    /// A joint path of finer grids around one through all layers: at least as good.
    ///
    /// Of several free axes, one at a time gets a band of values, together with the tool angle.
    pub(super) fn refined(
        &mut self,
        mut path: JointPath,
        caller: &mut Caller<'_>,
    ) -> Result<JointPath, PlanError> {
        let axes = &self.arm.freedom.axes;
        let mut steps = self.grid.steps;
        loop {
            let size = |axis: usize| steps[axis] / axes[axis].finest();
            let coarse = (0..axes.len()).filter(|axis| size(*axis) > 1.0);
            let coarse: Vec<usize> = coarse.collect();
            if coarse.is_empty() {
                return Ok(path);
            }
            let others = coarse.iter().filter(|axis| !axes[**axis].is_rotation());
            let coarsest = others.max_by(|a, b| size(**a).total_cmp(&size(**b))).copied();
            let rotation = self.arm.freedom.rotation();
            let mut bands = Values::default();
            for axis in coarsest.into_iter().chain(rotation) {
                if coarse.contains(&axis) {
                    steps[axis] /= FINER;
                }
                bands[axis] = steps[axis];
            }
            path = self.improved(path, &bands, caller)?;
        }
    }

    /// A joint path in bands around one through all layers: at least as good. The bands of other
    /// axes than the tool angle move along as long as that helps.
    fn improved(
        &mut self,
        mut path: JointPath,
        steps: &Values,
        caller: &mut Caller<'_>,
    ) -> Result<JointPath, PlanError> {
        let mut axes = self.arm.freedom.axes.iter().zip(steps);
        let moves = axes.any(|(axis, step)| *step > 0.0 && !axis.is_rotation());
        for _ in 0..if moves { AGAIN } else { 1 } {
            let (grid, layers) = (self.grid, core::mem::take(&mut self.layers));
            let along = layers.iter().zip(&path.nodes);
            let middles = along.map(|(layer, node)| Middle::of(&grid, layer, *node));
            self.band(middles, steps);
            let finer = self.path_within(path.bottleneck, caller)?;
            let cost = |path: &JointPath| path.cost(self.order);
            let Some(finer) = finer.filter(|finer| cost(finer) <= cost(&path)) else {
                (self.grid, self.layers) = (grid, layers);
                return Ok(path);
            };
            // NaN if the joints do not move.
            let has_gained = 1.0 - cost(&finer).0 / cost(&path).0 >= GAIN;
            path = finer;
            if !has_gained {
                return Ok(path);
            }
        }
        Ok(path)
    }

    /// Make layers with bands of the values of the axes that have a step.
    pub(super) fn band(&mut self, middles: impl Iterator<Item = Middle>, steps: &Values) {
        let counts = steps.map(|step| if step > 0.0 { WIDTH } else { 1 });
        self.grid = Grid::new(self.grid.slots, counts, *steps, [false; MOST_FREE_AXES]);
        let grid = self.grid;
        let cell = grid.cells / 2;
        self.layers.clear();
        self.layers.reserve(middles.size_hint().0);
        for middle in middles {
            let Middle { values, depth, turn, .. } = middle;
            let mut layer = Layer::new(middle.pose, middle.time, middle.index, &grid);
            layer.first = core::array::from_fn(|axis| values[axis] - FINER * steps[axis]);
            (layer.depth, layer.turn) = (depth, turn);
            if let Some((slot, q)) = middle.given {
                layer.own = Some(Own { cell, values });
                layer.put(&grid, Node { slot, cell }, Some(q));
            }
            self.layers.push(layer);
            if self.arm.interrupt.ends(self.layers.len()) {
                break;
            }
        }
        self.solve_all();
    }

    /// Make layers for more poses of a path, in bands around a joint path through some of them.
    pub(super) fn follow(
        &mut self,
        path: &JointPath,
        points: &[Waypoint],
        steps: &Values,
    ) -> Result<(), Error> {
        let turns = turns(points)?;
        let along = self.layers.iter().zip(&path.nodes).filter(|(layer, _)| layer.index.is_some());
        let known: Vec<Middle> =
            along.map(|(layer, node)| Middle::of(&self.grid, layer, *node)).collect();
        let freedom = self.arm.freedom;
        let mut at = 0;
        let middles: Vec<Middle> = points
            .iter()
            .zip(turns)
            .map(|(point, turn)| {
                while at + 2 < known.len() && known[at + 1].index <= Some(point.index) {
                    at += 1;
                }
                known[at].toward(&known[(at + 1).min(known.len() - 1)], point, turn, freedom)
            })
            .collect();
        self.band(middles.into_iter(), steps);
        Ok(())
    }

    /// The bottleneck of the middle of the bands around a joint path that stays on one branch: no
    /// best joint path of the bands has a larger one, unless steps of the middle jump.
    fn middle_bottleneck(&self, path: &JointPath) -> Option<f64> {
        let slot = path.nodes[0].slot;
        let stays = path.nodes.iter().all(|node| node.slot == slot);
        let nodes = vec![Node { slot, cell: self.grid.cells / 2 }; self.layers.len()];
        let mut along = self.layers.iter().zip(&nodes);
        let is_whole = along.all(|(layer, node)| layer.joints(&self.grid, *node).is_some());
        (stays && is_whole).then(|| self.ladder().bottleneck_along(&nodes, 0))
    }

    /// A joint path in bands of each free axis in turn.
    fn polished(
        &mut self,
        mut path: JointPath,
        caller: &mut Caller<'_>,
    ) -> Result<JointPath, PlanError> {
        let axes = &self.arm.freedom.axes;
        let angle = self.steps_of_angle();
        if axes[0].is_rotation() {
            return self.improved(path, &angle, caller);
        }
        for axis in (0..axes.len()).filter(|axis| !axes[*axis].is_rotation()) {
            for width in [FINER, 1.0] {
                let mut steps = angle;
                steps[axis] = width * self.finest(axis);
                path = self.improved(path, &steps, caller)?;
            }
        }
        Ok(path)
    }

    /// The distance of tool angles of the current grid, alone.
    fn steps_of_angle(&self) -> Values {
        let mut steps = Values::default();
        if let Some(axis) = self.arm.freedom.rotation() {
            steps[axis] = self.grid.steps[axis];
        }
        steps
    }

    /// The distance of the values of an axis on its finest grid [m, rad].
    fn finest(&self, axis: usize) -> f64 {
        let axis = &self.arm.freedom.axes[axis];
        let mut step = axis.step();
        while step > axis.finest() {
            step /= FINER;
        }
        step
    }
}
