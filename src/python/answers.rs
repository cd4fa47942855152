//! Records and arrays that answers are handed over in.

use numpy::{PyArray1, PyArrayDyn, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arrays::{Rows, checked_out, output};
use super::classes;
use super::records;
use crate::kinematics::{BreakReason, Followed, Singularity, SingularityKind};

/// `irbkin.Singularity` of one record, or `irbkin.SingularityBatch` of records with the leading
/// dimensions `lead`.
pub(super) fn singularity_record<'py>(
    py: Python<'py>,
    records: &[Option<Singularity>],
    lead: Option<&Vec<usize>>,
) -> PyResult<Bound<'py, PyAny>> {
    let number = |of: fn(&Singularity) -> Option<f64>| {
        records.iter().map(move |record| record.as_ref().and_then(of).unwrap_or(f64::NAN))
    };
    let columns = [
        number(|s| s.distances.map(|d| d.wrist)),
        number(|s| s.distances.map(|d| d.elbow)),
        number(|s| s.distances.map(|d| d.shoulder)),
        number(|s| Some(s.min_singular_value)),
        number(|s| Some(s.manipulability)),
    ];
    let kinds = |record: &Option<Singularity>| {
        record.map_or(SingularityKind::empty(), |record| record.kinds)
    };
    let mut fields: Vec<Bound<'py, PyAny>> = Vec::with_capacity(6);
    for mut column in columns {
        fields.push(match lead {
            Some(lead) => PyArray1::from_iter(py, column).reshape(lead.clone())?.into_any(),
            None => column.next().into_pyobject(py)?.into_any(),
        });
    }
    fields.push(match lead {
        Some(lead) => PyArray1::from_iter(py, records.iter().map(|record| kinds(record).bits()))
            .reshape(lead.clone())?
            .into_any(),
        None => records::kinds(py, records.first().map_or(SingularityKind::empty(), kinds))?,
    });
    let class = match lead {
        Some(_) => classes::singularity_batch_class(py)?,
        None => classes::singularity_class(py)?,
    };
    class.call1(PyTuple::new(py, fields)?)
}

pub(super) type BatchArrays<'py> = (Bound<'py, PyArrayDyn<f64>>, Bound<'py, PyArrayDyn<u8>>);

/// The arrays that a batch is written to.
pub(super) fn batch_output<'py>(
    py: Python<'py>,
    out: Option<&Bound<'py, PyAny>>,
    poses: &Rows<'_>,
    [slots, dof]: [usize; 2],
) -> PyResult<BatchArrays<'py>> {
    let (q_shape, status_shape) = (poses.shape_with(&[slots, dof]), poses.shape_with(&[slots]));
    let pair = out.and_then(|out| out.cast::<PyTuple>().ok());
    match pair {
        Some(pair) if pair.len() == 2 => Ok((
            output(py, Some(&pair.get_item(0)?), &q_shape)?,
            checked_out(&pair.get_item(1)?, &status_shape, "uint8")?,
        )),
        Some(pair) => Err(PyTypeError::new_err(format!(
            "out must be (q, status), got a tuple of {}",
            pair.len()
        ))),
        None => Ok((output(py, out, &q_shape)?, PyArrayDyn::zeros(py, status_shape, false))),
    }
}

/// `irbkin.FollowResult` of followed paths with the leading dimensions `lead`, of `poses` poses
/// each.
pub(super) fn follow_result<'py>(
    py: Python<'py>,
    followed: &[Followed],
    lead: &[usize],
    poses: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let joints: Vec<f64> =
        followed.iter().flat_map(|path| &path.q).flat_map(|q| q.unwrap_or([f64::NAN; 6])).collect();
    let joints = PyArray1::from_vec(py, joints).reshape([lead, &[poses, 6]].concat())?;
    let errors: Vec<f64> = followed
        .iter()
        .flat_map(|path| &path.orientation_error)
        .map(|error| error.unwrap_or(f64::NAN))
        .collect();
    let errors = PyArray1::from_vec(py, errors).reshape([lead, &[poses]].concat())?;
    let mut breaks = Vec::new();
    for (path, followed) in followed.iter().enumerate() {
        for broken in &followed.breaks {
            let place = PyTuple::new(py, index_in(lead, path))?;
            breaks.push(classes::break_class(py)?.call1((
                broken.pose_index,
                broken.to_string(),
                place,
                break_kind(py, &broken.reason)?,
            ))?);
        }
    }
    classes::follow_result_class(py)?.call1((joints, errors, PyTuple::new(py, breaks)?))
}

/// `irbkin.BreakReason` of a break.
fn break_kind<'py>(py: Python<'py>, reason: &BreakReason) -> PyResult<Bound<'py, PyAny>> {
    classes::break_reason_class(py)?.getattr(match reason {
        BreakReason::Unreachable(_) => "UNREACHABLE",
        BreakReason::Jump { .. } => "JUMP",
        BreakReason::Locked => "LOCKED",
        BreakReason::Stopped { .. } => "STOPPED",
    })
}

/// The index of an element by its number in row-major order.
pub(super) fn index_in(shape: &[usize], mut number: usize) -> Vec<usize> {
    let mut index: Vec<usize> = shape
        .iter()
        .rev()
        .map(|size| {
            let at = number % size;
            number /= size;
            at
        })
        .collect();
    index.reverse();
    index
}
