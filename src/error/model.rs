//! What can be wrong with the model of an arm, or with what is asked of it.

use core::fmt;

use crate::report::UnknownStructure;

use super::UrdfFault;

/// What is wrong with the description of an arm.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModelFault {
    /// A parameter is NaN or infinite.
    NotFinite {
        /// Name of the parameter.
        field: &'static str,
        /// Index into it, from 1 (joint or row).
        index: usize,
        /// The value.
        value: f64,
    },
    /// A length is too short for the arm to be one.
    TooShort {
        /// Name and meaning of the length.
        field: &'static str,
        /// The length [m].
        value: f64,
        /// The least length [m].
        bound: f64,
    },
    /// A length or an angle is too large to calculate with.
    TooLarge {
        /// Name of the parameter.
        field: &'static str,
        /// Index into it, from 1 (joint or row); 0 for a parameter by itself.
        index: usize,
        /// The value.
        value: f64,
        /// The largest size.
        bound: f64,
    },
    /// `snap` is negative, NaN or too large.
    Snap {
        /// What was given [rad].
        value: f64,
        /// The largest [rad].
        bound: f64,
    },
    /// A joint sign is neither 1 nor -1.
    Sign {
        /// The joint, from 1.
        joint: usize,
        /// The sign.
        value: f64,
    },
    /// A joint's lower limit is above its upper limit.
    EmptyLimit {
        /// The joint, from 1.
        joint: usize,
        /// Lower limit [rad].
        lower: f64,
        /// Upper limit [rad].
        upper: f64,
    },
    /// The lower limit of the linkage of coupled axes is above its upper limit.
    EmptyRodLimit {
        /// Lower limit of q3 - q2 [rad].
        lower: f64,
        /// Upper limit of q3 - q2 [rad].
        upper: f64,
    },
    /// Limits of a linkage were given for an arm whose axes 2 and 3 are not coupled.
    NoLinkage,
    /// Axes 2 and 3 of the arm cannot be coupled.
    NotCoupled {
        /// Why not.
        reason: &'static str,
    },
    /// A velocity limit is not positive.
    Velocity {
        /// The joint, from 1.
        joint: usize,
        /// The velocity [rad/s].
        value: f64,
    },
    /// The arm has another number of joints.
    JointCount {
        /// Joints of the arm.
        found: usize,
        /// Joints that were asked for.
        wanted: usize,
    },
    /// The geometry has no closed-form inverse here.
    UnknownStructure(UnknownStructure),
    /// ABB's confdata means nothing, or something else, for arms of this form.
    NoConfiguration {
        /// Name of the form.
        structure: &'static str,
    },
    /// A crossing policy holds a wrist that the arm does not have.
    NoSphericalWrist,
    /// The direction of an axis has no length.
    AxisDirection {
        /// The axis, from 1.
        axis: usize,
    },
    /// Two axes are so nearly parallel that a table cannot hold their common normal.
    NearlyParallel {
        /// The axes, from 1.
        axes: (usize, usize),
        /// How far they are off parallel [rad].
        off: f64,
        /// How far away their common normal stands [m].
        distance: f64,
        /// The farthest that a table holds [m].
        bound: f64,
        /// The least power of ten [rad] that, given as `snap`, makes an arm of a known form of it;
        /// none where none does.
        snap: Option<f64>,
    },
    /// The URDF describes no arm that can be taken.
    Urdf(UrdfFault),
}

impl fmt::Display for ModelFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { field, index: 0, value } => {
                write!(f, "{field} is {value}, it must be finite")
            }
            Self::NotFinite { field, index, value } => {
                write!(f, "{field} {index} is {value}, it must be finite")
            }
            Self::TooLarge { field, index: 0, value, bound } => {
                write!(f, "{field} is {value:e}, its size must be at most {bound:e}")
            }
            Self::TooLarge { field, index, value, bound } => {
                write!(f, "{field} {index} is {value:e}, its size must be at most {bound:e}")
            }
            Self::TooShort { field, value, bound } => {
                write!(f, "{field} is {value} m, it must be at least {bound:e} m")
            }
            Self::Snap { value, bound } => {
                write!(f, "snap is {value} rad, it must be 0 to {bound:e} rad")
            }
            Self::Sign { joint, value } => {
                write!(f, "joint {joint} sign is {value}, it must be 1 or -1")
            }
            Self::EmptyLimit { joint, lower, upper } => {
                write!(f, "joint {joint} limit is empty: lower {lower} rad > upper {upper} rad")
            }
            Self::EmptyRodLimit { lower, upper } => {
                write!(f, "linkage limit is empty: lower {lower} rad > upper {upper} rad")
            }
            Self::NoLinkage => write!(
                f,
                "linkage limits are those of q3 - q2 of an arm with coupled axes 2 and 3: this arm's are not coupled"
            ),
            Self::NotCoupled { reason } => write!(f, "axes 2 and 3 cannot be coupled: {reason}"),
            Self::Velocity { joint, value } => {
                write!(f, "joint {joint} velocity is {value} rad/s, it must be positive")
            }
            Self::JointCount { found, wanted } => {
                write!(f, "the arm has {found} joints, {wanted} were asked for")
            }
            Self::NoConfiguration { structure } => {
                write!(
                    f,
                    "this robot has no ABB configuration: its structure is \"{structure}\", not a six-axis arm with a spherical wrist"
                )
            }
            Self::NoSphericalWrist => write!(
                f,
                "this policy holds a spherical wrist, and the arm has none: take \"through\" or \"error\""
            ),
            Self::UnknownStructure(reason) => {
                write!(f, "no closed-form inverse kinematics for this arm: {reason}")
            }
            Self::AxisDirection { axis } => write!(f, "direction of axis {axis} has no length"),
            Self::NearlyParallel { axes: (i, j), off, distance, bound, snap } => {
                write!(
                    f,
                    "axes {i} and {j} are {off:.1e} rad off parallel, their common normal stands {distance:.1e} m away, it must be at most \
                     {bound:.0e} m"
                )?;
                match snap {
                    Some(snap) => write!(f, "; snap={snap:e} would take it"),
                    None => write!(f, " (are the angles written with all their digits?)"),
                }
            }
            Self::Urdf(fault) => write!(f, "URDF: {fault}"),
        }
    }
}

impl ModelFault {
    /// Checks that a number of a model is finite and not too large to calculate with.
    pub(crate) fn check(
        field: &'static str,
        index: usize,
        value: f64,
        bound: f64,
    ) -> Result<(), Self> {
        if !value.is_finite() {
            return Err(Self::NotFinite { field, index, value });
        }
        if value.abs() > bound {
            return Err(Self::TooLarge { field, index, value, bound });
        }
        Ok(())
    }
}
