//! ABB's RAPID: targets, tools, work objects and moves of a module, read and written.
//!
//! ```
//! use irbkin_abb::rapid::{self, Content, Value};
//!
//! let text = "MODULE Weld
//!     CONST robtarget p10 := [[600,0,800],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
//!     PROC main()
//!         MoveL Offs(p10,0,0,50), v100, fine, tool0;
//!     ENDPROC
//! ENDMODULE";
//! let module = rapid::parse(text, &[])?;
//! let Content::Single(Value::RobTarget(p10)) = &module.find("P10").unwrap().content else {
//!     unreachable!()
//! };
//! assert_eq!(p10.trans_mm, [600.0, 0.0, 800.0]);
//! assert_eq!(&*module.moves()[0].target.text, "Offs(p10,0,0,50)");
//! let again = rapid::parse(&module.to_string(), &[])?;
//! assert_eq!(again.without_positions(), module.without_positions());
//! # Ok::<(), irbkin_abb::Error>(())
//! ```
//!
//! Unknown statements are skipped and listed ([`Module::skipped`]), never guessed; an invalid text
//! is an error with its line and column. Data have the values of their declarations; those that the
//! module assigns have none where it moves, with the reason. A negative zero is read as zero.
//!
//! The layers; each uses only the layers before it:
//!
//! 1. `text`: places, tokens, literals, reserved words and faults of a text.
//! 2. `data`: types, records, values, expressions, statements, moves, modules, and reasons why
//!    something is not read.
//! 3. `expression`: expressions read, and their values.
//! 4. `statements`: the statements of a text read, each once, into one list.
//! 5. `resolve`: names resolved, data in the order of their references, then moves.
//! 6. `module`: whole modules read, compared, made, written, and rewritten in place.
//! 7. `calc`: joint angles of targets and back, one by one and in tables.
//! 8. `program`: modules that know each other, and their moves in the order of calls, with the
//!    values that arguments, assignments and loops give them.
//! 9. `motion`: a routine as one motion, followed, timed and checked.
//! 10. `check`: all moves of a program checked, with corrections of confdata; a program ported.

mod calc;
mod check;
mod data;
mod expression;
mod module;
mod motion;
mod program;
mod resolve;
mod statements;
#[cfg(test)]
mod tests;
#[doc(hidden)]
pub mod text;

pub use self::calc::table::{TableRow, calc_moves, calc_targets};
pub use self::calc::target::{Fallback, calc_joint_t, calc_joint_t_or, calc_rob_t, joint_vector};
pub use self::calc::units::{Unit, UnitAxis, Units};
pub use self::calc::wrong::error_name;
pub use self::check::checker::Carried;
pub use self::check::checker::{CheckOptions, Checked, CheckedMove, check};
pub use self::check::port::{FIRST_TAG, port};
pub use self::check::tasks::Task;
pub use self::check::undeclared::candidates;
pub use self::data::finding::{Code, Edit, Finding, Severity};
pub use self::data::module::{Content, Datum, Module, Routine, RoutineKind, Scope, Storage};
pub use self::data::moves::{Argument, ExtraArgument, Move, MoveKind, MoveOption, Target};
pub use self::data::records::{
    JointTarget, LoadData, NOT_THERE, RapidPose, RobTarget, SpeedData, ToolData, WobjData, ZoneData,
};
pub use self::data::settings::{CirPathMode, MotionSettings, SingArea};
pub use self::data::statement::Statement;
pub use self::data::value::{DataType, Value};
pub use self::expression::reader::DEEPEST_NESTING;
pub use self::module::differences::differing_names;
pub use self::module::read::{decode, parse, parse_record, read};
pub use self::module::write::{NewValue, rewrite};
pub use self::motion::drive::MotionOptions;
pub use self::motion::routine::{MotionMove, RoutineMotion, motion};

pub use self::text::fault::RapidFault;

/// What the faces use of RAPID besides its public names.
#[doc(hidden)]
pub mod internal {
    pub use super::calc::frames::rapid_pose;
    pub use super::calc::target::joint_target;
    pub use super::data::records::GivenTools;
    pub use super::data::table::Entry;
    pub use super::module::read::read_with;
    pub use super::statements::faults::Faults;
    pub use super::text::fault::FrameFault;
}
