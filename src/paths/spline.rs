//! A smooth curve of the tool through many poses.

use alloc::vec::Vec;

use nalgebra::Vector3;

use super::curve::Curve;
use super::line::{line, part};
use super::spacing::Spacing;
use super::turn::Turn;
use crate::error::{Error, MotionFault};
use crate::kinematics::thresholds::{LEAST_TURN, LEAST_WAY};
use crate::kinematics::{Pose, PoseDifference, checked_pose};
use crate::spline::{Ends, cubic_slopes};

/// Parts of a span in which the rate of its turn is measured.
const RATE_PARTS: usize = 16;

/// What the largest rate of a turn may exceed that of the parts by, as a part of its excess over
/// the mean rate [1]: the rate of the blend (27), as (1 - x^2)^2, falls by a hundredth within the
/// part next to its top.
const RATE_MARGIN: f64 = 0.05;

/// Poses along a smooth curve through poses, all of which are met.
///
/// The position is a cubic spline with continuous second derivative over the lengths of the chords
/// (eq. 23); the orientation's angular velocity and acceleration are continuous over the length of
/// that curve, the latter zero at each pose (eq. 25 to 27). The way from one pose to the next is
/// divided into equal steps along the curve (eq. 24). Where the tool only turns, it stops and turns
/// about one axis: the curves before and behind are splines of their own. Poses that repeat the one
/// before them, within 1e-9 m and 1e-9 rad, are left out. Through two poses it is a line.
///
/// # Errors
///
/// [`Error::InvalidPose`] for a pose that is not a rigid transform; [`Error::InvalidMotion`] for no
/// pose, a half turn between two, or a spacing that leaves the number of poses open.
pub fn spline(poses: &[Pose], spacing: Spacing) -> Result<Vec<Pose>, Error> {
    let mut met: Vec<Pose> = Vec::with_capacity(poses.len());
    // Which pose each of them is.
    let mut indices = Vec::with_capacity(poses.len());
    for (index, pose) in poses.iter().enumerate() {
        let pose = checked_pose(pose)?;
        if met.last().is_none_or(|last| !repeats(last, &pose)) {
            met.push(pose);
            indices.push(index);
        }
    }
    match (&met[..], poses.len()) {
        ([], _) => return Err(MotionFault::TooFew { field: "T", found: 0, least: 1 }.into()),
        ([_], 1) => return Ok(met),
        ([one], _) => return line(one, one, spacing, None),
        _ => {}
    }
    let spans = spans(&met, &indices)?;
    let sizes: Vec<[f64; 2]> =
        spans.iter().map(|span| span.size(spacing)).collect::<Result<_, _>>()?;
    let steps = spacing.steps(&sizes)?;
    let mut path = Vec::with_capacity(steps.iter().sum::<usize>() + 1);
    path.push(met[0]);
    for ((span, steps), end) in spans.iter().zip(steps).zip(&met[1..]) {
        for step in 1..steps {
            path.push(span.at(part(step, steps))?);
        }
        path.push(*end);
    }
    Ok(path)
}

fn repeats(last: &Pose, pose: &Pose) -> bool {
    let apart = PoseDifference::between(last, pose);
    apart.position < LEAST_WAY && apart.rotation < LEAST_TURN
}

/// The spans of all runs: a run is a curve of its own. One of several spans moves the tool in each
/// of them; a span in which the tool only turns is a run.
pub(super) fn spans(poses: &[Pose], indices: &[usize]) -> Result<Vec<Span>, Error> {
    let last = poses.len() - 1;
    let moves = |span: usize| chord(&poses[span..]) >= LEAST_WAY;
    let mut spans = Vec::with_capacity(last);
    let mut start = 0;
    while start < last {
        let mut end = start + 1;
        while moves(start) && end < last && moves(end) {
            end += 1;
        }
        add_run(&poses[start..=end], &indices[start..=end], &mut spans)?;
        start = end;
    }
    Ok(spans)
}

/// The distance of the first pose from the second [m].
fn chord(poses: &[Pose]) -> f64 {
    (poses[1].translation.vector - poses[0].translation.vector).norm()
}

fn add_run(poses: &[Pose], indices: &[usize], spans: &mut Vec<Span>) -> Result<(), Error> {
    let mut knots = Vec::with_capacity(poses.len());
    knots.push(0.0);
    for pair in poses.windows(2) {
        let chord = chord(pair);
        // Where the tool only turns any length serves.
        knots.push(knots[knots.len() - 1] + if chord < LEAST_WAY { 1.0 } else { chord });
    }
    let points: Vec<f64> =
        poses.iter().flat_map(|pose| pose.translation.vector.data.0[0]).collect();
    let slopes = cubic_slopes(&knots, &points, 3, Ends::NotAKnot);
    let row = |rows: &[f64], knot: usize| Vector3::from_column_slice(&rows[3 * knot..][..3]);
    let curves: Vec<Curve> = knots
        .windows(2)
        .enumerate()
        .map(|(span, ends)| {
            let both = [span, span + 1];
            let (points, slopes) =
                (both.map(|knot| row(&points, knot)), both.map(|knot| row(&slopes, knot)));
            Curve::new(points, slopes, ends[1] - ends[0])
        })
        .collect();
    let turns: Vec<Vector3<f64>> = poses
        .windows(2)
        .zip(&indices[1..])
        .map(|(pair, index)| {
            let turn = Turn::new(&pair[0].rotation, &pair[1].rotation, None, *index)?;
            Ok(turn.vector())
        })
        .collect::<Result<_, Error>>()?;
    // The rate of the turn at a pose, for a span next to it: even at both ends of the run.
    let rate = |pose: usize, span: usize| {
        let before = pose.checked_sub(1).filter(|before| *before < curves.len());
        match (before, curves.get(pose)) {
            (Some(before), Some(after)) => {
                let both = [turns[before] / curves[before].length(), turns[pose] / after.length()];
                mean_rate(both) * curves[span].length()
            }
            _ => turns[span],
        }
    };
    for (span, curve) in curves.iter().enumerate() {
        let ahead = Turn::by(&poses[span].rotation, &rate(span, span));
        let back = Turn::by(&poses[span + 1].rotation, &-rate(span + 1, span));
        let (turn, index) = (turns[span].norm(), indices[span + 1]);
        spans.push(Span { curve: curve.clone(), ahead, back, turn, index });
    }
    Ok(())
}

/// A mean of two rates of turn: harmonic where both have one axis, zero where one is zero or both
/// are opposite (eq. 25). It turns the way of both, and is at most twice the smaller: a span that
/// turns little next to one that turns much exceeds its own turn by 7.1 % at most.
fn mean_rate([before, after]: [Vector3<f64>; 2]) -> Vector3<f64> {
    let (first, second) = (before.norm(), after.norm());
    if first + second == 0.0 {
        return Vector3::zeros();
    }
    before * (second / (first + second)) + after * (first / (first + second))
}

/// The way from one pose to the next.
pub(super) struct Span {
    curve: Curve,
    /// From the pose at the start on, at the rate there, and from that at the end back.
    ahead: Turn,
    back: Turn,
    /// The angle from one to the other [rad].
    turn: f64,
    /// The pose at the end.
    index: usize,
}

impl Span {
    pub(super) fn at(&self, part: f64) -> Result<Pose, Error> {
        let position = self.curve.at(part);
        Ok(Pose::from_parts(position.into(), self.turned(part)?.at(blend(part))))
    }

    /// Length [m].
    pub(super) fn length(&self) -> f64 {
        self.curve.length()
    }

    /// From the turn ahead to the turn back at a part of the way (eq. 26).
    fn turned(&self, part: f64) -> Result<Turn, Error> {
        Turn::new(&self.ahead.at(part), &self.back.at(1.0 - part), None, self.index)
    }

    /// Length [m] and an angle that the tool does not turn by more than in equal steps [rad].
    fn size(&self, spacing: Spacing) -> Result<[f64; 2], Error> {
        if !spacing.is_by_angle() {
            return Ok([self.length(), self.turn]);
        }
        let mut last = self.ahead.at(0.0);
        let mut most: f64 = 0.0;
        for step in 1..=RATE_PARTS {
            let part = part(step, RATE_PARTS);
            let next = self.turned(part)?.at(blend(part));
            most = most.max(Turn::new(&last, &next, None, self.index)?.angle);
            last = next;
        }
        #[expect(clippy::cast_precision_loss, reason = "a small count")]
        let fastest = most * RATE_PARTS as f64;
        Ok([self.length(), fastest + RATE_MARGIN * (fastest - self.turn).max(0.0)])
    }
}

/// From 0 to 1 with two derivatives that are zero at both ends (eq. 27).
fn blend(part: f64) -> f64 {
    part * part * part * (10.0 + part * (6.0 * part - 15.0))
}
