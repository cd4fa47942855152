//! Every threshold of motions of joints over time, with its unit and its reason.

/// Least duration of a motion [s]: its fifth power and the velocities are far inside what a double
/// holds.
pub(crate) const LEAST_DURATION: f64 = 1e-9;

/// Greatest duration of a motion [s]: 30 years.
pub const MOST_DURATION: f64 = 1e9;

/// How far joints may be apart where one trajectory continues another [rad].
pub(crate) const JOINED_POSITION: f64 = 1e-9;

/// How far a velocity may be off the direction of the path that it is along, as a part of its size
/// [1]: far above the rounding of a derivative, far below a direction that is meant.
pub(crate) const PATH_DIRECTION: f64 = 1e-6;

/// How far rounding may exceed a limit of a motion, as a part of the limit [1].
pub const LIMIT_ROUNDING: f64 = 1e-9;
