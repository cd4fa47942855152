//! Axes that are free at each pose of a path besides the joints (docs/theory/plan.md, eq. 1).

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::axes::{Carried, ExternalAxis, ToolAxis, ToolCone, ToolRotation};
use super::graph::{Grid, Moved, Values};
use crate::plan::thresholds::{MOST_FREE_AXES, REFINED_TOOL_STEP, REFINED_TRACK};
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::thresholds::LIMIT_TOLERANCE;
use irbkin::internal::{nearest_turn, rotation_vector};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Motion {
    /// An external axis.
    Carrier(Carried),
    /// The tool is tilted about its first or second other axis.
    Tilt(usize),
    /// The tool is turned about one of its axes.
    Rotation(ToolAxis),
}

/// A free axis: its values, and the cost of moving it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FreeAxis {
    pub(super) motion: Motion,
    pub(super) range: [f64; 2],
    pub(super) steps: usize,
    /// Whether the last value is next to the first: a full turn.
    pub(super) is_cyclic: bool,
    /// Infinite of a tolerance and of the tool angle.
    pub(super) velocity: f64,
    pub(super) weight: f64,
}

impl FreeAxis {
    /// An axis of the tool, which costs nothing.
    fn of_tool(motion: Motion, range: [f64; 2], steps: usize) -> Self {
        Self { motion, range, steps, is_cyclic: false, velocity: f64::INFINITY, weight: 0.0 }
    }

    /// The distance of two neighboring values [m, rad]; 0 of a single value.
    pub(super) fn step(&self) -> f64 {
        let [lower, upper] = self.range;
        let intervals = if self.is_cyclic { self.steps } else { self.steps - 1 };
        #[expect(clippy::cast_precision_loss, reason = "a small count")]
        let step = (upper - lower) / intervals.max(1) as f64;
        step
    }

    /// The distance to which values are refined [m, rad].
    pub(super) fn finest(&self) -> f64 {
        match self.motion {
            Motion::Carrier(Carried::Robot(_)) => REFINED_TRACK,
            _ => REFINED_TOOL_STEP,
        }
    }

    pub(super) fn is_rotation(&self) -> bool {
        matches!(self.motion, Motion::Rotation(_))
    }

    pub(super) fn is_tilt(&self) -> bool {
        matches!(self.motion, Motion::Tilt(_))
    }

    /// The difference of two values [m, rad]: of a full turn, the shorter way round.
    pub(super) fn difference(&self, from: f64, to: f64) -> f64 {
        if self.is_cyclic { nearest_turn(to - from, 0.0) } else { to - from }
    }
}

#[derive(Clone, Debug)]
pub(super) struct Freedom {
    /// External axes, then tolerances, then the tool angle.
    pub(super) axes: Vec<FreeAxis>,
    /// Number of external axes.
    pub(super) external: usize,
    /// The largest tilt [rad].
    pub(super) cone: f64,
}

impl Freedom {
    pub(super) fn new(
        external: &[ExternalAxis],
        cone: Option<ToolCone>,
        rotation: Option<ToolRotation>,
    ) -> Self {
        let carrier = |axis: &ExternalAxis| FreeAxis {
            velocity: axis.max_velocity(),
            weight: axis.weight(),
            ..FreeAxis::of_tool(Motion::Carrier(axis.carried), axis.range(), axis.steps())
        };
        let mut axes: Vec<FreeAxis> = external.iter().map(carrier).collect();
        if let Some(cone) = cone {
            let range = [-cone.angle(), cone.angle()];
            let tilt = |axis| FreeAxis::of_tool(Motion::Tilt(axis), range, cone.steps());
            axes.extend([0, 1].map(tilt));
        }
        if let Some(rotation) = rotation {
            let (motion, steps) = (Motion::Rotation(rotation.axis()), rotation.steps());
            let axis = FreeAxis::of_tool(motion, rotation.range(), steps);
            axes.push(FreeAxis { is_cyclic: rotation.is_full(), ..axis });
        }
        let cone = cone.map_or(0.0, |cone| cone.angle());
        Self { axes, external: external.len(), cone }
    }

    /// The tool as the path gives it, or as near to that as it may be.
    pub(super) fn with_fixed_tool(mut self) -> Self {
        for axis in &mut self.axes[self.external..] {
            let fixed = 0.0_f64.clamp(axis.range[0], axis.range[1]);
            (axis.range, axis.steps, axis.is_cyclic) = ([fixed; 2], 1, false);
        }
        self
    }

    pub(super) fn grid(&self, slots: usize) -> Grid {
        let (mut counts, mut cyclic) = ([1; MOST_FREE_AXES], [false; MOST_FREE_AXES]);
        let mut steps = Values::default();
        for (axis, own) in self.axes.iter().enumerate() {
            (counts[axis], steps[axis], cyclic[axis]) = (own.steps, own.step(), own.is_cyclic);
        }
        Grid::new(slots, counts, steps, cyclic)
    }

    /// The values of the first cell of the whole grid.
    pub(super) fn first(&self) -> Values {
        let mut first = Values::default();
        for (first, axis) in first.iter_mut().zip(&self.axes) {
            *first = axis.range[0];
        }
        first
    }

    /// Which axis is the tool angle.
    pub(super) fn rotation(&self) -> Option<usize> {
        self.axes.iter().position(FreeAxis::is_rotation)
    }

    /// The axis in which the tool points.
    fn pointing(&self) -> ToolAxis {
        match self.axes.last() {
            Some(FreeAxis { motion: Motion::Rotation(axis), .. }) => *axis,
            _ => ToolAxis::Z,
        }
    }

    /// A pose of the path seen from the robot, its external axes at their values.
    pub(super) fn carried(&self, pose: &Pose, values: &Values) -> Pose {
        // The object first, from the axis that holds it on; then the robot, and its first joint.
        let pose = self.seen(pose, values, |carried| matches!(carried, Carried::Object(..)));
        let pose = self.seen(&pose, values, |carried| matches!(carried, Carried::Robot(_)));
        self.seen(&pose, values, |carried| matches!(carried, Carried::Arm(..)))
    }

    /// A pose seen from behind some of the external axes.
    fn seen(&self, pose: &Pose, values: &Values, is_one: impl Fn(&Carried) -> bool) -> Pose {
        let mut pose = *pose;
        for (axis, value) in self.axes[..self.external].iter().zip(values).rev() {
            if let Motion::Carrier(carried) = axis.motion
                && is_one(&carried)
            {
                pose = carried.seen(&pose, *value);
            }
        }
        pose
    }

    /// The pose that the six joints give the tool with everything that is free (eq. 1).
    pub(super) fn tool(&self, pose: &Pose, values: &Values) -> Pose {
        let mut tool = self.carried(pose, values);
        let mut tilt = Vector3::zeros();
        for (axis, value) in self.axes.iter().zip(values) {
            if let Motion::Tilt(number) = axis.motion {
                tilt[self.pointing().others()[number]] = *value;
            }
        }
        if self.cone > 0.0 {
            tool.rotation *= Rotation3::new(tilt);
        }
        if let Some(rotation) = self.rotation() {
            tool.rotation = turned(&tool.rotation, self.pointing(), values[rotation]);
        }
        self.seen(&tool, values, |carried| matches!(carried, Carried::Tool(..)))
    }

    /// The cost of moving the axes in a time [s] (eq. 4).
    pub(super) fn moved(&self, time: f64, from: &Values, to: &Values) -> Moved {
        let mut moved = Moved::default();
        for (axis, (from, to)) in self.axes[..self.external].iter().zip(from.iter().zip(to)) {
            let step = to - from;
            moved.most = moved.most.max(step.abs() / (axis.velocity * time));
            moved.squares += axis.weight * (step * step);
        }
        moved
    }

    pub(super) fn allows(&self, values: &Values) -> bool {
        self.axes.iter().zip(values).all(|(axis, value)| {
            let [lower, upper] = axis.range;
            axis.is_cyclic || (lower - LIMIT_TOLERANCE..=upper + LIMIT_TOLERANCE).contains(value)
        }) && self.tilt(values) <= self.cone + LIMIT_TOLERANCE
    }

    pub(super) fn clamped(&self, values: &Values) -> Values {
        let mut clamped = *values;
        let shorter = (self.cone / self.tilt(values)).min(1.0);
        for (axis, value) in self.axes.iter().zip(&mut clamped) {
            if axis.is_tilt() {
                *value *= shorter;
            } else if !axis.is_cyclic {
                *value = value.clamp(axis.range[0], axis.range[1]);
            }
        }
        clamped
    }

    /// How far the tool is tilted [rad].
    pub(super) fn tilt(&self, values: &Values) -> f64 {
        if self.cone == 0.0 {
            return 0.0;
        }
        let axes = self.axes.iter().zip(values);
        let tilts = axes.filter(|(axis, _)| axis.is_tilt());
        tilts.map(|(_, value)| value * value).sum::<f64>().sqrt()
    }

    /// The values of the tolerances and of the tool angle with which a pose of the path, its
    /// external axes at `values`, comes nearest to a pose of the tool.
    pub(super) fn nearest(&self, pose: &Pose, tool: &Pose, mut values: Values) -> Values {
        let carried = self.carried(pose, &values);
        let back = core::array::from_fn(|axis| -values[axis]);
        let tool = self.seen(tool, &back, |carried| matches!(carried, Carried::Tool(..)));
        let relative = carried.rotation.inverse() * tool.rotation;
        let [first, second] = self.pointing().others();
        let matrix = relative.matrix();
        let sin = matrix[(second, first)] - matrix[(first, second)];
        let angle = sin.atan2(matrix[(first, first)] + matrix[(second, second)]);
        let angle = if self.rotation().is_some() { angle } else { 0.0 };
        let mut about = Vector3::zeros();
        about[self.pointing() as usize] = -angle;
        let tilt = rotation_vector(&(relative * Rotation3::new(about)));
        for (axis, value) in self.axes.iter().zip(&mut values) {
            match axis.motion {
                Motion::Carrier(_) => {}
                Motion::Tilt(number) => *value = tilt[[first, second][number]],
                Motion::Rotation(_) => *value = angle,
            }
        }
        values
    }

    /// The values at a part of the distance between two, 0 to 1.
    pub(super) fn between(&self, from: &Values, to: &Values, part: f64) -> Values {
        let mut values = *from;
        for (axis, own) in self.axes.iter().enumerate() {
            values[axis] += part * own.difference(from[axis], to[axis]);
        }
        values
    }
}

fn turned(rotation: &Rotation3<f64>, axis: ToolAxis, angle: f64) -> Rotation3<f64> {
    let [first, second] = axis.others();
    let (sin, cos) = angle.sin_cos();
    let own = rotation.matrix();
    let mut turned: Matrix3<f64> = *own;
    let (one, two) = (own.column(first), own.column(second));
    turned.set_column(first, &(one * cos + two * sin));
    turned.set_column(second, &(two * cos - one * sin));
    Rotation3::from_matrix_unchecked(turned)
}
