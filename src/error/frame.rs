//! What can be wrong with a tool and a work object.

use core::fmt;

use alloc::string::String;

use super::PoseFault;

/// Why a robtarget cannot be seen in its frames.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum FrameFault {
    /// The robot holds both the tool and the work object, or neither.
    Held {
        /// Whether it holds both.
        both: bool,
    },
    /// A mechanical unit moves the work object's user frame: where it stands is not in the data.
    Moved {
        /// The unit, as `ufmec` has it.
        unit: String,
    },
    /// A frame is no pose.
    Pose {
        /// Its name.
        field: &'static str,
        /// What is wrong with it.
        fault: PoseFault,
    },
}

impl fmt::Display for FrameFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Held { both: true } => {
                write!(
                    f,
                    "the robot holds the tool and the work object: robhold must be TRUE for one \
                     of them"
                )
            }
            Self::Held { both: false } => {
                write!(
                    f,
                    "the robot holds neither the tool nor the work object: robhold must be TRUE \
                     for one of them"
                )
            }
            Self::Moved { unit } => write!(
                f,
                "the work object's user frame is moved (ufprog FALSE) by the mechanical unit \
                 \"{unit}\": its position is not in the data"
            ),
            Self::Pose { field, fault } => write!(f, "{field}: {fault}"),
        }
    }
}
