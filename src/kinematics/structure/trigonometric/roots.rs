//! The real roots of a polynomial: each as an interval.

use core::f64::consts::TAU;

use super::tables::FIRST;

/// Most intervals that are kept: twice as many as there can be roots.
const MOST_ROOTS: usize = 32;

/// A root, or a cluster of roots that noise does not separate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    /// Ends of the interval that holds it [rad].
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Whether it is certain to be one simple root.
    pub(crate) is_simple: bool,
    /// Most roots that are in the interval, with their multiplicity.
    pub(crate) most: usize,
}

impl Root {
    pub(crate) const NONE: Self = Self { low: 0.0, high: 0.0, is_simple: false, most: 0 };

    /// A simple root [rad].
    pub(super) fn simple(angle: f64, radius: f64) -> Self {
        Self { low: angle - radius, high: angle + radius, is_simple: true, most: 1 }
    }

    /// A cluster about an angle in -pi ..= pi [rad].
    pub(crate) fn cluster(angle: f64, radius: f64) -> Self {
        // In the range of the arcs.
        let angle = if angle < FIRST { angle + TAU } else { angle };
        Self { low: angle - radius, high: angle + radius, ..Self::NONE }
    }

    /// Middle of the interval [rad].
    pub(crate) fn angle(self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// Half the width of the interval [rad].
    pub(crate) fn radius(self) -> f64 {
        0.5 * (self.high - self.low)
    }

    /// Whether this is a cluster that has an angle of an interval.
    fn touches(&self, other: &Self) -> bool {
        !self.is_simple && self.low <= other.high && other.low <= self.high
    }
}

/// All real roots of a polynomial, by increasing angle, in a range of a full turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Roots {
    all: [Root; MOST_ROOTS],
    count: usize,
    /// Whether nothing was left out: false for a polynomial that is noise, or with more intervals
    /// than there is room for.
    pub(crate) is_complete: bool,
}

impl Roots {
    pub(super) const NONE: Self =
        Self { all: [Root::NONE; MOST_ROOTS], count: 0, is_complete: true };

    pub(super) fn push(&mut self, root: Root) {
        if self.count == MOST_ROOTS {
            self.join();
        }
        match self.all.get_mut(self.count) {
            Some(place) => {
                *place = root;
                self.count += 1;
            }
            None => self.is_complete = false,
        }
    }

    /// Whether an interval touches a cluster, and is narrower than a part of that.
    pub(super) fn have_at_edge(&self, new: &Root, part: f64) -> bool {
        self.as_slice().iter().any(|one| one.touches(new) && new.radius() <= part * one.radius())
    }

    /// Take a cluster: as a part of one that it touches, if there is one.
    pub(super) fn take_cluster(&mut self, new: &Root) {
        match self.as_mut_slice().iter_mut().find(|one| one.touches(new)) {
            Some(one) => (one.low, one.high) = (one.low.min(new.low), one.high.max(new.high)),
            None => self.push(*new),
        }
    }

    pub(crate) fn as_slice(&self) -> &[Root] {
        &self.all[..self.count]
    }

    pub(super) fn as_mut_slice(&mut self) -> &mut [Root] {
        &mut self.all[..self.count]
    }

    /// Number of simple roots if there is nothing else: the number of solutions.
    #[cfg(test)]
    pub(crate) fn count_if_simple(&self) -> Option<usize> {
        let is_simple = self.is_complete && self.as_slice().iter().all(|root| root.is_simple);
        is_simple.then_some(self.count)
    }

    /// Sort by angle, and join clusters that touch one another.
    pub(super) fn join(&mut self) {
        let roots = &mut self.all[..self.count];
        // An insertion sort: they are few.
        for end in 1..roots.len() {
            let mut place = end;
            while place > 0 && roots[place].low < roots[place - 1].low {
                roots.swap(place, place - 1);
                place -= 1;
            }
        }
        let mut kept = 0_usize;
        for index in 0..self.count {
            let root = self.all[index];
            let last = kept.checked_sub(1).map(|last| &mut self.all[last]);
            match last {
                Some(last) if !last.is_simple && !root.is_simple && root.low <= last.high => {
                    last.high = last.high.max(root.high);
                }
                _ => {
                    self.all[kept] = root;
                    kept += 1;
                }
            }
        }
        self.count = kept;
    }
}
