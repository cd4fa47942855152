//! RAPID's functions of numbers, vectors, rotations, poses, targets and the robot: one table.

use super::evaluate::{Component, Evaluator, Stop};
use super::geometry::{
    cross, def_frame, difference, dot, euler_zyx, length, mir_pos, normalized, offs, orient_zyx,
    pose_inv, pose_mult, pose_vect, rel_tool,
};
use super::names::{Lookup, Question};
use crate::prelude::*;
use crate::rapid::data::expression::{Call, Expression};
use crate::rapid::data::moves::Target;
use crate::rapid::data::records::{RobTarget, WobjData};
use crate::rapid::data::table::Entry;
use crate::rapid::data::types::{
    Atom, Atoms, JOINTTARGET, NUM, ORIENT, POS, POSE, Part, ROBTARGET, Shape, TOOLDATA, Type,
    WOBJDATA,
};
use crate::rapid::data::unread::Reason;
use crate::rapid::text::fault::RapidFaultKind;
use irbkin::internal::constant_sin_cos;

/// Whether the function of a name, in any case, displaces a target and keeps its confdata.
pub(crate) fn displaces(name: &str) -> bool {
    ["Offs", "RelTool"].iter().any(|own| own.eq_ignore_ascii_case(name))
}

/// The type of what a function of RAPID returns, by its name in any case, if that is known.
pub(crate) fn result_of(name: &str) -> Option<&'static str> {
    Function::named(name).map(|it| it.result.name)
}

pub(super) struct Function {
    name: &'static str,
    required: &'static [&'static Type],
    /// Optional arguments by their names; a switch has no type.
    optional: &'static [(&'static str, Option<&'static Type>)],
    pub(super) result: &'static Type,
    /// The result; `None` where it is not defined.
    apply: fn(&Arguments) -> Option<Atoms>,
    /// What it asks the robot instead.
    ask: Option<fn(&Arguments) -> Option<Question>>,
}

struct Arguments {
    required: Vec<Atoms>,
    /// In the order of the function's own; a switch that is there has no atoms.
    optional: Vec<Option<Atoms>>,
}

impl Arguments {
    /// A required argument.
    fn at<T: Part>(&self, place: usize) -> Option<T> {
        T::take(&mut self.required.get(place)?.clone().into_iter())
    }

    /// An optional argument; the default if it is not there.
    fn or<T: Part>(&self, place: usize, default: T) -> T {
        self.option(place).unwrap_or(default)
    }

    fn option<T: Part>(&self, place: usize) -> Option<T> {
        T::take(&mut self.optional.get(place)?.clone()?.into_iter())
    }

    fn has(&self, place: usize) -> bool {
        matches!(self.optional.get(place), Some(Some(_)))
    }
}

/// The atoms of a result.
#[expect(clippy::unnecessary_wraps, clippy::needless_pass_by_value, reason = "for closures")]
fn made<T: Part>(value: T) -> Option<Atoms> {
    let mut atoms = Atoms::new();
    value.put(&mut atoms);
    Some(atoms)
}

const fn line(
    name: &'static str,
    required: &'static [&'static Type],
    optional: &'static [(&'static str, Option<&'static Type>)],
    result: &'static Type,
    apply: fn(&Arguments) -> Option<Atoms>,
) -> Function {
    Function { name, required, optional, result, apply, ask: None }
}

static ONE_NUMBER: [&Type; 1] = [&NUM];

/// A function of one number, which a `dnum` may be too.
const fn of_number(name: &'static str, apply: fn(&Arguments) -> Option<Atoms>) -> Function {
    line(name, &ONE_NUMBER, &[], &NUM, apply)
}

/// A number to some decimals, 0 without `\Dec`.
fn to_decimals(given: &Arguments, whole: fn(f64) -> f64) -> Option<Atoms> {
    let unit = 10_f64.powf(given.or(0, 0.0));
    made(whole(given.at::<f64>(0)? * unit) / unit)
}

/// The three numbers behind a target.
fn shift(given: &Arguments) -> Option<[f64; 3]> {
    Some([given.at(1)?, given.at(2)?, given.at(3)?])
}

fn turned(given: &Arguments) -> Option<Atoms> {
    let turns = [given.or(0, 0.0), given.or(1, 0.0), given.or(2, 0.0)];
    made(rel_tool(&given.at(0)?, shift(given)?, turns))
}

/// The angle about the axis that a switch names.
fn euler_angle(given: &Arguments) -> Option<Atoms> {
    let [z, y, x] = euler_zyx(given.at(0)?);
    let angles = [x, y, z].into_iter().enumerate();
    made(angles.filter(|(axis, _)| given.has(*axis)).map(|(_, angle)| angle).next()?)
}

fn frame_of_points(given: &Arguments) -> Option<Atoms> {
    let point = |place| given.at::<RobTarget>(place).map(|target| target.trans_mm);
    made(def_frame([point(0)?, point(1)?, point(2)?], given.or(0, 1.0))?)
}

fn mirrored(given: &Arguments) -> Option<Atoms> {
    let (target, plane): (RobTarget, WobjData) = (given.at(0)?, given.at(1)?);
    made(mir_pos(&target, &plane, &given.or(0, WobjData::WOBJ0), given.has(1)))
}

fn sin_cos(given: &Arguments) -> Option<(f64, f64)> {
    Some(constant_sin_cos(given.at::<f64>(0)?.to_radians()))
}

/// Source: the RAPID reference manual.
#[rustfmt::skip]
static FUNCTIONS: &[Function] = &[
    line("Offs", &[&ROBTARGET, &NUM, &NUM, &NUM], &[], &ROBTARGET, |it| made(offs(&it.at(0)?, shift(it)?))),
    line("RelTool", &[&ROBTARGET, &NUM, &NUM, &NUM], &[("Rx", Some(&NUM)), ("Ry", Some(&NUM)), ("Rz", Some(&NUM))], &ROBTARGET, turned),
    line("PoseMult", &[&POSE, &POSE], &[], &POSE, |it| made(pose_mult(it.at(0)?, it.at(1)?))),
    line("PoseInv", &[&POSE], &[], &POSE, |it| made(pose_inv(it.at(0)?))),
    line("PoseVect", &[&POSE, &POS], &[], &POS, |it| made(pose_vect(it.at(0)?, it.at(1)?))),
    line("OrientZYX", &[&NUM, &NUM, &NUM], &[], &ORIENT, |it| made(orient_zyx(it.at(0)?, it.at(1)?, it.at(2)?))),
    line("EulerZYX", &[&ORIENT], &[("X", None), ("Y", None), ("Z", None)], &NUM, euler_angle),
    line("NOrient", &[&ORIENT], &[], &ORIENT, |it| made(normalized(it.at(0)?))),
    line("DefFrame", &[&ROBTARGET, &ROBTARGET, &ROBTARGET], &[("Origin", Some(&NUM))], &POSE, frame_of_points),
    line("MirPos", &[&ROBTARGET, &WOBJDATA], &[("WObj", Some(&WOBJDATA)), ("MirY", None)], &ROBTARGET, mirrored),
    Function { ask: Some(|it| Some(Question::Here(Some((it.option(0), it.option(1)))))), ..line("CRobT", &[], &[("Tool", Some(&TOOLDATA)), ("WObj", Some(&WOBJDATA))], &ROBTARGET, |_| None) },
    // The first atoms of the robtarget.
    Function { ask: Some(|it| Some(Question::Here(Some((it.option(0), it.option(1)))))), ..line("CPos", &[], &[("Tool", Some(&TOOLDATA)), ("WObj", Some(&WOBJDATA))], &POS, |_| None) },
    Function { ask: Some(|_| Some(Question::Here(None))), ..line("CJointT", &[], &[], &JOINTTARGET, |_| None) },
    Function { ask: Some(|it| Some(Question::Converted(Target::JointTarget(it.at(0)?), (it.at(1)?, it.or(0, WobjData::WOBJ0))))), ..line("CalcRobT", &[&JOINTTARGET, &TOOLDATA], &[("WObj", Some(&WOBJDATA))], &ROBTARGET, |_| None) },
    Function { ask: Some(|it| Some(Question::Converted(Target::RobTarget(it.at(0)?), (it.at(1)?, it.or(0, WobjData::WOBJ0))))), ..line("CalcJointT", &[&ROBTARGET, &TOOLDATA], &[("WObj", Some(&WOBJDATA))], &JOINTTARGET, |_| None) },
    line("Distance", &[&POS, &POS], &[], &NUM, |it| made(length(difference(it.at(0)?, it.at(1)?)))),
    line("DotProd", &[&POS, &POS], &[], &NUM, |it| made(dot(it.at(0)?, it.at(1)?))),
    line("CrossProd", &[&POS, &POS], &[], &POS, |it| made(cross(it.at(0)?, it.at(1)?))),
    line("VectMagn", &[&POS], &[], &NUM, |it| made(length(it.at(0)?))),
    of_number("Abs", |it| made(it.at::<f64>(0)?.abs())),
    of_number("NumToDnum", |it| made(it.at::<f64>(0)?)),
    of_number("Sqrt", |it| made(it.at::<f64>(0)?.sqrt())),
    of_number("Exp", |it| made(it.at::<f64>(0)?.exp())),
    of_number("Sin", |it| made(sin_cos(it)?.0)),
    of_number("Cos", |it| made(sin_cos(it)?.1)),
    of_number("Tan", |it| sin_cos(it).and_then(|(sin, cos)| made(sin / cos))),
    of_number("ASin", |it| made(it.at::<f64>(0)?.asin().to_degrees())),
    of_number("ACos", |it| made(it.at::<f64>(0)?.acos().to_degrees())),
    of_number("ATan", |it| made(it.at::<f64>(0)?.atan().to_degrees())),
    line("ATan2", &[&NUM, &NUM], &[], &NUM, |it| made(it.at::<f64>(0)?.atan2(it.at(1)?).to_degrees())),
    line("Pow", &[&NUM, &NUM], &[], &NUM, |it| made(it.at::<f64>(0)?.powf(it.at(1)?))),
    line("Max", &[&NUM, &NUM], &[], &NUM, |it| made(it.at::<f64>(0)?.max(it.at(1)?))),
    line("Min", &[&NUM, &NUM], &[], &NUM, |it| made(it.at::<f64>(0)?.min(it.at(1)?))),
    line("Round", &[&NUM], &[("Dec", Some(&NUM))], &NUM, |it| to_decimals(it, f64::round)),
    line("Trunc", &[&NUM], &[("Dec", Some(&NUM))], &NUM, |it| to_decimals(it, f64::trunc)),
    line("DnumToNum", &[&NUM], &[("Integer", None)], &NUM, |it| made(it.at::<f64>(0)?)),
];

impl Function {
    /// The function of a name, in any case; one of a dnum is a num's.
    fn named(name: &str) -> Option<&'static Self> {
        let entry = Entry::function(name)?;
        FUNCTIONS.iter().find(|it| it.name == entry.name)
    }
}

impl Evaluator<'_, '_> {
    /// The function that a name refers to: a routine or a datum may use the name.
    pub(super) fn function(&self, name: &str) -> Result<&'static Function, Reason> {
        let name_of = || name.to_string();
        let Some(function) = Function::named(name) else {
            return Err(Reason::Function { name: name_of() });
        };
        match self.names.find(self.at, name) {
            Lookup::NotHere => Ok(function),
            _ => Err(Reason::OwnFunction { name: name_of() }),
        }
    }

    /// Append the result of a function, or a component of it.
    pub(super) fn fill_call(
        &self,
        expression: &Expression<'_>,
        call: &Call<'_>,
        place: &Component<'_>,
        atoms: &mut Atoms,
    ) -> Result<(), Stop> {
        let function = match self.function(&call.name) {
            Ok(function) => function,
            Err(reason) => {
                let value = self.names.returned(self.text, expression).ok_or(reason)?;
                return self.fill_value(expression, &value, &call.components, place, atoms);
            }
        };
        let (of, begin) = self.part(expression, function.result, &call.components)?;
        let is_number = |of: &Type| matches!(of.shape, Shape::Num | Shape::Whole);
        if of.name != place.of.name && !(is_number(of) && is_number(place.of)) {
            let found = format!("{}, of type {}", function.name, of.name);
            return Err(self.wrong_type(expression, place, &found));
        }
        let given = self.given(expression, call, function)?;
        let nothing = || Atoms::from_iter([Atom::Num(f64::NAN)]);
        let question = function.ask.and_then(|ask| ask(&given));
        let answer = question.map(|it| self.names.ask(function.name, it)).transpose()?;
        let result = match answer {
            Some(Target::RobTarget(target)) => made(target),
            Some(Target::JointTarget(joints)) => made(joints),
            None => (function.apply)(&given),
        };
        let result = result.unwrap_or_else(nothing);
        for atom in &result {
            if let Atom::Num(number) = atom {
                self.finite(expression, *number)?;
            }
        }
        for atom in result.into_iter().skip(begin).take(of.size()) {
            match atom {
                Atom::Num(number) if is_number(place.of) => {
                    self.fill_number(expression, number, place, atoms)?;
                }
                Atom::Num(number) => atoms.push(Atom::Num(number + 0.0)),
                other => atoms.push(other),
            }
        }
        Ok(())
    }

    fn given(
        &self,
        expression: &Expression<'_>,
        call: &Call<'_>,
        function: &Function,
    ) -> Result<Arguments, Stop> {
        let (found, wanted) = (call.arguments.required.len(), function.required.len());
        if found != wanted {
            let instruction = function.name;
            let kind = RapidFaultKind::ArgumentCount { instruction, found, wanted };
            return Err(self.fault(expression, kind));
        }
        let required = call.arguments.required.iter().zip(function.required);
        let required = required.map(|(argument, of)| self.atoms(argument, of));
        let required = required.collect::<Result<Vec<_>, _>>()?;
        let mut optional: Vec<_> = function.optional.iter().map(|_| None).collect();
        for argument in &call.arguments.optional {
            let mut all = function.optional.iter().zip(&mut optional);
            let own = all.find(|((name, _), _)| argument.is(name));
            let atoms = match (own.as_ref().map(|((_, of), _)| *of), &argument.value) {
                (Some(Some(of)), Some(value)) => self.atoms(value, of)?,
                (Some(None), None) => Atoms::new(),
                _ => {
                    let (name, argument) = (call.name.to_string(), argument.name.to_string());
                    return Err(Reason::FunctionArgument { name, argument }.into());
                }
            };
            if let Some((_, place)) = own {
                *place = Some(atoms);
            }
        }
        Ok(Arguments { required, optional })
    }
}
