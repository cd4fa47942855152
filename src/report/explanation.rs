//! The outcome of a solve: how far the pose is from reach, and a sentence on it.

use core::fmt;

/// Whether the arm's wrist center gets to where the pose wants it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Reach {
    /// It does.
    Reached,
    /// It lies beyond the stretched arm.
    TooFar {
        /// How far beyond [m].
        shortfall: f64,
    },
    /// It lies closer than the folded arm, or inside the cylinder of the lateral offset.
    TooNear {
        /// How far inside [m].
        shortfall: f64,
    },
    /// An arm without a closed form has no solution: its polynomial has no real root. How far the
    /// pose is out of reach is not known.
    NoRoots,
}

impl Reach {
    /// How far the wrist center is from where the arm can bring it [m]; zero when reached, NaN where
    /// it is not known.
    #[must_use]
    pub fn shortfall(self) -> f64 {
        match self {
            Self::Reached => 0.0,
            Self::NoRoots => f64::NAN,
            Self::TooFar { shortfall } | Self::TooNear { shortfall } => shortfall,
        }
    }

    /// The one of two that misses by less; itself where they are equal.
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

/// One sentence on the outcome of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Explanation {
    /// Solutions inside the limits exist.
    Found {
        /// Solutions, limits not regarded.
        solutions: usize,
        /// Those inside the limits.
        inside: usize,
    },
    /// Solutions exist, none inside the limits.
    OutsideLimits {
        /// Solutions, limits not regarded.
        solutions: usize,
        /// The joint that keeps the best of them out, from 1.
        joint: usize,
        /// How far that joint is outside [rad].
        excess: f64,
    },
    /// Solutions exist, none inside the limits: all that keeps the best of them out is the linkage
    /// of coupled axes 2 and 3.
    OutsideLinkage {
        /// Solutions, limits not regarded.
        solutions: usize,
        /// How far q3 - q2 is outside the linkage's limits [rad].
        excess: f64,
    },
    /// The wrist center is out of reach.
    OutOfReach(
        /// On which side, and by how much.
        Reach,
    ),
    /// The pose leaves a joint free, but the arm does not reach with it at this angle.
    FreeOutOfReach {
        /// The free joint, from 1.
        joint: usize,
        /// The angle [rad].
        value: f64,
    },
    /// An arm without a closed form has no solution.
    NoRoots {
        /// Whether that is certain.
        certified: bool,
        /// How near the arm gets, if that was searched.
        approach: Option<Approach>,
    },
    /// Solutions inside the limits exist, none with this arm angle.
    NoArmAngle {
        /// The arm angle [rad].
        arm_angle: f64,
    },
    /// The caller's own condition rejected every solution.
    FilteredOut,
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Found { solutions: 1, inside: 1 } => write!(f, "1 solution, inside limits"),
            Self::Found { solutions, inside } => {
                write!(f, "{solutions} solutions, {inside} inside limits")
            }
            Self::OutsideLimits { solutions, joint, excess } => {
                write!(
                    f,
                    "all {solutions} outside limits; nearest: J{joint} by {:.1} deg",
                    excess.to_degrees()
                )
            }
            Self::OutsideLinkage { solutions, excess } => {
                write!(
                    f,
                    "all {solutions} outside limits; nearest: the linkage (q3 - q2) by {:.1} deg",
                    excess.to_degrees()
                )
            }
            Self::OutOfReach(Reach::TooNear { shortfall }) => {
                write!(f, "wrist center {} too near to be reached", Millimeters(shortfall))
            }
            Self::NoRoots { certified: true, approach } => {
                write!(f, "out of reach: no closed form; 0 real roots{}", Nearest(approach))
            }
            Self::OutOfReach(Reach::NoRoots) => {
                write!(f, "out of reach: no closed form; 0 real roots")
            }
            Self::NoRoots { certified: false, approach } => {
                let nearest = Nearest(approach);
                write!(f, "no solution found, which is not certain: no closed form{nearest}")
            }
            Self::OutOfReach(reach) => {
                let shortfall = reach.shortfall();
                write!(f, "wrist center {} beyond reach", Millimeters(shortfall))?;
                if shortfall > FAR_BEYOND {
                    write!(f, " (is the pose in millimeters? meters are wanted)")
                } else {
                    Ok(())
                }
            }
            Self::FreeOutOfReach { joint, value } => {
                write!(
                    f,
                    "the robot does not reach the pose with J{joint} at {:.3} deg",
                    value.to_degrees()
                )
            }
            Self::NoArmAngle { arm_angle } => {
                write!(
                    f,
                    "no solution inside the limits has the arm angle {:.3} deg",
                    arm_angle.to_degrees()
                )
            }
            Self::FilteredOut => write!(f, "the filter rejected every solution"),
        }
    }
}

/// The end of a sentence: how near the arm gets.
struct Nearest(Option<Approach>);

impl fmt::Display for Nearest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(Approach { position, rotation }) => {
                let degrees = rotation.to_degrees();
                write!(f, "; nearest approach {} and {degrees:.1} deg", Millimeters(position))
            }
            None => Ok(()),
        }
    }
}

/// How far beyond reach a pose must be to be one in millimeters [m]: no arm of the catalog reaches
/// 5 m, and the poses in millimeters that it is used for are 100 of them away, and more.
const FAR_BEYOND: f64 = 20.0;

/// A length in mm, with a decimal from 0.1 mm on and in scientific notation below.
struct Millimeters(f64);

impl fmt::Display for Millimeters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mm = self.0 * 1e3;
        if mm >= 0.1 { write!(f, "{mm:.1} mm") } else { write!(f, "{mm:.1e} mm") }
    }
}

#[cfg(test)]
mod tests {
    use std::string::ToString;

    use super::*;

    #[test]
    fn sentences_name_the_figure_and_the_joint() {
        let far = Explanation::OutOfReach(Reach::TooFar { shortfall: 0.012 });
        assert_eq!(far.to_string(), "wrist center 12.0 mm beyond reach");
        let mm = Explanation::OutOfReach(Reach::TooFar { shortfall: 1423.4115 });
        assert_eq!(
            mm.to_string(),
            "wrist center 1423411.5 mm beyond reach (is the pose in millimeters? meters are \
             wanted)"
        );
        let outside =
            Explanation::OutsideLimits { solutions: 4, joint: 5, excess: 3.1_f64.to_radians() };
        assert_eq!(outside.to_string(), "all 4 outside limits; nearest: J5 by 3.1 deg");
    }
}
