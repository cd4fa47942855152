//! A polyline of joints with rounded corners, and the fastest motion along it: what is straight
//! stays straight.

use core::array;

use super::grid::{Grid, PaceLimits};
use super::piecewise::Trajectory;
use super::polynomial::TERMS;
use crate::error::Error;
use crate::prelude::*;
use irbkin::Interrupt;

/// Pieces of the grid on a side or a corner: the motion takes 2 % longer than the shortest.
const PARTS: usize = 24;

/// The polyline through waypoints [rad] over its length, with a parabola from `cuts[i]` before
/// waypoint i + 1 to as much behind it: inside the triangle of its ends and the waypoint, in the
/// direction of the sides at both ends. The pieces are the sides with the corners between them.
/// Between neighboring waypoints more is left than zero.
pub(crate) fn rounded<const N: usize>(waypoints: &[[f64; N]], cuts: &[f64]) -> Trajectory {
    let (mut knots, mut terms) = (vec![0.0], Vec::with_capacity((2 * waypoints.len() - 3) * N));
    let cut = |corner: usize| corner.checked_sub(1).and_then(|at| cuts.get(at)).map_or(0.0, |c| *c);
    let mut before: Option<[f64; N]> = None;
    for (side, ends) in waypoints.windows(2).enumerate() {
        let length = distance(&ends[0], &ends[1]);
        let way: [f64; N] = array::from_fn(|joint| (ends[1][joint] - ends[0][joint]) / length);
        let own = cut(side);
        if let Some(before) = before {
            terms.extend((0..N).map(|joint| {
                let first = ends[0][joint] - own * before[joint];
                piece([first, before[joint], (way[joint] - before[joint]) / (4.0 * own)])
            }));
            knots.push(knots[knots.len() - 1] + 2.0 * own);
        }
        terms.extend(
            (0..N).map(|joint| piece([ends[0][joint] + own * way[joint], way[joint], 0.0])),
        );
        knots.push(knots[knots.len() - 1] + length - own - cut(side + 1));
        before = Some(way);
    }
    Trajectory::new(N, knots, terms)
}

fn piece([c0, c1, c2]: [f64; 3]) -> [f64; TERMS] {
    [c0, c1, c2, 0.0, 0.0, 0.0, 0.0]
}

/// The distance between two joint vectors [rad].
pub(crate) fn distance<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The fastest motion from rest to rest along a polyline of [`rounded`], within velocities [rad/s]
/// and accelerations [rad/s^2].
pub(crate) fn paced(
    path: &Trajectory,
    max_velocity: &[f64],
    max_acceleration: &[f64],
) -> Result<Trajectory, Error> {
    let grid = Grid::of(path.knots(), &path.terms, path.dof(), |_| PARTS, Interrupt::none())?;
    let limits = PaceLimits { max_velocity, max_acceleration, ends: [0.0; 2] };
    grid.paced(&limits, |_| f64::INFINITY, Interrupt::none())?.checked()
}
