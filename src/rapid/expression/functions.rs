//! Evaluates functions: `Offs` and `RelTool`.

use alloc::format;
use alloc::string::ToString;

use super::displaced::{Displacement, displaced};
use super::evaluate::{Evaluator, Path, Stop};
use super::names::Found;
use super::tree::{Call, Expression};
use crate::error::RapidFaultKind;
use crate::rapid::data::parts::PartMut;
use crate::rapid::data::reason::Reason;
use crate::rapid::data::records::RobTarget;

impl Evaluator<'_, '_> {
    /// Write the result of a function to its place.
    pub(super) fn fill_call(
        &self,
        expression: &Expression<'_>,
        call: &Call<'_>,
        place: PartMut<'_>,
        path: &Path<'_>,
    ) -> Result<(), Stop> {
        let name = || call.name.to_string();
        let Some(function) = Displacement::named(call.name) else {
            return Err(Reason::Function { name: name() }.into());
        };
        // A routine or a datum may use the name.
        let Found::NotHere = self.names.find(self.at, call.name) else {
            return Err(Reason::OwnFunction { name: name() }.into());
        };
        let PartMut::RobTarget(place) = place else {
            let found = format!("{}, of type robtarget", function.name());
            return Err(self.wrong_type(expression, &place, path, &found));
        };
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
        *place = displaced(function, &target, shift, turns);
        for number in place.trans_mm.iter_mut().chain(&mut place.rot) {
            *number = self.finite(expression, *number)? + 0.0;
        }
        Ok(())
    }
}
