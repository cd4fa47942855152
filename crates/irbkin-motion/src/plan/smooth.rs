//! Free axes along a joint path, smoothed: the search leaves them on a grid
//! (docs/theory/plan.md, section 5).

use super::answer::PlanError;
use super::best::JointPath;
use super::freedom::Freedom;
use super::graph::{Grid, Layer, Values, Waypoint};
use super::joints::TurnStates;
use super::ladder::{Ends, Ladder};
use super::nodes::{PART, PlannedArm, SINGULAR};
use super::options::{Caller, PlanOrder};
use super::planner::Planner;
use super::refine::Middle;
use super::roughness::{COORDINATES, Curve, Derivatives, Roughness};
use crate::plan::thresholds::BOTTLENECK_ROUNDING;
use crate::prelude::*;
use irbkin::internal::{largest, nearest_turn, steps};
use irbkin::pose::to_rows as pose_to_rows;

/// How much smoothing may raise a bottleneck, up to the one with nothing free [1].
const OF_SMOOTHING: f64 = 0.03;

/// Weights of the wall of velocities [1], one after the other: first the shape, then the wall.
const WALLS: [f64; 4] = [1e2, 1e3, 1e4, 3e4];

/// How often every pose is solved, and the joints taken as moving evenly from there, at most [1].
const ROUNDS: usize = 8;

/// Newton steps from there, at most [1].
const STEPS: usize = 6;

/// Decrease of the cost below which a search for its minimum is done, relative to it [1].
const GAIN: f64 = 1e-5;

/// How often a step is halved until the cost decreases.
const HALVINGS: usize = 6;

/// Part of a window by which free axes move for derivatives [1].
const DIFFERENCE: f64 = 1e-6;

/// Times in which joints reach their velocity limits [s], for how much acceleration counts, and
/// parts of the bottleneck that velocities aim at [1]: first those of an arm, then those with which
/// the bottleneck is less.
const PACES: [[f64; 2]; 3] = [[0.1, 0.95], [0.1, 0.9], [0.025, 0.9]];

impl Planner<'_> {
    /// A joint path with everything that is free smoothed and proven again, at least as good; where
    /// that is refused, a little worse, but not worse than with nothing free; else the one given.
    pub(super) fn smoothed(
        &mut self,
        path: JointPath,
        caller: &mut Caller<'_>,
    ) -> Result<JointPath, PlanError> {
        let most = path.cost(self.order).0;
        if self.arm.freedom.axes.is_empty() {
            return Ok(path);
        }
        if self.order == PlanOrder::Sum {
            return Ok(self.smoothed_within(&path, most, &PACES, caller)?.unwrap_or(path));
        }
        if let Some(smooth) = self.smoothed_within(&path, most, &PACES[..2], caller)? {
            return Ok(smooth);
        }
        let raised = self.fixed_bottleneck()?.min((1.0 + OF_SMOOTHING) * most);
        Ok(self.smoothed_within(&path, raised.max(most), &PACES, caller)?.unwrap_or(path))
    }

    /// The bottleneck with nothing free, or less; infinite if there is no joint path.
    fn fixed_bottleneck(&self) -> Result<f64, PlanError> {
        let freedom = Freedom::new(&[], None, None);
        let arm = PlannedArm { freedom: &freedom, ..self.arm };
        let (grid, count) = (arm.grid(), self.layers.len());
        let fixed = |layer: &Layer| {
            let mut fixed = Layer::new(layer.pose, layer.time, layer.index, &grid);
            fixed.turn = layer.turn;
            fixed
        };
        let mut layers: Vec<_> = self.layers.iter().map(fixed).collect();
        arm.solve(&grid, &mut layers, 0..count);
        arm.find_crossings(&grid, &mut layers, 1..count);
        let ladder = Ladder {
            grid,
            freedom: &freedom,
            layers: &layers,
            expected: None,
            ends: Ends::default(),
            whole: true,
            node_cost: None,
            ..self.ladder()
        };
        let path = ladder.best_path(0, &mut TurnStates::default())?;
        Ok(path.map_or(f64::INFINITY, |path| path.bottleneck))
    }

    /// A joint path through more poses, smoothed from ramps between the poses of one through some;
    /// `None` where that is refused or its bottleneck larger.
    pub(super) fn smoothed_along(
        &mut self,
        path: &JointPath,
        points: &[Waypoint],
        caller: &mut Caller<'_>,
    ) -> Result<Option<JointPath>, PlanError> {
        let (grid, layers, expected) = (self.grid, self.layers.clone(), self.expected);
        self.follow(path, points, &Values::default())?;
        let ramps = self.best_path(0)?;
        let smooth = match ramps {
            Some(ramps) => self.smoothed_within(&ramps, ramps.bottleneck, &PACES[..2], caller)?,
            None => None,
        };
        if smooth.is_none() {
            (self.grid, self.layers, self.expected) = (grid, layers, expected);
        }
        Ok(smooth)
    }

    /// A joint path with everything that is free smoothed and proven again; `None` where that is
    /// refused or the cost that comes first would be more than `most`.
    fn smoothed_within(
        &mut self,
        path: &JointPath,
        most: f64,
        paces: &[[f64; 2]],
        caller: &mut Caller<'_>,
    ) -> Result<Option<JointPath>, PlanError> {
        // A single layer has no motion, and joints that do not move need none.
        let moves = self.layers.len() > 1 && path.bottleneck > 0.0;
        if !moves {
            return Ok(None);
        }
        let curve = self.curve(path);
        for pace in paces {
            let bottleneck = if self.order == PlanOrder::Sum { path.bottleneck } else { most };
            let mut cost = Roughness::new(self.arm, &self.layers, self.order, bottleneck, *pace);
            cost.is_closed = self.closed;
            let Some(smooth) = cost.smoothed(curve.clone()) else { return Ok(None) };
            let (grid, layers) = self.exchange(path, smooth);
            let smooth = self.path_within(most, caller)?;
            let most = most * (1.0 + BOTTLENECK_ROUNDING);
            if let Some(smooth) = smooth.filter(|smooth| smooth.cost(self.order).0 <= most) {
                return Ok(Some(smooth));
            }
            (self.grid, self.layers) = (grid, layers);
        }
        Ok(None)
    }

    /// A joint path through all layers by what is free, cyclic axes without jumps.
    fn curve(&self, path: &JointPath) -> Curve {
        let mut values: Vec<Values> = Vec::with_capacity(self.layers.len());
        for (layer, node) in self.layers.iter().zip(&path.nodes) {
            let own = layer.values(&self.grid, node.cell);
            let from = values.last().copied();
            values.push(from.map_or(own, |from| self.arm.freedom.between(&from, &own, 1.0)));
        }
        Curve { values, q: path.q.clone() }
    }

    /// Exchange the layers of a joint path for ones with a single cell; return its own.
    fn exchange(&mut self, path: &JointPath, values: Vec<Values>) -> (Grid, Vec<Layer>) {
        let (grid, layers) = (self.grid, core::mem::take(&mut self.layers));
        let along = layers.iter().zip(&path.nodes).zip(values);
        let middles = along.map(|((layer, node), values)| {
            let mut middle = Middle::of(&grid, layer, *node);
            middle.values = values;
            middle
        });
        self.band(middles, &Values::default());
        (grid, layers)
    }
}

impl Roughness<'_> {
    /// The values of everything that is free, smoothed; `None` if nothing is gained.
    ///
    /// Joints move evenly with what is free, then every pose is solved, in turn.
    pub(super) fn smoothed(&self, mut curve: Curve) -> Option<Vec<Values>> {
        let mut has_moved = false;
        for round in 0..ROUNDS {
            if self.arm.interrupt.is_raised() {
                return None;
            }
            let wall = WALLS[round.min(WALLS.len() - 1)];
            let before = self.cost(&curve, wall);
            let even = self.minimum(&curve, wall);
            let Some((next, after)) = self.solved_toward(&curve, &even, wall, before) else {
                break;
            };
            curve = next;
            has_moved = true;
            if round >= WALLS.len() && after > (1.0 - GAIN) * before {
                break;
            }
        }
        let inside = |values: &Values| self.arm.freedom.clamped(values);
        has_moved.then(|| curve.values.iter().map(inside).collect())
    }

    /// The curve that minimizes the cost where joints move evenly with what is free.
    fn minimum(&self, curve: &Curve, wall: f64) -> Curve {
        let derivatives = self.derivatives(curve);
        let (mut curve, mut before) = (curve.clone(), self.cost(curve, wall));
        for _ in 0..STEPS {
            let Some(step) = self.newton_step(&curve, &derivatives, wall) else { break };
            let mut part = 1.0;
            let shortened = (0..HALVINGS).find_map(|_| {
                let next = self.moved(&curve, &derivatives, &step, part);
                let after = self.cost(&next, wall);
                part *= 0.5;
                (after < before).then_some((next, after))
            });
            let Some((next, after)) = shortened else { break };
            let is_done = after > (1.0 - GAIN) * before;
            (curve, before) = (next, after);
            if is_done {
                break;
            }
        }
        curve
    }

    /// A curve after a part of a step, joints moving evenly with what is free.
    fn moved(&self, curve: &Curve, derivatives: &[Derivatives], step: &[f64], part: f64) -> Curve {
        let axes = self.arm.freedom.axes.len();
        let mut next = curve.clone();
        for (layer, step) in step.chunks(axes).enumerate() {
            let Some(derivatives) = &derivatives[layer] else { continue };
            for (axis, step) in step.iter().enumerate() {
                next.values[layer][axis] += part * step;
                for joint in 0..6 {
                    next.q[layer][joint] += part * step * derivatives[joint][axis];
                }
            }
        }
        next
    }

    /// The curve toward another, by as much as decreases the cost, every pose solved; with the
    /// cost.
    fn solved_toward(
        &self,
        curve: &Curve,
        to: &Curve,
        wall: f64,
        before: f64,
    ) -> Option<(Curve, f64)> {
        let mut part = 1.0;
        for _ in 0..HALVINGS {
            let between = |from: &f64, to: &f64| from + part * (to - from);
            let mut next = curve.clone();
            for layer in 0..next.q.len() {
                let (own, to_values) = (&curve.values[layer], &to.values[layer]);
                next.values[layer] =
                    core::array::from_fn(|axis| between(&own[axis], &to_values[axis]));
                let (own, to_q) = (&curve.q[layer], &to.q[layer]);
                next.q[layer] = core::array::from_fn(|joint| between(&own[joint], &to_q[joint]));
            }
            if let Some(q) = self.solved(|layer| next.values[layer], &next.q).into_iter().collect()
            {
                next.q = q;
                let after = self.cost(&next, wall);
                if after < before {
                    return Some((next, after));
                }
            }
            part *= 0.5;
        }
        None
    }

    /// Whether what is free at a layer stays as it is: where joint angles are given, and where a
    /// closed path ends.
    fn is_fixed(&self, layer: usize) -> bool {
        let is_end = layer == 0 || layer + 1 == self.layers.len();
        self.layers[layer].own.is_some() || (self.is_closed && is_end)
    }

    /// The joint angles of each layer with values of the free axes, on the branch of the joint
    /// angles that they are near to; `None` where they are beyond limits, reach or a singularity.
    fn solved(&self, values: impl Fn(usize) -> Values, near: &[[f64; 6]]) -> Vec<Option<[f64; 6]>> {
        let (arm, slots) = (self.arm, self.arm.robot.slot_count());
        let mut solved = Vec::with_capacity(near.len());
        let mut q = vec![0.0; PART * slots * 6];
        let mut status = vec![0; PART * slots];
        for near in near.chunks(PART) {
            let first = solved.len();
            let pose =
                |at: usize| arm.freedom.tool(&self.layers[first + at].pose, &values(first + at));
            let poses: Vec<_> = (0..near.len()).map(|at| pose_to_rows(&pose(at))).collect();
            arm.solve_part(&poses, &mut q, &mut status);
            let rows = q.as_chunks::<6>().0.chunks(slots).zip(status.chunks(slots));
            for (at, (near, (q, status))) in near.iter().zip(rows).enumerate() {
                // A singular pose leaves joint angles free.
                let is_singular = status.iter().any(|bits| bits & SINGULAR.bits() != 0);
                solved.push(if is_singular {
                    arm.robot.ik_nearest(&pose(at), near, &[1.0; 6]).ok().map(|nearest| nearest.q)
                } else {
                    self.nearest(q, near)
                });
            }
        }
        solved
    }

    /// Of the joint angles of the slots of a pose, those nearest to others, turns included; `None`
    /// if they are outside the limits.
    fn nearest(&self, slots: &[[f64; 6]], near: &[f64; 6]) -> Option<[f64; 6]> {
        let mut nearest = (f64::INFINITY, [0.0; 6]);
        for slot in slots.iter().filter(|slot| !slot[0].is_nan()) {
            let q = core::array::from_fn(|joint| nearest_turn(slot[joint], near[joint]));
            let off = largest(&steps(near, &q));
            if off < nearest.0 {
                nearest = (off, q);
            }
        }
        self.arm.joints.contain(&nearest.1).then_some(nearest.1).filter(|_| nearest.0.is_finite())
    }

    /// How the coordinates of each layer change with each free axis; `None` where that is unknown,
    /// and where nothing may change.
    fn derivatives(&self, curve: &Curve) -> Vec<Derivatives> {
        let free = |layer| (!self.is_fixed(layer)).then_some([Values::default(); COORDINATES]);
        let mut derivatives: Vec<_> = (0..self.layers.len()).map(free).collect();
        for axis in 0..self.arm.freedom.axes.len() {
            let by = DIFFERENCE * self.width(axis);
            let moved = |layer: usize| {
                let mut moved = curve.values[layer];
                moved[axis] += by;
                moved
            };
            let moved = self.solved(moved, &curve.q);
            for ((derivatives, moved), q) in derivatives.iter_mut().zip(moved).zip(&curve.q) {
                let Some((own, moved)) = derivatives.as_mut().zip(moved) else {
                    *derivatives = None;
                    continue;
                };
                for joint in 0..6 {
                    own[joint][axis] = (moved[joint] - q[joint]) / by;
                }
                if axis < self.arm.freedom.external {
                    own[6 + axis][axis] = 1.0;
                }
            }
        }
        derivatives
    }
}
