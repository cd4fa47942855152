//! Settings of motion across calls: a routine begins with its callers' settings, and leaves its own
//! to them.

use alloc::borrow::Cow;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use crate::rapid::data::module::Module;
use crate::rapid::data::settings::{MotionSettings, Setting};
use crate::rapid::data::unread::NotRead;

/// How often settings are passed on from routine to routine.
const PASSES: usize = 8;

/// A setting, a call or a move, in the order of the text.
enum Event<'m> {
    Setting(&'m Setting),
    Call(String),
    Move(usize),
}

/// Settings, and which of `ConfL`, `ConfJ`, `SingArea` and `CirPathMode` were set.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
struct State {
    values: MotionSettings,
    is_set: [bool; 4],
}

impl State {
    /// Set what an instruction sets, such as `ConfL\Off;`.
    fn set(&mut self, text: &str) {
        let mut words = text.split(|c: char| !(c.is_alphanumeric() || c == '_'));
        let name = words.next().unwrap_or_default();
        let switch = words.find(|word| !word.is_empty());
        let place =
            MotionSettings::INSTRUCTIONS.iter().position(|it| it.eq_ignore_ascii_case(name));
        if let Some(place) = place
            && self.values.set(name, switch)
        {
            self.is_set[place] = true;
        }
    }

    /// Take what was set in a routine that was called.
    fn take(&mut self, called: Self) {
        let (own, other) = (&mut self.values, &called.values);
        for (place, is_set) in called.is_set.into_iter().enumerate().filter(|(_, is_set)| *is_set) {
            self.is_set[place] = is_set;
            match place {
                0 => own.conf_l = other.conf_l,
                1 => own.conf_j = other.conf_j,
                2 => own.sing_area = other.sing_area,
                _ => own.cir_path_mode = other.cir_path_mode,
            }
        }
    }
}

/// Of two callers the settings with which less is wrong.
fn lenient(a: MotionSettings, b: MotionSettings) -> MotionSettings {
    let default = MotionSettings::default();
    let pick = |is_default| if is_default { b } else { a };
    MotionSettings {
        conf_l: a.conf_l && b.conf_l,
        conf_j: a.conf_j && b.conf_j,
        sing_area: pick(a.sing_area == default.sing_area).sing_area,
        cir_path_mode: pick(a.cir_path_mode == default.cir_path_mode).cir_path_mode,
    }
}

/// The module whose moves have the settings that their routines are called with.
pub(super) fn with_inherited(module: &Module) -> Cow<'_, Module> {
    if module.settings.is_empty() {
        return Cow::Borrowed(module);
    }
    let routines = events(module);
    let mut entries: BTreeMap<String, MotionSettings> = BTreeMap::new();
    let mut exits: BTreeMap<String, State> = BTreeMap::new();
    let mut found = Vec::new();
    for _ in 0..PASSES {
        let mut calls: BTreeMap<String, MotionSettings> = BTreeMap::new();
        let mut leaves: BTreeMap<String, State> = BTreeMap::new();
        found.clear();
        for (routine, events) in &routines {
            let values = entries.get(routine).copied().unwrap_or_default();
            let mut state = State { values, ..State::default() };
            for event in events {
                match event {
                    Event::Setting(setting) => state.set(&setting.text),
                    Event::Move(index) => found.push((*index, state.values)),
                    Event::Call(name) => {
                        let before = state.values;
                        let entry = calls.entry(name.clone()).or_insert(before);
                        *entry = lenient(*entry, before);
                        if let Some(called) = exits.get(name) {
                            state.take(*called);
                        }
                    }
                }
            }
            leaves.insert(routine.clone(), state);
        }
        if calls == entries && leaves == exits {
            break;
        }
        (entries, exits) = (calls, leaves);
    }
    let is_same = |(index, values): &(usize, MotionSettings)| {
        module.moves.get(*index).is_none_or(|step| step.settings == *values)
    };
    if found.iter().all(is_same) {
        return Cow::Borrowed(module);
    }
    let mut module = module.clone();
    for (index, values) in found {
        if let Some(step) = module.moves.get_mut(index) {
            step.settings = values;
        }
    }
    Cow::Owned(module)
}

/// The events of each routine, by its name in lower case, in the order of the text.
fn events(module: &Module) -> BTreeMap<String, Vec<Event<'_>>> {
    let lower = |routine: &Option<String>| routine.as_deref().unwrap_or_default().to_lowercase();
    let moves = module.moves.iter().enumerate();
    let moves = moves.map(|(index, it)| (it.line, it.column, &it.routine, Event::Move(index)));
    let settings = module.settings.iter();
    let settings = settings.map(|it| (it.line, it.column, &it.routine, Event::Setting(it)));
    let calls = module.skipped.iter().filter_map(|it| match &it.what {
        NotRead::Instruction { name } => {
            Some((it.line, it.column, &it.routine, Event::Call(name.to_lowercase())))
        }
        _ => None,
    });
    let mut all: Vec<_> = moves.chain(settings).chain(calls).collect();
    all.sort_by_key(|(line, column, ..)| (*line, *column));
    let mut routines: BTreeMap<String, Vec<Event<'_>>> = BTreeMap::new();
    for (_, _, routine, event) in all {
        routines.entry(lower(routine)).or_default().push(event);
    }
    routines
}
