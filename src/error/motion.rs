//! What can be wrong with a trajectory, a path or their limits.

use core::fmt;

use super::JointFault;

/// What is wrong with an input of a trajectory or a path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum MotionFault {
    /// A number is NaN or infinite.
    NotFinite {
        /// Name of the argument.
        field: &'static str,
        /// Which one, from 0.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A number is not positive.
    NotPositive {
        /// Name of the argument.
        field: &'static str,
        /// Which one of several, from 0.
        index: Option<usize>,
        /// The number.
        value: f64,
    },
    /// There are too few rows, samples or poses.
    TooFew {
        /// Name of the argument.
        field: &'static str,
        /// How many there are.
        found: usize,
        /// How many there must be.
        least: usize,
    },
    /// There is no joint.
    NoJoints {
        /// Name of the argument.
        field: &'static str,
    },
    /// A row of joint angles is invalid.
    Row {
        /// The row, from 0.
        row: usize,
        /// What is wrong with it.
        fault: JointFault,
    },
    /// There are too few or too many samples or poses.
    Steps {
        /// How many.
        found: usize,
        /// The least and the largest number.
        bounds: [usize; 2],
    },
    /// The duration is too short or too long.
    Duration {
        /// The duration [s].
        value: f64,
        /// The least and the greatest [s].
        bounds: [f64; 2],
    },
    /// Velocities, accelerations or times are beyond what a double holds.
    Overflow,
    /// Nothing says how long the motion takes.
    NoDuration {
        /// The joint that moves and has no limit, from 1.
        joint: usize,
    },
    /// The duration is too short for a limit.
    AboveLimit {
        /// The joint, from 1.
        joint: usize,
        /// "velocity", "acceleration" or "jerk".
        what: &'static str,
        /// Its largest size.
        value: f64,
        /// The limit.
        limit: f64,
    },
    /// A profile cannot do what is asked of it.
    Profile {
        /// Name of the profile.
        profile: &'static str,
        /// Name of the argument.
        field: &'static str,
    },
    /// A trajectory does not begin where the one before it ends.
    Apart {
        /// The joint, from 1.
        joint: usize,
        /// How far it would jump [rad].
        gap: f64,
        /// How far it may be off [rad].
        bound: f64,
    },
    /// A part that is none.
    Slice {
        /// Its start [s].
        start: f64,
        /// Its end [s].
        end: f64,
        /// The duration [s].
        bound: f64,
    },
    /// Times do not increase.
    Order {
        /// Which one is not later than the one before it, from 0.
        index: usize,
        /// That time [s].
        value: f64,
        /// The one before it [s].
        before: f64,
    },
    /// A waypoint repeats the one before it.
    Repeats {
        /// The waypoint, from 0.
        index: usize,
    },
    /// The tool turns by half a turn between two poses: there are two ways.
    HalfTurn {
        /// The pose that it turns to, from 0.
        index: usize,
        /// The angle [rad].
        angle: f64,
    },
    /// The axis that is given is at right angles with that of the half turn, or has no length.
    Axis {
        /// The part of it along the axis of the turn [1].
        along: f64,
    },
    /// A path would have too many poses.
    TooMany {
        /// How many.
        found: f64,
        /// How many it may have.
        most: f64,
    },
    /// The joints of a path move where its tool does not: a speed of the tool says nothing there.
    ToolStill {
        /// The row to which they move, from 0.
        row: usize,
        /// The way of the tool from the row before [m].
        way: f64,
        /// The least way that counts [m].
        bound: f64,
    },
    /// A joint does not allow a constant speed of the tool.
    ToolSpeed {
        /// The joint, from 1.
        joint: usize,
        /// The row at which it does not, or the last one before the place, from 0.
        row: usize,
        /// The speed that it allows [m/s].
        most: f64,
        /// The one that is asked for [m/s].
        asked: f64,
    },
    /// Neither the step nor the turn says how many poses a part of the path has.
    NoStep {
        /// Its length [m].
        length: f64,
        /// The angle that the tool turns by [rad].
        angle: f64,
    },
    /// A robot has no joint velocities, and none are given.
    NoMaxVelocity,
    /// A zone is negative, NaN or infinite.
    Zone {
        /// The pose, from 0.
        index: usize,
        /// The zone.
        value: f64,
    },
    /// The three points of an arc lie on a line, or coincide.
    Collinear {
        /// How far the point on the way is off the line through the others [m].
        off: f64,
        /// How far it must be [m].
        bound: f64,
    },
}

impl fmt::Display for MotionFault {
    #[expect(clippy::too_many_lines, reason = "one message a fault")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NotFinite { field, index, value } => {
                write!(f, "{field}[{index}] is {value}: every element must be finite")
            }
            Self::NotPositive { field, index: Some(index), value } => {
                write!(f, "{field}[{index}] is {value:?}, it must be positive")
            }
            Self::NotPositive { field, index: None, value } => {
                write!(f, "{field} is {value:?}, it must be positive and finite")
            }
            Self::TooFew { field, found, least } => {
                write!(f, "{field} has {found} rows, it must have at least {least}")
            }
            Self::NoJoints { field } => write!(f, "{field} has no joints, it must have at least 1"),
            Self::Row { row, fault } => write!(f, "row {row} of {fault}"),
            Self::Steps { found, bounds: [least, most] } => {
                write!(f, "steps must be {least} to {most}, got {found}")
            }
            Self::Duration { value, bounds: [least, most] } => write!(
                f,
                "the motion takes {value:e} s, it must take {least:e} to {most:e} s: \
                 are the limits and the duration in rad and s?"
            ),
            Self::Overflow => f.write_str(
                "the motion is not finite: its velocities or accelerations are too large, or its \
                 times too close",
            ),
            Self::NoDuration { joint } => write!(
                f,
                "joint {joint} moves and has no limit: give a duration, or limits that bind it"
            ),
            Self::AboveLimit { joint, what, value, limit } => write!(
                f,
                "joint {joint} reaches a {what} of {value:.6}, its limit is {limit:.6}: \
                 give a longer duration, or limits without a duration"
            ),
            Self::Profile { profile, field } => write!(
                f,
                "a {profile} profile takes no {field}: use \"quintic\" for velocities and \
                 accelerations at the ends, \"cubic\" for velocities"
            ),
            Self::Apart { joint, gap, bound } => write!(
                f,
                "joint {joint} would jump by {gap:.3e} rad, trajectories are joined within \
                 {bound:.0e} rad"
            ),
            Self::Slice { start, end, bound } => write!(
                f,
                "a slice from {start} s to {end} s must be inside 0 s to {bound} s and not empty"
            ),
            Self::Order { index, value, before } => {
                write!(f, "t[{index}] is {value} s, it must be later than {before} s")
            }
            Self::Repeats { index } => {
                write!(f, "q[{index}] repeats the waypoint before it: give t, or leave it out")
            }
            Self::HalfTurn { index, angle } => write!(
                f,
                "the tool turns by {:.6} deg to pose {index}, there are two ways: give axis, or \
                 a pose between them",
                angle.to_degrees()
            ),
            Self::Axis { along } => write!(
                f,
                "axis has a part of {along:.1e} along the axis of the half turn, it must have \
                 at least 1e-6"
            ),
            Self::TooMany { found, most } => {
                write!(
                    f,
                    "the path has {found:.1e} poses, at most {most:.0e} are given: is step in m, or \
                     speed in m/s and dt in s?"
                )
            }
            Self::ToolStill { row, way, bound } => write!(
                f,
                "the tool moves by {way:.1e} m to row {row} of q, where its joints move: at least \
                 {bound:.0e} m is wanted, for its speed says nothing there: time a part in which \
                 the tool only turns by itself, by joint limits or a duration"
            ),
            Self::ToolSpeed { joint, row, most, asked } => write!(
                f,
                "joint {joint} allows {most:.6} m/s at row {row} of q, {asked:.6} m/s is asked: \
                 give a lower speed, or retime with max_tool_speed, which is slower there"
            ),
            Self::NoStep { length, angle } => write!(
                f,
                "a part of the path is {length} m long and turns by {:.6} deg: give {}, or steps",
                angle.to_degrees(),
                if length > 0.0 { "step" } else { "turn" }
            ),
            Self::NoMaxVelocity => {
                f.write_str("the robot has no joint velocities: give max_velocity, in rad/s")
            }
            Self::Zone { index, value } => {
                write!(f, "zones[{index}] is {value:?}, it must be finite and not negative")
            }
            Self::Collinear { off, bound } => write!(
                f,
                "the three points of an arc must not lie on a line: the second is {off:.1e} m off \
                 it, at least {bound:.0e} m is wanted"
            ),
        }
    }
}
