//! `irbkin.paths`: paths of the tool as poses.

use numpy::{PyArray3, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyString;

use super::arguments::{read_orientation, read_steps};
use super::arrays::{matrix4, vector};
use super::errors::{Fault, to_py};
use super::paths::read_path_poses;
use crate::error::Error;
use crate::kinematics::{Pose, pose_from_rows, pose_to_rows};
use crate::paths::{Spacing, Zone};

type PoseArray<'py> = Bound<'py, PyArray3<f64>>;

/// Poses as an array of shape (m, 4, 4).
fn pose_rows(py: Python<'_>, poses: Result<Vec<Pose>, Error>) -> PyResult<PoseArray<'_>> {
    let poses = poses.map_err(|error| to_py(py, &error))?;
    let rows: Vec<f64> = poses.iter().flat_map(pose_to_rows).collect();
    numpy::PyArray1::from_vec(py, rows).reshape([poses.len(), 4, 4])
}

/// One pose of shape (4, 4), named in what is wrong with it.
fn read_end(value: &Bound<'_, PyAny>, field: &'static str) -> PyResult<Pose> {
    let rows = matrix4(value, field, Fault::Pose)?;
    let located = |error| Fault::Pose.error(value.py(), format!("{field}: {error}"));
    pose_from_rows(&rows).map_err(located)
}

/// How the poses of a path are spaced, by the arguments that every function takes: `steps` poses;
/// steps of at most `step` [m] and `turn` [rad]; or those that `speed` [m/s] makes in `dt` [s].
struct SpacingArguments<'a, 'py> {
    steps: Option<&'a Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
}

impl SpacingArguments<'_, '_> {
    fn read(&self, py: Python<'_>) -> PyResult<Spacing> {
        let turn = self.turn.unwrap_or(f64::INFINITY);
        let spacing = match (self.steps, self.step, self.turn, self.speed, self.dt) {
            (Some(steps), None, None, None, None) => Spacing::count(read_steps(steps)?),
            (None, Some(step), _, None, None) => Spacing::step(step, turn),
            (None, None, Some(turn), None, None) => Spacing::step(f64::INFINITY, turn),
            (None, None, _, Some(speed), Some(dt)) => Spacing::speed(speed, dt, turn),
            _ => {
                return Err(PyValueError::new_err(
                    "give steps, or step [m] and turn [rad], or speed [m/s] with dt [s]",
                ));
            }
        };
        spacing.map_err(|error| to_py(py, &error))
    }
}

/// Move the tool on a straight line, its orientation turning evenly about one axis (slerp).
///
/// Args:
///     T0: Pose at the start, shape (4, 4).
///     T1: Pose at the end, shape (4, 4).
///     steps: Number of poses, both ends included.
///     step: Instead of `steps`, the largest distance of two poses [m].
///     turn: With or instead of `step`, the largest turn between two poses [rad].
///     speed: Instead of `step`, the speed of the tool [m/s]: poses `dt` apart in time move it so
///         fast or, for a whole number of steps, a little slower.
///     dt: With `speed`, the time from one pose to the next [s].
///     axis: Axis of a turn by 180 deg, shape (3,), in the frame of the poses: the tool turns
///         counterclockwise about it. Without it such a turn is refused, for there are two ways.
///
/// Returns:
///     Poses, shape (m, 4, 4). Of equal poses with `step`: one.
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform.
///     InvalidMotionError: The tool turns by 180 deg and `axis` does not say how, or neither
///         `step` nor `turn` says how many poses there are.
#[pyfunction]
#[pyo3(signature = (T0, T1, *, steps=None, step=None, turn=None, speed=None,
    dt=None, axis=None))]
#[expect(non_snake_case, clippy::too_many_arguments, reason = "the keywords of one call")]
pub(super) fn line<'py>(
    T0: &Bound<'py, PyAny>,
    T1: &Bound<'py, PyAny>,
    steps: Option<&Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
    axis: Option<&Bound<'py, PyAny>>,
) -> PyResult<PoseArray<'py>> {
    let py = T0.py();
    let (start, end) = (read_end(T0, "T0")?, read_end(T1, "T1")?);
    let axis = axis.map(|axis| vector::<3>(axis, "axis", Fault::Motion)).transpose()?;
    let spacing = SpacingArguments { steps, step, turn, speed, dt }.read(py)?;
    pose_rows(py, crate::paths::line(&start, &end, spacing, axis))
}

/// Move the tool on a circular arc through three poses.
///
/// Args:
///     T0: Pose at the start, shape (4, 4).
///     T_via: Pose that the arc passes, shape (4, 4).
///     T1: Pose at the end, shape (4, 4).
///     orientation: "path", the tool turns evenly relative to the path (ABB's \PathFrame);
///         "object", evenly relative to the base (\ObjectFrame); "via", evenly to the orientation
///         of `T_via` and then of `T1` (\CirPointOri).
///     steps: Number of poses, both ends included.
///     step: Instead of `steps`, the largest distance of two poses along the arc [m].
///     turn: With or instead of `step`, the largest turn between two poses [rad].
///     speed: Instead of `step`, the speed of the tool [m/s]: poses `dt` apart in time move it so
///         fast or, for a whole number of steps, a little slower.
///     dt: With `speed`, the time from one pose to the next [s].
///
/// Returns:
///     Poses, shape (m, 4, 4).
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform.
///     InvalidMotionError: The points lie on a line or coincide, or the tool turns by 180 deg.
#[pyfunction]
#[pyo3(signature = (T0, T_via, T1, *, orientation="path", steps=None, step=None, turn=None,
    speed=None, dt=None))]
#[expect(non_snake_case, clippy::too_many_arguments, reason = "the keywords of one call")]
pub(super) fn arc<'py>(
    T0: &Bound<'py, PyAny>,
    T_via: &Bound<'py, PyAny>,
    T1: &Bound<'py, PyAny>,
    orientation: &str,
    steps: Option<&Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
) -> PyResult<PoseArray<'py>> {
    let py = T0.py();
    let poses = [read_end(T0, "T0")?, read_end(T_via, "T_via")?, read_end(T1, "T1")?];
    let orientation = read_orientation(orientation)?;
    let spacing = SpacingArguments { steps, step, turn, speed, dt }.read(py)?;
    pose_rows(py, crate::paths::arc(&poses[0], &poses[1], &poses[2], orientation, spacing))
}

/// Move the tool on lines from pose to pose, with rounded corners.
///
/// Inside a zone the position runs on a parabola, as ABB's manual describes its corners; the
/// orientation is blended over its own zone. A zone reaches half of the way to a neighbor at most.
///
/// Args:
///     T: Poses, shape (m, 4, 4).
///     zones: For each pose a radius [m] or one of ABB's names, "fine", "z0" .. "z200"; or one for
///         all. Zones of the first and the last pose do not matter: both are met.
///     steps: Number of poses of the path.
///     step: Instead of `steps`, the largest distance of two poses along the lines [m].
///     turn: With or instead of `step`, the largest turn between two poses along the lines [rad].
///     speed: Instead of `step`, the speed of the tool [m/s]: poses `dt` apart in time move it so
///         fast or, for a whole number of steps, a little slower.
///     dt: With `speed`, the time from one pose to the next [s].
///
/// Returns:
///     Poses, shape (k, 4, 4). A corner with a zone of radius r, where the direction changes by an
///     angle a, is passed at a distance of r / 2 sin(a / 2).
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform.
///     InvalidMotionError: No pose, another number of zones, a zone that is negative or not known,
///         or a turn by 180 deg between two poses.
#[pyfunction]
#[pyo3(signature = (T, zones, *, steps=None, step=None, turn=None, speed=None,
    dt=None))]
#[expect(non_snake_case, reason = "the name that users pass")]
pub(super) fn polyline<'py>(
    T: &Bound<'py, PyAny>,
    zones: &Bound<'py, PyAny>,
    steps: Option<&Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
) -> PyResult<PoseArray<'py>> {
    let py = T.py();
    let poses = read_path_poses(T)?;
    let zones = read_zones(zones, poses.len())?;
    let spacing = SpacingArguments { steps, step, turn, speed, dt }.read(py)?;
    pose_rows(py, crate::paths::polyline(&poses, &zones, spacing))
}

/// Move the tool on a smooth curve through poses, all of which are met.
///
/// The position is a cubic spline with continuous second derivative; angular velocity and
/// acceleration are continuous along it. Where the tool only turns it stops, and turns about one
/// axis. Through two poses the curve is a line.
///
/// Args:
///     T: Poses, shape (m, 4, 4). One that repeats the one before it, within 1e-9 m and rad, is
///         left out.
///     steps: Number of poses of the path.
///     step: Instead of `steps`, the largest distance of two poses along the curve [m].
///     turn: With or instead of `step`, the largest turn between two poses [rad].
///     speed: Instead of `step`, the speed of the tool [m/s]: poses `dt` apart in time move it so
///         fast or, for a whole number of steps, a little slower.
///     dt: With `speed`, the time from one pose to the next [s].
///
/// Returns:
///     Poses, shape (k, 4, 4), with the poses of `T` among them: from each to the next in equal
///     steps along the curve.
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform.
///     InvalidMotionError: No pose, a turn by 180 deg between two poses, fewer `steps` than poses,
///         or a spacing that does not say how many poses there are.
#[pyfunction]
#[pyo3(signature = (T, *, steps=None, step=None, turn=None, speed=None, dt=None))]
#[expect(non_snake_case, reason = "the name that users pass")]
pub(super) fn spline<'py>(
    T: &Bound<'py, PyAny>,
    steps: Option<&Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
) -> PyResult<PoseArray<'py>> {
    let py = T.py();
    let poses = read_path_poses(T)?;
    let spacing = SpacingArguments { steps, step, turn, speed, dt }.read(py)?;
    pose_rows(py, py.detach(|| crate::paths::spline(&poses, spacing)))
}

/// A zone for each pose, or one for all.
fn read_zones(zones: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<Zone>> {
    if zones.is_instance_of::<PyString>() || zones.extract::<f64>().is_ok() {
        return Ok(vec![read_zone(zones)?; count]);
    }
    let Ok(each) = zones.try_iter() else { return read_zone(zones).map(|zone| vec![zone]) };
    let read = each.map(|zone| read_zone(&zone?)).collect::<PyResult<Vec<_>>>()?;
    if read.len() != count {
        let message =
            format!("zones has {} elements, it must have {count}: one a pose", read.len());
        return Err(Fault::Motion.error(zones.py(), message));
    }
    Ok(read)
}

fn read_zone(zone: &Bound<'_, PyAny>) -> PyResult<Zone> {
    if let Ok(radius) = zone.extract::<f64>() {
        return Ok(Zone::radius(radius));
    }
    let known = zone.extract::<String>().ok().and_then(|name| Zone::named(&name));
    known.ok_or_else(|| {
        let got = zone.repr().map_or_else(|_| "something else".into(), |repr| repr.to_string());
        let message = format!("zones must be radii [m] or \"fine\", \"z0\" .. \"z200\", got {got}");
        Fault::Motion.error(zone.py(), message)
    })
}
