//! The polynomial on each of 32 arcs: Bernstein coefficients, by quarters of the circle (eq. 94).

use fearless_simd::prelude::*;

use super::part::Coefficients;
use super::polynomial::TrigonometricPolynomial;
use super::tables::{ARCS, BEGINNING, BERNSTEIN, DEGREE, MIDDLES, POWERS, QUARTERS};
use crate::lanes::{LANES, Number as _, Vector};

impl TrigonometricPolynomial {
    /// Bernstein coefficients on all arcs, by quarters (eq. 94).
    #[inline(always)]
    pub(super) fn on_arcs<S: Simd>(
        &self,
        simd: S,
        quarters: &mut [Coefficients<Vector<S>>; QUARTERS],
    ) {
        let zero = Vector::splat(simd, 0.0);
        let [cos, sin] = self.at_first_arc(simd);
        // Products with cosines and sines of the middles: of the cosines of an angle from there, and
        // of its sines.
        let [mut even, mut odd] = [[[zero; DEGREE + 1]; 2]; 2];
        for k in 0..=DEGREE {
            let [of_cos, of_sin] = MIDDLES[k].each_ref().map(|c| Vector::load_array_ref(simd, c));
            (even[0][k], even[1][k]) = (of_cos * cos[k], of_sin * sin[k]);
            (odd[0][k], odd[1][k]) = (of_cos * sin[k], of_sin * cos[k]);
        }
        for j in 0..=POWERS / 2 {
            let [of_even, of_odd] = &BERNSTEIN[j];
            let [same, turned] = both_ways(&even, of_even);
            let [same_odd, turned_odd] = both_ways(&odd, of_odd);
            // At m, pi - m, pi + m, -m.
            let sums = [
                (same[0] + same[1], same_odd[0] - same_odd[1]),
                (turned[0] - turned[1], turned_odd[0] + turned_odd[1]),
                (turned[0] + turned[1], turned_odd[0] - turned_odd[1]),
                (same[0] - same[1], same_odd[0] + same_odd[1]),
            ];
            for (columns, (even, odd)) in quarters.iter_mut().zip(sums) {
                columns[POWERS - j] = even - odd;
                columns[j] = even + odd;
            }
        }
    }

    /// Coefficients of the cosines and sines of angles from the beginning of the first arc.
    #[inline(always)]
    fn at_first_arc<S: Simd>(&self, simd: S) -> [[f64; DEGREE + 1]; 2] {
        let [of_cos, of_sin] = BEGINNING.each_ref().map(|c| Vector::load_array_ref(simd, c));
        let cos = Vector::from_slice(simd, &self.cos[1..]);
        let sin = Vector::from_slice(simd, &self.sin[1..]);
        let [mut all_cos, mut all_sin] = [[0.0; DEGREE + 1]; 2];
        all_cos[0] = self.cos[0];
        all_cos[1..].copy_from_slice(&of_cos.mul_add(cos, of_sin * sin).to_array());
        all_sin[1..].copy_from_slice(&of_cos.mul_add(sin, -(of_sin * cos)).to_array());
        [all_cos, all_sin]
    }
}

/// Weighted sums of two sequences, at a middle and half a turn on, where those with an odd k have the
/// other sign.
#[inline(always)]
fn both_ways<S: Simd>(
    [a, b]: &[[Vector<S>; DEGREE + 1]; 2],
    weights: &[f64; DEGREE + 1],
) -> [[Vector<S>; 2]; 2] {
    let [[a, c], [b, d]] = [by_parity(a, weights), by_parity(b, weights)];
    [[a + c, b + d], [a - c, b - d]]
}

/// Weighted sums of those with an even and of those with an odd k.
#[inline(always)]
fn by_parity<S: Simd>(
    all: &[Vector<S>; DEGREE + 1],
    weights: &[f64; DEGREE + 1],
) -> [Vector<S>; 2] {
    let plus = |k: usize, sum: Vector<S>| all[k].scaled_plus(weights[k], sum);
    [
        plus(0, plus(2, plus(4, plus(6, all[8] * weights[8])))),
        plus(1, plus(3, plus(5, all[7] * weights[7]))),
    ]
}

/// The arcs in the lanes of each quarter, with their middles at m, pi - m, pi + m and -m from the
/// beginning of the first arc.
pub(super) const ARCS_OF: [[usize; LANES]; QUARTERS] = {
    let mut arcs = [[0; LANES]; QUARTERS];
    let mut lane = 0;
    while lane < LANES {
        arcs[0][lane] = lane;
        arcs[1][lane] = ARCS / 2 - 1 - lane;
        arcs[2][lane] = ARCS / 2 + lane;
        arcs[3][lane] = ARCS - 1 - lane;
        lane += 1;
    }
    arcs
};
