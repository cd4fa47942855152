//! `irbkin.rapid`: modules read, solved, timed, checked and written.

mod calc;
mod checked;
mod checks;
pub(super) mod class;
mod instructions;
mod module;
pub(super) mod program;
pub(super) mod records;
mod routine_motion;
mod text;
mod values;

use pyo3::prelude::*;
use pyo3::types::PyMapping;

use self::checked::{Checked, CheckedMove, Finding};
use self::class::{
    JointTarget, LoadData, RapidPose, RobTarget, SpeedData, ToolData, WobjData, ZoneData,
};
use self::module::RapidModule;
use self::program::{
    Argument, Declaration, MotionMove, MotionSettings, Move, Routine, Skipped, TargetTable,
    TextFault,
};
use self::routine_motion::PyRoutineMotion;
use irbkin_abb::rapid::{FIRST_TAG, NOT_THERE};

/// Add classes and functions to the extension module.
pub(super) fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("FIRST_TAG", FIRST_TAG)?;
    module.add("NOT_THERE", NOT_THERE)?;
    add!(module: classes [
        RobTarget, JointTarget, ToolData, WobjData, RapidPose, LoadData, SpeedData, ZoneData,
        Declaration, Argument, MotionSettings, Move, MotionMove, Finding, Skipped, TextFault,
        TargetTable, RapidModule, PyRoutineMotion, Checked, CheckedMove, Routine,
    ], functions [
        text::parse, text::parse_module, text::read_module, text::read_modules,
        text::differing_names, text::dump, calc::calc_joint_t, calc::calc_rob_t,
        calc::calc_moves, calc::calc_targets, routine_motion::motion, checks::check,
        checks::check_program, checks::port_program, checks::check_codes, instructions::instructions,
    ]);
    PyMapping::register::<RapidModule>(module.py())
}
