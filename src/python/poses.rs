//! Poses from and to translations with quaternions or Euler angles.

use numpy::{PyArray1, PyArray2};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

use super::arrays::{Rows, copied_matrix4, matrix, matrix4, vector};
use super::errors::{Fault, to_py};
use super::wording;
use crate::error::Error;
use crate::kinematics::{
    Pose, pose_from_euler_zyx, pose_from_rows, pose_from_wxyz, pose_to_euler_zyx, pose_to_rows,
    pose_to_wxyz,
};

/// The argument `field` as a checked pose.
pub(super) fn read_pose(value: &Bound<'_, PyAny>, field: &str) -> PyResult<Pose> {
    let rows = matrix4(value, field, Fault::Pose)?;
    pose_from_rows(&rows).map_err(|error| to_py(value.py(), &error))
}

/// The argument T of a call that takes one pose, and of which `ik_batch` takes many.
#[inline]
pub(super) fn read_one_pose(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    match copied_matrix4(value) {
        Some(rows) => pose_from_rows(&rows).map_err(|error| to_py(value.py(), &error)),
        None => {
            read_pose(value, "T").map_err(|error| match wording::many_hint(value, "ik_batch") {
                none if none.is_empty() => error,
                hint => Fault::Pose.error(value.py(), format!("{}{hint}", error.value(value.py()))),
            })
        }
    }
}

/// A pose, or many.
pub(super) enum PoseArgument<'py> {
    One(Pose),
    Many(Rows<'py>),
}

/// The argument T, of shape (..., 4, 4); a single pose is checked.
#[inline]
pub(super) fn read_poses<'py>(value: &Bound<'py, PyAny>) -> PyResult<PoseArgument<'py>> {
    let checked = |rows: &[f64; 16]| {
        pose_from_rows(rows).map(PoseArgument::One).map_err(|error| to_py(value.py(), &error))
    };
    if let Some(rows) = copied_matrix4(value) {
        return checked(&rows);
    }
    let rows = Rows::read(value, &[4, 4], "T", Fault::Pose)?;
    match rows.data()?.as_chunks::<16>().0 {
        [row] if rows.is_single() => checked(row),
        _ => Ok(PoseArgument::Many(rows)),
    }
}

/// A pose as a (4, 4) array.
pub(super) fn pose_array<'py>(py: Python<'py>, pose: &Pose) -> Bound<'py, PyArray2<f64>> {
    matrix(py, pose_to_rows(pose).as_chunks::<4>().0)
}

/// Pose from a translation and an orientation.
///
/// Args:
///     xyz: Translation [m], shape (3,).
///     wxyz: Orientation as w, x, y, z, shape (4,); normalized.
///     euler_zyx: Orientation as rz, ry, rx [rad], shape (3,): Rz(rz) Ry(ry) Rx(rx).
///
/// Returns:
///     Homogeneous matrix, shape (4, 4). Without an orientation, that of the base.
///
/// Raises:
///     InvalidPoseError: A wrong shape, an element that is not finite, a quaternion whose norm is
///         off one by more than 2e-3.
///     TypeError: Both orientations are given, or something is no number.
#[pyfunction]
#[pyo3(signature = (xyz, wxyz=None, euler_zyx=None))]
pub(super) fn pose<'py>(
    xyz: &Bound<'py, PyAny>,
    wxyz: Option<&Bound<'py, PyAny>>,
    euler_zyx: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let py = xyz.py();
    let xyz = vector::<3>(xyz, "xyz", Fault::Pose)?;
    let pose: Result<Pose, Error> = match (wxyz, euler_zyx) {
        (Some(_), Some(_)) => {
            return Err(PyTypeError::new_err("give wxyz or euler_zyx, not both"));
        }
        (Some(wxyz), None) => pose_from_wxyz(xyz, vector(wxyz, "wxyz", Fault::Pose)?),
        (None, Some(euler)) => pose_from_euler_zyx(xyz, vector(euler, "euler_zyx", Fault::Pose)?),
        (None, None) => pose_from_euler_zyx(xyz, [0.0; 3]),
    };
    Ok(pose_array(py, &pose.map_err(|error| to_py(py, &error))?))
}

type TwoArrays<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

/// Translation and quaternion of a pose.
///
/// Args:
///     T: Homogeneous matrix, shape (4, 4), translation [m].
///
/// Returns:
///     Translation [m], shape (3,), and quaternion w, x, y, z with w >= 0, shape (4,).
///
/// Raises:
///     InvalidPoseError: T is no rigid transform.
#[pyfunction]
#[pyo3(name = "to_xyz_wxyz", signature = (T))]
#[expect(non_snake_case, reason = "the name that users pass")]
pub(super) fn to_xyz_wxyz<'py>(T: &Bound<'py, PyAny>) -> PyResult<TwoArrays<'py>> {
    let (xyz, quaternion) = pose_to_wxyz(&read_pose(T, "T")?);
    Ok((PyArray1::from_slice(T.py(), &xyz), PyArray1::from_slice(T.py(), &quaternion)))
}

/// Translation and ZYX Euler angles of a pose.
///
/// Args:
///     T: Homogeneous matrix, shape (4, 4), translation [m].
///
/// Returns:
///     Translation [m], shape (3,), and rz, ry, rx [rad], shape (3,), ry in -pi/2 .. pi/2. Where ry
///     is +-pi/2 only rz - rx or rz + rx is determined: rz is 0 there.
///
/// Raises:
///     InvalidPoseError: T is no rigid transform.
#[pyfunction]
#[pyo3(name = "to_xyz_euler_zyx", signature = (T))]
#[expect(non_snake_case, reason = "the name that users pass")]
pub(super) fn to_xyz_euler_zyx<'py>(T: &Bound<'py, PyAny>) -> PyResult<TwoArrays<'py>> {
    let (xyz, zyx) = pose_to_euler_zyx(&read_pose(T, "T")?);
    Ok((PyArray1::from_slice(T.py(), &xyz), PyArray1::from_slice(T.py(), &zyx)))
}
