//! Refusals that list what exists instead: configurations, names.

use core::fmt;

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use thiserror::Error;

use crate::report::{Configuration, FreeJoint};

/// A configuration that no solution inside the limits has.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "no solution inside the limits has the configuration {wanted}; there are {}{}{}",
    Listed(.existing, ", "), if *.more { " and more" } else { "" }, OtherAngles(*.free)
)]
pub struct NoConfiguration {
    /// The one that was asked for.
    pub wanted: Configuration,
    /// The configurations that exist, at every turn inside the limits: the first
    /// [`NoConfiguration::MOST`].
    pub existing: Vec<Configuration>,
    /// Whether there are more.
    pub more: bool,
    /// The joint that a singular pose leaves free: other angles of it have other configurations.
    pub free: Option<FreeJoint>,
}

impl NoConfiguration {
    /// How many configurations are listed at most.
    pub const MOST: usize = 64;
}

/// The end of a message: configurations at other angles of a free joint.
struct OtherAngles(Option<FreeJoint>);

impl fmt::Display for OtherAngles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |free| {
            let joint = free.joint();
            write!(f, ", and others with other angles of J{joint}, which is free at this pose")
        })
    }
}

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

/// Most names that a message lists.
const LISTED: usize = 12;

/// Names for a message: the first of them, quoted, and how many more there are.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    listed: Vec<String>,
    more: usize,
}

impl<T: fmt::Display> FromIterator<T> for Names {
    fn from_iter<I: IntoIterator<Item = T>>(names: I) -> Self {
        let mut names = names.into_iter();
        let listed = names.by_ref().take(LISTED).map(|name| name.to_string()).collect();
        Self { listed, more: names.count() }
    }
}

impl Names {
    pub(super) fn is_empty(&self) -> bool {
        self.listed.is_empty()
    }
}

impl fmt::Display for Names {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Listed(&self.listed, ", ").fmt(f)?;
        if self.more > 0 { write!(f, " and {} more", self.more) } else { Ok(()) }
    }
}

/// Elements with a separator between them.
pub(super) struct Listed<'a, T>(pub(super) &'a [T], pub(super) &'static str);

impl<T: fmt::Display> fmt::Display for Listed<'_, T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0
            .iter()
            .enumerate()
            .try_for_each(|(i, element)| write!(f, "{}{element}", if i == 0 { "" } else { self.1 }))
    }
}
