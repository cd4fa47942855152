//! What is free along a joint path, smoothed: the search leaves it on a grid
//! (docs/guide/plan.md, section 5).

use alloc::vec;
use alloc::vec::Vec;

use super::graph::Values;
use super::nodes::{PART, SINGULAR};
use super::roughness::{COORDINATES, Curve, Derivatives, Roughness};
use crate::kinematics::{largest, nearest_turn, pose_to_rows, steps};

/// Weights of the wall of velocities [1], one after the other: first the shape, then the wall.
const WALLS: [f64; 4] = [1e2, 1e3, 1e4, 3e4];

/// How often every pose is solved, and the joints taken as moving evenly from there, at most [1].
const ROUNDS: usize = 8;

/// Newton steps from there, at most [1].
const STEPS: usize = 6;

/// Decrease of the cost below which a search for its minimum is done, relative to it [1].
const GAIN: f64 = 1e-3;

/// How often a step is halved until the cost decreases.
const HALVINGS: usize = 6;

/// Part of a window by which free axes move for derivatives [1].
const DIFFERENCE: f64 = 1e-6;

impl Roughness<'_> {
    /// The values of everything that is free, smoothed; `None` if nothing is gained.
    ///
    /// Joints move evenly with what is free, then every pose is solved, in turn.
    pub(super) fn smoothed(&self, mut curve: Curve) -> Option<Vec<Values>> {
        let mut has_moved = false;
        for round in 0..ROUNDS {
            if !self.arm.watch.goes_on() {
                return None;
            }
            let wall = WALLS[round.min(WALLS.len() - 1)];
            let before = self.cost(&curve, wall);
            let even = self.minimum(&curve, wall);
            let Some((next, after)) = self.solved_toward(&curve, &even, wall, before) else { break };
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

    /// The curve toward another, by as much as decreases the cost, every pose solved; with the cost.
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

    /// The joint angles of each layer with values of the free axes, on the branch of the joint angles
    /// that they are near to; `None` where they are beyond limits, reach or a singularity.
    fn solved(
        &self,
        values: impl Fn(usize) -> Values,
        near: &[[f64; 6]],
    ) -> Vec<Option<[f64; 6]>> {
        let (arm, slots) = (self.arm, self.arm.robot.slot_count());
        let mut solved = Vec::with_capacity(near.len());
        let mut q = vec![0.0; PART * slots * 6];
        let mut status = vec![0; PART * slots];
        for near in near.chunks(PART) {
            let first = solved.len();
            let pose = |at: usize| {
                arm.freedom.tool(&self.layers[first + at].pose, &values(first + at))
            };
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

    /// Of the joint angles of the slots of a pose, those nearest to others, turns included; `None` if
    /// they are outside the limits.
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
