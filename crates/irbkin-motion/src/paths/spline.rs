//! A smooth curve of the tool through many poses.

use nalgebra::Vector3;

use super::line::{Turn, line, part};
use super::spacing::Spacing;
use crate::error::{Error, MotionFault};
use crate::paths::thresholds::{LEAST_TURN, LEAST_WAY};
use crate::prelude::*;
use crate::spline::{Ends, cubic};
use irbkin::internal::checked_pose;
use irbkin::{Pose, PoseDifference};

/// Parts of a span in which the rate of its turn is measured.
const RATE_PARTS: usize = 16;

/// Excess of the largest rate of a turn over the largest of the parts, as a part of its excess over
/// the mean rate [1]: the rate of the blend (27), as (1 - x^2)^2, falls by a hundredth within the
/// part next to its top.
const RATE_MARGIN: f64 = 0.05;

/// Even parts of a curve, in each of which its speed has one place at most where it is least: there
/// a curve that nearly stops has a kink of its speed.
const PARTS: usize = 16;

/// Most places at which the speed of a cubic is least.
const MOST_SLOW: usize = 3;

/// Panels, over each of which the length is a sum of five terms: the parts, cut at those places.
const PANELS: usize = PARTS + MOST_SLOW;

/// Halvings that bring a bracket of a place to the last digit.
const HALVINGS: usize = 53;

/// Rounds of Newton's iteration for a place on a curve: it converges in three or four, and halving
/// a panel replaces a step that leaves its bracket.
const MOST_ROUNDS: usize = 60;

/// Gauss' five places in -1 .. 1, one side, and their weights.
const PLACES: [f64; 3] = [0.0, 0.538_469_310_105_683_1, 0.906_179_845_938_664];
const WEIGHTS: [f64; 3] =
    [0.568_888_888_888_888_9, 0.478_628_670_499_366_47, 0.236_926_885_056_189_1];

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
/// [`irbkin::Error::InvalidPose`] for a pose that is not a rigid transform; [`Error::InvalidMotion`] for no
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
    let pieces: Vec<[f64; 4]> = cubic(&knots, &points, 3, Ends::NotAKnot);
    let spans_of_run = knots.windows(2).zip(pieces.chunks_exact(3));
    let curves: Vec<Curve> =
        spans_of_run.map(|(ends, pieces)| Curve::new(pieces, ends[1] - ends[0])).collect();
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

/// A cubic in space with a parameter from 0 to 1, by its length.
#[derive(Clone)]
struct Curve {
    terms: [Vector3<f64>; 4],
    /// Where the panels begin, and the end.
    edges: [f64; PANELS + 1],
    /// Lengths up to the end of each panel [m] (eq. 24).
    lengths: [f64; PANELS],
}

impl Curve {
    /// The cubic whose coordinates have these coefficients over a range of a parameter.
    fn new(pieces: &[[f64; 4]], range: f64) -> Self {
        let mut power = 1.0;
        let terms = core::array::from_fn(|order| {
            let term = Vector3::from_fn(|axis, _| pieces[axis][order] * power);
            power *= range;
            term
        });
        let mut curve = Self { terms, edges: [1.0; PANELS + 1], lengths: [0.0; PANELS] };
        for number in 0..PARTS {
            curve.edges[number] = part(number, PARTS);
        }
        let mut next = PARTS;
        for number in 0..PARTS {
            if let Some(place) = curve.slowest(part(number, PARTS), part(number + 1, PARTS))
                && next < PANELS
            {
                curve.edges[next] = place;
                next += 1;
            }
        }
        curve.edges.sort_unstable_by(f64::total_cmp);
        let mut sum = 0.0;
        for panel in 0..PANELS {
            sum += curve.between(curve.edges[panel], curve.edges[panel + 1]);
            curve.lengths[panel] = sum;
        }
        curve
    }

    /// The place between two others at which the speed is least.
    fn slowest(&self, mut low: f64, mut high: f64) -> Option<f64> {
        let [_, c1, c2, c3] = self.terms;
        // Half of the derivative of the speed's square.
        let growth = |u: f64| {
            let first = c1 + (c2 * 2.0 + c3 * (3.0 * u)) * u;
            first.dot(&(c2 * 2.0 + c3 * (6.0 * u)))
        };
        if !(growth(low) < 0.0 && growth(high) > 0.0) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if growth(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }

    /// Length [m].
    fn length(&self) -> f64 {
        self.lengths[PANELS - 1]
    }

    /// The point at a part of the length, 0 to 1.
    fn at(&self, part: f64) -> Vector3<f64> {
        let [c0, c1, c2, c3] = self.terms;
        let u = self.parameter(part * self.length());
        c0 + (c1 + (c2 + c3 * u) * u) * u
    }

    fn speed(&self, u: f64) -> f64 {
        let [_, c1, c2, c3] = self.terms;
        (c1 + (c2 * 2.0 + c3 * (3.0 * u)) * u).norm()
    }

    /// The length between two parameters, by Gauss' rule.
    fn between(&self, start: f64, end: f64) -> f64 {
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let both =
            |place: f64| self.speed(middle - half * place) + self.speed(middle + half * place);
        let outer = WEIGHTS[1] * both(PLACES[1]) + WEIGHTS[2] * both(PLACES[2]);
        half * (WEIGHTS[0] * self.speed(middle) + outer)
    }

    fn parameter(&self, length: f64) -> f64 {
        let panel = self.lengths[..PANELS - 1].partition_point(|end| *end <= length);
        let before = if panel == 0 { 0.0 } else { self.lengths[panel - 1] };
        let start = self.edges[panel];
        let (mut low, mut high) = (start, self.edges[panel + 1]);
        let rest = length - before;
        let part = rest / (self.lengths[panel] - before);
        // A curve without length is at one place all along.
        let mut u = if part.is_nan() { low } else { low + (high - low) * part };
        for _ in 0..MOST_ROUNDS {
            let off = self.between(start, u) - rest;
            if off.abs() <= f64::EPSILON * self.length() {
                break;
            }
            if off > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let next = u - off / self.speed(u);
            u = if low < next && next < high { next } else { 0.5 * (low + high) };
        }
        u
    }
}
