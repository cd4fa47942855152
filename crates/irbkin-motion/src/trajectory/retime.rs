//! The fastest trajectory along samples of a path: its arguments and its spline.

use super::check::{
    check_duration, check_finite, check_limits, check_path_limits, check_positive, check_rows,
};
use super::grid::{Grid, PaceLimits};
use super::jerk::paced_with_jerk;
use super::piecewise::Trajectory;
use super::polynomial::TERMS;
use super::tool_speed::ToolPath;
use crate::error::{Error, MotionFault};
use crate::prelude::*;
use crate::spline::{Ends, cubic};
use crate::trajectory::thresholds::PATH_DIRECTION;
use irbkin::Interrupt;
use irbkin::internal::check_length;

/// Pieces of the grid between two rests of a program, at least.
const PROGRAMMED_PIECES: usize = 48;

/// Largest step of a joint from row to row with which the tool keeps a speed [rad]: between the
/// rows of 3,400 random lines it was faster by 0.5 % at most.
const TOOL_STEP: f64 = 0.1;

/// The bounds that the pace along a path keeps.
///
/// ```
/// use irbkin_motion::trajectory::{Retiming, retime};
///
/// let whole = retime(&[0.0, 1.0, 2.0], &[1.0], &[2.0])?;
/// // From the middle on, at the speed that it has there.
/// let rest = Retiming { start_velocity: Some(&[1.0]), ..Retiming::within(&[1.0], &[2.0]) };
/// let rest = rest.along(&[1.0, 2.0])?;
/// assert!((2.0 * rest.duration() - whole.duration()).abs() < 1e-3);
/// # Ok::<(), irbkin_motion::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Retiming<'a> {
    /// Limits [rad/s], infinity for none.
    pub max_velocity: &'a [f64],
    /// Limits [rad/s^2], infinity for none.
    pub max_acceleration: &'a [f64],
    /// Limits [rad/s^3] of a motion from rest to rest, infinity for none; accelerations may jump if
    /// `None`.
    pub max_jerk: Option<&'a [f64]>,
    /// Velocities of the joints at the start [rad/s], in the direction of the path; rest if `None`.
    pub start_velocity: Option<&'a [f64]>,
    /// Velocities of the joints at the end, in the same way.
    pub end_velocity: Option<&'a [f64]>,
    /// The length of the tool's path up to each sample [m], and a speed that it does not exceed
    /// [m/s].
    pub tool: Option<(&'a [f64], f64)>,
}

impl<'a> Retiming<'a> {
    /// From rest to rest within limits of the joints.
    #[must_use]
    pub fn within(max_velocity: &'a [f64], max_acceleration: &'a [f64]) -> Self {
        Self {
            max_velocity,
            max_acceleration,
            max_jerk: None,
            start_velocity: None,
            end_velocity: None,
            tool: None,
        }
    }

    /// The fastest trajectory along samples of a path, rows of as many numbers as there are limits.
    ///
    /// # Errors
    ///
    /// As [`retime`] and [`retime_tool`]; [`Error::InvalidMotion`] too for a velocity at an end that
    /// is not in the direction of the path, or that the limits do not allow.
    pub fn along(&self, q: &[f64]) -> Result<Trajectory, Error> {
        self.along_until(q, Interrupt::none())
    }

    /// As [`Self::along`], until it is interrupted.
    #[doc(hidden)]
    pub fn along_until(&self, q: &[f64], interrupt: Interrupt<'_>) -> Result<Trajectory, Error> {
        let Self { max_velocity, max_acceleration, .. } = *self;
        let dof = check_path_limits(max_velocity, max_acceleration)?;
        self.check_jerk(dof)?;
        let (knots, spline, most) = match self.tool {
            None => {
                let (knots, points) = polygon(q, dof)?;
                let is_still = knots.len() == 1;
                let spline =
                    if is_still { vec![] } else { cubic(&knots, &points, dof, Ends::NotAKnot) };
                (knots, spline, f64::INFINITY)
            }
            Some((lengths, speed)) => {
                check_positive("max_tool_speed", speed)?;
                let path = ToolPath::new(q, lengths, max_velocity, max_acceleration)?;
                check_steps(q, dof)?;
                (path.knots, path.terms, speed * speed)
            }
        };
        let ends = self.paces_of_ends(&knots, &spline)?;
        if spline.is_empty() {
            return Ok(Trajectory::still(&q[..dof]));
        }
        let grid = Grid::fine(&knots, &spline, dof, interrupt)?;
        drop(spline);
        let limits = PaceLimits { max_velocity, max_acceleration, ends };
        let timed = match self.max_jerk {
            None => grid.paced(&limits, |_| most, interrupt)?,
            Some(max_jerk) => paced_with_jerk(&grid, &limits, max_jerk, most, interrupt)?,
        };
        check_duration(timed.duration()).and_then(|()| timed.checked())
    }

    /// Check limits of jerk, which are for a motion from rest to rest.
    fn check_jerk(&self, dof: usize) -> Result<(), Error> {
        let Some(max_jerk) = self.max_jerk else { return Ok(()) };
        check_limits("max_jerk", max_jerk)?;
        check_length("max_jerk", max_jerk.len(), dof)?;
        for (field, velocity) in
            [("start_velocity", self.start_velocity), ("end_velocity", self.end_velocity)]
        {
            if velocity.is_some_and(|velocity| velocity.iter().any(|rate| *rate != 0.0)) {
                return Err(MotionFault::JerkAtEnd { field }.into());
            }
        }
        Ok(())
    }

    /// The squares of ds/dt at both ends: the velocities there are q' ds/dt.
    fn paces_of_ends(&self, knots: &[f64], spline: &[[f64; TERMS]]) -> Result<[f64; 2], Error> {
        let dof = self.max_velocity.len();
        let mut paces = [0.0; 2];
        for (pace, (field, velocity, is_end)) in paces.iter_mut().zip([
            ("start_velocity", self.start_velocity, false),
            ("end_velocity", self.end_velocity, true),
        ]) {
            let Some(velocity) = velocity else { continue };
            check_length(field, velocity.len(), dof)?;
            check_finite(field, velocity)?;
            let first = if is_end { spline.len().saturating_sub(dof) } else { 0 };
            let since = if is_end && knots.len() > 1 {
                knots[knots.len() - 1] - knots[knots.len() - 2]
            } else {
                0.0
            };
            let slope = |joint: usize| {
                let [_, c1, c2, c3, ..] = spline.get(first + joint).copied().unwrap_or_default();
                c1 + since * (2.0 * c2 + since * 3.0 * c3)
            };
            let (mut along, mut square, mut size) = (0.0, 0.0, 0.0);
            for (joint, velocity) in velocity.iter().enumerate() {
                along += slope(joint) * velocity;
                square += slope(joint) * slope(joint);
                size += velocity * velocity;
            }
            let rate = if square > 0.0 { (along / square).max(0.0) } else { 0.0 };
            for (index, value) in velocity.iter().copied().enumerate() {
                let along = rate * slope(index);
                if (value - along).abs() > PATH_DIRECTION * size.sqrt() {
                    let joint = index + 1;
                    return Err(MotionFault::OffPath { field, joint, value, along }.into());
                }
            }
            *pace = rate * rate;
        }
        Ok(paces)
    }
}

/// The fastest trajectory along samples of a path, from rest to rest.
///
/// `q` has rows of as many numbers as `max_velocity` has [rad]; between them the path is a cubic
/// spline over the length of the polygon. Samples that repeat the one before them are left out.
/// Limits are positive, in rad/s and rad/s^2, infinity for none.
///
/// # Errors
///
/// [`Error::InvalidMotion`] for an angle that is not finite, a limit that is not positive, no rows
/// or no joints, a path that no limit binds, or a duration out of bounds; [`irbkin::Error::WrongLength`] for
/// slices that do not fit.
pub fn retime(
    q: &[f64],
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<Trajectory, Error> {
    Retiming::within(max_velocity, max_acceleration).along(q)
}

/// The fastest trajectory along samples of a path, from rest to rest, at which the tool is nowhere
/// faster than a speed [m/s]: where the other limits allow, it has that speed (eq. 30).
///
/// As [`retime`], but over the `lengths` of the tool's path up to each row [m], as
/// [`tool_lengths`](super::tool_lengths) gives them: the spline of
/// [`at_tool_speed`](super::at_tool_speed).
///
/// # Errors
///
/// As [`retime`]; [`Error::InvalidMotion`] too for a speed that is not positive, a length that is
/// not finite, joints that move where the tool does not, or a step of a joint above 0.1 rad,
/// between whose rows the tool would leave its path.
pub fn retime_tool(
    q: &[f64],
    lengths: &[f64],
    max_tool_speed: f64,
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<Trajectory, Error> {
    let tool = Some((lengths, max_tool_speed));
    Retiming { tool, ..Retiming::within(max_velocity, max_acceleration) }.along(q)
}

/// Check that no joint steps farther than the tool is known to stay on its path between two rows.
fn check_steps(q: &[f64], dof: usize) -> Result<(), Error> {
    for (row, ends) in q.windows(2 * dof).step_by(dof).enumerate() {
        for (joint, step) in (0..dof).map(|joint| (joint, ends[dof + joint] - ends[joint])) {
            if step.abs() > TOOL_STEP {
                let (joint, row, bound) = (joint + 1, row + 1, TOOL_STEP);
                return Err(MotionFault::ToolStep { joint, row, step, bound }.into());
            }
        }
    }
    Ok(())
}

/// Joints that go evenly from row to row [rad]. The times of the rows [s] begin at zero and do not
/// decrease; rows at one time are equal.
#[doc(hidden)]
pub fn evenly<const N: usize>(times: &[f64], rows: &[[f64; N]]) -> Trajectory {
    let mut terms = Vec::with_capacity(rows.len() * N);
    for (ends, rows) in times.windows(2).zip(rows.windows(2)) {
        let duration = ends[1] - ends[0];
        terms.extend((0..N).map(|joint| {
            let mut even = [0.0; TERMS];
            even[0] = rows[0][joint];
            if duration > 0.0 {
                even[1] = (rows[1][joint] - rows[0][joint]) / duration;
            }
            even
        }));
    }
    match rows {
        [only] => Trajectory::still(only),
        _ => Trajectory::new(N, times.to_vec(), terms),
    }
}

/// The fastest trajectory along rows of joints [rad] from rest to rest, with the time of each row
/// [s]. The path is a cubic spline as in `retime`, the limits hold in the same way (eq. 13 to 16),
/// and from each row to the next it takes `least` [s] or more (eq. 35).
#[doc(hidden)]
pub fn within_times<const N: usize>(
    rows: &[[f64; N]],
    least: &[f64],
    max_velocity: &[f64; N],
    max_acceleration: &[f64; N],
) -> Result<(Trajectory, Vec<f64>), Error> {
    // Rows that repeat the one before have its knot.
    let (mut lengths, mut points, mut knots) = (vec![0.0], rows[0].to_vec(), vec![0]);
    let mut caps = Vec::with_capacity(least.len());
    for (ends, least) in rows.windows(2).zip(least) {
        let way = ends[0].iter().zip(&ends[1]).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
        let before = lengths[lengths.len() - 1];
        if before + way > before {
            lengths.push(before + way);
            points.extend_from_slice(&ends[1]);
            caps.push((way / least) * (way / least));
        }
        knots.push(lengths.len() - 1);
    }
    if lengths.len() == 1 {
        return Ok((evenly(&[0.0], &rows[..1]), vec![0.0; rows.len()]));
    }
    let parts = PROGRAMMED_PIECES.div_ceil(lengths.len() - 1);
    let spline = cubic(&lengths, &points, N, Ends::NotAKnot);
    let grid = Grid::of(&lengths, &spline, N, |_| parts, Interrupt::none())?;
    let pace = PaceLimits { max_velocity, max_acceleration, ends: [0.0; 2] };
    let timed = grid.paced(&pace, |piece| caps[piece / parts], Interrupt::none())?.checked()?;
    let times = knots.iter().map(|knot| timed.knots()[knot * parts]).collect();
    Ok((timed, times))
}

/// The rows that differ from the one before, and the length of the polygon up to each.
fn polygon(q: &[f64], dof: usize) -> Result<(Vec<f64>, Vec<f64>), Error> {
    check_rows("q", q, dof)?;
    if !q.len().is_multiple_of(dof) {
        let (found, wanted) = (q.len(), dof);
        return Err(irbkin::Error::WrongLength { field: "q", found, wanted }.into());
    }
    if q.is_empty() {
        return Err(MotionFault::TooFew { field: "q", found: 0, least: 1 }.into());
    }
    let (mut lengths, mut points) = (vec![0.0], q[..dof].to_vec());
    for row in q.chunks_exact(dof).skip(1) {
        let last = &points[points.len() - dof..];
        let way: f64 = row.iter().zip(last).map(|(a, b)| (a - b) * (a - b)).sum();
        let length = lengths[lengths.len() - 1] + way.sqrt();
        if length > lengths[lengths.len() - 1] {
            lengths.push(length);
            points.extend_from_slice(row);
        }
    }
    Ok((lengths, points))
}
