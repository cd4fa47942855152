//! A robot with corrected parameters, as a calibration makes it, and one that is solved by way of
//! its nominal arm.

use alloc::boxed::Box;

use super::{Definition, Robot};
use crate::error::{Error, ModelFault};
use crate::kinematics::chain::corrections::{Corrections, correction};
use crate::kinematics::pose::{Pose, PoseDifference};
use crate::kinematics::structure::known::recognize;
use crate::kinematics::thresholds::FAR_FROM_NOMINAL;

/// Joint vectors at which a robot is compared with its nominal one.
const COMPARED: usize = 32;

/// Step between them in joint 1 [rad]; in joint `i` it is `i` times that, so that they are spread.
const SPREAD: f64 = 0.618_033_988_75;

impl<const N: usize> Robot<N> {
    /// Return the robot with corrected base, table and tool; limits, velocities, name and a
    /// coupling of axes 2 and 3 are kept. Column `theta` of row 3 corrects the serial joint 3.
    ///
    /// Corrections of base and tool alone leave the structure as it is. Corrections of the table
    /// make an arm of general structure; corrections of two nearly parallel axes may put their
    /// common normal far away (docs/theory/calibrate.md, section 2).
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
    /// coupled. Derivation: docs/theory/calibrate.md, eq. 2 to 6.
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

    /// Return the robot solved from the branches of `nominal`, each brought onto the pose by
    /// Newton's method: a microsecond more than the closed form of the nominal arm.
    ///
    /// Slots belong to the nominal arm. The answer is not complete: a pair of branches that the
    /// nominal arm has not is not seen, next to a fold. A branch whose refinement fails has its
    /// slot flagged [`MERGED`](crate::Status::MERGED). Rates: docs/theory/calibrate.md, section 5.
    ///
    /// Base, tool, limits, velocities and a coupling of axes 2 and 3 belong to this robot.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidModel`] when the nominal arm has no closed form, and when their tools are
    /// more than 0.05 apart, in rad or as a part of the reach.
    pub fn with_nominal(&self, nominal: &Self) -> Result<Self, Error> {
        self.check_near(nominal)?;
        let closed_form = nominal.inverse.as_ref().filter(|_| nominal.is_closed_form());
        let (refined, inverse) = (self.count.refined.zip(closed_form))
            .ok_or(ModelFault::NominalStructure { structure: nominal.structure() })?;
        let refined = refined(&**inverse, [&nominal.chain, &self.chain], &self.limits);
        let definition = Definition::Refined {
            mdh: self.mdh().clone(),
            nominal: Box::new(nominal.definition.clone()),
        };
        Ok(Self { definition, inverse: Some(refined), missing_form: None, ..self.clone() })
    }

    fn check_near(&self, nominal: &Self) -> Result<(), Error> {
        let nominal = nominal.clone().with_coupling_of(self)?;
        let nominal = nominal.with_base(self.base())?.with_tool(self.tool())?;
        // The longest distance of the flange from an axis, not of tables: nearly parallel axes
        // have offsets that cancel.
        let reach: f64 = nominal.mdh().rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
        let mut off = PoseDifference::default();
        for sample in 0..COMPARED {
            #[expect(clippy::cast_precision_loss, reason = "small whole numbers")]
            let q = core::array::from_fn(|joint| SPREAD * (sample * (joint + 1)) as f64);
            let here = PoseDifference::between(&self.fk(&q), &nominal.fk(&q));
            off.position = off.position.max(here.position);
            off.rotation = off.rotation.max(here.rotation);
        }
        let bound = FAR_FROM_NOMINAL;
        if off.rotation <= bound && off.position <= bound * reach {
            return Ok(());
        }
        let (position, rotation) = (off.position, off.rotation);
        Err(ModelFault::FarFromNominal { position, rotation, bound: [bound * reach, bound] }.into())
    }
}

fn is_zero(corrections: &[f64]) -> bool {
    corrections.iter().all(|correction| *correction == 0.0)
}
