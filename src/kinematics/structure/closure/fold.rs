//! Solutions next to a singular configuration: along the direction in which the closure hardly
//! changes, it is a function of one variable (eq. 99 to 102).
//!
//! With the least singular vectors u, v of the derivatives J, the configurations `q(s)` that close
//! up to a part `g(s) u`, and are s ahead along v, are a curve: the bordered system
//!
//! ```text
//! [ J    u ] [ dq ]   [ missing              ]
//! [ v^T  0 ] [ g  ] = [ s - v (q - q_start)  ]
//! ```
//!
//! is regular where J has rank 5. The solutions are the roots of `g(s) = c0 + c1 s + c2 s^2 + ..`:
//! two, one that two merge into, or every s: a self-motion.
//! Reference: Golubitsky and Schaeffer, Singularities and groups in bifurcation theory I, 1985.

use nalgebra::{SMatrix, SVector};

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::accepted::{Configuration, ISOLATED, Kind, Missed};
use super::chain::{Closure, Target, largest, sines};

/// Steps of Newton's method along the curve, at most.
const MOST_STEPS: usize = 8;

/// Sweeps of a singular value decomposition, at most.
pub(super) const SWEEPS: usize = 60;

/// How far along the curve its closure is sampled [rad]: for a fold of rounding's size, 1e5 times
/// the distance of its solutions; the third power is then below 1e-5.
const SAMPLED: f64 = 0.02;

/// Closure at all samples below which a configuration moves freely, in roundings [1]: a curvature
/// of 1e-9, where those of arms are of the order of one.
const FREE: f64 = 100.0;

/// Closure at its extreme value, in roundings, up to which two solutions are one [1].
const MERGED: f64 = 2.0;

/// How near the place of an extreme value must be known for what is there to be certain [rad]:
/// rounding moves it by its root over the curvature.
const PLACED: f64 = 1e-5;

/// How far from the start the curve is searched for solutions [rad].
const FARTHEST: f64 = 0.2;

/// Second singular value below which two directions are free, which is not analyzed [1].
pub(super) const SECOND: f64 = 1e-6;

/// What is at a configuration that hardly closes better in one direction.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Settled {
    pub(super) all: [Option<Configuration>; 2],
    /// Whether the analysis holds: rank 5, and a curve of second order.
    pub(super) is_certain: bool,
    /// Where two solutions would merge, if the pose misses them.
    pub(super) missed: Option<Missed>,
}

impl Settled {
    fn of(all: [Option<Configuration>; 2], is_certain: bool) -> Self {
        Self { all, is_certain, missed: None }
    }
}

/// The curve through a start: along v, with the closure left along u.
pub(super) struct Curve<'a> {
    closure: &'a Closure,
    target: &'a Target,
    start: [f64; 6],
    u: SVector<f64, 6>,
    pub(super) v: SVector<f64, 6>,
    /// The least singular value.
    pub(super) least: f64,
}

impl Closure {
    /// The solutions next to a configuration whose derivatives are nearly singular.
    pub(super) fn settle(&self, target: &Target, theta: &[f64; 6]) -> Settled {
        self.settled(target, theta).unwrap_or_default()
    }

    fn settled(&self, target: &Target, theta: &[f64; 6]) -> Option<Settled> {
        let Some(curve) = self.curve(target, theta) else {
            return self.unanalyzed(target, theta);
        };
        let start = curve.at(0.0, theta)?;
        let ahead = curve.at(SAMPLED, &start.theta)?;
        let free = FREE * self.rounding;
        let is_free = |point: &Point| point.left.abs().max(SAMPLED * point.slope.abs()) <= free;
        if is_free(&start) && is_free(&ahead) {
            let free = self.accepted(target, start.theta, curve.least, Kind::Free);
            return Some(Settled::of([free, None], free.is_some()));
        }
        curve.solutions(start, ahead)
    }

    /// The curve through a configuration; none where two directions are free.
    pub(super) fn curve<'a>(&'a self, target: &'a Target, theta: &[f64; 6]) -> Option<Curve<'a>> {
        let (jacobian, _) = self.linear(target, theta);
        let svd = jacobian.try_svd(true, true, f64::EPSILON, SWEEPS)?;
        // The decomposition sorts by size.
        let (second, least) = (svd.singular_values[4], svd.singular_values[5]);
        let (u, v) = (svd.u?.column(5).into_owned(), svd.v_t?.row(5).transpose());
        (second > SECOND).then_some(Curve { closure: self, target, start: *theta, u, v, least })
    }

    /// A configuration with two free directions: taken if it closes, without a claim.
    fn unanalyzed(&self, target: &Target, theta: &[f64; 6]) -> Option<Settled> {
        let one = self.accepted(target, *theta, 0.0, Kind::Fold)?;
        Some(Settled::of([Some(one), None], false))
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
        let configuration = Configuration { theta, residual, least, kind };
        (residual <= self.accepts()).then_some(configuration)
    }

    /// Derivatives and missing conditions at angles.
    pub(super) fn linear(
        &self,
        target: &Target,
        theta: &[f64; 6],
    ) -> (SMatrix<f64, 6, 6>, SVector<f64, 6>) {
        let (sin, cos) = sines(theta);
        let conditions = self.conditions(target, &sin, &cos);
        (
            SMatrix::from_fn(|row, joint| conditions.columns[joint][row]),
            SVector::from_fn(|row, _| conditions.missing[row]),
        )
    }
}

/// A point of a curve.
#[derive(Clone, Copy)]
pub(super) struct Point {
    s: f64,
    pub(super) theta: [f64; 6],
    /// The closure that is left along u, and its derivative by s.
    pub(super) left: f64,
    slope: f64,
}

impl Curve<'_> {
    /// The point s ahead, by Newton's method from a guess.
    pub(super) fn at(&self, s: f64, guess: &[f64; 6]) -> Option<Point> {
        let mut theta = *guess;
        let mut before = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            let (jacobian, missing) = self.closure.linear(self.target, &theta);
            let mut bordered = SMatrix::<f64, 7, 7>::zeros();
            bordered.fixed_view_mut::<6, 6>(0, 0).copy_from(&jacobian);
            bordered.fixed_view_mut::<6, 1>(0, 6).copy_from(&self.u);
            bordered.fixed_view_mut::<1, 6>(6, 0).copy_from(&self.v.transpose());
            let ahead: f64 = (0..6).map(|i| self.v[i] * (theta[i] - self.start[i])).sum();
            // The step, and the derivatives by s.
            let mut right = SMatrix::<f64, 7, 2>::zeros();
            right.fixed_view_mut::<6, 1>(0, 0).copy_from(&missing);
            (right[(6, 0)], right[(6, 1)]) = (s - ahead, 1.0);
            let step = bordered.lu().solve(&right)?;
            let size = step.fixed_view::<6, 1>(0, 0).amax();
            if size.is_nan() || size > 1.0 {
                return None;
            }
            for joint in 0..6 {
                theta[joint] += step[(joint, 0)];
            }
            // From here on rounding no longer shrinks it.
            if size < 1e-15 || (size < 1e-8 && size > 0.01 * before) {
                return Some(Point { s, theta, left: step[(6, 0)], slope: step[(6, 1)] });
            }
            before = size;
        }
        None
    }

    /// The roots of the closure along the curve.
    fn solutions(&self, start: Point, ahead: Point) -> Option<Settled> {
        let c2 = (ahead.slope - start.slope) / (2.0 * (ahead.s - start.s));
        // Too flat for two solutions in sight: one.
        if c2.abs() * FARTHEST < 0.5 * start.slope.abs() {
            let one = self.root(start);
            let is_certain = one.is_some_and(|one| one.least > ISOLATED);
            return Some(Settled::of([one, None], is_certain));
        }
        let (turning, c2) = self.turning(ahead, start)?;
        let extreme = turning.left;
        // Next to a self-motion the closure is flat to rounding: where its extreme value is, and
        // how many points close, is not certain (eq. 102b).
        let rounding = self.closure.rounding;
        let is_bent = c2.abs() * PLACED * PLACED > MERGED * rounding;
        if extreme.abs() <= MERGED * rounding {
            let merged = self.closure.accepted(self.target, turning.theta, 0.0, Kind::Fold);
            return Some(Settled::of([merged, None], is_bent && merged.is_some()));
        }
        if extreme / c2 > 0.0 {
            let none = Settled::of([None; 2], is_bent);
            let half = (extreme / c2).sqrt();
            let aside = core::array::from_fn(|joint| (half * self.v[joint]).abs());
            let missed = Some(Missed { theta: turning.theta, aside });
            return Some(Settled { missed, ..none });
        }
        let half = (-extreme / c2).sqrt();
        let root = |s: f64| self.root(self.at(s, &turning.theta)?);
        let (one, other) = (root(turning.s - half), root(turning.s + half));
        Some(Settled::of([one, other], is_bent && one.is_some() && other.is_some()))
    }

    /// Where the closure along the curve has its extreme value, by the secant method on its slope,
    /// and half of its second derivative there.
    fn turning(&self, mut before: Point, mut point: Point) -> Option<(Point, f64)> {
        for _ in 0..MOST_STEPS {
            let c2 = (point.slope - before.slope) / (2.0 * (point.s - before.s));
            let step = -0.5 * point.slope / c2;
            // The extreme value is then known to less than rounding.
            if c2.abs() * step * step <= 0.1 * self.closure.rounding && step.abs() < SAMPLED {
                return Some((point, c2));
            }
            let s = point.s + step;
            if s.is_nan() || s.abs() > FARTHEST {
                return None;
            }
            (before, point) = (point, self.at(s, &point.theta)?);
        }
        None
    }

    /// A root of the closure near a point, by Newton's method.
    fn root(&self, mut point: Point) -> Option<Configuration> {
        for _ in 0..MOST_STEPS {
            let step = -point.left / point.slope;
            if point.left.abs() <= 0.5 * self.closure.rounding {
                break;
            }
            let s = point.s + step;
            if s.is_nan() || s.abs() > FARTHEST {
                return None;
            }
            point = self.at(s, &point.theta)?;
        }
        self.closure.accepted(self.target, point.theta, point.slope.abs(), Kind::Regular)
    }
}
