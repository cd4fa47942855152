//! Joint paths along paths of poses.

#[cfg(feature = "rapid")]
mod arm_angle;
pub(crate) mod follow;
pub(crate) mod singularity_mode;
pub(crate) mod step;
mod walk;

#[cfg(test)]
mod tests;
