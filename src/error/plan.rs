//! What can be wrong with what a plan is asked for.

use core::fmt;

use super::PoseFault;

/// What is wrong with an input of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PlanFault {
    /// The path has no poses.
    NoPoses,
    /// A pose of the path is no rigid transform.
    Pose {
        /// The pose, from 0.
        index: usize,
        /// What is wrong with it.
        fault: PoseFault,
    },
    /// A time is NaN or infinite, or not later than the one before it.
    Time {
        /// Which one, from 0.
        index: usize,
        /// That time [s].
        value: f64,
        /// The one before it [s].
        before: f64,
    },
    /// There are too few or too many tool angles.
    RotationSteps {
        /// How many.
        found: usize,
        /// The least and the largest number.
        bounds: [usize; 2],
    },
    /// The range of tool angles is empty, not finite, or more than a full turn.
    RotationRange {
        /// Its lower end [rad].
        lower: f64,
        /// Its upper end [rad].
        upper: f64,
    },
    /// The joint vector of an end does not bring the tool to the pose there.
    EndOff {
        /// Name of the argument.
        field: &'static str,
        /// How far the tool is from the pose [m].
        position: f64,
        /// How far it is turned from the orientation, or out of the free rotation [rad].
        rotation: f64,
        /// How far it may be off [m, rad].
        bound: f64,
    },
    /// The joint vector of an end turns the tool out of the range of its free rotation.
    EndAngle {
        /// Name of the argument.
        field: &'static str,
        /// The tool angle [rad].
        angle: f64,
        /// The range [rad].
        bounds: [f64; 2],
    },
    /// A cost is negative or not finite.
    Cost {
        /// Name of the argument.
        field: &'static str,
        /// The cost [rad^2/s^2].
        value: f64,
    },
    /// The range of an axis is empty, not finite or too large.
    AxisRange {
        /// The axis.
        field: &'static str,
        /// Its lower end [m, rad].
        lower: f64,
        /// Its upper end [m, rad].
        upper: f64,
        /// The largest value [m, rad].
        most: f64,
    },
    /// An axis has too few or too many values.
    AxisSteps {
        /// The axis.
        field: &'static str,
        /// How many.
        found: usize,
        /// The least and the largest number.
        bounds: [usize; 2],
    },
    /// The direction of an axis has no length, or a direction or a point is not finite.
    AxisVector {
        /// The axis.
        field: &'static str,
        /// The element, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The velocity limit of an external axis is not positive and finite.
    AxisVelocity {
        /// That limit [m/s, rad/s].
        value: f64,
    },
    /// The weight of an external axis is negative or not finite.
    AxisWeight {
        /// That weight.
        value: f64,
    },
    /// A cone has no positive angle, or one above a quarter turn.
    ConeAngle {
        /// Its angle [rad].
        angle: f64,
        /// The largest one [rad].
        most: f64,
    },
    /// There are too many external axes.
    External {
        /// How many.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// A start or an end has not one value for each external axis.
    EndExternal {
        /// Name of the argument.
        field: &'static str,
        /// How many values it has.
        found: usize,
        /// How many external axes there are.
        wanted: usize,
    },
    /// A start or an end has an external axis or a tolerance outside its range.
    EndValue {
        /// Name of the argument.
        field: &'static str,
        /// The axis, from 0: external ones, then tilts, then the offset.
        index: usize,
        /// Its value [m, rad].
        value: f64,
        /// Its range [m, rad].
        bounds: [f64; 2],
    },
    /// Path, tool angles and axes have too many combinations.
    Nodes {
        /// How many there are.
        found: usize,
        /// How many there may be.
        most: usize,
    },
    /// The joint vector of an end is outside the limits.
    EndOutside {
        /// Name of the argument.
        field: &'static str,
        /// The joint, from 1.
        joint: usize,
        /// Its angle [rad].
        value: f64,
        /// Its limits [rad].
        bounds: [f64; 2],
    },
    /// A closed path does not end where it starts.
    Open {
        /// How far apart the ends are [m].
        position: f64,
        /// How far they are turned from each other [rad].
        rotation: f64,
        /// How far apart they may be [m, rad].
        bound: f64,
    },
    /// A closed path has no end of its own.
    ClosedEnd,
    /// The joint limits allow too many turns for a search over all of them.
    Turns {
        /// How many combinations of turns there are.
        found: f64,
        /// How many are searched at most.
        most: usize,
    },
}

impl fmt::Display for PlanFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoPoses => f.write_str("the path has 0 poses, it must have at least 1"),
            Self::Pose { index, fault } => write!(f, "pose {index} of the path: {fault}"),
            Self::Time { index, value, before } => write!(
                f,
                "times[{index}] is {value} s, it must be finite and later than {before} s"
            ),
            Self::RotationSteps { found, bounds: [least, most] } => write!(
                f,
                "steps of the tool rotation must be {least} to {most}, got {found}: one step is \
                 one angle, lower == upper"
            ),
            Self::RotationRange { lower, upper } => write!(
                f,
                "the tool rotation from {lower} to {upper} rad must not be empty, and not more \
                 than a full turn: did you pass degrees?"
            ),
            Self::EndOff { field, position, rotation, bound } => write!(
                f,
                "{field} brings the tool {:.3} mm and {:.4} deg off the pose there, {bound:.0e} m \
                 and rad are allowed: take a joint vector of that pose",
                1e3 * position,
                rotation.to_degrees()
            ),
            Self::EndAngle { field, angle, bounds: [lower, upper] } => write!(
                f,
                "{field} turns the tool by {:.3} deg, the tool rotation allows {:.3} to {:.3} deg",
                angle.to_degrees(),
                lower.to_degrees(),
                upper.to_degrees()
            ),
            Self::AxisRange { field, lower, upper, most } => write!(
                f,
                "{field}: the range from {lower} to {upper} (m or rad) must not be empty, its ends \
                 must be at most {most}"
            ),
            Self::AxisSteps { field, found, bounds: [least, most] } => {
                write!(f, "{field}: steps must be {least} to {most}, got {found}")?;
                if field == "tool cone" { f.write_str(", and odd") } else { Ok(()) }
            }
            Self::AxisVector { field, index, value } => write!(
                f,
                "{field}: element {index} is {value}, a direction must have a length and all \
                 elements must be finite"
            ),
            Self::AxisVelocity { value } => write!(
                f,
                "max_velocity of an external axis must be positive and finite, got {value} (m/s or \
                 rad/s)"
            ),
            Self::Cost { field, value } => {
                write!(f, "{field} must be finite and not negative, got {value}")
            }
            Self::AxisWeight { value } => {
                write!(f, "weight of an external axis must be finite and not negative, got {value}")
            }
            Self::ConeAngle { angle, most } => write!(
                f,
                "the angle of the tool cone must be above 0 and at most {most:.4} rad, got {angle}: \
                 did you pass degrees?"
            ),
            Self::External { found, most } => {
                write!(f, "there may be at most {most} external axes, got {found}")
            }
            Self::EndExternal { field, found, wanted } => write!(
                f,
                "{field} must have 6 joint angles and a value for each of {wanted} external axes, \
                 got {found} such values"
            ),
            Self::EndValue { field, index, value, bounds: [lower, upper] } => write!(
                f,
                "{field}: free axis {index} (external axes, tilts, offset) is at {value:.6}, its \
                 range is {lower:.6} to {upper:.6} (m or rad)"
            ),
            Self::Nodes { found, most } => write!(
                f,
                "poses, tool angles and values of axes make {found} nodes, there may be {most}: \
                 take fewer steps, or parts of the path"
            ),
            Self::EndOutside { field, joint, value, bounds: [lower, upper] } => write!(
                f,
                "{field}: joint {joint} is {value:.6} rad, its limits are {lower:.6} to \
                 {upper:.6} rad"
            ),
            Self::Open { position, rotation, bound } => write!(
                f,
                "closed: the last pose is {:.3} mm and {:.4} deg from the first, {bound:.0e} m \
                 and rad are allowed: append the first pose, or leave closed out",
                1e3 * position,
                rotation.to_degrees()
            ),
            Self::ClosedEnd => f.write_str(
                "closed: a closed path ends at its start: give start only, or leave closed out",
            ),
            Self::Turns { found, most } => write!(
                f,
                "the joint limits allow {found:.0} combinations of turns, {most} are searched: \
                 narrow them with with_limits"
            ),
        }
    }
}
