//! What can be wrong with corrections of an arm, or with its nominal arm.

use core::fmt;

/// Why an arm cannot be corrected, or solved by way of its nominal one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum CalibratedFault {
    /// The table of an arm with coupled axes 2 and 3 cannot be corrected.
    Coupled,
    /// The nominal arm has no closed form.
    Structure {
        /// Name of its structure.
        structure: &'static str,
    },
    /// A calibrated arm is not near its nominal one.
    Far {
        /// Largest distance of their tools [m].
        position: f64,
        /// Largest angle between their tools [rad].
        rotation: f64,
        /// The largest of each [m, rad].
        bound: [f64; 2],
    },
}

impl fmt::Display for CalibratedFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Coupled => write!(
                f,
                "the table of a robot with coupled axes 2 and 3 cannot be corrected: correct its \
                 uncoupled() twin, whose q3 is q3 - q2"
            ),
            Self::Structure { structure } => write!(
                f,
                "the structure of the nominal robot is \"{structure}\", it must have a closed form"
            ),
            Self::Far { position, rotation, bound: [length, angle] } => write!(
                f,
                "the tool is up to {position:.3} m and {rotation:.3} rad from that of the nominal \
                 robot, it must be at most {length:.3} m and {angle} rad (is it the same arm, with \
                 the same zero pose?)"
            ),
        }
    }
}
