//! The fastest pace along a path of joints within limits of velocity and acceleration.
//!
//! A path q(s) is a cubic spline. Its pace is x = (ds/dt)^2, linear in s on each piece of a grid,
//! so d2s/dt2 is constant there and q is a polynomial in time. The acceleration of a joint on a
//! piece is then a polynomial of degree two in s whose Bernstein coefficients are linear in the
//! paces at both ends: where these keep to the limit, all of the piece does (eq. 13 to 16).
//! From the end backwards the largest pace is found from which the rest of the path can be done;
//! from the start forwards the largest pace is taken that stays below it (Pham and Pham, "A new
//! approach to time-optimal path parameterization based on reachability analysis", 2018; there the
//! limits hold at the points of the grid alone).

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use alloc::vec;
use alloc::vec::Vec;

use super::check::{check_duration, check_path_limits, check_rows};
use super::piece::{Piece, Strips};
use super::piecewise::Trajectory;
use super::polynomial::{TERMS, shifted};
use super::tool_speed::{ToolPath, check_speed};
use crate::error::{Error, MotionFault};
use crate::spline::{Ends, cubic};

/// Pieces of the grid, at least: a path of few waypoints is cut finer.
const LEAST_PIECES: usize = 1000;

/// Pieces of the grid between two rests of a program, at least.
#[cfg(feature = "rapid")]
const PROGRAMMED_PIECES: usize = 48;

/// Angle by which the path's direction in joint space may turn on a piece of the grid [rad]: the
/// motion of a path through random waypoints takes 1 % longer than the shortest.
const PIECE_TURN: f64 = 0.04;

/// Most pieces between two samples: memory is linear in the samples.
const MOST_PARTS: f64 = 100.0;

/// The fastest trajectory along samples of a path, from rest to rest.
///
/// `q` has rows of as many numbers as `max_velocity` has [rad]; between them the path is a cubic
/// spline over the length of the polygon. Samples that repeat the one before them are left out.
/// Limits are positive, in rad/s and rad/s^2, infinity for none.
///
/// # Errors
///
/// [`Error::InvalidMotion`] for an angle that is not finite, a limit that is not positive, no rows
/// or no joints, a path that no limit binds, or a duration out of bounds; [`Error::WrongLength`] for
/// slices that do not fit.
pub fn retime(
    q: &[f64],
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<Trajectory, Error> {
    let dof = check_path_limits(max_velocity, max_acceleration)?;
    let (lengths, points) = polygon(q, dof)?;
    if lengths.len() == 1 {
        return Ok(Trajectory::still(&points));
    }
    let spline = cubic(&lengths, &points, dof, Ends::NotAKnot);
    Grid::fine(&lengths, &spline, dof).retimed(max_velocity, max_acceleration, f64::INFINITY)
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
/// not finite, or joints that move where the tool does not.
pub fn retime_tool(
    q: &[f64],
    lengths: &[f64],
    max_tool_speed: f64,
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<Trajectory, Error> {
    check_speed("max_tool_speed", max_tool_speed)?;
    let path = ToolPath::new(q, lengths, max_velocity, max_acceleration)?;
    let dof = max_velocity.len();
    if path.terms.is_empty() {
        return Ok(Trajectory::still(&q[..dof]));
    }
    let most = max_tool_speed * max_tool_speed;
    Grid::fine(&path.knots, &path.terms, dof).retimed(max_velocity, max_acceleration, most)
}

/// Joints that go evenly from row to row [rad]. The times of the rows [s] begin at zero and do not
/// decrease; rows at one time are equal.
#[cfg(feature = "rapid")]
pub(crate) fn evenly<const N: usize>(times: &[f64], rows: &[[f64; N]]) -> Trajectory {
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
#[cfg(feature = "rapid")]
pub(crate) fn within_times<const N: usize>(
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
    let grid = Grid::of(&lengths, &spline, N, |_, _| parts);
    let timed =
        grid.paced(max_velocity, max_acceleration, |piece| caps[piece / parts])?.checked()?;
    let times = knots.iter().map(|knot| timed.knots()[knot * parts]).collect();
    Ok((timed, times))
}

/// The rows that differ from the one before, and the length of the polygon up to each.
fn polygon(q: &[f64], dof: usize) -> Result<(Vec<f64>, Vec<f64>), Error> {
    check_rows("q", q, dof)?;
    if !q.len().is_multiple_of(dof) {
        return Err(Error::WrongLength { field: "q", found: q.len(), wanted: dof });
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

/// The spline, cut into pieces that are short enough.
struct Grid {
    dof: usize,
    lengths: Vec<f64>,
    /// By piece and joint.
    terms: Vec<[f64; TERMS]>,
}

impl Grid {
    /// Pieces on which the direction of the path turns little, [`LEAST_PIECES`] or more.
    fn fine(knots: &[f64], spline: &[[f64; TERMS]], dof: usize) -> Self {
        let least = (LEAST_PIECES / (knots.len() - 1)).max(1);
        Self::of(knots, spline, dof, |terms, length| least.max(parts_of_turn(terms, length)))
    }

    /// Each piece of a spline, cut into as many parts as `parts` says of its terms and length.
    fn of(
        knots: &[f64],
        spline: &[[f64; TERMS]],
        dof: usize,
        parts: impl Fn(&[[f64; TERMS]], f64) -> usize,
    ) -> Self {
        let mut grid = Self { dof, lengths: Vec::new(), terms: Vec::new() };
        for (piece, ends) in knots.windows(2).enumerate() {
            let terms = &spline[piece * dof..][..dof];
            let parts = parts(terms, ends[1] - ends[0]);
            let mut begin = 0.0;
            for part in 1..=parts {
                #[expect(clippy::cast_precision_loss, reason = "counts of parts are small")]
                let end = (ends[1] - ends[0]) * (part as f64 / parts as f64);
                grid.lengths.push(end - begin);
                grid.terms.extend(terms.iter().map(|terms| shifted(terms, begin)));
                begin = end;
            }
        }
        grid
    }

    /// The path at the largest paces within limits, of which none is above `most`.
    fn retimed(
        &self,
        max_velocity: &[f64],
        max_acceleration: &[f64],
        most: f64,
    ) -> Result<Trajectory, Error> {
        let timed = self.paced(max_velocity, max_acceleration, |_| most)?;
        check_duration(timed.duration()).and_then(|()| timed.checked())
    }

    /// The path at the largest paces within limits, of which none exceeds the cap of its piece.
    fn paced(
        &self,
        max_velocity: &[f64],
        max_acceleration: &[f64],
        cap: impl Fn(usize) -> f64,
    ) -> Result<Trajectory, Error> {
        let pieces: Vec<Piece<'_>> =
            (0..self.lengths.len()).map(|index| self.piece(index)).collect();
        Ok(self.timed(&paces(&pieces, max_velocity, max_acceleration, cap)?))
    }

    fn piece(&self, index: usize) -> Piece<'_> {
        Piece { length: self.lengths[index], terms: &self.terms[index * self.dof..][..self.dof] }
    }

    /// The path at these paces: s = sqrt(x) t + (dx/ds) t^2 / 4 on each piece, put into its cubic.
    fn timed(&self, paces: &[f64]) -> Trajectory {
        let mut knots = Vec::with_capacity(paces.len());
        knots.push(0.0);
        let mut terms = Vec::with_capacity(self.terms.len());
        for (index, length) in self.lengths.iter().enumerate() {
            let (before, after) = (paces[index].sqrt(), paces[index + 1].sqrt());
            let (a, b) = (before, (paces[index + 1] - paces[index]) / (4.0 * length));
            knots.push(knots[index] + 2.0 * length / (before + after));
            terms.extend(self.piece(index).terms.iter().map(|[c0, c1, c2, c3, ..]| {
                [
                    *c0,
                    c1 * a,
                    c1 * b + c2 * a * a,
                    2.0 * c2 * a * b + c3 * a * a * a,
                    c2 * b * b + 3.0 * c3 * a * a * b,
                    3.0 * c3 * a * b * b,
                    c3 * b * b * b,
                ]
            }));
        }
        Trajectory::new(self.dof, knots, terms)
    }
}

/// The number of parts of a cubic piece that turn by [`PIECE_TURN`] at most, from 0 to
/// [`MOST_PARTS`].
///
/// A path turns by less than the integral of the size of q'' by the size of q'. Both are taken as the
/// means of their ends.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to MOST_PARTS")]
fn parts_of_turn(terms: &[[f64; TERMS]], length: f64) -> usize {
    let ends = [0.0, length].map(|s| {
        let (mut slope, mut bend) = (0.0, 0.0);
        for [_, c1, c2, c3, ..] in terms {
            slope += (c1 + s * (2.0 * c2 + s * 3.0 * c3)).powi(2);
            bend += (2.0 * c2 + 6.0 * c3 * s).powi(2);
        }
        [slope.sqrt(), bend.sqrt()]
    });
    let [[slope, bend], [slope_after, bend_after]] = ends;
    let turn = length * (bend + bend_after) / (slope + slope_after);
    (turn / PIECE_TURN).ceil().min(MOST_PARTS) as usize
}

/// The largest paces at the points of the grid, from rest to rest; no piece exceeds its cap.
fn paces(
    pieces: &[Piece<'_>],
    max_velocity: &[f64],
    max_acceleration: &[f64],
    cap: impl Fn(usize) -> f64,
) -> Result<Vec<f64>, Error> {
    let last = pieces.len();
    let mut bounds = vec![f64::INFINITY; last + 1];
    for (index, piece) in pieces.iter().enumerate() {
        let bound = piece.pace_bound(max_velocity).min(cap(index));
        bounds[index] = bounds[index].min(bound);
        bounds[index + 1] = bounds[index + 1].min(bound);
    }
    (bounds[0], bounds[last]) = (0.0, 0.0);
    let strips: Vec<Strips> =
        pieces.iter().map(|piece| Strips::of(piece, max_acceleration)).collect();
    for index in (1..last).rev() {
        bounds[index] = strips[index].most_before(bounds[index], bounds[index + 1]);
    }
    for index in 1..last {
        bounds[index] = strips[index - 1].most_after(bounds[index - 1], bounds[index]);
        if !bounds[index].is_finite() {
            return Err(MotionFault::NoDuration { joint: pieces[index].first_moving() }.into());
        }
    }
    Ok(bounds)
}
