//! Axes 2 and 3 coupled by a parallelogram linkage, or not.

use super::Robot;
use crate::error::{Error, ModelFault};
use crate::kinematics::structure::any::AnyStructure;
use crate::kinematics::structure::arity::{Arity, Joints};

impl<const N: usize> Robot<N>
where
    Joints<N>: Arity<N>,
{
    /// The same robot with limits of the linkage that couples axes 2 and 3: (lower, upper) of q3 -
    /// q2 [rad], at whatever turn; `None` for none.
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

    /// The twin of this arm whose axes 2 and 3 a parallelogram couples: its joint 3 is this one's
    /// plus joint 2, as its controller tells it.
    ///
    /// What was the limit of joint 3 is that of the linkage; joint 3 may stand wherever axes 2 and
    /// the linkage let it, and turns as fast as both together: there and back again widens both.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] for an arm without a spherical wrist, or whose axes 2 and 3 turn in
    /// opposite senses.
    pub fn coupled(mut self) -> Result<Self, Error> {
        if self.is_coupled() {
            return Ok(self);
        }
        let may_be_coupled = self.structure.arm().may_be_coupled();
        may_be_coupled.map_err(|reason| ModelFault::NotCoupled { reason })?;
        self.chain = self.chain.with_coupling(true);
        self.limits = self.limits.coupled();
        Ok(self.with_twins_velocity().joined())
    }

    /// The twin of this arm without the coupling of axes 2 and 3: its joint 3 is this one's minus
    /// joint 2. The arm itself where it has none.
    ///
    /// Its joint 3 is limited as the linkage is or, where that is unknown, may stand wherever axes
    /// 2 and 3 let it, and turns as fast as both together: there and back again widens both.
    #[must_use]
    pub fn uncoupled(mut self) -> Self {
        if !self.is_coupled() {
            return self;
        }
        self.chain = self.chain.with_coupling(false);
        self.limits = self.limits.uncoupled();
        self.with_twins_velocity().joined()
    }

    /// Joint 3 of a twin turns as fast as joints 2 and 3 of the arm together.
    fn with_twins_velocity(mut self) -> Self {
        if let Some([_, second, third, ..]) =
            self.max_velocity.as_mut().map(|velocity| &mut velocity[..])
        {
            *third += *second;
        }
        self
    }

    /// Whether a parallelogram couples axes 2 and 3: then joint 3 is told from the base, not from
    /// the upper arm.
    #[must_use]
    pub fn is_coupled(&self) -> bool {
        self.chain.is_coupled()
    }

    /// The same arm, coupled or not, with the limits as they are: those of its controller.
    pub(crate) fn with_coupling(mut self, coupled: bool) -> Self {
        self.chain = self.chain.with_coupling(coupled);
        self.joined()
    }
}
