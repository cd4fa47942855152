//! Every threshold of plans that answers depend on, with its unit and its reason. Parameters of one
//! algorithm are beside it.

/// How much a range of tool angles may differ from a full turn and still be one [rad].
pub(crate) const FULL_TURN: f64 = 1e-9;

/// Most tool angles of a plan at each pose [1]: a tenth of a degree apart.
pub const MOST_TOOL_ANGLES: usize = 3600;

/// Most values of an external axis or of a tolerance of a plan [1].
pub(crate) const MOST_AXIS_STEPS: usize = 1001;

/// Most external axes of a plan [1]: a track and a positioner of two axes.
pub(crate) const MOST_EXTERNAL: usize = 3;

/// Most axes that are free in a plan [1]: [`MOST_EXTERNAL`], two of a cone and the tool angle.
pub(crate) const MOST_FREE_AXES: usize = MOST_EXTERNAL + 3;

/// Largest value of an external axis [m, rad].
pub(crate) const MOST_EXTERNAL_VALUE: f64 = 1000.0;

/// Most nodes of a plan in all [1]: its joint angles take 50 bytes each.
pub(crate) const MOST_PLAN_NODES: usize = 1 << 28;

/// Most combinations of turns that a plan distinguishes at each node [1].
pub(crate) const MOST_TURN_STATES: usize = 4096;

/// How far the tool at the start or the end of a plan may be from the pose there, and the ends of a
/// closed path from each other [m, rad]: poses written with six digits.
pub(crate) const PLAN_END_OFF: f64 = 1e-6;

/// Joint step that is small enough to be no jump [rad]: a twentieth of a degree.
pub(crate) const CONTINUOUS_STEP: f64 = 1e-3;

/// Joint step from which a branch may have ended at a singularity, so that a plan looks for another
/// one that continues it [rad].
pub(crate) const CROSSING_JUMP: f64 = 1.0;

/// Joint step up to which one branch may continue another one through a singularity [rad].
pub(crate) const CROSSING_STEP: f64 = 0.5;

/// Distance of tool angles down to which a plan refines them [rad]: half a degree.
pub(crate) const REFINED_TOOL_STEP: f64 = 8.8e-3;

/// Distance of the tool angles that a plan looks at first along a long path [rad]: ten degrees.
pub(crate) const COARSEST_TOOL_STEP: f64 = 0.174_532_925_199_432_95;

/// Distance of the values of a track down to which a plan refines them [m].
pub(crate) const REFINED_TRACK: f64 = 5e-3;

/// How far rounding may raise the cost of a step, relative to it [1]: that of joint angles, 1e-15
/// rad, in steps of a millionth of a radian.
pub(crate) const BOTTLENECK_ROUNDING: f64 = 1e-9;
