//! Intervals with one root each, by Descartes' rule for Bernstein coefficients.
//!
//! A polynomial has at most as many roots in an interval as its Bernstein coefficients change sign,
//! and differs from that number by an even one. So no change is no root, one change is one root,
//! and more are divided by de Casteljau's algorithm. A coefficient below the noise counts as either
//! sign. Reference: Lane and Riesenfeld, Bounds on a polynomial, BIT 21, 1981.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::tables::{ARCS, BERNSTEIN, FIRST_MIDDLE, HALF_ARC_TAN, MIDDLES, POWERS};
use super::{DEGREE, Root, Roots, TrigonometricPolynomial};
use crate::lanes::{Column, LANES, mul_add};

/// Width of a part of an arc that is not divided [1]: 5e-8 rad.
const LEAST_WIDTH: f64 = 1.0 / (1 << 23) as f64;

/// Parts of arcs that wait for their division: a double root leaves two or three of each width.
const MOST_PARTS: usize = 32;

/// Divisions of eight parts each, at most: a double root takes one for each width.
const MOST_DIVISIONS: usize = 96;

/// A count of changes that no coefficients have: stands for an impossible sign.
const NEVER: f64 = -1e3;

type Coefficients<T> = [T; POWERS + 1];

/// A part of an arc: ends in 0 ..= 1, and the Bernstein coefficients between them.
#[derive(Clone, Copy)]
struct Part {
    arc: usize,
    low: f64,
    high: f64,
    coefficients: Coefficients<f64>,
}

/// Parts to be divided.
struct Parts {
    all: [Part; MOST_PARTS],
    count: usize,
}

impl TrigonometricPolynomial {
    /// Find an interval for every root; those of simple roots are as wide as they can be.
    #[inline(always)]
    pub(super) fn isolate<const FUSED: bool>(&self, roots: &mut Roots) {
        let none = Part { arc: 0, low: 0.0, high: 1.0, coefficients: [0.0; POWERS + 1] };
        let mut parts = Parts { all: [none; MOST_PARTS], count: 0 };
        for half in 0..ARCS / LANES {
            let columns = self.on_arcs::<FUSED>(half);
            let most = most_changes(&columns, self.noise);
            for lane in 0..LANES {
                let arc = LANES * half + lane;
                self.take(&columns, most[lane], lane, (arc, 0.0, 1.0), &mut parts, roots);
            }
        }
        let mut divisions = 0;
        while parts.count > 0 {
            let first = parts.count.saturating_sub(LANES);
            let count = parts.count - first;
            divisions += 1;
            if divisions > MOST_DIVISIONS {
                parts.all[..parts.count].iter().for_each(|part| roots.push(part.cluster()));
                break;
            }
            let [left, right] = divide(&parts.all[first..parts.count]);
            let changes = [most_changes(&left, self.noise), most_changes(&right, self.noise)];
            let divided: [_; LANES] = core::array::from_fn(|lane| {
                let part = &parts.all[first + if lane < count { lane } else { 0 }];
                (part.arc, part.low, part.high)
            });
            parts.count = first;
            for (lane, (arc, low, high)) in divided[..count].iter().copied().enumerate() {
                let middle = 0.5 * (low + high);
                let ends = [(arc, low, middle), (arc, middle, high)];
                self.take(&left, changes[0][lane], lane, ends[0], &mut parts, roots);
                self.take(&right, changes[1][lane], lane, ends[1], &mut parts, roots);
            }
        }
    }

    /// Bernstein coefficients on eight arcs (eq. 94).
    #[inline(always)]
    fn on_arcs<const FUSED: bool>(&self, half: usize) -> Coefficients<Column> {
        let mut columns = [[0.0; LANES]; POWERS + 1];
        // The sums of cosines and of sines, which are even and odd about the middle.
        let mut even = [[0.0; LANES]; DEGREE + 1];
        let mut odd = [[0.0; LANES]; DEGREE + 1];
        for k in 0..=DEGREE {
            let [cos, sin] = &MIDDLES[half][k];
            let (mut of_cos, mut of_sin) = ([0.0; LANES], [0.0; LANES]);
            for lane in 0..LANES {
                of_cos[lane] = mul_add::<FUSED>(self.cos[k], cos[lane], self.sin[k] * sin[lane]);
                of_sin[lane] = mul_add::<FUSED>(self.sin[k], cos[lane], -(self.cos[k] * sin[lane]));
            }
            for j in 0..=DEGREE {
                let [weight_even, weight_odd] = BERNSTEIN[k][j];
                for lane in 0..LANES {
                    even[j][lane] = mul_add::<FUSED>(weight_even, of_cos[lane], even[j][lane]);
                    odd[j][lane] = mul_add::<FUSED>(weight_odd, of_sin[lane], odd[j][lane]);
                }
            }
        }
        for j in 0..=DEGREE {
            for lane in 0..LANES {
                columns[j][lane] = even[j][lane] + odd[j][lane];
                columns[POWERS - j][lane] = even[j][lane] - odd[j][lane];
            }
        }
        columns
    }

    /// Decide on one lane: nothing, a simple root, a cluster, or a part to be divided.
    #[inline(always)]
    fn take(
        &self,
        columns: &Coefficients<Column>,
        changes: f64,
        lane: usize,
        (arc, low, high): (usize, f64, f64),
        parts: &mut Parts,
        roots: &mut Roots,
    ) {
        if changes < 0.5 {
            return;
        }
        let coefficients: Coefficients<f64> = core::array::from_fn(|j| columns[j][lane]);
        let part = Part { arc, low, high, coefficients };
        let (first, last) = (coefficients[0], coefficients[POWERS]);
        let are_certain = first.abs() > self.noise && last.abs() > self.noise;
        if changes < 1.5 && are_certain && (first < 0.0) != (last < 0.0) {
            roots.push(Root {
                low: part.angle(low),
                high: part.angle(high),
                is_simple: true,
                most: 1,
            });
        } else if coefficients.iter().all(|b| b.abs() <= self.noise)
            || high - low < 1.5 * LEAST_WIDTH
            || parts.count == MOST_PARTS
        {
            roots.push(part.cluster());
        } else {
            parts.all[parts.count] = part;
            parts.count += 1;
        }
    }
}

impl Part {
    /// The angle at a place of its arc [rad].
    fn angle(&self, place: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "one of 16")]
        let middle = FIRST_MIDDLE + self.arc as f64 * (2.0 * PI / ARCS as f64);
        middle + 2.0 * (HALF_ARC_TAN * (2.0 * place - 1.0)).atan()
    }

    fn cluster(&self) -> Root {
        Root { low: self.angle(self.low), high: self.angle(self.high), is_simple: false, most: 0 }
    }
}

/// The most changes of sign that the coefficients of each lane have, if those below the noise have
/// any sign.
#[inline(always)]
fn most_changes(columns: &Coefficients<Column>, noise: f64) -> Column {
    // Most changes of a sequence that ends above zero, and of one that ends below.
    // The first coefficient is no change.
    let (mut above, mut below) = ([-1.0; LANES], [-1.0; LANES]);
    for column in columns {
        for lane in 0..LANES {
            let (after_above, after_below) = (above[lane], below[lane]);
            let rises = after_below + 1.0;
            let falls = after_above + 1.0;
            let up = if rises > after_above { rises } else { after_above };
            let down = if falls > after_below { falls } else { after_below };
            above[lane] = if column[lane] >= -noise { up } else { NEVER };
            below[lane] = if column[lane] <= noise { down } else { NEVER };
        }
    }
    let mut most = [0.0; LANES];
    for lane in 0..LANES {
        most[lane] = if above[lane] > below[lane] { above[lane] } else { below[lane] };
    }
    most
}

/// Both halves of up to eight parts, by de Casteljau's algorithm.
#[inline(always)]
fn divide(parts: &[Part]) -> [Coefficients<Column>; 2] {
    let mut right = [[0.0; LANES]; POWERS + 1];
    for (lane, part) in parts.iter().enumerate() {
        for j in 0..=POWERS {
            right[j][lane] = part.coefficients[j];
        }
    }
    let mut left = right;
    for row in 1..=POWERS {
        for j in 0..=POWERS - row {
            for lane in 0..LANES {
                right[j][lane] = 0.5 * (right[j][lane] + right[j + 1][lane]);
            }
        }
        left[row] = right[0];
    }
    [left, right]
}
