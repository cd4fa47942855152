//! Intervals with one root each, by Descartes' rule for Bernstein coefficients.
//!
//! A polynomial has at most as many roots in an interval as its Bernstein coefficients change sign,
//! and differs from that number by an even one. So no change is no root, one change is one root,
//! and more are halved by de Casteljau's algorithm. A coefficient below the noise counts as either
//! sign. Reference: Lane and Riesenfeld, Bounds on a polynomial, BIT 21, 1981.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use arrayvec::ArrayVec;
use fearless_simd::prelude::*;

use super::arcs::ARCS_OF;
use super::brackets::Brackets;
use super::clusters::Clusters;
use super::part::{Coefficients, Part};
use super::polynomial::TrigonometricPolynomial;
use super::tables::{POWERS, QUARTERS};
use crate::lanes::{Column, LANES, Number as _, Vector};

/// Divisions of eight parts each, at most: a double root takes one for each width.
const MOST_DIVISIONS: usize = 96;

/// A count of changes that no coefficients have: stands for an impossible sign.
const NEVER: f64 = -1e3;

/// Blocks of parts that wait for their division, at most: for one polynomial four are enough, and
/// parts are divided before there are more of several.
const MOST_BLOCKS: usize = 6;

/// The findings, and the parts to be divided.
pub(super) struct Search<'a> {
    parts: Parts,
    brackets: &'a mut Brackets,
    clusters: Clusters<'a>,
}

/// Parts to be divided, in blocks of lanes.
struct Parts {
    columns: ArrayVec<Coefficients<Column>, MOST_BLOCKS>,
    all: ArrayVec<Part, { MOST_BLOCKS * LANES }>,
}

impl Parts {
    #[inline(always)]
    fn new() -> Self {
        Self { columns: ArrayVec::new(), all: ArrayVec::new() }
    }

    fn push(&mut self, coefficients: &Coefficients<f64>, part: Part) {
        let (block, lane) = (self.all.len() / LANES, self.all.len() % LANES);
        if lane == 0 {
            // The first of a block stands in its other lanes until there are others.
            self.columns.push(coefficients.map(|coefficient| [coefficient; LANES]));
        } else {
            for (column, coefficient) in self.columns[block].iter_mut().zip(coefficients) {
                column[lane] = *coefficient;
            }
        }
        self.all.push(part);
    }

    /// Divide a block by de Casteljau's algorithm, and remove it: the last full one. Returns its
    /// parts.
    #[inline(always)]
    fn divide<S: Simd>(
        &mut self,
        left: &mut Coefficients<Vector<S>>,
        right: &mut Coefficients<Vector<S>>,
    ) -> ([Part; LANES], usize) {
        let (last, rest) = (self.columns.len() - 1, self.all.len() % LANES);
        let block = if rest > 0 && last > 0 { last - 1 } else { last };
        let first = LANES * block;
        let count = LANES.min(self.all.len() - first);
        let mut parts = [self.all[first]; LANES];
        parts[..count].copy_from_slice(&self.all[first..first + count]);
        let simd = left[0].token();
        for (to, column) in right.iter_mut().zip(&self.columns[block]) {
            *to = Vector::load_array_ref(simd, column);
        }
        left[0] = right[0];
        for row in 1..=POWERS {
            for j in 0..=POWERS - row {
                right[j] = (right[j] + right[j + 1]) * 0.5;
            }
            left[row] = right[0];
        }
        if block < last {
            self.columns[block] = self.columns[last];
            self.all.copy_within(first + LANES.., first);
        }
        self.columns.truncate(last);
        self.all.truncate(self.all.len() - count);
        (parts, count)
    }
}

impl<'a> Search<'a> {
    /// A search that has found nothing yet.
    #[inline(always)]
    pub(super) fn new(brackets: &'a mut Brackets, clusters: Clusters<'a>) -> Self {
        Self { parts: Parts::new(), brackets, clusters }
    }

    /// Find an interval for every root: brackets of simple roots, as wide as they can be, and
    /// clusters.
    pub(super) fn isolate<S: Simd>(&mut self, simd: S, all: &[TrigonometricPolynomial]) {
        // A function of its own for each instruction set: it is long.
        simd.vectorize(
            #[inline(always)]
            || self.isolate_in(simd, all),
        );
    }

    #[inline(always)]
    fn isolate_in<S: Simd>(&mut self, simd: S, all: &[TrigonometricPolynomial]) {
        let zero = Vector::splat(simd, 0.0);
        let (mut columns, mut divisions) = ([[zero; POWERS + 1]; QUARTERS], 0);
        for of in 0..=all.len() {
            // Blocks of parts are divided when they are full, in the end all.
            let most = if of == all.len() { 0 } else { LANES - 1 };
            while self.parts.all.len() > most && divisions < MOST_DIVISIONS * all.len() {
                let [left, right, ..] = &mut columns;
                self.divide(left, right);
                divisions += 1;
            }
            if let Some(polynomial) = all.get(of)
                && !self.clusters.have_abandoned(of)
            {
                polynomial.on_arcs(simd, &mut columns);
                self.begin(&columns, (of, polynomial.noise));
            }
        }
        for part in &self.parts.all {
            self.clusters.take(part);
        }
    }

    /// Begin with a polynomial with this number and noise, on all arcs, by quarters of the circle.
    #[inline(always)]
    fn begin<S: Simd>(
        &mut self,
        quarters: &[Coefficients<Vector<S>>; QUARTERS],
        (of, noise): (usize, f64),
    ) {
        for (columns, arcs) in quarters.iter().zip(&ARCS_OF) {
            let seen = Seen::of(columns, columns[0].like(noise));
            for lane in lanes_of(seen.open) {
                self.take(&seen, lane, Part::whole(of, noise, arcs[lane]));
            }
        }
    }

    #[inline(always)]
    fn divide<S: Simd>(
        &mut self,
        left: &mut Coefficients<Vector<S>>,
        right: &mut Coefficients<Vector<S>>,
    ) {
        let (parts, count) = self.parts.divide(left, right);
        let noise = Vector::load_array(left[0].token(), parts.map(|part| part.noise));
        for (end, columns) in [&*left, &*right].into_iter().enumerate() {
            let seen = Seen::of(columns, noise);
            for lane in lanes_of(seen.open).take_while(|lane| *lane < count) {
                self.take(&seen, lane, parts[lane].halves()[end]);
            }
        }
    }

    /// Decide on one lane that is open: a simple root, a cluster, or a part to be divided.
    #[inline(always)]
    fn take<S: Simd>(&mut self, seen: &Seen<'_, S>, lane: usize, part: Part) {
        if seen.simple >> lane & 1 == 1 {
            self.brackets.push(&part, seen.places[lane], seen.columns[0][lane]);
        } else {
            self.take_rest(&in_lane(seen.columns, lane), seen.many >> lane & 1 == 1, part);
        }
    }

    /// Decide where there is more than one simple root: a function of its own, for it is called in
    /// several places.
    #[inline(never)]
    fn take_rest(&mut self, coefficients: &Coefficients<f64>, has_many: bool, part: Part) {
        let Self { parts, brackets, clusters } = self;
        if clusters.have_abandoned(part.of) {
            return;
        }
        let is_noise = |b: &f64| b.abs() <= part.noise;
        if coefficients.iter().all(is_noise) || clusters.is_narrow(&part) || parts.all.is_full() {
            clusters.take(&part);
        } else if has_many || !part.take_pair(coefficients, brackets, clusters) {
            clusters.pass(&part);
            parts.push(coefficients, part);
        }
    }
}

/// The roots that coefficients show: sets of lanes as bits.
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
    fn of(columns: &'a Coefficients<Vector<S>>, noise: Vector<S>) -> Self {
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
#[expect(clippy::cast_precision_loss, reason = "up to 12")]
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
fn most_changes<S: Simd>(columns: &Coefficients<Vector<S>>, noise: Vector<S>) -> Vector<S> {
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

/// Count where coefficients are below the noise.
#[inline(always)]
fn most_changes_of_any_sign<S: Simd>(
    columns: &Coefficients<Vector<S>>,
    noise: Vector<S>,
) -> Vector<S> {
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
