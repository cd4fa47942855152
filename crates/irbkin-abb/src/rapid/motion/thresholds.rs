//! Every threshold of moves of a program, with its unit and its reason.

use irbkin::thresholds::CONFIGURATION_EDGE;

/// How far an axis may be over the quarter of a target's confdata [rad] to be met: one quarter.
///
/// ABB's manual has a controller go to the closest configuration and stop beyond a number of degrees
/// that it does not give; users report 90.
pub(crate) const NEAR_CONFDATA: f64 = core::f64::consts::FRAC_PI_2 + CONFIGURATION_EDGE;

/// As above at the end of a line or an arc, where no other joints are nearer to the confdata [rad]:
/// 110 deg. Public programs that ran on a real IRB 140, without `ConfL` and `ConfJ`, are up to 109.2
/// deg over with `MoveL` and up to 85 deg with `MoveJ`.
pub(crate) const NEAR_CONFDATA_OF_LINE: f64 = 1.92;

/// Angle between upper arm and forearm from stretched or folded below which a move of a program
/// passes the elbow singularity [rad]: one degree, as `WRIST_ZONE`.
pub(crate) const ELBOW_ZONE: f64 = 0.0175;

/// Distance of the wrist center from axis 1 below which a move of a program passes the shoulder
/// singularity [m]. At this distance axis 1 turns by 57 deg for each millimeter of the way.
pub(crate) const SHOULDER_ZONE: f64 = 1e-3;

/// Acceleration of a tool on a line or an arc that is taken as possible [m/s^2]: five times gravity.
/// The accelerations of the arms are not known. A joint that is too fast only above the speed that
/// a tool reaches with this one, between two places where it stops, is not reported.
pub(crate) const MOST_ACCELERATION: f64 = 50.0;

/// How far the joints at the end of a move may be from those with which the next one begins [rad]:
/// more than the rounding of two solutions of one pose near a singularity.
pub(crate) const JOINED_MOVES: f64 = 1e-6;
