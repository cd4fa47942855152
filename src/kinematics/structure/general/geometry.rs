//! The constants of a general arm.

use alloc::sync::Arc;
use alloc::vec::Vec;

use super::split::Split;
use crate::kinematics::structure::closure::Closure;
use crate::kinematics::structure::joint_map::JointMap;

/// An arm of six joints without parallel or coincident neighbors that cost it a degree of freedom.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct General {
    pub(super) closure: Closure,
    pub(super) joint_map: JointMap<6>,
    /// The splits, the best first. They are the same for an arm with any base, tool and limits.
    pub(super) splits: Arc<Vec<Split>>,
    pub(super) roots: RootKind,
}

/// The roots of an arm's splits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RootKind {
    /// Most poses are regular in the first split.
    Regular,
    Irregular,
    /// Three axes meet in one point: roots come in pairs, whose noise one polynomial alone does
    /// not show. So many must certify (eq. 104c).
    Pairs(usize),
}
