//! Constant speed of the tool along a path, and which joint limits it.
//!
//! A path q(s) of the joints is a cubic spline over the length s of the tool's path. At a constant
//! tool speed v, dq/dt = q'(s) v and d2q/dt2 = q''(s) v^2 (eq. 28, 29).

use super::check::{check_duration, check_finite, check_path_limits, check_positive, check_rows};
use super::piece::Piece;
use super::piecewise::Trajectory;
use super::polynomial::TERMS;
use crate::error::{Error, MotionFault};
use crate::paths::thresholds::LEAST_WAY;
use crate::prelude::*;
use crate::spline::{Ends, cubic};
use crate::trajectory::thresholds::{JOINED_POSITION, LIMIT_ROUNDING};
use irbkin::Pose;
use irbkin::internal::check_length;

/// Limits of the speed of the tool along a path, by the limits of the joints.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ToolSpeedLimits {
    /// The highest tool speed at each row [m/s], infinite where no limit binds.
    pub speed: Vec<f64>,
    /// The joint that limits it, from 1; 0 where none does.
    pub joint: Vec<usize>,
    /// The fastest constant speed on the whole path [m/s], between the rows too.
    pub fastest: f64,
    /// The joint that limits that, from 1; 0 where none does.
    pub fastest_joint: usize,
    /// The row at which it does, or the last one before the place.
    pub fastest_row: usize,
}

/// The length of the tool's path up to each pose [m]: a polygon's.
#[must_use]
pub fn tool_lengths(poses: &[Pose]) -> Vec<f64> {
    let mut length = 0.0;
    let mut last = poses.first();
    let of = |pose| {
        if let Some(last) = last.replace(pose) {
            length += (pose.translation.vector - last.translation.vector).norm();
        }
        length
    };
    poses.iter().map(of).collect()
}

/// The highest speed of the tool at each row of a path of joints, and the fastest constant one.
///
/// `q` has rows of as many numbers as `max_velocity` has [rad], `lengths` the length of the tool's
/// path up to each row [m], as [`tool_lengths`] gives it. Between the rows the joints are a cubic
/// spline over that length. Limits are positive, in rad/s and rad/s^2, infinity for none.
///
/// # Errors
///
/// [`Error::InvalidMotion`] for an angle or a length that is not finite, a limit that is not
/// positive, no rows, no joints, or joints that move where the tool stays within 1e-9 m of
/// its place; [`irbkin::Error::WrongLength`] for slices that do not fit.
pub fn tool_speed_limits(
    q: &[f64],
    lengths: &[f64],
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<ToolSpeedLimits, Error> {
    let path = ToolPath::new(q, lengths, max_velocity, max_acceleration)?;
    Ok(path.limits(max_velocity, max_acceleration))
}

/// The trajectory at a constant speed of the tool [m/s], moving at both ends.
///
/// The other arguments are as in [`tool_speed_limits`].
///
/// # Errors
///
/// As [`tool_speed_limits`]; [`Error::InvalidMotion`] too for a speed that is not positive, that a
/// joint does not allow, or a duration out of bounds.
pub fn at_tool_speed(
    q: &[f64],
    lengths: &[f64],
    speed: f64,
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<Trajectory, Error> {
    check_positive("speed", speed)?;
    let path = ToolPath::new(q, lengths, max_velocity, max_acceleration)?;
    let limits = path.limits(max_velocity, max_acceleration);
    if speed > limits.fastest * (1.0 + LIMIT_ROUNDING) {
        let (joint, row, most) = (limits.fastest_joint, limits.fastest_row, limits.fastest);
        return Err(MotionFault::ToolSpeed { joint, row, most, asked: speed }.into());
    }
    if path.terms.is_empty() {
        return Ok(Trajectory::still(&q[..path.dof]));
    }
    let powers = [1.0, speed, speed * speed, speed * speed * speed];
    let terms = path.terms.iter().map(|terms| {
        let mut timed = [0.0; TERMS];
        for (timed, (term, power)) in timed.iter_mut().zip(terms.iter().zip(powers)) {
            *timed = term * power;
        }
        timed
    });
    let knots = path.knots.iter().map(|knot| knot / speed).collect();
    let motion = Trajectory::new(path.dof, knots, terms.collect());
    check_duration(motion.duration()).and_then(|()| motion.checked())
}

/// A path of joints over the length of the tool's path.
pub(super) struct ToolPath {
    dof: usize,
    /// Lengths at which the pieces begin, from 0, and the end [m].
    pub(super) knots: Vec<f64>,
    /// The spline, by piece and joint.
    pub(super) terms: Vec<[f64; TERMS]>,
    /// Which knot each row is at, and the first row of each knot.
    knot_of: Vec<usize>,
    row_of: Vec<usize>,
}

impl ToolPath {
    pub(super) fn new(
        q: &[f64],
        lengths: &[f64],
        max_velocity: &[f64],
        max_acceleration: &[f64],
    ) -> Result<Self, Error> {
        let dof = check_path_limits(max_velocity, max_acceleration)?;
        check_rows("q", q, dof)?;
        check_finite("lengths", lengths)?;
        let wanted = dof * lengths.len();
        check_length("q", q.len(), wanted)?;
        if q.is_empty() {
            return Err(MotionFault::TooFew { field: "q", found: 0, least: 1 }.into());
        }
        let mut path =
            Self { dof, knots: vec![0.0], terms: Vec::new(), knot_of: vec![0], row_of: vec![0] };
        let mut points = q[..dof].to_vec();
        for (row, (length, angles)) in lengths.iter().zip(q.chunks_exact(dof)).enumerate().skip(1) {
            let knot = path.knots.len() - 1;
            let way = length - lengths[0] - path.knots[knot];
            if way >= LEAST_WAY {
                path.knots.push(length - lengths[0]);
                path.row_of.push(row);
                points.extend_from_slice(angles);
            } else if way < 0.0 || !is_same(&points[knot * dof..], angles) {
                return Err(MotionFault::ToolStill { row, way, bound: LEAST_WAY }.into());
            }
            path.knot_of.push(path.knots.len() - 1);
        }
        if path.knots.len() > 1 {
            path.terms = cubic(&path.knots, &points, dof, Ends::NotAKnot);
        }
        Ok(path)
    }

    fn piece(&self, index: usize) -> Piece<'_> {
        let terms = &self.terms[index * self.dof..][..self.dof];
        Piece { length: self.knots[index + 1] - self.knots[index], terms }
    }

    /// The highest speeds at the rows, from which the acceleration follows everywhere, for q'' is
    /// linear on each piece; and the velocities between (eq. 28, 29).
    fn limits(&self, max_velocity: &[f64], max_acceleration: &[f64]) -> ToolSpeedLimits {
        let joints = || max_velocity.iter().zip(max_acceleration).enumerate();
        let pieces = self.knots.len() - 1;
        let mut at_knots = Vec::with_capacity(self.knots.len());
        for knot in 0..self.knots.len() {
            let mut most = Most::NONE;
            // A path of one knot has no piece.
            let piece = (pieces > 0).then(|| self.piece(knot.min(pieces - 1)));
            for (joint, (velocity, acceleration)) in joints() {
                let [slope, bend] = piece.as_ref().map_or([0.0; 2], |piece| {
                    piece.slope_and_bend(joint, if knot < pieces { 0.0 } else { piece.length })
                });
                most.lower(velocity / slope.abs(), joint);
                most.lower((acceleration / bend.abs()).sqrt(), joint);
            }
            at_knots.push(most);
        }
        let (mut fastest, mut fastest_row) = (Most::NONE, 0);
        for (knot, most) in at_knots.iter().enumerate() {
            let mut own = *most;
            if knot < pieces {
                let piece = self.piece(knot);
                for (joint, (velocity, _)) in joints() {
                    own.lower(velocity / piece.steepest(joint), joint);
                }
            }
            if own.speed < fastest.speed {
                (fastest, fastest_row) = (own, self.row_of[knot]);
            }
        }
        let rows = || self.knot_of.iter().map(|knot| &at_knots[*knot]);
        ToolSpeedLimits {
            speed: rows().map(|most| most.speed).collect(),
            joint: rows().map(|most| most.joint).collect(),
            fastest: fastest.speed,
            fastest_joint: fastest.joint,
            fastest_row,
        }
    }
}

/// Whether a row repeats the one before it.
fn is_same(before: &[f64], angles: &[f64]) -> bool {
    before.iter().zip(angles).all(|(before, angle)| (angle - before).abs() <= JOINED_POSITION)
}

/// A speed and the joint that limits it, from 1.
#[derive(Clone, Copy)]
struct Most {
    speed: f64,
    joint: usize,
}

impl Most {
    const NONE: Self = Self { speed: f64::INFINITY, joint: 0 };

    /// Lower it to the limit of a joint, from 0; a joint that does not move has no limit.
    fn lower(&mut self, speed: f64, joint: usize) {
        if speed < self.speed {
            *self = Self { speed, joint: joint + 1 };
        }
    }
}
