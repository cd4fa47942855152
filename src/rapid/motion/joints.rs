//! Moves of the joints: where they go, and the straight line in joint space that gets there.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use alloc::vec::Vec;

use super::drive::Drive;
use super::finding::FindingKind;
use super::goal::{Goal, Place};
use super::samples::{Way, way};
use crate::error::{Error, MotionFault};
use crate::kinematics::thresholds::{MOST_SAMPLES, STEP_ROUNDING};
use crate::rapid::calc::frames::Frames;
use crate::rapid::calc::problem::Problem;

/// The joints of a move after those that it begins with, and the way of the tool to each.
#[derive(Default)]
pub(super) struct Path {
    pub(super) q: Vec<[f64; 6]>,
    pub(super) ways: Vec<Way>,
}

impl Path {
    pub(super) fn push(&mut self, q: [f64; 6], way: Way) {
        self.q.push(q);
        self.ways.push(way);
    }

    /// The length of the tool's way [m].
    pub(super) fn length(&self) -> f64 {
        self.ways.iter().map(|way| way[0]).sum()
    }
}

/// Whether a target must be met with its own configuration.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Conf {
    /// It must; where no solution has it, that is a finding and the nearest one is taken.
    On,
    /// The nearest one is taken.
    Off,
    /// As `On`, without a finding.
    Quiet,
}

impl Drive<'_, '_> {
    /// The joints at the target of a move, from `seed`; `None` with a finding.
    pub(super) fn solved(
        &mut self,
        index: usize,
        seed: Option<&[f64; 6]>,
        conf: Conf,
    ) -> Option<[f64; 6]> {
        let goal = &self.goals[index];
        let (pose, robconf) = match goal.place? {
            Place::Joints(q) => return Some(q),
            Place::Tool(pose, robconf) => (goal.frames.flange(&pose), robconf),
        };
        let nearest = seed.filter(|_| conf == Conf::Off);
        let missed = if nearest.is_none() {
            match self.flange.ik_configured(&pose, robconf) {
                Ok(solution) => return Some(solution.q),
                Err(error @ (Error::NoConfiguration(_) | Error::InvalidJoints(_))) => Some(error),
                Err(error) => {
                    self.found(index, FindingKind::Target(Problem::NotSolved(error)));
                    return None;
                }
            }
        } else {
            None
        };
        match self.flange.ik_nearest(&pose, seed.unwrap_or(&[0.0; 6]), &[1.0; 6]) {
            Ok(solution) => {
                if let (Some(missed), Conf::On) = (missed, conf) {
                    self.found(index, FindingKind::Target(Problem::Nearest(missed)));
                }
                Some(solution.q)
            }
            Err(error) => {
                self.found(index, FindingKind::Target(Problem::NotSolved(error)));
                None
            }
        }
    }

    /// The straight line in joint space to `to` [rad].
    pub(super) fn joint_line(
        &self,
        frames: &Frames,
        from: &[f64; 6],
        to: &[f64; 6],
    ) -> Result<Path, Error> {
        let longest = from.iter().zip(to).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
        let steps = longest / self.options.turn;
        #[expect(clippy::cast_precision_loss, reason = "exact")]
        let most = MOST_SAMPLES as f64;
        if steps > most {
            return Err(MotionFault::TooMany { found: steps, most }.into());
        }
        let mut path = Path::default();
        if longest == 0.0 {
            return Ok(path);
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 1e7")]
        let count = (steps - STEP_ROUNDING).max(1.0).ceil() as usize;
        let mut last = frames.tool(&self.flange.fk(from));
        for step in 1..=count {
            let part = crate::paths::line::part(step, count);
            let q = if step == count {
                *to
            } else {
                core::array::from_fn(|joint| from[joint] + (to[joint] - from[joint]) * part)
            };
            let pose = frames.tool(&self.flange.fk(&q));
            path.push(q, way(&last, &pose));
            last = pose;
        }
        Ok(path)
    }

    /// A joint move from `from` to its target; `None` with a finding if that has no joints.
    pub(super) fn joint_move(
        &mut self,
        index: usize,
        from: &[f64; 6],
        conf: Conf,
    ) -> Result<Option<Path>, Error> {
        let Some(to) = self.solved(index, Some(from), conf) else { return Ok(None) };
        let frames = self.goals[index].frames;
        self.joint_line(&frames, from, &to).map(Some)
    }
}

impl Goal<'_> {
    /// How its target is met by a joint move.
    pub(super) fn conf(&self) -> Conf {
        let settings = self.step.settings;
        let on = if self.is_cartesian() { settings.conf_l } else { settings.conf_j };
        if on { Conf::On } else { Conf::Off }
    }
}
