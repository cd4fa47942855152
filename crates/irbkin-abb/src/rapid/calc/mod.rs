//! Joint angles of targets and targets of joint angles, for single ones and for whole modules.

pub(super) mod confdata;
pub(super) mod frames;
pub(super) mod table;
pub(super) mod target;
pub(super) mod units;
pub(super) mod wrong;
