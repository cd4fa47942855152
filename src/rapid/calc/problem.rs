//! Problems with a target of a table.

use core::fmt;

use alloc::string::{String, ToString};

use super::target::error_name;
use crate::error::Error;
use crate::rapid::data::reason::Reason;
use crate::rapid::data::records::NOT_THERE;
use crate::rapid::data::value::Value;

/// The reason why a target has no joint angles, or others than it requests. `Display` gives the
/// words.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Problem {
    /// The value of the target is unknown.
    Target(Reason),
    /// The value of the tool is unknown.
    Tool {
        /// Its source text.
        text: String,
        /// Why it is unknown.
        reason: Reason,
    },
    /// The value of the work object is unknown.
    WorkObject {
        /// Its source text.
        text: String,
        /// Why it is unknown.
        reason: Reason,
    },
    /// An instruction displaces the move.
    Displaced {
        /// Line of the instruction, from 1; 0 for data that were not read from a text.
        line: usize,
    },
    /// A jointtarget has the angle of an axis that does not exist (9E9).
    AbsentAxis {
        /// The axis, from 1.
        axis: usize,
        /// Its angle [deg].
        degrees: f64,
    },
    /// The joint angles of a jointtarget are outside the limits; reports the joint that exceeds
    /// them most.
    OutsideLimits {
        /// The joint, from 1.
        joint: usize,
        /// How far outside [rad].
        excess: f64,
    },
    /// The joint angles of a jointtarget are outside the limits of the parallelogram linkage, q3 -
    /// q2.
    OutsideLinkageLimits {
        /// How far outside [rad].
        excess: f64,
    },
    /// More than one solution has the configuration: the joint angles are those nearest to the
    /// previous ones.
    Ambiguous {
        /// How many have it.
        count: usize,
    },
    /// No joint angles were found, for this reason.
    NotSolved(Error),
    /// No solution has the configuration: the joint angles are those nearest to the previous ones.
    Nearest(Error),
}

/// An error with its name in RAPID, if it has one.
struct Named<'a>(&'a Error);

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(name) = error_name(self.0) {
            write!(f, "{name}: ")?;
        }
        self.0.fmt(f)
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Target(reason) => reason.fmt(f),
            Self::Tool { text, reason } => write!(f, "tool {text}: {reason}"),
            Self::WorkObject { text, reason } => write!(f, "work object {text}: {reason}"),
            Self::Displaced { line } => {
                write!(f, "line {line} displaces it, which is not followed")
            }
            Self::AbsentAxis { axis, degrees } => {
                let written = if degrees.to_bits() == NOT_THERE.to_bits() {
                    "9E9".to_string()
                } else {
                    Value::Num(*degrees).to_string()
                };
                write!(f, "axis {axis} is {written}: it is not there")
            }
            Self::OutsideLimits { joint, excess } => write!(
                f,
                "ERR_ROBLIMIT: J{joint} is outside its limits by {:.1} deg",
                excess.to_degrees()
            ),
            Self::OutsideLinkageLimits { excess } => write!(
                f,
                "ERR_ROBLIMIT: the linkage (q3 - q2) is outside its limits by {:.1} deg",
                excess.to_degrees()
            ),
            Self::Ambiguous { count } => write!(
                f,
                "{count} solutions have its confdata; the nearest to the joints before is taken"
            ),
            Self::NotSolved(error) => Named(error).fmt(f),
            Self::Nearest(error) => {
                write!(f, "{}; the nearest to the joints before is taken", Named(error))
            }
        }
    }
}
