//! Poses: check and repair of a 4x4 matrix, quaternions and ZYX Euler angles.

pub(crate) mod angles;
pub(crate) mod matrix;
pub(crate) mod rotation;

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3, Vector3};

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::error::{Error, PoseFault};
use crate::kinematics::pose::angles::constant_sin_cos;
use crate::kinematics::pose::rotation::{
    Rows3, determinant, gram_excess, nearest_rotation, quaternion,
};
use crate::kinematics::thresholds::{
    GIMBAL_COS, LAST_ROW_BOUND, MOST_EULER, MOST_LENGTH, QUATERNION_NORM_BOUND,
    ROTATION_REPAIR_BOUND, ROTATION_ROUNDING,
};

/// A rigid transform: a rotation matrix and a translation [m].
pub type Pose = IsometryMatrix3<f64>;

/// The difference of two poses.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PoseDifference {
    /// Distance of the origins [m].
    pub position: f64,
    /// Angle of the rotation between them [rad].
    pub rotation: f64,
}

impl PoseDifference {
    /// The difference of `a` and `b`.
    #[must_use]
    pub fn between(a: &Pose, b: &Pose) -> Self {
        // Ra - Rb
        //
        // (Frobenius) is 2 sqrt(2) sin(angle / 2): accurate for small angles, where the trace is
        // not.
        let chord = (a.rotation.matrix() - b.rotation.matrix()).norm() / 8.0_f64.sqrt();
        Self {
            position: (a.translation.vector - b.translation.vector).norm(),
            rotation: 2.0 * chord.min(1.0).asin(),
        }
    }

    /// The larger of the two numbers, meters compared with radians.
    #[must_use]
    pub fn largest(self) -> f64 {
        self.position.max(self.rotation)
    }
}

/// The pose of a homogeneous 4x4 matrix in row-major order, checked and, within the tolerance,
/// repaired.
///
/// # Errors
///
/// [`Error::InvalidPose`] when an element is not finite, a coordinate of the position exceeds
/// [`MOST_LENGTH`], the last row is not 0 0 0 1, the rotation mirrors, or its deviation from
/// orthonormal exceeds 1e-5. A rotation with a smaller deviation becomes the
/// nearest rotation.
pub fn pose_from_rows(rows: &[f64; 16]) -> Result<Pose, Error> {
    if let Some(index) = rows.iter().position(|element| !element.is_finite()) {
        return Err(
            PoseFault::NotFinite { row: index / 4, column: index % 4, value: rows[index] }.into()
        );
    }
    let &[r00, r01, r02, x, r10, r11, r12, y, r20, r21, r22, z, l0, l1, l2, l3] = rows;
    check_near("pose", [x, y, z])?;
    if [l0, l1, l2, l3 - 1.0].iter().any(|element| element.abs() > LAST_ROW_BOUND) {
        let is_unit = |column: [f64; 4]| {
            let unit = column.iter().zip([0.0, 0.0, 0.0, 1.0]);
            unit.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) <= LAST_ROW_BOUND
        };
        let transposed = is_unit([x, y, z, l3]);
        return Err(PoseFault::LastRow { row: [l0, l1, l2, l3], transposed }.into());
    }
    let rotation = checked_rotation([[r00, r01, r02], [r10, r11, r12], [r20, r21, r22]])?;
    Ok(IsometryMatrix3::from_parts(Translation3::new(x, y, z), rotation))
}

/// The pose as a homogeneous 4x4 matrix in row-major order.
#[must_use]
pub fn pose_to_rows(pose: &Pose) -> [f64; 16] {
    let r = pose.rotation.matrix();
    let p = &pose.translation.vector;
    [
        r[(0, 0)],
        r[(0, 1)],
        r[(0, 2)],
        p[0],
        r[(1, 0)],
        r[(1, 1)],
        r[(1, 2)],
        p[1],
        r[(2, 0)],
        r[(2, 1)],
        r[(2, 2)],
        p[2],
        0.0,
        0.0,
        0.0,
        1.0,
    ]
}

/// A rotation that is finite, proper and orthonormal to rounding, or an error.
fn checked_rotation(rows: Rows3) -> Result<Rotation3<f64>, Error> {
    let deviation =
        gram_excess(&rows).into_iter().fold(0.0, |most: f64, element| most.max(element.abs()));
    let determinant = determinant(&rows);
    if !deviation.is_finite() || deviation > ROTATION_REPAIR_BOUND {
        return Err(PoseFault::NotOrthonormal { deviation, bound: ROTATION_REPAIR_BOUND }.into());
    }
    if determinant < 0.0 {
        return Err(PoseFault::Mirrored { determinant }.into());
    }
    let [[a, b, c], [d, e, f], [g, h, i]] =
        if deviation <= ROTATION_ROUNDING { rows } else { nearest_rotation(&rows) };
    Ok(Rotation3::from_matrix_unchecked(Matrix3::new(a, b, c, d, e, f, g, h, i)))
}

/// Check a pose from another program: finite, and its rotation orthonormal, repaired as by
/// [`pose_from_rows`].
#[doc(hidden)]
pub fn checked_pose(pose: &Pose) -> Result<Pose, Error> {
    let r = pose.rotation.matrix();
    let rows = [0, 1, 2].map(|row| [r[(row, 0)], r[(row, 1)], r[(row, 2)]]);
    // The comparison is false for NaN, too.
    let is_near = pose.translation.vector.iter().all(|coordinate| coordinate.abs() <= MOST_LENGTH);
    let is_rotation = gram_excess(&rows).iter().all(|element| element.abs() <= ROTATION_ROUNDING);
    if is_near && is_rotation && determinant(&rows) > 0.0 {
        return Ok(*pose);
    }
    pose_from_rows(&pose_to_rows(pose))
}

/// The pose of a translation [m] and a quaternion in the order w, x, y, z, which is normalized.
///
/// # Errors
///
/// [`Error::InvalidPose`] when an element is not finite, a coordinate exceeds [`MOST_LENGTH`] or
/// the quaternion's norm differs from one by more than 2e-3.
pub fn pose_from_wxyz(xyz: [f64; 3], wxyz: [f64; 4]) -> Result<Pose, Error> {
    check_position(xyz)?;
    check_finite("wxyz", &wxyz)?;
    pose_of_quaternion(xyz, wxyz, "w, x, y, z")
}

/// As [`pose_from_wxyz`], of a quaternion in the order x, y, z, w of SciPy and ROS.
///
/// # Errors
///
/// As [`pose_from_wxyz`].
pub fn pose_from_xyzw(xyz: [f64; 3], xyzw: [f64; 4]) -> Result<Pose, Error> {
    check_position(xyz)?;
    check_finite("xyzw", &xyzw)?;
    let [x, y, z, w] = xyzw;
    pose_of_quaternion(xyz, [w, x, y, z], "x, y, z, w")
}

/// A pose from a translation [m] and the rows of a rotation matrix, checked and repaired as by
/// [`pose_from_rows`].
///
/// # Errors
///
/// As [`pose_from_rows`].
pub fn pose_from_rotation(xyz: [f64; 3], rotation: [[f64; 3]; 3]) -> Result<Pose, Error> {
    check_position(xyz)?;
    let elements = rotation.as_flattened();
    if let Some(index) = elements.iter().position(|element| !element.is_finite()) {
        let (row, column, value) = (index / 3, index % 3, elements[index]);
        return Err(PoseFault::NotFinite { row, column, value }.into());
    }
    Ok(IsometryMatrix3::from_parts(Translation3::from(xyz), checked_rotation(rotation)?))
}

/// The pose of a quaternion w, x, y, z, which came in an order of its own.
fn pose_of_quaternion(xyz: [f64; 3], wxyz: [f64; 4], order: &'static str) -> Result<Pose, Error> {
    let norm = wxyz.iter().map(|element| element * element).sum::<f64>().sqrt();
    if (norm - 1.0).abs() > QUATERNION_NORM_BOUND {
        let bound = QUATERNION_NORM_BOUND;
        return Err(PoseFault::QuaternionNorm { norm, bound, order }.into());
    }
    let [w, x, y, z] = wxyz.map(|element| element / norm);
    let rotation = Matrix3::new(
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    );
    Ok(IsometryMatrix3::from_parts(
        Translation3::from(xyz),
        Rotation3::from_matrix_unchecked(rotation),
    ))
}

/// The pose of a translation [m] and ZYX Euler angles rz, ry, rx [rad]: `Rz(rz) Ry(ry) Rx(rx)`.
///
/// # Errors
///
/// [`Error::InvalidPose`] when an element is not finite, a coordinate exceeds [`MOST_LENGTH`], or
/// an angle exceeds a full turn, as degrees do.
pub fn pose_from_euler_zyx(xyz: [f64; 3], zyx: [f64; 3]) -> Result<Pose, Error> {
    check_position(xyz)?;
    check_angles("euler_zyx", &zyx)?;
    Ok(pose_of_zyx(xyz, zyx.map(f64::sin_cos)))
}

/// The pose of a translation [m] and a rotation vector, its axis times its angle [rad], in which
/// Universal Robots' controllers show orientations.
///
/// # Errors
///
/// As [`pose_from_euler_zyx`].
pub fn pose_from_rotvec(xyz: [f64; 3], rotvec: [f64; 3]) -> Result<Pose, Error> {
    check_position(xyz)?;
    check_angles("rotvec", &rotvec)?;
    let angle = Vector3::from(rotvec).norm();
    let (sin, w) = (0.5 * angle).sin_cos();
    let part = if angle > 0.0 { sin / angle } else { 0.5 };
    let [x, y, z] = rotvec.map(|component| part * component);
    pose_of_quaternion(xyz, [w, x, y, z], "w, x, y, z")
}

/// Check angles that are given in radians.
fn check_angles(field: &'static str, angles: &[f64; 3]) -> Result<(), Error> {
    check_finite(field, angles)?;
    let Some(index) = angles.iter().position(|angle| angle.abs() > MOST_EULER) else {
        return Ok(());
    };
    Err(PoseFault::Angle { field, index, value: angles[index], bound: MOST_EULER }.into())
}

/// The pose of a model's constants, as [`pose_from_euler_zyx`] for finite input; quarter turns are
/// exact.
pub fn constant_pose(xyz: [f64; 3], zyx: [f64; 3]) -> Pose {
    pose_of_zyx(xyz, zyx.map(constant_sin_cos))
}

/// The pose of a translation [m] and the sines and cosines of rz, ry, rx.
fn pose_of_zyx(xyz: [f64; 3], [(sz, cz), (sy, cy), (sx, cx)]: [(f64, f64); 3]) -> Pose {
    let rotation = Matrix3::new(
        cz * cy,
        cz * sy * sx - sz * cx,
        cz * sy * cx + sz * sx,
        sz * cy,
        sz * sy * sx + cz * cx,
        sz * sy * cx - cz * sx,
        -sy,
        cy * sx,
        cy * cx,
    );
    IsometryMatrix3::from_parts(Translation3::from(xyz), Rotation3::from_matrix_unchecked(rotation))
}

/// Translation [m] and quaternion w, x, y, z of a pose; w is not negative.
#[must_use]
pub fn pose_to_wxyz(pose: &Pose) -> ([f64; 3], [f64; 4]) {
    (pose.translation.vector.into(), quaternion(&pose.rotation))
}

/// Translation [m] and ZYX Euler angles rz, ry, rx [rad] of a pose, ry in -pi/2 ..= pi/2.
///
/// In gimbal lock (
///
/// ry
///
/// = pi/2) only `rz - rx` or `rz + rx` is determined: rz is set to zero and rx takes the whole
/// angle. Near it each angle is computed from the previous one, so that together they reproduce the
/// pose to rounding.
#[must_use]
pub fn pose_to_euler_zyx(pose: &Pose) -> ([f64; 3], [f64; 3]) {
    let r = pose.rotation.matrix();
    let cos_y = r[(0, 0)].hypot(r[(1, 0)]);
    let (sin_z, cos_z) =
        if cos_y <= GIMBAL_COS { (0.0, 1.0) } else { (r[(1, 0)] / cos_y, r[(0, 0)] / cos_y) };
    let rz = sin_z.atan2(cos_z);
    let ry = (-r[(2, 0)]).atan2(cos_y);
    let rx = (sin_z * r[(0, 2)] - cos_z * r[(1, 2)]).atan2(cos_z * r[(1, 1)] - sin_z * r[(0, 1)]);
    (pose.translation.vector.into(), [rz, ry, rx])
}

fn check_finite(field: &'static str, values: &[f64]) -> Result<(), Error> {
    match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(PoseFault::FieldNotFinite { field, index, value: values[index] }.into()),
        None => Ok(()),
    }
}

/// A translation that is finite and near enough.
fn check_position(xyz: [f64; 3]) -> Result<(), Error> {
    check_finite("xyz", &xyz)?;
    check_near("xyz", xyz)
}

/// A position that is near enough for squares of its coordinates to keep their digits.
fn check_near(field: &'static str, xyz: [f64; 3]) -> Result<(), Error> {
    match xyz.iter().position(|coordinate| coordinate.abs() > MOST_LENGTH) {
        Some(index) => {
            Err(PoseFault::TooFar { field, index, value: xyz[index], bound: MOST_LENGTH }.into())
        }
        None => Ok(()),
    }
}

pub(crate) fn translation_z(z: f64) -> Pose {
    IsometryMatrix3::from_parts(
        Translation3::from(Vector3::new(0.0, 0.0, z)),
        Rotation3::identity(),
    )
}
