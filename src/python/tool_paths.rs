//! `irbkin.paths`: paths of the tool as poses.

use numpy::{PyArray3, PyArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyString;

use super::arguments::{read_orientation, read_steps};
use super::arrays::{Rows, vector};
use super::errors::{Fault, to_py};
use super::poses::read_pose;
use super::wording::shape;
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

/// `steps` poses, or steps of at most `step` [m] and `turn` [rad].
fn read_spacing(
    py: Python<'_>,
    steps: Option<&Bound<'_, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
) -> PyResult<Spacing> {
    let spacing = match (steps, step.or(turn)) {
        (Some(steps), None) => Spacing::count(read_steps(steps)?),
        (None, Some(_)) => {
            Spacing::step(step.unwrap_or(f64::INFINITY), turn.unwrap_or(f64::INFINITY))
        }
        _ => return Err(PyValueError::new_err("give steps, or step [m] and turn [rad]")),
    };
    spacing.map_err(|error| to_py(py, &error))
}

/// Move the tool on a straight line, its orientation turning evenly about one axis (slerp).
///
/// Args:
///     T0: Pose at the start, shape (4, 4).
///     T1: Pose at the end, shape (4, 4).
///     steps: Number of poses, both ends included.
///     step: Instead of `steps`, the largest distance of two poses [m].
///     turn: With or instead of `step`, the largest turn between two poses [rad].
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
#[pyo3(signature = (T0, T1, *, steps=None, step=None, turn=None, axis=None))]
#[expect(non_snake_case, reason = "the names that users pass")]
pub(super) fn line<'py>(
    T0: &Bound<'py, PyAny>,
    T1: &Bound<'py, PyAny>,
    steps: Option<&Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
    axis: Option<&Bound<'py, PyAny>>,
) -> PyResult<PoseArray<'py>> {
    let py = T0.py();
    let (start, end) = (read_pose(T0, "T0")?, read_pose(T1, "T1")?);
    let axis = axis.map(|axis| vector::<3>(axis, "axis", Fault::Motion)).transpose()?;
    let spacing = read_spacing(py, steps, step, turn)?;
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
///         of `T_via` and then to that of `T1` (\CirPointOri).
///     steps: Number of poses, both ends included.
///     step: Instead of `steps`, the largest distance of two poses along the arc [m].
///     turn: With or instead of `step`, the largest turn between two poses [rad].
///
/// Returns:
///     Poses, shape (m, 4, 4).
///
/// Raises:
///     InvalidPoseError: A pose is not a rigid transform.
///     InvalidMotionError: The points lie on a line or coincide, or the tool turns by 180 deg.
#[pyfunction]
#[pyo3(signature = (T0, T_via, T1, *, orientation="path", steps=None, step=None, turn=None))]
#[expect(non_snake_case, reason = "the names that users pass")]
pub(super) fn arc<'py>(
    T0: &Bound<'py, PyAny>,
    T_via: &Bound<'py, PyAny>,
    T1: &Bound<'py, PyAny>,
    orientation: &str,
    steps: Option<&Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
) -> PyResult<PoseArray<'py>> {
    let py = T0.py();
    let poses = [read_pose(T0, "T0")?, read_pose(T_via, "T_via")?, read_pose(T1, "T1")?];
    let orientation = read_orientation(orientation)?;
    let spacing = read_spacing(py, steps, step, turn)?;
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
///         all. Those of the first and the last pose do not matter: both are met.
///     steps: Number of poses of the path.
///     step: Instead of `steps`, the largest distance of two poses along the lines [m].
///     turn: With or instead of `step`, the largest turn between two poses along the lines [rad].
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
#[pyo3(signature = (T, zones, *, steps=None, step=None, turn=None))]
#[expect(non_snake_case, reason = "the name that users pass")]
pub(super) fn polyline<'py>(
    T: &Bound<'py, PyAny>,
    zones: &Bound<'py, PyAny>,
    steps: Option<&Bound<'py, PyAny>>,
    step: Option<f64>,
    turn: Option<f64>,
) -> PyResult<PoseArray<'py>> {
    let py = T.py();
    let rows = Rows::read(T, &[4, 4], "T", Fault::Pose)?;
    if rows.lead.len() != 1 {
        let message =
            format!("T must have shape (m, 4, 4), got {}", shape(&rows.shape_with(&[4, 4])));
        return Err(Fault::Pose.error(py, message));
    }
    let poses = rows.data()?.as_chunks::<16>().0.iter().enumerate();
    let poses = poses.map(|(index, row)| {
        pose_from_rows(row).map_err(|error| Fault::Pose.error(py, format!("T[{index}]: {error}")))
    });
    let poses = poses.collect::<PyResult<Vec<Pose>>>()?;
    let zones = read_zones(zones, poses.len())?;
    let spacing = read_spacing(py, steps, step, turn)?;
    pose_rows(py, crate::paths::polyline(&poses, &zones, spacing))
}

/// A zone for each pose, or one for all.
fn read_zones(zones: &Bound<'_, PyAny>, count: usize) -> PyResult<Vec<Zone>> {
    if zones.is_instance_of::<PyString>() || zones.extract::<f64>().is_ok() {
        return Ok(vec![read_zone(zones)?; count]);
    }
    let read = zones.try_iter()?.map(|zone| read_zone(&zone?)).collect::<PyResult<Vec<_>>>()?;
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
