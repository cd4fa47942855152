//! Shapes of points and triangles, from arrays and files.

use pyo3::prelude::*;
use pyo3::types::PyString;

use super::arrays::Rows;
use super::errors::{Fault, exception};
use super::shapes::{PyShape, read_points, read_pose};
use super::signals::detached_until;
use irbkin::Interrupt;
use irbkin_motion::body::Shape;

#[pymethods]
impl PyShape {
    /// The convex hull of points.
    ///
    /// Args:
    ///     points: At least four points that are in no plane [m], shape (n, 3); or a file of a
    ///         mesh, whose corners they are.
    ///     pose: Pose of the frame of the points, shape (4, 4); the identity when not given.
    ///     scale: Meters of a unit of the points: 0.001 of millimeters.
    ///
    /// Raises:
    ///     InvalidModelError: Points that are not finite, in a plane, or more than 100 m apart.
    ///     InvalidPoseError: pose is not a rigid transform.
    ///     ImportError: A file is given and trimesh is not installed.
    #[staticmethod]
    #[pyo3(signature = (points, pose=None, *, scale=1.0))]
    fn convex(
        points: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
        scale: f64,
    ) -> PyResult<Self> {
        let rows = match of_file(points)? {
            Some(triangles) => scaled(read_triangles(&triangles)?.data()?, scale)?,
            None => scaled(read_points(points)?.data()?, scale)?,
        };
        let pose = read_pose(pose)?;
        let made = detached_until(points.py(), |it| Shape::convex_until(&rows, &pose, it))?;
        Ok(Self(made.map_err(exception)?))
    }

    /// A triangle mesh: what is inside belongs to it.
    ///
    /// Args:
    ///     triangles: The corners of its triangles [m], shape (n, 3, 3); or a file (STL, OBJ, DAE,
    ///         PLY, OFF, GLB, glTF, 3MF). A solid mesh is closed; its corners are counterclockwise,
    ///         seen from outside. If it is not, corners within 1e-6 m, or a millionth of its size,
    ///         are made one: it is off by as much.
    ///     pose: Pose of the frame of the mesh, shape (4, 4); the identity when not given.
    ///     scale: Meters of a unit of the mesh: 0.001 of millimeters. A file that states its unit
    ///         is converted to meters first.
    ///     solid: False for its surface alone, which need not be closed. Inside of it is free.
    ///
    /// Raises:
    ///     InvalidModelError: Corners that are not finite or more than 100 m apart, a solid mesh
    ///         that is not closed or has no volume.
    ///     InvalidPoseError: pose is not a rigid transform.
    ///     ImportError: A file is given and trimesh is not installed.
    #[staticmethod]
    #[pyo3(signature = (triangles, pose=None, *, scale=1.0, solid=true))]
    fn mesh(
        triangles: &Bound<'_, PyAny>,
        pose: Option<&Bound<'_, PyAny>>,
        scale: f64,
        solid: bool,
    ) -> PyResult<Self> {
        let read = of_file(triangles)?;
        let rows = read_triangles(read.as_ref().unwrap_or(triangles))?;
        let corners = scaled(rows.data()?, scale)?;
        let (corners, pose) = (corners.as_chunks::<3>().0, read_pose(pose)?);
        let made = |it: Interrupt<'_>| Shape::mesh_until(corners, solid, &pose, it);
        Ok(Self(detached_until(triangles.py(), made)?.map_err(exception)?))
    }

    /// A cloud of points, each with a ball around it.
    ///
    /// Args:
    ///     points: The points [m], shape (n, 3).
    ///     radius: The radius of the balls [m]; the distance of neighboring points leaves no gaps
    ///         between them.
    ///     pose: Pose of the frame of the points, shape (4, 4); the identity when not given.
    ///
    /// Raises:
    ///     InvalidModelError: Points that are not finite or more than 100 m apart, a radius that
    ///         is not positive.
    ///     InvalidPoseError: pose is not a rigid transform.
    #[staticmethod]
    #[pyo3(signature = (points, radius, pose=None))]
    fn points(
        points: &Bound<'_, PyAny>,
        radius: f64,
        pose: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let rows = scaled(read_points(points)?.data()?, 1.0)?;
        let pose = read_pose(pose)?;
        let made = detached_until(points.py(), |it| Shape::points_until(&rows, radius, &pose, it))?;
        Ok(Self(made.map_err(exception)?))
    }

    /// Several shapes as one.
    ///
    /// Args:
    ///     shapes: At least one shape.
    ///
    /// Raises:
    ///     InvalidModelError: No shape.
    #[staticmethod]
    fn union(shapes: Vec<PyRef<'_, Self>>) -> PyResult<Self> {
        let shapes = shapes.into_iter().map(|shape| shape.0.clone()).collect();
        Shape::union(shapes).map(Self).map_err(exception)
    }

    /// Return the shape moved from a frame, whose pose is given, into the frame of the pose.
    ///
    /// Args:
    ///     T: Pose of the frame that the shape is in, shape (4, 4).
    ///
    /// Raises:
    ///     InvalidModelError: The shape is more than 100 m away then.
    ///     InvalidPoseError: T is not a rigid transform.
    #[pyo3(signature = (T))]
    fn moved(&self, T: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(self.0.moved(&read_pose(Some(T))?).map_err(exception)?))
    }
}

/// The triangles of a file, if a path is given.
fn of_file<'py>(source: &Bound<'py, PyAny>) -> PyResult<Option<Bound<'py, PyAny>>> {
    let is_path = source.is_instance_of::<PyString>() || source.hasattr("__fspath__")?;
    if !is_path {
        return Ok(None);
    }
    source.py().import("irbkin._mesh_files")?.call_method1("triangles", (source,)).map(Some)
}

fn read_triangles<'py>(triangles: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
    let fits = |shape: &[usize]| matches!(shape, [_, 3, 3]);
    Rows::shaped(triangles, || "(n, 3, 3)", "triangles", Fault::Model, fits)
}

/// Points in meters.
fn scaled(data: &[f64], scale: f64) -> PyResult<Vec<[f64; 3]>> {
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(Fault::Model.error(format_args!(
            "scale is {scale}, it must be positive: meters of a unit, 0.001 of millimeters"
        )));
    }
    Ok(data.as_chunks::<3>().0.iter().map(|point| point.map(|value| scale * value)).collect())
}
