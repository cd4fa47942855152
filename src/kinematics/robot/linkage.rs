//! Axes 2 and 3 coupled, by a parallelogram linkage or by the controller, or not.

use alloc::format;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::Robot;
use crate::error::{Error, ModelFault};
use crate::kinematics::thresholds::FAR_FROM_NOMINAL;

impl<const N: usize> Robot<N> {
    /// Return the robot with limits of the linkage that couples axes 2 and 3: (lower, upper) of the
    /// serial joint 3 [rad], q3 of the [`Robot::uncoupled`] twin, compared modulo 2 pi; `None` for
    /// no limits.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a limit is NaN, the lower one is above the upper one, or axes 2
    /// and 3 are not coupled.
    pub fn with_linkage_limits(mut self, linkage: Option<[f64; 2]>) -> Result<Self, Error> {
        if linkage.is_some() && !self.is_coupled() {
            return Err(ModelFault::NoLinkage.into());
        }
        self.limits = self.limits.with_linkage(linkage, self.coupling())?;
        Ok(self.joined())
    }

    /// Return the arm with axes 2 and 3 coupled: joint 3 is measured from the base, as controllers
    /// report it of arms with a parallelogram linkage, and Fanuc's of all. It becomes q3 + q2 or, if
    /// axes 2 and 3 turn in opposite senses, as in Fanuc's URDFs, q3 - q2.
    ///
    /// The limit of joint 3 becomes the limit of the linkage. The new range of joint 3 is the sum
    /// of the ranges of axis 2 and the linkage, and its speed the sum of both speeds; coupling and
    /// uncoupling an arm therefore widens both.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when axes 2 and 3 are not parallel, for an arm of seven joints, and
    /// for a GoFa, whose controller measures joint 3 from the upper arm.
    pub fn coupled(mut self) -> Result<Self, Error> {
        if self.is_coupled() {
            return Ok(self);
        }
        self.check_linkage()?;
        let coupling = self.sense();
        self.chain = self.chain.with_coupling(coupling);
        self.limits = self.limits.coupled(coupling);
        Ok(self.with_twins_velocity().joined())
    }

    /// Return the arm without the coupling of axes 2 and 3: joint 3 is measured from the upper arm.
    /// It becomes q3 - q2 or, if axes 2 and 3 turn in opposite senses, q3 + q2. Returns an uncoupled
    /// arm unchanged.
    ///
    /// The limit of joint 3 is the limit of the linkage or, if unknown, the difference of the
    /// ranges of axes 2 and 3, and its speed is the sum of both speeds; coupling and uncoupling an
    /// arm therefore widens both.
    #[must_use]
    pub fn uncoupled(mut self) -> Self {
        if !self.is_coupled() {
            return self;
        }
        self.limits = self.limits.uncoupled(self.coupling());
        self.chain = self.chain.with_coupling(0.0);
        self.with_twins_velocity().joined()
    }

    /// Check that axes 2 and 3 may be coupled: parallel, as q2 and q3 are then parts of one pitch.
    pub(super) fn check_linkage(&self) -> Result<(), Error> {
        let apart = self.mdh().rows[2].alpha.sin().abs();
        let reason = if apart > FAR_FROM_NOMINAL {
            let [apart, bound] = [apart.asin(), FAR_FROM_NOMINAL].map(f64::to_degrees);
            format!("they are {apart:.1} deg off parallel, at most {bound:.1} deg is possible")
        } else if N != 6 {
            format!("the arm has {N} joints, a linkage needs six")
        } else if self.own_rule().is_some() {
            "the controller of this arm measures joint 3 from the upper arm".into()
        } else {
            return Ok(());
        };
        Err(ModelFault::NotCoupled { reason }.into())
    }

    /// 1 if axes 2 and 3 turn in the same sense, -1 if in opposite senses.
    fn sense(&self) -> f64 {
        self.mdh().rows[2].alpha.cos().signum()
    }

    /// Factor of q2 in joint 3, q3 = q3_serial + coupling * q2: 1, -1 or, without a coupling, zero.
    #[must_use]
    pub fn coupling(&self) -> f64 {
        self.chain.coupling()
    }

    /// Joint 3 of the converted arm turns as fast as joints 2 and 3 of the arm together.
    fn with_twins_velocity(mut self) -> Self {
        if let Some([_, second, third, ..]) =
            self.max_velocity.as_mut().map(|velocity| &mut velocity[..])
        {
            *third += *second;
        }
        self
    }

    /// Whether axes 2 and 3 are coupled, by a parallelogram linkage or by the controller: q3 is then
    /// measured from the base, not from the upper arm.
    #[must_use]
    pub fn is_coupled(&self) -> bool {
        self.coupling() != 0.0
    }

    /// Return the robot with the coupling and the limits of another one.
    pub(super) fn with_coupling_of(mut self, other: &Self) -> Result<Self, Error> {
        if other.is_coupled() {
            self.check_linkage()?;
        }
        self.chain = self.chain.with_coupling(other.coupling());
        self.limits = other.limits;
        Ok(self.joined())
    }

    /// Couple the arm or not, with the unchanged limits of its controller.
    pub(crate) fn with_coupling(mut self, coupled: bool) -> Self {
        let coupling = if coupled { self.sense() } else { 0.0 };
        self.chain = self.chain.with_coupling(coupling);
        self.joined()
    }
}
