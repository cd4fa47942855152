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
    /// Whether most poses are regular in the first split: not where roots are pairs.
    pub(super) is_mostly_regular: bool,
}
