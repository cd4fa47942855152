//! Axes 2 and 3 coupled by a parallelogram linkage, or not.

use super::Robot;
use crate::error::{Error, ModelFault};
use crate::kinematics::structure::spherical_wrist::SphericalWrist;

impl<const N: usize> Robot<N> {
    /// Return the robot with limits of the linkage that couples axes 2 and 3: (lower, upper) of q3
    /// - q2 [rad], compared modulo 2 pi; `None` for no limits.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a limit is NaN, the lower one is above the upper one, or axes 2
    /// and 3 are not coupled.
    pub fn with_linkage_limits(mut self, linkage: Option<[f64; 2]>) -> Result<Self, Error> {
        if linkage.is_some() && !self.is_coupled() {
            return Err(ModelFault::NoLinkage.into());
        }
        self.limits = self.limits.with_linkage(linkage)?;
        Ok(self.joined())
    }

    /// Return the arm with axes 2 and 3 coupled by a parallelogram linkage: joint 3 becomes q3 +
    /// q2, as its controller reports it.
    ///
    /// The limit of joint 3 becomes the limit of the linkage. The new range of joint 3 is the sum
    /// of the ranges of axis 2 and the linkage, and its speed the sum of both speeds; coupling and
    /// uncoupling an arm therefore widens both.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] for an arm without a spherical wrist, or whose axes 2 and 3 turn in
    /// opposite senses.
    pub fn coupled(mut self) -> Result<Self, Error> {
        if self.is_coupled() {
            return Ok(self);
        }
        self.check_linkage()?;
        self.chain = self.chain.with_coupling(true);
        self.limits = self.limits.coupled();
        Ok(self.with_twins_velocity().joined())
    }

    /// Return the arm without the coupling of axes 2 and 3: joint 3 becomes q3 - q2. Returns an
    /// uncoupled arm unchanged.
    ///
    /// The limit of joint 3 is the limit of the linkage or, if unknown, the difference of the
    /// ranges of axes 2 and 3, and its speed is the sum of both speeds; coupling and uncoupling an
    /// arm therefore widens both.
    #[must_use]
    pub fn uncoupled(mut self) -> Self {
        if !self.is_coupled() {
            return self;
        }
        self.chain = self.chain.with_coupling(false);
        self.limits = self.limits.uncoupled();
        self.with_twins_velocity().joined()
    }

    /// Check that a parallelogram linkage may couple axes 2 and 3.
    pub(super) fn check_linkage(&self) -> Result<(), Error> {
        let wrist = self.spherical_wrist().ok_or("the arm has no spherical wrist");
        let may_be_coupled = wrist.and_then(SphericalWrist::may_be_coupled);
        may_be_coupled.map_err(|reason| ModelFault::NotCoupled { reason }.into())
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

    /// Whether a parallelogram linkage couples axes 2 and 3: q3 is then measured from the base, not
    /// from the upper arm.
    #[must_use]
    pub fn is_coupled(&self) -> bool {
        self.chain.is_coupled()
    }

    /// Couple the arm or not, with the unchanged limits of its controller.
    pub(crate) fn with_coupling(mut self, coupled: bool) -> Self {
        self.chain = self.chain.with_coupling(coupled);
        self.joined()
    }
}
