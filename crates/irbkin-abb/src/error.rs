//! Errors of input.

use irbkin::Interrupted;
use irbkin::internal::JointFault;
use irbkin_motion::internal::MotionFault;

use crate::egm::fault::EgmFault;
use crate::prelude::*;
use crate::rapid::text::fault::{FrameFault, RapidFault};

/// Why a call was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The RAPID text is broken.
    #[error(transparent)]
    Rapid(#[from] RapidFault),
    /// A tool and a work object do not go together, or are not poses.
    #[error(transparent)]
    Frame(#[from] FrameFault),
    /// The bytes are no EGM message.
    #[error(transparent)]
    InvalidMessage(#[from] EgmFault),
    /// The robot refuses an argument, or does not reach a target.
    #[error(transparent)]
    Robot(#[from] irbkin::Error),
    /// A path, a shape or a cell is invalid.
    #[error(transparent)]
    Motion(Box<irbkin_motion::Error>),
}

impl From<irbkin_motion::Error> for Error {
    fn from(error: irbkin_motion::Error) -> Self {
        match error {
            irbkin_motion::Error::Robot(error) => Self::Robot(error),
            other => Self::Motion(other.into()),
        }
    }
}

/// Faults of arms and motions that are raised here.
macro_rules! faults {
    ($($Fault:ty)*) => {$(
        impl From<$Fault> for Error {
            fn from(fault: $Fault) -> Self {
                irbkin_motion::Error::from(fault).into()
            }
        }
    )*};
}
faults! { JointFault MotionFault Interrupted }

#[cfg(test)]
mod tests {
    use std::string::ToString;
    use std::vec::Vec;

    use super::*;
    use crate::rapid::text::fault::{Missing, RapidFaultKind};

    #[test]
    fn messages_of_rapid() {
        use RapidFaultKind as Kind;
        let (thing, routine) = ("robtarget p10".to_string(), Some("main".into()));
        let fault = |kind| RapidFault::nowhere(kind).into();
        let count = |part: &str, found| {
            let (thing, part) = (thing.clone(), part.into());
            fault(Kind::ComponentCount { thing, part, found, wanted: 4, missing: "" })
        };
        let indices =
            |found, wanted| fault(Kind::IndexCount { text: "p{1}".into(), found, wanted });
        check(&[
            (
                RapidFault { line: 1, column: 12, kind: Kind::SecondModule }.into(),
                "line 1, column 12: a second module begins, a text must hold one",
            ),
            (count("", 1), "robtarget p10 has 1 component, it must have 4"),
            (count("robconf", 3), "robtarget p10: robconf has 3 components, it must have 4"),
            (indices(1, 0), "p{1} has 1 index, but it is not an array"),
            (indices(2, 1), "p{1} has 2 indices, it must have 1"),
            (
                fault(Kind::SameName { name: "p10".into(), routine: None }),
                "p10 is declared twice in the module",
            ),
            (
                fault(Kind::SameName { name: "p10".into(), routine }),
                "p10 is declared twice in main",
            ),
            (
                fault(Kind::NoSuchValue { missing: Missing::Datum { index: 7, count: 3 } }),
                "there is no datum 7, the module has 3",
            ),
            (
                FrameFault::Held { both: false }.into(),
                "the robot holds neither the tool nor the work object: robhold must be TRUE for one of \
                 them",
            ),
        ]);
    }

    fn check(rows: &[(Error, &str)]) {
        let wrong: Vec<_> =
            rows.iter().filter(|(error, words)| error.to_string() != *words).collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
    }
}
