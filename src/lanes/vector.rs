//! Eight lanes as one vector, for kernels whose state is too large for the compiler to find their
//! vectors by itself.
//!
//! A loop over lanes becomes vector instructions where its columns are stored soon. An elimination
//! of nine columns by six rows keeps hundreds of numbers between its stores; as loops it
//! is much slower than as vectors. The vectors are `fearless_simd`'s.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

use super::LANES;
use super::dispatch::InstructionSet;

/// A number for each lane, in registers of an instruction set.
pub type Vector<S> = f64x8<S>;

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

/// A computation in vectors, which is compiled for each instruction set.
///
/// Everything in it must be `#[inline(always)]`, without closures: a function of its own is
/// compiled for the baseline.
pub trait VectorKernel {
    /// The result.
    type Answer;

    /// Compute the answer.
    fn run<S: Simd>(self, simd: S) -> Self::Answer;
}

/// Run a kernel on the instruction set in use. AVX-512 is taken where the processor has what
/// Ice Lake has of it, else AVX2: the bits are the same.
#[inline]
pub fn run_vectors<K: VectorKernel>(kernel: K) -> K::Answer {
    run_on(InstructionSet::in_use(), kernel)
}

/// Run a kernel on an instruction set.
#[inline]
pub(crate) fn run_on<K: VectorKernel>(set: InstructionSet, kernel: K) -> K::Answer {
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    {
        let level = Level::new();
        if set == InstructionSet::Avx512
            && let Some(simd) = level.as_avx512()
        {
            return vectorized(simd, kernel);
        }
        if set != InstructionSet::Baseline
            && let Some(simd) = level.as_avx2()
        {
            return vectorized(simd, kernel);
        }
    }
    let _ = set;
    on_baseline(kernel)
}

/// Run a kernel on what the crate is compiled for.
#[inline]
fn on_baseline<K: VectorKernel>(kernel: K) -> K::Answer {
    // Not the other sets below AVX2, for which no kernel need be compiled.
    #[cfg(target_arch = "x86_64")]
    if let Some(simd) = Level::baseline().as_sse2() {
        return vectorized(simd, kernel);
    }
    dispatch!(Level::baseline(), simd => kernel.run(simd))
}

#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn vectorized<S: Simd, K: VectorKernel>(simd: S, kernel: K) -> K::Answer {
    simd.vectorize(
        #[inline(always)]
        || kernel.run(simd),
    )
}
