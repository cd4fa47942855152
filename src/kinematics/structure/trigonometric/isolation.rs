//! Intervals with one root each, by Descartes' rule for Bernstein coefficients.
//!
//! A polynomial has at most as many roots in an interval as its Bernstein coefficients change sign,
//! and differs from that number by an even one. So no change is no root, one change is one root,
//! and more are divided by de Casteljau's algorithm. A coefficient below the noise counts as either
//! sign. Reference: Lane and Riesenfeld, Bounds on a polynomial, BIT 21, 1981.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use fearless_simd::prelude::*;

use super::brackets::Brackets;
use super::part::{Coefficients, Part};
use super::polynomial::TrigonometricPolynomial;
use super::roots::{Root, Roots};
use super::tables::{ARCS, BERNSTEIN, DEGREE, MIDDLES, POWERS};
use crate::lanes::{Column, LANES, Number as _, Vector};

/// Width of a part of an arc that is not divided [1]: 5e-8 rad.
const LEAST_WIDTH: f64 = 1.0 / (1 << 23) as f64;

/// Width of a part at the edge of a cluster, relative to the cluster's, up to which it is taken as
/// part of it [1].
const EDGE: f64 = 0.125;

/// Parts of arcs that wait for their division: a double root leaves two or three of each width.
const MOST_PARTS: usize = 24;

/// Divisions of eight parts each, at most: a double root takes one for each width.
const MOST_DIVISIONS: usize = 96;

/// A count of changes that no coefficients have: stands for an impossible sign.
const NEVER: f64 = -1e3;

/// What is found, and what is to be divided.
struct Found<'a> {
    parts: Parts,
    brackets: Brackets,
    roots: &'a mut Roots,
}

/// Parts to be divided, in blocks of lanes.
struct Parts {
    columns: [Coefficients<Column>; MOST_PARTS / LANES],
    all: [Part; MOST_PARTS],
    count: usize,
}

impl Parts {
    const NONE: Self = Self {
        columns: [[[0.0; LANES]; POWERS + 1]; MOST_PARTS / LANES],
        all: [Part::NONE; MOST_PARTS],
        count: 0,
    };

    fn push(&mut self, coefficients: &Coefficients<f64>, part: Part) {
        let columns = &mut self.columns[self.count / LANES];
        for j in 0..=POWERS {
            // The first of a block stands in its other lanes until there are others.
            if self.count.is_multiple_of(LANES) {
                columns[j] = [coefficients[j]; LANES];
            }
            columns[j][self.count % LANES] = coefficients[j];
        }
        self.all[self.count] = part;
        self.count += 1;
    }

    fn as_slice(&self) -> &[Part] {
        &self.all[..self.count]
    }

    /// Divide the last block by de Casteljau's algorithm, and remove it. Returns its parts.
    #[inline(always)]
    fn divide<S: Simd>(
        &mut self,
        left: &mut Coefficients<Vector<S>>,
        right: &mut Coefficients<Vector<S>>,
    ) -> Option<([Part; LANES], usize)> {
        let block = self.count.checked_sub(1)? / LANES;
        let first = LANES * block;
        let mut parts = [self.all[first]; LANES];
        parts.copy_from_slice(&self.all[first..first + LANES]);
        let simd = left[0].token();
        let cut = Vector::load_array(simd, parts.map(|part| part.cut));
        for j in 0..=POWERS {
            right[j] = Vector::load_array_ref(simd, &self.columns[block][j]);
        }
        left[0] = right[0];
        for row in 1..=POWERS {
            for j in 0..=POWERS - row {
                right[j] = (right[j + 1] - right[j]).mul_add(cut, right[j]);
            }
            left[row] = right[0];
        }
        let count = self.count - first;
        self.count = first;
        Some((parts, count))
    }
}

impl TrigonometricPolynomial {
    /// Find an interval for every root beside the known clusters: brackets of simple roots, as wide
    /// as they can be, and clusters.
    #[inline(always)]
    pub(super) fn isolate<S: Simd>(&self, simd: S, known: &[Root], roots: &mut Roots) -> Brackets {
        let mut found = Found { parts: Parts::NONE, brackets: Brackets::NONE, roots };
        for half in 0..ARCS / LANES {
            let columns = self.on_arcs(simd, half);
            let seen = Seen::of(&columns, self.noise);
            let whole = |lane: usize| Part::new(LANES * half + lane, 0.0, 1.0);
            let mut cut = 0;
            for lane in if known.is_empty() { 0..0 } else { 0..LANES } {
                let whole = whole(lane);
                if let Some(cluster) = known.iter().find(|cluster| cluster.reaches(whole.arc)) {
                    cut |= 1 << lane;
                    for part in whole.without(cluster).into_iter().flatten() {
                        found.parts.push(&in_lane(&columns, lane), part);
                    }
                }
            }
            for lane in lanes_of(seen.open & !cut) {
                self.take(&seen, lane, whole(lane), &mut found);
            }
        }
        for cluster in known {
            found.roots.push(*cluster);
        }
        let zero = Vector::splat(simd, 0.0);
        let (mut left, mut right) = ([zero; POWERS + 1], [zero; POWERS + 1]);
        for _ in 0..MOST_DIVISIONS {
            let Some((parts, count)) = found.parts.divide(&mut left, &mut right) else { break };
            for (end, columns) in [&left, &right].into_iter().enumerate() {
                let seen = Seen::of(columns, self.noise);
                for lane in lanes_of(seen.open).take_while(|lane| *lane < count) {
                    if parts[lane].keeps[end] {
                        self.take(&seen, lane, parts[lane].divided()[end], &mut found);
                    }
                }
            }
        }
        for part in found.parts.as_slice() {
            found.roots.push(part.cluster());
        }
        found.brackets
    }

    /// Bernstein coefficients on eight arcs (eq. 94).
    #[inline(always)]
    fn on_arcs<S: Simd>(&self, simd: S, half: usize) -> Coefficients<Vector<S>> {
        let zero = Vector::splat(simd, 0.0);
        let mut columns = [zero; POWERS + 1];
        // The sums of cosines and of sines, which are even and odd about the middle.
        let (mut even, mut odd) = ([zero; DEGREE + 1], [zero; DEGREE + 1]);
        for k in 0..=DEGREE {
            let [cos, sin] = &MIDDLES[half][k];
            let (cos, sin) = (Vector::load_array_ref(simd, cos), Vector::load_array_ref(simd, sin));
            let of_cos = cos.scaled_plus(self.cos[k], sin * self.sin[k]);
            let of_sin = cos.scaled_plus(self.sin[k], sin * -self.cos[k]);
            for j in 0..=DEGREE {
                let [weight_even, weight_odd] = BERNSTEIN[k][j];
                even[j] = of_cos.scaled_plus(weight_even, even[j]);
                odd[j] = of_sin.scaled_plus(weight_odd, odd[j]);
            }
        }
        for j in 0..=DEGREE {
            columns[j] = even[j] + odd[j];
            columns[POWERS - j] = even[j] - odd[j];
        }
        columns
    }

    /// Decide on one lane that is open: a simple root, a cluster, or a part to be divided.
    #[inline(always)]
    fn take<S: Simd>(&self, seen: &Seen<'_, S>, lane: usize, part: Part, found: &mut Found<'_>) {
        if seen.simple >> lane & 1 == 1 {
            let place = (part.arc, part.low, part.high);
            found.brackets.push(place, seen.places[lane], seen.columns[0][lane]);
        } else {
            self.take_rest(&in_lane(seen.columns, lane), seen.many >> lane & 1 == 1, part, found);
        }
    }

    /// Decide where there is more than one simple root: a function of its own, for it is called in
    /// several places.
    #[inline(never)]
    fn take_rest(
        &self,
        coefficients: &Coefficients<f64>,
        has_many: bool,
        part: Part,
        found: &mut Found<'_>,
    ) {
        let Found { parts, brackets, roots } = found;
        let is_noise = |b: &f64| b.abs() <= self.noise;
        let is_at_edge = || {
            let may_be = is_noise(&coefficients[0]) || is_noise(&coefficients[POWERS]);
            may_be && roots.have_at_edge(&part.cluster(), EDGE)
        };
        if coefficients.iter().all(is_noise)
            || part.high - part.low < 1.5 * LEAST_WIDTH
            || parts.count == MOST_PARTS
            || is_at_edge()
        {
            roots.take_cluster(&part.cluster());
        } else if has_many || !part.take_pair(coefficients, self.noise, brackets, roots) {
            parts.push(coefficients, part);
        }
    }
}

/// What coefficients show of roots: sets of lanes as bits.
struct Seen<'a, S: Simd> {
    columns: &'a Coefficients<Vector<S>>,
    /// With a root, perhaps; with one simple root; with more than two, perhaps.
    open: u64,
    simple: u64,
    many: u64,
    /// Where the control polygon crosses zero, in 0 ..= 1, if there is a simple root.
    places: Column,
}

impl<'a, S: Simd> Seen<'a, S> {
    #[inline(always)]
    fn of(columns: &'a Coefficients<Vector<S>>, noise: f64) -> Self {
        let changes = most_changes(columns, noise);
        let (first, last) = (columns[0], columns[POWERS]);
        let are_certain = first.abs().simd_gt(noise) & last.abs().simd_gt(noise);
        let differ = first.simd_lt(0.0) ^ last.simd_lt(0.0);
        let simple = changes.simd_gt(0.5) & changes.simd_lt(1.5) & are_certain & differ;
        Self {
            columns,
            open: changes.simd_gt(0.5).to_bitmask(),
            simple: simple.to_bitmask(),
            many: changes.simd_gt(2.5).to_bitmask(),
            places: crossings(columns).to_array(),
        }
    }
}

/// The lanes of a set, in order.
#[inline(always)]
fn lanes_of(mut set: u64) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let lane = set.trailing_zeros() as usize;
        set &= set.wrapping_sub(1);
        (lane < LANES).then_some(lane)
    })
}

/// The coefficients in a lane.
#[inline(always)]
fn in_lane<S: Simd>(columns: &Coefficients<Vector<S>>, lane: usize) -> Coefficients<f64> {
    let mut coefficients = [0.0; POWERS + 1];
    for j in 0..=POWERS {
        coefficients[j] = columns[j][lane];
    }
    coefficients
}

/// Where the control polygon first crosses zero between ends of different signs, in 0 ..= 1.
#[inline(always)]
fn crossings<S: Simd>(columns: &Coefficients<Vector<S>>) -> Vector<S> {
    let is_below = columns[0].simd_lt(0.0);
    let [mut one, mut other] = [columns[POWERS - 1], columns[POWERS]];
    let mut after = one.like(PLACES[POWERS]);
    for j in (1..POWERS).rev() {
        let is_after = columns[j].simd_lt(0.0) ^ is_below;
        one = is_after.select(columns[j - 1], one);
        other = is_after.select(columns[j], other);
        after = is_after.select(after.like(PLACES[j]), after);
    }
    after - other / (other - one) * PLACES[1]
}

/// Places of the coefficients, in 0 ..= 1.
#[expect(clippy::cast_precision_loss, reason = "up to 16")]
const PLACES: [f64; POWERS + 1] = {
    let mut places = [0.0; POWERS + 1];
    let mut j = 0;
    while j <= POWERS {
        places[j] = j as f64 / POWERS as f64;
        j += 1;
    }
    places
};

/// The most changes of sign that the coefficients of each lane have, if those below the noise have
/// any sign.
#[inline(always)]
fn most_changes<S: Simd>(columns: &Coefficients<Vector<S>>, noise: f64) -> Vector<S> {
    let (zero, one) = (columns[0].like(0.0), columns[0].like(1.0));
    let (mut count, mut least) = (zero, columns[0].abs());
    let mut before = columns[0].simd_lt(zero);
    for column in &columns[1..] {
        let is_below = column.simd_lt(zero);
        count += (is_below ^ before).select(one, zero);
        least = least.min(column.abs());
        before = is_below;
    }
    if least.simd_gt(noise).all_true() {
        return count;
    }
    most_changes_of_any_sign(columns, noise)
}

/// The same where coefficients are below the noise.
#[inline(always)]
fn most_changes_of_any_sign<S: Simd>(columns: &Coefficients<Vector<S>>, noise: f64) -> Vector<S> {
    // Most changes of a sequence that ends above zero, and of one that ends below.
    // The first coefficient is no change.
    let never = columns[0].like(NEVER);
    let (mut above, mut below) = (columns[0].like(-1.0), columns[0].like(-1.0));
    for column in columns {
        let up = (below + 1.0).or_more(above);
        let down = (above + 1.0).or_more(below);
        above = column.simd_ge(-noise).select(up, never);
        below = column.simd_le(noise).select(down, never);
    }
    above.or_more(below)
}
