//! Joint paths along paths of poses.

pub(crate) mod crossing;
pub(crate) mod follow;
