//! The knowledge at a place of a program: values, settings, displacements, where the robot is.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use super::index::DatumId;
use crate::rapid::data::module::Content;
use crate::rapid::data::records::RapidPose;
use crate::rapid::data::settings::MotionSettings;
use crate::rapid::data::unread::Unresolved;
use crate::rapid::data::value::{DataType, Value};

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
    pub(super) globals: BTreeMap<DatumId, Content>,
    pub(super) locals: Locals,
}

impl State {
    /// At the beginning of a routine of which nothing is known.
    pub(super) fn new() -> Self {
        Self {
            here: Here::Unknown,
            settings: MotionSettings::default(),
            displacement: Displacement::Nothing,
            offsets: Ok([0.0; 6]),
            globals: BTreeMap::new(),
            locals: Locals::new(),
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
            all.globals.retain(|datum, content| end.globals.get(datum) == Some(content));
            for (name, local) in &mut all.locals {
                if end.locals.get(name) != Some(local) {
                    local.content = Err(Unresolved::ValueNotKnown);
                }
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
