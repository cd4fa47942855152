//! Joint paths along paths of poses.

mod arm_angle;
pub(crate) mod follow;
pub(crate) mod singularity_mode;
mod walk;

#[cfg(test)]
mod tests;
