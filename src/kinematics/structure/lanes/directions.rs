//! Directions in lanes, and their angles.

use crate::lanes::atan2;

/// A direction in a plane, of any length: its sine and its cosine.
pub(crate) type Direction = [f64; 2];

/// `D` directions, each for `W` lanes.
pub(crate) struct Directions<const D: usize, const W: usize> {
    sin: [[f64; W]; D],
    cos: [[f64; W]; D],
    pub(crate) angle: [[f64; W]; D],
}

impl<const D: usize, const W: usize> Directions<D, W> {
    pub(crate) const NEW: Self =
        Self { sin: [[0.0; W]; D], cos: [[0.0; W]; D], angle: [[0.0; W]; D] };

    #[inline(always)]
    pub(crate) fn set(&mut self, number: usize, lane: usize, [sin, cos]: Direction) {
        (self.sin[number][lane], self.cos[number][lane]) = (sin, cos);
    }

    #[inline(always)]
    pub(crate) fn set_lane(&mut self, lane: usize, all: [Direction; D]) {
        for number in 0..D {
            self.set(number, lane, all[number]);
        }
    }

    /// Arc tangents in sequence, independent of one another.
    #[inline(always)]
    pub(crate) fn angles<const FUSED: bool>(&mut self) {
        let (sin, cos) = (self.sin.as_flattened(), self.cos.as_flattened());
        for ((angle, sin), cos) in self.angle.as_flattened_mut().iter_mut().zip(sin).zip(cos) {
            *angle = atan2::<FUSED>(*sin, *cos);
        }
    }

    #[inline(always)]
    pub(crate) fn angles_of(&self, lane: usize) -> [f64; D] {
        let mut angles = [0.0; D];
        for number in 0..D {
            angles[number] = self.angle[number][lane];
        }
        angles
    }
}
