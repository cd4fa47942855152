//! Where solutions are searched that may be close to one another.

/// Where in a cluster of roots solutions are searched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum InCluster {
    /// Nowhere: a pose that has one is left.
    Nowhere,
    Middle,
    Everywhere,
}
