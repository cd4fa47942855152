//! Every threshold of paths of the tool, with its unit and its reason.

/// Most samples of a trajectory and most poses of a path [1]: they fill gigabytes. More is a step
/// in another unit.
pub const MOST_SAMPLES: usize = 10_000_000;

/// Cosine of half the angle below which a turn of the tool is a half turn [1]: both ways are
/// equally long, to 2e-9 rad.
pub(crate) const HALF_TURN_COS: f64 = 1e-9;

/// Least part of a given axis along a half turn's for it to choose the way [1].
pub(crate) const LEAST_ALONG: f64 = 1e-6;

/// Least distance of the second point of an arc from the line through the others, by their distance
/// [1]: below, the radius is a million times that distance.
pub(crate) const LEAST_BEND: f64 = 1e-6;

/// Part of a step of a path that is rounding and takes no step of its own [1].
pub const STEP_ROUNDING: f64 = 1e-9;

/// Way of the tool below which it stays at one place [m]: a pose that repeats another is known to
/// rounding, and directions and speeds on such a way are not determined.
pub const LEAST_WAY: f64 = 1e-9;

/// Turn of the tool below which a pose at the same place repeats the one before it [rad].
pub(crate) const LEAST_TURN: f64 = 1e-9;
