//! What can be wrong with the name of an arm.

use core::fmt;

use alloc::string::String;
use alloc::vec::Vec;

/// A name that the catalog does not have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownRobot {
    /// The name that was asked for.
    pub name: String,
    /// Names that are close to it, the closest first.
    pub close: Vec<&'static str>,
}

impl fmt::Display for UnknownRobot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown robot \"{}\"", self.name)?;
        if self.close.is_empty() {
            return write!(f, "; no name of the catalog is close to it");
        }
        for (i, name) in self.close.iter().enumerate() {
            write!(f, "{}\"{name}\"", if i == 0 { "; close names: " } else { ", " })?;
        }
        Ok(())
    }
}
