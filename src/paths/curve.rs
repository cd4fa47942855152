//! A cubic in space, by its length.

use nalgebra::Vector3;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use crate::spline::hermite;

/// Even parts of a curve, in each of which its speed has one place at most where it is least: there
/// a curve that nearly stops has a kink of its speed.
const PARTS: usize = 16;

/// Most places at which the speed of a cubic is least.
const MOST_SLOW: usize = 3;

/// Panels, over each of which the length is a sum of five terms: the parts, cut at those places.
const PANELS: usize = PARTS + MOST_SLOW;

/// Halvings that bring a bracket of a place to the last digit.
const HALVINGS: usize = 53;

/// Rounds of Newton's iteration for a place on a curve: it converges in three or four, and halving
/// a panel replaces a step that leaves its bracket.
const MOST_ROUNDS: usize = 60;

/// Gauss' five places in -1 .. 1, one side, and their weights.
const PLACES: [f64; 3] = [0.0, 0.538_469_310_105_683_1, 0.906_179_845_938_664];
const WEIGHTS: [f64; 3] =
    [0.568_888_888_888_888_9, 0.478_628_670_499_366_47, 0.236_926_885_056_189_1];

/// A cubic with a parameter from 0 to 1.
#[derive(Clone)]
pub(super) struct Curve {
    terms: [Vector3<f64>; 4],
    /// Where the panels begin, and the end.
    edges: [f64; PANELS + 1],
    /// Lengths up to the end of each panel [m] (eq. 24).
    lengths: [f64; PANELS],
}

impl Curve {
    /// Between two points with slopes, over a range of the parameter of the spline.
    pub(super) fn new(points: [Vector3<f64>; 2], slopes: [Vector3<f64>; 2], range: f64) -> Self {
        let mut terms = [Vector3::zeros(); 4];
        for axis in 0..3 {
            let ends = points.map(|point| point[axis]);
            let axes = hermite(ends, slopes.map(|slope| slope[axis] * range), 1.0);
            for (term, axis_term) in terms.iter_mut().zip(axes) {
                term[axis] = axis_term;
            }
        }
        let mut curve = Self { terms, edges: [1.0; PANELS + 1], lengths: [0.0; PANELS] };
        for part in 0..PARTS {
            curve.edges[part] = even(part);
        }
        let mut next = PARTS;
        for part in 0..PARTS {
            if let Some(place) = curve.slowest(even(part), even(part + 1))
                && next < PANELS
            {
                curve.edges[next] = place;
                next += 1;
            }
        }
        curve.edges.sort_unstable_by(f64::total_cmp);
        let mut sum = 0.0;
        for panel in 0..PANELS {
            sum += curve.between(curve.edges[panel], curve.edges[panel + 1]);
            curve.lengths[panel] = sum;
        }
        curve
    }

    /// The place between two others at which the speed is least.
    fn slowest(&self, mut low: f64, mut high: f64) -> Option<f64> {
        let [_, c1, c2, c3] = self.terms;
        // Half of the derivative of the speed's square.
        let growth = |u: f64| {
            let first = c1 + (c2 * 2.0 + c3 * (3.0 * u)) * u;
            first.dot(&(c2 * 2.0 + c3 * (6.0 * u)))
        };
        if !(growth(low) < 0.0 && growth(high) > 0.0) {
            return None;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if growth(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }

    /// Length [m].
    pub(super) fn length(&self) -> f64 {
        self.lengths[PANELS - 1]
    }

    /// The point at a part of the length, 0 to 1.
    pub(super) fn at(&self, part: f64) -> Vector3<f64> {
        let [c0, c1, c2, c3] = self.terms;
        let u = self.parameter(part * self.length());
        c0 + (c1 + (c2 + c3 * u) * u) * u
    }

    fn speed(&self, u: f64) -> f64 {
        let [_, c1, c2, c3] = self.terms;
        (c1 + (c2 * 2.0 + c3 * (3.0 * u)) * u).norm()
    }

    /// The length between two parameters, by Gauss' rule.
    fn between(&self, start: f64, end: f64) -> f64 {
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let both =
            |place: f64| self.speed(middle - half * place) + self.speed(middle + half * place);
        let outer = WEIGHTS[1] * both(PLACES[1]) + WEIGHTS[2] * both(PLACES[2]);
        half * (WEIGHTS[0] * self.speed(middle) + outer)
    }

    /// The parameter at a length.
    fn parameter(&self, length: f64) -> f64 {
        let panel = self.lengths[..PANELS - 1].partition_point(|end| *end <= length);
        let before = if panel == 0 { 0.0 } else { self.lengths[panel - 1] };
        let start = self.edges[panel];
        let (mut low, mut high) = (start, self.edges[panel + 1]);
        let rest = length - before;
        let part = rest / (self.lengths[panel] - before);
        // A curve without length is at one place all along.
        let mut u = if part.is_nan() { low } else { low + (high - low) * part };
        for _ in 0..MOST_ROUNDS {
            let off = self.between(start, u) - rest;
            if off.abs() <= f64::EPSILON * self.length() {
                break;
            }
            if off > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let next = u - off / self.speed(u);
            u = if low < next && next < high { next } else { 0.5 * (low + high) };
        }
        u
    }
}

/// Where an even part begins.
#[expect(clippy::cast_precision_loss, reason = "a small count")]
fn even(part: usize) -> f64 {
    part as f64 / PARTS as f64
}
