//! What becomes of clusters of roots: they are kept, or the polynomial is left.

use super::part::Part;
use super::roots::Roots;

/// Width of a part of an arc that is not divided [1]: 5e-8 rad.
const LEAST_WIDTH: f64 = 1.0 / (1 << 22) as f64;

/// The same for a polynomial that is left if it has a cluster: 4e-4 rad.
const WIDE: f64 = 1.0 / 512.0;

/// Parts that wait for their division in a polynomial that is not left, at most.
const MOST_PARTS: usize = 24;

/// Width of a part at the edge of a cluster, relative to the cluster's, up to which it is taken as
/// part of it [1].
const EDGE: f64 = 0.125;

/// What becomes of clusters.
pub(super) enum Clusters<'a> {
    /// They are kept: those of one polynomial.
    Kept(&'a mut Roots),
    /// They are not: each of several polynomials is left at its first one.
    Left(&'a mut [Progress]),
}

/// How far the search in a polynomial is that is left if it has a cluster.
#[derive(Clone, Copy)]
pub(super) struct Progress {
    pub(super) is_left: bool,
    /// Parts that were to be divided.
    parts: usize,
}

impl Progress {
    pub(super) const NEW: Self = Self { is_left: false, parts: 0 };
    pub(super) const LEFT: Self = Self { is_left: true, parts: 0 };
}

impl Clusters<'_> {
    /// Whether nothing more is searched in a polynomial.
    pub(super) fn is_left(&self, of: usize) -> bool {
        matches!(self, Self::Left(all) if all[of].is_left)
    }

    /// Whether a part is too narrow to be divided.
    pub(super) fn is_narrow(&self, part: &Part) -> bool {
        let least = if matches!(self, Self::Kept(_)) { LEAST_WIDTH } else { WIDE };
        part.high - part.low < 1.5 * least
    }

    /// Whether a part is at the edge of a cluster, and narrow beside it.
    pub(super) fn have_at_edge(&self, part: &Part) -> bool {
        matches!(self, Self::Kept(roots) if roots.have_at_edge(&part.cluster(), EDGE))
    }

    /// A part is to be divided: a polynomial with many is left.
    pub(super) fn pass(&mut self, part: &Part) {
        if let Self::Left(all) = self {
            let one = &mut all[part.of];
            one.parts += 1;
            one.is_left |= one.parts > MOST_PARTS;
        }
    }

    /// Take a cluster: as a part of one that it touches, if there is one.
    pub(super) fn take(&mut self, part: &Part) {
        match self {
            Self::Kept(roots) => roots.take_cluster(&part.cluster()),
            Self::Left(all) => all[part.of] = Progress::LEFT,
        }
    }
}
