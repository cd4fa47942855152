//! Poses from and to translations with quaternions or Euler angles.

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use super::arrays::{Argument, Rows, copied_matrix4, copied_vector, matrix4, together};
use super::errors::{Fault, index_in, shape_text, to_py};
use super::outputs::{matrix, output, writable};
use super::signals::detached;
use crate::error::Error;
use crate::kinematics::{
    Pose, pose_from_euler_zyx, pose_from_rotation, pose_from_rows, pose_from_wxyz, pose_from_xyzw,
    pose_to_euler_zyx, pose_to_rows, pose_to_wxyz,
};

/// The argument `field` as a checked pose.
pub(super) fn read_pose(value: &Bound<'_, PyAny>, field: &str) -> PyResult<Pose> {
    let rows = matrix4(value, field, Fault::Pose)?;
    pose_from_rows(&rows).map_err(|error| to_py(value.py(), &error))
}

/// The argument T of `ik`, without NumPy's bookkeeping where it is plain.
#[inline]
pub(super) fn read_ik_pose(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    match copied_matrix4(value) {
        Some(rows) => pose_from_rows(&rows).map_err(|error| to_py(value.py(), &error)),
        None => read_one_pose(value, " (for many poses take ik_batch)"),
    }
}

/// The argument T of a method that takes one pose and has no batch.
pub(super) fn read_single_pose(value: &Bound<'_, PyAny>, method: &str) -> PyResult<Pose> {
    read_one_pose(value, &format!(": {method} takes a single pose, call it for each"))
}

/// The argument T of a call that takes one pose; a message on many ends with `many`.
fn read_one_pose(value: &Bound<'_, PyAny>, many: &str) -> PyResult<Pose> {
    read_pose(value, "T").map_err(|error| match shape_of(value).as_deref() {
        Some(sizes @ [_, .., 4, 4]) => {
            let got = shape_text(sizes);
            Fault::Pose.error(value.py(), format!("T must have shape (4, 4), got {got}{many}"))
        }
        _ => error,
    })
}

/// The pose where there is one alone, checked.
pub(super) fn single_pose(py: Python<'_>, poses: &Rows<'_>) -> PyResult<Option<Pose>> {
    match poses.data()?.as_chunks::<16>().0 {
        [pose] if poses.is_single() => {
            pose_from_rows(pose).map(Some).map_err(|error| to_py(py, &error))
        }
        _ => Ok(None),
    }
}

/// The shape that NumPy sees in an argument.
fn shape_of(value: &Bound<'_, PyAny>) -> Option<Vec<usize>> {
    let numpy = value.py().import("numpy").ok()?;
    numpy.call_method1("shape", (value,)).ok()?.extract().ok()
}

/// A pose as a (4, 4) array.
pub(super) fn pose_array<'py>(py: Python<'py>, pose: &Pose) -> Bound<'py, PyArray2<f64>> {
    matrix(py, pose_to_rows(pose).as_chunks::<4>().0)
}

/// Poses from translations and orientations.
///
/// Give one orientation, or none for the orientation of the base. All arguments are broadcast.
///
/// Args:
///     xyz: Translations [m], shape (..., 3).
///     wxyz: Quaternions w, x, y, z, shape (..., 4); normalized.
///     xyzw: Quaternions x, y, z, w, as SciPy and ROS order them, shape (..., 4); normalized.
///     euler_zyx: Angles rz, ry, rx [rad], shape (..., 3): Rz(rz) Ry(ry) Rx(rx).
///     rotation: Rotation matrices, shape (..., 3, 3), or a `scipy.spatial.transform.Rotation`.
///
/// Returns:
///     Homogeneous matrices, shape (..., 4, 4).
///
/// Raises:
///     InvalidPoseError: A wrong shape, an element that is not finite, a quaternion whose norm is
///         off one by more than 2e-3, a matrix that is not a rotation. Of many the message has the
///         index of the first.
///     TypeError: Several orientations are given, or an argument is not a number.
#[pyfunction]
#[pyo3(signature = (xyz, wxyz=None, xyzw=None, euler_zyx=None, rotation=None))]
pub(super) fn pose<'py>(
    xyz: &Bound<'py, PyAny>,
    wxyz: Option<&Bound<'py, PyAny>>,
    xyzw: Option<&Bound<'py, PyAny>>,
    euler_zyx: Option<&Bound<'py, PyAny>>,
    rotation: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyAny>> {
    let orientations =
        [("wxyz", wxyz), ("xyzw", xyzw), ("euler_zyx", euler_zyx), ("rotation", rotation)];
    let mut given = orientations.into_iter().filter_map(|(name, value)| Some((name, value?)));
    let first = given.next();
    if let (Some((first, _)), Some((second, _))) = (first, given.next()) {
        return Err(PyTypeError::new_err(format!(
            "give one orientation: {first} or {second}, not both"
        )));
    }
    match first {
        None => made(xyz, None, "", &[3], pose_from_euler_zyx),
        Some((name @ "wxyz", value)) => made(xyz, Some(value), name, &[4], pose_from_wxyz),
        Some((name @ "xyzw", value)) => made(xyz, Some(value), name, &[4], pose_from_xyzw),
        Some((name @ "euler_zyx", value)) => {
            made(xyz, Some(value), name, &[3], pose_from_euler_zyx)
        }
        Some((name, value)) => {
            let matrix = match value.getattr_opt("as_matrix")? {
                Some(as_matrix) => &as_matrix.call0()?,
                None => value,
            };
            made(xyz, Some(matrix), name, &[3, 3], |xyz, rotation: [f64; 9]| {
                let [a, b, c, d, e, f, g, h, i] = rotation;
                pose_from_rotation(xyz, [[a, b, c], [d, e, f], [g, h, i]])
            })
        }
    }
}

/// Poses of translations and of orientations of `R` numbers each, in arrays of shape (..., `tail`).
fn made<'py, const R: usize>(
    xyz: &Bound<'py, PyAny>,
    orientation: Option<&Bound<'py, PyAny>>,
    field: &'static str,
    tail: &[usize],
    make: impl Fn([f64; 3], [f64; R]) -> Result<Pose, Error> + Send + Sync,
) -> PyResult<Bound<'py, PyAny>> {
    let py = xyz.py();
    let single = |make: Result<Pose, Error>| {
        Ok(pose_array(py, &make.map_err(|error| to_py(py, &error))?).into_any())
    };
    // Without NumPy's bookkeeping, where both are plain.
    let plain = orientation.map_or(Some([0.0; R]), copied_vector);
    if let (Some(xyz), Some(orientation)) = (copied_vector::<3>(xyz), plain) {
        return single(make(xyz, orientation));
    }
    let mut xyz = Rows::read(xyz, &[3], "xyz", Fault::Pose)?;
    let mut orientations =
        orientation.map(|given| Rows::read(given, tail, field, Fault::Pose)).transpose()?;
    if let Some(orientations) = &mut orientations {
        together(
            py,
            &mut [
                Argument { field: "xyz", fault: Fault::Pose, rows: &mut xyz },
                Argument { field, fault: Fault::Pose, rows: orientations },
            ],
        )?;
    }
    let (translations, count) = (xyz.data()?, xyz.lead.iter().product::<usize>());
    let nothing = vec![0.0; if orientations.is_some() { 0 } else { R * count }];
    let turns = orientations.as_ref().map_or(Ok(&nothing[..]), Rows::data)?;
    if xyz.is_single() {
        let (first, turn) = (translations.first_chunk::<3>(), turns.first_chunk::<R>());
        if let (Some(first), Some(turn)) = (first, turn) {
            return single(make(*first, *turn));
        }
    }
    let answer = output(py, None, &xyz.shape_with(&[4, 4]))?;
    let mut view = writable(&answer, &[])?;
    let poses = view.as_slice_mut()?;
    match detached(py, None, |pace| pace.make_poses(translations, turns, poses, make))? {
        Some((row, error)) => {
            let place = index_in(&xyz.lead, row);
            Err(Fault::Pose.error(py, format!("row {place:?}: {error}")))
        }
        None => Ok(answer.into_any()),
    }
}

type TwoArrays<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>);

/// Translations and quaternions of poses.
///
/// Args:
///     T: Homogeneous matrices, shape (..., 4, 4), translation [m].
///
/// Returns:
///     Translations [m], shape (..., 3), and quaternions w, x, y, z with w >= 0, shape (..., 4). In
///     a batch, an invalid row gives NaN.
///
/// Raises:
///     InvalidPoseError: A wrong shape, or a single pose that is not a rigid transform.
#[pyfunction]
#[pyo3(name = "to_xyz_wxyz", signature = (T))]
#[expect(non_snake_case, reason = "the name that users pass")]
pub(super) fn to_xyz_wxyz<'py>(T: &Bound<'py, PyAny>) -> PyResult<TwoArrays<'py>> {
    taken_apart(T, pose_to_wxyz)
}

/// Translations and ZYX Euler angles of poses.
///
/// Args:
///     T: Homogeneous matrices, shape (..., 4, 4), translation [m].
///
/// Returns:
///     Translations [m], shape (..., 3), and rz, ry, rx [rad], shape (..., 3), ry in -pi/2 .. pi/2.
///     Where ry is +-pi/2 only rz - rx or rz + rx is determined: rz is 0 there. In a batch, a row
///     that is invalid gives NaN.
///
/// Raises:
///     InvalidPoseError: A wrong shape, or a single pose that is not a rigid transform.
#[pyfunction]
#[pyo3(name = "to_xyz_euler_zyx", signature = (T))]
#[expect(non_snake_case, reason = "the name that users pass")]
pub(super) fn to_xyz_euler_zyx<'py>(T: &Bound<'py, PyAny>) -> PyResult<TwoArrays<'py>> {
    taken_apart(T, pose_to_euler_zyx)
}

/// Translations and orientations of `R` numbers each.
fn taken_apart<'py, const R: usize>(
    poses: &Bound<'py, PyAny>,
    take: fn(&Pose) -> ([f64; 3], [f64; R]),
) -> PyResult<TwoArrays<'py>> {
    let py = poses.py();
    let one = |pose: &Pose| {
        let (xyz, orientation) = take(pose);
        let arrays = (PyArray1::from_slice(py, &xyz), PyArray1::from_slice(py, &orientation));
        Ok((arrays.0.into_any(), arrays.1.into_any()))
    };
    if let Some(rows) = copied_matrix4(poses) {
        return one(&pose_from_rows(&rows).map_err(|error| to_py(py, &error))?);
    }
    let rows = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    if let Some(pose) = single_pose(py, &rows)? {
        return one(&pose);
    }
    let (xyz, orientation) =
        (output(py, None, &rows.shape_with(&[3]))?, output(py, None, &rows.shape_with(&[R]))?);
    let (mut xyz_view, mut view) = (writable(&xyz, &[])?, writable(&orientation, &[])?);
    let (data, to_xyz, to) = (rows.data()?, xyz_view.as_slice_mut()?, view.as_slice_mut()?);
    detached(py, None, |pace| pace.take_apart(data, to_xyz, to, take))?;
    Ok((xyz.into_any(), orientation.into_any()))
}
