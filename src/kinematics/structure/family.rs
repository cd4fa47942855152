//! Self-motions in closed form: the joint vectors of one pose that a free joint passes through.
//!
//! Docs: singularities.md, section 6.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};
use nalgebra::{Matrix3, Vector3};

use super::free_choice::SeedPolicy;
use super::joint_map::JointMap;
use super::zyz::{First, zyz};

/// The joint vectors of a pose along a free joint: two branches, which meet at corners.
pub(crate) trait Family<const N: usize> {
    /// The members with the free joint at an angle [rad], and whether each is on the second branch;
    /// none where the arm does not reach.
    fn at(&self, angle: f64) -> [Option<([f64; N], bool)>; 2];

    /// The angles of the free joint at which branches meet, end or turn about [rad].
    fn corners(&self) -> [f64; 6];

    /// The bit in which the slots of the two branches differ.
    fn bit(&self) -> usize;

    /// The joints, from 0, that may turn against each other at a corner, and the sign with which
    /// their sum is fixed there.
    fn pair(&self, q: &[f64; N]) -> (usize, usize, f64);
}

/// A joint turns about a line through the center of a spherical wrist or shoulder, and the three
/// axes of that follow: `Rz Ry Rz` of them is `left Rz(-theta) right` (eq. 143).
pub(crate) struct Following<'a, const N: usize> {
    pub(crate) map: &'a JointMap<N>,
    pub(crate) theta: [f64; N],
    /// The free joint and the first of the three, from 0.
    pub(crate) free: usize,
    pub(crate) first: usize,
    pub(crate) left: Matrix3<f64>,
    pub(crate) right: Matrix3<f64>,
    /// The angle that the first of the three takes where it is undetermined [rad].
    pub(crate) rest: f64,
    pub(crate) bit: usize,
}

/// The rotation that takes y to z and z to x: `Ry(a)` is `y_to_z^T Rz(a) y_to_z`.
pub(crate) fn y_to_z() -> Matrix3<f64> {
    Matrix3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
}

/// `Ry(theta)`
pub(crate) fn about_y(theta: f64) -> Matrix3<f64> {
    let (sin, cos) = theta.sin_cos();
    Matrix3::new(cos, 0.0, sin, 0.0, 1.0, 0.0, -sin, 0.0, cos)
}

/// `Rz(-theta) m`
pub(crate) fn turned_back(theta: f64, m: &Matrix3<f64>) -> Matrix3<f64> {
    let (sin, cos) = theta.sin_cos();
    let (x, y) = (m.row(0), m.row(1));
    Matrix3::from_rows(&[x * cos + y * sin, y * cos - x * sin, m.row(2).into()])
}

impl<const N: usize> Family<N> for Following<'_, N> {
    fn at(&self, angle: f64) -> [Option<([f64; N], bool)>; 2] {
        let Self { map, free, first, .. } = *self;
        let mut theta = self.theta;
        theta[free] = map.signs[free] * angle - map.offsets[free];
        let rotation = self.left * turned_back(theta[free], &self.right);
        let rest = First { joint: 0, theta: self.rest, policy: SeedPolicy::Seed };
        let [a, b, c] = zyz(&rotation, &rest, 0.0).theta;
        let joints = |three: [f64; 3]| {
            let mut theta = theta;
            theta[first..first + 3].copy_from_slice(&three);
            map.joints(theta)
        };
        let flipped = b < 0.0;
        [Some((joints([a, b, c]), flipped)), Some((joints([a + PI, -b, c + PI]), !flipped))]
    }

    /// The angles at which the second of the three is the least and the greatest (eq. 144).
    fn corners(&self) -> [f64; 6] {
        let (l, r): (Vector3<f64>, Vector3<f64>) =
            (self.left.row(2).transpose(), self.right.column(2).into());
        let least = (l.x * r.y - l.y * r.x).atan2(l.x * r.x + l.y * r.y);
        let (sign, offset) = (self.map.signs[self.free], self.map.offsets[self.free]);
        [0.0, PI, 0.0, PI, 0.0, PI].map(|turned| sign * (least + turned + offset))
    }

    fn bit(&self) -> usize {
        self.bit
    }

    fn pair(&self, q: &[f64; N]) -> (usize, usize, f64) {
        let (first, signs) = (self.first, self.map.signs);
        let is_folded = self.map.theta(q)[first + 1].cos() < 0.0;
        let sign = signs[first] * signs[first + 2];
        (first, first + 2, if is_folded { -sign } else { sign })
    }
}
