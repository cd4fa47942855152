//! Shapes of obstacles, bodies of arms.

use numpy::PyArray2;
use pyo3::prelude::*;

use super::arrays::{Rows, vector};
use super::errors::{Fault, exception};
use super::outputs::{column, matrix};
use super::state::{Reduced, reduced};
use super::targets::read_place;
use irbkin::Pose;
use irbkin_motion::Error;
use irbkin_motion::body::{Body, Capsule, LinkCapsule, LinkHull, RoundedHull, Shape};

/// A box, sphere, capsule, cylinder, half space, convex hull, triangle mesh, point cloud, or
/// several of them. Lengths are in meters.
#[pyclass(name = "Shape", module = "irbkin.body", frozen, eq)]
#[derive(Clone, PartialEq)]
pub(super) struct PyShape(pub(super) Shape);

#[pymethods]
impl PyShape {
    /// A box.
    ///
    /// Args:
    ///     size: Lengths of its edges along x, y and z [m], shape (3,).
    ///     pose: Pose of its middle, shape (4, 4), or its position alone [m], shape (3,); the
    ///         identity when not given.
    ///
    /// Raises:
    ///     InvalidModelError: A length that is not positive or more than 100 m, or a pose
    ///         farther away.
    ///     InvalidPoseError: pose is not a rigid transform.
    #[staticmethod]
    #[pyo3(signature = (size, pose=None))]
    fn r#box(size: &Bound<'_, PyAny>, pose: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let size = vector::<3>(size, "size", Fault::Model)?;
        Ok(Self(Shape::cuboid(size, &read_pose(pose)?).map_err(exception)?))
    }

    /// A sphere.
    ///
    /// Args:
    ///     radius: Its radius [m].
    ///     center: Its center [m], shape (3,).
    ///
    /// Raises:
    ///     InvalidModelError: A radius that is not positive or more than 100 m, or a center
    ///         farther away.
    #[staticmethod]
    #[pyo3(signature = (radius, center))]
    fn sphere(radius: f64, center: &Bound<'_, PyAny>) -> PyResult<Self> {
        let center = vector(center, "center", Fault::Model)?;
        Shape::sphere(radius, center).map(Self).map_err(exception)
    }

    /// All points within a radius of a line segment.
    ///
    /// Args:
    ///     a: One end of the segment [m], shape (3,).
    ///     b: The other end [m], shape (3,).
    ///     radius: The radius [m].
    ///
    /// Raises:
    ///     InvalidModelError: A radius that is not positive or more than 100 m, or an end
    ///         farther away.
    #[staticmethod]
    #[pyo3(signature = (a, b, radius))]
    fn capsule(a: &Bound<'_, PyAny>, b: &Bound<'_, PyAny>, radius: f64) -> PyResult<Self> {
        let [a, b] = [vector::<3>(a, "a", Fault::Model)?, vector::<3>(b, "b", Fault::Model)?];
        Ok(Self(Shape::capsule(a, b, radius).map_err(exception)?))
    }

    /// A cylinder along the z axis of its pose.
    ///
    /// Args:
    ///     radius: Its radius [m].
    ///     length: Its length [m].
    ///     pose: As of `box`.
    ///
    /// Raises:
    ///     InvalidModelError: A length that is not positive or more than 100 m, or a pose
    ///         farther away.
    ///     InvalidPoseError: pose is not a rigid transform.
    #[staticmethod]
    #[pyo3(signature = (radius, length, pose=None))]
    fn cylinder(radius: f64, length: f64, pose: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Ok(Self(Shape::cylinder(radius, length, &read_pose(pose)?).map_err(exception)?))
    }

    /// Everything behind a plane.
    ///
    /// Args:
    ///     normal: Normal of the plane, which points out of the solid: (0, 0, 1) of a floor.
    ///     point: A point of the plane [m], shape (3,).
    ///
    /// Raises:
    ///     InvalidModelError: A normal of length zero, or a point more than 100 m away.
    #[staticmethod]
    #[pyo3(signature = (normal, point))]
    fn half_space(normal: &Bound<'_, PyAny>, point: &Bound<'_, PyAny>) -> PyResult<Self> {
        let normal = vector(normal, "normal", Fault::Model)?;
        let point = vector(point, "point", Fault::Model)?;
        Shape::half_space(normal, point).map(Self).map_err(exception)
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
            Shape::Convex { pose, hull } => {
                format!("<Shape.convex: {} points at {:?}>", hull.points().len(), position(pose))
            }
            Shape::Mesh { pose, mesh } => {
                let kind = if mesh.is_solid() { "" } else { ", a surface" };
                let count = mesh.triangles().len();
                format!("<Shape.mesh: {count} triangles{kind} at {:?}>", position(pose))
            }
            Shape::Points { pose, cloud } => {
                let (count, radius) = (cloud.points().len(), cloud.radius());
                format!("<Shape.points: {count} points, {radius:?} m, at {:?}>", position(pose))
            }
            Shape::Union(parts) => format!("<Shape.union: {} shapes>", parts.len()),
        }
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Shape", &self.0)
    }
}

pub(super) fn read_pose(pose: Option<&Bound<'_, PyAny>>) -> PyResult<Pose> {
    pose.map_or(Ok(Pose::identity()), |pose| read_place(pose, "pose"))
}

pub(super) fn read_points<'py>(points: &Bound<'py, PyAny>) -> PyResult<Rows<'py>> {
    Rows::shaped(points, || "(n, 3)", "points", Fault::Model, |shape| matches!(shape, [_, 3]))
}

fn position(pose: &Pose) -> [f64; 3] {
    pose.translation.vector.into()
}

/// Capsules that contain the links of an arm, and the pairs of links that are kept apart.
#[pyclass(name = "Body", module = "irbkin.body", frozen, eq)]
#[derive(Clone, PartialEq)]
pub(super) struct PyBody(pub(super) Body);

/// Capsules by their links, ends and radii.
pub(super) fn read_capsules(
    links: Vec<usize>,
    capsules: &Bound<'_, PyAny>,
) -> PyResult<Vec<LinkCapsule>> {
    let rows = Rows::exact(capsules, &[links.len(), 7], "capsules", Fault::Model)?;
    let made = links.into_iter().zip(rows.chunks::<7>()?).map(|(link, row)| {
        let [ax, ay, az, bx, by, bz, radius] = *row;
        Ok(LinkCapsule { link, capsule: Capsule::new([ax, ay, az], [bx, by, bz], radius)? })
    });
    made.collect::<Result<_, Error>>().map_err(exception)
}

/// A hull: its link, points, faces and radius.
type HullRow<'py> = (usize, Bound<'py, PyAny>, Vec<[u8; 3]>, f64);

/// A hull as an answer.
type HullItem<'py> = (usize, Bound<'py, PyArray2<f64>>, Vec<[usize; 3]>, f64);

fn read_hulls(hulls: Vec<HullRow<'_>>) -> PyResult<Vec<LinkHull>> {
    let made = hulls.into_iter().map(|(link, points, faces, radius)| {
        let points = read_points(&points)?;
        let hull = RoundedHull::new(points.chunks::<3>()?, faces, radius).map_err(exception)?;
        Ok(LinkHull { link, hull })
    });
    made.collect()
}

#[pymethods]
impl PyBody {
    /// Make a body of capsules, and of hulls that contain the same more closely.
    ///
    /// Args:
    ///     links: The link of each capsule, shape (k,): 0 is the base, link i moves with joint i,
    ///         and the flange carries link n + 1 in its frame.
    ///     capsules: Both ends of the axis and the radius of each [m], shape (k, 7), in the frame
    ///         of its link (`Robot.link_frames`).
    ///     pairs: Pairs of links that are kept apart, shape (m, 2).
    ///     hulls: Convex hulls that contain what the capsules of their links contain: link, points
    ///         [m], shape (p, 3), triangles of its surface by the numbers of points, shape (t, 3)
    ///         or none, and a radius [m], within which everything belongs to it. Where capsules
    ///         touch, the hulls of a link decide, if it has some.
    ///     source: Where the shapes are from.
    ///     excess: How far outside of what they contain the capsules of each link are [m]; not
    ///         known when not given.
    ///
    /// Raises:
    ///     InvalidModelError: A radius that is not positive, a pair of links without capsules, a
    ///         wrong shape.
    #[new]
    #[pyo3(signature = (links, capsules, pairs, *, hulls=None, source="given", excess=None))]
    fn new(
        links: Vec<usize>,
        capsules: &Bound<'_, PyAny>,
        pairs: Vec<[usize; 2]>,
        hulls: Option<Vec<HullRow<'_>>>,
        source: &str,
        excess: Option<Vec<f64>>,
    ) -> PyResult<Self> {
        let body = Body::new(read_capsules(links, capsules)?, pairs).map_err(exception)?;
        let body = body.with_hulls(read_hulls(hulls.unwrap_or_default())?).map_err(exception)?;
        let excess = excess.unwrap_or_default();
        body.with_source(source.to_owned(), excess).map(Self).map_err(exception)
    }

    /// Return the body with more capsules: a hose, a dress pack. Rods and cylinders that move
    /// beside the links stay.
    ///
    /// Args:
    ///     links: The link of each capsule, shape (k,).
    ///     capsules: Both ends of the axis and the radius of each [m], shape (k, 7).
    ///
    /// Raises:
    ///     InvalidModelError: A radius that is not positive, a wrong shape.
    fn with_capsules(&self, links: Vec<usize>, capsules: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(self.0.clone().with_capsules(read_capsules(links, capsules)?)))
    }

    /// Fit capsules to the meshes of a URDF: they contain every triangle, and the inside of closed
    /// meshes. It needs `pip install 'irbkin[mesh]'`, and takes 15 to 60 s for an arm.
    ///
    /// Of each link, the meshes and shapes of its `collision` elements, or of its `visual` ones
    /// where it has none; of links behind joints beside the arm, as of a gripper, wherever these
    /// joints may be. `source` names them. Links that are not neighbors are kept apart; left out
    /// are pairs that touch in all of 2,000 random postures inside the limits, and pairs whose
    /// capsules touch in more than 2 % of these and whose meshes do in none. The same body comes
    /// out each time.
    ///
    /// Args:
    ///     urdf: As of `Robot.from_urdf`.
    ///     base: As of `Robot.from_urdf`.
    ///     tip: As of `Robot.from_urdf`.
    ///     excess: How far 95 % of the surface of the capsules of a link may be outside its mesh
    ///         [m]: the fewest that meet it are taken. When not given, or not met, as many as
    ///         `most` allows.
    ///     most: Capsules of a link at most, 1 to 12.
    ///     packages: Folder of each package that `package://` names; a folder of that name above
    ///         the URDF when not given.
    ///     joints: Where joints beside the arm are, by their names [rad or m]: their links, and
    ///         links of joints that mimic them, are in the body there alone.
    ///     progress: Called with the number of links that are fitted, and of all; or a bar as
    ///         `tqdm.tqdm()`.
    ///
    /// Raises:
    ///     InvalidModelError: As `Robot.from_urdf`; a file is no mesh, no link has a shape, the
    ///         joint in front of one has no end, or a joint is unknown, of the arm, or cannot be
    ///         where it is given.
    ///     FileNotFoundError: A mesh is not found.
    ///     ImportError: trimesh or scipy is not installed.
    #[staticmethod]
    #[pyo3(signature = (
        urdf, base=None, tip=None, *, excess=None, most=4, packages=None, joints=None,
        progress=None
    ))]
    fn fit(
        urdf: &Bound<'_, PyAny>,
        base: Option<&str>,
        tip: Option<&str>,
        excess: Option<f64>,
        most: i64,
        packages: Option<&Bound<'_, PyAny>>,
        joints: Option<&Bound<'_, PyAny>>,
        progress: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Py<Self>> {
        let fit = urdf.py().import("irbkin.body")?.getattr("_fit_body")?;
        let arguments = (urdf, base, tip, excess, most, packages, joints, progress);
        Ok(fit.call1(arguments)?.extract()?)
    }

    /// The link of each capsule, shape (k,).
    #[getter]
    fn links(&self, py: Python<'_>) -> Py<PyAny> {
        #[expect(clippy::cast_possible_wrap, reason = "a few links")]
        column(py, self.0.capsules().iter().map(|own| own.link as i64))
    }

    /// Both ends of the axis and the radius of each capsule [m], shape (k, 7), in the frame of its
    /// link: of link k `Robot.link_frames(q)[k - 1]`, of link 0 the base, of link n + 1 the flange.
    #[getter]
    fn capsules<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        matrix(py, &self.0.capsules().iter().map(|own| row_of(&own.capsule)).collect::<Vec<_>>())
    }

    /// The hulls, as they are given: link, points [m], shape (p, 3), faces, radius [m].
    #[getter]
    fn hulls<'py>(&self, py: Python<'py>) -> Vec<HullItem<'py>> {
        let row = |own: &LinkHull| {
            let points: Vec<[f64; 3]> = own.hull.points().collect();
            let faces = own.hull.faces().iter().map(|face| face.map(usize::from)).collect();
            (own.link, matrix(py, &points), faces, own.hull.radius())
        };
        self.0.hulls().iter().map(row).collect()
    }

    /// The pairs of links that are kept apart. The others may touch by construction or, of a body
    /// of the catalog, never do inside the catalog's limits.
    #[getter]
    fn pairs(&self) -> Vec<(usize, usize)> {
        self.0.pairs().iter().map(|pair| (pair[0], pair[1])).collect()
    }

    /// Repository, commit, file and license of the meshes that it contains; or what else it is of.
    #[getter]
    fn source(&self) -> &str {
        self.0.source()
    }

    /// Whether it is made of the lengths of the kinematic table alone: the arm may be outside.
    #[getter]
    fn is_approximate(&self) -> bool {
        self.0.is_approximate()
    }

    /// How far outside its mesh 95 % of the surface of the capsules of each link are at most [m],
    /// and all of the surface of what the flange carries, shape (n + 1,) or (n + 2,); empty if it
    /// is not known.
    #[getter]
    fn excess(&self, py: Python<'_>) -> Py<PyAny> {
        column(py, self.0.excess().iter().copied())
    }

    fn __repr__(&self) -> String {
        let (count, pairs) = (self.0.capsules().len(), self.0.pairs().len());
        let hulls = match self.0.hulls().len() {
            0 => String::new(),
            count => format!(", {count} hulls"),
        };
        format!("<Body: {count} capsules{hulls}, {pairs} pairs of links, {}>", self.0.source())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        reduced(py, "Body", &self.0)
    }
}

/// Both ends of the axis and the radius.
pub(super) fn row_of(own: &Capsule) -> [f64; 7] {
    let [[ax, ay, az], [bx, by, bz]] = own.ends();
    [ax, ay, az, bx, by, bz, own.radius()]
}
