//! Real roots of a trigonometric polynomial, and clusters of them.

use arrayvec::ArrayVec;

/// How far ends of two arcs that are the same may differ by rounding [rad].
const SEAM: f64 = 1e-14;

/// A root, or a cluster of roots that noise or a small distance does not separate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    /// Ends of the interval that holds it [rad].
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Whether it is one simple root.
    pub(crate) is_simple: bool,
    /// Most roots that are in the interval, with their multiplicity.
    pub(crate) most: usize,
}

impl Root {
    /// Return a simple root [rad].
    pub(super) fn simple(angle: f64, radius: f64) -> Self {
        Self { low: angle - radius, high: angle + radius, is_simple: true, most: 1 }
    }

    /// Return the middle of the interval [rad].
    pub(crate) fn angle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// Return half the width of the interval [rad].
    pub(crate) fn radius(self) -> f64 {
        0.5 * (self.high - self.low)
    }
}

/// All real roots of a polynomial, by increasing angle, in a range of a full turn.
#[derive(Clone, Debug)]
pub(crate) struct Roots {
    pub(super) all: ArrayVec<Root, { Roots::ROOM }>,
    /// Whether nothing was left out: false for a polynomial that is noise, or with more intervals
    /// than there is room for.
    pub(crate) is_complete: bool,
}

impl Roots {
    /// Most intervals that are kept: twice as many as there can be roots.
    pub(crate) const ROOM: usize = 32;

    pub(super) fn push(&mut self, root: Root) {
        if self.all.is_full() {
            self.join();
        }
        self.is_complete &= self.all.try_push(root).is_ok();
    }

    pub(crate) fn as_slice(&self) -> &[Root] {
        &self.all
    }

    /// Set how many there are at most, and remove clusters in which nothing can be.
    pub(crate) fn limit(&mut self, most: impl Fn(&Root) -> usize) {
        self.all.iter_mut().for_each(|root| root.most = most(root));
        self.all.retain(|root| root.most > 0);
    }

    /// Sort by angle, and join clusters that touch one another.
    pub(super) fn join(&mut self) {
        self.all.sort_unstable_by(|a, b| a.low.total_cmp(&b.low));
        let mut kept = 0;
        for index in 1..self.all.len() {
            let (root, last) = (self.all[index], &mut self.all[kept]);
            if !last.is_simple && !root.is_simple && root.low <= last.high + SEAM {
                last.high = last.high.max(root.high);
            } else {
                kept += 1;
                self.all[kept] = root;
            }
        }
        self.all.truncate(kept + 1);
    }
}
