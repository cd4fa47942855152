//! A part of an arc.

use super::roots::Root;
use super::tables::{FIRST, HALF_ARC, POWERS};
use crate::lanes::Number;

/// Bernstein coefficients between the ends of a part.
pub(super) type Coefficients<T> = [T; POWERS + 1];

/// A part of an arc, in 0 ..= 1.
#[derive(Clone, Copy)]
pub(super) struct Part {
    /// Which of several polynomials, and its noise.
    pub(super) of: usize,
    pub(super) noise: f64,
    pub(super) arc: usize,
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Part {
    /// Return a whole arc of a polynomial.
    #[inline(always)]
    pub(super) const fn whole(of: usize, noise: f64, arc: usize) -> Self {
        Self { of, noise, arc, low: 0.0, high: 1.0 }
    }

    #[inline(always)]
    pub(super) fn halves(&self) -> [Self; 2] {
        let middle = 0.5 * (self.low + self.high);
        [self.within(self.low, middle), self.within(middle, self.high)]
    }

    /// Return the part between two places of the arc.
    #[inline(always)]
    pub(super) fn within(&self, low: f64, high: f64) -> Self {
        Self { low, high, ..Self::whole(self.of, self.noise, self.arc) }
    }

    pub(super) fn cluster(&self) -> Root {
        let [low, high] = [self.low, self.high].map(|place| angle(middle(self.arc), place));
        Root { low, high, is_simple: false, most: usize::MAX }
    }
}

/// The middle of an arc [rad].
#[expect(clippy::cast_precision_loss, reason = "one of 32")]
pub(super) fn middle(arc: usize) -> f64 {
    FIRST + (arc as f64 + 0.5) * (2.0 * HALF_ARC)
}

/// The angle at a place of an arc with this middle [rad].
#[inline(always)]
pub(super) fn angle<T: Number>(middle: T, place: T) -> T {
    place.scaled_plus(2.0 * HALF_ARC, middle - middle.like(HALF_ARC))
}
