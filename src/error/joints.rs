//! What can be wrong with joint angles.

use core::fmt;

/// What is wrong with a joint vector.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum JointFault {
    /// An angle is NaN or infinite.
    NotFinite {
        /// Name of the argument.
        field: &'static str,
        /// The joint, from 1.
        joint: usize,
        /// The angle.
        value: f64,
    },
    /// An angle is too large to be given: its whole turns leave too few digits for the rest.
    TooLarge {
        /// Name of the argument.
        field: &'static str,
        /// The joint, from 1.
        joint: usize,
        /// The angle [rad].
        value: f64,
        /// The largest size of an angle [rad].
        bound: f64,
    },
    /// A solution was passed with a pose that it does not meet.
    NotOfPose {
        /// How far its tool is from the pose, the larger of meters and radians.
        off: f64,
        /// The farthest that it may be [m, rad].
        bound: f64,
    },
    /// The zone of a singularity mode is no bound of a sine: NaN, or not between 0 and 1.
    Zone {
        /// The zone.
        value: f64,
    },
    /// A number of a configuration that no configuration of the arm has.
    Configuration {
        /// Its name.
        field: &'static str,
        /// The number.
        value: i32,
        /// The least and the largest that it may be.
        bounds: [i32; 2],
    },
    /// The arm has no joint with this number.
    NoJoint {
        /// The joint, from 1.
        joint: usize,
        /// The number of joints.
        dof: usize,
    },
    /// A configuration of an arm that needs the arm angle with it comes without one.
    MissingArmAngle,
    /// An arm angle is NaN, infinite, or too large to be given.
    ArmAngle {
        /// The arm angle [rad].
        value: f64,
        /// Its largest size [rad].
        bound: f64,
    },
    /// A weight is negative, NaN or infinite.
    Weight {
        /// The joint, from 1.
        joint: usize,
        /// The weight.
        value: f64,
    },
}

impl fmt::Display for JointFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { field, joint, value } => {
                write!(f, "{field}: joint {joint} is {value}, every angle must be finite [rad]")
            }
            Self::TooLarge { field, joint, value, bound } => {
                write!(
                    f,
                    "{field}: joint {joint} is {value:e} rad, its size must be at most {bound:e} \
                     rad (remove whole turns)"
                )
            }
            Self::NotOfPose { off, bound } => {
                write!(
                    f,
                    "solution does not reach this pose: residual {off:.1e} (m or rad), it must be \
                     at most {bound:.0e} (is it a solution of another pose or robot?)"
                )
            }
            Self::Zone { value } => {
                write!(f, "zone is {value}, it must be 0 to 1: a bound of |sin q5|")
            }
            Self::Configuration { field, value, bounds: [0, 0] } => {
                write!(
                    f,
                    "configuration: {field} is {value}, it must be 0 for a robot with coupled \
                     axes 2 and 3"
                )
            }
            Self::Configuration { field, value, bounds: [least, most] } => {
                write!(f, "configuration: {field} is {value}, it must be {least} to {most}")
            }
            Self::NoJoint { joint, dof } => {
                write!(f, "given: there is no joint {joint}, it must be 1 to {dof}")
            }
            Self::MissingArmAngle => write!(
                f,
                "arm_angle is missing: the pose and the configuration of a YuMi leave its elbow \
                 undetermined (in a robtarget it is eax_a)"
            ),
            Self::ArmAngle { value, bound } => write!(
                f,
                "arm_angle is {value} rad, it must be finite and at most {bound:e} rad in size"
            ),
            Self::Weight { joint, value } => write!(
                f,
                "weights: joint {joint} is {value}, a weight must be finite and not negative"
            ),
        }
    }
}
