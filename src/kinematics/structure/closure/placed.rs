//! Frames of a chain, one or eight at once.

use crate::kinematics::chain::axes::Link;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::Number;

/// A frame as its axes and its origin.
#[derive(Clone, Copy)]
pub(crate) struct Placed<T> {
    pub(crate) x: [T; 3],
    pub(crate) y: [T; 3],
    pub(crate) z: [T; 3],
    pub(crate) origin: [T; 3],
}

impl<T: Number> Placed<T> {
    #[inline(always)]
    pub(crate) fn of(frame: Frame<T>) -> Self {
        let Frame { rotation: [a, b, c], origin } = frame;
        Self { x: [a[0], b[0], c[0]], y: [a[1], b[1], c[1]], z: [a[2], b[2], c[2]], origin }
    }

    #[inline(always)]
    pub(crate) fn times(&self, by: &Frame<T>) -> Self {
        let mut product = *self;
        for i in 0..3 {
            let row = [self.x[i], self.y[i], self.z[i]];
            let [a, b, c] = &by.rotation;
            product.x[i] = along(row, [a[0], b[0], c[0]]);
            product.y[i] = along(row, [a[1], b[1], c[1]]);
            product.z[i] = along(row, [a[2], b[2], c[2]]);
            product.origin[i] = self.origin[i] + along(row, by.origin);
        }
        product
    }

    /// This frame turned about its z axis.
    #[inline(always)]
    pub(crate) fn turned(&self, sin: T, cos: T) -> Self {
        let mut turned = *self;
        for i in 0..3 {
            turned.x[i] = self.x[i].times_plus(cos, self.y[i] * sin);
            turned.y[i] = self.y[i].times_minus(cos, self.x[i] * sin);
        }
        turned
    }

    /// This frame turned by an angle about its y axis.
    #[inline(always)]
    pub(super) fn tilted(&self, (sin, cos): (f64, f64)) -> Self {
        let mut tilted = *self;
        for i in 0..3 {
            tilted.x[i] = self.x[i].scaled_plus(cos, self.z[i] * -sin);
            tilted.z[i] = self.x[i].scaled_plus(sin, self.z[i] * cos);
        }
        tilted
    }

    /// This frame times `Rx(alpha) Tx(a)` of a link.
    #[inline(always)]
    pub(super) fn screwed(&self, link: &Link) -> Self {
        let mut screwed = *self;
        for i in 0..3 {
            let (y, z) = (self.y[i], self.z[i]);
            screwed.y[i] = y.scaled_plus(link.cos_alpha, z * link.sin_alpha);
            screwed.z[i] = z.scaled_plus(link.cos_alpha, y * -link.sin_alpha);
            screwed.origin[i] = self.x[i].scaled_plus(link.a, self.origin[i]);
        }
        screwed
    }

    /// This frame moved along its z axis.
    #[inline(always)]
    pub(super) fn raised(&self, d: f64) -> Self {
        let mut raised = *self;
        for i in 0..3 {
            raised.origin[i] = self.z[i].scaled_plus(d, self.origin[i]);
        }
        raised
    }
}

#[inline(always)]
fn along<T: Number>(row: [T; 3], by: [T; 3]) -> T {
    row[0].times_plus(by[0], row[1].times_plus(by[1], row[2] * by[2]))
}
