//! Joint angles of targets and targets of joint angles, for single ones and for whole modules.

pub(super) mod axes;
pub(super) mod fallback;
pub(super) mod frames;
pub(super) mod problem;
pub(super) mod table;
pub(super) mod target;
