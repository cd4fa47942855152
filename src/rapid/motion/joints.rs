//! Moves of the joints: where they go, and the straight line in joint space that gets there.

use super::finding::FindingKind;
use super::goal::{Goal, Place};
use super::samples::{Path, way};
use crate::error::Error;
use crate::kinematics::{ConfigurationRequest, Robot};
use crate::paths::Spacing;
use crate::paths::line::part;
use crate::rapid::calc::frames::Frames;
use crate::rapid::calc::problem::Problem;

/// Whether a target must be met with its own configuration.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::rapid) enum Conf {
    /// It must; where no solution has it, that is a finding and the nearest one is taken.
    On,
    /// The nearest one is taken.
    Off,
    /// As `On`, without a finding.
    Quiet,
}

/// The joints at the target of a move, from `seed`, with what is wrong with them; `None` if it has
/// none. `flange` is the robot with the flange as its tool.
pub(super) fn solved(
    flange: &Robot<6>,
    goal: &Goal<'_>,
    seed: Option<&[f64; 6]>,
    conf: Conf,
) -> (Option<[f64; 6]>, Option<FindingKind>) {
    let not_solved = |error| (None, Some(FindingKind::Target(Problem::NotSolved(error))));
    let (pose, robconf) = match goal.place {
        None => return (None, None),
        Some(Place::Joints(q)) => return (Some(q), None),
        Some(Place::Tool(pose, robconf)) => (goal.frames.flange(&pose), robconf),
    };
    let mut missed = None;
    if conf != Conf::Off || seed.is_none() {
        let request = ConfigurationRequest { seed: seed.copied(), ..robconf.into() };
        match flange.ik_configured(&pose, request) {
            Ok(solution) => return (Some(solution.q), None),
            Err(error @ (Error::NoConfiguration(_) | Error::InvalidJoints(_))) => {
                missed = Some(error).filter(|_| conf == Conf::On);
            }
            Err(error) => return not_solved(error),
        }
    }
    match flange.ik_nearest(&pose, seed.unwrap_or(&[0.0; 6]), &[1.0; 6]) {
        Ok(solution) => {
            let kind = missed.map(|missed| FindingKind::Target(Problem::Nearest(missed)));
            (Some(solution.q), kind)
        }
        Err(error) => not_solved(error),
    }
}

/// The straight line in joint space between joints [rad]; `spacing` bounds the steps of a joint as
/// it does turns of the tool.
pub(super) fn joint_line(
    flange: &Robot<6>,
    spacing: Spacing,
    frames: &Frames,
    [from, to]: [&[f64; 6]; 2],
) -> Result<Path, Error> {
    let longest = from.iter().zip(to).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
    let count = spacing.steps_of_one([0.0, longest])?;
    let mut path = Path::default();
    let mut last = frames.tool(&flange.fk(from));
    for step in 1..=count {
        let q = if step == count { *to } else { mixed(from, to, part(step, count)) };
        let pose = frames.tool(&flange.fk(&q));
        path.push(q, way(&last, &pose));
        last = pose;
    }
    Ok(path)
}

/// Joints between two others.
pub(super) fn mixed(from: &[f64; 6], to: &[f64; 6], part: f64) -> [f64; 6] {
    core::array::from_fn(|joint| from[joint] + (to[joint] - from[joint]) * part)
}

impl Goal<'_> {
    /// How its target is met by a joint move.
    pub(in crate::rapid) fn conf(&self) -> Conf {
        let settings = self.step.settings;
        let on = if self.is_cartesian() { settings.conf_l } else { settings.conf_j };
        if on { Conf::On } else { Conf::Off }
    }
}
