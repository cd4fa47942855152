//! A solution of the closure, and what makes it regular.

use super::chain::{Closure, Target, largest, sines};
use crate::kinematics::pose::angles::wrap;

/// Residual, in roundings, up to which a configuration closes [1].
const CLOSES: f64 = 20.0;

/// Least singular value above which a configuration is regular [1]. By the theorem of Newton and
/// Kantorovich what closes is then next to exactly one solution: `6 residual / least^2 <= 1/2`, six
/// bounding the second derivatives of the conditions (eq. 98b).
pub(super) const REGULAR: f64 = 1e-5;

/// Least singular value above which the theorem holds for what closes [1].
pub(super) const ISOLATED: f64 = 1e-6;

/// Least singular value up to which a solution is a fold, but for the root of a rounding [1]: above,
/// its twin may be another solution.
const FOLD: f64 = 3e-8;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Configuration {
    /// Angles of the table [rad].
    pub(crate) theta: [f64; 6],
    /// The largest condition that is left [1].
    pub(crate) residual: f64,
    /// The least singular value of the conditions' derivatives, to a small factor [1].
    pub(crate) least: f64,
    /// The joints that move on its self-motion; `None` for an isolated solution.
    pub(crate) moving: Option<[bool; 6]>,
}

impl Configuration {
    /// Return the largest difference of a joint [rad].
    pub(crate) fn distance(&self, other: &[f64; 6]) -> f64 {
        apart(&self.theta, other)
    }

    /// Whether the theorem of Newton and Kantorovich says nothing about it.
    pub(super) fn is_singular(&self) -> bool {
        self.moving.is_some() || self.least <= REGULAR
    }

    /// Whether it is two solutions or more that are one to rounding.
    pub(crate) fn is_fold(&self) -> bool {
        self.moving.is_none() && self.least <= FOLD
    }

    /// Return how many solutions it may be, at least.
    pub(crate) fn weight(&self) -> usize {
        if self.moving.is_some() || self.least <= ISOLATED { 2 } else { 1 }
    }
}

/// Return the largest difference of a joint [rad].
pub(super) fn apart(one: &[f64; 6], other: &[f64; 6]) -> f64 {
    (0..6).fold(0.0, |most, i| wrap(one[i] - other[i]).abs().max(most))
}

impl Closure {
    /// Return the residual up to which a configuration closes [1].
    pub(crate) fn accepts(&self) -> f64 {
        CLOSES * self.rounding
    }

    /// Return the largest condition that a configuration leaves [1].
    pub(super) fn residual(&self, target: &Target, theta: &[f64; 6]) -> f64 {
        let (sin, cos) = sines(theta);
        largest(&self.missing(target, &sin, &cos))
    }
}
