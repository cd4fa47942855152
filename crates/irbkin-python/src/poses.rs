//! Poses from and to translations with quaternions or Euler angles.

use numpy::PyArray1;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyFloat, PyInt};

use super::arrays::{Rows, copied_matrix4, copied_vector, together};
use super::errors::{Fault, exception, index_in};
use super::outputs::Output;
use super::signals::detached;
use super::targets::{pose_array, single_pose};
use irbkin::pose::{
    from_euler_zyx as pose_from_euler_zyx, from_rotation as pose_from_rotation,
    from_rotvec as pose_from_rotvec, from_rows as pose_from_rows, from_wxyz as pose_from_wxyz,
    from_xyzw as pose_from_xyzw, to_euler_zyx as pose_to_euler_zyx, to_wxyz as pose_to_wxyz,
};
use irbkin::{Error, Pose};

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
///     rotvec: Rotation vectors rx, ry, rz [rad], shape (..., 3), axis times angle, as Universal
///         Robots' controllers show them.
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
#[pyo3(
    signature = (
        xyz, wxyz=None, xyzw=None, euler_zyx=None, rotation=None, rotvec=None, **others
    ),
    text_signature = "(xyz, wxyz=None, xyzw=None, euler_zyx=None, rotation=None, rotvec=None)"
)]
pub(super) fn pose<'py>(
    xyz: &Bound<'py, PyAny>,
    wxyz: Option<&Bound<'py, PyAny>>,
    xyzw: Option<&Bound<'py, PyAny>>,
    euler_zyx: Option<&Bound<'py, PyAny>>,
    rotation: Option<&Bound<'py, PyAny>>,
    rotvec: Option<&Bound<'py, PyAny>>,
    others: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    if let Some((name, _)) = others.and_then(|others| others.iter().next()) {
        let own = match name.extract::<String>()?.as_str() {
            "rpy" | "euler" => "euler_zyx=[yaw, pitch, roll] [rad]",
            "quat" | "quaternion" => "wxyz, or xyzw as SciPy and ROS order them",
            "R" | "matrix" => "rotation",
            _ => "xyz and one of wxyz, xyzw, euler_zyx, rotation and rotvec",
        };
        let message = format!("pose has no argument {}: use {own}", name.repr()?);
        return Err(PyTypeError::new_err(message));
    }
    let orientations = [
        ("wxyz", wxyz),
        ("xyzw", xyzw),
        ("euler_zyx", euler_zyx),
        ("rotvec", rotvec),
        ("rotation", rotation),
    ];
    if xyz.is_instance_of::<PyFloat>() || xyz.is_instance_of::<PyInt>() {
        return Err(PyTypeError::new_err("xyz is one argument of three numbers: pose([x, y, z])"));
    }
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
        Some((name @ "rotvec", value)) => made(xyz, Some(value), name, &[3], pose_from_rotvec),
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
    let single = |xyz, orientation| {
        Ok(pose_array(py, &make(xyz, orientation).map_err(exception)?).into_any())
    };
    // Without NumPy's bookkeeping, where both are plain.
    let plain = orientation.map_or(Some([0.0; R]), copied_vector);
    if let (Some(xyz), Some(orientation)) = (copied_vector(xyz), plain) {
        return single(xyz, orientation);
    }
    let mut xyz = Rows::read(xyz, &[3], "xyz", Fault::Pose)?;
    let mut orientations =
        orientation.map(|given| Rows::read(given, tail, field, Fault::Pose)).transpose()?;
    if let Some(orientations) = &mut orientations {
        together(&mut [&mut xyz, orientations])?;
    }
    let (translations, count) = (xyz.data()?, xyz.lead.iter().product::<usize>());
    let nothing = vec![0.0; if orientations.is_some() { 0 } else { R * count }];
    let turns = orientations.as_ref().map_or(Ok(&nothing[..]), Rows::data)?;
    if let (Some(xyz), Some(turn)) = (xyz.single()?, turns.first_chunk()) {
        return single(*xyz, *turn);
    }
    let mut answer = Output::new(py, None, &xyz.shape_with(&[4, 4]), &[])?;
    let poses = answer.slice()?;
    match detached(py, None, |batch| batch.make_poses(translations, turns, poses, make))? {
        Some((row, error)) => {
            let place = index_in(&xyz.lead, row);
            Err(Fault::Pose.error(format_args!("row {place:?}: {error}")))
        }
        None => Ok(answer.bound()),
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
pub(super) fn to_xyz_euler_zyx<'py>(T: &Bound<'py, PyAny>) -> PyResult<TwoArrays<'py>> {
    taken_apart(T, pose_to_euler_zyx)
}

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
        return one(&pose_from_rows(&rows).map_err(exception)?);
    }
    let rows = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    if let Some(pose) = single_pose(&rows)? {
        return one(&pose);
    }
    let mut xyz = Output::new(py, None, &rows.shape_with(&[3]), &[])?;
    let mut orientation = Output::new(py, None, &rows.shape_with(&[R]), &[])?;
    let (data, to_xyz, to) = (rows.data()?, xyz.slice()?, orientation.slice()?);
    detached(py, None, |batch| batch.take_apart(data, to_xyz, to, take))?;
    Ok((xyz.bound(), orientation.bound()))
}
