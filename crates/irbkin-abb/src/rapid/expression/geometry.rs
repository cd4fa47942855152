//! Poses, vectors and quaternions w, x, y, z as RAPID's functions calculate with them. Lengths are
//! in mm, angles in degrees.
//!
//! The definitions are the ones of the RAPID reference manual; a quaternion may have any norm.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use crate::rapid::data::records::{RapidPose, RobTarget, WobjData};
use irbkin::internal::constant_sin_cos;

/// |cos ry| below which only rz - rx or rz + rx is determined [1]: rounding of a quaternion.
const GIMBAL_COS: f64 = 1e-12;

/// Offs: a target displaced in the work object.
pub(super) fn offs(target: &RobTarget, shift: [f64; 3]) -> RobTarget {
    RobTarget { trans_mm: sum(target.trans_mm, shift), ..*target }
}

/// RelTool: a target displaced in the tool and rotated by `turns`: about x, then about the new y,
/// then about the new z.
///
/// The order of the rotations is general knowledge of RAPID's reference, not checked on a
/// controller.
pub(super) fn rel_tool(target: &RobTarget, shift: [f64; 3], turns: [f64; 3]) -> RobTarget {
    let mut displaced = offs(target, rotated(target.rot, shift));
    for (axis, turn) in turns.into_iter().enumerate() {
        if turn != 0.0 {
            displaced.rot = product(displaced.rot, turn_about(axis, turn));
        }
    }
    displaced
}

fn turn_about(axis: usize, degrees: f64) -> [f64; 4] {
    let (sin, cos) = constant_sin_cos(0.5 * degrees.to_radians());
    let mut about = [cos, 0.0, 0.0, 0.0];
    about[axis + 1] = sin;
    about
}

/// Hamilton's product of two quaternions: the rotation by the second one, then by the first.
pub(super) fn product([aw, ax, ay, az]: [f64; 4], [bw, bx, by, bz]: [f64; 4]) -> [f64; 4] {
    [
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    ]
}

/// A vector rotated by a quaternion; not finite if the norm is zero and the vector is not.
pub(super) fn rotated(rot: [f64; 4], vector: [f64; 3]) -> [f64; 3] {
    if vector.iter().all(|component| *component == 0.0) {
        return vector;
    }
    let [vx, vy, vz] = vector;
    let [_, tx, ty, tz] = product(product(rot, [0.0, vx, vy, vz]), conjugate(rot));
    [tx, ty, tz].map(|component| component / norm_squared(rot))
}

fn conjugate([w, x, y, z]: [f64; 4]) -> [f64; 4] {
    [w, -x, -y, -z]
}

fn norm_squared(rot: [f64; 4]) -> f64 {
    rot.iter().map(|component| component * component).sum()
}

pub(super) fn normalized(rot: [f64; 4]) -> [f64; 4] {
    let norm = norm_squared(rot).sqrt();
    rot.map(|component| component / norm)
}

pub(super) fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn scaled(a: [f64; 3], by: f64) -> [f64; 3] {
    a.map(|component| component * by)
}

pub(super) fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    sum(a, scaled(b, -1.0))
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn length(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// PoseVect: a vector seen from the frame around.
pub(super) fn pose_vect(pose: RapidPose, vector: [f64; 3]) -> [f64; 3] {
    sum(pose.trans_mm, rotated(pose.rot, vector))
}

/// PoseMult: the second frame, which is seen from the first, seen from the frame around.
pub(super) fn pose_mult(first: RapidPose, second: RapidPose) -> RapidPose {
    RapidPose { trans_mm: pose_vect(first, second.trans_mm), rot: product(first.rot, second.rot) }
}

/// PoseInv: the frame around seen from the frame.
pub(super) fn pose_inv(pose: RapidPose) -> RapidPose {
    let rot = conjugate(pose.rot).map(|component| component / norm_squared(pose.rot));
    RapidPose { trans_mm: scaled(rotated(rot, pose.trans_mm), -1.0), rot }
}

/// OrientZYX: about z, then about the new y, then about the new x.
pub(super) fn orient_zyx(z: f64, y: f64, x: f64) -> [f64; 4] {
    product(product(turn_about(2, z), turn_about(1, y)), turn_about(0, x))
}

/// EulerZYX: the angles about z, y and x; in gimbal lock the one about z is 0.
pub(super) fn euler_zyx(rot: [f64; 4]) -> [f64; 3] {
    let [x, y, z] = axes(rot);
    let cos_y = x[0].hypot(x[1]);
    let locked = cos_y <= GIMBAL_COS;
    let (sin_z, cos_z) = if locked { (0.0, 1.0) } else { (x[1] / cos_y, x[0] / cos_y) };
    let about_x = (sin_z * z[0] - cos_z * z[1]).atan2(cos_z * y[1] - sin_z * y[0]);
    [sin_z.atan2(cos_z), (-x[2]).atan2(cos_y), about_x].map(f64::to_degrees)
}

fn axes(rot: [f64; 4]) -> [[f64; 3]; 3] {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|unit| rotated(rot, unit))
}

/// The quaternion of a rotation with these axes, by the largest of its squares.
fn of_axes([x, y, z]: [[f64; 3]; 3]) -> [f64; 4] {
    let squares = [
        1.0 + x[0] + y[1] + z[2],
        1.0 + x[0] - y[1] - z[2],
        1.0 - x[0] + y[1] - z[2],
        1.0 - x[0] - y[1] + z[2],
    ];
    let (wx, wy, wz) = (y[2] - z[1], z[0] - x[2], x[1] - y[0]);
    let (xy, xz, yz) = (x[1] + y[0], x[2] + z[0], y[2] + z[1]);
    let largest = (0..4).fold(0, |best, i| if squares[i] > squares[best] { i } else { best });
    let rot = match largest {
        0 => [squares[0], wx, wy, wz],
        1 => [wx, squares[1], xy, xz],
        2 => [wy, xy, squares[2], yz],
        _ => [wz, xz, yz, squares[3]],
    };
    normalized(rot)
}

/// DefFrame: x from the first to the second point, the third one in the plane of x and y. `origin`
/// is the point in the origin; for 3, the third point is on y.
pub(super) fn def_frame(points: [[f64; 3]; 3], origin: f64) -> Option<RapidPose> {
    let [first, second, third] = points;
    let to_third = difference(third, first);
    let along = difference(second, first);
    let x = scaled(along, 1.0 / length(along));
    let normal = cross(x, to_third);
    let z = scaled(normal, 1.0 / length(normal));
    let trans_mm = match origin {
        1.0 => first,
        2.0 => second,
        3.0 => sum(first, scaled(x, dot(x, to_third))),
        _ => return None,
    };
    Some(RapidPose { trans_mm, rot: of_axes([x, cross(z, x), z]) })
}

/// MirPos: a target mirrored in the plane of x and y of a work object. Of the tool's axes, z and x
/// (or y) are mirrored; the third follows.
pub(super) fn mir_pos(
    target: &RobTarget,
    plane: &WobjData,
    wobj: &WobjData,
    keeps_y: bool,
) -> RobTarget {
    let frame = |wobj: &WobjData| pose_mult(wobj.uframe, wobj.oframe);
    let seen = RapidPose { trans_mm: target.trans_mm, rot: target.rot };
    let to_plane = pose_mult(pose_inv(frame(plane)), frame(wobj));
    let in_plane = pose_mult(to_plane, seen);
    let mirrored = |[x, y, z]: [f64; 3]| [x, y, -z];
    let [x, y, z] = axes(in_plane.rot).map(mirrored);
    let rot = if keeps_y { [cross(y, z), y, z] } else { [x, cross(z, x), z] };
    let mirror = RapidPose { trans_mm: mirrored(in_plane.trans_mm), rot: of_axes(rot) };
    let RapidPose { trans_mm, rot } = pose_mult(pose_inv(to_plane), mirror);
    RobTarget { trans_mm, rot, ..*target }
}
