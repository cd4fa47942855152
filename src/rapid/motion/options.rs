//! How the motion of a routine is made.

/// Options of [`motion`](crate::rapid::motion).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionOptions {
    /// Joint angles from which the first move begins [rad]; without them the motion begins at the
    /// first target.
    pub start: Option<[f64; 6]>,
    /// Limits of the joints [rad/s]; those of the robot without them.
    pub max_velocity: Option<[f64; 6]>,
    /// Accelerations that the joints may have [rad/s^2]; no catalog has them. Without them the
    /// duration is a kinematic lower bound: speeds change at once.
    pub max_acceleration: Option<[f64; 6]>,
    /// Largest distance of the tool between two samples [m].
    pub step: f64,
    /// Largest turn of the tool, and of a joint of a `MoveJ` or `MoveAbsJ`, between two samples
    /// [rad].
    pub turn: f64,
}

impl Default for MotionOptions {
    fn default() -> Self {
        Self {
            start: None,
            max_velocity: None,
            max_acceleration: None,
            step: 5e-3,
            turn: 5_f64.to_radians(),
        }
    }
}
