//! Denavit-Hartenberg tables, modified and standard, converted into one another and never mixed.
//!
//! Reference: Craig, Introduction to Robotics, 2005, section 3.4 (modified); Siciliano et al.,
//! Robotics, 2009, section 2.8.2 (standard).

use nalgebra::{IsometryMatrix3, Matrix3, Rotation3, Translation3};

use crate::error::{Error, ModelFault};
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::{constant_sin_cos, snapped};
use crate::kinematics::thresholds::MOST_SNAP;

/// One row of a Denavit-Hartenberg table; the table that holds it determines the convention.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct DhRow {
    /// Twist about x [rad].
    pub alpha: f64,
    /// Length along x [m].
    pub a: f64,
    /// Offset along z [m].
    pub d: f64,
    /// Angle about z where the joint angle is zero [rad].
    pub theta: f64,
}

impl DhRow {
    /// A row from alpha [rad], a [m], d [m] and the theta offset [rad].
    #[must_use]
    pub const fn new(alpha: f64, a: f64, d: f64, theta: f64) -> Self {
        Self { alpha, a, d, theta }
    }

    /// The row as alpha, a, d, theta.
    #[must_use]
    pub const fn to_array(self) -> [f64; 4] {
        [self.alpha, self.a, self.d, self.theta]
    }

    /// Lengths are not changed: text represents them exactly, unlike right angles.
    fn snapped(self, snap: f64) -> Self {
        Self { alpha: snapped(self.alpha, snap), theta: snapped(self.theta, snap), ..self }
    }
}

/// Modified (Craig) table with its fixed end transforms:
/// `base * prod(Rx(alpha) Tx(a) Rz(theta + q) Tz(d)) * flange`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Mdh<const N: usize> {
    /// Fixed transform before the first row.
    pub base: Pose,
    /// One row per joint.
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    pub rows: [DhRow; N],
    /// Fixed transform after the last row.
    pub flange: Pose,
}

/// Standard table with its fixed end transforms:
/// `base * prod(Rz(theta + q) Tz(d) Tx(a) Rx(alpha)) * flange`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sdh<const N: usize> {
    /// Fixed transform before the first row.
    pub base: Pose,
    /// One row per joint.
    #[cfg_attr(feature = "serde", serde(with = "serde_big_array::BigArray"))]
    pub rows: [DhRow; N],
    /// Fixed transform after the last row.
    pub flange: Pose,
}

impl<const N: usize> Mdh<N> {
    /// Return the table with each alpha and theta within `snap` [rad] of a multiple of 90 deg made
    /// exact, so that 1.5708 becomes a right angle.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when `snap` is not 0 to 1e-3 rad.
    pub fn snapped(mut self, snap: f64) -> Result<Self, Error> {
        check_snap(snap)?;
        self.rows = self.rows.map(|row| row.snapped(snap));
        Ok(self)
    }
}

impl<const N: usize> Sdh<N> {
    /// Return the table with its angles made exact as by [`Mdh::snapped`].
    ///
    /// # Errors
    ///
    /// As [`Mdh::snapped`].
    pub fn snapped(mut self, snap: f64) -> Result<Self, Error> {
        check_snap(snap)?;
        self.rows = self.rows.map(|row| row.snapped(snap));
        Ok(self)
    }
}

/// Check `snap`, how far an angle may be from a multiple of 90 deg to become one: 0 to
/// 1e-3 rad.
#[doc(hidden)]
pub fn check_snap(value: f64) -> Result<(), Error> {
    if (0.0..=MOST_SNAP).contains(&value) {
        Ok(())
    } else {
        Err(ModelFault::Snap { value, bound: MOST_SNAP }.into())
    }
}

impl<const N: usize> From<Sdh<N>> for Mdh<N> {
    /// The twist and length of a standard row follow its joint, in a modified row they precede it:
    /// they shift by one row, and the last row's join the flange.
    fn from(sdh: Sdh<N>) -> Self {
        let (mut alpha, mut a) = (0.0, 0.0);
        let rows = sdh.rows.map(|row| {
            let shifted = DhRow { alpha, a, ..row };
            (alpha, a) = (row.alpha, row.a);
            shifted
        });
        Self { base: sdh.base, rows, flange: screw_x(alpha, a) * sdh.flange }
    }
}

impl<const N: usize> From<Mdh<N>> for Sdh<N> {
    /// The inverse shift: the first modified row's twist and length join the base.
    fn from(mdh: Mdh<N>) -> Self {
        let first = mdh.rows.first().copied().unwrap_or_default();
        let mut rows = mdh.rows;
        for (i, row) in rows.iter_mut().enumerate() {
            let next = mdh.rows.get(i + 1).copied().unwrap_or_default();
            (row.alpha, row.a) = (next.alpha, next.a);
        }
        Self { base: mdh.base * screw_x(first.alpha, first.a), rows, flange: mdh.flange }
    }
}

/// `Rx(alpha) Tx(a)`: the part of a row that does not move.
pub fn screw_x(alpha: f64, a: f64) -> Pose {
    let (sin, cos) = constant_sin_cos(alpha);
    let rotation = Matrix3::new(1.0, 0.0, 0.0, 0.0, cos, -sin, 0.0, sin, cos);
    IsometryMatrix3::from_parts(
        Translation3::new(a, 0.0, 0.0),
        Rotation3::from_matrix_unchecked(rotation),
    )
}
