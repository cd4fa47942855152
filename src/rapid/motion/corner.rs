//! Corners where the tool does not go on lines of one work object on both sides: rounded in joint
//! space.

use super::joints::mixed;
use super::samples::{Path, Samples, Way, way};
use crate::kinematics::Robot;
use crate::kinematics::thresholds::STEP_ROUNDING;
use crate::paths::line::part;
use crate::rapid::calc::frames::Frames;

/// Samples of each half of a corner.
const HALF: usize = 6;

/// Joints along the way of the tool from a corner: the first are those at the corner.
struct Side<'a> {
    /// The joints of sample `index`, from 0 at the corner.
    q: &'a dyn Fn(usize) -> [f64; 6],
    /// The way of the tool from sample `index - 1` to `index`.
    way: &'a dyn Fn(usize) -> Way,
    count: usize,
}

impl Side<'_> {
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

    fn at(&self, distance: f64) -> [f64; 6] {
        let (index, part) = self.place(distance);
        mixed(&(self.q)(index - 1), &(self.q)(index), part)
    }
}

/// Round the corner between the last move and `path`, which begins at its end, with a zone [m]
/// (eq. 34). Returns whether it is rounded; `path` then begins halfway through the corner.
pub(super) fn round_joints(
    flange: &Robot<6>,
    samples: &mut Samples,
    zone: f64,
    [before, after]: [&Frames; 2],
    path: &mut Path,
) -> bool {
    let Some(last) = samples.ends.len().checked_sub(1) else { return false };
    let own = samples.own(last);
    // Without a sample before it there is no way to its first sample.
    let (begin, end) = (own.start.max(1), own.end);
    let length: f64 = samples.ways[begin.min(end)..end].iter().map(|way| way[0]).sum();
    let radius = zone.min(0.5 * length).min(0.5 * path.length());
    if radius.is_nan() || radius <= 0.0 {
        return false;
    }
    let (q, ways) = (&samples.q, &samples.ways);
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
    let mut halves = [[[0.0; 6]; HALF]; 2];
    for (half, rows) in halves.iter_mut().enumerate() {
        for (step, row) in rows.iter_mut().enumerate() {
            let half = if half == 0 { 0.0 } else { 0.5 };
            *row = blended(half + 0.5 * part(step + 1, HALF));
        }
    }
    // The samples of the last move up to the corner, the entry, and half of the corner.
    samples.q.truncate(end - kept);
    samples.ways.truncate(end - kept);
    // Unless the zone begins at a sample.
    if entry_part < 1.0 - STEP_ROUNDING {
        samples.push(entry, entry_way);
    }
    let mut pose = before.tool(&flange.fk(&entry));
    for row in &halves[0] {
        let next = before.tool(&flange.fk(row));
        samples.push(*row, way(&pose, &next));
        pose = next;
    }
    samples.ends[last] = samples.q.len();
    let mut rounded = Path::default();
    let mut pose = after.tool(&flange.fk(&halves[0][HALF - 1]));
    for row in &halves[1] {
        let next = after.tool(&flange.fk(row));
        rounded.push(*row, way(&pose, &next));
        pose = next;
    }
    for index in left - 1..path.q.len() {
        let share = if index == left - 1 { 1.0 - exit_part } else { 1.0 };
        if share > STEP_ROUNDING {
            rounded.push(path.q[index], path.ways[index].map(|size| size * share));
        }
    }
    *path = rounded;
    true
}
