//! Solutions next to a singular configuration: where the closure is zero along the curve through it
//! (eq. 99 to 102).
//!
//! The solutions are the roots of `g(s) = c0 + c1 s + c2 s^2 + ..`: two, one that two merge into,
//! or every s: a self-motion.
//! Reference: Golubitsky and Schaeffer, Singularities and groups in bifurcation theory I, 1985.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::chain::{Closure, Target, largest, sines};
use super::configuration::{Configuration, EXTENT, ISOLATED, Kind, MERGED, Missed};
use super::curve::{Curve, Point, Wanted};
use super::merged::Merged;
use super::powers::{Powers, SPAN, SimpleRoots, complex_beside, value};
use super::surface::{NEARLY_FREE, Surface};
use crate::lanes::LANES;

/// Points to an extreme value or to a root, at most.
const MOST_POINTS: usize = 8;

/// How far along the curve its closure is sampled [rad]: for a fold of rounding's size, 1e5 times
/// the distance of its solutions; the third power is then below 1e-5.
const SAMPLED: f64 = 0.02;

/// Closure at all samples below which a configuration moves freely, in roundings [1]: a curvature
/// of 1e-9, where those of arms are of the order of one.
const FREE: f64 = 100.0;

/// How near the place of an extreme value must be known for what is there to be certain [rad]:
/// rounding moves it by its root over the curvature.
const PLACED: f64 = 1e-5;

/// How far from the start the curve is searched for solutions [rad].
const FARTHEST_ROOT: f64 = 0.2;

/// Half of the second derivative below which more than two solutions may have merged [1].
const FLAT_CURVATURE: f64 = 0.03;

/// How far the closure may be off a parabola, as a part of its value, for the complex roots to be
/// where that has them [1].
const PARABOLIC: f64 = 0.1;

/// Second singular value up to which a candidate may be beside a surface [1].
const BESIDE: f64 = 0.02;

/// What is at a configuration that hardly closes better in one direction.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Settled {
    pub(super) all: Each<Configuration>,
    /// Whether the analysis holds: rank 5, and a curve of second order.
    pub(super) is_certain: bool,
    /// Where two solutions would merge, if the pose misses them.
    pub(super) missed: Option<Missed>,
    /// Where more than two solutions have merged.
    pub(super) merged: Option<Merged>,
}

impl Settled {
    fn of(found: [Option<Configuration>; 2], is_certain: bool) -> Self {
        let mut all = [None; LANES];
        all[..2].copy_from_slice(&found);
        Self { all, is_certain, missed: None, merged: None }
    }

    /// Take what another analysis has found, too.
    fn add(&mut self, other: &Self) {
        let free = self.all.iter_mut().filter(|one| one.is_none());
        for (place, one) in free.zip(other.all.iter().flatten()) {
            *place = Some(*one);
        }
    }
}

/// The extreme value of the closure along a curve.
#[derive(Clone, Copy)]
struct Turning {
    point: Point,
    /// Half of the second derivative there.
    c2: f64,
}

impl Turning {
    /// Whether these points, a root of `-left / c2` to either side of it, are on a parabola.
    fn is_of(&self, points: [Option<Point>; 2]) -> bool {
        let twice = 2.0 * self.point.left;
        let is_on = |point: Point| (point.left - twice).abs() <= PARABOLIC * twice.abs();
        points.into_iter().all(|point| point.is_some_and(is_on))
    }
}

/// Of the curve in each lane.
type Each<T> = [Option<T>; LANES];

/// The curves through eight configurations, for a target.
struct Curves<'a> {
    closure: &'a Closure,
    target: &'a Target,
    all: Each<Curve>,
}

impl Closure {
    /// The solutions next to configurations, at most eight, whose derivatives are nearly singular.
    pub(super) fn settle(&self, target: &Target, all: &[[f64; 6]]) -> [Settled; LANES] {
        let mut curves = Curves { closure: self, target, all: [None; LANES] };
        let mut settled = [Settled::default(); LANES];
        for (index, theta) in all.iter().enumerate() {
            curves.all[index] = self.curve(target, theta);
        }
        curves.settle(&mut settled);
        for (theta, (curve, settled)) in all.iter().zip(curves.all.iter().zip(&mut settled)) {
            self.settle_surface(target, theta, curve.as_ref(), settled);
        }
        settled
    }

    /// Take a configuration of a surface, or where no curve could be followed, without a claim.
    fn settle_surface(
        &self,
        target: &Target,
        theta: &[f64; 6],
        curve: Option<&Curve>,
        settled: &mut Settled,
    ) {
        let mut theta = *theta;
        if let Some(curve) = curve {
            // A candidate beside a surface has a curve, too, along which it is free.
            let free = settled.all[0].filter(|one| one.is_free() && curve.second <= BESIDE);
            let Some(free) = free else { return };
            theta = free.theta;
            if self.curve(target, &theta).is_some_and(|curve| curve.second > NEARLY_FREE) {
                return;
            }
        }
        let Some(surface) = Surface::next_to(self, target, &theta) else { return };
        let one = surface.configuration(&theta);
        if curve.is_none() || one.as_ref().is_some_and(Configuration::is_surface) {
            *settled = Settled::of([one, None], false);
        }
    }

    /// The configuration if it closes.
    pub(super) fn accepted(
        &self,
        target: &Target,
        theta: [f64; 6],
        least: f64,
        kind: Kind,
    ) -> Option<Configuration> {
        let (sin, cos) = sines(&theta);
        let residual = largest(&self.missing(target, &sin, &cos));
        let configuration = Configuration { theta, residual, least, kind, is_placed: true };
        (residual <= self.accepts()).then_some(configuration)
    }
}

impl Curves<'_> {
    /// Find the solutions on the curves: between the samples and the roots is the extreme value.
    fn settle(&self, settled: &mut [Settled; LANES]) {
        let starts = self.points(&|_, curve| Some(curve.at_start()));
        let aheads = self.points(&|lane, curve| Some(curve.at(SAMPLED, starts[lane]?.theta)));
        let (mut singles, mut samples) = ([None; LANES], [None; LANES]);
        let mut is_flat = [false; LANES];
        for lane in 0..LANES {
            let (Some(start), Some(ahead)) = (starts[lane], aheads[lane]) else { continue };
            let c2 = (ahead.slope - start.slope) / (2.0 * (ahead.s - start.s));
            is_flat[lane] = c2.abs() < FLAT_CURVATURE;
            if self.is_free(&start) && self.is_free(&ahead) {
                let free = self.accepted(lane, &start, Kind::FREE);
                settled[lane] = Settled::of([free, None], free.is_some());
            } else if let Some(curve) = self.all[lane].as_ref().filter(|_| is_flat[lane])
                && let Some(merged) = self.merged(curve, settled)
            {
                settled[lane] = merged;
            } else if c2.abs() * FARTHEST_ROOT < 0.5 * start.slope.abs() {
                // Too flat for two solutions in sight: one.
                singles[lane] = Some(start);
            } else {
                samples[lane] = Some([ahead, start]);
            }
        }
        let turnings = self.turnings(samples);
        let mut halves = [None; LANES];
        for (lane, turning) in turnings.iter().enumerate() {
            if let Some(turning) = turning {
                (settled[lane], halves[lane]) = self.at_extreme(lane, turning);
            }
        }
        let mut sides = [-1.0, 1.0].map(|sign| {
            self.points(&|lane, curve| {
                let point = turnings[lane]?.point;
                Some(curve.at(within(point.s + sign * halves[lane]?)?, point.theta))
            })
        });
        for lane in 0..LANES {
            if settled[lane].missed.is_some() {
                // Nothing real is there; what is complex is where a parabola has it, or anywhere.
                let both = sides.each_mut().map(|side| side[lane].take());
                let is_parabola = turnings[lane].is_some_and(|turning| turning.is_of(both));
                settled[lane].missed = settled[lane].missed.filter(|_| is_parabola);
                halves[lane] = None;
            }
        }
        let [before, after] = sides.each_mut().map(|near| self.roots(near));
        let single = self.roots(&mut singles);
        for lane in 0..LANES {
            if singles[lane].is_some() {
                let is_certain = single[lane].is_some_and(|one| one.least > ISOLATED);
                settled[lane] = Settled::of([single[lane], None], is_certain);
            } else if halves[lane].is_some() {
                let pair = [before[lane], after[lane]];
                let are_found = pair.iter().all(Option::is_some);
                settled[lane] = Settled::of(pair, settled[lane].is_certain && are_found);
            }
            // More than two have merged, perhaps, nearer to what was found than to the start.
            if let Settled { all: [Some(one), ..], is_certain: false, .. } = settled[lane]
                && let Some(curve) = self.closure.curve(self.target, &one.theta)
                && let Some(merged) = self.merged(&curve, settled)
            {
                settled[lane] = merged;
            }
            // Or nearly.
            if let Some(curve) = self.all[lane].filter(|_| is_flat[lane])
                && !settled[lane].is_certain
                && let Some(mut all) = self.all_on(&curve)
            {
                if !all.is_certain {
                    // What has merged to rounding is no simple root.
                    all.add(&settled[lane]);
                }
                settled[lane] = all;
            }
        }
    }

    /// The solutions about the start of a curve, if there are any: as many as the polynomial
    /// through its closure has simple roots (eq. 102d).
    fn all_on(&self, curve: &Curve) -> Option<Settled> {
        let powers = self.closure.powers(self.target, curve)?;
        let roots = SimpleRoots::of(&powers, self.closure.accepts());
        let each = Curves { all: roots.all.map(|root| root.map(|_| *curve)), ..*self };
        let mut near = each
            .points(&|lane, curve| roots.all[lane].map(|root| curve.straight_ahead(root * SPAN)));
        let mut all = each.roots(&mut near);
        for (one, root) in all.iter_mut().zip(roots.all) {
            let sides = root.map(|root| [-1.0, 1.0].map(|side| root + side * EXTENT / SPAN));
            let is_off = |at: f64| value(&powers, at).abs() > MERGED * self.closure.rounding;
            if let (Some(one), Some(sides)) = (one, sides) {
                one.is_placed = sides.into_iter().all(is_off);
            }
        }
        let is_certain = roots.are_all
            && all.iter().zip(roots.all).all(|(one, root)| one.is_some() == root.is_some());
        let is_any = all.iter().any(Option::is_some);
        let missed = if is_certain { self.missed_beside(curve, &powers, &roots) } else { None };
        is_any.then_some(Settled { all, missed, ..Settled::of([None; 2], is_certain) })
    }

    /// The two complex solutions next to a single real one.
    fn missed_beside(&self, curve: &Curve, powers: &Powers, roots: &SimpleRoots) -> Option<Missed> {
        let &[Some(root), None, ..] = &roots.all else { return None };
        let [middle, aside] = complex_beside(powers, root)?;
        let [point] =
            self.closure.points(self.target, &[Some(curve.straight_ahead(middle * SPAN))]);
        let aside = curve.direction().map(|part| (aside * SPAN * part).abs());
        point.map(|point| Missed { theta: point.theta, aside })
    }

    /// Where more than two solutions have merged near the start of a curve, if they have.
    fn merged(&self, curve: &Curve, settled: &[Settled; LANES]) -> Option<Settled> {
        let mut known = settled.iter().filter_map(|one| one.merged);
        let known = known.find(|one| one.explains(&curve.start));
        let merged = known.or_else(|| self.closure.merged(self.target, curve))?;
        Some(Settled { merged: Some(merged), ..Settled::of([Some(merged.at), None], true) })
    }

    /// Whether the closure is zero to rounding about a point.
    fn is_free(&self, point: &Point) -> bool {
        point.left.abs().max(SAMPLED * point.slope.abs()) <= FREE * self.closure.rounding
    }

    /// Points of the curves, where one is wanted.
    #[inline(never)]
    fn points(&self, wanted: &dyn Fn(usize, &Curve) -> Option<Wanted<'_>>) -> Each<Point> {
        let of_lane = |lane: usize| wanted(lane, self.all[lane].as_ref()?);
        self.closure.points(self.target, &core::array::from_fn(of_lane))
    }

    fn accepted(&self, lane: usize, point: &Point, kind: Kind) -> Option<Configuration> {
        let least = match kind {
            Kind::Regular => point.slope.abs(),
            Kind::Merged(_) => 0.0,
            Kind::Free(_) | Kind::Surface(_) => self.all[lane]?.least,
        };
        self.closure.accepted(self.target, point.theta, least, kind)
    }

    /// Where the closure along the curves has its extreme value, by the secant method on its slope.
    fn turnings(&self, mut samples: Each<[Point; 2]>) -> Each<Turning> {
        let mut turnings = [None; LANES];
        for _ in 0..MOST_POINTS {
            let mut ahead = [None; LANES];
            for lane in 0..LANES {
                let Some([before, point]) = samples[lane] else { continue };
                let c2 = (point.slope - before.slope) / (2.0 * (point.s - before.s));
                let step = -0.5 * point.slope / c2;
                // The extreme value is then known to less than rounding.
                if c2.abs() * step * step <= 0.1 * self.closure.rounding && step.abs() < SAMPLED {
                    turnings[lane] = Some(Turning { point, c2 });
                } else {
                    ahead[lane] = within(point.s + step);
                }
            }
            if ahead.iter().all(Option::is_none) {
                break;
            }
            let points = self.points(&|lane, curve| {
                let [_, point] = samples[lane]?;
                Some(curve.at(ahead[lane]?, point.theta))
            });
            for (sample, point) in samples.iter_mut().zip(points) {
                *sample = sample.zip(point).map(|([_, before], point)| [before, point]);
            }
        }
        turnings
    }

    /// What an extreme value tells, and how far to either side of it the roots are, real or not.
    fn at_extreme(&self, lane: usize, turning: &Turning) -> (Settled, Option<f64>) {
        let Turning { point, c2 } = *turning;
        let rounding = self.closure.rounding;
        // Next to a self-motion the closure is flat to rounding: where its extreme value is, and
        // how many points close, is not certain (eq. 102b).
        let is_bent = c2.abs() * PLACED * PLACED > MERGED * rounding;
        if point.left.abs() <= MERGED * rounding {
            let is_placed = c2.abs() * EXTENT * EXTENT > MERGED * rounding;
            let merged = self.accepted(lane, &point, Kind::FOLD);
            let merged = merged.map(|one| Configuration { is_placed, ..one });
            return (Settled::of([merged, None], is_bent && merged.is_some()), None);
        }
        let half = (point.left / c2).abs().sqrt();
        let none = Settled::of([None; 2], is_bent);
        if point.left / c2 < 0.0 {
            return (none, Some(half));
        }
        let aside = self.all[lane].map(|curve| curve.direction().map(|part| (half * part).abs()));
        let missed = aside.map(|aside| Missed { theta: point.theta, aside });
        (Settled { missed, ..none }, Some(half))
    }

    /// The roots of the closure near points, by Newton's method.
    fn roots(&self, near: &mut Each<Point>) -> Each<Configuration> {
        for _ in 0..MOST_POINTS {
            let mut ahead = [None; LANES];
            for (point, ahead) in near.iter_mut().zip(&mut ahead) {
                let Some(one) = point else { continue };
                if one.left.abs() > 0.5 * self.closure.rounding {
                    *ahead = within(one.s - one.left / one.slope);
                    *point = point.filter(|_| ahead.is_some());
                }
            }
            if ahead.iter().all(Option::is_none) {
                break;
            }
            let points =
                self.points(&|lane, curve| Some(curve.at(ahead[lane]?, near[lane]?.theta)));
            for lane in 0..LANES {
                if ahead[lane].is_some() {
                    near[lane] = points[lane];
                }
            }
        }
        core::array::from_fn(|lane| self.accepted(lane, near[lane].as_ref()?, Kind::Regular))
    }
}

/// A place on a curve, if it is in sight.
fn within(s: f64) -> Option<f64> {
    (s.abs() <= FARTHEST_ROOT).then_some(s)
}
