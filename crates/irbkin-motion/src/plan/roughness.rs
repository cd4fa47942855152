//! The cost of a joint path whose free axes are off their grid: velocities, accelerations, walls
//! (docs/theory/plan.md, section 5, eq. 9).

use super::banded::Banded;
use super::graph::{Layer, Values};
use super::nodes::PlannedArm;
use super::options::PlanOrder;
use crate::plan::thresholds::MOST_EXTERNAL;
use crate::prelude::*;

/// Distance from joint limits that smoothing aims at [rad]: walls are soft.
const INSET: f64 = 0.01;

/// Part of a window that smoothing keeps away from its ends [1]: walls are soft.
const INSET_OF_WINDOW: f64 = 0.01;

/// Weight of the walls of windows and limits [1]: so stiff that they hold within the insets.
const WINDOWS: f64 = 1e6;

/// Part of a window that one Newton step may cross [1].
const MOST_STEP: f64 = 0.25;

/// Cost of moving a free axis across its window that holds it where nothing else does [1].
const DAMPING: f64 = 1e-6;

/// Joints, then external axes.
pub(super) const COORDINATES: usize = 6 + MOST_EXTERNAL;

/// How the coordinates of a layer change with each free axis; `None` where they stay as they are.
pub(super) type Derivatives = Option<[Values; COORDINATES]>;

/// A joint path by what is free.
#[derive(Clone)]
pub(super) struct Curve {
    pub(super) values: Vec<Values>,
    pub(super) q: Vec<[f64; 6]>,
}

/// A term of the cost, `weight * value^2`: of a coordinate in one to three layers from one on.
struct Term {
    layer: usize,
    parts: [f64; 3],
    value: f64,
    weight: f64,
}

/// The cost of a curve (eq. 9).
pub(super) struct Roughness<'a> {
    pub(super) arm: PlannedArm<'a>,
    pub(super) layers: &'a [Layer],
    pub(super) is_closed: bool,
    /// Time from layer to layer, parts of the whole time.
    parts: Vec<f64>,
    /// Factor of each coordinate: its velocity, over the whole time, becomes one at its limit.
    scale: [f64; COORDINATES],
    /// How much acceleration counts, a part of the whole time.
    rise: f64,
    /// The velocity that is aimed at.
    aim: f64,
    /// Cost of a node that [`NodeCost`](super::joints::NodeCost) gives as 1.
    of_nodes: f64,
}

impl<'a> Roughness<'a> {
    /// Of curves through all layers at an even pace, for a bottleneck, the part of it that
    /// velocities aim at, and the time in which joints reach their velocity limits [s].
    pub(super) fn new(
        arm: PlannedArm<'a>,
        layers: &'a [Layer],
        order: PlanOrder,
        bottleneck: f64,
        [rise, aim]: [f64; 2],
    ) -> Self {
        let total = layers[layers.len() - 1].time - layers[0].time;
        let parts = layers.windows(2).map(|two| (two[1].time - two[0].time) / total).collect();
        let external = &arm.freedom.axes[..arm.freedom.external];
        let (aim, of_nodes, scale) = match order {
            PlanOrder::Bottleneck => {
                let each =
                    arm.joints.velocity.into_iter().chain(external.iter().map(|a| a.velocity));
                let rates = each.map(|velocity| 1.0 / (velocity * total * bottleneck));
                (aim, 1.0 / (bottleneck * bottleneck), filled(rates))
            }
            PlanOrder::Sum => {
                let each = arm.joints.weights.into_iter().chain(external.iter().map(|a| a.weight));
                (f64::INFINITY, total * total, filled(each.map(|weight| weight.max(0.0).sqrt())))
            }
        };
        // The sum alone leaves no staircase, but kinks at the ends of windows.
        let has_windows = arm.freedom.axes.iter().any(|axis| !axis.is_cyclic);
        let is_smooth = order == PlanOrder::Sum && !has_windows;
        let rise = if is_smooth { 0.0 } else { rise / (bottleneck * total) };
        Self { arm, layers, is_closed: false, parts, scale, rise, aim, of_nodes }
    }

    /// The width of the window of an axis [m, rad].
    pub(super) fn width(&self, axis: usize) -> f64 {
        let [lower, upper] = self.arm.freedom.axes[axis].range;
        upper - lower
    }

    /// The time at a layer, to the nearest layers [1].
    fn part(&self, layer: usize) -> f64 {
        self.parts[layer.min(self.parts.len() - 1)]
    }

    /// The terms of a joint or of an external axis.
    #[inline]
    fn terms(&self, curve: &Curve, number: usize, wall: f64, visit: &mut impl FnMut(Term)) {
        let scale = self.scale[number];
        let at = |layer: usize| match number.checked_sub(6) {
            None => curve.q[layer][number],
            Some(axis) => curve.values[layer][axis],
        };
        let (mut before, mut from) = (0.0, at(0));
        for (layer, part) in self.parts.iter().enumerate() {
            let to = at(layer + 1);
            let value = scale * (to - from) / part;
            let parts = [-1.0 / part, 1.0 / part, 0.0];
            visit(Term { layer, parts, value, weight: *part });
            let over = value.abs() - self.aim;
            if over > 0.0 {
                visit(Term { layer, parts, value: over.copysign(value), weight: wall * part });
            }
            if layer > 0 {
                let [one, other] = [self.parts[layer - 1], *part];
                let mean = 0.5 * (one + other);
                let rise = self.rise / mean;
                let parts = [rise / one, -rise / one - rise / other, rise / other];
                let value = (value - before) * rise;
                visit(Term { layer: layer - 1, parts, value, weight: mean });
            }
            (before, from) = (value, to);
        }
        if number < 6 && !self.arm.joints.is_unlimited(number) {
            let limits = self.arm.joints.limits(number);
            for (layer, q) in curve.q.iter().enumerate() {
                let value = scale * beyond(q[number], limits, INSET);
                if value != 0.0 {
                    let weight = WINDOWS * self.part(layer);
                    visit(Term { layer, parts: [1.0, 0.0, 0.0], value, weight });
                }
            }
        }
    }

    /// How far a layer is beyond the windows of the free axes: how that changes with each of them,
    /// and the value.
    fn windows(&self, curve: &Curve, layer: usize, visit: &mut impl FnMut(Values, f64)) {
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
                visit(along, value);
            }
        }
        let cone = self.arm.freedom.cone;
        let tilt = self.arm.freedom.tilt(values);
        if cone > 0.0 && tilt > (1.0 - INSET_OF_WINDOW) * cone {
            let mut along = Values::default();
            for (axis, own) in self.arm.freedom.axes.iter().enumerate() {
                along[axis] = if own.is_tilt() { values[axis] / (tilt * cone) } else { 0.0 };
            }
            visit(along, tilt / cone - (1.0 - INSET_OF_WINDOW));
        }
    }

    /// The cost of a curve, velocities beyond the aim weighing `wall`.
    pub(super) fn cost(&self, curve: &Curve, wall: f64) -> f64 {
        let mut cost = 0.0;
        for number in 0..6 + self.arm.freedom.external {
            let visit = &mut |term: Term| cost += term.weight * term.value * term.value;
            self.terms(curve, number, wall, visit);
        }
        for layer in 0..curve.q.len() {
            let weight = WINDOWS * self.part(layer);
            self.windows(curve, layer, &mut |_, value| cost += weight * value * value);
        }
        for (layer, q) in curve.q.iter().enumerate().skip(1) {
            cost += self.node_cost(q, layer);
        }
        cost
    }

    fn node_cost(&self, q: &[f64; 6], layer: usize) -> f64 {
        let part = self.parts[layer - 1];
        self.arm.node_cost.map_or(0.0, |cost| self.of_nodes * part * cost.at(q, 1.0))
    }

    /// The step of all free axes that minimizes the cost where joints move evenly with them.
    pub(super) fn newton_step(
        &self,
        curve: &Curve,
        derivatives: &[Derivatives],
        wall: f64,
    ) -> Option<Vec<f64>> {
        let (count, axes) = (self.layers.len(), self.arm.freedom.axes.len());
        let mut matrix = Banded::new(count * axes, 3 * axes - 1);
        let mut step = vec![0.0; count * axes];
        for number in 0..6 + self.arm.freedom.external {
            self.add_coordinate(curve, (number, derivatives), wall, (&mut matrix, &mut step));
        }
        for (layer, derivatives) in derivatives.iter().enumerate() {
            let first = layer * axes;
            for axis in 0..axes {
                let (at, width) = (first + axis, self.width(axis));
                matrix.add([at; 2], DAMPING * self.part(layer) / (width * width));
                match derivatives {
                    None => matrix.add([at; 2], 1.0),
                    Some(derivatives) if layer > 0 && self.arm.node_cost.is_some() => {
                        let [slope, bend] = self.slope(curve, layer, axis, derivatives);
                        matrix.add([at; 2], 0.5 * bend);
                        step[at] -= 0.5 * slope;
                    }
                    Some(_) => {}
                }
            }
            if derivatives.is_some() {
                let weight = WINDOWS * self.part(layer);
                self.windows(curve, layer, &mut |along, value| {
                    for row in 0..axes {
                        step[first + row] -= weight * value * along[row];
                        for column in 0..=row {
                            let amount = weight * along[row] * along[column];
                            matrix.add([first + row, first + column], amount);
                        }
                    }
                });
            }
        }
        matrix.solve(&mut step).then_some(())?;
        let most = |axis: usize| MOST_STEP * self.width(axis);
        let each = step.iter().enumerate().map(|(at, step)| step.abs() / most(at % axes));
        let longest = each.fold(1.0, f64::max);
        for step in &mut step {
            *step /= longest;
        }
        Some(step)
    }

    /// Add the terms of a joint or of an external axis to the equations of a Newton step.
    fn add_coordinate(
        &self,
        curve: &Curve,
        (number, derivatives): (usize, &[Derivatives]),
        wall: f64,
        (matrix, right): (&mut Banded, &mut [f64]),
    ) {
        let (count, axes) = (self.layers.len(), self.arm.freedom.axes.len());
        let mut slopes = vec![0.0; count];
        // Of each layer with itself and with the two after it.
        let mut bends = vec![[0.0; 3]; count];
        self.terms(curve, number, wall, &mut |Term { layer, parts, value, weight }| {
            for (at, part) in parts.into_iter().enumerate().filter(|(_, part)| *part != 0.0) {
                slopes[layer + at] += weight * value * part;
                for (beyond, other) in parts[at..].iter().enumerate() {
                    bends[layer + at][beyond] += weight * part * other;
                }
            }
        });
        let scale = self.scale[number];
        for (layer, own) in derivatives.iter().enumerate() {
            let Some(own) = own.as_ref().map(|own| &own[number]) else { continue };
            for axis in 0..axes {
                right[layer * axes + axis] -= slopes[layer] * scale * own[axis];
            }
            for (beyond, other) in derivatives[layer..].iter().take(3).enumerate() {
                let Some(other) = other.as_ref().map(|other| &other[number]) else { continue };
                let bend = bends[layer][beyond] * scale * scale;
                for row in 0..axes {
                    let last = if beyond == 0 { row + 1 } else { axes };
                    for column in 0..last {
                        let at = [(layer + beyond) * axes + row, layer * axes + column];
                        matrix.add(at, bend * other[row] * own[column]);
                    }
                }
            }
        }
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
            let moved = |joint: usize| derivatives[joint][axis] * by;
            let q = core::array::from_fn(|joint| curve.q[layer][joint] + moved(joint));
            self.node_cost(&q, layer)
        };
        let [below, own, above] = [at(-by), at(0.0), at(by)];
        [(above - below) / (2.0 * by), ((above + below - 2.0 * own) / (by * by)).max(0.0)]
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
