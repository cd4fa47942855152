//! Facts about joint angles that answers share: confdata, arm angle, margins, contacts.

use alloc::string::{String, ToString};
use alloc::vec::Vec;

use irbkin::{Robot, SingularityKind};
use irbkin_motion::Arm;
use irbkin_motion::cell::Cell;
use serde::Serialize;

use super::request::Refusal;

/// How far joint angles are from limits and singularities.
#[derive(Debug, Serialize)]
pub struct Margin {
    /// The joint that is nearest to a limit, from 1; none without limits.
    pub joint: Option<usize>,
    /// How far it is inside its limits [rad]; negative outside.
    pub rad: Option<f64>,
    /// Margin to the limits as a part of the farthest possible: 1 in the middle, 0 at a limit.
    pub limits: f64,
    /// Margin to the singularities as a part of the farthest possible; null if it is not known.
    pub singularities: f64,
}

/// The nearest pair of a link and something else.
#[derive(Debug, Serialize)]
pub struct Contact {
    /// Whether the arm touches itself, or is nearer to an obstacle than the margin.
    pub collides: bool,
    /// How far the nearest two are apart [m]; negative if they touch.
    pub distance: Option<f64>,
    /// How deep they are in each other [m]; 0 if they do not touch.
    pub depth: f64,
    /// The link of the two.
    pub link: Option<usize>,
    /// The other: "link 3", or the name of an obstacle.
    pub near: Option<String>,
    /// The nearest points of both [m].
    pub points: Option<[[f64; 3]; 2]>,
}

impl Margin {
    pub(crate) fn of<const N: usize>(robot: &Robot<N>, q: &[f64; N]) -> Self {
        let nearest = robot.limits().nearest(q);
        let margin = robot.margin(q);
        Self {
            joint: nearest.map(|(joint, _)| joint),
            rad: nearest.map(|(_, room)| room),
            limits: margin.limits,
            singularities: margin.singularities,
        }
    }
}

impl Contact {
    pub(crate) fn of<const N: usize>(
        arm: &Arm<N>,
        cell: &Cell,
        q: &[f64; N],
    ) -> Result<Self, Refusal> {
        let mut checker = cell.checker(arm)?;
        let collides = checker.collides(q)?;
        let nearest = checker.nearest(q)?;
        let distance = nearest.as_ref().map(|nearest| nearest.distance);
        Ok(Self {
            collides,
            distance,
            depth: distance.map_or(0.0, |distance| (-distance).max(0.0)),
            link: nearest.as_ref().map(|nearest| nearest.link),
            near: nearest.as_ref().map(|nearest| nearest.near.to_string()),
            points: nearest.map(|nearest| nearest.points),
        })
    }
}

/// Whether the arm collides at joint angles, if that is asked.
pub(crate) fn collides<const N: usize>(
    arm: &Arm<N>,
    cell: Option<&Cell>,
    q: &[f64; N],
) -> Result<Option<bool>, Refusal> {
    Ok(cell.map(|cell| cell.collides(arm, q)).transpose()?)
}

/// ABB's confdata of joint angles, if the arm has them.
pub(crate) fn confdata<const N: usize>(robot: &Robot<N>, q: &[f64; N]) -> Option<[i32; 4]> {
    robot.configuration(q).ok().map(Into::into)
}

/// The arm angle of joint angles [rad], of an arm that has one.
pub(crate) fn arm_angle<const N: usize>(robot: &Robot<N>, q: &[f64; N]) -> Option<f64> {
    robot.arm_angle(q).ok()?
}

/// The words for singularities.
pub(crate) fn words(kinds: SingularityKind) -> Vec<&'static str> {
    let words = [
        (SingularityKind::WRIST, "wrist"),
        (SingularityKind::ELBOW, "elbow"),
        (SingularityKind::SHOULDER, "shoulder"),
    ];
    words.into_iter().filter(|(kind, _)| kinds.contains(*kind)).map(|(_, word)| word).collect()
}
