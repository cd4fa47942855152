//! A plan from its parts: layers are solved, searched, proven and refined.

use super::answer::PlanError;
use super::best::JointPath;
use super::certificate::{Between, HALVINGS, Step};
use super::ends::EndNode;
use super::graph::{Grid, Layer, Node, Waypoint};
use super::joints::TurnStates;
use super::ladder::{Ends, Ladder};
use super::nodes::PlannedArm;
use super::options::{Caller, PlanOptions, PlanOrder, Test};
use crate::error::Error;
use crate::paths::Turn;
use crate::plan::fault::PlanFault;
use crate::plan::thresholds::MOST_PLAN_NODES;
use crate::prelude::*;
use irbkin::internal::thresholds::LIMIT_TOLERANCE;
use irbkin::internal::{largest, steps};

/// How often a step with a jump is halved where there are free axes.
const HALVINGS_OF_AXES: u32 = 6;

pub(super) struct Planner<'a> {
    pub(super) arm: PlannedArm<'a>,
    pub(super) grid: Grid,
    pub(super) layers: Vec<Layer>,
    pub(super) ends: Ends,
    pub(super) speed: f64,
    /// An estimate of the cost that comes first.
    pub(super) expected: Option<f64>,
    pub(super) closed: bool,
    /// Whether only joint paths through all layers count.
    pub(super) whole: bool,
    pub(super) order: PlanOrder,
    /// Joints whose turns mattered so far.
    pub(super) states: TurnStates,
}

impl<'a> Planner<'a> {
    /// The layers of a path whose poses were checked, solved.
    pub(super) fn new(
        arm: PlannedArm<'a>,
        path: &[Waypoint],
        options: &PlanOptions,
        given: &[Option<EndNode>; 2],
    ) -> Result<Self, Error> {
        let grid = arm.grid();
        let found = path.len().saturating_mul(grid.slots * grid.cells);
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
        let [first, last] = given;
        let closing = if options.closed { first } else { last };
        let count = planner.layers.len();
        planner.ends.first = first.as_ref().map(|given| planner.fix(0, given));
        if count > 1 || planner.ends.first.is_none() {
            planner.ends.last = closing.as_ref().map(|given| planner.fix(count - 1, given));
        }
        planner.solve_all();
        Ok(planner)
    }

    /// Solve all layers, with the work that a search through them may take.
    pub(super) fn solve_all(&mut self) {
        self.arm.work.refill(&self.grid, self.layers.len());
        self.solve(0..self.layers.len());
        self.arm.work.refill(&self.grid, self.layers.len());
    }

    /// Solve a range of layers, and find the edges between branches at them.
    pub(super) fn solve(&mut self, range: core::ops::Range<usize>) {
        self.arm.solve(&self.grid, &mut self.layers, range.clone());
        if let Some(only) = self.arm.first_slot.filter(|_| range.start == 0) {
            for number in (0..self.grid.len()).filter(|n| self.grid.node(*n).slot != only) {
                self.layers[0].put(&self.grid, self.grid.node(number), None);
            }
        }
        let last = self.layers.len() - 1;
        if self.closed && range.contains(&last) {
            self.layers[last].q = self.layers[0].q.clone();
        }
        let edges = range.start.max(1)..(range.end + 1).min(self.layers.len());
        self.arm.find_crossings(&self.grid, &mut self.layers, edges);
    }

    /// Fix the joint angles at a layer; returns their turns.
    fn fix(&mut self, layer: usize, given: &EndNode) -> [i32; 6] {
        let joints = self.arm.joints;
        let q = core::array::from_fn(|joint| joints.first_turn(joint, given.q[joint]));
        let node = Node { slot: given.slot, cell: given.own.cell };
        let layer = &mut self.layers[layer];
        layer.own = Some(given.own);
        layer.put(&self.grid, node, Some(q));
        core::array::from_fn(|joint| joints.turn_of(joint, q[joint], given.q[joint]))
    }

    pub(super) fn ladder(&self) -> Ladder<'_> {
        Ladder {
            grid: self.grid,
            joints: self.arm.joints,
            freedom: self.arm.freedom,
            layers: &self.layers,
            speed: self.speed,
            expected: self.expected,
            ends: self.ends,
            whole: self.whole,
            order: self.order,
            node_cost: self.arm.node_cost,
            interrupt: self.arm.interrupt,
        }
    }

    /// [`Ladder::best_path`], with the turns counted that mattered before.
    pub(super) fn best_path(&mut self, from: usize) -> Result<Option<JointPath>, PlanError> {
        let mut states = core::mem::take(&mut self.states);
        let path = self.ladder().best_path(from, &mut states)?;
        self.states = states;
        if let Some(path) = &path {
            self.expected = Some(path.cost(self.order).0);
        }
        Ok(path)
    }

    /// The best joint path from a layer on whose steps are all continuous and whose nodes the
    /// caller accepts; `None` without a node at the layer itself.
    pub(super) fn proven_path(
        &mut self,
        from: usize,
        caller: &mut Caller<'_>,
    ) -> Result<Option<JointPath>, PlanError> {
        let mut reach = 1;
        loop {
            let path =
                if self.closed && from == 0 { self.closed_path()? } else { self.best_path(from)? };
            let Some(path) = path else { return Ok(None) };
            self.arm.work.searches(&self.grid, path.nodes.len());
            let (layers, along) = (&self.layers[from..], (&path.nodes[..], &path.q[..]));
            let mut open = self.arm.followed(&self.grid, layers, along);
            let layers = &mut self.layers[from..];
            open.retain(|(step, between)| {
                if *between == Between::Continuous {
                    layers[*step].proven.push([path.q[step - 1], path.q[*step]]);
                }
                *between != Between::Continuous
            });
            if self.arm.interrupt.is_raised() {
                return Err(PlanError::Stopped);
            }
            if open.is_empty() {
                if self.is_accepted(&path, reach, caller)? {
                    return Ok(Some(path));
                }
                reach *= 2;
            }
            // From the end, so that layers that are put in do not move the others.
            for (step, between) in open.into_iter().rev() {
                self.resolve(&path, step, between)?;
            }
        }
    }

    /// The best joint path that ends with the joint angles that it begins with; otherwise the
    /// best open one.
    fn closed_path(&mut self) -> Result<Option<JointPath>, PlanError> {
        let last = self.layers.len() - 1;
        let Some(open) = self.best_path(0)? else { return Ok(None) };
        if open.reached() < last {
            return Ok(Some(open));
        }
        let mut states = self.states.clone();
        let mut ladder = self.ladder();
        ladder.ends.closed = true;
        ladder.whole = true;
        let closed = ladder.best_closed_path(&mut states)?;
        if self.whole {
            return Ok(closed);
        }
        if closed.is_some() || last == 0 {
            return Ok(Some(closed.unwrap_or(open)));
        }
        let mut shorter = self.ladder();
        shorter.layers = &self.layers[..last];
        shorter.ends.last = None;
        shorter.best_path(0, &mut states)
    }

    /// Split, slow down or refuse a step of a joint path that is not continuous.
    fn resolve(&mut self, path: &JointPath, step: usize, between: Between) -> Result<(), Error> {
        let layer = path.from + step;
        let nodes = [path.nodes[step - 1], path.nodes[step]];
        let q = [path.q[step - 1], path.q[step]];
        let depth = self.layers[layer].depth;
        if self.arm.work.is_done() {
            self.layers[layer].cap = -1.0;
            return Ok(());
        }
        if between == Between::Elsewhere && depth < HALVINGS {
            return self.split(layer, nodes, q);
        }
        // Beside the tool angle, edges are not examined one by one: a jump does not shrink.
        let mut axes = self.arm.freedom.axes.iter().zip(self.grid.counts);
        if axes.any(|(axis, count)| count > 1 && !axis.is_rotation()) {
            let is_near = self.grid.apart(nodes.map(|node| node.cell)) <= 1;
            if depth < HALVINGS_OF_AXES && is_near {
                return self.split(layer, nodes, q);
            }
            self.layers[layer].cap = 0.5 * self.ladder().bottleneck(layer, nodes);
            return Ok(());
        }
        let edge = nodes.map(|node| self.grid.number(node));
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
        let pose = Step::new(&self.grid, [before, after], nodes, q).path_pose(0.5);
        let time = 0.5 * (before.time + after.time);
        let mut middle = Layer::new(pose, time, None, &self.grid);
        middle.first = self.arm.freedom.between(&before.first, &after.first, 0.5);
        middle.depth = after.depth + 1;
        middle.cap = 2.0 * after.cap;
        let (first, last) = (before.pose.rotation, after.pose.rotation);
        middle.turn = Some(Turn::new(&first, &pose.rotation, None, layer)?);
        let after = &mut self.layers[layer];
        after.turn = Some(Turn::new(&pose.rotation, &last, None, layer)?);
        (after.depth, after.cap) = (middle.depth, middle.cap);
        after.is_examined = false;
        after.refused.clear();
        after.proven.clear();
        self.layers.insert(layer, middle);
        self.solve(layer..layer + 1);
        Ok(())
    }

    /// Examine the other edges of a step where one is not continuous: those about as large, between
    /// cells about as far apart.
    fn examine(&mut self, layer: usize, nodes: [Node; 2], least: f64) {
        let grid = self.grid;
        let (before, after) = (&self.layers[layer - 1], &self.layers[layer]);
        let apart = grid.apart(nodes.map(|node| node.cell)).max(1);
        let window = grid.full_window().map(|sides| sides.map(|side| side.min(apart)));
        let mut refused = Vec::new();
        for (to, q) in after.nodes(&grid) {
            for cell in grid.around(to.cell, &window) {
                let from = Node { cell, ..to };
                let edge = [grid.number(from), grid.number(to)];
                let Some(q_before) = before.joints(&grid, from) else { continue };
                let steps = self.arm.joints.steps(&q_before, &q);
                if largest(&steps) < least || after.refused.contains(&edge) {
                    continue;
                }
                let Some(ends) = self.arm.joints.inside(&q_before, &steps) else { continue };
                let step = Step::new(&grid, [before, after], [from, to], ends);
                if step.followed(&self.arm) == Between::Jump {
                    refused.push(edge);
                }
            }
        }
        self.layers[layer].refused.extend(refused);
        self.layers[layer].is_examined = true;
    }

    /// Whether the caller accepts every node of a joint path. If not, it is asked for the nodes
    /// around that are up to `reach` values away, too.
    fn is_accepted(
        &mut self,
        path: &JointPath,
        reach: usize,
        caller: &mut Caller<'_>,
    ) -> Result<bool, PlanError> {
        let Some(tests) = &mut caller.tests else { return Ok(true) };
        let grid = self.grid;
        let number = |step: usize| (path.from + step, grid.number(path.nodes[step]));
        let is_new = |layers: &[Layer], (layer, node): &(usize, usize)| -> bool {
            let layer = &layers[*layer];
            let is_failed = layer.failed.iter().any(|(edge, _)| *edge == [*node; 2]);
            !is_failed && !layer.accepted.contains(node)
        };
        let mut open: Vec<_> = (0..path.nodes.len()).map(number).collect();
        open.retain(|key| is_new(&self.layers, key));
        let q: Vec<_> = open.iter().map(|(layer, _)| path.q[layer - path.from]).collect();
        let rejected = self.ask(&open, &q, *tests)?;
        if rejected.is_empty() {
            return Ok(self.are_motions_accepted(path, *tests));
        }
        let mut around = Vec::new();
        for (layer, number) in &rejected {
            let node = grid.node(*number);
            for near in layer.saturating_sub(1)..(layer + 2).min(self.layers.len()) {
                for (other, q) in self.layers[near].nodes(&grid) {
                    let apart = grid.apart([other.cell, node.cell]);
                    let key = (near, grid.number(other));
                    if other.slot == node.slot && apart <= reach && is_new(&self.layers, &key) {
                        around.push((key, q));
                    }
                }
            }
        }
        around.sort_unstable_by_key(|(key, _)| *key);
        around.dedup_by_key(|(key, _)| *key);
        let (keys, q): (Vec<_>, Vec<_>) = around.into_iter().unzip();
        self.ask(&keys, &q, *tests)?;
        Ok(false)
    }

    /// Whether all motions of a joint path pass their test; those that do not are refused. Motions
    /// between poses with others in between are not the ones of the plan, so they are not looked
    /// at.
    fn are_motions_accepted(&mut self, path: &JointPath, tests: &mut dyn Test) -> bool {
        let layers = &self.layers[path.from..][..path.nodes.len()];
        let poses: Vec<usize> =
            (0..layers.len()).filter(|at| layers[*at].index.is_some()).collect();
        let q: Vec<_> = poses.iter().map(|at| path.q[*at]).collect();
        let values = poses.iter().map(|at| layers[*at].values(&self.grid, path.nodes[*at].cell));
        let values: Vec<_> = values.collect();
        let passed = tests.motions(&q, &values);
        let mut all = true;
        for (first, (ends, passed)) in poses.windows(2).zip(passed).enumerate() {
            let [from, to] =
                [ends[0], ends[1]].map(|at| self.layers[path.from + at].index.unwrap_or_default());
            if passed || to != from + 1 {
                continue;
            }
            all = false;
            let at = path.from + ends[1];
            let edge = [ends[1] - 1, ends[1]].map(|step| self.grid.number(path.nodes[step]));
            self.layers[at].refused.push(edge);
            let motion = (first..first + 2).map(|end| (q[end], values[end])).collect();
            self.layers[at].failed.push((edge, motion));
        }
        all
    }

    /// Ask the caller for nodes; take those away that are rejected, and return them.
    fn ask(
        &mut self,
        keys: &[(usize, usize)],
        q: &[[f64; 6]],
        tests: &mut dyn Test,
    ) -> Result<Vec<(usize, usize)>, PlanError> {
        if keys.is_empty() {
            return Ok(Vec::new());
        }
        let values = |(layer, number): &(usize, usize)| {
            self.layers[*layer].values(&self.grid, self.grid.node(*number).cell)
        };
        let values: Vec<_> = keys.iter().map(values).collect();
        let verdicts = tests.postures(q, &values).filter(|verdicts| verdicts.len() == q.len());
        let verdicts = verdicts.ok_or(PlanError::Stopped)?;
        let mut rejected = Vec::new();
        let parts = q.iter().copied().zip(values);
        for (((layer, number), part), is_accepted) in keys.iter().zip(parts).zip(verdicts) {
            let at = &mut self.layers[*layer];
            if is_accepted {
                at.accepted.push(*number);
            } else {
                at.failed.push(([*number; 2], Vec::from([part])));
                at.put(&self.grid, self.grid.node(*number), None);
                rejected.push((*layer, *number));
            }
        }
        Ok(rejected)
    }
}
