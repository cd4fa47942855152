//! Long paths with free axes: what a plan along some of the poses gives to those between them
//! (docs/plan.md, section 5).

use alloc::vec;
use alloc::vec::Vec;

use super::answer::PlanError;
use super::caller::Caller;
use super::ends::Given;
use super::freedom::Freedom;
use super::layer::{Node, Waypoint, turns};
use super::nodes::Arm;
use super::options::PlanOptions;
use super::planner::Planner;
use super::refine::{FINER, Middle};
use super::way::Way;
use crate::error::Error;
use crate::paths::Turn;

/// Poses of the first, coarsest path, about.
const FEWEST: usize = 16;

/// How many times as many poses each next path has.
pub(super) const FINER_STRIDE: usize = 4;

/// The plan along some poses of a long path, refined, then along more and more of them; `None` if
/// nothing is free, or if that finds none.
///
/// What goes from value to value of its grid between two poses is fast. Between poses that are
/// farther apart it is slower, and what is between those is a ramp.
pub(super) fn guided<'a>(
    arm: Arm<'a>,
    points: &[Waypoint],
    options: &PlanOptions,
    caller: &mut Caller<'_, '_>,
) -> Result<Option<(Planner<'a>, Way)>, PlanError> {
    let mut stride = first_stride(points.len());
    let is_fixed = arm.freedom.axes.is_empty() && arm.freedom.rotation.is_none();
    if is_fixed || stride == 1 {
        return Ok(None);
    }
    let ends = Given::both(&arm, points, options)?;
    // Neighbors may be half a turn apart now: a matter of this way only.
    let Ok(mut planner) = Planner::new(arm, &every(points, stride), options, &ends) else {
        return Ok(None);
    };
    let Some(way) = planner.whole_way(caller)? else { return Ok(None) };
    let mut way = planner.refined(way, caller)?;
    while stride > 1 {
        stride = (stride / FINER_STRIDE).max(1);
        if planner.guide(&way, &every(points, stride)).is_err() {
            return Ok(None);
        }
        let within = match planner.middle_bottleneck(&way) {
            Some(most) => planner.way_within(most, caller)?,
            None => None,
        };
        let finer = if within.is_some() { within } else { planner.whole_way(caller)? };
        let Some(finer) = finer else { return Ok(None) };
        way = planner.polished(finer, caller)?;
    }
    Ok(Some((planner, way)))
}

/// The distance of the poses of the coarsest path.
pub(super) fn first_stride(count: usize) -> usize {
    let mut stride = 1;
    while count / (stride * FINER_STRIDE) >= FEWEST {
        stride *= FINER_STRIDE;
    }
    stride
}

/// Every so many poses of a path, and the last one.
fn every(points: &[Waypoint], stride: usize) -> Vec<Waypoint> {
    let last = points.len() - 1;
    let on_grid = points.iter().filter(|point| point.index % stride == 0 || point.index == last);
    on_grid.copied().collect()
}

impl Planner<'_> {
    /// The best way, if it goes through all layers. From then on, no others are looked for.
    pub(super) fn whole_way(
        &mut self,
        caller: &mut Caller<'_, '_>,
    ) -> Result<Option<Way>, PlanError> {
        self.whole = true;
        self.proven_way(0, caller)
    }

    /// Layers for more poses of a path, in bands around a way through some of them.
    fn guide(&mut self, way: &Way, points: &[Waypoint]) -> Result<(), Error> {
        let turns = turns(points)?;
        let along = self.layers.iter().zip(&way.nodes).filter(|(layer, _)| layer.index.is_some());
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
        let step = freedom.axes.first().map(|_| (0, self.finest(0)));
        self.band(middles.into_iter(), self.grid.step, step);
        Ok(())
    }

    /// The bottleneck of the middle of the bands around a way that stays on one branch: no best way
    /// of the bands has a larger one, unless steps of the middle jump.
    fn middle_bottleneck(&self, way: &Way) -> Option<f64> {
        let slot = way.nodes[0].slot;
        let stays = way.nodes.iter().all(|node| node.slot == slot);
        let (station, bin) = (self.grid.stations.len() / 2, self.grid.bins / 2);
        let nodes = vec![Node { slot, station, bin }; self.layers.len()];
        let mut along = self.layers.iter().zip(&nodes);
        let is_whole = along.all(|(layer, node)| layer.joints(&self.grid, *node).is_some());
        (stays && is_whole).then(|| self.field().bottleneck_along(&nodes, 0))
    }

    /// A way in bands of each free axis in turn.
    fn polished(&mut self, mut way: Way, caller: &mut Caller<'_, '_>) -> Result<Way, PlanError> {
        let turn = self.grid.step;
        let turn_only = self.arm.freedom.axes.is_empty();
        if turn_only {
            return self.improved(way, turn, None, caller);
        }
        for axis in 0..self.arm.freedom.axes.len() {
            for width in [FINER, 1.0] {
                way = self.improved(way, turn, Some((axis, width * self.finest(axis))), caller)?;
            }
        }
        Ok(way)
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

impl Middle {
    /// The middle at a pose between two that are known, or at one of them.
    fn toward(&self, to: &Self, point: &Waypoint, turn: Option<Turn>, freedom: &Freedom) -> Self {
        let here = Self {
            pose: point.pose,
            time: point.time,
            index: Some(point.index),
            given: None,
            depth: 0,
            turn,
            ..*self
        };
        if let Some(end) = [self, to].into_iter().find(|end| end.index == here.index) {
            return Self { angle: end.angle, values: end.values, given: end.given, ..here };
        }
        let part = (point.time - self.time) / (to.time - self.time);
        let between = |axis| self.values[axis] + part * (to.values[axis] - self.values[axis]);
        Self {
            angle: self.angle + part * freedom.angle_step(self.angle, to.angle),
            values: core::array::from_fn(between),
            ..here
        }
    }
}
