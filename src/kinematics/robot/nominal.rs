//! A calibrated robot that is solved by way of its nominal one.

use alloc::boxed::Box;

use super::{Definition, Robot};
use crate::error::{Error, ModelFault};
use crate::kinematics::pose::PoseDifference;
use crate::kinematics::thresholds::FAR_FROM_NOMINAL;

/// Joint vectors at which a robot is compared with its nominal one.
const COMPARED: usize = 32;

/// Step between them in joint 1 [rad]; in joint `i` it is `i` times that, so that they are spread.
const SPREAD: f64 = 0.618_033_988_75;

impl<const N: usize> Robot<N> {
    /// Return the robot solved from the branches of `nominal`, each brought onto the pose by
    /// Newton's method: a microsecond more than the closed form of the nominal arm.
    ///
    /// Slots belong to the nominal arm. The answer is not complete: a pair of branches that the
    /// nominal arm has not is not seen, next to a fold. A branch whose refinement fails has its
    /// slot flagged [`MERGED`](crate::Status::MERGED). Rates: docs/guide/calibrate.md, section 5.
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

    /// Check that a nominal robot is near.
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
