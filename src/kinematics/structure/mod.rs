//! Kinematic structures: what an arm is like whose inverse is known in closed form.

pub(crate) mod any;
pub(crate) mod branches;
pub(crate) mod end_frames;
pub(crate) mod free_choice;
pub(crate) mod joint_map;
pub(crate) mod lanes;
pub(crate) mod planar_arm;
pub(crate) mod recognition;
pub(crate) mod spherical_shoulder;
pub(crate) mod spherical_wrist;
pub(crate) mod three_parallel;
pub(crate) mod zyz;
