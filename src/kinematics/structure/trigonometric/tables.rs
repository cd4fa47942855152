//! Constants of the transforms: from samples to coefficients, and from those to Bernstein
//! coefficients on each of 32 arcs. All are computed by the compiler.
#![expect(clippy::cast_precision_loss, reason = "numbers up to 200")]

use crate::lanes::{Column, LANES};

/// Degree of the polynomials: they have up to twice as many real roots.
pub(super) const DEGREE: usize = 8;

/// Samples of a polynomial: 17 for its coefficients, 7 for its noise.
pub(crate) const SAMPLES: usize = 24;

/// Arcs into which the circle is divided before roots are isolated.
pub(super) const ARCS: usize = 32;

/// Quarters of the circle: the arcs of each are in the lanes of a vector.
pub(super) const QUARTERS: usize = ARCS / LANES;

/// Degree of the polynomials on an arc, in the angle.
pub(super) const POWERS: usize = 12;

/// Where arc 0 begins [rad], -9.375 deg: no arc ends within 1.8 deg of a multiple of 7.5 deg, where
/// structured poses have their roots, and the range of roots not within 5.6 deg of one of 15 deg.
pub(super) const FIRST: f64 = -5.0 * core::f64::consts::PI / 96.0;

/// Half of an arc [rad].
pub(super) const HALF_ARC: f64 = core::f64::consts::PI / 32.0;

/// Orders of the harmonics, as factors.
pub(super) const ORDERS: [f64; DEGREE + 1] = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];

/// `cos(15 deg k)`, k = 0 .. 6
const COS_15: [f64; 7] = [
    1.0,
    0.965_925_826_289_068_3,
    0.866_025_403_784_438_6,
    core::f64::consts::FRAC_1_SQRT_2,
    0.5,
    0.258_819_045_102_520_74,
    0.0,
];

/// `cos(1.875 deg k)`, k = 0 .. 48: three such steps are half of an arc.
const COS_FINE: [f64; FINE / 4 + 1] = {
    let mut table = [1.0; FINE / 4 + 1];
    let mut k = 1;
    while k <= FINE / 4 {
        table[k] = cos_of(k as f64 * (2.0 * core::f64::consts::PI / FINE as f64));
        k += 1;
    }
    // The last is zero but for the rounding of pi.
    table[FINE / 4] = 0.0;
    table
};

/// Steps of 1.875 deg in a full turn.
const FINE: usize = 192;

/// Such steps in half of an arc, and to where arc 0 begins, a turn on.
const HALF_ARC_STEPS: usize = 3;
const FIRST_STEPS: usize = FINE - 5;

/// The cosine of an angle in the first quarter, by its series.
const fn cos_of(angle: f64) -> f64 {
    let (mut sum, mut term, mut order) = (0.0, 1.0, 0.0);
    let mut terms = [0.0; 14];
    let mut n = 0;
    while n < terms.len() {
        terms[n] = term;
        term = -term * angle * angle / ((order + 1.0) * (order + 2.0));
        order += 2.0;
        n += 1;
    }
    // From the smallest on.
    while n > 0 {
        n -= 1;
        sum += terms[n];
    }
    sum
}

/// The cosine of a whole number of `1 / turn` full turns, by its values in the first quarter.
const fn whole_cos(steps: usize, turn: usize, quarter: &[f64]) -> f64 {
    let step = steps % turn;
    let step = if step > turn / 2 { turn - step } else { step };
    if step > turn / 4 { -quarter[turn / 2 - step] } else { quarter[step] }
}

const fn cos_15(steps: usize) -> f64 {
    whole_cos(steps, SAMPLES, &COS_15)
}

const fn sin_15(steps: usize) -> f64 {
    whole_cos(steps + 3 * SAMPLES / 4, SAMPLES, &COS_15)
}

/// Cosines and sines of the sample angles.
pub(crate) const SAMPLE_COS: [Column; SAMPLES / LANES] = samples(false);
pub(crate) const SAMPLE_SIN: [Column; SAMPLES / LANES] = samples(true);

const fn samples(of_sine: bool) -> [Column; SAMPLES / LANES] {
    let mut columns = [[0.0; LANES]; SAMPLES / LANES];
    let mut j = 0;
    while j < SAMPLES {
        columns[j / LANES][j % LANES] = if of_sine { sin_15(j) } else { cos_15(j) };
        j += 1;
    }
    columns
}

/// Weights of each sample in the harmonics: cosines of order 0 to 7; the cosine of order 8, then
/// the surplus, cosines of order 9 to 12 and sines of order 9 to 11; sines of order 1 to 8.
pub(super) static FOURIER: [[Column; 3]; SAMPLES] = fourier();

const fn fourier() -> [[Column; 3]; SAMPLES] {
    let mut weights = [[[0.0; LANES]; 3]; SAMPLES];
    let mut j = 0;
    while j < SAMPLES {
        let mut lane = 0;
        while lane < LANES {
            let half = if lane == 0 { 1.0 } else { 2.0 };
            weights[j][0][lane] = half / 24.0 * cos_15(lane * j);
            weights[j][1][lane] = if lane < 5 {
                let half = if lane == 4 { 1.0 } else { 2.0 };
                half / 24.0 * cos_15((8 + lane) * j)
            } else {
                2.0 / 24.0 * sin_15((4 + lane) * j)
            };
            weights[j][2][lane] = 2.0 / 24.0 * sin_15((lane + 1) * j);
            lane += 1;
        }
        j += 1;
    }
    weights
}

/// `cos(k m)` and `sin(k m)` of the middles m of the arcs of the first quarter, from the beginning
/// of the first arc: by order and arc.
pub(super) static MIDDLES: [[Column; 2]; DEGREE + 1] = middles();

const fn middles() -> [[Column; 2]; DEGREE + 1] {
    let mut table = [[[0.0; LANES]; 2]; DEGREE + 1];
    let mut k = 0;
    while k <= DEGREE {
        let mut arc = 0;
        while arc < LANES {
            table[k][0][arc] = fine_cos(k * (2 * arc + 1) * HALF_ARC_STEPS);
            table[k][1][arc] = fine_sin(k * (2 * arc + 1) * HALF_ARC_STEPS);
            arc += 1;
        }
        k += 1;
    }
    table
}

/// `cos(k x)` and `sin(k x)` of the beginning x of the first arc, k = 1 .. 8.
pub(super) static BEGINNING: [Column; 2] = {
    let mut columns = [[0.0; LANES]; 2];
    let mut k = 1;
    while k <= DEGREE {
        columns[0][k - 1] = fine_cos(k * FIRST_STEPS);
        columns[1][k - 1] = fine_sin(k * FIRST_STEPS);
        k += 1;
    }
    columns
};

const fn fine_cos(steps: usize) -> f64 {
    whole_cos(steps, FINE, &COS_FINE)
}

const fn fine_sin(steps: usize) -> f64 {
    whole_cos(steps + 3 * FINE / 4, FINE, &COS_FINE)
}

/// Bernstein coefficients 0 to 6 of `cos(k x)` and of `sin(k x)` for x of half an arc to either side:
/// by coefficient and order. Coefficient 12 - j of the cosine equals coefficient j, the sine's is
/// its negative (eq. 94).
pub(super) static BERNSTEIN: [[[f64; DEGREE + 1]; 2]; POWERS / 2 + 1] = bernstein();

const fn bernstein() -> [[[f64; DEGREE + 1]; 2]; POWERS / 2 + 1] {
    let mut table = [[[0.0; DEGREE + 1]; 2]; POWERS / 2 + 1];
    let mut k = 0;
    while k <= DEGREE {
        let mut n = 0;
        while n <= POWERS {
            let twice = if n == 0 { 1.0 } else { 2.0 };
            let sign = if n % 4 < 2 { 1.0 } else { -1.0 };
            let weight = sign * twice * bessel(n, k as f64 * HALF_ARC);
            let mut j = 0;
            while j <= POWERS / 2 {
                table[j][n % 2][k] += weight * chebyshev(n, j);
                j += 1;
            }
            n += 1;
        }
        k += 1;
    }
    table
}

/// Bessel's function of the first kind, by its series.
const fn bessel(order: usize, of: f64) -> f64 {
    let (mut sum, mut term) = (0.0, 1.0);
    let mut n = 1;
    while n <= order {
        term *= 0.5 * of / n as f64;
        n += 1;
    }
    let mut m = 1;
    while m < 16 {
        sum += term;
        term *= -0.25 * of * of / (m * (m + order)) as f64;
        m += 1;
    }
    sum
}

/// Bernstein coefficient j, in degree 12, of Chebyshev's polynomial of degree n on -1 .. 1.
const fn chebyshev(n: usize, j: usize) -> f64 {
    let (mut sum, mut i) = (0.0, 0);
    while i <= n && i <= j {
        if j - i <= POWERS - n {
            let sign = if (n - i).is_multiple_of(2) { 1.0 } else { -1.0 };
            sum += sign * binomial(2 * n, 2 * i) * binomial(POWERS - n, j - i);
        }
        i += 1;
    }
    sum / binomial(POWERS, j)
}

pub(super) const fn binomial(n: usize, k: usize) -> f64 {
    let (mut product, mut i) = (1.0, 0);
    while i < k {
        product = product * (n - i) as f64 / (i + 1) as f64;
        i += 1;
    }
    product
}
