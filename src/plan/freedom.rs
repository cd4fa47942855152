//! What is free at each pose of a path besides the joints: the tool angle, and axes beside it
//! (docs/plan.md, eq. 1).

use alloc::vec::Vec;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Matrix3, Rotation3, Translation3, Vector3};

use super::axis::ToolAxis;
use super::carrier::Carried;
use super::options::{PlanOptions, ToolRotation};
use super::step::Moved;
use crate::kinematics::thresholds::{
    COARSEST_TOOL_STEP, LIMIT_TOLERANCE, MOST_FREE_AXES, REFINED_OFFSET, REFINED_TOOL_STEP,
    REFINED_TRACK,
};
use crate::kinematics::{Pose, nearest_turn};

/// A value of each free axis; 0 beyond those that there are.
pub(super) type Values = [f64; MOST_FREE_AXES];

/// What a free axis does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Motion {
    /// An external axis.
    Carrier(Carried),
    /// The tool is tilted about its first or second other axis.
    Tilt(usize),
    /// The tool is shifted along an axis of the pose.
    Offset(ToolAxis),
}

/// A free axis: its values, and what it costs to move it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FreeAxis {
    pub(super) motion: Motion,
    pub(super) range: [f64; 2],
    pub(super) steps: usize,
    /// Infinite of a tolerance.
    pub(super) velocity: f64,
    pub(super) weight: f64,
}

impl FreeAxis {
    /// The distance of two neighboring values [m, rad].
    pub(super) fn step(&self) -> f64 {
        let [lower, upper] = self.range;
        #[expect(clippy::cast_precision_loss, reason = "a small count")]
        let intervals = (self.steps - 1) as f64;
        (upper - lower) / intervals
    }

    /// The distance to which values are refined [m, rad].
    pub(super) fn finest(&self) -> f64 {
        match self.motion {
            Motion::Carrier(Carried::Robot(_)) => REFINED_TRACK,
            Motion::Offset(_) => REFINED_OFFSET,
            Motion::Carrier(Carried::Object(..)) | Motion::Tilt(_) => REFINED_TOOL_STEP,
        }
    }

    /// Whether moving it turns the tool as seen from the robot.
    pub(super) fn is_rotary(&self) -> bool {
        matches!(self.motion, Motion::Carrier(Carried::Object(..)))
    }
}

/// Everything that is free.
#[derive(Clone, Debug)]
pub(super) struct Freedom {
    pub(super) rotation: Option<ToolRotation>,
    /// External axes, then tolerances.
    pub(super) axes: Vec<FreeAxis>,
    /// Number of external axes.
    pub(super) external: usize,
    /// The largest tilt [rad].
    pub(super) cone: f64,
}

impl Freedom {
    pub(super) fn of(options: &PlanOptions) -> Self {
        let mut axes: Vec<FreeAxis> = options
            .external
            .iter()
            .map(|axis| FreeAxis {
                motion: Motion::Carrier(axis.carried()),
                range: axis.range(),
                steps: axis.steps(),
                velocity: axis.max_velocity(),
                weight: axis.weight(),
            })
            .collect();
        let tolerance = |motion, range, steps| FreeAxis {
            motion,
            range,
            steps,
            velocity: f64::INFINITY,
            weight: 0.0,
        };
        if let Some(cone) = options.cone {
            let range = [-cone.angle(), cone.angle()];
            axes.extend([0, 1].map(|axis| tolerance(Motion::Tilt(axis), range, cone.steps())));
        }
        if let Some(offset) = options.offset {
            axes.push(tolerance(Motion::Offset(offset.axis()), offset.range(), offset.steps()));
        }
        let cone = options.cone.map_or(0.0, |cone| cone.angle());
        Self { rotation: options.rotation, axes, external: options.external.len(), cone }
    }

    /// The same with tool angles that are at least ten degrees apart, for a first search.
    pub(super) fn coarser(&self) -> Self {
        let rotation = self.rotation.map(|rotation| rotation.coarser(COARSEST_TOOL_STEP));
        Self { rotation, axes: self.axes.clone(), ..*self }
    }

    /// The axis in which the tool points.
    fn pointing(&self) -> ToolAxis {
        self.rotation.map_or(ToolAxis::Z, |rotation| rotation.axis())
    }

    /// A pose of the path seen from the robot, its external axes at their values.
    pub(super) fn carried(&self, pose: &Pose, values: &Values) -> Pose {
        let mut pose = *pose;
        // The object first, from the axis that holds it on; then the robot.
        for carries_object in [true, false] {
            for (axis, value) in self.axes[..self.external].iter().zip(values).rev() {
                if let Motion::Carrier(carried) = axis.motion
                    && axis.is_rotary() == carries_object
                {
                    pose = carried.seen(&pose, *value);
                }
            }
        }
        pose
    }

    /// The pose of the tool, its own angle left out (eq. 1).
    pub(super) fn placed(&self, pose: &Pose, values: &Values) -> Pose {
        if self.axes.is_empty() {
            return *pose;
        }
        let mut placed = self.carried(pose, values);
        let mut tilt = Vector3::zeros();
        for (axis, value) in self.axes.iter().zip(values) {
            match axis.motion {
                Motion::Carrier(_) => {}
                Motion::Tilt(number) => tilt[self.pointing().others()[number]] = *value,
                Motion::Offset(axis) => {
                    let direction = placed.rotation.matrix().column(axis.index()).into_owned();
                    placed.translation =
                        Translation3::from(placed.translation.vector + direction * *value);
                }
            }
        }
        if self.cone > 0.0 {
            placed.rotation *= Rotation3::new(tilt);
        }
        placed
    }

    /// A placed pose, turned by a tool angle of which sine and cosine are given.
    pub(super) fn turned(&self, placed: &Pose, (sin, cos): (f64, f64)) -> Pose {
        let Some(rotation) = self.rotation else { return *placed };
        let [first, second] = rotation.axis().others();
        let own = placed.rotation.matrix();
        let mut turned: Matrix3<f64> = *own;
        let (one, two) = (own.column(first), own.column(second));
        turned.set_column(first, &(one * cos + two * sin));
        turned.set_column(second, &(two * cos - one * sin));
        Pose::from_parts(placed.translation, Rotation3::from_matrix_unchecked(turned))
    }

    /// The pose of the tool with everything that is free (eq. 1).
    pub(super) fn tool(&self, pose: &Pose, values: &Values, angle: f64) -> Pose {
        self.turned(&self.placed(pose, values), angle.sin_cos())
    }

    /// What moving the axes costs in a time [s] (eq. 4).
    pub(super) fn moved(&self, time: f64, from: &Values, to: &Values) -> Moved {
        let mut moved = Moved::default();
        for (axis, (from, to)) in self.axes.iter().zip(from.iter().zip(to)) {
            let step = to - from;
            moved.most = moved.most.max(step.abs() / (axis.velocity * time));
            moved.squares += axis.weight * (step * step);
        }
        moved
    }

    /// Whether values are inside their ranges.
    pub(super) fn allows(&self, values: &Values) -> bool {
        let mut ranges = self.axes.iter().zip(values).map(|(axis, value)| (axis.range, *value));
        ranges.all(|([lower, upper], value)| {
            value >= lower - LIMIT_TOLERANCE && value <= upper + LIMIT_TOLERANCE
        }) && self.tilt(values) <= self.cone + LIMIT_TOLERANCE
    }

    /// How far the tool is tilted [rad].
    pub(super) fn tilt(&self, values: &Values) -> f64 {
        let axes = self.axes.iter().zip(values);
        let tilts = axes.filter(|(axis, _)| matches!(axis.motion, Motion::Tilt(_)));
        tilts.map(|(_, value)| value * value).sum::<f64>().sqrt()
    }

    /// The tool angle and the values of the tolerances with which a pose of the path, its external
    /// axes at `values`, comes nearest to a pose of the tool.
    pub(super) fn found(&self, pose: &Pose, tool: &Pose, mut values: Values) -> (f64, Values) {
        let carried = self.carried(pose, &values);
        let relative = carried.rotation.inverse() * tool.rotation;
        let [first, second] = self.pointing().others();
        let matrix = relative.matrix();
        let sin = matrix[(second, first)] - matrix[(first, second)];
        let angle = sin.atan2(matrix[(first, first)] + matrix[(second, second)]);
        let angle = if self.rotation.is_some() { angle } else { 0.0 };
        let mut about = Vector3::zeros();
        about[self.pointing().index()] = -angle;
        let tilt = (relative * Rotation3::new(about)).scaled_axis();
        let shift =
            carried.rotation.inverse() * (tool.translation.vector - carried.translation.vector);
        for (axis, value) in self.axes.iter().zip(&mut values) {
            match axis.motion {
                Motion::Carrier(_) => {}
                Motion::Tilt(number) => *value = tilt[[first, second][number]],
                Motion::Offset(axis) => *value = shift[axis.index()],
            }
        }
        (angle, values)
    }

    /// The angle by which the tool turns from one tool angle to another: of a full circle, the
    /// shorter way round.
    pub(super) fn angle_step(&self, from: f64, to: f64) -> f64 {
        match self.rotation {
            Some(rotation) if rotation.is_full() => nearest_turn(to - from, 0.0),
            _ => to - from,
        }
    }

    /// What a tool angle may be [rad]; `None` of a full turn.
    pub(super) fn angles(&self) -> Option<[f64; 2]> {
        let rotation = self.rotation.filter(|rotation| !rotation.is_full())?;
        let [lower, upper] = rotation.range();
        Some([lower - LIMIT_TOLERANCE, upper + LIMIT_TOLERANCE])
    }
}
