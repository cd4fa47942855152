//! Shapes, bodies and cells that are refused.

use thiserror::Error;

/// Why a shape, a body or a cell is refused. Lengths in meters; links and obstacles count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BodyFault {
    #[error(
        "{field}[{index}] is {value}, it must be at most {most:e} in size: are lengths in meters?"
    )]
    Point { field: &'static str, index: usize, value: f64, most: f64 },
    #[error("{field} is {value} m, it must be {least:e} to {most:e} m")]
    Length { field: &'static str, value: f64, least: f64, most: f64 },
    #[error("normal has length zero: it must point out of the solid, as [0, 0, 1] of a floor does")]
    Normal,
    #[error(
        "links {} and {} are no pair to be kept apart: they must be two links with capsules",
        .pair[0], .pair[1]
    )]
    Pair { pair: [usize; 2] },
    #[error("a capsule is of link {link}: the arm has {dof} joints, its links are 0 to {dof}")]
    NoLink { link: usize, dof: usize },
    #[error("obstacle {index} has the name of another one: each must have its own")]
    TwoNames { index: usize },
    #[error(
        "the robot has no body: the catalog has none of this arm; give one by with_body, of capsules \
         that contain its links"
    )]
    NoBody,
}
