//! Types that a program defines. Names are in lower case.

use crate::prelude::*;
use alloc::collections::BTreeMap;

/// Most names that stand for one another, and records in records.
pub(crate) const DEEPEST_TYPE: usize = 8;

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OwnType {
    pub(crate) of: Definition,
    pub(crate) is_local: bool,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Definition {
    Alias(String),
    /// As a record: the type and the name of each component.
    Record(Vec<(String, String)>),
}

pub(crate) type OwnTypes = BTreeMap<String, OwnType>;
