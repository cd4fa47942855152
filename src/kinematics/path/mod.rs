//! Joint paths along paths of poses.

pub(crate) mod follow;
pub(crate) mod singularity_mode;

#[cfg(test)]
mod tests;
