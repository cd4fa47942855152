//! The knowledge at a place of a program: values, settings, displacements, where the robot is.

use alloc::collections::{BTreeMap, BTreeSet};
use alloc::rc::Rc;
use alloc::string::String;
use alloc::vec::Vec;

use super::index::DatumId;
use crate::rapid::data::module::Content;
use crate::rapid::data::records::RapidPose;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::data::unread::Unresolved;
use crate::rapid::data::value::{DataType, Value};

/// Most assigned data, and most names of a routine, whose contents are followed: copies at branches
/// stay small.
pub(super) const MOST_KNOWN: usize = 1000;

/// Where the robot is.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Here {
    Unknown,
    /// After so many steps of a run.
    After(usize, usize),
    /// Nowhere: the routine was left.
    Left,
}

/// The displacement of the targets of moves.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Displacement {
    Nothing,
    /// A pose in the work object, from which the targets are seen, set on a line.
    Known(RapidPose, usize),
    /// Set by the instruction on a line, with values that are not known.
    Unknown(usize),
}

/// The offsets of external axes [deg or mm], or the line of the instruction that sets unknown ones.
pub(super) type Offsets = Result<[f64; 6], usize>;

/// A datum or a parameter of a routine.
#[derive(Clone, PartialEq)]
pub(super) struct Local {
    /// `None` for a type that is not read.
    pub(super) data_type: Option<DataType>,
    /// Its content here, or why it is unknown.
    pub(super) content: Result<Content, Unresolved>,
}

impl Local {
    pub(super) fn single(value: Value) -> Self {
        Self { data_type: Some(value.data_type()), content: Ok(Content::Single(value)) }
    }

    /// How many values it has, at least one.
    pub(super) fn size(&self) -> usize {
        match &self.content {
            Ok(Content::Array { values, .. }) => values.len().max(1),
            _ => 1,
        }
    }
}

/// The data and the parameters of a routine by their names in lower case.
pub(super) type Locals = BTreeMap<String, Local>;

/// The knowledge at a place.
#[derive(Clone, PartialEq)]
pub(super) struct State {
    pub(super) here: Here,
    pub(super) settings: MotionSettings,
    pub(super) displacement: Displacement,
    pub(super) offsets: Offsets,
    /// Assigned data with the contents that they have here; all others are unknown.
    globals: Rc<BTreeMap<DatumId, Content>>,
    pub(super) locals: Rc<Locals>,
}

impl State {
    /// At the beginning of a routine of which nothing is known.
    pub(super) fn new() -> Self {
        Self {
            here: Here::Unknown,
            settings: MotionSettings::default(),
            displacement: Displacement::Nothing,
            offsets: Ok([0.0; 6]),
            globals: Rc::default(),
            locals: Rc::default(),
        }
    }

    /// How many contents were copied since it was the other one: all or none.
    pub(super) fn copied(&self, other: &Self) -> usize {
        let globals =
            if Rc::ptr_eq(&self.globals, &other.globals) { 0 } else { self.globals.len() };
        let locals = if Rc::ptr_eq(&self.locals, &other.locals) { 0 } else { self.locals.len() };
        globals + locals
    }

    /// The content of an assigned datum; `None` if it is not known.
    pub(super) fn global(&self, datum: DatumId) -> Option<&Content> {
        self.globals.get(&datum)
    }

    /// Give a datum another content, or none that is known.
    pub(super) fn set_global(&mut self, datum: DatumId, content: Option<Content>) {
        let content = content
            .filter(|_| self.globals.len() < MOST_KNOWN || self.globals.contains_key(&datum));
        if content.is_none() && !self.globals.contains_key(&datum) {
            return;
        }
        let globals = Rc::make_mut(&mut self.globals);
        match content {
            Some(content) => globals.insert(datum, content),
            None => globals.remove(&datum),
        };
    }

    /// Forget assigned data; all of them without a set.
    pub(super) fn forget_globals(&mut self, assigned: Option<&BTreeSet<DatumId>>) {
        match assigned {
            None => self.globals = Rc::default(),
            Some(assigned) if self.globals.keys().any(|datum| assigned.contains(datum)) => {
                Rc::make_mut(&mut self.globals).retain(|datum, _| !assigned.contains(datum));
            }
            Some(_) => {}
        }
    }

    /// Forget the contents of some names of the routine.
    pub(super) fn forget_locals(&mut self, is_forgotten: impl Fn(&String, &Local) -> bool) {
        if self
            .locals
            .iter()
            .any(|(name, local)| local.content.is_ok() && is_forgotten(name, local))
        {
            for (name, local) in Rc::make_mut(&mut self.locals) {
                if local.content.is_ok() && is_forgotten(name, local) {
                    local.content = Err(Unresolved::ValueNotKnown);
                }
            }
        }
    }

    /// The knowledge behind parts that begin with `entry` and end with `ends`; `line` is theirs.
    pub(super) fn joined(entry: Self, ends: Vec<Self>, line: usize) -> Self {
        let mut ends = ends.into_iter().filter(|end| end.here != Here::Left);
        let Some(mut all) = ends.next() else {
            return Self { here: Here::Left, ..entry };
        };
        for end in ends {
            if end.here != all.here {
                all.here = Here::Unknown;
            }
            all.settings = lenient(all.settings, end.settings);
            if end.displacement != all.displacement {
                all.displacement = Displacement::Unknown(line);
            }
            if end.offsets != all.offsets {
                all.offsets = Err(line);
            }
            if !Rc::ptr_eq(&all.globals, &end.globals) {
                let is_same = |datum: &DatumId, content: &mut Content| {
                    end.globals.get(datum) == Some(content)
                };
                Rc::make_mut(&mut all.globals).retain(is_same);
            }
            if !Rc::ptr_eq(&all.locals, &end.locals) {
                all.forget_locals(|name, local| end.locals.get(name) != Some(local));
            }
        }
        all
    }
}

/// Of two settings the ones with which less is wrong.
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
