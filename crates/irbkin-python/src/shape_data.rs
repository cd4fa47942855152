//! The numbers of a shape, as plain data.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use super::shapes::PyShape;
use irbkin::Pose;
use irbkin_motion::body::Shape;

#[pymethods]
impl PyShape {
    /// Return the shape as plain data, which JSON takes: the name of its constructor as `kind`, and
    /// the arguments that make it again.
    ///
    /// Returns:
    ///     A dict of numbers and nested lists; lengths in meters, a pose as four rows.
    fn data<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let data = PyDict::new(py);
        let kind = match &self.0 {
            Shape::Capsule(capsule) => {
                let ([a, b], radius) = (capsule.ends(), capsule.radius());
                data.set_item("radius", radius)?;
                if capsule.is_sphere() {
                    data.set_item("center", a)?;
                    "sphere"
                } else {
                    data.set_item("a", a)?;
                    data.set_item("b", b)?;
                    "capsule"
                }
            }
            Shape::Box { pose, half } => {
                data.set_item("size", <[f64; 3]>::from(2.0 * half))?;
                data.set_item("pose", rows(pose))?;
                "box"
            }
            Shape::Cylinder { pose, radius, half } => {
                data.set_item("radius", radius)?;
                data.set_item("length", 2.0 * half)?;
                data.set_item("pose", rows(pose))?;
                "cylinder"
            }
            Shape::HalfSpace { normal, offset } => {
                data.set_item("normal", <[f64; 3]>::from(*normal))?;
                data.set_item("point", <[f64; 3]>::from(normal * *offset))?;
                "half_space"
            }
            Shape::Convex { pose, hull } => {
                data.set_item("points", hull.points().collect::<Vec<_>>())?;
                data.set_item("pose", rows(pose))?;
                "convex"
            }
            Shape::Mesh { pose, mesh } => {
                data.set_item("triangles", mesh.triangles().collect::<Vec<_>>())?;
                data.set_item("pose", rows(pose))?;
                data.set_item("solid", mesh.is_solid())?;
                "mesh"
            }
            Shape::Points { pose, cloud } => {
                data.set_item("points", cloud.points().collect::<Vec<_>>())?;
                data.set_item("radius", cloud.radius())?;
                data.set_item("pose", rows(pose))?;
                "points"
            }
            Shape::Union(parts) => {
                let parts = parts.iter().map(|part| Self(part.clone()).data(py));
                data.set_item("shapes", parts.collect::<PyResult<Vec<_>>>()?)?;
                "union"
            }
        };
        data.set_item("kind", kind)?;
        Ok(data)
    }
}

fn rows(pose: &Pose) -> [[f64; 4]; 4] {
    pose.to_homogeneous().transpose().into()
}
