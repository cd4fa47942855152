//! Methods of `irbkin.Robot` about its parameters, which a calibration corrects.

use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::arm::{Arm, on};
use super::arrays::Rows;
use super::errors::{Fault, shape_text, to_py};
use super::robot::PyRobot;
use crate::error::{Error, ModelFault};
use crate::kinematics::{AnyRobot, Corrections, Robot};

#[pymethods]
impl PyRobot {
    /// Return the robot with corrected base, table and tool: what `irbkin.calibrate` makes of it.
    ///
    /// Corrections of base and tool alone leave the structure as it is. See
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
    ///         is not a table, or the table of a robot with coupled axes 2 and 3 is corrected.
    fn with_corrections(&self, corrections: &Bound<'_, PyAny>) -> PyResult<Self> {
        let numbers = read(corrections, self.arm().dof())?;
        let corrected = on!(self.arm(), robot => corrected(robot, numbers.data()?).map(Arm::from));
        corrected.map(Self::from).map_err(|error| to_py(corrections.py(), &error))
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
    ///     nominal: A Robot with a closed form, or its catalog name. Its base, tool and limits do
    ///         not count.
    ///
    /// Raises:
    ///     UnknownRobotError: No arm of that name.
    ///     InvalidModelError: The nominal robot has no closed form, coupled axes, or its tool is
    ///         more than 0.05 rad, or 0.05 of its reach, from this robot's.
    fn with_nominal(&self, nominal: &Bound<'_, PyAny>) -> PyResult<Self> {
        let py = nominal.py();
        if let Ok(nominal) = nominal.cast::<Self>() {
            return self.refined(py, nominal.get().arm());
        }
        let named =
            AnyRobot::named(nominal.extract::<&str>()?).map_err(|error| to_py(py, &error))?;
        self.refined(py, &Arm::from(named))
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
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let dof = self.arm().dof();
        let numbers = corrections.map(|corrections| read(corrections, dof)).transpose()?;
        let numbers = numbers.as_ref().map(Rows::data).transpose()?;
        let width = count(dof);
        on!(self.arm(), robot => {
            let corrections = corrections_of(robot, numbers).map_err(|error| to_py(q.py(), &error))?;
            self.arm().mapped(q, out, &[6, width], |pace, q, rows| {
                pace.parameter_jacobian(robot, &corrections, q, rows)
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
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let numbers = read(corrections, self.arm().dof())?;
        let numbers = numbers.data()?;
        on!(self.arm(), robot => {
            let corrections =
                corrections_of(robot, Some(numbers)).map_err(|error| to_py(q.py(), &error))?;
            self.arm().mapped(q, None, &[4, 4], |pace, q, poses| {
                pace.corrected_fk(robot, &corrections, q, poses)
            })
        })
    }
}

impl PyRobot {
    fn refined(&self, py: Python<'_>, nominal: &Arm) -> PyResult<Self> {
        let refined = match (self.arm(), nominal) {
            (Arm::Six(robot), Arm::Six(nominal)) => robot.with_nominal(nominal).map(Arm::from),
            (Arm::Seven(robot), Arm::Seven(nominal)) => robot.with_nominal(nominal).map(Arm::from),
            (robot, nominal) => {
                Err(ModelFault::JointCount { found: nominal.dof(), wanted: robot.dof() }.into())
            }
        };
        refined.map(Self::from).map_err(|error| to_py(py, &error))
    }
}

/// Number of parameters of a robot of `dof` joints.
fn count(dof: usize) -> usize {
    if dof == 6 { Corrections::<6>::COUNT } else { Corrections::<7>::COUNT }
}

/// One row of corrections.
fn read<'py>(corrections: &Bound<'py, PyAny>, dof: usize) -> PyResult<Rows<'py>> {
    let wanted = format!("({},)", count(dof));
    let rows = Rows::read_wanting(corrections, &[count(dof)], "corrections", Fault::Model, || {
        wanted.clone()
    })?;
    if rows.is_single() {
        return Ok(rows);
    }
    let got = shape_text(rows.shape());
    Err(Fault::Model
        .error(corrections.py(), format!("corrections must have shape {wanted}, got {got}")))
}

fn corrections_of<const N: usize>(
    _: &Robot<N>,
    numbers: Option<&[f64]>,
) -> Result<Corrections<N>, Error> {
    numbers.map_or(Ok(Corrections::NONE), Corrections::from_slice)
}

fn corrected<const N: usize>(robot: &Robot<N>, numbers: &[f64]) -> Result<Robot<N>, Error> {
    robot.with_corrections(&Corrections::from_slice(numbers)?)
}
