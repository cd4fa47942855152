//! Clusters of roots: they are kept, or the polynomial is abandoned.

use super::part::Part;
use super::roots::Roots;

/// Width of a part of an arc that is not halved [1]: at first, and if the polynomial is abandoned
/// then, 4e-4 rad; at last 3e-6 rad.
pub(crate) const WIDE: f64 = 1.0 / 512.0;
pub(crate) const NARROW: f64 = 1.0 / (1 << 16) as f64;

/// Parts that wait for their division in a polynomial that is not abandoned, at most.
const MOST_PARTS: usize = 24;

/// The treatment of clusters.
pub(super) enum Clusters<'a> {
    /// Keep them, in parts of a width [1] or more: they are of one polynomial.
    Kept(&'a mut Roots, f64),
    /// Abandon each of several polynomials at its first one.
    Abandoned(&'a mut [Progress]),
}

/// How far the search in a polynomial is that is abandoned if it has a cluster.
#[derive(Clone, Copy)]
pub(crate) struct Progress {
    pub(super) is_abandoned: bool,
    /// Parts that were to be divided.
    parts: usize,
}

impl Progress {
    pub(super) const NEW: Self = Self { is_abandoned: false, parts: 0 };
    pub(super) const ABANDONED: Self = Self { is_abandoned: true, parts: 0 };
}

impl Clusters<'_> {
    /// Whether nothing more is searched in a polynomial.
    pub(super) fn have_abandoned(&self, of: usize) -> bool {
        matches!(self, Self::Abandoned(all) if all[of].is_abandoned)
    }

    /// Whether a part is too narrow to be halved.
    pub(super) fn is_narrow(&self, part: &Part) -> bool {
        let least = if let Self::Kept(_, width) = self { *width } else { WIDE };
        part.high - part.low < 1.5 * least
    }

    /// Count a part that is to be divided: a polynomial with many is abandoned.
    pub(super) fn pass(&mut self, part: &Part) {
        if let Self::Abandoned(all) = self {
            let one = &mut all[part.of];
            one.parts += 1;
            one.is_abandoned |= one.parts > MOST_PARTS;
        }
    }

    pub(super) fn take(&mut self, part: &Part) {
        match self {
            Self::Kept(roots, _) => roots.push(part.cluster()),
            Self::Abandoned(all) => all[part.of] = Progress::ABANDONED,
        }
    }
}
