//! Shapes, bodies and cells.

use numpy::PyArray2;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use super::arguments::thread_count;
use super::arm::on;
use super::arrays::{Rows, vector};
use super::errors::Fault;
use super::outputs::{Output, array, column, matrix};
use super::records::CellDistance;
use super::robot::PyRobot;
use super::signals::detached;
use super::state::{Reduced, reduced};
use super::targets::read_single_pose;
use crate::body::{Body, Capsule, LinkCapsule, Shape};
use crate::cell::{Cell, Near, Nearest};
use crate::kinematics::Pose;

/// A solid: a box, sphere, capsule, cylinder or half space. Lengths are in meters.
#[pyclass(name = "Shape", module = "irbkin.body", frozen, eq)]
#[derive(Clone, PartialEq)]
pub(super) struct PyShape(pub(super) Shape);

#[pymethods]
impl PyShape {
    /// A box.
    ///
    /// Args:
    ///     size: Lengths of its edges along x, y and z [m], shape (3,).
    ///     pose: Pose of its middle, shape (4, 4); the identity when not given.
    ///
    /// Raises:
    ///     InvalidModelError: A length that is not positive, or more than 1e6 m.
    ///     InvalidPoseError: pose is not a rigid transform.
    #[staticmethod]
    #[pyo3(signature = (size, pose=None))]
    fn r#box(size: &Bound<'_, PyAny>, pose: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let size = vector::<3>(size, "size", Fault::Model)?;
        Ok(Self(Shape::cuboid(size, &read_pose(pose)?)?))
    }

    /// A sphere.
    ///
    /// Args:
    ///     radius: Its radius [m].
    ///     center: Its center [m], shape (3,).
    ///
    /// Raises:
    ///     InvalidModelError: A radius that is not positive, or more than 1e6 m.
    #[staticmethod]
    #[pyo3(signature = (radius, center))]
    fn sphere(radius: f64, center: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(Shape::sphere(radius, vector::<3>(center, "center", Fault::Model)?)?))
    }

    /// All points within a radius of a line segment.
    ///
    /// Args:
    ///     a, b: The ends of the segment [m], shape (3,) each.
    ///     radius: The radius [m].
    ///
    /// Raises:
    ///     InvalidModelError: A radius that is not positive, or more than 1e6 m.
    #[staticmethod]
    #[pyo3(signature = (a, b, radius))]
    fn capsule(a: &Bound<'_, PyAny>, b: &Bound<'_, PyAny>, radius: f64) -> PyResult<Self> {
        let [a, b] = [vector::<3>(a, "a", Fault::Model)?, vector::<3>(b, "b", Fault::Model)?];
        Ok(Self(Shape::capsule(a, b, radius)?))
    }

    /// A cylinder along the z axis of its pose.
    ///
    /// Args:
    ///     radius: Its radius [m].
    ///     length: Its length [m].
    ///     pose: Pose of its middle, shape (4, 4); the identity when not given.
    ///
    /// Raises:
    ///     InvalidModelError: A length that is not positive, or more than 1e6 m.
    ///     InvalidPoseError: pose is not a rigid transform.
    #[staticmethod]
    #[pyo3(signature = (radius, length, pose=None))]
    fn cylinder(radius: f64, length: f64, pose: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Ok(Self(Shape::cylinder(radius, length, &read_pose(pose)?)?))
    }

    /// Everything behind a plane.
    ///
    /// Args:
    ///     normal: Normal of the plane, which points out of the solid: (0, 0, 1) of a floor.
    ///     point: A point of the plane [m], shape (3,).
    ///
    /// Raises:
    ///     InvalidModelError: A normal of length zero.
    #[staticmethod]
    #[pyo3(signature = (normal, point))]
    fn half_space(normal: &Bound<'_, PyAny>, point: &Bound<'_, PyAny>) -> PyResult<Self> {
        let normal = vector::<3>(normal, "normal", Fault::Model)?;
        Ok(Self(Shape::half_space(normal, vector::<3>(point, "point", Fault::Model)?)?))
    }

    fn __repr__(&self) -> String {
        match &self.0 {
            Shape::Capsule(capsule) => {
                let ([a, b], radius) = (capsule.ends(), capsule.radius());
                if capsule.is_sphere() {
                    return format!("Shape.sphere({radius:?}, {a:?})");
                }
                format!("Shape.capsule({a:?}, {b:?}, {radius:?})")
            }
            Shape::Box { pose, half } => {
                let size: [f64; 3] = (2.0 * half).into();
                format!("Shape.box({size:?}) at {:?}", position(pose))
            }
            Shape::Cylinder { pose, radius, half } => {
                format!("Shape.cylinder({radius:?}, {:?}) at {:?}", 2.0 * half, position(pose))
            }
            Shape::HalfSpace { normal, offset } => {
                let point: [f64; 3] = (normal * *offset).into();
                format!("Shape.half_space({:?}, {point:?})", <[f64; 3]>::from(*normal))
            }
        }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Shape", &self.0)
    }
}

fn read_pose(pose: Option<&Bound<'_, PyAny>>) -> PyResult<Pose> {
    pose.map_or(Ok(Pose::identity()), |pose| read_single_pose(pose, "pose"))
}

fn position(pose: &Pose) -> [f64; 3] {
    pose.translation.vector.into()
}

/// Capsules that contain the links of an arm, and the pairs of links that are kept apart.
#[pyclass(name = "Body", module = "irbkin.body", frozen, eq)]
#[derive(Clone, PartialEq)]
pub(super) struct PyBody(pub(super) Body);

#[pymethods]
impl PyBody {
    /// Make a body of capsules.
    ///
    /// Args:
    ///     links: The link of each capsule, shape (k,): 0 is the base, link i moves with joint i.
    ///     capsules: Both ends of the axis and the radius of each [m], shape (k, 7), in the frame of
    ///         its link (`Robot.link_frames`).
    ///     pairs: Pairs of links that are kept apart, shape (m, 2).
    ///
    /// Raises:
    ///     InvalidModelError: A radius that is not positive, a pair that is none, a wrong shape.
    #[new]
    fn new(
        links: Vec<usize>,
        capsules: &Bound<'_, PyAny>,
        pairs: Vec<[usize; 2]>,
    ) -> PyResult<Self> {
        let rows = Rows::exact(capsules, &[links.len(), 7], "capsules", Fault::Model)?;
        let made = links.into_iter().zip(rows.chunks::<7>()?).map(|(link, row)| {
            let [ax, ay, az, bx, by, bz, radius] = *row;
            Ok(LinkCapsule { link, capsule: Capsule::new([ax, ay, az], [bx, by, bz], radius)? })
        });
        Ok(Self(Body::new(made.collect::<Result<_, crate::error::Error>>()?, pairs)?))
    }

    /// The link of each capsule, shape (k,).
    #[getter]
    fn links(&self, py: Python<'_>) -> Py<PyAny> {
        #[expect(clippy::cast_possible_wrap, reason = "a few links")]
        column(py, self.0.capsules().iter().map(|own| own.link as i64))
    }

    /// Both ends of the axis and the radius of each capsule [m], shape (k, 7), in the frame of its
    /// link (`Robot.link_frames`).
    #[getter]
    fn capsules<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        matrix(py, &self.0.capsules().iter().map(row_of).collect::<Vec<_>>())
    }

    /// The pairs of links that are kept apart. The others may touch by construction or, of a body of
    /// the catalog, never do inside the catalog's limits.
    #[getter]
    fn pairs(&self) -> Vec<(usize, usize)> {
        self.0.pairs().iter().map(|pair| (pair[0], pair[1])).collect()
    }

    /// Repository, commit, file and license of the meshes that it contains.
    #[getter]
    fn source(&self) -> &str {
        self.0.source()
    }

    /// How far outside its mesh 95 % of the surface of the capsules of each link are at most [m],
    /// shape (n + 1,); empty if it is not known.
    #[getter]
    fn excess(&self, py: Python<'_>) -> Py<PyAny> {
        column(py, self.0.excess().iter().copied())
    }

    fn __repr__(&self) -> String {
        let (count, pairs) = (self.0.capsules().len(), self.0.pairs().len());
        format!("<Body: {count} capsules, {pairs} pairs of links, {}>", self.0.source())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Body", &self.0)
    }
}

fn row_of(own: &LinkCapsule) -> [f64; 7] {
    let [[ax, ay, az], [bx, by, bz]] = own.capsule.ends();
    [ax, ay, az, bx, by, bz, own.capsule.radius()]
}

/// Obstacles around an arm: whether it touches them or itself.
///
/// Args:
///     obstacles: The `Shape` of each by its name, in the world; none when not given.
///     margin: How far the arm is to stay from them [m].
///
/// Raises:
///     InvalidModelError: A margin that is negative or not finite.
#[pyclass(name = "Cell", module = "irbkin", frozen, eq)]
#[derive(Clone, PartialEq)]
pub(super) struct PyCell(pub(super) Cell);

#[pymethods]
impl PyCell {
    #[new]
    #[pyo3(signature = (obstacles=None, margin=0.0))]
    fn new(obstacles: Option<&Bound<'_, PyDict>>, margin: f64) -> PyResult<Self> {
        let mut read = Vec::new();
        for (name, shape) in obstacles.into_iter().flatten() {
            let name: String = name.extract()?;
            let shape = shape.cast::<PyShape>().map_err(|_| {
                PyTypeError::new_err(format!(
                    "obstacle {name:?} must be an irbkin.body.Shape, as Shape.box([1, 1, 0.1])"
                ))
            })?;
            read.push((name, shape.get().0.clone()));
        }
        Ok(Self(Cell::new(read, margin)?))
    }

    /// The `Shape` of each obstacle, by its name.
    #[getter]
    fn obstacles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let obstacles = PyDict::new(py);
        for (name, shape) in self.0.obstacles() {
            obstacles.set_item(name, PyShape(shape.clone()))?;
        }
        Ok(obstacles)
    }

    /// How far the arm is to stay from the obstacles [m].
    #[getter]
    fn margin(&self) -> f64 {
        self.0.margin()
    }

    /// Whether an arm touches itself, or comes nearer to an obstacle than the margin.
    ///
    /// The links are inside the capsules of `robot.body`: what does not collide is free, what
    /// collides may be free by as much as `robot.body.excess`. The base, link 0, is not compared
    /// with obstacles: it stands on one.
    ///
    /// Args:
    ///     robot: The arm.
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Array to write to, shape (...), bool.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Truth values, shape (...).
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or joints that are not finite.
    ///     InvalidModelError: The robot has no body.
    #[pyo3(signature = (robot, q, out=None, *, threads=1))]
    fn collides<'py>(
        &self,
        robot: &PyRobot,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, threads) = (q.py(), thread_count(threads)?);
        let rows = robot.arm().joints(q)?;
        let mut answer = Output::<bool>::new(py, out, &rows.lead, &[rows.addresses()])?;
        let (q, to) = (rows.data()?, answer.slice()?);
        detached(
            py,
            threads,
            |batch| on!(robot.arm(), robot => batch.collides(&self.0, robot, q, to)),
        )?;
        Ok(answer.bound())
    }

    /// How far the nearest two are apart: two links of the arm, or a link and an obstacle.
    ///
    /// Args:
    ///     robot: The arm.
    ///     q: Joint angles [rad], shape (..., n).
    ///
    /// Returns:
    ///     CellDistance: distances [m], names of the pairs, nearest points [m].
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or joints that are not finite.
    ///     InvalidModelError: The robot has no body.
    fn distance(&self, robot: &PyRobot, q: &Bound<'_, PyAny>) -> PyResult<CellDistance> {
        let py = q.py();
        let rows = robot.arm().joints(q)?;
        let nearest: Vec<Option<Nearest>> = on!(robot.arm(), robot => {
            let nearest = |q: &_| self.0.nearest(robot, q);
            rows.chunks()?.iter().map(nearest).collect::<Result<_, _>>()?
        });
        let distance =
            nearest.iter().map(|one| one.as_ref().map_or(f64::INFINITY, |one| one.distance));
        let points = nearest.iter().flat_map(|one| {
            one.as_ref().map_or([f64::NAN; 6], |one| {
                let [[ax, ay, az], [bx, by, bz]] = one.points;
                [ax, ay, az, bx, by, bz]
            })
        });
        Ok(CellDistance {
            distance: array(py, distance, &rows.lead)?,
            pair: PyTuple::new(py, nearest.iter().map(|one| names(one.as_ref())))?.unbind(),
            points: array(py, points, &[&rows.lead[..], &[2, 3]].concat())?,
        })
    }

    fn __repr__(&self) -> String {
        let names: Vec<_> = self.0.obstacles().iter().map(|(name, _)| name.as_str()).collect();
        format!("<Cell: {} obstacles {names:?}, margin {} m>", names.len(), self.0.margin())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Cell", &self.0)
    }
}

/// The names of a pair; two empty ones if there is none.
fn names(nearest: Option<&Nearest>) -> (String, String) {
    nearest.map_or_else(Default::default, |nearest| {
        let other = match &nearest.near {
            Near::Link(link) => format!("link {link}"),
            Near::Obstacle(name) => name.clone(),
        };
        (format!("link {}", nearest.link), other)
    })
}
