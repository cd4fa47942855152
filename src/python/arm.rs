//! A robot of either number of joints behind one Python class.

use std::sync::Arc;

use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::arrays::{Rows, copied_vector};
use super::errors::{Fault, to_py};
use super::outputs::{answer, output, writable};
use super::signals::detached;
use crate::batch::Pace;
use crate::error::{Error, ModelFault};
use crate::kinematics::{Arity, JacobianFrame, Joints, Robot, check_joints, pose_to_rows};

/// A robot of six or seven joints.
#[derive(Clone, PartialEq)]
pub(super) enum Arm {
    Six(Arc<Robot<6>>),
    Seven(Arc<Robot<7>>),
}

/// Runs the same expression on the robot, whatever its number of joints.
macro_rules! on_robot {
    ($arm:expr, $robot:ident => $body:expr) => {
        match $arm {
            $crate::python::arm::Arm::Six($robot) => $body,
            $crate::python::arm::Arm::Seven($robot) => $body,
        }
    };
}
pub(super) use on_robot;

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
        match self {
            Self::Six(robot) => Ok(robot),
            Self::Seven(robot) => Err(match robot.unknown_structure() {
                Some(reason) => to_py(py, &ModelFault::UnknownStructure(reason).into()),
                None => Fault::Model.error(
                    py,
                    "follow is for arms of six joints: along a path of a seven-axis arm, pass the \
                     joints of the pose before to ik_nearest as the seed"
                        .to_owned(),
                ),
            }),
        }
    }

    pub(super) fn slot_count(&self) -> usize {
        on_robot!(self, robot => robot.slot_count())
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
        on_robot!(self, robot => if let Some(joints) = one(q)? {
            return answer(q, out, pose_to_rows(&robot.fk(&joints)).as_chunks::<4>().0);
        });
        Ok(self
            .mapped(
                q,
                out,
                &[4, 4],
                |pace, q, poses| on_robot!(self, robot => pace.fk(robot, q, poses)),
            )?
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
            |pace, q, frames| on_robot!(self, robot => pace.link_frames(robot, q, frames)),
        )
    }

    pub(super) fn jacobian<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        frame: JacobianFrame,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        on_robot!(self, robot => if let Some(joints) = one(q)? {
            return answer(q, out, &robot.jacobian_rows(&joints, frame));
        });
        let rows = self.mapped(
            q,
            out,
            &[6, self.dof()],
            |pace, q, rows| on_robot!(self, robot => pace.jacobian(robot, q, frame, rows)),
        );
        Ok(rows?.into_any())
    }

    /// An answer of shape (..., `tail`) for joint vectors (..., n), computed without the
    /// interpreter's lock.
    fn mapped<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        tail: &[usize],
        compute: impl FnOnce(&mut Pace<'_>, &[f64], &mut [f64]) -> Result<(), Error> + Send,
    ) -> PyResult<Bound<'py, PyArrayDyn<f64>>> {
        let rows = self.joints(q)?;
        let answer = output(q.py(), out, &rows.shape_with(tail))?;
        let (data, mut view) = (rows.data()?, writable(&answer, &[rows.addresses()])?);
        let slice = view.as_slice_mut()?;
        detached(q.py(), None, |pace| compute(pace, data, slice))?;
        Ok(answer)
    }

    /// The arm with its robot changed.
    pub(super) fn changed(&self, py: Python<'_>, change: &impl Change) -> PyResult<Self> {
        let changed = match self {
            Self::Six(robot) => change.apply(Robot::clone(robot)).map(Self::from),
            Self::Seven(robot) => change.apply(Robot::clone(robot)).map(Self::from),
        };
        changed.map_err(|error: Error| to_py(py, &error))
    }
}

/// A single joint vector that can be read the short way; it must be finite.
#[inline]
fn one<const N: usize>(q: &Bound<'_, PyAny>) -> PyResult<Option<[f64; N]>> {
    let Some(joints) = copied_vector::<N>(q) else { return Ok(None) };
    check_joints("q", &joints).map_err(|error| to_py(q.py(), &error))?;
    Ok(Some(joints))
}

/// A change of a robot that is the same for any number of joints.
pub(super) trait Change {
    fn apply<const N: usize>(&self, robot: Robot<N>) -> Result<Robot<N>, Error>
    where
        Joints<N>: Arity<N>;
}
