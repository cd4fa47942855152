//! The parameters of an ortho-parallel arm with a spherical wrist.

use core::f64::consts::{FRAC_PI_2, PI};

use crate::error::{Error, ModelFault};
use crate::kinematics::chain::dh::{DhRow, Mdh, screw_x};
use crate::kinematics::pose::Pose;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::thresholds::{FORM_TOLERANCE, LEAST_LINK, MOST_ANGLE, MOST_LENGTH};

/// Brandstoetter's parameters of an ortho-parallel basis with a spherical wrist.
///
/// At zero angles the arm is upright along z. `theta = sign * q - offset`, as in the
/// `opw_kinematics` library. Reference: Brandstoetter, Angerer, Hofbaur, "An analytical solution of
/// the inverse kinematics problem of industrial serial manipulators with an ortho-parallel basis
/// and a spherical wrist", 2014.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct OpwParameters {
    /// Distance of axis 2 from axis 1 [m].
    pub a1: f64,
    /// Elbow offset: distance of axis 4 from axis 3 [m]; negative if it raises the forearm of an
    /// ABB arm at zero.
    pub a2: f64,
    /// Lateral offset of the wrist center from the plane through axis 1 [m].
    pub b: f64,
    /// Height of axis 2 [m].
    pub c1: f64,
    /// Upper arm: distance of axis 3 from axis 2 [m].
    pub c2: f64,
    /// Forearm: distance of the wrist center from axis 3, along axis 4 [m].
    pub c3: f64,
    /// Distance of the flange from the wrist center [m].
    pub c4: f64,
    /// Joint offsets [rad].
    pub offsets: [f64; 6],
    /// Joint signs, each 1 or -1.
    pub signs: [i8; 6],
}

/// Added to each theta to get the angle of the modified Denavit-Hartenberg row
/// (docs/spherical_wrist.md, table 1).
const MDH_SHIFT: [f64; 6] = [0.0, -FRAC_PI_2, -FRAC_PI_2, 0.0, 0.0, PI];

impl OpwParameters {
    /// Parameters in meters with ABB's joint convention: axis 3 is at -90 deg where the arm is
    /// straight, all signs are +1.
    #[must_use]
    pub const fn abb(a1: f64, a2: f64, c1: f64, c2: f64, c3: f64, c4: f64) -> Self {
        Self {
            a1,
            a2,
            b: 0.0,
            c1,
            c2,
            c3,
            c4,
            offsets: [0.0, 0.0, -FRAC_PI_2, 0.0, 0.0, 0.0],
            signs: [1; 6],
        }
    }

    /// The parameters, checked, with offsets in (-pi, pi]. A lateral offset within
    /// [`FORM_TOLERANCE`] of zero becomes zero, because an offset changes how the shoulder's
    /// branches meet.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a parameter is not finite, a sign is not 1 or -1, or the upper
    /// arm or forearm has no length.
    pub(crate) fn squared_up(self) -> Result<Self, Error> {
        self.check()?;
        // Full turns of an offset would cost digits of every angle.
        let offsets =
            self.offsets.map(|offset| if offset.abs() > PI { wrap(offset) } else { offset });
        Ok(Self { b: if self.b.abs() <= FORM_TOLERANCE { 0.0 } else { self.b }, offsets, ..self })
    }

    fn check(&self) -> Result<(), Error> {
        let lengths = [
            ("a1", self.a1),
            ("a2", self.a2),
            ("b", self.b),
            ("c1", self.c1),
            ("c2", self.c2),
            ("c3", self.c3),
            ("c4", self.c4),
        ];
        for (field, value) in lengths {
            ModelFault::check(field, 0, value, MOST_LENGTH)?;
        }
        for (i, value) in self.offsets.into_iter().enumerate() {
            ModelFault::check("offset of joint", i + 1, value, MOST_ANGLE)?;
            ModelFault::check_radians("offset of joint", i + 1, value)?;
        }
        for (i, sign) in self.signs.into_iter().enumerate() {
            if sign != 1 && sign != -1 {
                return Err(ModelFault::Sign { joint: i + 1, value: sign.into() }.into());
            }
        }
        let forearm = nalgebra::Vector2::new(self.a2, self.c3).norm();
        for (field, value) in [("upper arm c2", self.c2), ("forearm hypot(a2, c3)", forearm)] {
            if value < LEAST_LINK {
                return Err(ModelFault::TooShort { field, value, bound: LEAST_LINK }.into());
            }
        }
        Ok(())
    }

    /// The modified Denavit-Hartenberg table of the arm.
    ///
    /// A joint of sign -1 flips its frame: `Rz(-q) = Rx(pi) Rz(q) Rx(-pi)`; the last flip remains
    /// in the flange transform.
    #[must_use]
    pub fn mdh(&self) -> Mdh<6> {
        let mut rows = [
            DhRow::new(0.0, 0.0, self.c1, 0.0),
            DhRow::new(-FRAC_PI_2, self.a1, self.b, 0.0),
            DhRow::new(0.0, self.c2, 0.0, 0.0),
            DhRow::new(-FRAC_PI_2, -self.a2, self.c3, 0.0),
            DhRow::new(FRAC_PI_2, 0.0, 0.0, 0.0),
            DhRow::new(-FRAC_PI_2, 0.0, self.c4, 0.0),
        ];
        let mut turned = false;
        for (i, row) in rows.iter_mut().enumerate() {
            row.theta = wrap(MDH_SHIFT[i] - self.offsets[i]);
            let turns = self.signs[i] < 0;
            if turns != turned {
                row.alpha = wrap(row.alpha + PI);
            }
            if turns {
                (row.d, row.theta) = (-row.d, wrap(-row.theta));
            }
            turned = turns;
        }
        let flange = if turned { screw_x(PI, 0.0) } else { Pose::identity() };
        Mdh { base: Pose::identity(), rows, flange }
    }
}
