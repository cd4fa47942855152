//! Moves of the joints: samples of a motion, straight lines in joint space, and corners rounded in
//! joint space, where the tool does not go on lines of one work object on both sides.

use core::ops::Range;

use super::goal::{Conf, Goal, Place};
use crate::Error;
use crate::prelude::*;
use crate::rapid::calc::confdata::{Over, near, over_quarters};
use crate::rapid::calc::frames::Frames;
use crate::rapid::calc::wrong::{ambiguous, beside_taken, nearest_taken, not_solved};
use crate::rapid::data::finding::Finding;
use crate::rapid::motion::thresholds::NEAR_CONFDATA;
use irbkin::report::ConfigurationRule;
use irbkin::{ConfigurationRequest, Error as RobotError, Explanation, Pose, Robot};
use irbkin_motion::internal::{STEP_ROUNDING, part};
use irbkin_motion::paths::Spacing;

/// The way of the tool between two samples: a length [m] and an angle [rad].
pub(in crate::rapid) type Way = [f64; 2];

/// Samples in order, grouped by moves.
#[derive(Default)]
pub(in crate::rapid) struct Samples<const N: usize> {
    pub(in crate::rapid) path: Path<N>,
    /// How many samples there are after each move.
    pub(in crate::rapid) ends: Vec<usize>,
    /// How many there are before the first move: 1 if a start is given.
    pub(in crate::rapid) first: usize,
    pub(super) forgotten: usize,
}

impl<const N: usize> Samples<N> {
    /// Forget the samples of the moves before one, but for the last.
    pub(in crate::rapid) fn forget_before(&mut self, index: usize) {
        let Some(before) = index.checked_sub(1) else { return };
        let count = self.ends[before].saturating_sub(1);
        self.path.q.drain(..count);
        self.path.ways.drain(..count);
        self.ends[before..].iter_mut().for_each(|end| *end -= count);
        self.forgotten += count;
    }

    /// The samples of a move.
    pub(in crate::rapid) fn own(&self, index: usize) -> Range<usize> {
        let begin = index.checked_sub(1).map_or(self.first, |before| self.ends[before]);
        begin..self.ends[index]
    }

    /// The joints along a move, from where it begins.
    pub(in crate::rapid) fn along(&self, index: usize) -> &[[f64; N]] {
        let intervals = self.intervals(index);
        &self.path.q[intervals.start.saturating_sub(1)..intervals.end]
    }

    /// The intervals of a move, by the samples that they end at.
    pub(in crate::rapid) fn intervals(&self, index: usize) -> Range<usize> {
        let own = self.own(index);
        own.start.max(1).min(own.end)..own.end
    }
}

/// Joints one after the other, as those of a move after those that it begins with, and the way of
/// the tool to each.
#[derive(Default)]
pub(in crate::rapid) struct Path<const N: usize> {
    pub(in crate::rapid) q: Vec<[f64; N]>,
    pub(in crate::rapid) ways: Vec<Way>,
}

impl<const N: usize> Path<N> {
    pub(in crate::rapid) fn push(&mut self, q: [f64; N], way: Way) {
        self.q.push(q);
        self.ways.push(way);
    }

    pub(super) fn append(&mut self, mut behind: Self) {
        self.q.append(&mut behind.q);
        self.ways.append(&mut behind.ways);
    }

    /// Joints behind others, with a tool in a work object.
    fn behind(
        from: &[f64; N],
        joints: impl IntoIterator<Item = [f64; N]>,
        flange: &Robot<N>,
        frames: &Frames,
    ) -> Self {
        let mut path = Self::default();
        let mut last = frames.tool(&flange.fk(from));
        for q in joints {
            let pose = frames.tool(&flange.fk(&q));
            path.push(q, way(&last, &pose));
            last = pose;
        }
        path
    }

    /// The length of the tool's way [m].
    pub(in crate::rapid) fn length(&self) -> f64 {
        self.ways.iter().map(|way| way[0]).sum()
    }
}

/// The way of the tool from one pose to another.
pub(in crate::rapid) fn way(from: &Pose, to: &Pose) -> Way {
    let length = (to.translation.vector - from.translation.vector).norm();
    // |R1 - R0| in the Frobenius norm is 2 sqrt(2) sin(angle / 2).
    let apart = (to.rotation.matrix() - from.rotation.matrix()).norm();
    let half_sin = apart / (2.0 * core::f64::consts::SQRT_2);
    [length, 2.0 * half_sin.min(1.0).asin()]
}

/// The joints at the target of a move, from `seed`, with what is wrong with them; `None` if it has
/// none. `flange` is the robot with the flange as its tool.
pub(super) fn solved<const N: usize>(
    flange: &Robot<N>,
    goal: &Goal<'_, N>,
    seed: Option<&[f64; N]>,
    conf: Conf,
) -> (Option<[f64; N]>, Option<Finding>) {
    let (pose, wanted) = match goal.place {
        None => return (None, None),
        Some(Place::Joints(q)) => return (Some(q), None),
        Some(Place::Tool(pose, wanted)) => (goal.frames.flange(&pose), wanted),
    };
    let (mut missed, mut beside) = (None, None);
    if conf != Conf::Off || seed.is_none() {
        let request = ConfigurationRequest { seed: seed.copied(), ..wanted };
        match named(flange, &pose, &request) {
            Ok((q, count)) => {
                let is_one = count == 1 || conf != Conf::On || goal.is_cartesian();
                return (Some(q), (!is_one).then(|| ambiguous(count)));
            }
            Err(
                error @ Error::Robot(RobotError::NoConfiguration(_) | RobotError::InvalidJoints(_)),
            ) => {
                beside = nearest_written(flange, &pose, &wanted);
                // Running cells keep targets whose tool or work object was measured again.
                if let Some((q, over)) = beside
                    && over.by <= NEAR_CONFDATA
                    && let Ok(found) = flange.configuration(&q)
                {
                    let finding = near(&over, wanted.configuration, found);
                    return (Some(q), Some(finding).filter(|_| conf == Conf::On));
                }
                missed = Some(error).filter(|_| conf == Conf::On);
            }
            Err(error) => return (None, Some(not_solved(&error))),
        }
    }
    if let Some((q, over)) = beside {
        return (Some(q), missed.as_ref().map(|missed| beside_taken(missed, &over)));
    }
    match flange.ik_nearest_at(&pose, seed.unwrap_or(&[0.0; N]), wanted.arm_angle) {
        Ok(q) => (Some(q), missed.as_ref().map(nearest_taken)),
        Err(error) => (None, Some(not_solved(&error.into()))),
    }
}

/// The joints that a configuration names, the nearest to a seed, and how many it names.
fn named<const N: usize>(
    flange: &Robot<N>,
    pose: &Pose,
    request: &ConfigurationRequest<N>,
) -> Result<([f64; N], usize), Error> {
    if flange.configuration_rule()? == ConfigurationRule::SphericalWrist {
        return Ok((flange.ik_configured(pose, *request)?.q, 1));
    }
    let all = flange.ik_configured_all(pose, *request)?;
    let first = all.first().ok_or(RobotError::Unreachable(Explanation::FilteredOut))?;
    Ok((first.q, all.len()))
}

/// The joints inside the limits that are nearest to a configuration that no solution has: on its
/// branch, and least over its quarters.
pub(in crate::rapid) fn nearest_written<const N: usize>(
    flange: &Robot<N>,
    pose: &Pose,
    request: &ConfigurationRequest<N>,
) -> Option<([f64; N], Over)> {
    let wanted = request.configuration;
    let inside = flange.ik_inside_at(pose, request.arm_angle).ok()?;
    let over = inside.into_iter().filter_map(|q| Some((q, over_quarters(flange, &q, wanted)?)));
    over.min_by(|a, b| a.1.by.total_cmp(&b.1.by))
}

/// The straight line in joint space between joints [rad]; `spacing` bounds the steps of a joint as
/// it does turns of the tool.
pub(super) fn joint_line<const N: usize>(
    flange: &Robot<N>,
    spacing: Spacing,
    frames: &Frames,
    [from, to]: [&[f64; N]; 2],
) -> Result<Path<N>, Error> {
    let longest = from.iter().zip(to).map(|(a, b)| (b - a).abs()).fold(0.0, f64::max);
    let count = spacing.steps_of_one([0.0, longest])?;
    let at = |step| if step == count { *to } else { mixed(from, to, part(step, count)) };
    Ok(Path::behind(from, (1..=count).map(at), flange, frames))
}

/// Joints between two others.
pub(super) fn mixed<const N: usize>(from: &[f64; N], to: &[f64; N], part: f64) -> [f64; N] {
    core::array::from_fn(|joint| from[joint] + (to[joint] - from[joint]) * part)
}

/// Samples of each half of a corner.
const HALF: usize = 6;

/// Joints along the way of the tool from a corner: the first are those at the corner.
struct Side<'a, const N: usize> {
    /// The joints of sample `index`, from 0 at the corner.
    q: &'a dyn Fn(usize) -> [f64; N],
    /// The way of the tool from sample `index - 1` to `index`.
    way: &'a dyn Fn(usize) -> Way,
    count: usize,
}

impl<const N: usize> Side<'_, N> {
    /// The first sample at a distance or more, and how far into the interval before it the distance
    /// is, 0 to 1.
    fn place(&self, distance: f64) -> (usize, f64) {
        let (mut index, mut left) = (1, distance);
        while index + 1 < self.count && (self.way)(index)[0] < left {
            left -= (self.way)(index)[0];
            index += 1;
        }
        let length = (self.way)(index)[0];
        (index, if length > 0.0 { (left / length).min(1.0) } else { 1.0 })
    }

    fn at(&self, distance: f64) -> [f64; N] {
        let (index, part) = self.place(distance);
        mixed(&(self.q)(index - 1), &(self.q)(index), part)
    }
}

/// Round the corner between the last move and `path`, which begins at its end, with a zone [m]
/// (eq. 34). Returns whether it is rounded; `path` then begins halfway through the corner.
pub(super) fn round_joints<const N: usize>(
    flange: &Robot<N>,
    samples: &mut Samples<N>,
    zone: f64,
    [before, after]: [&Frames; 2],
    path: &mut Path<N>,
) -> bool {
    let Some(last) = samples.ends.len().checked_sub(1) else { return false };
    let own = samples.own(last);
    // Its first sample needs one before it, to have a way.
    let (begin, end) = (own.start.max(1), own.end);
    let length: f64 = samples.path.ways[begin.min(end)..end].iter().map(|way| way[0]).sum();
    let radius = zone.min(0.5 * length).min(0.5 * path.length());
    if radius.is_nan() || radius <= 0.0 {
        return false;
    }
    let (q, ways) = (&samples.path.q, &samples.path.ways);
    let behind = Side {
        q: &|index| q[end - 1 - index],
        way: &|index| ways[end - index],
        count: end - begin + 1,
    };
    let corner = q[end - 1];
    let ahead = Side {
        q: &|index| index.checked_sub(1).map_or(corner, |index| path.q[index]),
        way: &|index| path.ways[index - 1],
        count: path.q.len() + 1,
    };
    // De Casteljau's construction, of joints.
    let blended = |u: f64| mixed(&behind.at((1.0 - u) * radius), &ahead.at(u * radius), u);
    let (kept, entry_part) = behind.place(radius);
    let entry = behind.at(radius);
    let entry_way = ways[end - kept].map(|size| size * (1.0 - entry_part));
    let (left, exit_part) = ahead.place(radius);
    let [first, second] = [0.0, 0.5].map(|begin| {
        core::array::from_fn::<_, HALF, _>(|step| blended(begin + 0.5 * part(step + 1, HALF)))
    });
    // The samples of the last move up to the corner, the entry, and half of the corner.
    samples.path.q.truncate(end - kept);
    samples.path.ways.truncate(end - kept);
    // Unless the zone begins at a sample.
    if entry_part < 1.0 - STEP_ROUNDING {
        samples.path.push(entry, entry_way);
    }
    samples.path.append(Path::behind(&entry, first, flange, before));
    samples.ends[last] = samples.path.q.len();
    let mut rounded = Path::behind(&first[HALF - 1], second, flange, after);
    for index in left - 1..path.q.len() {
        let share = if index == left - 1 { 1.0 - exit_part } else { 1.0 };
        if share > STEP_ROUNDING {
            rounded.push(path.q[index], path.ways[index].map(|size| size * share));
        }
    }
    *path = rounded;
    true
}
