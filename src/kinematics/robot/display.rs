//! A robot as text.

use core::fmt;

use super::Robot;
use crate::kinematics::pose::Pose;

impl<const N: usize> fmt::Display for Robot<N> {
    /// Name, number of joints and structure; also coupling, base and tool, if the arm has them.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = if self.name().is_empty() { "unnamed robot" } else { self.name() };
        write!(f, "{name} ({N} joints, {} structure", self.structure())?;
        for (is_so, words) in [
            (self.is_coupled(), "axes 2 and 3 coupled"),
            (*self.base() != Pose::identity(), "with base"),
            (*self.tool() != Pose::identity(), "with tool"),
        ] {
            if is_so {
                write!(f, ", {words}")?;
            }
        }
        f.write_str(")")
    }
}
