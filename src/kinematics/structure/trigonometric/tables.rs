//! Constants of the transforms: from samples to coefficients, and from those to Bernstein
//! coefficients on each of 16 arcs. All are computed by the compiler.

use crate::lanes::{Column, LANES};

/// Degree of the polynomials: they have up to twice as many real roots.
pub(super) const DEGREE: usize = 8;

/// Samples of a polynomial: 17 for its coefficients, 7 for its noise.
pub(crate) const SAMPLES: usize = 24;

/// Arcs into which the circle is divided before roots are isolated.
pub(super) const ARCS: usize = 16;

/// Degree in the tangent of half an angle.
pub(super) const POWERS: usize = 2 * DEGREE;

/// Middle of arc 0 [rad]: no arc ends within 2.5 deg of a multiple of 7.5 deg, where structured
/// poses have their roots.
pub(super) const FIRST_MIDDLE: f64 = 0.11;

/// Half of an arc [rad].
pub(super) const HALF_ARC: f64 = core::f64::consts::PI / 16.0;

/// Tangent of half of half an arc, pi / 32.
pub(super) const HALF_ARC_TAN: f64 = 0.098_491_403_357_164_25;

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

/// `cos(22.5 deg k)`, k = 0 .. 4
const COS_22: [f64; 5] =
    [1.0, 0.923_879_532_511_286_7, core::f64::consts::FRAC_1_SQRT_2, 0.382_683_432_365_089_84, 0.0];

/// `cos(k FIRST_MIDDLE)` and `sin(k FIRST_MIDDLE)`, k = 0 .. 8
const COS_FIRST: [f64; DEGREE + 1] = [
    1.0,
    0.993_956_097_956_696_8,
    0.975_897_449_330_605_5,
    0.946_042_343_528_387,
    0.904_751_663_219_963_4,
    0.852_524_522_059_505_7,
    0.789_992_231_497_365_1,
    0.717_910_669_610_943_3,
    0.637_151_144_198_580_2,
];
const SIN_FIRST: [f64; DEGREE + 1] = [
    0.0,
    0.109_778_300_837_174_81,
    0.218_229_623_080_869_32,
    0.324_043_028_394_868_37,
    0.425_939_465_065_999_6,
    0.522_687_228_930_659_2,
    0.613_116_851_973_433_8,
    0.696_135_238_627_356_7,
    0.770_738_878_898_969_3,
];

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

/// `cos(k m)` and `sin(k m)` of the middles m of the arcs: by half of the arcs, order and arc.
pub(super) static MIDDLES: [[[Column; 2]; DEGREE + 1]; ARCS / LANES] = middles();

const fn middles() -> [[[Column; 2]; DEGREE + 1]; ARCS / LANES] {
    let mut table = [[[[0.0; LANES]; 2]; DEGREE + 1]; ARCS / LANES];
    let mut arc = 0;
    while arc < ARCS {
        let mut k = 0;
        while k <= DEGREE {
            let cos = whole_cos(k * arc, ARCS, &COS_22);
            let sin = whole_cos(k * arc + 3 * ARCS / 4, ARCS, &COS_22);
            let place = &mut table[arc / LANES][k];
            place[0][arc % LANES] = cos * COS_FIRST[k] - sin * SIN_FIRST[k];
            place[1][arc % LANES] = sin * COS_FIRST[k] + cos * SIN_FIRST[k];
            k += 1;
        }
        arc += 1;
    }
    table
}

/// Bernstein coefficients 0 to 8 of `(1 + tau^2)^8 cos(2 k atan tau)` and of the sine, for tau of
/// half an arc to either side: by order and coefficient. Coefficient 16 - j of the cosine equals
/// coefficient j, that of the sine its negative (eq. 94).
pub(super) static BERNSTEIN: [[[f64; 2]; DEGREE + 1]; DEGREE + 1] = bernstein();

#[expect(clippy::cast_precision_loss, reason = "numbers up to 16")]
const fn bernstein() -> [[[f64; 2]; DEGREE + 1]; DEGREE + 1] {
    let mut table = [[[0.0; 2]; DEGREE + 1]; DEGREE + 1];
    let mut k = 0;
    while k <= DEGREE {
        // (1 + i tau)^(8 + k) (1 - i tau)^(8 - k) as a product of 16 linear factors: coefficients
        // by powers of t and 1 - t, tau = h (2 t - 1), complex.
        let mut product = [[0.0; 2]; POWERS + 1];
        product[0] = [1.0, 0.0];
        let mut factor = 0;
        while factor < POWERS {
            let h = if factor < DEGREE + k { HALF_ARC_TAN } else { -HALF_ARC_TAN };
            let mut j = factor + 1;
            loop {
                let here = product[j];
                let before = if j == 0 { [0.0; 2] } else { product[j - 1] };
                // (1 - i h) (1 - t) + (1 + i h) t
                product[j] = [
                    here[0] + here[1] * h + before[0] - before[1] * h,
                    here[1] - here[0] * h + before[1] + before[0] * h,
                ];
                if j == 0 {
                    break;
                }
                j -= 1;
            }
            factor += 1;
        }
        let mut binomial = 1.0;
        let mut j = 0;
        while j <= DEGREE {
            table[k][j] = [product[j][0] / binomial, product[j][1] / binomial];
            binomial = binomial * (POWERS - j) as f64 / (j + 1) as f64;
            j += 1;
        }
        k += 1;
    }
    table
}
