//! What can be wrong with the model of an arm, or with what is asked of it.

use core::f64::consts::TAU;
use core::fmt;

use crate::report::UnknownStructure;

use super::{CalibratedFault, UrdfFault};

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
    /// An angle of a model is in degrees: a multiple of 15 beyond two turns.
    Degrees {
        /// Name of the parameter.
        field: &'static str,
        /// Index into it, from 1 (joint or row).
        index: usize,
        /// The value, taken as radians.
        value: f64,
    },
    /// The flange is too far from an axis, as that of an arm in millimeters is.
    TooFar {
        /// The axis, from 1.
        axis: usize,
        /// The distance [m].
        distance: f64,
        /// The greatest distance [m].
        bound: f64,
    },
    /// More than half of the joints have limits as those in degrees are.
    LimitsInDegrees {
        /// The first of these joints, from 1.
        joint: usize,
        /// Its lower limit, taken as radians.
        lower: f64,
        /// Its upper limit, taken as radians.
        upper: f64,
        /// The size from which limits of most joints are refused [rad].
        bound: f64,
    },
    /// A limit is NaN, or infinite on the wrong side.
    NoLimit {
        /// Which limit.
        field: &'static str,
        /// The joint, from 1; 0 for the linkage.
        index: usize,
        /// The value.
        value: f64,
        /// What stands for no limit: infinity or minus infinity.
        none: f64,
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
    EmptyLinkageLimit {
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
    /// The joints are not independent, or the structure of the arm is unknown.
    UnknownStructure(UnknownStructure),
    /// ABB's confdata means nothing, or something else, for arms of this structure.
    NoConfiguration {
        /// Name of the structure.
        structure: &'static str,
    },
    /// The arm angle is a YuMi's.
    NoArmAngle,
    /// A singularity mode locks a wrist that the arm does not have.
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
        /// How far away their common normal is [m].
        distance: f64,
        /// The farthest that a table holds [m].
        bound: f64,
        /// The least power of ten [rad] that, given as `snap`, makes an arm of a known structure of
        /// it; none where none does.
        snap: Option<f64>,
    },
    /// A joint at this angle leaves two axes of the others so nearly parallel.
    LeftNearlyParallel {
        /// The joint, from 1.
        joint: usize,
        /// Its angle [rad].
        angle: f64,
        /// The axes, from 1.
        axes: (usize, usize),
        /// How far they are off parallel [rad].
        off: f64,
        /// How far off parallel they must be, if not parallel [rad].
        bound: f64,
    },
    /// The arm cannot be corrected, or is not that of its nominal one.
    Calibrated(CalibratedFault),
    /// The URDF describes no arm that can be taken.
    Urdf(UrdfFault),
}

impl fmt::Display for ModelFault {
    #[expect(clippy::too_many_lines, reason = "a message for each fault")]
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
            Self::Degrees { field, index, value } => write!(
                f,
                "{field} {index} is {value} rad, a multiple of 15 must be at most 12.57 rad (did \
                 you pass degrees? {value} deg is {} rad)",
                value.to_radians()
            ),
            Self::TooFar { axis, distance, bound } => write!(
                f,
                "the flange is {distance:.1} m from axis {axis}, it must be at most {bound} m \
                 (are the lengths in millimeters? meters are wanted)"
            ),
            Self::LimitsInDegrees { joint, lower, upper, bound } => write!(
                f,
                "joint {joint} limit is {lower} to {upper} rad, beyond {bound} rad as are those \
                 of most joints (did you pass degrees? for no limit give inf)"
            ),
            Self::NoLimit { field, index, value, none } => {
                match index {
                    0 => write!(f, "{field}"),
                    _ => write!(f, "{field} {index}"),
                }?;
                let wanted = if value.is_nan() { "not be NaN" } else { "be finite" };
                write!(f, " is {value}, it must {wanted} ({none} is allowed: no limit)")
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
            Self::EmptyLinkageLimit { lower, upper } => {
                write!(f, "linkage limit is empty: lower {lower} rad > upper {upper} rad")
            }
            Self::NoLinkage => write!(
                f,
                "this robot has no parallelogram linkage: linkage limits are those of q3 - q2 of a \
                 robot with coupled axes 2 and 3 (see coupled)"
            ),
            Self::NotCoupled { reason } => write!(f, "axes 2 and 3 cannot be coupled: {reason}"),
            Self::Velocity { joint, value } => {
                write!(f, "joint {joint} velocity is {value} rad/s, it must be positive")
            }
            Self::JointCount { found, wanted } => {
                write!(f, "the robot has {found} joints, it must have {wanted}")
            }
            Self::NoConfiguration { structure } => {
                write!(
                    f,
                    "this robot has no ABB configuration: its structure is \"{structure}\", not a \
                     six-axis arm with a spherical wrist"
                )?;
                match *structure {
                    "offset wrist" | "general" => write!(f, ", nor a GoFa or YuMi of the catalog"),
                    _ => Ok(()),
                }
            }
            Self::NoArmAngle => {
                write!(f, "this robot has no arm angle: it is no YuMi of the catalog")
            }
            Self::NoSphericalWrist => write!(
                f,
                "this singularity mode needs a spherical wrist, and the robot has none: use \
                 \"through\" or \"error\""
            ),
            Self::UnknownStructure(reason) => {
                write!(f, "no inverse kinematics for this arm: {reason}")
            }
            Self::AxisDirection { axis } => {
                write!(f, "direction of axis {axis} is zero, it must have a length")
            }
            Self::NearlyParallel { axes: (i, j), off, distance, bound, snap } => {
                write!(
                    f,
                    "axes {i} and {j} are {off:.1e} rad off parallel, their common normal is \
                     {distance:.1e} m away, it must be at most {bound:.0e} m"
                )?;
                match snap {
                    Some(snap) => write!(
                        f,
                        " (write the angles with all their digits); snap={snap:e} would take it"
                    ),
                    None => write!(f, " (are the angles written with all their digits?)"),
                }
            }
            Self::LeftNearlyParallel { joint, angle, axes: (i, j), off, bound } => write!(
                f,
                "joint {joint} at {angle} rad leaves axes {i} and {j} {off:.1e} rad off parallel, \
                 they must be parallel or at least {bound:.1e} rad off"
            ),
            Self::Calibrated(fault) => fault.fmt(f),
            Self::Urdf(fault) => write!(f, "URDF: {fault}"),
        }
    }
}

impl ModelFault {
    /// Checks that an angle of a model is not in degrees: no one writes 90 rad, or another multiple
    /// of 15, for an angle of that many turns.
    pub(crate) fn check_radians(field: &'static str, index: usize, value: f64) -> Result<(), Self> {
        if value.abs() > 2.0 * TAU && value % 15.0 == 0.0 {
            return Err(Self::Degrees { field, index, value });
        }
        Ok(())
    }

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
