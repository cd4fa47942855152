//! Joint angles of targets and targets of joint angles, one by one and of whole modules.

mod frames;
pub(super) mod problem;
pub(super) mod table;
pub(super) mod target;
