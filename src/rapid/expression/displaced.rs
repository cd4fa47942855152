//! RAPID's functions that displace a target.

use crate::kinematics::constant_sin_cos;
use crate::rapid::data::records::RobTarget;

/// A function that returns a displaced target.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Displacement {
    /// `Offs`: in the work object.
    Offs,
    /// `RelTool`: in the tool.
    RelTool,
}

impl Displacement {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Offs => "Offs",
            Self::RelTool => "RelTool",
        }
    }

    pub(crate) fn named(name: &str) -> Option<Self> {
        [Self::Offs, Self::RelTool]
            .into_iter()
            .find(|function| function.name().eq_ignore_ascii_case(name))
    }
}

/// A target displaced by `shift` [mm] and, by RelTool, rotated by `turns` [deg]: about x, then
/// about the new y, then about the new z.
///
/// The order of the rotations is general knowledge of RAPID's reference, not checked on a
/// controller.
pub(crate) fn displaced(
    function: Displacement,
    target: &RobTarget,
    shift: [f64; 3],
    turns: [f64; 3],
) -> RobTarget {
    let mut displaced = *target;
    let shift = if function == Displacement::Offs { shift } else { rotated(target.rot, shift) };
    for (position, shift) in displaced.trans_mm.iter_mut().zip(shift) {
        *position += shift;
    }
    for (axis, turn) in turns.into_iter().enumerate() {
        if turn != 0.0 {
            let (sin, cos) = constant_sin_cos(0.5 * turn.to_radians());
            let mut about = [cos, 0.0, 0.0, 0.0];
            about[axis + 1] = sin;
            displaced.rot = product(displaced.rot, about);
        }
    }
    displaced
}

/// Hamilton's product of two quaternions w, x, y, z.
fn product([aw, ax, ay, az]: [f64; 4], [bw, bx, by, bz]: [f64; 4]) -> [f64; 4] {
    [
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    ]
}

/// A vector rotated by a quaternion of any norm; not finite if the norm is zero and the vector is
/// not.
fn rotated(rot: [f64; 4], vector: [f64; 3]) -> [f64; 3] {
    if vector.iter().all(|component| *component == 0.0) {
        return vector;
    }
    let [w, x, y, z] = rot;
    let [vx, vy, vz] = vector;
    let norm_squared = w * w + x * x + y * y + z * z;
    let [_, tx, ty, tz] = product(product(rot, [0.0, vx, vy, vz]), [w, -x, -y, -z]);
    [tx, ty, tz].map(|component| component / norm_squared)
}
