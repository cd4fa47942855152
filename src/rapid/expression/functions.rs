//! Functions that displace a target: `Offs` and `RelTool`.

use alloc::format;
use alloc::string::ToString;

use super::evaluate::{Component, Evaluator, Stop};
use super::names::Found;
use super::tree::{Call, Expression};
use crate::error::RapidFaultKind;
use crate::kinematics::constant_sin_cos;
use crate::rapid::data::records::RobTarget;
use crate::rapid::data::types::{Atoms, Part, ROBTARGET};
use crate::rapid::data::unread::Reason;
use crate::rapid::text::words::words;

impl Evaluator<'_, '_> {
    /// Append the result of a function.
    pub(super) fn fill_call(
        &self,
        expression: &Expression<'_>,
        call: &Call<'_>,
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let name = || call.name.to_string();
        let Some(function) = Displacement::named(call.name) else {
            return Err(Reason::Function { name: name() }.into());
        };
        // A routine or a datum may use the name.
        let Found::NotHere = self.names.find(self.at, call.name) else {
            return Err(Reason::OwnFunction { name: name() }.into());
        };
        if place.of.name != ROBTARGET.name {
            let found = format!("{}, of type robtarget", function.name());
            return Err(self.wrong_type(expression, place, &found));
        }
        let [point, x, y, z] = call.required.as_slice() else {
            let (instruction, found) = (function.name(), call.required.len());
            let kind = RapidFaultKind::ArgumentCount { instruction, found, wanted: 4 };
            return Err(self.fault(expression, kind));
        };
        let target: RobTarget = self.record(point)?;
        let shift = [self.number(x)?, self.number(y)?, self.number(z)?];
        let mut turns = [0.0; 3];
        for (argument, value) in &call.optional {
            let is = |axis: &&str| axis.eq_ignore_ascii_case(argument);
            let axis = ["Rx", "Ry", "Rz"].iter().position(is);
            let (Displacement::RelTool, Some(axis), Some(angle)) = (function, axis, value) else {
                let argument = (*argument).to_string();
                return Err(Reason::FunctionArgument { name: name(), argument }.into());
            };
            turns[axis] = self.number(angle)?;
        }
        let mut target = displaced(function, &target, shift, turns);
        for number in target.trans_mm.iter_mut().chain(&mut target.rot) {
            *number = self.finite(expression, *number)? + 0.0;
        }
        target.put(atoms);
        Ok(())
    }
}

words! {
    /// A function that returns a displaced target.
    pub(crate) enum Displacement {
        /// In the work object.
        Offs = "Offs",
        /// In the tool.
        RelTool = "RelTool",
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
