//! A plan from its parts: layers are solved, searched, proven and refined.

use alloc::vec::Vec;

use super::answer::PlanError;
use super::caller::{Accept, Caller};
use super::certificate::{Between, HALVINGS, Hop};
use super::ends::Given;
use super::field::{Ends, Field};
use super::layer::{Grid, Layer, Node, Waypoint};
use super::nodes::Arm;
use super::options::{PlanOptions, PlanOrder};
use super::turns::TurnStates;
use super::way::Way;
use crate::error::{Error, PlanFault};
use crate::kinematics::thresholds::{LIMIT_TOLERANCE, MOST_PLAN_NODES};
use crate::kinematics::{largest, steps};
use crate::paths::Turn;

/// How often a step with a jump is halved where there are free axes.
const HALVINGS_OF_AXES: u32 = 6;

/// The state of a plan that is being made.
pub(super) struct Planner<'a> {
    pub(super) arm: Arm<'a>,
    pub(super) grid: Grid,
    pub(super) layers: Vec<Layer>,
    pub(super) ends: Ends,
    pub(super) speed: f64,
    /// What the best way costs, about, if that is known: of the cost that comes first.
    pub(super) expected: Option<f64>,
    pub(super) closed: bool,
    /// Whether only ways through all layers count.
    pub(super) whole: bool,
    pub(super) order: PlanOrder,
    /// Joints whose turns mattered so far.
    pub(super) states: TurnStates,
}

impl<'a> Planner<'a> {
    /// The layers of a path whose poses were checked, solved.
    pub(super) fn new(
        arm: Arm<'a>,
        path: &[Waypoint],
        options: &PlanOptions,
        given: &[Option<Given>; 2],
    ) -> Result<Self, Error> {
        let grid = arm.grid();
        let found = path.len().saturating_mul(grid.len());
        if found > MOST_PLAN_NODES {
            return Err(PlanFault::Nodes { found, most: MOST_PLAN_NODES }.into());
        }
        let layers = arm.layers(&grid, path)?;
        let has_limits = options.times.is_some() && arm.robot.max_velocity().is_some();
        let mut planner = Self {
            arm,
            grid,
            layers,
            ends: Ends::default(),
            speed: if has_limits { 1.0 + LIMIT_TOLERANCE } else { f64::INFINITY },
            expected: None,
            closed: options.closed,
            whole: false,
            order: options.order,
            states: TurnStates::default(),
        };
        for joint in 0..6 {
            if arm.soft.is_some_and(|soft| soft.tells(arm.joints, joint)) {
                planner.states.add(joint, arm.joints)?;
            }
        }
        let [first, last] = given;
        let closing = if options.closed { first } else { last };
        let count = planner.layers.len();
        planner.ends.first = first.as_ref().map(|given| planner.fix(0, given));
        if count > 1 || planner.ends.first.is_none() {
            planner.ends.last = closing.as_ref().map(|given| planner.fix(count - 1, given));
        }
        planner.solve(0..count);
        Ok(planner)
    }

    /// Solve a range of layers, and find the edges between branches at them.
    pub(super) fn solve(&mut self, range: core::ops::Range<usize>) {
        self.arm.solve(&self.grid, &mut self.layers, range.clone());
        let last = self.layers.len() - 1;
        if self.closed && range.contains(&last) {
            let (q, present) = (self.layers[0].q.clone(), self.layers[0].present.clone());
            (self.layers[last].q, self.layers[last].present) = (q, present);
        }
        let edges = range.start.max(1)..(range.end + 1).min(self.layers.len());
        self.arm.find_crossings(&self.grid, &mut self.layers, edges);
    }

    /// Fix the joint angles at a layer; returns their turns.
    fn fix(&mut self, layer: usize, given: &Given) -> [i32; 6] {
        let joints = self.arm.joints;
        let q = core::array::from_fn(|joint| joints.first_turn(joint, given.q[joint]));
        let node = Node { slot: given.slot, station: given.own.station, bin: given.own.bin };
        let layer = &mut self.layers[layer];
        layer.own = Some(given.own);
        layer.put(&self.grid, node, Some(q));
        core::array::from_fn(|joint| joints.turn_of(joint, q[joint], given.q[joint]))
    }

    pub(super) fn field(&self) -> Field<'_> {
        Field {
            grid: self.grid,
            joints: self.arm.joints,
            freedom: self.arm.freedom,
            layers: &self.layers,
            speed: self.speed,
            expected: self.expected,
            ends: self.ends,
            whole: self.whole,
            order: self.order,
            soft: self.arm.soft,
            watch: self.arm.watch,
        }
    }

    /// [`Field::best_way`], with the turns told apart that mattered before.
    fn best_way(&mut self, from: usize) -> Result<Option<Way>, PlanError> {
        let mut states = core::mem::take(&mut self.states);
        let way = self.field().best_way(from, &mut states)?;
        self.states = states;
        if let Some(way) = &way {
            self.expected = Some(way.cost(self.order).0);
        }
        Ok(way)
    }

    /// The best way from a layer on whose steps are all continuous and whose nodes the caller
    /// accepts; `None` if there is none, not even to the layer itself.
    pub(super) fn proven_way(
        &mut self,
        from: usize,
        caller: &mut Caller<'_, '_>,
    ) -> Result<Option<Way>, PlanError> {
        let mut reach = 1;
        loop {
            let way =
                if self.closed && from == 0 { self.closed_way()? } else { self.best_way(from)? };
            let Some(way) = way else { return Ok(None) };
            let doubts = self.arm.doubts(&self.grid, &self.layers, &way);
            if !self.arm.watch.goes_on() {
                return Err(PlanError::Stopped);
            }
            if !doubts.is_empty() {
                // From the end, so that layers that are put in do not move those to come.
                for (layer, doubt) in doubts.into_iter().rev() {
                    self.resolve(&way, layer, doubt)?;
                }
                continue;
            }
            if self.is_accepted(&way, reach, caller)? {
                return Ok(Some(way));
            }
            reach *= 2;
        }
    }

    /// The best way that ends with the joint angles that it begins with; the best one that does not
    /// if there is none.
    fn closed_way(&mut self) -> Result<Option<Way>, PlanError> {
        let last = self.layers.len() - 1;
        let Some(open) = self.best_way(0)? else { return Ok(None) };
        if open.reached() < last {
            return Ok(Some(open));
        }
        let mut states = self.states.clone();
        let mut field = self.field();
        field.ends.closed = true;
        field.whole = true;
        let closed = field.closed_way(&mut states)?;
        if self.whole {
            return Ok(closed);
        }
        if closed.is_some() || last == 0 {
            return Ok(Some(closed.unwrap_or(open)));
        }
        let mut shorter = self.field();
        shorter.layers = &self.layers[..last];
        shorter.ends.last = None;
        shorter.best_way(0, &mut states)
    }

    /// Deal with a step of a way that is not continuous.
    fn resolve(&mut self, way: &Way, layer: usize, doubt: Between) -> Result<(), Error> {
        let step = layer - way.from;
        let nodes = [way.nodes[step - 1], way.nodes[step]];
        let q = [way.q[step - 1], way.q[step]];
        let edge = nodes.map(|node| self.grid.number(node));
        let depth = self.layers[layer].depth;
        if doubt == Between::Elsewhere && depth < HALVINGS {
            return self.split(layer, nodes, q);
        }
        // Of many values of free axes, edges are not looked at one by one: a jump does not shrink.
        if self.grid.stations.len() > 1 {
            let stations = nodes.map(|node| node.station);
            if depth < HALVINGS_OF_AXES && self.grid.stations.are_neighbors(stations) {
                return self.split(layer, nodes, q);
            }
            self.layers[layer].cap = 0.5 * self.field().bottleneck(layer, nodes);
            return Ok(());
        }
        if !self.layers[layer].refused.contains(&edge) {
            self.layers[layer].refused.push(edge);
        }
        if !self.layers[layer].is_examined {
            let size = largest(&steps(&q[0], &q[1]));
            self.examine(layer, nodes, 0.5 * size);
        }
        Ok(())
    }

    /// Put a layer half way before a layer.
    fn split(&mut self, layer: usize, nodes: [Node; 2], q: [[f64; 6]; 2]) -> Result<(), Error> {
        let (before, after) = (&self.layers[layer - 1], &self.layers[layer]);
        let hop = Hop::new(&self.arm, &self.grid, [before, after], nodes, q);
        let pose = hop.middle();
        let time = 0.5 * (before.time + after.time);
        let mut middle = Layer::new(pose, time, None, &self.grid);
        middle.base = before.base + 0.5 * self.arm.freedom.angle_step(before.base, after.base);
        middle.bases = core::array::from_fn(|axis| 0.5 * (before.bases[axis] + after.bases[axis]));
        middle.depth = after.depth + 1;
        middle.cap = 2.0 * after.cap;
        let (first, last) = (before.pose.rotation, after.pose.rotation);
        middle.turn = Some(Turn::new(&first, &pose.rotation, None, layer)?);
        let after = &mut self.layers[layer];
        after.turn = Some(Turn::new(&pose.rotation, &last, None, layer)?);
        (after.depth, after.cap) = (middle.depth, middle.cap);
        after.is_examined = false;
        after.refused.clear();
        self.layers.insert(layer, middle);
        self.solve(layer..layer + 1);
        Ok(())
    }

    /// Look at the other edges of a step where one is not continuous: at those about as large.
    fn examine(&mut self, layer: usize, nodes: [Node; 2], least: f64) {
        let grid = self.grid;
        let (before, after) = (&self.layers[layer - 1], &self.layers[layer]);
        let apart = grid.apart(nodes[0].bin, nodes[1].bin).max(1);
        let mut refused = Vec::new();
        for (to, q) in after.nodes(&grid) {
            for offset in 0..(2 * apart + 1).min(grid.bins) {
                let bin = to.bin + grid.bins + offset - apart.min(grid.bins);
                let from = Node { bin: bin % grid.bins, ..to };
                let edge = [grid.number(from), grid.number(to)];
                let Some(q_before) = before.joints(&grid, from) else { continue };
                let steps = self.arm.joints.steps(&q_before, &q);
                if largest(&steps) < least || after.refused.contains(&edge) {
                    continue;
                }
                let Some(ends) = self.arm.joints.inside(&q_before, &steps) else { continue };
                let hop = Hop::new(&self.arm, &grid, [before, after], [from, to], ends);
                if hop.followed(&self.arm) == Between::Jump {
                    refused.push(edge);
                }
            }
        }
        self.layers[layer].refused.extend(refused);
        self.layers[layer].is_examined = true;
    }

    /// Whether the caller accepts every node of a way. If not, those around it that are `reach`
    /// tool angles away are asked for, too.
    fn is_accepted(
        &mut self,
        way: &Way,
        reach: usize,
        caller: &mut Caller<'_, '_>,
    ) -> Result<bool, PlanError> {
        let Some(accept) = &mut caller.accept else { return Ok(true) };
        let grid = self.grid;
        let number = |step: usize| (way.from + step, grid.number(way.nodes[step]));
        let is_new = |layers: &[Layer], (layer, node): &(usize, usize)| -> bool {
            !layers[*layer].accepted.contains(node) && !layers[*layer].rejected.contains(node)
        };
        let mut open: Vec<_> = (0..way.nodes.len()).map(number).collect();
        open.retain(|place| is_new(&self.layers, place));
        let q: Vec<_> = open.iter().map(|(layer, _)| way.q[layer - way.from]).collect();
        let rejected = self.ask(&open, &q, accept)?;
        if rejected.is_empty() {
            return Ok(true);
        }
        let mut around = Vec::new();
        for (layer, number) in &rejected {
            let node = grid.node(*number);
            for near in layer.saturating_sub(1)..(layer + 2).min(self.layers.len()) {
                for (other, q) in self.layers[near].nodes(&grid) {
                    let apart = grid.apart(other.bin, node.bin);
                    let place = (near, grid.number(other));
                    if other.slot == node.slot && apart <= reach && is_new(&self.layers, &place) {
                        around.push((place, q));
                    }
                }
            }
        }
        around.sort_unstable_by_key(|(place, _)| *place);
        around.dedup_by_key(|(place, _)| *place);
        let (places, q): (Vec<_>, Vec<_>) = around.into_iter().unzip();
        self.ask(&places, &q, accept)?;
        Ok(false)
    }

    /// Ask the caller for nodes; take those away that are rejected, and return them.
    fn ask(
        &mut self,
        places: &[(usize, usize)],
        q: &[[f64; 6]],
        accept: &mut Accept<'_>,
    ) -> Result<Vec<(usize, usize)>, PlanError> {
        if places.is_empty() {
            return Ok(Vec::new());
        }
        let verdicts = accept(q).filter(|verdicts| verdicts.len() == q.len());
        let verdicts = verdicts.ok_or(PlanError::Stopped)?;
        let mut rejected = Vec::new();
        for ((layer, number), is_accepted) in places.iter().zip(verdicts) {
            let at = &mut self.layers[*layer];
            if is_accepted {
                at.accepted.push(*number);
            } else {
                at.rejected.push(*number);
                at.put(&self.grid, self.grid.node(*number), None);
                rejected.push((*layer, *number));
            }
        }
        Ok(rejected)
    }
}
