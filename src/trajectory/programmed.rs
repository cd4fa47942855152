//! Trajectories along rows of joints whose times a program gives.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use alloc::vec;
use alloc::vec::Vec;

use super::piecewise::Trajectory;
use super::polynomial::TERMS;
use super::retime::Grid;
use super::spline::cubic;
use crate::error::Error;
use crate::spline::Ends;

/// Pieces of the grid between two rests, at least.
const LEAST_PIECES: usize = 48;

/// Joints that go evenly from row to row [rad]. The times of the rows [s] begin at zero and do not
/// decrease; rows at one time are equal.
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
    let parts = LEAST_PIECES.div_ceil(lengths.len() - 1);
    let spline = cubic(&lengths, &points, N, Ends::NotAKnot);
    let grid = Grid::of(&lengths, &spline, N, |_, _| parts);
    let timed =
        grid.paced(max_velocity, max_acceleration, |piece| caps[piece / parts])?.checked()?;
    let times = knots.iter().map(|knot| timed.knots()[knot * parts]).collect();
    Ok((timed, times))
}
