//! What is free along a joint path, smoothed: the search leaves it on a grid
//! (docs/guide/plan.md, section 5, eq. 9).

use alloc::vec;
use alloc::vec::Vec;

use super::banded::Banded;
use super::best::JointPath;
use super::graph::{Layer, Values};
use super::nodes::Arm;
use super::options::PlanOrder;
use crate::kinematics::thresholds::{MOST_EXTERNAL, MOST_FREE_AXES};

/// Part of the bottleneck that smoothed velocities aim at [1]: walls are soft.
const AIM: f64 = 0.95;

/// Distance from joint limits that smoothing aims at [rad]: walls are soft.
const INSET: f64 = 0.01;

/// Part of a window that smoothing keeps away from its ends [1]: walls are soft.
const INSET_OF_WINDOW: f64 = 0.05;

/// Weight of the walls of windows and limits [1].
const WINDOWS: f64 = 1e4;

/// Weights of the wall of velocities [1], one after the other: first the shape, then the wall.
const WALLS: [f64; 4] = [1e2, 1e3, 1e4, 3e4];

/// Newton steps with each weight of walls, at most [1].
const ROUNDS: usize = 3;

/// Decrease of the cost below which a weight of walls is done with, relative to it [1].
const GAIN: f64 = 1e-3;

/// How often a Newton step is halved until the cost decreases.
const HALVINGS: usize = 6;

/// Part of a window that one Newton step may cross [1].
const MOST_STEP: f64 = 0.25;

/// Part of a window by which free axes move for derivatives [1].
const DIFFERENCE: f64 = 1e-6;

/// Cost of moving a free axis across its window that holds it where nothing else does [1].
const DAMPING: f64 = 1e-6;

/// Joints, then external axes.
const COORDINATES: usize = 6 + MOST_EXTERNAL;

/// How a term depends on the free axes.
#[derive(Clone, Copy)]
enum Along {
    /// As a joint or an external axis does.
    Coordinate(usize),
    /// Directly.
    Axes(Values),
}

/// A term of the cost, `weight * value^2`: of one to three layers from one on.
struct Term {
    layer: usize,
    parts: [f64; 3],
    along: Along,
    value: f64,
    weight: f64,
}

/// A joint path by what is free.
#[derive(Clone)]
struct Curve {
    values: Vec<Values>,
    q: Vec<[f64; 6]>,
}

/// The cost of a curve (eq. 9).
pub(super) struct Smoothing<'a> {
    arm: Arm<'a>,
    layers: &'a [Layer],
    /// Time from layer to layer, parts of the whole time.
    parts: Vec<f64>,
    /// Factor of each coordinate that makes its velocity one relative to the bottleneck.
    scale: [f64; COORDINATES],
    /// The velocity that is aimed at.
    most: f64,
    /// The whole time if the bottleneck is as fast as it may be [s].
    least: f64,
    /// How much acceleration counts, as a part of that time.
    rise: f64,
    is_closed: bool,
    /// Cost of a node that [`NodeCost`](super::joints::NodeCost) gives as 1.
    of_nodes: f64,
}

impl<'a> Smoothing<'a> {
    /// Of a joint path through all layers.
    pub(super) fn new(
        arm: Arm<'a>,
        layers: &'a [Layer],
        path: &JointPath,
        order: PlanOrder,
        is_closed: bool,
    ) -> Self {
        let total = layers[layers.len() - 1].time - layers[0].time;
        let parts = layers.windows(2).map(|two| (two[1].time - two[0].time) / total).collect();
        let external = &arm.freedom.axes[..arm.freedom.external];
        let (most, of_nodes, scale) = match order {
            PlanOrder::Bottleneck => {
                let each =
                    arm.joints.velocity.into_iter().chain(external.iter().map(|a| a.velocity));
                let rates = each.map(|velocity| 1.0 / (velocity * total * path.bottleneck));
                (AIM, 1.0 / (path.bottleneck * path.bottleneck), filled(rates))
            }
            PlanOrder::Sum => {
                let each = arm.joints.weights.into_iter().chain(external.iter().map(|a| a.weight));
                (f64::INFINITY, total * total, filled(each.map(f64::sqrt)))
            }
        };
        let least = path.bottleneck * total;
        Self { arm, layers, parts, scale, most, least, rise: 0.0, is_closed, of_nodes }
    }

    /// The values of everything that is free, smoothed for joints that reach their velocity limits
    /// in a time `rise` [s]; `None` if nothing is gained.
    pub(super) fn smoothed(
        mut self,
        rise: f64,
        values: Vec<Values>,
        q: Vec<[f64; 6]>,
    ) -> Option<Vec<Values>> {
        self.rise = rise / self.least;
        let mut curve = Curve { values, q };
        let mut has_moved = false;
        for wall in WALLS {
            for _ in 0..ROUNDS {
                if !self.arm.watch.goes_on() {
                    return None;
                }
                let before = self.cost(&curve, wall);
                let Some(step) = self.newton_step(&curve, wall) else { break };
                let Some((next, after)) = self.shortened(&curve, &step, wall, before) else {
                    break;
                };
                curve = next;
                has_moved = true;
                if after > (1.0 - GAIN) * before {
                    break;
                }
            }
        }
        let inside = |values: &Values| self.arm.freedom.clamped(values);
        has_moved.then(|| curve.values.iter().map(inside).collect())
    }

    /// The width of the window of an axis [m, rad].
    fn width(&self, axis: usize) -> f64 {
        let [lower, upper] = self.arm.freedom.axes[axis].range;
        upper - lower
    }

    /// Whether what is free at a layer stays as it is: where joint angles are given, and where a
    /// closed path ends.
    fn is_fixed(&self, layer: usize) -> bool {
        let is_end = layer == 0 || layer + 1 == self.layers.len();
        self.layers[layer].own.is_some() || (self.is_closed && is_end)
    }

    fn coordinate(&self, curve: &Curve, layer: usize, number: usize) -> f64 {
        let own = match number.checked_sub(6) {
            None => curve.q[layer][number],
            Some(axis) => curve.values[layer][axis],
        };
        self.scale[number] * own
    }

    fn terms(&self, curve: &Curve, wall: f64, visit: &mut impl FnMut(Term)) {
        let count = self.layers.len();
        for number in 0..6 + self.arm.freedom.external {
            let along = Along::Coordinate(number);
            let mut before = 0.0;
            for layer in 0..count - 1 {
                let part = self.parts[layer];
                let step = self.coordinate(curve, layer + 1, number)
                    - self.coordinate(curve, layer, number);
                let value = step / part;
                let parts = [-1.0 / part, 1.0 / part, 0.0];
                visit(Term { layer, parts, along, value, weight: part });
                let over = value.abs() - self.most;
                if over > 0.0 {
                    let value = over.copysign(value);
                    visit(Term { layer, parts, along, value, weight: wall * part });
                }
                if layer > 0 {
                    let [one, other] = [self.parts[layer - 1], part];
                    let mean = 0.5 * (one + other);
                    let scale = self.rise / mean;
                    let parts = [scale / one, -scale / one - scale / other, scale / other];
                    let term = (value - before) * scale;
                    visit(Term { layer: layer - 1, parts, along, value: term, weight: mean });
                }
                before = value;
            }
        }
        for layer in 0..count {
            let weight = WINDOWS * self.parts[layer.min(count - 2)];
            self.window_terms(curve, layer, weight, visit);
        }
    }

    /// How far a layer is beyond the windows of the free axes and the limits of the joints.
    fn window_terms(&self, curve: &Curve, layer: usize, weight: f64, visit: &mut impl FnMut(Term)) {
        let parts = [1.0, 0.0, 0.0];
        let values = &curve.values[layer];
        for (axis, own) in self.arm.freedom.axes.iter().enumerate() {
            if own.is_cyclic || own.is_tilt() {
                continue;
            }
            let width = self.width(axis);
            let value = beyond(values[axis], own.range, INSET_OF_WINDOW * width) / width;
            if value != 0.0 {
                let mut along = Values::default();
                along[axis] = 1.0 / width;
                visit(Term { layer, parts, along: Along::Axes(along), value, weight });
            }
        }
        let cone = self.arm.freedom.cone;
        let tilt = self.arm.freedom.tilt(values);
        if cone > 0.0 && tilt > (1.0 - INSET_OF_WINDOW) * cone {
            let mut along = Values::default();
            for (axis, own) in self.arm.freedom.axes.iter().enumerate() {
                along[axis] = if own.is_tilt() { values[axis] / (tilt * cone) } else { 0.0 };
            }
            let value = tilt / cone - (1.0 - INSET_OF_WINDOW);
            visit(Term { layer, parts, along: Along::Axes(along), value, weight });
        }
        for joint in (0..6).filter(|joint| !self.arm.joints.is_unlimited(*joint)) {
            let value = beyond(curve.q[layer][joint], self.arm.joints.limits(joint), INSET);
            if value != 0.0 {
                let value = value * self.scale[joint];
                visit(Term { layer, parts, along: Along::Coordinate(joint), value, weight });
            }
        }
    }

    fn cost(&self, curve: &Curve, wall: f64) -> f64 {
        let mut cost = 0.0;
        self.terms(curve, wall, &mut |term| cost += term.weight * term.value * term.value);
        for (layer, q) in curve.q.iter().enumerate().skip(1) {
            cost += self.node_cost(q, layer);
        }
        cost
    }

    fn node_cost(&self, q: &[f64; 6], layer: usize) -> f64 {
        let part = self.parts[layer - 1];
        self.arm.node_cost.map_or(0.0, |cost| self.of_nodes * part * cost.at(q, 1.0))
    }

    /// The joint angles nearest to `q` at a layer with values of the free axes.
    fn solved(&self, layer: usize, values: &Values, q: &[f64; 6]) -> Option<[f64; 6]> {
        let pose = self.arm.freedom.tool(&self.layers[layer].pose, values);
        Some(self.arm.robot.ik_nearest(&pose, q, &[1.0; 6]).ok()?.q)
    }

    /// How the coordinates of a layer change with each free axis; `None` where that is unknown.
    fn derivatives(&self, curve: &Curve, layer: usize) -> Option<[Values; COORDINATES]> {
        let mut derivatives = [Values::default(); COORDINATES];
        let (values, q) = (&curve.values[layer], &curve.q[layer]);
        for axis in 0..self.arm.freedom.axes.len() {
            let by = DIFFERENCE * self.width(axis);
            let moved = [by, -by].into_iter().find_map(|by| {
                let mut moved = *values;
                moved[axis] += by;
                Some((by, self.solved(layer, &moved, q)?))
            });
            let (by, moved) = moved?;
            for joint in 0..6 {
                derivatives[joint][axis] = self.scale[joint] * (moved[joint] - q[joint]) / by;
            }
            if axis < self.arm.freedom.external {
                derivatives[6 + axis][axis] = self.scale[6 + axis];
            }
        }
        Some(derivatives)
    }

    /// The step of all free axes that minimizes the cost where joints move evenly with them.
    fn newton_step(&self, curve: &Curve, wall: f64) -> Option<Vec<f64>> {
        let (count, axes) = (self.layers.len(), self.arm.freedom.axes.len());
        let derivatives: Vec<_> = (0..count)
            .map(|layer| if self.is_fixed(layer) { None } else { self.derivatives(curve, layer) })
            .collect();
        let mut matrix = Banded::new(count * axes, 3 * axes - 1);
        let mut step = vec![0.0; count * axes];
        self.terms(curve, wall, &mut |Term { layer, parts, along, value, weight }| {
            let mut row = [0.0; 3 * MOST_FREE_AXES];
            let mut length = 0;
            for (at, part) in parts.iter().enumerate().filter(|(_, part)| **part != 0.0) {
                length = (at + 1) * axes;
                let Some(derivatives) = &derivatives[layer + at] else { continue };
                let along = match along {
                    Along::Coordinate(number) => &derivatives[number],
                    Along::Axes(ref along) => along,
                };
                for axis in 0..axes {
                    row[at * axes + axis] = part * along[axis];
                }
            }
            matrix.add(layer * axes, &row[..length], weight);
            for (step, own) in step[layer * axes..].iter_mut().zip(&row[..length]) {
                *step -= weight * value * own;
            }
        });
        for layer in 0..count {
            for axis in 0..axes {
                let (at, width) = (layer * axes + axis, self.width(axis));
                let part = self.parts[layer.min(count - 2)];
                matrix.damp(at, DAMPING * part / (width * width));
                match &derivatives[layer] {
                    None => matrix.damp(at, 1.0),
                    Some(derivatives) if layer > 0 && self.arm.node_cost.is_some() => {
                        let [slope, bend] = self.slope(curve, layer, axis, derivatives);
                        matrix.damp(at, 0.5 * bend);
                        step[at] -= 0.5 * slope;
                    }
                    Some(_) => {}
                }
            }
        }
        let most = |axis: usize| MOST_STEP * self.width(axis);
        matrix.solve(&mut step).then_some(())?;
        let each = step.iter().enumerate().map(|(at, step)| step.abs() / most(at % axes));
        let longest = each.fold(1.0, f64::max);
        step.iter_mut().for_each(|step| *step /= longest);
        Some(step)
    }

    /// How the cost of a node changes with a free axis, and how that changes if it grows.
    fn slope(
        &self,
        curve: &Curve,
        layer: usize,
        axis: usize,
        derivatives: &[Values; COORDINATES],
    ) -> [f64; 2] {
        /// Part of a window [1]: across the kinks of margins.
        const BY: f64 = 1e-3;
        let by = BY * self.width(axis);
        let at = |by: f64| {
            let moved = |joint: usize| derivatives[joint][axis] / self.scale[joint] * by;
            let q = core::array::from_fn(|joint| curve.q[layer][joint] + moved(joint));
            self.node_cost(&q, layer)
        };
        let [below, own, above] = [at(-by), at(0.0), at(by)];
        [(above - below) / (2.0 * by), ((above + below - 2.0 * own) / (by * by)).max(0.0)]
    }

    /// A step, halved until the cost decreases, with the cost.
    fn shortened(
        &self,
        curve: &Curve,
        step: &[f64],
        wall: f64,
        before: f64,
    ) -> Option<(Curve, f64)> {
        let axes = self.arm.freedom.axes.len();
        let mut part = 1.0;
        for _ in 0..HALVINGS {
            let mut next = curve.clone();
            for (values, step) in next.values.iter_mut().zip(step.chunks(axes)) {
                for (value, step) in values.iter_mut().zip(step) {
                    *value += part * step;
                }
            }
            let is_solved = (0..self.layers.len()).all(|layer| {
                let solved = self.solved(layer, &next.values[layer], &curve.q[layer]);
                solved.map(|q| next.q[layer] = q).is_some()
            });
            let after = if is_solved { self.cost(&next, wall) } else { f64::INFINITY };
            if after < before {
                return Some((next, after));
            }
            part *= 0.5;
        }
        None
    }
}

/// How far a value is beyond a range that is smaller by an inset on each side.
fn beyond(value: f64, [lower, upper]: [f64; 2], inset: f64) -> f64 {
    (value - upper + inset).max(0.0) + (value - lower - inset).min(0.0)
}

/// Factors, zeros beyond the last.
fn filled(each: impl Iterator<Item = f64>) -> [f64; COORDINATES] {
    let mut filled = [0.0; COORDINATES];
    filled.iter_mut().zip(each).for_each(|(filled, own)| *filled = own);
    filled
}
