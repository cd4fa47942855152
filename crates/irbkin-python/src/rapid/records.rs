//! Records of RAPID from and to matrices [m] and joint angles [rad].

use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

use super::class::{
    Argument, Field, JointTarget, LoadData, RapidPose, Refused, RobTarget, WobjData,
};
use crate::errors::{Fault, exception};
use crate::targets::{pose_array, read_pose};
use irbkin::pose::from_wxyz as pose_from_wxyz;
use irbkin::{Configuration, Pose};
use irbkin_abb::rapid::internal::rapid_pose;
use irbkin_abb::rapid::{self, NOT_THERE};

/// Powers of ten of the decimals of a position [mm] and a quaternion that are made of a matrix:
/// further ones are rounding errors.
const DECIMALS: [f64; 2] = [1e9, 1e12];

/// The homogeneous matrix of a frame.
fn matrix(py: Python<'_>, trans_mm: [f64; 3], rot: [f64; 4]) -> PyResult<Bound<'_, PyArray2<f64>>> {
    Ok(pose_array(py, &pose_from_wxyz(trans_mm.map(|mm| mm / 1e3), rot).map_err(exception)?))
}

/// The frame of a tool that the robot holds [m].
pub(crate) fn carried_tool(tool: &rapid::ToolData) -> PyResult<Pose> {
    if !tool.robhold {
        let message = "the tool is stationary (robhold FALSE), with_tool takes one that the robot \
                       holds: rapid.calc_joint_t takes both";
        return Err(Fault::Rapid.error(message));
    }
    pose_from_wxyz(tool.tframe.trans_mm.map(|mm| mm / 1e3), tool.tframe.rot).map_err(exception)
}

#[pymethods]
impl RapidPose {
    /// Return the frame of a homogeneous matrix, shape (4, 4), translation [m].
    #[staticmethod]
    #[pyo3(signature = (T))]
    fn of(T: &Bound<'_, PyAny>) -> PyResult<Self> {
        let rapid::RapidPose { trans_mm, rot } = rapid_pose(&read_pose(T)?);
        let [millimeters, units] = DECIMALS;
        // -0.0 is 0.
        let rounded = |value: f64, decimals: f64| (value * decimals).round() / decimals + 0.0;
        Ok(Self(rapid::RapidPose {
            trans_mm: trans_mm.map(|mm| rounded(mm, millimeters)),
            rot: rot.map(|part| rounded(part, units)),
        }))
    }

    /// Return the homogeneous matrix, shape (4, 4), translation [m].
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.0.trans_mm, self.0.rot)
    }
}

#[pymethods]
impl WobjData {
    /// Return the work object of a homogeneous matrix, its user frame in the world, shape (4, 4),
    /// translation [m].
    #[staticmethod]
    #[pyo3(signature = (T))]
    fn of(T: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(rapid::WobjData { uframe: RapidPose::of(T)?.0, ..rapid::WobjData::WOBJ0 }))
    }
}

#[pymethods]
impl RobTarget {
    /// Return the target of a homogeneous matrix, shape (4, 4), translation [m].
    #[staticmethod]
    #[pyo3(signature = (T, robconf, extax=Argument::Default([NOT_THERE; 6])))]
    fn of(
        T: &Bound<'_, PyAny>,
        robconf: Argument<'_, Configuration>,
        extax: Argument<'_, [f64; 6]>,
    ) -> PyResult<Self> {
        let RapidPose(rapid::RapidPose { trans_mm, rot }) = RapidPose::of(T)?;
        let robconf = robconf.read("RobTarget", "robconf")?;
        let extax = extax.read("RobTarget", "extax")?;
        Ok(Self(rapid::RobTarget { trans_mm, rot, robconf, extax }))
    }

    /// Return the homogeneous matrix of the tool in the work object, shape (4, 4), translation [m].
    fn matrix<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        matrix(py, self.0.trans_mm, self.0.rot)
    }
}

#[pymethods]
impl JointTarget {
    /// Return the target of joint angles [rad], shape (6,).
    #[staticmethod]
    #[pyo3(signature = (q, extax=Argument::Default([NOT_THERE; 6])))]
    fn of(q: Argument<'_, [f64; 6]>, extax: Argument<'_, [f64; 6]>) -> PyResult<Self> {
        let robax_deg = q.read("JointTarget", "robax_deg")?.map(f64::to_degrees);
        let extax = extax.read("JointTarget", "extax")?;
        Ok(Self(rapid::JointTarget { robax_deg, extax }))
    }

    /// Joint angles [rad], shape (6,).
    #[getter]
    fn q<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, &self.0.robax_deg.map(f64::to_radians))
    }
}

impl Field for rapid::RapidPose {
    /// A pose, or its position and quaternion, as RAPID writes them.
    fn read(given: &Bound<'_, PyAny>) -> Result<Self, Refused> {
        if let Ok(RapidPose(pose)) = given.extract() {
            return Ok(pose);
        }
        let is_pair = given.is_instance_of::<PyTuple>() || given.is_instance_of::<PyList>();
        if is_pair && given.len()? == 2 {
            let trans_mm = Argument::Object(given.get_item(0)?).read("Pose", "trans_mm")?;
            let rot = Argument::Object(given.get_item(1)?).read("Pose", "rot")?;
            return Ok(Self { trans_mm, rot });
        }
        Err(Refused::Wanted("a Pose (Pose.of(T) makes one of a matrix)".into()))
    }

    fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(Bound::new(py, RapidPose(*self))?.into_any())
    }
}

impl Field for rapid::LoadData {
    fn read(given: &Bound<'_, PyAny>) -> Result<Self, Refused> {
        given.extract().map(|LoadData(load)| load).map_err(|_| Refused::Wanted("a LoadData".into()))
    }

    fn show<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(Bound::new(py, LoadData(*self))?.into_any())
    }
}
