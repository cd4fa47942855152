//! Poses, seeds and weights: what a solve is asked for.

use numpy::{PyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use super::arrays::{Rows, as_array, copied_matrix4, copied_vector, matrix4, together, vector};
use super::errors::{Fault, exception, index_in, shape_text};
use super::outputs::matrix;
use irbkin::Pose;
use irbkin::internal::{check_seed, check_weights};
use irbkin::pose::{
    from_rows as pose_from_rows, from_wxyz as pose_from_wxyz, to_rows as pose_to_rows,
};
use irbkin::thresholds::MOST_REACH;

/// Longest path of an arm without a rail [m]: no arm of the catalog reaches 5 m.
const LONGEST: f64 = 10.0;

/// Poses that are read between two looks at the signals.
const POSES_AT_A_TIME: usize = 1 << 18;

/// The argument T as a checked pose.
pub(super) fn read_pose(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    pose_from_rows(&matrix4(value, "T", Fault::Pose)?).map_err(exception)
}

/// The argument T of `ik`, without NumPy's bookkeeping where it is plain.
#[inline]
pub(super) fn read_ik_pose(value: &Bound<'_, PyAny>) -> PyResult<Pose> {
    match copied_matrix4(value) {
        Some(rows) => Ok(pose_from_rows(&rows).map_err(exception)?),
        None => read_one_pose(value, " (for many poses take ik_batch)"),
    }
}

/// The argument T of a method that takes one pose and has no batch.
pub(super) fn read_single_pose(value: &Bound<'_, PyAny>, method: &str) -> PyResult<Pose> {
    read_one_pose(value, &format!(": {method} takes a single pose, call it for each"))
}

/// A frame of the robot: a pose as the argument T of `method`, or its translation alone.
pub(super) fn read_frame(value: &Bound<'_, PyAny>, method: &str) -> PyResult<Pose> {
    match shape_of(value).as_deref() {
        Some([3]) => read_place(value, "T"),
        _ => read_single_pose(value, method),
    }
}

/// Where something is, as the argument `field`: a pose, or its translation alone.
pub(super) fn read_place(value: &Bound<'_, PyAny>, field: &'static str) -> PyResult<Pose> {
    match shape_of(value).as_deref() {
        Some([3]) => Ok(pose_from_wxyz(vector(value, field, Fault::Pose)?, [1.0, 0.0, 0.0, 0.0])
            .map_err(exception)?),
        _ => Ok(pose_from_rows(&matrix4(value, field, Fault::Pose)?).map_err(exception)?),
    }
}

/// The argument T of a call that takes one pose; a message on many ends with `many`.
fn read_one_pose(value: &Bound<'_, PyAny>, many: &str) -> PyResult<Pose> {
    read_pose(value).map_err(|error| match shape_of(value).as_deref() {
        Some(sizes @ [_, .., 4, 4]) => {
            let got = shape_text(sizes);
            Fault::Pose.error(format_args!("T must have shape (4, 4), got {got}{many}"))
        }
        _ => error,
    })
}

/// The pose where there is one alone, checked.
pub(super) fn single_pose(poses: &Rows<'_>) -> PyResult<Option<Pose>> {
    poses.single()?.map(pose_from_rows).transpose().map_err(exception)
}

/// The poses of one path `T`, shape (m, 4, 4), checked.
pub(super) fn read_path_poses(path: &Bound<'_, PyAny>) -> PyResult<Vec<Pose>> {
    let is_path = |shape: &[usize]| matches!(shape, [_, 4, 4]);
    let rows = Rows::shaped(path, || "(m, 4, 4)", "T", Fault::Pose, is_path)?;
    read_path(path.py(), &rows, &rows.lead[..1])
}

/// Ask back for the poses of a path in millimeters: a path that no arm makes. It may be far away, in
/// the frame of a site, or long near its origin, along a rail.
pub(super) fn check_meters(poses: &[Pose]) -> PyResult<()> {
    let most = |from: &Pose| {
        let distances =
            poses.iter().map(|it| (it.translation.vector - from.translation.vector).norm());
        distances.fold(0.0, f64::max)
    };
    let (away, long) = (most(&Pose::identity()), poses.first().map_or(0.0, most));
    if away <= MOST_REACH || long <= LONGEST {
        return Ok(());
    }
    Err(Fault::Pose.error(format_args!(
        "the path is {long:.1} m long and {away:.1} m away, it must be at most {LONGEST} m long \
         where it is beyond {MOST_REACH} m (is the pose in millimeters? meters are wanted)"
    )))
}

/// Every pose of paths of the shape `shape`, checked.
pub(super) fn read_path(py: Python<'_>, rows: &Rows<'_>, shape: &[usize]) -> PyResult<Vec<Pose>> {
    let rows = rows.chunks::<16>()?;
    let mut poses = Vec::with_capacity(rows.len());
    for row in rows {
        if poses.len().is_multiple_of(POSES_AT_A_TIME) {
            py.check_signals()?;
        }
        poses.push(pose_from_rows(row).map_err(|error| {
            Fault::Pose.error(format_args!("T{:?}: {error}", index_in(shape, poses.len())))
        })?);
    }
    Ok(poses)
}

pub(super) fn shape_of(value: &Bound<'_, PyAny>) -> Option<Vec<usize>> {
    Some(as_array(value).ok()?.shape().to_vec())
}

/// A pose as a (4, 4) array.
pub(super) fn pose_array<'py>(py: Python<'py>, pose: &Pose) -> Bound<'py, PyArray2<f64>> {
    matrix(py, pose_to_rows(pose).as_chunks::<4>().0)
}

pub(super) fn read_seed<const N: usize>(seed: &Bound<'_, PyAny>) -> PyResult<[f64; N]> {
    let seed = vector::<N>(seed, "seed", Fault::Joints)?;
    check_seed("seed", &seed).map_err(exception)?;
    Ok(seed)
}

/// Weights, checked; ones where none were given.
pub(super) fn read_weights<const N: usize>(
    weights: Option<&Bound<'_, PyAny>>,
) -> PyResult<[f64; N]> {
    let Some(given) = weights else { return Ok([1.0; N]) };
    let weights = vector::<N>(given, "weights", Fault::Joints)?;
    check_weights(&weights).map_err(exception)?;
    Ok(weights)
}

/// The seed where there is one alone, checked.
pub(super) fn single_seed<const N: usize>(seeds: &Rows<'_>) -> PyResult<Option<[f64; N]>> {
    let seed = seeds.single::<N>()?;
    seed.map(|seed| check_seed("seed", seed)).transpose().map_err(exception)?;
    Ok(seed.copied())
}

/// A pose with a seed, or many.
pub(super) enum Seeded<'py, const N: usize> {
    One(Pose, [f64; N]),
    /// With the same leading dimensions.
    Many(Rows<'py>, Rows<'py>),
}

/// The arguments T and `seed`, which are broadcast. What stands for all rows is checked.
#[inline]
pub(super) fn read_seeded<'py, const N: usize>(
    poses: &Bound<'py, PyAny>,
    seeds: &Bound<'py, PyAny>,
) -> PyResult<Seeded<'py, N>> {
    if let (Some(pose), Some(seed)) = (copied_matrix4(poses), copied_vector(seeds)) {
        let pose = pose_from_rows(&pose).map_err(exception)?;
        check_seed("seed", &seed).map_err(exception)?;
        return Ok(Seeded::One(pose, seed));
    }
    read_arrays(poses, seeds)
}

#[inline(never)]
fn read_arrays<'py, const N: usize>(
    poses: &Bound<'py, PyAny>,
    seeds: &Bound<'py, PyAny>,
) -> PyResult<Seeded<'py, N>> {
    let mut poses = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    let mut seeds = Rows::read(seeds, &[N], "seed", Fault::Joints)?;
    if let (Some(pose), Some(seed)) = (single_pose(&poses)?, single_seed(&seeds)?) {
        return Ok(Seeded::One(pose, seed));
    }
    together(&mut [&mut poses, &mut seeds])?;
    Ok(Seeded::Many(poses, seeds))
}

/// Joint vectors that are checked; an error has the place of its row among several.
pub(super) fn checked_joints<'a, const N: usize>(
    field: &'static str,
    rows: &'a Rows<'_>,
) -> PyResult<&'a [[f64; N]]> {
    let all = rows.chunks::<N>()?;
    for (row, q) in all.iter().enumerate() {
        check_seed(field, q).map_err(|error| {
            if rows.is_single() {
                return exception(error);
            }
            let place = index_in(&rows.lead, row);
            Fault::Joints.error(format_args!("{field}{place:?}: {error}"))
        })?;
    }
    Ok(all)
}
