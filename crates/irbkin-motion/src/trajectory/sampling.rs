//! Samples of a trajectory, the joints side by side in lanes.

use super::polynomial::TERMS;
use irbkin::internal::lanes::{Column, Kernel, LANES};

/// The polynomials of a trajectory, by piece and joint, sampled at times that are numbers.
pub(super) struct Samples<'a> {
    pub(super) dof: usize,
    pub(super) knots: &'a [f64],
    pub(super) terms: &'a [[f64; TERMS]],
    pub(super) times: &'a [f64],
    /// Joint angles, velocities and accelerations: a row of `dof` numbers a time.
    pub(super) rows: [&'a mut [f64]; 3],
}

impl Kernel for Samples<'_> {
    type Answer = ();
    const WIDE: bool = true;

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        // The last lanes first: what they write too much is written again by the first ones.
        for first in (0..self.dof).step_by(LANES).rev() {
            self.sample(first);
        }
    }
}

impl Samples<'_> {
    /// Samples the joints from `first` on, as many as there are lanes.
    #[inline(always)]
    fn sample(&mut self, first: usize) {
        let Self { dof, knots, terms, times, rows } = self;
        let count = (*dof - first).min(LANES);
        let (pieces, duration) = (knots.len() - 1, knots[knots.len() - 1]);
        let (mut piece, mut here) = (0, columns(&terms[first..][..count]));
        for (row, time) in times.iter().enumerate() {
            let inside = time.clamp(0.0, duration);
            // Times mostly come in order, a few to a piece; a knot belongs to the piece that
            // begins there.
            if !(knots[piece] <= inside && inside < knots[piece + 1]) {
                let next = knots[1..pieces].partition_point(|knot| *knot <= inside);
                if next != piece {
                    (piece, here) = (next, columns(&terms[next * *dof + first..][..count]));
                }
            }
            // At rest outside.
            let is_outside = *time < 0.0 || *time > duration;
            let moves = if is_outside { 0.0 } else { 1.0 };
            let sample = derivatives(&here, inside - knots[piece], moves);
            for (rows, numbers) in rows.iter_mut().zip(&sample) {
                let rest = &mut rows[row * *dof + first..];
                match rest.first_chunk_mut::<LANES>() {
                    // The next row begins before the end of this one, and is written later.
                    Some(lanes) => *lanes = *numbers,
                    None => rest[..count].copy_from_slice(&numbers[..count]),
                }
            }
        }
    }
}

/// The coefficients of up to [`LANES`] joints, a column for each power.
#[inline(always)]
fn columns(terms: &[[f64; TERMS]]) -> [Column; TERMS] {
    let mut columns = [[0.0; LANES]; TERMS];
    for (lane, terms) in terms.iter().enumerate() {
        for (column, term) in columns.iter_mut().zip(terms) {
            column[lane] = *term;
        }
    }
    columns
}

/// Value, first and second derivative of every lane, as
/// [`derivatives`](super::polynomial::derivatives) has them; the derivatives times `moves`.
#[inline(always)]
fn derivatives(columns: &[Column; TERMS], t: f64, moves: f64) -> [Column; 3] {
    let mut derivatives = [[0.0; LANES]; 3];
    for lane in 0..LANES {
        let [mut value, mut first, mut second] = [0.0; 3];
        for power in (0..TERMS).rev() {
            second = second * t + first;
            first = first * t + value;
            value = value * t + columns[power][lane];
        }
        derivatives[0][lane] = value;
        derivatives[1][lane] = moves * first;
        derivatives[2][lane] = moves * (2.0 * second);
    }
    derivatives
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;
    use crate::rng::Rng;
    use crate::sets::on_each_set;
    use crate::trajectory::Trajectory;
    use crate::trajectory::polynomial::derivatives;

    /// A row of joint angles, velocities and accelerations, number by number.
    fn alone(knots: &[f64], terms: &[[f64; TERMS]], time: f64) -> [Vec<f64>; 3] {
        let (pieces, end) = (knots.len() - 1, knots[knots.len() - 1]);
        let dof = terms.len() / pieces;
        let inside = time.clamp(0.0, end);
        let piece = (1..pieces).rev().find(|piece| knots[*piece] <= inside).unwrap_or(0);
        let moves = if (0.0..=end).contains(&time) { 1.0 } else { 0.0 };
        let states = terms[piece * dof..][..dof].iter().map(|terms| {
            let [value, first, second, _] = derivatives(terms, inside - knots[piece]);
            [value, moves * first, moves * second]
        });
        let states: Vec<[f64; 3]> = states.collect();
        [0, 1, 2].map(|which| states.iter().map(|state| state[which]).collect())
    }

    #[test]
    #[ignore = "run by itself: cargo test --lib -- --ignored"]
    fn samples_are_those_of_each_number_alone_to_the_bit() {
        on_each_set(|set| {
            let mut rng = Rng::new(3);
            for (dof, pieces) in [(1, 1), (2, 5), (6, 1), (6, 40), (7, 3), (8, 4), (9, 2), (19, 6)]
            {
                let mut knots = std::vec![0.0];
                (0..pieces).for_each(|piece| knots.push(knots[piece] + rng.between(0.1, 2.0)));
                let mut term = || core::array::from_fn(|_| rng.between(-2.0, 2.0));
                let terms: Vec<[f64; TERMS]> = (0..pieces * dof).map(|_| term()).collect();
                let end = knots[pieces];
                let mut times: Vec<f64> = (0..57).map(|_| rng.between(-0.5, end + 0.5)).collect();
                times.extend((0..100).map(|step| f64::from(step) / 99.0 * end));
                times.extend_from_slice(&knots);
                let motion = Trajectory::new(dof, knots.clone(), terms.clone());
                let mut rows = [(); 3].map(|()| std::vec![7.0; times.len() * dof]);
                let [q, dq, ddq] = &mut rows;
                motion.sample(&times, q, dq, ddq).unwrap();
                for (row, time) in times.iter().enumerate() {
                    let alone = alone(&knots, &terms, *time);
                    for (rows, alone) in rows.iter().zip(&alone) {
                        let bits = |numbers: &[f64]| -> Vec<u64> {
                            numbers.iter().map(|number| number.to_bits()).collect()
                        };
                        let row = &rows[row * dof..][..dof];
                        assert_eq!(bits(row), bits(alone), "{}: {dof} at {time}", set.name());
                    }
                }
            }
        });
    }
}
