//! A robot as text, and names of its file.

use core::fmt;

use alloc::string::String;
use alloc::sync::Arc;
use alloc::vec::Vec;

use super::Robot;
use crate::kinematics::pose::Pose;

/// Names of the joints, and how the tip was chosen among several, if it was.
pub(super) type Labels = (Vec<String>, String);

impl<const N: usize> Robot<N> {
    /// The names that the file of the arm gives its joints; `None` of an arm without a file.
    #[must_use]
    pub fn joint_names(&self) -> Option<&[String]> {
        self.labels.as_ref().map(|labels| &labels.0[..])
    }

    /// How its tip was chosen among several in its file.
    #[doc(hidden)]
    pub fn tip_remark(&self) -> Option<&str> {
        self.labels.as_ref().map(|labels| &labels.1[..]).filter(|remark| !remark.is_empty())
    }

    #[doc(hidden)]
    pub fn with_labels(self, labels: Option<Labels>) -> Self {
        Self { labels: labels.map(Arc::new), ..self }
    }
}

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
