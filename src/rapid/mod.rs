//! ABB's RAPID: targets, tools, work objects and moves of a module, read and written.
//!
//! ```
//! use irbkin::rapid::{self, Content, Value};
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
//! assert_eq!(module.moves()[0].target.text, "Offs(p10,0,0,50)");
//! let again = rapid::parse(&module.to_string(), &[])?;
//! assert_eq!(again.without_positions(), module.without_positions());
//! # Ok::<(), irbkin::Error>(())
//! ```
//!
//! What is not known is skipped and listed ([`Module::skipped`]), never guessed; an invalid text is
//! an error with its line and column. Data have the values of their declarations; those that the
//! module assigns have none where it moves, with the [`Reason`]. A negative zero is read as zero.
//!
//! The layers, each of which uses only those before it:
//!
//! 1. `text`: places, tokens, literals and reserved words of a text.
//! 2. `data`: types, records, values, declarations, moves, modules, and reasons why something is
//!    not read.
//! 3. `expression`: expressions as they are written, and their values.
//! 4. `statements`: declarations, moves, routines and blocks as they are written, and what is not
//!    read.
//! 5. `resolve`: names resolved, data in the order of their references, then moves.
//! 6. `module`: whole modules read, made, written, and rewritten in place.
//! 7. `calc`: joint angles of targets and back, one by one and in tables.
//! 8. `motion`: a routine as one motion, followed, timed and checked.
//! 9. `check`: all moves of a module checked, with corrections of confdata.

mod calc;
mod check;
mod data;
mod expression;
mod module;
mod motion;
mod resolve;
mod statements;
#[cfg(test)]
mod tests;
mod text;

#[cfg(feature = "python")]
pub(crate) use self::calc::axes::joint_target;
pub use self::calc::fallback::Fallback;
pub use self::calc::problem::Problem;
pub use self::calc::table::{TableRow, calc_moves, calc_targets, moves_table, targets_table};
pub use self::calc::target::{
    calc_joint_t, calc_joint_t_or_nearest, calc_rob_t, error_name, joint_target_of, rob_target_of,
};
pub use self::check::checker::check;
pub use self::check::code::Code;
pub use self::check::diagnostic::{Diagnostic, Edit};
pub use self::data::data_type::DataType;
pub use self::data::module::{Content, Datum, Module, Routine, RoutineKind, Scope, Storage};
pub use self::data::moves::{Argument, Move, MoveKind, MoveOption, Target};
pub use self::data::reason::{AssignedBy, Reason, Unresolved};
pub use self::data::records::{
    JointTarget, LoadData, NOT_THERE, RapidPose, RobTarget, SpeedData, ToolData, WobjData, ZoneData,
};
pub use self::data::settings::{CirPathMode, MotionSettings, SingArea};
pub use self::data::skipped::{NotRead, Skipped};
pub use self::data::value::Value;
pub use self::expression::reader::DEEPEST_NESTING;
pub use self::module::parse::{decode, parse};
pub use self::module::record::parse_record;
pub use self::module::rewrite::{NewValue, rewrite};
pub use self::motion::finding::{Finding, FindingKind};
pub use self::motion::options::MotionOptions;
pub use self::motion::routine::{MotionMove, RoutineMotion, motion};
