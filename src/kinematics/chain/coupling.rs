//! Axes 2 and 3 coupled: joint 3 is the forearm's pitch, which stays while axis 2 turns.
//!
//! A parallelogram linkage does so, and so does the J2/J3 interaction of Fanuc's controllers, which
//! measure q3 from the base, not from the upper arm. Their q3 is q3 of the serial chain plus q2 or,
//! if axes 2 and 3 turn in opposite senses, minus q2 (docs/theory/spherical_wrist.md, eq. 25).

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::limits::{JointLimits, check, overrun};
use crate::error::{Error, ModelFault};
use crate::kinematics::thresholds::{LIMIT_TOLERANCE, MOST_ANGLE};

/// Convert the controller's joint angles to the serial chain's [rad]; `coupling` is the factor of q2
/// in the controller's q3: 1, -1 or, without a coupling, zero.
#[inline(always)]
pub(crate) fn uncoupled<const N: usize>(mut q: [f64; N], coupling: f64) -> [f64; N] {
    if let ([_, q2, q3, ..], true) = (&mut q[..], coupling != 0.0) {
        let turned = coupling * *q2;
        *q3 = if q2.abs().max(q3.abs()) > MOST_ANGLE { far(*q3, turned) } else { *q3 - turned };
    }
    q
}

/// The difference of two angles with so many turns that it would be rounded by a fraction of a
/// turn, in [-pi, pi] [rad].
#[cold]
fn far(angle: f64, other: f64) -> f64 {
    let ((sin, cos), (other_sin, other_cos)) = (angle.sin_cos(), other.sin_cos());
    (sin * other_cos - cos * other_sin).atan2(cos * other_cos + sin * other_sin)
}

/// Convert the serial chain's joint angles to the controller's [rad], as [`uncoupled`] does back.
pub(crate) fn coupled<const N: usize>(mut q: [f64; N], coupling: f64) -> [f64; N] {
    if let ([_, q2, q3, ..], true) = (&mut q[..], coupling != 0.0) {
        *q3 += coupling * *q2;
    }
    q
}

/// Limits of the linkage.
impl<const N: usize> JointLimits<N> {
    /// Return the limits with linkage limits: (lower, upper) of the serial joint 3, q3 less q2 by
    /// the factor of the coupling [rad], at whatever turn.
    pub(crate) fn with_linkage(
        self,
        linkage: Option<[f64; 2]>,
        coupling: f64,
    ) -> Result<Self, Error> {
        if let Some([lower, upper]) = linkage {
            check(["lower limit of the linkage", "upper limit of the linkage"], 0, [lower, upper])?;
            if lower > upper {
                return Err(ModelFault::EmptyLinkageLimit { lower, upper }.into());
            }
        }
        Ok(self.linked(linkage, coupling))
    }

    /// Return the limits with the linkage limits of `others`.
    pub(crate) fn with_linkage_of(self, others: &Self) -> Self {
        self.linked(others.linkage, others.coupling)
    }

    fn linked(self, linkage: Option<[f64; 2]>, coupling: f64) -> Self {
        Self { linkage, coupling: if linkage.is_some() { coupling } else { 0.0 }, ..self }
    }

    /// (lower, upper) of the serial joint 3 of a robot with coupled axes 2 and 3 [rad], q3 - q2 or,
    /// if these turn in opposite senses, q3 + q2; `None` if the axes are not coupled or the limits
    /// are unknown.
    #[must_use]
    pub fn linkage(&self) -> Option<[f64; 2]> {
        self.linkage
    }

    /// Factor of q2 in the controller's q3; zero without limits of the linkage.
    pub(crate) fn coupling(&self) -> f64 {
        self.coupling
    }

    /// Return the limits of the coupled twin: the limit of joint 3 is the linkage's.
    pub(crate) fn coupled(self, coupling: f64) -> Self {
        let linkage = Some([self.lower[2], self.upper[2]])
            .filter(|linkage| linkage.iter().copied().any(f64::is_finite));
        self.twin(coupling).linked(linkage, coupling)
    }

    /// The limits of the uncoupled arm: the linkage limit, where known, becomes joint 3's.
    pub(crate) fn uncoupled(self, coupling: f64) -> Self {
        let mut twin = self.twin(-coupling).linked(None, 0.0);
        if let Some([lower, upper]) = self.linkage {
            (twin.lower[2], twin.upper[2]) = (lower, upper);
        }
        twin
    }

    /// With joint 3 limited to the range of `q3 + sign * q2`.
    fn twin(mut self, sign: f64) -> Self {
        let (low, high) = (sign * self.lower[1], sign * self.upper[1]);
        let (lower, upper) = (self.lower[2] + low.min(high), self.upper[2] + low.max(high));
        // A bound that exceeds [`MOST_ANGLE`] is no limit.
        self.lower[2] = if lower < -MOST_ANGLE { f64::NEG_INFINITY } else { lower };
        self.upper[2] = if upper > MOST_ANGLE { f64::INFINITY } else { upper };
        self
    }

    /// How far the serial joint 3, at its best 2 pi equivalent, exceeds the linkage limits, beyond
    /// [`LIMIT_TOLERANCE`] [rad]; zero inside.
    #[doc(hidden)]
    pub fn linkage_excess(&self, q: &[f64; N]) -> f64 {
        let excess = self.linkage_overrun(q);
        if excess <= LIMIT_TOLERANCE { 0.0 } else { excess }
    }

    /// How far the serial joint 3, at its best 2 pi equivalent, exceeds the linkage limits [rad];
    /// negative inside.
    #[doc(hidden)]
    pub fn linkage_overrun(&self, q: &[f64; N]) -> f64 {
        let (Some([lower, upper]), [_, q2, q3, ..]) = (self.linkage, &q[..]) else {
            return f64::NEG_INFINITY;
        };
        overrun(lower, upper, q3 - self.coupling * q2)
    }
}
