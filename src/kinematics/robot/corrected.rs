//! A robot with corrected parameters: what a calibration makes of it.

use super::Robot;
use crate::error::Error;
use crate::kinematics::chain::corrections::{Corrections, correction};
use crate::kinematics::pose::Pose;
use crate::kinematics::structure::known::recognize;

impl<const N: usize> Robot<N> {
    /// Return the robot with corrected base, table and tool; limits, velocities, name and a
    /// coupling of axes 2 and 3 are kept. Column `theta` of row 3 corrects the serial joint 3.
    ///
    /// Corrections of base and tool alone leave the structure as it is. Corrections of the table
    /// make an arm of general structure; corrections of two nearly parallel axes may put their
    /// common normal far away (docs/guide/calibrate.md, section 2).
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when a correction is not finite, or when [`Robot::serial_chain`]
    /// refuses the corrected table, and when it leaves coupled axes 2 and 3 more than 0.05 rad
    /// off parallel.
    pub fn with_corrections(&self, corrections: &Corrections<N>) -> Result<Self, Error> {
        corrections.check()?;
        let (mut base, mut tool) = (*self.base(), *self.tool());
        // An end that is not corrected keeps every bit.
        if !is_zero(&corrections.base) {
            let root = self.mdh().base;
            base = base * root * correction(corrections.base) * root.inverse();
        }
        if !is_zero(&corrections.tool) {
            tool *= correction(corrections.tool);
        }
        let robot = if corrections.are_of_rows() {
            let corrected = Self::recognized(corrections.table(self.mdh()), self.count, recognize)?;
            Self { labels: self.labels.clone(), ..corrected }
                .with_coupling_of(self)?
                .with_name(self.name.clone())
                .with_max_velocity(self.max_velocity)?
                .with_lock(self.locked_joint())?
        } else {
            self.clone()
        };
        robot.with_base(&base)?.with_tool(&tool)
    }

    /// The motion of the tool with each of its parameters, at `q` [rad]: write the rows of a matrix
    /// with [`Corrections::COUNT`] columns in the order base, rows, tool; three linear rows, then
    /// three angular, in the frame in which poses are given.
    ///
    /// `corrections` is where it is taken: [`Corrections::NONE`] at the robot as it is. Column
    /// `theta` of a row is the column of its joint in [`Robot::jacobian`], if axes 2 and 3 are not
    /// coupled. Derivation: docs/guide/calibrate.md, eq. 2 to 6.
    ///
    /// # Errors
    ///
    /// [`Error::WrongLength`] when `jacobian` does not have six rows of that width.
    pub fn parameter_jacobian(
        &self,
        corrections: &Corrections<N>,
        q: &[f64; N],
        jacobian: &mut [f64],
    ) -> Result<(), Error> {
        let (found, wanted) = (jacobian.len(), 6 * Corrections::<N>::COUNT);
        if found != wanted {
            return Err(Error::WrongLength { field: "jacobian", found, wanted });
        }
        self.chain.parameter_jacobian(corrections, q, jacobian);
        Ok(())
    }

    /// The pose of the tool of the corrected robot. The table of [`Robot::with_corrections`] may be
    /// rounded by a common normal that is far away.
    #[must_use]
    pub fn corrected_fk(&self, corrections: &Corrections<N>, q: &[f64; N]) -> Pose {
        self.chain.corrected_fk(corrections, q)
    }
}

fn is_zero(corrections: &[f64]) -> bool {
    corrections.iter().all(|correction| *correction == 0.0)
}
