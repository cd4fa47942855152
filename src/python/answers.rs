//! Records and arrays that answers are handed over in.

use std::num::NonZeroUsize;

use numpy::PyArrayDyn;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arm::{Arm, on};
use super::arrays::{Rows, addresses};
use super::classes::{self, pose_check_class};
use super::outputs::{checked_out, output, writable};
use super::records;
use super::signals::detached;
use crate::batch::Pace;
use crate::kinematics::{Singularity, Status};
use crate::report::Explanation;

/// `irbkin.Singularity` of one joint vector.
pub(super) fn singularity_record<'py>(
    py: Python<'py>,
    record: &Singularity,
) -> PyResult<Bound<'py, PyAny>> {
    let [wrist, elbow, shoulder, least, product] = numbers(record);
    let kinds = records::kinds(py, record.kinds)?;
    classes::singularity_class(py)?.call1((wrist, elbow, shoulder, least, product, kinds))
}

/// `irbkin.Singularity` of arrays with the leading dimensions of `q`.
pub(super) fn singularity_arrays<'py>(
    py: Python<'py>,
    arm: &Arm,
    q: &Rows<'py>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
    let out = match out.map(|out| out.cast::<PyTuple>().map(|out| (out, out.len()))) {
        None => None,
        Some(Ok((out, 6))) => Some(out),
        Some(_) => {
            return Err(PyTypeError::new_err(
                "out must be a Singularity, or a tuple of its six arrays",
            ));
        }
    };
    let mut memory = vec![q.addresses()];
    let (mut columns, mut views) = (Vec::new(), Vec::new());
    for field in 0..5 {
        let out = out.map(|out| out.get_item(field)).transpose()?;
        let column = output(py, out.as_ref(), &q.lead)?;
        views.push(writable(&column, &memory)?);
        memory.push(addresses(&column));
        columns.push(column);
    }
    let kinds = match out {
        Some(out) => checked_out(&out.get_item(5)?, &q.lead, "uint8")?,
        None => PyArrayDyn::zeros(py, q.lead.clone(), false),
    };
    let mut kinds_view = writable(&kinds, &memory)?;
    let mut parts = Vec::new();
    for view in &mut views {
        parts.push(view.as_slice_mut()?.chunks_mut(Pace::SINGULARITIES));
    }
    let kind_parts = kinds_view.as_slice_mut()?.chunks_mut(Pace::SINGULARITIES);
    let data = q.data()?;
    let parts = kind_parts
        .map(move |kinds| (kinds, parts.iter_mut().filter_map(Iterator::next).collect::<Vec<_>>()));
    detached(
        py,
        threads,
        |pace| on!(arm, robot => pace.singularity(robot, data, parts, write_part)),
    )?;
    let mut fields: Vec<Bound<'py, PyAny>> = columns.into_iter().map(Bound::into_any).collect();
    fields.push(kinds.into_any());
    classes::singularity_batch_class(py)?.call1(PyTuple::new(py, fields)?)
}

/// Writes some records into columns: the singularities, and the five numbers.
fn write_part(
    (kinds, mut columns): (&mut [u8], Vec<&mut [f64]>),
    records: &mut dyn Iterator<Item = Option<Singularity>>,
) {
    for (row, (record, kinds)) in records.zip(kinds).enumerate() {
        *kinds = record.map_or(Status::INVALID.bits(), |record| record.kinds.bits());
        let numbers = record.as_ref().map_or([f64::NAN; 5], numbers);
        for (column, number) in columns.iter_mut().zip(numbers) {
            column[row] = number;
        }
    }
}

/// The numbers of a record in the order of its fields; NaN where an arm has no such singularity.
fn numbers(record: &Singularity) -> [f64; 5] {
    let [wrist, elbow, shoulder] =
        record.distances.map_or([f64::NAN; 3], |d| [d.wrist, d.elbow, d.shoulder]);
    [wrist, elbow, shoulder, record.min_singular_value, record.manipulability]
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

/// `irbkin.PoseCheck` of the outcome of a solve.
pub(super) fn pose_check<'py>(
    py: Python<'py>,
    explanation: &Explanation,
) -> PyResult<Bound<'py, PyAny>> {
    let inside = matches!(explanation, Explanation::Found { .. });
    let reachable = inside
        || matches!(
            explanation,
            Explanation::OutsideLimits { .. } | Explanation::OutsideLinkage { .. }
        );
    pose_check_class(py)?.call1((reachable, inside, explanation.to_string()))
}
