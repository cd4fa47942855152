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
    /// The arm that it means, where that is left out of the catalog on purpose.
    pub left_out: Option<LeftOut>,
}

/// An arm that is left out of the catalog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// Its name, or those of several arms.
    pub name: &'static str,
    /// Why it is left out.
    pub reason: &'static str,
}

impl fmt::Display for UnknownRobot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "unknown robot \"{}\"", self.name)?;
        if let Some(LeftOut { name, reason }) = self.left_out {
            return write!(f, "; left out of the catalog: {name}: {reason}");
        }
        if self.close.is_empty() {
            return write!(
                f,
                "; no name of the catalog is close to it: catalog() lists all, from_urdf and \
                 from_mdh take other arms"
            );
        }
        for (i, name) in self.close.iter().enumerate() {
            write!(f, "{}\"{name}\"", if i == 0 { "; close names: " } else { ", " })?;
        }
        Ok(())
    }
}
