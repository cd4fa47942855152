//! Eight lanes as one vector, for kernels whose state is too large for the compiler to find their
//! vectors by itself.
//!
//! A loop over lanes becomes vector instructions where its columns are stored soon. An elimination
//! of nine columns by six rows keeps hundreds of numbers between its stores; as loops it
//! is much slower than as vectors. The vectors are those of `fearless_simd`.

use fearless_simd::f64x8;
use fearless_simd::prelude::*;

use super::LANES;

/// A number for each lane, in registers of an instruction set.
pub(crate) type Vector<S> = f64x8<S>;

/// The number that is in every lane, if it is one.
#[inline(always)]
pub(crate) fn same(numbers: &[usize; LANES]) -> Option<usize> {
    numbers.iter().all(|number| *number == numbers[0]).then_some(numbers[0])
}

/// The numbers of eight rows in lanes: one vector for each place in a row.
#[inline(always)]
pub(crate) fn transposed<S: Simd, const N: usize>(
    simd: S,
    rows: &[&[f64; N]; LANES],
) -> [Vector<S>; N] {
    let mut vectors = [Vector::splat(simd, 0.0); N];
    if N < LANES {
        let mut columns = [[0.0; LANES]; N];
        for lane in 0..LANES {
            for place in 0..N {
                columns[place][lane] = rows[lane][place];
            }
        }
        for place in 0..N {
            vectors[place] = Vector::load_array_ref(simd, &columns[place]);
        }
        return vectors;
    }
    for chunk in 0..N.div_ceil(LANES) {
        // The last eight overlap those before.
        let first = (LANES * chunk).min(N - LANES);
        let mut square = [vectors[0]; LANES];
        for lane in 0..LANES {
            square[lane] = Vector::from_slice(simd, &rows[lane][first..first + LANES]);
        }
        let square = turned_over(square);
        vectors[first..first + LANES].copy_from_slice(&square);
    }
    vectors
}

/// The transpose of eight rows of eight, by perfect shuffles.
#[inline(always)]
fn turned_over<S: Simd>(mut rows: [Vector<S>; LANES]) -> [Vector<S>; LANES] {
    for _ in 0..3 {
        let mut next = rows;
        for i in 0..LANES / 2 {
            next[2 * i] = rows[i].zip_low(rows[i + LANES / 2]);
            next[2 * i + 1] = rows[i].zip_high(rows[i + LANES / 2]);
        }
        rows = next;
    }
    rows
}
