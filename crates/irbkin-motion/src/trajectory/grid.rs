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

use super::piece::{Piece, Strips};
use super::piecewise::Trajectory;
use super::polynomial::{TERMS, shifted};
use crate::error::{Error, MotionFault};
use crate::paths::line::part;
use crate::prelude::*;
use crate::trajectory::thresholds::LIMIT_ROUNDING;
use irbkin::Interrupt;

/// Pieces of the grid, at least: a path of few waypoints is cut finer.
const LEAST_PIECES: usize = 1000;

/// Angle by which the path's direction in joint space may turn on a piece of the grid [rad]: the
/// motion of a path through random waypoints takes 1 % longer than the shortest.
const PIECE_TURN: f64 = 0.04;

/// Most pieces between two samples.
const MOST_PARTS: f64 = 100.0;

/// Pieces that a path may have for [`PIECE_TURN`] [1]; they fill 20 MB.
const MOST_PIECES: f64 = 30_000.0;

/// Pieces between two samples, on average, that a longer path may have for it [1]: with 360 bytes a
/// piece of six joints its memory stays below 2 kB a sample.
const LONG_PARTS: f64 = 3.0;

/// Limits of a pace, and its values at both ends.
pub(super) struct PaceLimits<'a> {
    pub(super) max_velocity: &'a [f64],
    pub(super) max_acceleration: &'a [f64],
    pub(super) ends: [f64; 2],
}

/// The spline, cut into pieces that are short enough.
pub(super) struct Grid {
    pub(super) dof: usize,
    pub(super) lengths: Vec<f64>,
    /// By piece and joint.
    pub(super) terms: Vec<[f64; TERMS]>,
}

impl Grid {
    /// Pieces on which the direction of the path turns little, [`LEAST_PIECES`] or more.
    pub(super) fn fine(
        knots: &[f64],
        spline: &[[f64; TERMS]],
        dof: usize,
        interrupt: Interrupt<'_>,
    ) -> Result<Self, Error> {
        let turns = knots
            .windows(2)
            .zip(spline.chunks_exact(dof))
            .map(|(ends, terms)| (turn(terms, ends[1] - ends[0]) / PIECE_TURN).min(MOST_PARTS));
        let turns: Vec<f64> = turns.collect();
        let pieces = turns.len();
        let least = (LEAST_PIECES / pieces).max(1);
        #[expect(clippy::cast_precision_loss, reason = "counts of samples are small")]
        let most = (LONG_PARTS * pieces as f64).max(MOST_PIECES);
        let coarser = (turns.iter().sum::<f64>() / most).max(1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "to MOST_PARTS"
        )]
        let parts = |piece: usize| least.max((turns[piece] / coarser).ceil() as usize);
        Self::of(knots, spline, dof, parts, interrupt)
    }

    /// Each piece of a spline, cut into as many parts as `parts` says.
    pub(super) fn of(
        knots: &[f64],
        spline: &[[f64; TERMS]],
        dof: usize,
        parts: impl Fn(usize) -> usize,
        interrupt: Interrupt<'_>,
    ) -> Result<Self, Error> {
        let count = (0..knots.len() - 1).map(&parts).sum();
        let (mut lengths, mut grid) = (Vec::with_capacity(count), Vec::with_capacity(count * dof));
        for (piece, ends) in knots.windows(2).enumerate() {
            interrupt.check(piece)?;
            let terms = &spline[piece * dof..][..dof];
            let parts = parts(piece);
            let mut begin = 0.0;
            for number in 1..=parts {
                let end = (ends[1] - ends[0]) * part(number, parts);
                lengths.push(end - begin);
                grid.extend(terms.iter().map(|terms| shifted(terms, begin)));
                begin = end;
            }
        }
        Ok(Self { dof, lengths, terms: grid })
    }

    fn piece(&self, index: usize) -> Piece<'_> {
        Piece { length: self.lengths[index], terms: &self.terms[index * self.dof..][..self.dof] }
    }

    /// The path at the largest paces within limits, of which none exceeds the cap of its piece.
    pub(super) fn paced(
        self,
        limits: &PaceLimits<'_>,
        cap: impl Fn(usize) -> f64,
        interrupt: Interrupt<'_>,
    ) -> Result<Trajectory, Error> {
        let paces = self.paces(limits, cap, interrupt)?;
        Ok(self.timed(&paces))
    }

    /// The largest paces at the points of the grid; no piece exceeds its cap.
    pub(super) fn paces(
        &self,
        limits: &PaceLimits<'_>,
        cap: impl Fn(usize) -> f64,
        interrupt: Interrupt<'_>,
    ) -> Result<Vec<f64>, Error> {
        let [start, end] = limits.ends;
        let last = self.lengths.len();
        let mut bounds = vec![f64::INFINITY; last + 1];
        for index in 0..last {
            interrupt.check(index)?;
            let bound = self.piece(index).pace_bound(limits.max_velocity).min(cap(index));
            bounds[index] = bounds[index].min(bound);
            bounds[index + 1] = bounds[index + 1].min(bound);
        }
        bounds[last] = end_pace("end_velocity", end, bounds[last])?;
        let mut strips = Strips::default();
        for index in (0..last).rev() {
            interrupt.check(index)?;
            strips.set(&self.piece(index), limits.max_acceleration);
            bounds[index] = strips.most_before(bounds[index], bounds[index + 1]);
        }
        bounds[0] = end_pace("start_velocity", start, bounds[0])?;
        for index in 1..=last {
            interrupt.check(index)?;
            strips.set(&self.piece(index - 1), limits.max_acceleration);
            bounds[index] = strips.most_after(bounds[index - 1], bounds[index]);
            if !bounds[index].is_finite() {
                let joint = self.piece(index.min(last - 1)).first_moving();
                return Err(MotionFault::NoDuration { joint }.into());
            }
        }
        bounds[last] = end_pace("end_velocity", end, bounds[last])?;
        Ok(bounds)
    }

    /// The path at these paces: s = sqrt(x) t + (dx/ds) t^2 / 4 on each piece, put into its cubic.
    /// A piece takes the place of its own.
    fn timed(mut self, paces: &[f64]) -> Trajectory {
        let mut knots = Vec::with_capacity(paces.len());
        knots.push(0.0);
        let pieces = self.lengths.iter().zip(self.terms.chunks_exact_mut(self.dof));
        for (index, (length, terms)) in pieces.enumerate() {
            let (before, after) = (paces[index].sqrt(), paces[index + 1].sqrt());
            let (a, b) = (before, (paces[index + 1] - paces[index]) / (4.0 * length));
            knots.push(knots[index] + 2.0 * length / (before + after));
            for terms in terms {
                let [c0, c1, c2, c3, ..] = *terms;
                *terms = [
                    c0,
                    c1 * a,
                    c1 * b + c2 * a * a,
                    2.0 * c2 * a * b + c3 * a * a * a,
                    c2 * b * b + 3.0 * c3 * a * a * b,
                    3.0 * c3 * a * b * b,
                    c3 * b * b * b,
                ];
            }
        }
        Trajectory::new(self.dof, knots, self.terms)
    }
}

/// The pace at an end, of which at most `bound` is possible.
fn end_pace(field: &'static str, pace: f64, bound: f64) -> Result<f64, MotionFault> {
    let part = (bound / pace).sqrt();
    if pace > 0.0 && part < 1.0 - LIMIT_ROUNDING {
        return Err(MotionFault::EndTooFast { field, part });
    }
    Ok(pace.min(bound))
}

/// The angle by which a cubic piece turns.
///
/// A path turns by less than the integral of the size of q'' by the size of q'. Both are taken as the
/// means of their ends.
fn turn(terms: &[[f64; TERMS]], length: f64) -> f64 {
    let ends = [0.0, length].map(|s| {
        let (mut slope, mut bend) = (0.0, 0.0);
        for [_, c1, c2, c3, ..] in terms {
            slope += (c1 + s * (2.0 * c2 + s * 3.0 * c3)).powi(2);
            bend += (2.0 * c2 + 6.0 * c3 * s).powi(2);
        }
        [slope.sqrt(), bend.sqrt()]
    });
    let [[slope, bend], [slope_after, bend_after]] = ends;
    length * (bend + bend_after) / (slope + slope_after)
}
