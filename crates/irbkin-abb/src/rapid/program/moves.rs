//! Moves with the values that they have at a place, and what displaces their targets there.

use alloc::borrow::Cow;
use alloc::rc::Rc;
use alloc::sync::Arc;

use super::state::{Displacement, Offsets, Place, State};
use super::values::{Scope, argument};
use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::frames::{pose_in, rapid_pose};
use crate::rapid::calc::target::target_pose;
use crate::rapid::calc::units::MOST_DEGREES;
use crate::rapid::data::expression::{Arguments, Expression};
use crate::rapid::data::instructions::Shift;
use crate::rapid::data::moves::{Argument, Move, MoveKind, Target};
use crate::rapid::data::records::{RapidPose, RobTarget, ToolData, WobjData};
use crate::rapid::data::statement::{Instruction, Statement};
use crate::rapid::data::types::Record;
use crate::rapid::data::unread::{AssignedBy, Reason, Unresolved};
use crate::rapid::data::value::{DataType, Value};
use crate::rapid::expression::names::{Names as _, Question};
use irbkin::Pose;

impl Scope<'_, '_> {
    /// Fill a move with the values that it has here. Whether its target depends on what the call of
    /// its routine passes on.
    pub(super) fn fill(&self, own: &mut Cow<'_, Move>) -> bool {
        let is_known = own.target.value.is_ok()
            && own.via.as_ref().is_none_or(|via| via.value.is_ok())
            && own.tool.value.is_ok()
            && own.wobj.as_ref().is_none_or(|wobj| wobj.value.is_ok())
            && own.speed.value.is_ok()
            && own.zone.value.is_ok()
            && own.time.as_ref().is_none_or(|time| time.is_ok());
        if is_known && self.program.effects.by_reference.is_empty() {
            return false;
        }
        let step = own.to_mut();
        let mut is_passed_on = is_parameter(&step.target.value);
        if let Some(via) = &mut step.via {
            is_passed_on |= is_parameter(&via.value);
            self.argument(via);
        }
        if step.kind == MoveKind::MoveAbsJ {
            self.target(&mut step.target, Target::JointTarget);
        } else {
            self.target(&mut step.target, Target::RobTarget);
        }
        // Joint angles hold without their tool, and a move is checked without its speed and zone.
        let takes_last = self.takes_last.get();
        let is_joints = step.kind == MoveKind::MoveAbsJ;
        self.takes_last.set(takes_last && !is_joints);
        let tool = Arc::make_mut(&mut step.tool);
        self.argument(tool);
        self.give(tool, is_joints);
        let absent = step.wobj.as_ref().and_then(|wobj| wobj.text.strip_prefix('?'));
        if absent.is_some_and(|name| self.frame.absent.contains(&name.trim().to_lowercase())) {
            step.wobj = None;
        }
        if let Some(wobj) = &mut step.wobj {
            self.argument(Arc::make_mut(wobj));
        }
        self.takes_last.set(false);
        self.choices.without(|| self.pace(step));
        self.takes_last.set(takes_last);
        is_passed_on
    }

    /// A target of another type than others.
    fn target<T: Record>(&self, target: &mut Argument<Target>, made: fn(T) -> Target) {
        if target.value.is_ok() && !self.is_stale(&target.text) {
            return;
        }
        let reason = target.value.as_ref().err().cloned().unwrap_or(Reason::Unfinished);
        let mut own: Argument<T> = Argument { text: target.text.clone(), value: Err(reason) };
        self.argument(&mut own);
        target.value = own.value.map(made);
    }

    /// An argument that its declarations do not determine, where it is determined here.
    fn argument<T: Record>(&self, argument: &mut Argument<T>) {
        if argument.value.is_ok() && !self.is_stale(&argument.text) {
            return;
        }
        let text = argument.text.strip_prefix('?').unwrap_or(&argument.text);
        match self.record(text) {
            Ok(value) => {
                argument.value = Ok(value);
                if let Some(given) = self.frame.texts.get(&text.trim().to_lowercase()) {
                    argument.text = given.written.as_str().into();
                }
            }
            // The reader knows better why, except of parameters and of lines that it does not name.
            Err(reason) => {
                let is_assigned =
                    matches!(reason, Reason::Reference { why: Unresolved::Assigned { .. }, .. });
                let is_of_robot = matches!(reason, Reason::Robot { .. });
                let is_named = matches!(
                    &argument.value,
                    Err(Reason::Reference {
                        why: Unresolved::Assigned { by: AssignedBy::Line(_) },
                        ..
                    })
                );
                let is_better = is_parameter(&argument.value)
                    || is_assigned && !is_named
                    || matches!(reason, Reason::NoSuchElement { .. });
                if argument.value.is_ok() || is_better || is_of_robot {
                    argument.value = Err(self.frame.named(reason));
                }
            }
        }
    }

    /// Put in the tool that is given for one that nothing declares.
    fn give(&self, tool: &mut Argument<ToolData>, is_joints: bool) {
        let Err(Reason::Reference { name, why: Unresolved::NotDeclared }) = &tool.value else {
            return;
        };
        let given = |name| self.tools.and_then(|tools| tools.get(&name));
        if let Some(given) = given(Some(name.to_lowercase())).or_else(|| given(None)) {
            if !is_joints {
                self.choices.assume(|| "the tool of --tool".into());
            }
            tool.value = Ok(*given);
        }
    }

    /// Speed, zone and duration.
    fn pace(&self, step: &mut Move) {
        let has = |step: &Move, name: &str| {
            step.options.iter().any(|option| option.name.eq_ignore_ascii_case(name))
        };
        if step.speed.value.is_err() && !has(step, "V") {
            let known = self.record(&step.speed.text);
            Arc::make_mut(&mut step.speed).value = known.map_err(|it| self.frame.named(it));
        }
        if step.zone.value.is_err() && !has(step, "Z") {
            let known = self.record(&step.zone.text);
            Arc::make_mut(&mut step.zone).value = known.map_err(|it| self.frame.named(it));
        }
        if step.time.as_ref().is_none_or(|time| time.is_ok()) {
            return;
        }
        let option = step.options.iter().find(|option| option.name.eq_ignore_ascii_case("T"));
        let Some(text) = option.and_then(|option| option.text.as_deref()) else { return };
        let passed = text.strip_prefix('?').map(|name| name.trim().to_lowercase());
        if passed.is_some_and(|name| self.frame.absent.contains(&name)) {
            step.time = None;
        } else {
            let text = text.trim_start_matches('?');
            let time = argument(text).and_then(|it| self.evaluate(text, &it));
            step.time = Some(Box::new(time));
        }
    }

    pub(super) fn displacement(
        &self,
        statement: &Statement,
        instruction: &Instruction,
        shift: Shift,
    ) -> Displacement {
        let pose: Option<RapidPose> = match shift {
            Shift::Off => return Displacement::Nothing,
            Shift::Given => self.argument_of(statement, instruction.arguments.required.first()),
            Shift::Between => self.between(statement, instruction),
        };
        match pose {
            Some(pose) => Displacement::Known(pose, statement.line),
            None => Displacement::Unknown(statement.line),
        }
    }

    pub(super) fn offsets(
        &self,
        statement: &Statement,
        instruction: &Instruction,
        shift: Shift,
    ) -> Offsets {
        let Arguments { required, optional } = &instruction.arguments;
        let first = required.first();
        let offsets = match shift {
            Shift::Off => Some([0.0; 6]),
            Shift::Between => {
                let from: Option<RobTarget> = self.argument_of(statement, first);
                let to = self.here((None, None)).filter(|_| optional.is_empty());
                let between = |(from, to): (RobTarget, RobTarget)| {
                    core::array::from_fn(|axis| to.extax[axis] - from.extax[axis])
                };
                from.zip(to).map(between)
            }
            Shift::Given => {
                let value = |it| self.value(&statement.text, it, DataType::ExtJoint).ok();
                match first.and_then(value) {
                    Some(Value::ExtJoint(offsets)) => Some(offsets),
                    _ => None,
                }
            }
        };
        offsets.ok_or(statement.line)
    }

    fn argument_of<T: Record>(
        &self,
        statement: &Statement,
        argument: Option<&Expression<'_>>,
    ) -> Option<T> {
        self.evaluate(&statement.text, argument?).ok()
    }

    /// Where the robot is, in a tool and a work object.
    fn here(&self, at: (Option<ToolData>, Option<WobjData>)) -> Option<RobTarget> {
        match self.ask("CRobT", Question::Here(Some(at))) {
            Ok(Target::RobTarget(target)) => Some(target),
            _ => None,
        }
    }

    /// The displacement of PDispOn from a programmed position to the one that is executed, which is
    /// where the robot is unless `\ExeP` gives it.
    fn between(&self, statement: &Statement, instruction: &Instruction) -> Option<RapidPose> {
        let arguments = &instruction.arguments;
        let executed: RobTarget = if let Some(executed) = arguments.value("ExeP") {
            self.argument_of(statement, Some(executed))?
        } else {
            let wobj = match arguments.value("WObj") {
                Some(wobj) => Some(self.argument_of(statement, Some(wobj))?),
                None => None,
            };
            let tool = self.argument_of(statement, arguments.required.get(1))?;
            self.here((Some(tool), Some(wobj.unwrap_or(WobjData::WOBJ0))))?
        };
        let programmed: RobTarget = self.argument_of(statement, arguments.required.first())?;
        let [executed, programmed] = [target_pose(&executed), target_pose(&programmed)];
        let (executed, programmed): (Pose, Pose) = (executed.ok()?, programmed.ok()?);
        if arguments.optional.iter().any(|it| it.is("Rot")) {
            return Some(rapid_pose(&(executed * programmed.inverse())));
        }
        let shift = executed.translation.vector - programmed.translation.vector;
        let trans_mm = [shift.x, shift.y, shift.z].map(|m| m * 1e3);
        Some(RapidPose { trans_mm, rot: [1.0, 0.0, 0.0, 0.0] })
    }
}

impl State {
    pub(super) fn displace(&self, own: &mut Cow<'_, Move>) {
        let is_joints = own.kind == MoveKind::MoveAbsJ;
        let displaced = match self.displacement {
            Displacement::Unknown(line) if !is_joints => Some(line),
            _ => None,
        };
        if own.displaced != displaced {
            own.to_mut().displaced = displaced;
        }
        if let (Displacement::Known(pose, _), false) = (self.displacement, is_joints) {
            let step = own.to_mut();
            let targets = [
                match &mut step.target.value {
                    Ok(Target::RobTarget(target)) => Some(target),
                    _ => None,
                },
                step.via.as_mut().and_then(|via| via.value.as_mut().ok()),
            ];
            for target in targets.into_iter().flatten() {
                if let Ok(displaced) = displaced_by(&pose, target) {
                    *target = displaced;
                }
            }
        }
        if own.options.iter().any(|option| option.name.eq_ignore_ascii_case("NoEOffs")) {
            return;
        }
        let has_external = |axis: &f64| axis.abs() < MOST_DEGREES;
        match self.offsets {
            Ok(offsets) if offsets.iter().all(|offset| offset.abs() <= 0.0) => {}
            Ok(offsets) => {
                if let Some(axes) = external_axes(own.to_mut()) {
                    for (axis, offset) in axes.iter_mut().zip(offsets) {
                        if has_external(axis) && has_external(&offset) {
                            *axis += offset;
                        }
                    }
                }
            }
            Err(line) => {
                let step = own.to_mut();
                if external_axes(step).is_some_and(|axes| axes.iter().any(has_external)) {
                    step.displaced = Some(line);
                }
            }
        }
    }
}

/// Where the robot is behind a move, which has the name of `written`.
pub(super) fn place_behind(step: &Move, written: &Move) -> Place {
    let has = |name| step.options.iter().any(|it| it.name.eq_ignore_ascii_case(name));
    // Others are searches and processes with sensors.
    let name = written.instruction.to_lowercase();
    let meets = name.starts_with("move") || name.starts_with("trigg");
    let stops = has("Inpos") || step.zone.value.as_ref().is_ok_and(|zone| zone.finep);
    let wobj = step.wobj.as_ref().map_or(Ok(WobjData::WOBJ0), |wobj| wobj.value.clone());
    match (&step.target.value, &step.tool.value, wobj, step.displaced) {
        _ if !meets || has("Conc") || has("Corr") => Err("the move before it may end elsewhere"),
        _ if !stops => Err("the move before it has a zone"),
        (Ok(target), Ok(tool), Ok(wobj), None) => Ok(Rc::new((target.clone(), (*tool, wobj)))),
        _ => Err("the target of the move before it is not known"),
    }
}

fn external_axes(step: &mut Move) -> Option<&mut [f64; 6]> {
    match step.target.value.as_mut().ok()? {
        Target::RobTarget(target) => Some(&mut target.extax),
        Target::JointTarget(target) => Some(&mut target.extax),
    }
}

fn displaced_by(pose: &RapidPose, target: &RobTarget) -> Result<RobTarget, Error> {
    let RapidPose { trans_mm, rot } =
        rapid_pose(&(pose_in(pose, "displacement")? * target_pose(target)?));
    Ok(RobTarget { trans_mm, rot, ..*target })
}

/// Whether a value is unknown because it is a parameter, or refers to one.
fn is_parameter<T>(value: &Result<T, Reason>) -> bool {
    matches!(
        value,
        Err(Reason::Reference { why: Unresolved::Parameter { .. }, .. } | Reason::OptionalArgument)
    )
}
