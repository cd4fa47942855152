//! Finer grids around a way (docs/plan.md, section 5).

use super::answer::PlanError;
use super::caller::Caller;
use super::freedom::Values;
use super::layer::{Grid, Layer, Node, Own};
use super::options::PlanOrder;
use super::planner::Planner;
use super::stations::Stations;
use super::way::Way;
use crate::kinematics::Pose;
use crate::kinematics::thresholds::{BOTTLENECK_ROUNDING, MOST_FREE_AXES, REFINED_TOOL_STEP};
use crate::paths::Turn;

/// Values of a refined layer to each side of the one that was found.
const BAND: usize = 5;

/// How many finer steps are one coarser step [1]: so that a band reaches to the next values.
#[expect(clippy::cast_precision_loss, reason = "a small count")]
pub(super) const FINER: f64 = BAND as f64;

/// Gain of the cost that comes first below which a grid is not searched once more [1].
const GAIN: f64 = 0.02;

/// Most searches of grids that are as fine as the one before.
const AGAIN: usize = 8;

/// A band of values, to each side of one that is its middle.
const WIDTH: usize = 2 * BAND + 1;

/// A layer that is to be made, with the middle of its bands.
pub(super) struct Middle {
    pub(super) pose: Pose,
    pub(super) time: f64,
    pub(super) index: Option<usize>,
    pub(super) angle: f64,
    pub(super) values: Values,
    /// The slot and the joint angles of a joint vector that is given.
    pub(super) given: Option<(usize, [f64; 6])>,
    pub(super) depth: u32,
    pub(super) turn: Option<Turn>,
}

impl Middle {
    /// Where a way goes through a layer.
    pub(super) fn of(grid: &Grid, layer: &Layer, node: Node) -> Self {
        Self {
            pose: layer.pose,
            time: layer.time,
            index: layer.index,
            angle: layer.tool_angle(grid, node.bin),
            values: layer.values(grid, node.station),
            given: layer.own.and(layer.joints(grid, node)).map(|q| (node.slot, q)),
            depth: layer.depth,
            turn: layer.turn,
        }
    }
}

impl Planner<'_> {
    /// A way of finer grids around a way through all layers: at least as good.
    ///
    /// Of several free axes, one at a time gets a band of values, together with the tool angle.
    pub(super) fn refined(
        &mut self,
        mut way: Way,
        caller: &mut Caller<'_, '_>,
    ) -> Result<Way, PlanError> {
        let freedom = self.arm.freedom;
        let mut steps = self.grid.stations.steps;
        let mut turn = self.grid.step;
        loop {
            let is_coarse = |axis: &usize| steps[*axis] > freedom.axes[*axis].finest();
            let coarsest = (0..freedom.axes.len()).filter(is_coarse).max_by(|a, b| {
                let size = |axis: usize| steps[axis] / freedom.axes[axis].finest();
                size(*a).total_cmp(&size(*b))
            });
            if coarsest.is_none() && turn <= REFINED_TOOL_STEP {
                return Ok(way);
            }
            if turn > REFINED_TOOL_STEP {
                turn /= FINER;
            }
            if let Some(axis) = coarsest {
                steps[axis] /= FINER;
            }
            let axis = coarsest.map(|axis| (axis, steps[axis]));
            way = self.improved(way, turn, axis, caller)?;
        }
    }

    /// A way in bands around a way through all layers: at least as good. With free axes, the bands
    /// move along as long as that helps.
    pub(super) fn improved(
        &mut self,
        mut way: Way,
        turn: f64,
        axis: Option<(usize, f64)>,
        caller: &mut Caller<'_, '_>,
    ) -> Result<Way, PlanError> {
        for _ in 0..if axis.is_some() { AGAIN } else { 1 } {
            let (grid, layers) = (self.grid, core::mem::take(&mut self.layers));
            let along = layers.iter().zip(&way.nodes);
            let middles = along.map(|(layer, node)| Middle::of(&grid, layer, *node));
            self.band(middles, turn, axis);
            let finer = self.way_within(way.bottleneck, caller)?;
            let cost = |way: &Way| way.cost(self.order);
            let better = finer.filter(|finer| cost(finer) <= cost(&way));
            let Some(finer) = better else {
                (self.grid, self.layers) = (grid, layers);
                return Ok(way);
            };
            // Of joints that stay, it is no number.
            let has_gained = 1.0 - cost(&finer).0 / cost(&way).0 >= GAIN;
            way = finer;
            if !has_gained {
                return Ok(way);
            }
        }
        Ok(way)
    }

    /// The best way through all layers; where the bottleneck comes first, `None` if that is larger
    /// than one that is known.
    pub(super) fn way_within(
        &mut self,
        bottleneck: f64,
        caller: &mut Caller<'_, '_>,
    ) -> Result<Option<Way>, PlanError> {
        let speed = self.speed;
        if self.order == PlanOrder::Bottleneck {
            self.speed = speed.min(bottleneck * (1.0 + BOTTLENECK_ROUNDING));
            self.expected = Some(self.speed);
        }
        let way = self.whole_way(caller);
        self.speed = speed;
        way
    }

    /// Layers with a band of tool angles, and of the values of an axis.
    pub(super) fn band(
        &mut self,
        middles: impl Iterator<Item = Middle>,
        turn: f64,
        axis: Option<(usize, f64)>,
    ) {
        let mut counts = [1; MOST_FREE_AXES];
        let mut steps = [0.0; MOST_FREE_AXES];
        if let Some((axis, step)) = axis {
            (counts[axis], steps[axis]) = (WIDTH, step);
        }
        let bins = if self.grid.bins > 1 { WIDTH } else { 1 };
        let stations = Stations::new(counts, steps);
        self.grid = Grid { stations, bins, step: turn, cyclic: false, ..self.grid };
        let grid = self.grid;
        let (station, bin) = (stations.len() / 2, bins / 2);
        self.layers.clear();
        self.layers.reserve(middles.size_hint().0);
        for middle in middles {
            if self.arm.watch.ends_at(self.layers.len()) {
                break;
            }
            let mut layer = Layer::new(middle.pose, middle.time, middle.index, &grid);
            layer.base = if bins > 1 { middle.angle - FINER * turn } else { middle.angle };
            layer.bases = middle.values;
            if let Some((axis, step)) = axis {
                layer.bases[axis] -= FINER * step;
            }
            (layer.depth, layer.turn) = (middle.depth, middle.turn);
            if let Some((slot, q)) = middle.given {
                let (angle, values) = (middle.angle, middle.values);
                layer.own = Some(Own { station, bin, angle, values });
                layer.put(&grid, Node { slot, station, bin }, Some(q));
            }
            self.layers.push(layer);
        }
        self.solve(0..self.layers.len());
    }
}
