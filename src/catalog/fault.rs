//! A name that is refused.

use core::fmt;

use alloc::string::String;
use alloc::vec::Vec;

use thiserror::Error;

use crate::report::Listed;

/// A name that the catalog does not have.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub struct UnknownRobot {
    /// The name that was asked for.
    pub name: String,
    /// Names that are close to it, the closest first.
    pub close: Vec<&'static str>,
    /// The arm that it means, where that is left out of the catalog on purpose.
    pub left_out: Option<LeftOut>,
}

/// An arm that is left out of the catalog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Its name, or the names of several arms.
    pub name: &'static str,
    /// Why it is left out.
    pub reason: &'static str,
}

impl fmt::Display for UnknownRobot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown robot \"{}\"; ", self.name)?;
        if let Some((_, "urdf" | "xacro" | "xml")) = self.name.rsplit_once('.') {
            return f.write_str("a file of a robot is read by from_urdf");
        }
        match (&self.left_out, &self.close[..]) {
            (Some(LeftOut { name, reason }), _) => {
                write!(f, "left out of the catalog: {name}: {reason}")
            }
            (None, []) => f.write_str(
                "no name of the catalog is close to it: catalog() lists all, from_urdf and \
                 from_mdh take other arms",
            ),
            (None, close) => write!(f, "close names: \"{}\"", Listed(close, "\", \"")),
        }
    }
}
