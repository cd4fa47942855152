//! A robot of either number of joints behind one Python class.

use std::sync::Arc;

use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::arrays::{Rows, copied_vector};
use super::errors::{Fault, to_py};
use super::outputs::{answer, output, writable};
use super::signals::detached;
use crate::batch::Batch;
use crate::error::{Error, ModelFault};
use crate::kinematics::{AnyRobot, JacobianFrame, Robot, check_joints, pose_to_rows};

/// A value of a robot of six joints, or of one of seven.
#[derive(Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) enum ByJoints<S, V> {
    Six(S),
    Seven(V),
}

/// Evaluate one expression on either.
macro_rules! on {
    ($either:expr, $inner:ident => $body:expr) => {
        match $either {
            $crate::python::arm::ByJoints::Six($inner) => $body,
            $crate::python::arm::ByJoints::Seven($inner) => $body,
        }
    };
}
pub(super) use on;

/// A robot of six or seven joints.
pub(super) type Arm = ByJoints<Arc<Robot<6>>, Arc<Robot<7>>>;

impl From<AnyRobot> for Arm {
    fn from(robot: AnyRobot) -> Self {
        match robot {
            AnyRobot::Six(robot) => robot.into(),
            AnyRobot::Seven(robot) => robot.into(),
        }
    }
}

impl From<Robot<6>> for Arm {
    fn from(robot: Robot<6>) -> Self {
        Self::Six(Arc::new(robot))
    }
}

impl From<Robot<7>> for Arm {
    fn from(robot: Robot<7>) -> Self {
        Self::Seven(Arc::new(robot))
    }
}

impl From<Arc<Robot<6>>> for Arm {
    fn from(robot: Arc<Robot<6>>) -> Self {
        Self::Six(robot)
    }
}

impl From<Arc<Robot<7>>> for Arm {
    fn from(robot: Arc<Robot<7>>) -> Self {
        Self::Seven(robot)
    }
}

impl Arm {
    pub(super) fn dof(&self) -> usize {
        match self {
            Self::Six(_) => 6,
            Self::Seven(_) => 7,
        }
    }

    /// The robot that follows paths.
    pub(super) fn follower(&self, py: Python<'_>) -> PyResult<&Arc<Robot<6>>> {
        self.six_joints_or(py, "follow", ", or take locked({3: 0.2}).follow")
    }

    /// The robot of a call along a path, which is for six joints.
    pub(super) fn six_joints(&self, py: Python<'_>, call: &str) -> PyResult<&Arc<Robot<6>>> {
        self.six_joints_or(py, call, "")
    }

    /// The robot of a call for six joints; the message for seven ends with a remedy.
    fn six_joints_or(&self, py: Python<'_>, call: &str, or: &str) -> PyResult<&Arc<Robot<6>>> {
        match self {
            Self::Six(robot) => Ok(robot),
            Self::Seven(robot) => Err(match robot.unknown_structure() {
                Some(reason) => to_py(py, &ModelFault::UnknownStructure(reason).into()),
                None => Fault::Model.error(
                    py,
                    format!(
                        "{call} is for arms of six joints: along a path of a seven-axis arm, pass \
                         the joints of the pose before to ik_nearest as the seed{or}"
                    ),
                ),
            }),
        }
    }

    pub(super) fn slot_count(&self) -> usize {
        on!(self, robot => robot.slot_count())
    }

    /// Joint vectors as an argument; a single one must be finite.
    pub(super) fn joints<'py>(&self, q: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
        let rows = Rows::read(q, &[self.dof()], "q", Fault::Joints)?;
        if rows.is_single() {
            check_joints("q", rows.data()?).map_err(|error| to_py(q.py(), &error))?;
        }
        Ok(rows)
    }

    pub(super) fn fk<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        on!(self, robot => if let Some(joints) = one(q)? {
            return answer(q, out, pose_to_rows(&robot.fk(&joints)).as_chunks::<4>().0);
        });
        Ok(self
            .mapped(q, out, &[4, 4], |pace, q, poses| on!(self, robot => pace.fk(robot, q, poses)))?
            .into_any())
    }

    pub(super) fn link_frames<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        self.mapped(
            q,
            out,
            &[self.dof() + 1, 4, 4],
            |pace, q, frames| on!(self, robot => pace.link_frames(robot, q, frames)),
        )
    }

    pub(super) fn jacobian<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        frame: JacobianFrame,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        on!(self, robot => if let Some(joints) = one(q)? {
            return answer(q, out, &robot.jacobian_rows(&joints, frame));
        });
        let rows = self.mapped(
            q,
            out,
            &[6, self.dof()],
            |pace, q, rows| on!(self, robot => pace.jacobian(robot, q, frame, rows)),
        );
        Ok(rows?.into_any())
    }

    /// An answer of shape (..., `tail`) for joint vectors (..., n), computed without the
    /// interpreter's lock.
    pub(super) fn mapped<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        tail: &[usize],
        compute: impl FnOnce(&mut Batch<'_>, &[f64], &mut [f64]) -> Result<(), Error> + Send,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let rows = self.joints(q)?;
        let answer = output(q.py(), out, &rows.shape_with(tail))?;
        let (data, mut view) = (rows.data()?, writable(&answer, &[rows.addresses()])?);
        let slice = view.as_slice_mut()?;
        detached(q.py(), None, |pace| compute(pace, data, slice))?;
        Ok(answer)
    }
}

/// A single joint vector that can be read the short way; it must be finite.
#[inline]
fn one<const N: usize>(q: &Bound<'_, PyAny>) -> PyResult<Option<[f64; N]>> {
    let Some(joints) = copied_vector::<N>(q) else { return Ok(None) };
    check_joints("q", &joints).map_err(|error| to_py(q.py(), &error))?;
    Ok(Some(joints))
}
