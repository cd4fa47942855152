//! `irbkin.Robot` with shapes of its links, and with what its flange carries.

use crate::errors::exception;
use pyo3::prelude::*;

use super::arm::{SharedArm, on};
use super::robot::PyRobot;
use super::shapes::{PyBody, PyShape, read_pose};
use irbkin_motion::Arm;
use irbkin_motion::body::Shape;

#[pymethods]
impl PyRobot {
    /// The shapes of its links, an `irbkin.body.Body`: of an arm of the catalog, capsules that
    /// contain a public mesh or, without one, `approximate_body()`. None of an arm of your own
    /// until `with_body`.
    #[getter]
    fn body(&self) -> Option<PyBody> {
        on!(self.arm(), robot => robot.body().cloned()).map(PyBody)
    }

    /// Return the robot with other shapes of its links, or without.
    ///
    /// Raises:
    ///     InvalidModelError: A capsule of a link that the arm does not have.
    #[pyo3(signature = (body))]
    fn with_body(&self, body: Option<&Bound<'_, PyBody>>) -> PyResult<Self> {
        let body = body.map(|body| body.get().0.clone());
        Ok(on!(self.arm(), robot => {
            SharedArm::from(Arm::clone(robot).with_body(body).map_err(exception)?)
        })
        .into())
    }

    /// Return a body made of the lengths of the kinematic table: capsules along its lines, thicker
    /// towards the base. The arm may be outside of it; see docs/guide/cell.md.
    ///
    /// Raises:
    ///     InvalidModelError: The lengths of the table are more than ten times the size of the arm.
    fn approximate_body(&self) -> PyResult<PyBody> {
        Ok(PyBody(on!(self.arm(), robot => robot.approximate_body().map_err(exception)?)))
    }

    /// Return the robot with shapes that its flange carries, besides those it has: a tool, a work
    /// piece. They are link n + 1 of its body, in the flange frame.
    ///
    /// Capsules contain each shape. They are kept apart from links 0 to n - 2, unless they touch
    /// one in each of 64 postures that fill the limits.
    ///
    /// Args:
    ///     shapes: A `Shape`, or several.
    ///     pose: Pose of the shapes in the flange frame `tool0`, shape (4, 4), or its position
    ///         alone [m], shape (3,); the identity when not given. The tool center point does not
    ///         move them: pass `robot.tool` if they are in its frame.
    ///     excess: How far the capsules may be outside the shape [m]; when not given, at most four
    ///         capsules with the least excess, which `body.excess[n + 1]` has.
    ///
    /// Raises:
    ///     InvalidModelError: The robot has no body, a shape is a half space or reaches farther
    ///         from the flange than the arm, or the excess needs more than 100 capsules for a
    ///         shape.
    ///     InvalidPoseError: pose is not a rigid transform.
    #[pyo3(signature = (shapes, pose=None, *, excess=None))]
    fn with_attached(
        &self,
        shapes: Shapes<'_>,
        pose: Option<&Bound<'_, PyAny>>,
        excess: Option<f64>,
    ) -> PyResult<Self> {
        let pose = read_pose(pose)?;
        let shapes = shapes.read();
        Ok(on!(self.arm(), robot => {
            let carrying = Arm::clone(robot).with_attached(&shapes, &pose, excess);
            SharedArm::from(carrying.map_err(exception)?)
        })
        .into())
    }
}

#[derive(FromPyObject)]
pub(crate) enum Shapes<'py> {
    One(Bound<'py, PyShape>),
    Many(Vec<Bound<'py, PyShape>>),
}

impl Shapes<'_> {
    pub(crate) fn read(self) -> Vec<Shape> {
        let shapes = match self {
            Shapes::One(shape) => Vec::from([shape]),
            Shapes::Many(shapes) => shapes,
        };
        shapes.iter().map(|shape| shape.get().0.clone()).collect()
    }
}
