//! Solutions counted at the roots that they belong to.

use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::{Accepted, Configuration};
use crate::kinematics::structure::trigonometric::{Root, Roots};

/// How far from its interval the angle of a solution may be [rad]: what rounding moves a double
/// root.
pub(crate) const BESIDE: f64 = 1e-5;

impl Root {
    /// Whether an angle is in its interval, or next to it [rad].
    pub(crate) fn is_at(&self, angle: f64) -> bool {
        wrap(angle - self.angle()).abs() <= self.radius() + BESIDE
    }
}

impl Accepted {
    /// Number of solutions at a root, with their multiplicity.
    pub(crate) fn at(&self, root: &Root, root_of: impl Fn(&[f64; 6]) -> f64) -> usize {
        let is_here = |one: &&Configuration| root.is_at(root_of(&one.theta));
        self.as_slice().iter().filter(is_here).map(Configuration::multiplicity).sum()
    }

    /// Whether each of these roots has as many solutions as it can have, away from singularities, no
    /// solution is elsewhere, and all of it is certain.
    pub(crate) fn are_at_all(&self, roots: &Roots, root_of: impl Fn(&[f64; 6]) -> f64) -> bool {
        let all = roots.as_slice();
        roots.is_complete
            && !self.has_singular()
            && self.are_certain(all.iter().map(|root| root.most).sum())
            && all.iter().all(|root| self.at(root, &root_of) >= root.most)
    }
}
