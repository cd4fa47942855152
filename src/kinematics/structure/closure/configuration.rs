//! A solution of the closure, or the place of two that the pose misses.

use crate::kinematics::pose::angles::wrap;

/// Least singular value below which a candidate is examined as one of a fold or a self-motion [1].
pub(super) const SINGULAR: f64 = 1e-5;

/// Least singular value above which what closes is next to a solution of its own [1]: by the
/// theorem of Newton and Kantorovich, where `6 residual / least^2` is at most a half, six bounding
/// the second derivatives of the conditions.
pub(super) const ISOLATED: f64 = 1e-6;

/// Closure at its extreme value, in roundings, up to which two solutions are one [1].
pub(super) const MERGED: f64 = 2.0;

/// How far from an examined configuration others are the same [rad]: the curve is searched farther.
pub(super) const EXTENT: f64 = 1e-3;

/// Largest distance of two regular configurations that are the same [rad]: their least singular
/// value is above [`SINGULAR`], and two different ones are as far apart as that.
pub(super) const SAME: f64 = 1e-6;

/// What the chain can do at a configuration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Nothing: an isolated solution.
    Regular,
    /// So many solutions have merged here.
    Merged(u8),
    /// Move, its ends standing still: these joints, as far as is known.
    Free([bool; 6]),
    /// The same in two directions, or more.
    Surface([bool; 6]),
}

impl Kind {
    /// Two solutions have merged.
    pub(super) const FOLD: Self = Self::Merged(2);

    /// What moves, but was not walked along yet.
    pub(super) const FREE: Self = Self::Free([false; 6]);
}

/// A solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Configuration {
    /// Angles of the table [rad].
    pub(crate) theta: [f64; 6],
    /// The largest condition that is left [1].
    pub(crate) residual: f64,
    /// The least singular value of the conditions' derivatives, to a small factor [1].
    pub(crate) least: f64,
    pub(crate) kind: Kind,
    /// Whether rounding leaves it where it is, to [`EXTENT`].
    pub(super) is_placed: bool,
}

/// A fold that a pose misses: its solutions are complex.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Missed {
    /// Their real part, where they would merge.
    pub(crate) theta: [f64; 6],
    /// Their imaginary part, by size.
    pub(crate) aside: [f64; 6],
}

impl Missed {
    pub(super) const NONE: Self = Self { theta: [0.0; 6], aside: [0.0; 6] };

    pub(super) fn is(&self, other: &Self) -> bool {
        self.theta.iter().zip(&other.theta).all(|(a, b)| wrap(a - b).abs() < EXTENT)
    }
}

impl Configuration {
    pub(super) const NONE: Self =
        Self { theta: [0.0; 6], residual: 1.0, least: 0.0, kind: Kind::Regular, is_placed: true };

    /// How many solutions this one is.
    pub(crate) fn multiplicity(&self) -> usize {
        if let Kind::Merged(count) = self.kind { count.into() } else { 1 }
    }

    /// Within what distance another one is the same [rad].
    pub(super) fn radius(&self, rounding: f64) -> f64 {
        match self.kind {
            // Half of the distance of a solution that merges with this one is of the order of the
            // least singular value; rounding moves it by its inverse.
            Kind::Regular => {
                (0.1 * self.least).max(2.0 * rounding / self.least.max(1e-9)).min(SAME)
            }
            // Its distance from the exact fold is the root of rounding.
            Kind::Merged(_) | Kind::Free(_) | Kind::Surface(_) => 1e-6,
        }
    }

    /// Whether no joint differs by more than a radius [rad].
    pub(super) fn is_within(&self, radius: f64, other: &[f64; 6]) -> bool {
        self.theta.iter().zip(other).all(|(a, b)| wrap(a - b).abs() <= radius)
    }

    /// Whether it is next to a singularity.
    pub(super) fn is_singular(&self) -> bool {
        self.kind != Kind::Regular || self.least <= SINGULAR
    }

    /// Whether the chain can move there.
    pub(crate) fn is_free(&self) -> bool {
        matches!(self.kind, Kind::Free(_) | Kind::Surface(_))
    }

    /// Whether two directions are free there, or more.
    pub(super) fn is_surface(&self) -> bool {
        matches!(self.kind, Kind::Surface(_))
    }

    /// Angles at a part of the way to another one.
    pub(super) fn between(&self, other: &Self, part: f64) -> [f64; 6] {
        core::array::from_fn(|i| self.theta[i] + part * wrap(other.theta[i] - self.theta[i]))
    }

    /// The largest difference of a joint [rad].
    pub(crate) fn distance(&self, other: &[f64; 6]) -> f64 {
        (0..6).fold(0.0, |most, i| wrap(self.theta[i] - other[i]).abs().max(most))
    }
}
