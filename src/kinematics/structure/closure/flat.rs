//! Findings of one solution where the closure is flat to rounding.
//!
//! Docs: general.md, eq. 103a.

use super::accepted::Accepted;
use super::chain::{Closure, Target};
use super::configuration::{Configuration, Kind};
use super::curve::Point;

/// How far two findings of one solution may be apart [rad]: where solutions of multiplicity six
/// merge, the closure is below its rounding as far as the sixth root of that.
const FARTHEST_FINDING: f64 = 0.02;

/// How far the curve through one finding may be from the other [rad]: the root of rounding.
const SAME_END: f64 = 1e-6;

impl Accepted {
    /// Keep one of the findings between which the chain closes too: the one that closes best.
    /// Returns whether there were others.
    pub(crate) fn merge_flat(&mut self, closure: &Closure, target: &Target) -> bool {
        let count = self.as_slice().len();
        let mut first = 0;
        while first < self.as_slice().len() {
            let mut second = first + 1;
            while second < self.as_slice().len() {
                let pair = [self.as_slice()[first], self.as_slice()[second]];
                if closure.is_flat_between(target, &pair) {
                    let kept = usize::from(pair[1].residual < pair[0].residual);
                    self.replace(first, Configuration { kind: Kind::FOLD, ..pair[kept] });
                    self.remove(second);
                    // What is next to the one that is kept may be anywhere.
                    second = first + 1;
                } else {
                    second += 1;
                }
            }
            first += 1;
        }
        self.as_slice().len() < count
    }
}

impl Closure {
    /// Whether two singular configurations are near one another, and the chain closes on the curve
    /// (99) between them.
    fn is_flat_between(&self, target: &Target, [one, other]: &[Configuration; 2]) -> bool {
        let is_singular = |one: &Configuration| one.is_singular() && !one.is_free();
        let is_near = one.distance(&other.theta) < FARTHEST_FINDING;
        if !(is_singular(one) && is_singular(other) && is_near) {
            return false;
        }
        let Some(curve) = self.curve(target, &one.theta) else { return false };
        let way = one.between(other, 1.0);
        let apart: f64 = (0..6).map(|i| curve.direction()[i] * (way[i] - one.theta[i])).sum();
        let parts = [0.25, 0.5, 0.75, 1.0];
        let wanted = parts.map(|part| Some(curve.at(part * apart, one.between(other, part))));
        let points = self.points(target, &wanted);
        let are_closed =
            points.iter().flatten().filter(|point| point.left.abs() <= self.accepts()).count();
        let is_end = |point: &Point| other.distance(&point.theta) < SAME_END;
        are_closed == parts.len() && points[3].as_ref().is_some_and(is_end)
    }
}
