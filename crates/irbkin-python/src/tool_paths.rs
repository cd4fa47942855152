//! `irbkin.paths`: paths of the tool as poses.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyString;

use super::arguments::{ORIENTATIONS, one_of, read_steps};
use super::arrays::{matrix4, vector};
use super::errors::{Fault, exception};
use super::outputs::array;
use super::targets::{check_meters, read_path_poses};
use irbkin::Pose;
use irbkin::pose::{from_rows as pose_from_rows, to_rows as pose_to_rows};
use irbkin_motion::Error;
use irbkin_motion::paths::{Spacing, Zone};

/// Poses as an array of shape (m, 4, 4).
fn pose_rows(py: Python<'_>, poses: Result<Vec<Pose>, Error>) -> PyResult<Py<PyAny>> {
    let poses = poses.map_err(exception)?;
    array(py, poses.iter().flat_map(pose_to_rows), &[poses.len(), 4, 4])
}

/// One pose of shape (4, 4), named in what is wrong with it.
fn read_end(value: &Bound<'_, PyAny>, field: &'static str) -> PyResult<Pose> {
    let located = |error| Fault::Pose.error(format_args!("{field}: {error}"));
    pose_from_rows(&matrix4(value, field, Fault::Pose)?).map_err(located)
}

/// How the poses of a path are spaced: `steps` poses; steps of at most `step` [m] and `turn` [rad];
/// or those that `speed` [m/s] makes in `dt` [s].
fn read_spacing(
    steps: Option<&Bound<'_, PyAny>>,
    [step, turn, speed, dt]: [Option<f64>; 4],
) -> PyResult<Spacing> {
    let most = turn.unwrap_or(f64::INFINITY);
    let spacing = match (steps, step, turn, speed, dt) {
        (Some(steps), None, None, None, None) => Spacing::count(read_steps(steps)?),
        (None, Some(step), _, None, None) => Spacing::step(step, most),
        (None, None, Some(turn), None, None) => Spacing::step(f64::INFINITY, turn),
        (None, None, _, Some(speed), Some(dt)) => Spacing::speed(speed, dt, most),
        _ => {
            let message = "give steps, or step [m] and turn [rad], or speed [m/s] with dt [s]";
            return Err(PyValueError::new_err(message));
        }
    };
    spacing.map_err(exception)
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
///     InvalidPoseError: A pose is not a rigid transform, or in millimeters.
///     InvalidMotionError: The tool turns by 180 deg and `axis` does not say how, or neither
///         `step` nor `turn` says how many poses there are.
#[pyfunction]
#[pyo3(signature = (T0, T1, *, steps=None, step=None, turn=None, speed=None,
    dt=None, axis=None))]
pub(super) fn line(
    T0: &Bound<'_, PyAny>,
    T1: &Bound<'_, PyAny>,
    steps: Option<&Bound<'_, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
    axis: Option<&Bound<'_, PyAny>>,
) -> PyResult<Py<PyAny>> {
    let py = T0.py();
    let ends = [read_end(T0, "T0")?, read_end(T1, "T1")?];
    check_meters(&ends)?;
    let axis = axis.map(|axis| vector::<3>(axis, "axis", Fault::Motion)).transpose()?;
    let spacing = read_spacing(steps, [step, turn, speed, dt])?;
    pose_rows(py, irbkin_motion::paths::line(&ends[0], &ends[1], spacing, axis))
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
///     steps: As of `line`.
///     step: As of `line`, along the path.
///     turn: As of `line`.
///     speed: As of `line`.
///     dt: As of `line`.
///
/// Returns:
///     Poses, shape (m, 4, 4).
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform, or in millimeters.
///     InvalidMotionError: The points lie on a line or coincide, or the tool turns by 180 deg.
#[pyfunction]
#[pyo3(signature = (T0, T_via, T1, *, orientation="path", steps=None, step=None, turn=None,
    speed=None, dt=None))]
pub(super) fn arc(
    T0: &Bound<'_, PyAny>,
    T_via: &Bound<'_, PyAny>,
    T1: &Bound<'_, PyAny>,
    orientation: &str,
    steps: Option<&Bound<'_, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
) -> PyResult<Py<PyAny>> {
    let py = T0.py();
    let poses = [read_end(T0, "T0")?, read_end(T_via, "T_via")?, read_end(T1, "T1")?];
    check_meters(&poses)?;
    let orientation = one_of("orientation", orientation, &ORIENTATIONS)?;
    let spacing = read_spacing(steps, [step, turn, speed, dt])?;
    pose_rows(py, irbkin_motion::paths::arc(&poses[0], &poses[1], &poses[2], orientation, spacing))
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
///     steps: As of `line`.
///     step: As of `line`, along the path.
///     turn: As of `line`.
///     speed: As of `line`.
///     dt: As of `line`.
///
/// Returns:
///     Poses, shape (k, 4, 4). A corner with a zone of radius r, where the direction changes by an
///     angle a, is passed at a distance of r / 2 sin(a / 2).
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform, or in millimeters.
///     InvalidMotionError: No pose, another number of zones, a zone that is negative or not known,
///         or a turn by 180 deg between two poses.
#[pyfunction]
#[pyo3(signature = (T, zones, *, steps=None, step=None, turn=None, speed=None,
    dt=None))]
pub(super) fn polyline(
    T: &Bound<'_, PyAny>,
    zones: &Bound<'_, PyAny>,
    steps: Option<&Bound<'_, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
) -> PyResult<Py<PyAny>> {
    let py = T.py();
    let poses = read_path_poses(T)?;
    check_meters(&poses)?;
    let zones = read_zones(zones, poses.len())?;
    let spacing = read_spacing(steps, [step, turn, speed, dt])?;
    pose_rows(py, irbkin_motion::paths::polyline(&poses, &zones, spacing))
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
///     steps: As of `line`.
///     step: As of `line`, along the path.
///     turn: As of `line`.
///     speed: As of `line`.
///     dt: As of `line`.
///
/// Returns:
///     Poses, shape (k, 4, 4), with the poses of `T` among them: from each to the next in equal
///     steps along the curve.
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform, or in millimeters.
///     InvalidMotionError: No pose, a turn by 180 deg between two poses, fewer `steps` than poses,
///         or a spacing that does not say how many poses there are.
#[pyfunction]
#[pyo3(signature = (T, *, steps=None, step=None, turn=None, speed=None, dt=None))]
pub(super) fn spline(
    T: &Bound<'_, PyAny>,
    steps: Option<&Bound<'_, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    speed: Option<f64>,
    dt: Option<f64>,
) -> PyResult<Py<PyAny>> {
    let py = T.py();
    let poses = read_path_poses(T)?;
    check_meters(&poses)?;
    let spacing = read_spacing(steps, [step, turn, speed, dt])?;
    pose_rows(py, py.detach(|| irbkin_motion::paths::spline(&poses, spacing)))
}

/// A zone for each pose, or one for all.
fn read_zones(zones: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<Zone>> {
    if zones.is_instance_of::<PyString>() || zones.extract::<f64>().is_ok() {
        return Ok(vec![read_zone(zones)?; count]);
    }
    let Ok(each) = zones.try_iter() else { return read_zone(zones).map(|zone| vec![zone]) };
    let read = each.map(|zone| read_zone(&zone?)).collect::<PyResult<Vec<_>>>()?;
    if read.len() != count {
        let found = read.len();
        let message = format!("zones has {found} elements, it must have {count}: one a pose");
        return Err(Fault::Motion.error(message));
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
        Fault::Motion.error(message)
    })
}
