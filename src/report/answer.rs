//! The outcome of a solve in a sentence: reach, limits; and ABB's numbers of a solution.

use core::fmt;

use alloc::format;
use alloc::string::String;

use thiserror::Error;

/// Whether the wrist center reaches the pose.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Reach {
    /// It does.
    Reached,
    /// The pose is beyond the stretched arm.
    TooFar {
        /// How far beyond [m].
        shortfall: f64,
    },
    /// The pose is closer than the folded arm, or inside the cylinder of the lateral offset.
    TooNear {
        /// How far inside [m].
        shortfall: f64,
    },
    /// The polynomial of an arm without a closed form has no real root. How far the pose is out of
    /// reach is not known.
    NoRoots,
    /// An arm of five axes reaches the pose only if it is turned about axis 1 by more than the
    /// heading tolerance.
    Turned {
        /// The least turn [rad].
        error: f64,
    },
}

impl Reach {
    /// The distance missing for the wrist center to reach the pose [m]: zero when reached, NaN when
    /// not known.
    #[must_use]
    pub fn shortfall(self) -> f64 {
        match self {
            Self::Reached | Self::Turned { .. } => 0.0,
            Self::NoRoots => f64::NAN,
            Self::TooFar { shortfall } | Self::TooNear { shortfall } => shortfall,
        }
    }

    /// Return the one of two with the smaller shortfall, `self` if they are equal.
    pub(crate) fn nearer(self, other: Self) -> Self {
        if other.shortfall() < self.shortfall() { other } else { self }
    }
}

/// How near a robot gets to a pose that it does not reach.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Approach {
    /// Distance of the tool from the pose [m].
    pub position: f64,
    /// Angle between them [rad].
    pub rotation: f64,
}

/// One sentence on the outcome of a solve. Joints count from 1; `solutions` are counted without
/// regard to limits.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Explanation {
    /// Solutions inside the limits exist.
    #[error("{}", counted(*.solutions, *.inside))]
    Found {
        /// All solutions.
        solutions: usize,
        /// Solutions inside the limits.
        inside: usize,
    },
    /// Solutions exist, none inside the limits.
    #[error(
        "no solution inside the limits ({solutions} outside); nearest: J{joint} by {:.1} deg",
        .excess.to_degrees()
    )]
    OutsideLimits {
        /// All solutions.
        solutions: usize,
        /// The joint that keeps the best of them out.
        joint: usize,
        /// How far that joint is outside [rad].
        excess: f64,
    },
    /// Solutions exist, none inside the limits: only the linkage of coupled axes 2 and 3 keeps the
    /// best of them out.
    #[error(
        "no solution inside the limits ({solutions} outside); nearest: the linkage (serial joint 3) \
         by {:.1} deg",
        .excess.to_degrees()
    )]
    OutsideLinkage {
        /// All solutions.
        solutions: usize,
        /// How far the serial joint 3 is outside the limits of the linkage [rad].
        excess: f64,
    },
    /// The wrist center does not reach the pose.
    #[error("{}", out_of_reach(*.0))]
    OutOfReach(
        /// On which side, and by how much.
        Reach,
    ),
    /// The pose leaves a joint free, but the arm does not reach it with that joint at this angle.
    #[error("the robot does not reach the pose with J{joint} at {:.3} deg", .value.to_degrees())]
    FreeOutOfReach {
        /// The free joint.
        joint: usize,
        /// Its angle [rad].
        value: f64,
    },
    /// An arm without a closed form has no solution.
    #[error(
        "{}{}",
        if *.certified { NO_ROOTS } else { NOT_CERTAIN },
        .approach.map_or_else(String::new, nearest)
    )]
    NoRoots {
        /// Whether that is certain.
        certified: bool,
        /// How near the arm gets, if that was searched.
        approach: Option<Approach>,
    },
    /// Solutions inside the limits exist, none with this arm angle.
    #[error(
        "no solution inside the limits has the arm angle {:.3} deg", .arm_angle.to_degrees()
    )]
    NoArmAngle {
        /// The arm angle [rad].
        arm_angle: f64,
    },
    /// The caller's filter rejected every solution.
    #[error("the filter rejected every solution")]
    FilteredOut,
}

const NO_ROOTS: &str = "out of reach: no closed form; 0 real roots";
const NOT_CERTAIN: &str = "no solution found, which is not certain: no closed form";

/// How many solutions there are, and how many of them inside the limits.
fn counted(solutions: usize, inside: usize) -> String {
    match (solutions, inside) {
        (1, 1) => "1 solution, inside limits".into(),
        _ => format!("{solutions} solutions, {inside} inside limits"),
    }
}

/// The end of a sentence: how near the arm gets.
fn nearest(Approach { position, rotation }: Approach) -> String {
    format!("; nearest approach {} and {:.1} deg", millimeters(position), rotation.to_degrees())
}

/// The reason of an empty answer.
fn out_of_reach(reach: Reach) -> String {
    let shortfall = reach.shortfall();
    let by = millimeters(shortfall);
    match reach {
        Reach::NoRoots => NO_ROOTS.into(),
        Reach::Turned { error } => format!(
            "no heading within the tolerance: the arm reaches the pose turned about axis 1 by {} \
             deg (heading_tolerance admits it)",
            degrees(error)
        ),
        Reach::TooNear { .. } => format!("wrist center {by} too near to be reached"),
        _ if shortfall > FAR_BEYOND => {
            format!(
                "wrist center {by} beyond reach (is the pose in millimeters? meters are wanted)"
            )
        }
        _ => format!("wrist center {by} beyond reach"),
    }
}

/// The distance beyond reach from which a pose is taken for one in millimeters [m]: no arm of the
/// catalog reaches 5 m, and its poses in millimeters are 100 m away and more.
const FAR_BEYOND: f64 = 20.0;

/// An angle in degrees, with three decimals or, below 0.001 deg, in scientific notation.
fn degrees(angle: f64) -> String {
    let degrees = angle.to_degrees();
    if degrees >= 1e-3 { format!("{degrees:.3}") } else { format!("{degrees:.1e}") }
}

/// A length in mm, with a decimal from 0.1 mm on and in scientific notation below.
fn millimeters(length: f64) -> String {
    let mm = length * 1e3;
    if mm >= 0.1 { format!("{mm:.1} mm") } else { format!("{mm:.1e} mm") }
}

/// ABB's confdata `[cf1, cf4, cf6, cfx]`: quarter turns of axes 1, 4 and 6, and the branch of the
/// arm.
///
/// A quarter turn's number is `floor(angle / 90 deg)`. `cfx` is 4 (wrist center behind axis 1) + 2
/// (behind the lower arm) + 1 (q5 < 0). Arms of other structures count as their
/// [`ConfigurationRule`] says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Configuration {
    /// Quarter turn of axis 1.
    pub cf1: i32,
    /// Quarter turn of axis 4.
    pub cf4: i32,
    /// Quarter turn of axis 6.
    pub cf6: i32,
    /// The branch of an arm that bends backwards; zero for one with coupled axes 2 and 3.
    pub cfx: i32,
}

impl fmt::Display for Configuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cf1, cf4, cf6, cfx } = self;
        write!(f, "[{cf1}, {cf4}, {cf6}, {cfx}]")
    }
}

impl From<Configuration> for [i32; 4] {
    fn from(it: Configuration) -> Self {
        [it.cf1, it.cf4, it.cf6, it.cfx]
    }
}

/// How a controller counts the configurations of an arm.
///
/// docs/guide/abb.md says how each rule was validated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ConfigurationRule {
    /// Six axes with a spherical wrist: cf is the floor of the quarter turns, cfx the slot.
    SphericalWrist,
    /// GoFa: cf is the floor of the quarter turns, cfx counts as for a wrist whose center is the
    /// intersection of axes 4 and 5. A configuration may name two joint vectors of a pose.
    OffsetWrist,
    /// YuMi: cf is the nearest number of quarter turns, cfx 4 (q2 < 0) + 2 (q3 below the stretched
    /// elbow) + 1 (q5 < 0) of ABB's axes 2, 3 and 5. The arm angle completes it.
    ArmAngle {
        /// The direction, in the frame before the first link, from which the arm angle counts.
        reference: [f64; 3],
    },
}
