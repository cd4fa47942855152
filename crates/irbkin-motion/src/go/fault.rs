//! Free motions that are not found.

use crate::prelude::*;
use thiserror::Error;

use irbkin::Explanation;
use irbkin::internal::excess;

/// Why there is no free motion. `field` is "start" or "goal"; joints count from 1.
#[doc(hidden)]
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum GoFault {
    #[error(
        "{field}: joint {joint} is {value:.6} rad, its limits are {:.6} to {:.6} rad, exceeded {} rad",
        .bounds[0], .bounds[1], excess(*.value, *.bounds)
    )]
    Outside { field: &'static str, joint: usize, value: f64, bounds: [f64; 2] },
    #[error(
        "{field}: the linkage of axes 2 and 3 is outside its limits {} deg",
        irbkin::internal::excess(.excess.to_degrees(), [0.0; 2])
    )]
    Linkage { field: &'static str, excess: f64 },
    #[error("{field} is not reached: {reason}")]
    Unreachable { field: &'static str, reason: Explanation },
    /// `solutions`: of a pose, those that were tried; `is_proven`: there are no others.
    #[error(
        "{field} collides: {}link {link} with {other}, {:.1} mm deep{}: take another {field}, lower \
         the margin, or leave out pairs that may touch",
        tried(*.solutions), 1e3 * .depth,
        if *.is_proven { " (proven impossible)" } else { " (others were not tried)" }
    )]
    Collides {
        field: &'static str,
        solutions: Option<usize>,
        link: usize,
        other: String,
        depth: f64,
        is_proven: bool,
    },
    #[error(
        "no free motion was found with {samples} samples, which does not prove that there is none \
         (what is within 1 mm of a collision counts as blocked, ends too): give more time, another \
         seed, or a waypoint between"
    )]
    NotFound { samples: usize },
}

impl GoFault {
    /// Whether no motion can be.
    pub fn is_proven(&self) -> bool {
        match self {
            Self::Outside { .. } | Self::Linkage { .. } => true,
            Self::Unreachable { reason, .. } => {
                !matches!(reason, Explanation::NoRoots { certified: false, .. })
            }
            Self::Collides { is_proven, .. } => *is_proven,
            Self::NotFound { .. } => false,
        }
    }
}

/// The solutions of a pose that were tried.
fn tried(solutions: Option<usize>) -> String {
    match solutions {
        None => String::new(),
        Some(1) => String::from("of its one solution inside the limits, "),
        Some(count) => format!("each of {count} solutions inside the limits, of the nearest "),
    }
}
