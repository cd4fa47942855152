//! Methods of `irbkin.Robot` that take joint vectors.

use std::array;

use numpy::PyArray0;
use numpy::ndarray::arr0;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyFloat;

use super::arguments::{FRAMES, one_of, read_threads, thread_count};
use super::arm::{SharedArm, joints, on};
use super::arrays::{Rows, copied_vector};
use super::errors::{Fault, exception};
use super::figure::Figure;
use super::outputs::{Output, answer, array};
use super::records::{self, Margin, Singularity};
use super::robot::PyRobot;
use super::signals::detached;
use irbkin::batch::Batch;
use irbkin::internal::{check_joints, check_near};
use irbkin::pose::to_rows as pose_to_rows;
use irbkin::thresholds::{NEAR_ANGLE, NEAR_LENGTH};
use irbkin::{Error, JointLimits, SingularDistances, SingularityKind, Status};

#[pymethods]
impl PyRobot {
    /// Forward kinematics: the pose of the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Array to write to, shape (..., 4, 4), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., 4, 4), translation [m]. In a batch, a row with a NaN
    ///     or inf gives NaN.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, a single joint vector that is not finite, or one, or
    ///         most of many, more than four turns outside the limits, as degrees are.
    #[pyo3(signature = (q, out=None))]
    fn fk<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        on!(self.arm(), robot => {
            if let Some(joints) = plain_joints(q, robot.limits())? {
                return answer(q, out, pose_to_rows(&robot.fk(&joints)).as_chunks::<4>().0);
            }
            mapped(self.arm(), q, out, &[4, 4], |batch, q, poses| batch.fk(robot, q, poses))
        })
    }

    /// Every frame of the modified Denavit-Hartenberg table after its joint, then the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     out: Array to write to, shape (..., n + 1, 4, 4), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Homogeneous matrices, shape (..., n + 1, 4, 4), translation [m]. In a batch, a row with
    ///     a NaN or inf gives NaN.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    #[pyo3(signature = (q, out=None))]
    fn link_frames<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let tail = [self.arm().dof() + 1, 4, 4];
        on!(self.arm(), robot => {
            mapped(self.arm(), q, out, &tail, |batch, q, frames| batch.link_frames(robot, q, frames))
        })
    }

    /// Geometric Jacobian of the tool.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     frame: "base", the frame in which poses are given, or "tool".
    ///     out: Array to write to, shape (..., 6, n), float64, C-contiguous; it is returned.
    ///
    /// Returns:
    ///     Shape (..., 6, n): three linear rows [m/rad], then three angular [1].
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    ///     ValueError: Another frame.
    #[pyo3(signature = (q, frame="base", out=None))]
    fn jacobian<'py>(
        &self,
        q: &Bound<'py, PyAny>,
        frame: &str,
        out: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let frame = one_of("frame", frame, &FRAMES)?;
        let tail = [6, self.arm().dof()];
        on!(self.arm(), robot => {
            if let Some(joints) = plain_joints(q, robot.limits())? {
                return answer(q, out, &robot.jacobian_rows(&joints, frame));
            }
            mapped(self.arm(), q, out, &tail, |batch, q, rows| batch.jacobian(robot, q, frame, rows))
        })
    }

    /// How far joint vectors are from the singularities.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Singularity; numbers for (n,), arrays of shape (...) for (..., n). NaN where an arm has
    ///     no such singularity. In a batch, a row with a NaN or inf gives NaN, and its `kinds` are
    ///     `irbkin.Status.INVALID`, 64.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single joint vector that is not finite.
    #[pyo3(signature = (q, *, threads=1))]
    fn singularity(
        &self,
        q: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
    ) -> PyResult<Singularity> {
        let (py, threads) = (q.py(), thread_count(threads)?);
        on!(self.arm(), robot => {
            if let Some(q) = plain_joints(q, robot.limits())? {
                return self.one_singularity(py, &q, robot.near_singularities(&q));
            }
        });
        let rows = joints(self.arm(), q)?;
        let (data, lead) = (rows.data()?, &rows.lead);
        on!(self.arm(), robot => {
            if let Some(q) = rows.single()? {
                return self.one_singularity(py, q, robot.near_singularities(q));
            }
        });
        let mut found = vec![None; lead.iter().product()];
        let to = &mut found[..];
        on!(self.arm(), robot => {
            detached(py, threads, |batch| batch.singularity(robot, data, to))?;
        });
        let number = |of: &dyn Fn(&irbkin::Singularity) -> f64| {
            array(py, found.iter().map(|it| it.as_ref().map_or(f64::NAN, of)), lead)
        };
        let distance = |index: usize| number(&|it| distances(it.distances)[index]);
        let kinds = |it: &Option<irbkin::Singularity>| {
            it.map_or(Status::INVALID.bits(), |it| it.kinds.bits())
        };
        Ok(Singularity {
            wrist: distance(0)?,
            elbow: distance(1)?,
            shoulder: distance(2)?,
            min_singular_value: Figure::Known(number(&|it| it.min_singular_value)?),
            manipulability: Figure::Known(number(&|it| it.manipulability)?),
            kinds: array(py, found.iter().map(kinds), lead)?,
        })
    }

    /// How far joint vectors are from limits and singularities, as parts of the farthest that they
    /// can be.
    ///
    /// Args:
    ///     q: Joint angles [rad], shape (..., n).
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Margin: two arrays of shape (...), 1 in the middle, 0 at a limit or a singularity,
    ///     negative outside limits. Of many rows, one with a NaN or inf gives NaN.
    ///
    /// Raises:
    ///     InvalidJointsError: A wrong shape, or a single row with a NaN or inf.
    #[pyo3(signature = (q, *, threads=1))]
    fn margin(
        &self,
        q: &Bound<'_, PyAny>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
    ) -> PyResult<Margin> {
        let (py, threads) = (q.py(), thread_count(threads)?);
        let one = on!(self.arm(), robot => {
            plain_joints(q, robot.limits())?.map(|q| robot.margin(&q))
        });
        if let Some(one) = one {
            let [limits, singularities] = [one.limits, one.singularities]
                .map(|number| PyArray0::from_array(py, &arr0(number)).into_any().unbind());
            return Ok(Margin { limits, singularities });
        }
        let rows = joints(self.arm(), q)?;
        let mut limits = Output::new(py, None, &rows.lead, &[])?;
        let mut singularities = Output::new(py, None, &rows.lead, &[])?;
        let (q, to_limits, to) = (rows.data()?, limits.slice()?, singularities.slice()?);
        on!(self.arm(), robot => {
            detached(py, threads, |batch| batch.margin(robot, q, to_limits, to))?;
        });
        Ok(Margin { limits: limits.array(), singularities: singularities.array() })
    }
}

#[pymethods]
impl Singularity {
    /// The singularities that joint vectors are at or near.
    ///
    /// Args:
    ///     angle: Distance from the wrist and from the elbow singularity [rad]; 1 deg by default.
    ///         Of an arm whose singularities have no names the least singular value, which then
    ///         counts as an elbow.
    ///     length: Distance from the shoulder singularity [m]; 10 mm by default.
    ///
    /// Returns:
    ///     SingularityKind, with those in `kinds`; for many its values, uint8, shape (...).
    ///
    /// Raises:
    ///     ValueError: A distance that is not positive and finite.
    #[pyo3(signature = (angle=NEAR_ANGLE, length=NEAR_LENGTH))]
    fn near<'py>(slf: &Bound<'py, Self>, angle: f64, length: f64) -> PyResult<Bound<'py, PyAny>> {
        for (name, bound) in [("angle", angle), ("length", length)] {
            if !(bound > 0.0 && bound.is_finite()) {
                let words = format!("{name} is {bound}, it must be positive and finite");
                return Err(PyValueError::new_err(words));
            }
        }
        let read =
            |field| Rows::shaped(&slf.getattr(field)?, || "(...)", field, Fault::Joints, |_| true);
        let wrist = read("wrist")?;
        let fields = [read("elbow")?, read("shoulder")?, read("min_singular_value")?];
        let others = [fields[0].data()?, fields[1].data()?, fields[2].data()?];
        let mut beside = wrist.data()?.iter().enumerate().map(|(row, &wrist)| {
            let [elbow, shoulder, min_singular_value] =
                others.map(|field| field.get(row).copied().unwrap_or(f64::NAN));
            let distances = SingularDistances { wrist, elbow, shoulder };
            let one = irbkin::Singularity {
                distances: (!wrist.is_nan()).then_some(distances),
                min_singular_value,
                manipulability: f64::NAN,
                kinds: SingularityKind::empty(),
            };
            one.near(angle, length)
        });
        let beside = if wrist.is_single() {
            records::kinds(slf.py(), beside.next().unwrap_or_default())?
        } else {
            array(slf.py(), beside.map(|it| it.bits()), &wrist.lead)?.into_bound(slf.py())
        };
        slf.getattr("kinds")?.bitor(beside)
    }
}

/// Distances from wrist, elbow and shoulder; NaN where an arm has no such singularity.
fn distances(of: Option<SingularDistances>) -> [f64; 3] {
    of.map_or([f64::NAN; 3], |of| [of.wrist, of.elbow, of.shoulder])
}

impl PyRobot {
    fn one_singularity(
        &self,
        py: Python<'_>,
        q: &[f64],
        (near, kinds): (Option<SingularDistances>, SingularityKind),
    ) -> PyResult<Singularity> {
        let number = |number: f64| PyFloat::new(py, number).into_any().unbind();
        let [wrist, elbow, shoulder] = distances(near).map(number);
        let at = array::from_fn(|joint| q.get(joint).copied().unwrap_or(0.0));
        let sought = |figure| Figure::Sought(self.arm().clone(), at, figure);
        Ok(Singularity {
            wrist,
            elbow,
            shoulder,
            min_singular_value: sought(|it| it.min_singular_value),
            manipulability: sought(|it| it.manipulability),
            kinds: records::kinds(py, kinds)?.unbind(),
        })
    }
}

/// An answer of shape (..., `tail`) for joint vectors (..., n), computed without the interpreter's
/// lock.
pub(super) fn mapped<'py>(
    arm: &SharedArm,
    q: &Bound<'py, PyAny>,
    out: Option<&Bound<'py, PyAny>>,
    tail: &[usize],
    compute: impl FnOnce(&mut Batch<'_>, &[f64], &mut [f64]) -> Result<(), Error> + Send,
) -> PyResult<Bound<'py, PyAny>> {
    let rows = joints(arm, q)?;
    let mut answer = Output::new(q.py(), out, &rows.shape_with(tail), &[rows.addresses()])?;
    let (data, slice) = (rows.data()?, answer.slice()?);
    detached(q.py(), None, |batch| compute(batch, data, slice))?;
    Ok(answer.bound())
}

/// A single joint vector that can be read the short way; it must be finite and
/// near the limits.
#[inline]
pub(super) fn plain_joints<const N: usize>(
    q: &Bound<'_, PyAny>,
    limits: &JointLimits<N>,
) -> PyResult<Option<[f64; N]>> {
    let Some(joints) = copied_vector::<N>(q) else { return Ok(None) };
    check_joints("q", &joints).map_err(exception)?;
    check_near("q", &joints, limits, &[1.0; N]).map_err(exception)?;
    Ok(Some(joints))
}
