//! Why a RAPID routine is no single motion.

use core::fmt;

use alloc::string::String;

use super::Names;

/// Why a routine is no single motion.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum RoutineFault {
    /// A module has no such routine.
    Unknown {
        /// The name.
        name: String,
        /// Those that it has.
        known: Names,
    },
    /// Several routines move, and no name says which is meant.
    Which {
        /// Those that move.
        moving: Names,
    },
    /// A routine has no move.
    NoMoves {
        /// The routine.
        routine: String,
    },
    /// A branch, a loop or a jump decides which moves of a routine are made.
    Branch {
        /// Its word.
        word: String,
    },
    /// Not one move of a routine can be made.
    NoMotion {
        /// What is wrong with the first one.
        finding: String,
    },
}

impl fmt::Display for RoutineFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { name, known } => {
                write!(f, "the module has no routine {name:?}; it has: {known}")
            }
            Self::Which { moving } => {
                write!(f, "give routine, one of those that move: {moving}")
            }
            Self::NoMoves { routine } => write!(f, "{routine} has no move that is read"),
            Self::Branch { word } => write!(
                f,
                "{word} decides which moves are made: give a routine without branches, loops and \
                 jumps around its moves"
            ),
            Self::NoMotion { finding } => write!(f, "no move can be made: {finding}"),
        }
    }
}
