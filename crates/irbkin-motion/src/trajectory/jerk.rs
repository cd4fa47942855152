//! The pace along a path whose jerk is limited too: the fastest one without, averaged over a window
//! of time. The equations are in docs/theory/motion.md, section 3.

use alloc::collections::VecDeque;
use core::array;

use super::axis::AxisLimits;
use super::grid::{Grid, PaceLimits};
use super::phase::{AxisState, Phase};
use super::piecewise::Trajectory;
use super::polynomial::{TERMS, monotone_root};
use crate::error::{Error, MotionFault};
use crate::prelude::*;
use irbkin::Interrupt;

/// Rounds in which paces are lowered.
const MOST_ROUNDS: usize = 30;

/// Rounds without a shorter motion after which no more are tried.
const STALLED_ROUNDS: usize = 4;

/// Part by which a limit may be exceeded before the whole motion is stretched [1].
const SETTLED: f64 = 1e-3;

/// Most that a pace is lowered by in a round, as a ratio of speeds [1]: its neighbors are lowered
/// too, and less is needed then.
const LOWERED: f64 = 1.25;

/// Ratio of the accelerations that are tried one after another [1].
const LESS: f64 = 0.8;

/// Changes of the acceleration within a window, in limits of it [1]: from none to the limit, and
/// from the limit to its opposite.
const CHANGES: [f64; 2] = [1.0, 2.0];

/// Least window, as a part of the motion [1]: over a shorter one the means lose their digits.
const LEAST_WINDOW: f64 = 1e-5;

/// Most that terms of a degree above six may have in an angle [rad]. They are replaced by lower ones
/// and leave less than a tenth of it.
const MOST_REPLACED: f64 = 1e-9;

/// A motion along the path: paces at the points of the grid, their times [s] and their places.
struct Pace {
    paces: Vec<f64>,
    times: Vec<f64>,
    places: Vec<f64>,
}

impl Pace {
    fn of(grid: &Grid, paces: Vec<f64>) -> Self {
        let (mut times, mut places) = (vec![0.0], vec![0.0]);
        for (index, length) in grid.lengths.iter().enumerate() {
            let speeds = paces[index].sqrt() + paces[index + 1].sqrt();
            times.push(times[index] + 2.0 * length / speeds);
            places.push(places[index] + length);
        }
        Self { paces, times, places }
    }

    fn duration(&self) -> f64 {
        self.times[self.times.len() - 1]
    }

    /// Place, speed and acceleration at a time before a point of the grid; at rest before the first
    /// and behind the last one.
    fn state(&self, point: usize, time: f64) -> [f64; 3] {
        let Some(before) = point.checked_sub(1) else { return [0.0; 3] };
        if point == self.paces.len() {
            return [self.places[before], 0.0, 0.0];
        }
        let length = self.places[point] - self.places[before];
        let acceleration = (self.paces[point] - self.paces[before]) / (2.0 * length);
        let (speed, since) = (self.paces[before].sqrt(), time - self.times[before]);
        let place = self.places[before] + since * (speed + since * acceleration / 2.0);
        [place, speed + since * acceleration, acceleration]
    }
}

/// The path at a pace at which each joint keeps its jerk, too; none exceeds `most`.
pub(super) fn paced_with_jerk(
    grid: &Grid,
    limits: &PaceLimits<'_>,
    max_jerk: &[f64],
    most: f64,
    interrupt: Interrupt<'_>,
) -> Result<Trajectory, Error> {
    let axes: Vec<AxisLimits> = (0..max_jerk.len())
        .map(|joint| AxisLimits {
            velocity: limits.max_velocity[joint],
            acceleration: limits.max_acceleration[joint],
            jerk: max_jerk[joint],
        })
        .collect();
    let mut best: Option<(f64, f64, Pace, f64)> = None;
    for change in CHANGES {
        let (max_acceleration, window) =
            accelerations(grid, limits, &axes, (most, change), interrupt)?;
        let limits = PaceLimits { max_acceleration: &max_acceleration, ..*limits };
        let mut caps = vec![most; grid.lengths.len()];
        let (mut least, mut stalled) = (f64::INFINITY, 0);
        for _ in 0..MOST_ROUNDS {
            let pace = Pace::of(grid, grid.paces(&limits, |piece| caps[piece], interrupt)?);
            let motion = averaged(grid, &pace, window, interrupt)?;
            let excess = motion.excesses(&axes);
            let factor = excess.iter().copied().fold(1.0, f64::max);
            lower(&mut caps, &pace, &motion, &excess, window);
            let duration = factor * motion.duration();
            stalled = if duration < least * (1.0 - SETTLED) { 0 } else { stalled + 1 };
            least = least.min(duration);
            if best.as_ref().is_none_or(|(least, ..)| duration < *least) {
                best = Some((duration, factor, pace, window));
            }
            if factor <= 1.0 + SETTLED || stalled == STALLED_ROUNDS {
                break;
            }
        }
    }
    match best {
        Some((_, factor, pace, window)) => {
            averaged(grid, &pace, window, interrupt)?.stretched(factor)
        }
        None => Err(MotionFault::Overflow.into()),
    }
}

/// The limits of acceleration and the window [s] with which the motion is the shortest on a straight
/// path where the acceleration changes by `change` limits: less of it needs a shorter window.
fn accelerations(
    grid: &Grid,
    limits: &PaceLimits<'_>,
    axes: &[AxisLimits],
    (most, change): (f64, f64),
    interrupt: Interrupt<'_>,
) -> Result<(Vec<f64>, f64), Error> {
    // More is not reached between rest and full velocity.
    let useful = |axis: &AxisLimits| axis.acceleration.min((axis.velocity * axis.jerk).sqrt());
    let mut accelerations: Vec<f64> = axes.iter().map(useful).collect();
    let (mut least, mut found) = (f64::INFINITY, (accelerations.clone(), 0.0));
    loop {
        let windows = accelerations.iter().zip(axes).map(|(most, axis)| change * most / axis.jerk);
        // A joint without limits has none.
        let window = windows.filter(|window| *window < f64::INFINITY).fold(0.0, f64::max);
        let limits = PaceLimits { max_acceleration: &accelerations, ..*limits };
        let pace = Pace::of(grid, grid.paces(&limits, |_| most, interrupt)?);
        let window = window.max(LEAST_WINDOW * pace.duration());
        let duration = pace.duration() + window;
        if duration.is_nan() || duration >= least {
            return Ok(found);
        }
        (least, found) = (duration, (accelerations.clone(), window));
        for acceleration in &mut accelerations {
            *acceleration *= LESS;
        }
    }
}

/// The motion whose place at each time is the mean of the places of a pace over the window before
/// (eq. 16b).
fn averaged(
    grid: &Grid,
    pace: &Pace,
    window: f64,
    interrupt: Interrupt<'_>,
) -> Result<Trajectory, Error> {
    let mut walk = Walk { grid, piece: 0, place: 0.0, knots: vec![0.0], terms: Vec::new() };
    let (last, mut time) = (grid.lengths.len(), 0.0);
    let (mut front, mut back) = (1, 0);
    while back <= last {
        interrupt.check(front + back)?;
        let (now, before) = (pace.state(front, time), pace.state(back, time - window));
        let behind = pace.times[back] + window;
        let next = if front <= last { pace.times[front].min(behind) } else { behind };
        let [velocity, acceleration, jerk] =
            array::from_fn(|order| (now[order] - before[order]) / window);
        let start = AxisState { position: walk.place, velocity, acceleration };
        walk.go(Phase { duration: next - time, start, jerk });
        time = next;
        if front <= last && pace.times[front] <= next {
            front += 1;
        } else {
            back += 1;
        }
    }
    Ok(Trajectory::new(grid.dof, walk.knots, walk.terms))
}

/// A motion along the pieces of a grid, in parts of constant jerk along the path.
struct Walk<'a> {
    grid: &'a Grid,
    piece: usize,
    /// Place since the beginning of the piece.
    place: f64,
    knots: Vec<f64>,
    terms: Vec<[f64; TERMS]>,
}

impl Walk<'_> {
    /// Go on in a phase that begins at the place.
    fn go(&mut self, mut phase: Phase) {
        while phase.duration > 0.0 {
            let mut way = phase.terms();
            way[0] = phase.start.position - self.grid.lengths[self.piece];
            let is_last = self.piece + 1 == self.grid.lengths.len();
            let root = monotone_root(&way, 0.0, phase.duration).filter(|_| !is_last);
            let mut part = Phase { duration: root.unwrap_or(phase.duration), ..phase };
            let mut is_whole = true;
            while self.above_six(&part) > MOST_REPLACED {
                (part.duration, is_whole) = (0.5 * part.duration, false);
            }
            self.part(&part);
            phase.start = part.end();
            if root.is_some() && is_whole {
                (self.piece, phase.start.position) = (self.piece + 1, 0.0);
            }
            self.place = phase.start.position;
            phase.duration -= part.duration;
        }
    }

    /// The largest part of an angle that the terms of a degree above six have in a phase [rad].
    fn above_six(&self, phase: &Phase) -> f64 {
        let cubics = &self.grid.terms[self.piece * self.grid.dof..][..self.grid.dof];
        let most = cubics.iter().map(|terms| terms[3].abs()).fold(0.0, f64::max);
        let (t, AxisState { velocity, acceleration, .. }) = (phase.duration, phase.start);
        let [x, y, z] =
            [velocity * t, acceleration * t * t / 2.0, phase.jerk * t * t * t / 6.0].map(f64::abs);
        most * z * (3.0 * (x * z + y * y + y * z) + z * z)
    }

    /// Put s(t) into the cubics of the piece (eq. 16b). What has a degree above six is replaced by
    /// terms of degree four to six with the same position, velocity and acceleration at both ends.
    fn part(&mut self, phase: &Phase) {
        let ([s, x, y, z, ..], h) = (phase.terms(), phase.duration);
        let [seven, eight, nine] = [
            3.0 * z * (x * z + y * y) * h * h * h,
            3.0 * y * z * z * h.powi(4),
            (z * z * z) * h.powi(5),
        ];
        let replaced = [
            seven + 3.0 * eight + 6.0 * nine,
            -(3.0 * seven + 8.0 * eight + 15.0 * nine) / h,
            (3.0 * seven + 6.0 * eight + 10.0 * nine) / (h * h),
        ];
        let cubics = &self.grid.terms[self.piece * self.grid.dof..][..self.grid.dof];
        self.terms.extend(cubics.iter().map(|[c0, c1, c2, c3, ..]| {
            let b1 = c1 + s * (2.0 * c2 + s * 3.0 * c3);
            let (b2, b3) = (c2 + 3.0 * c3 * s, *c3);
            [
                c0 + s * (c1 + s * (c2 + s * c3)),
                b1 * x,
                b1 * y + b2 * x * x,
                b1 * z + 2.0 * b2 * x * y + b3 * x * x * x,
                b2 * (y * y + 2.0 * x * z) + 3.0 * b3 * x * x * y + b3 * replaced[0],
                2.0 * b2 * y * z + 3.0 * b3 * x * (y * y + x * z) + b3 * replaced[1],
                b2 * z * z + b3 * y * (y * y + 6.0 * x * z) + b3 * replaced[2],
            ]
        }));
        self.knots.push(self.knots[self.knots.len() - 1] + h);
    }
}

/// Lower the caps of the pieces of the grid that are in the window of a part of the motion that
/// exceeds a limit.
fn lower(caps: &mut [f64], pace: &Pace, motion: &Trajectory, excess: &[f64], window: f64) {
    let knots = motion.knots();
    let (mut next, mut highest) = (0, VecDeque::<usize>::new());
    for (piece, cap) in caps.iter_mut().enumerate() {
        let [start, end] = [pace.times[piece], pace.times[piece + 1] + window];
        while next < excess.len() && knots[next] < end {
            while highest.back().is_some_and(|part| excess[*part] <= excess[next]) {
                highest.pop_back();
            }
            highest.push_back(next);
            next += 1;
        }
        while highest.front().is_some_and(|part| knots[part + 1] <= start) {
            highest.pop_front();
        }
        let most = highest.front().map_or(1.0, |part| excess[*part]);
        if most > 1.0 {
            let own = pace.paces[piece].max(pace.paces[piece + 1]);
            let ratio = most.min(LOWERED);
            *cap = cap.min(own / (ratio * ratio));
        }
    }
}
