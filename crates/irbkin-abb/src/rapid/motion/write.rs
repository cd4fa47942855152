//! A motion as a module of its own.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::sync::Arc;

use super::routine::RoutineMotion;
use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::target::joint_target;
use crate::rapid::data::module::{Datum, Module, Storage};
use crate::rapid::data::moves::{Argument, Move, MoveKind, MoveOption, Target};
use crate::rapid::data::records::{NOT_THERE, ToolData, WobjData};
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::data::value::Value;
use crate::rapid::expression::names::predefined;
use crate::rapid::text::words::is_name;

impl<const N: usize> RoutineMotion<N> {
    /// The motion as a module: a `MoveAbsJ` to the joints of each target that is met or passed,
    /// with its external axes, speed, zone, `\T`, tool and work object. Between the targets the
    /// joints move evenly. Tools and work objects are declared as `PERS`; speeds and zones that are
    /// not RAPID's own are written as numbers.
    ///
    /// # Errors
    ///
    /// [`Error::Rapid`] for a name that is not a valid name.
    pub fn to_module(&self, name: &str) -> Result<Module, Error> {
        let routine = self.routine.clone().unwrap_or_else(|| "main".to_string());
        let mut data = Data::default();
        let mut moves = Vec::with_capacity(self.moves.len());
        for made in &self.moves {
            let Some(q) = made.q else { continue };
            let step = &made.step;
            let target = match &step.target.value {
                Ok(Target::JointTarget(target)) => *target,
                Ok(Target::RobTarget(target)) => joint_target(&q, target.extax),
                Err(_) => joint_target(&q, [NOT_THERE; 6]),
            };
            let tool = data.tool(&step.tool);
            moves.push(Move {
                kind: MoveKind::MoveAbsJ,
                instruction: MoveKind::MoveAbsJ.name().into(),
                routine: Some(routine.as_str().into()),
                line: 0,
                column: 0,
                via: None,
                target: Argument {
                    text: target.to_string().into(),
                    value: Ok(Target::JointTarget(target)),
                },
                target_span: 0..0,
                speed: numbers(&step.speed),
                zone: numbers(&step.zone),
                tool: tool.into(),
                wobj: step.wobj.as_ref().map(|wobj| data.wobj(wobj).into()),
                options: time(step).into_iter().collect(),
                extra: Vec::new(),
                displaced: None,
                time: step.time.clone(),
                settings: MotionSettings::default(),
            });
        }
        Module::new(Some(name.to_string()), data.declared, moves, &[])
    }
}

/// The duration of `\T`, if it is known.
fn time(step: &Move) -> Option<MoveOption> {
    let Some(Ok(time)) = step.time.as_deref() else { return None };
    let text = Some(Value::Num(*time).to_string());
    Some(MoveOption { after: 2, name: "T".to_string(), text })
}

/// A speed or a zone as its own name or, if it is not RAPID's own or an option changes it, as
/// numbers.
fn numbers<T: Clone + ToString>(Argument { text, value }: &Argument<T>) -> Arc<Argument<T>> {
    let written = value.as_ref().map_or_else(|_| text.to_string(), ToString::to_string);
    let own = predefined(&text.to_lowercase()).map(|own| own.to_string());
    let text = if own.as_ref() == Some(&written) { text.clone() } else { written.into() };
    Arc::new(Argument { text, value: value.clone() })
}

/// The tools and work objects that moves name.
#[derive(Default)]
struct Data {
    declared: Vec<Datum>,
    /// Names in lower case.
    known: BTreeSet<String>,
    /// Texts that are not names, with the names that they get.
    named: BTreeMap<String, String>,
}

impl Data {
    fn tool(&mut self, tool: &Argument<ToolData>) -> Argument<ToolData> {
        let value = tool.value.as_ref().ok().filter(|tool| **tool != ToolData::TOOL0);
        let value = value.map(|tool| Value::ToolData(*tool));
        let is_own = tool.value == Ok(ToolData::TOOL0);
        let text = if is_own { "tool0".to_string() } else { self.name("tool", &tool.text, value) };
        Argument { text: text.into(), value: tool.value.clone() }
    }

    fn wobj(&mut self, wobj: &Argument<WobjData>) -> Argument<WobjData> {
        let value = wobj.value.as_ref().ok().map(|wobj| Value::WobjData(wobj.clone()));
        let is_own = wobj.value == Ok(WobjData::WOBJ0);
        let text = if is_own { "wobj0".to_string() } else { self.name("wobj", &wobj.text, value) };
        Argument { text: text.into(), value: wobj.value.clone() }
    }

    /// The name of a datum, which is declared with its value.
    fn name(&mut self, prefix: &str, text: &str, value: Option<Value>) -> String {
        let Some(value) = value else { return text.to_string() };
        if let Some(name) = self.named.get(text) {
            return name.clone();
        }
        let mut name = text.to_string();
        let mut number = 0;
        while !is_name(&name) || predefined(&name.to_lowercase()).is_some() {
            number += 1;
            name = format!("{prefix}_{number}");
            if self.known.contains(&name) {
                name.clear();
            }
        }
        if self.known.insert(name.to_lowercase()) {
            self.declared.push(Datum::single(name.clone(), Storage::Pers, value));
        }
        if name != text {
            self.named.insert(text.to_string(), name.clone());
        }
        name
    }
}
