//! The moments of a line, on which rigid motions act linearly (docs/theory/general.md, eq. 82, 83).

use fearless_simd::prelude::*;

use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{Column, LANES, Number, Vector, cross, dot};

/// Number of moments: `1, p, l, p.p, p.l, p x l, (p.p) l - 2 (p.l) p` of a point p and a direction
/// l.
pub(super) const MOMENTS: usize = 15;

/// Moments that a rotation about z leaves alone: of p, l, p.p, p.l, p x l and the last vector.
pub(super) const ALONG: [usize; 6] = [3, 6, 7, 8, 11, 14];

/// First of the two moments that a rotation about z turns: x and y of the four vectors.
pub(super) const ACROSS: [usize; 4] = [1, 4, 9, 12];

/// Moments, or derivatives of moments: any vector of their space, or one in each lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Moments<T = f64>(pub(super) [T; MOMENTS]);

impl Moments<Column> {
    /// Up to eight, one in each lane.
    pub(super) fn columns(all: &[Moments]) -> Self {
        let mut columns = [[0.0; LANES]; MOMENTS];
        for (lane, moments) in all.iter().enumerate() {
            for (column, moment) in columns.iter_mut().zip(moments.0) {
                column[lane] = moment;
            }
        }
        Self(columns)
    }

    /// The moments after a rigid motion.
    #[inline(always)]
    pub(super) fn all_moved<S: Simd>(&self, simd: S, by: &Frame) -> Self {
        let mut moments = Moments([Vector::splat(simd, 0.0); MOMENTS]);
        for k in 0..MOMENTS {
            moments.0[k] = Vector::load_array_ref(simd, &self.0[k]);
        }
        let moved = moments.moved(&by.in_lanes(moments.0[0]));
        let mut columns = *self;
        for k in 0..MOMENTS {
            columns.0[k] = moved.0[k].to_array();
        }
        columns
    }
}

impl<T: Number> Moments<T> {
    /// The moments after a rigid motion (eq. 83).
    #[inline(always)]
    pub(super) fn moved(&self, by: &Frame<T>) -> Self {
        let (m, t) = (&self.0, by.origin);
        let [p, l] = [by.turned([m[1], m[2], m[3]]), by.turned([m[4], m[5], m[6]])];
        let [w, v] = [by.turned([m[9], m[10], m[11]]), by.turned([m[12], m[13], m[14]])];
        let (tt, tl) = (dot(t, t), dot(t, l));
        let (t_l, t_w) = (cross(t, l), cross(t, w));
        let mut moved = *m;
        moved[7] = dot(t, p).scaled_plus(2.0, tt.times_plus(m[0], m[7]));
        let along = m[8] + tl;
        moved[8] = along;
        for i in 0..3 {
            moved[1 + i] = t[i].times_plus(m[0], p[i]);
            moved[4 + i] = l[i];
            moved[9 + i] = w[i] + t_l[i];
            let rest = t_w[i] + along * t[i];
            moved[12 + i] = rest.scaled_plus(-2.0, tt.times_plus(l[i], v[i]));
        }
        Self(moved)
    }
}

impl Moments {
    /// The moments of the z axis.
    pub(super) const AXIS: Self = {
        let mut moments = [0.0; MOMENTS];
        (moments[0], moments[6]) = (1.0, 1.0);
        Self(moments)
    };

    pub(super) fn unit(k: usize) -> Self {
        let mut moments = [0.0; MOMENTS];
        moments[k] = 1.0;
        Self(moments)
    }

    /// Return the parts that a rotation about z leaves alone, multiplies by the cosine, and by the
    /// sine (eq. 84).
    pub(super) fn harmonics(&self) -> [Self; 3] {
        let (mut along, mut cos, mut sin) = (*self, Self([0.0; MOMENTS]), Self([0.0; MOMENTS]));
        for at in ACROSS {
            let (x, y) = (self.0[at], self.0[at + 1]);
            (along.0[at], along.0[at + 1]) = (0.0, 0.0);
            (cos.0[at], cos.0[at + 1]) = (x, y);
            (sin.0[at], sin.0[at + 1]) = (-y, x);
        }
        [along, cos, sin]
    }

    /// The harmonics of a rotation back, by the angle.
    pub(super) fn back(&self) -> [Self; 3] {
        let [along, cos, sin] = self.harmonics();
        [along, cos, sin.times(-1.0)]
    }

    /// Return the parts of a rotation back times `1 + x^2`, by powers of x, the tangent of half the
    /// angle (eq. 88).
    pub(super) fn powers_back(&self) -> [Self; 3] {
        let [along, cos, sin] = self.back();
        [along.plus(&cos, 1.0), sin.times(2.0), along.plus(&cos, -1.0)]
    }

    fn times(&self, factor: f64) -> Self {
        Self(self.0.map(|x| x * factor))
    }

    fn plus(&self, other: &Self, factor: f64) -> Self {
        Self(core::array::from_fn(|k| self.0[k] + factor * other.0[k]))
    }
}
