//! Frames in lanes, as axes and origins: a product of link transforms updates them one axis at a
//! time.

use nalgebra::{Matrix3, Rotation3, Translation3, Vector3};

use crate::kinematics::chain::dh::DhRow;
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::constant_sin_cos;
use crate::lanes::mul_add;

/// The constants of one table row, with the sines computed once.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::kinematics) struct Link {
    pub(in crate::kinematics) sin_alpha: f64,
    pub(in crate::kinematics) cos_alpha: f64,
    pub(in crate::kinematics) a: f64,
    pub(in crate::kinematics) d: f64,
    pub(in crate::kinematics) sin_theta: f64,
    pub(in crate::kinematics) cos_theta: f64,
}

impl Link {
    pub(in crate::kinematics) fn new(row: DhRow) -> Self {
        let (sin_alpha, cos_alpha) = constant_sin_cos(row.alpha);
        let (sin_theta, cos_theta) = constant_sin_cos(row.theta);
        Self { sin_alpha, cos_alpha, a: row.a, d: row.d, sin_theta, cos_theta }
    }
}

/// The components of a vector, each for `W` lanes.
pub(crate) type Vectors<const W: usize> = [[f64; W]; 3];

/// `W` frames side by side.
#[derive(Clone, Copy)]
#[doc(hidden)]
pub struct Axes<const W: usize> {
    pub x: Vectors<W>,
    pub y: Vectors<W>,
    pub z: Vectors<W>,
    pub origin: Vectors<W>,
}

impl<const W: usize> Axes<W> {
    /// Broadcast a frame to every lane.
    #[doc(hidden)]
    pub fn of(pose: &Pose) -> Self {
        let r = pose.rotation.matrix();
        let axis = |j: usize| [[r[(0, j)]; W], [r[(1, j)]; W], [r[(2, j)]; W]];
        let p = &pose.translation.vector;
        Self { x: axis(0), y: axis(1), z: axis(2), origin: [[p.x; W], [p.y; W], [p.z; W]] }
    }

    /// Takes the frames on by `Rx(alpha) Tx(a) Rz(theta + q) Tz(d)`, with the sines and cosines of
    /// q. In place: new frames would be copied for each link.
    #[inline(always)]
    pub(in crate::kinematics) fn advance<const FUSED: bool>(
        &mut self,
        link: Link,
        sin_q: &[f64; W],
        cos_q: &[f64; W],
    ) {
        for lane in 0..W {
            let sin = mul_add::<FUSED>(sin_q[lane], link.cos_theta, cos_q[lane] * link.sin_theta);
            let cos =
                mul_add::<FUSED>(cos_q[lane], link.cos_theta, -(sin_q[lane] * link.sin_theta));
            self.turn::<FUSED>(link, sin, cos, 0, lane);
            self.turn::<FUSED>(link, sin, cos, 1, lane);
            self.turn::<FUSED>(link, sin, cos, 2, lane);
        }
    }

    /// Takes the frames on by `Rx(alpha) Tx(a) Ry(beta) Rz(theta + q) Tz(d)`, with the sines and
    /// cosines of beta and q (docs/theory/calibrate.md, eq. 20 to 22).
    #[inline(always)]
    pub(in crate::kinematics) fn advance_tilted<const FUSED: bool>(
        &mut self,
        link: Link,
        (sin_beta, cos_beta): (f64, f64),
        sin_q: &[f64; W],
        cos_q: &[f64; W],
    ) {
        let screw = Link { d: 0.0, sin_theta: 0.0, cos_theta: 1.0, ..link };
        self.advance::<FUSED>(screw, &[0.0; W], &[1.0; W]);
        for i in 0..3 {
            for lane in 0..W {
                let (x, z) = (self.x[i][lane], self.z[i][lane]);
                self.x[i][lane] = mul_add::<FUSED>(x, cos_beta, -(z * sin_beta));
                self.z[i][lane] = mul_add::<FUSED>(z, cos_beta, x * sin_beta);
            }
        }
        let turn = Link { sin_alpha: 0.0, cos_alpha: 1.0, a: 0.0, ..link };
        self.advance::<FUSED>(turn, sin_q, cos_q);
    }

    /// One component of the step in one lane.
    #[inline(always)]
    fn turn<const FUSED: bool>(&mut self, link: Link, sin: f64, cos: f64, i: usize, lane: usize) {
        let (x, y, z) = (self.x[i][lane], self.y[i][lane], self.z[i][lane]);
        let tilted = mul_add::<FUSED>(y, link.cos_alpha, z * link.sin_alpha);
        let axis = mul_add::<FUSED>(z, link.cos_alpha, -(y * link.sin_alpha));
        self.x[i][lane] = mul_add::<FUSED>(x, cos, tilted * sin);
        self.y[i][lane] = mul_add::<FUSED>(tilted, cos, -(x * sin));
        self.z[i][lane] = axis;
        self.origin[i][lane] =
            mul_add::<FUSED>(x, link.a, mul_add::<FUSED>(axis, link.d, self.origin[i][lane]));
    }

    /// The frames times a constant one.
    #[inline(always)]
    pub(crate) fn times<const FUSED: bool>(&self, last: &Pose) -> Self {
        let r = last.rotation.matrix();
        let columns = [
            [r[(0, 0)], r[(1, 0)], r[(2, 0)]],
            [r[(0, 1)], r[(1, 1)], r[(2, 1)]],
            [r[(0, 2)], r[(1, 2)], r[(2, 2)]],
        ];
        let p = [last.translation.vector.x, last.translation.vector.y, last.translation.vector.z];
        let mut product = *self;
        for lane in 0..W {
            self.combine::<FUSED>(&mut product, columns, p, 0, lane);
            self.combine::<FUSED>(&mut product, columns, p, 1, lane);
            self.combine::<FUSED>(&mut product, columns, p, 2, lane);
        }
        product
    }

    #[inline(always)]
    fn combine<const FUSED: bool>(
        &self,
        product: &mut Self,
        [a, b, c]: [[f64; 3]; 3],
        p: [f64; 3],
        i: usize,
        lane: usize,
    ) {
        product.x[i][lane] = self.along::<FUSED>(a, 0.0, i, lane);
        product.y[i][lane] = self.along::<FUSED>(b, 0.0, i, lane);
        product.z[i][lane] = self.along::<FUSED>(c, 0.0, i, lane);
        product.origin[i][lane] = self.along::<FUSED>(p, self.origin[i][lane], i, lane);
    }

    /// `x v0 + y v1 + z v2 + rest`
    #[inline(always)]
    fn along<const FUSED: bool>(&self, v: [f64; 3], rest: f64, i: usize, lane: usize) -> f64 {
        mul_add::<FUSED>(
            self.x[i][lane],
            v[0],
            mul_add::<FUSED>(self.y[i][lane], v[1], mul_add::<FUSED>(self.z[i][lane], v[2], rest)),
        )
    }

    /// Write the pose of each lane as row-major elements, for as many lanes as there are rows.
    #[inline(always)]
    pub(crate) fn write(&self, rows: &mut [[f64; 16]]) {
        for (lane, row) in rows.iter_mut().enumerate() {
            for i in 0..3 {
                let (left, right) = row[4 * i..4 * i + 4].split_at_mut(2);
                left.copy_from_slice(&[self.x[i][lane], self.y[i][lane]]);
                right.copy_from_slice(&[self.z[i][lane], self.origin[i][lane]]);
            }
            row[12..].copy_from_slice(&[0.0, 0.0, 0.0, 1.0]);
        }
    }

    /// The pose in one lane.
    #[inline(always)]
    #[doc(hidden)]
    pub fn pose(&self, lane: usize) -> Pose {
        let vector = |v: &Vectors<W>| Vector3::new(v[0][lane], v[1][lane], v[2][lane]);
        let axes = Matrix3::from_columns(&[vector(&self.x), vector(&self.y), vector(&self.z)]);
        Pose::from_parts(
            Translation3::from(vector(&self.origin)),
            Rotation3::from_matrix_unchecked(axes),
        )
    }
}
