//! The solutions of many poses nearest to seeds.

use std::num::NonZeroUsize;

use pyo3::prelude::*;

use super::arrays::{Argument, Rows, copied_matrix4, copied_vector, together};
use super::errors::{Fault, to_py};
use super::found::read_weights;
use super::outputs::{output, writable};
use super::poses::single_pose;
use super::signals::detached;
use crate::kinematics::{Pose, Robot, check_seed, pose_from_rows};

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
    match (copied_matrix4(poses), copied_vector(seeds)) {
        (Some(pose), Some(seed)) => one(poses.py(), &pose, seed),
        _ => read_arrays(poses, seeds),
    }
}

fn one<'py, const N: usize>(
    py: Python<'py>,
    pose: &[f64; 16],
    seed: [f64; N],
) -> PyResult<Seeded<'py, N>> {
    let pose = pose_from_rows(pose).map_err(|error| to_py(py, &error))?;
    check_seed("seed", &seed).map_err(|error| to_py(py, &error))?;
    Ok(Seeded::One(pose, seed))
}

#[inline(never)]
fn read_arrays<'py, const N: usize>(
    poses: &Bound<'py, PyAny>,
    seeds: &Bound<'py, PyAny>,
) -> PyResult<Seeded<'py, N>> {
    let py = poses.py();
    let mut poses = Rows::read(poses, &[4, 4], "T", Fault::Pose)?;
    let mut seeds = Rows::read(seeds, &[N], "seed", Fault::Joints)?;
    let pose = single_pose(py, &poses)?;
    let seed = single_seed::<N>(py, &seeds)?;
    if let (Some(pose), Some(seed)) = (pose, seed) {
        return Ok(Seeded::One(pose, seed));
    }
    together(
        py,
        &mut [
            Argument { field: "T", fault: Fault::Pose, rows: &mut poses },
            Argument { field: "seed", fault: Fault::Joints, rows: &mut seeds },
        ],
    )?;
    Ok(Seeded::Many(poses, seeds))
}

/// The seed where there is one alone, checked.
pub(super) fn single_seed<const N: usize>(
    py: Python<'_>,
    seeds: &Rows<'_>,
) -> PyResult<Option<[f64; N]>> {
    match seeds.data()?.as_chunks::<N>().0 {
        [seed] if seeds.is_single() => {
            check_seed("seed", seed).map_err(|error| to_py(py, &error))?;
            Ok(Some(*seed))
        }
        _ => Ok(None),
    }
}

/// The solutions nearest to seeds, a row for each pose.
pub(super) fn many<'py, const N: usize>(
    py: Python<'py>,
    robot: &Robot<N>,
    poses: &Rows<'py>,
    seeds: &Rows<'py>,
    weights: Option<&Bound<'py, PyAny>>,
    out: Option<&Bound<'py, PyAny>>,
    threads: Option<NonZeroUsize>,
) -> PyResult<Bound<'py, PyAny>> {
    let weights = read_weights::<N>(weights)?;
    let answer = output(py, out, &poses.shape_with(&[N]))?;
    let mut view = writable(&answer, &[poses.addresses(), seeds.addresses()])?;
    let (pose_data, seed_data, q) = (poses.data()?, seeds.data()?, view.as_slice_mut()?);
    detached(py, threads, |pace| pace.ik_nearest(robot, pose_data, seed_data, &weights, q))?;
    Ok(answer.into_any())
}
