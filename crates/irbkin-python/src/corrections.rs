//! Methods of `irbkin.Robot` about its parameters, which a calibration corrects.

use pyo3::prelude::*;

use super::arm::{SharedArm, changed, named, on};
use super::arrays::Rows;
use super::errors::{Fault, exception};
use super::queries::mapped;
use super::robot::PyRobot;
use irbkin::internal::ModelFault;
use irbkin::{Corrections, Error, Robot};

#[pymethods]
impl PyRobot {
    /// Return the robot with corrected base, table and tool: what `irbkin.calibrate` makes of it.
    ///
    /// Corrections of base and tool alone leave the structure as it is. Limits, velocities, name
    /// and a coupling of axes 2 and 3 are kept: `theta` of row 3 corrects the serial joint 3. See
    /// docs/guide/calibrate.md.
    ///
    /// Args:
    ///     corrections: What is added to each parameter, shape (12 + 5 n,): x, y, z [m], rx, ry, rz
    ///         [rad] of the frame before the first row of `mdh`, along and about its own axes; of
    ///         each row alpha [rad], a [m], d [m], theta [rad] and beta [rad], a rotation about y
    ///         after alpha and a; x, y, z, rx, ry, rz of the tool.
    ///
    /// Raises:
    ///     InvalidModelError: A correction is not finite, the shape is wrong, the corrected table
    ///         is not a table, or it leaves coupled axes 2 and 3 more than 0.05 rad off parallel.
    fn with_corrections(&self, corrections: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(on!(self.arm(), robot => {
            let corrected = robot.with_corrections(&read(robot, Some(corrections))?);
            SharedArm::from(corrected.map_err(exception)?)
        })
        .into())
    }

    /// Return the robot, of a calibrated table, solved from the branches of its nominal robot: each
    /// is brought onto the pose by Newton's method, in a microsecond more than the closed form.
    ///
    /// Slots are the nominal robot's. The answer is not complete: a pair of branches that the
    /// nominal robot does not have is not seen, which happens next to a fold; and a branch whose
    /// refinement fails has its slot flagged MERGED. Meant for tracking, `ik_nearest`, `follow` and
    /// `plan`. Rates: docs/guide/calibrate.md.
    ///
    /// Args:
    ///     nominal: A Robot with a closed form, or its catalog name. Its base, tool, limits and
    ///         coupling do not count.
    ///
    /// Raises:
    ///     UnknownRobotError: No arm of that name.
    ///     InvalidModelError: The nominal robot has no closed form, or its tool is more than 0.05
    ///         rad, or 0.05 of its reach, from this robot's.
    fn with_nominal(&self, nominal: &Bound<'_, PyAny>) -> PyResult<Self> {
        let nominal = match nominal.cast::<Self>() {
            Ok(nominal) => nominal.get().arm().clone(),
            Err(_) => named(nominal.extract()?).map_err(exception)?,
        };
        let refined = match (self.arm(), &nominal) {
            (SharedArm::Six(arm), SharedArm::Six(nominal)) => {
                changed(arm, |robot| robot.with_nominal(nominal))?
            }
            (SharedArm::Seven(arm), SharedArm::Seven(nominal)) => {
                changed(arm, |robot| robot.with_nominal(nominal))?
            }
            (robot, nominal) => {
                let fault = ModelFault::JointCount { found: nominal.dof(), wanted: robot.dof() };
                return Err(exception(Error::from(fault)));
            }
        };
        Ok(refined.into())
    }

    /// Jacobian of the tool in the parameters of the robot: how each of them moves it.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     corrections: Where it is taken, shape (12 + 5 n,), as in `with_corrections`; at the
    ///         robot as it is when not given.
    ///     out: Array to write to, shape (..., 6, 12 + 5 n), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Shape (..., 6, 12 + 5 n), columns as the corrections: three linear rows [m/rad] or
    ///     [m/m], then three angular [1] or [rad/m], in the frame of the poses.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     InvalidModelError: Corrections of a wrong shape, or one that is not finite.
    #[pyo3(signature = (q, corrections=None, out=None))]
    fn _parameter_jacobian<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        corrections: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        on!(self.arm(), robot => {
            let (at, width) = (read(robot, corrections)?, count(robot));
            mapped(self.arm(), q, out, &[6, width], |batch, q, rows| {
                batch.parameter_jacobian(robot, &at, q, rows)
            })
        })
    }

    /// Poses of the tool of `with_corrections(corrections)`, without the rounding of a common
    /// normal that is far away.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     corrections: As in `with_corrections`.
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., 4, 4).
    fn _corrected_fk<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        corrections: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        on!(self.arm(), robot => {
            let at = read(robot, Some(corrections))?;
            mapped(self.arm(), q, None, &[4, 4], |batch, q, poses| {
                batch.corrected_fk(robot, &at, q, poses)
            })
        })
    }
}

/// Number of parameters of a robot.
fn count<const N: usize>(_: &Robot<N>) -> usize {
    Corrections::<N>::COUNT
}

/// One row of corrections of a robot; none where they are not given.
fn read<const N: usize>(
    robot: &Robot<N>,
    corrections: Option<&Bound<'_, PyAny>>,
) -> PyResult<Corrections<N>> {
    let Some(given) = corrections else { return Ok(Corrections::NONE) };
    let rows = Rows::exact(given, &[count(robot)], "corrections", Fault::Model)?;
    Corrections::from_slice(rows.data()?).map_err(exception)
}
