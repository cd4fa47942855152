//! Joint paths along paths of poses.

pub(crate) mod follow;
pub(crate) mod singularity_mode;
pub(crate) mod step;
mod walk;

#[cfg(test)]
mod tests;
