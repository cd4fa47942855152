//! Many poses with seeds: the nearest solutions, and paths followed.

use numpy::PyArrayDyn;
use pyo3::prelude::*;

use super::answers::{follow_result, index_in};
use super::arrays::{Rows, output, writable};
use super::errors::{Fault, to_py};
use super::found::read_weights;
use super::wording::shape;
use crate::batch;
use crate::kinematics::{
    Arity, FollowOptions, Inverse, Joints, Pose, Robot, check_seed, pose_from_rows,
};

/// The solutions nearest to seeds, a row for each pose.
pub(super) fn nearest<'py, const N: usize>(
    robot: &Robot<N>,
    poses: &Rows<'py>,
    seeds: &Bound<'py, PyAny>,
    weights: Option<&Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyArrayDyn<f64>>>
where
    Robot<N>: Inverse<N>,
    Joints<N>: Arity<N>,
{
    let py = seeds.py();
    let (weights, numbers) = (read_weights::<N>(weights)?, read_seeds::<N>(seeds, &poses.lead)?);
    let answer = output(py, None, &poses.shape_with(&[N]))?;
    let (data, mut view) = (poses.data()?, writable(&answer, &[])?);
    let q = view.as_slice_mut()?;
    py.detach(|| batch::ik_nearest(robot, data, &numbers, &weights, q))
        .map_err(|error| to_py(py, &error))?;
    Ok(answer)
}

/// Paths of poses, shape (..., m, 4, 4), each followed from its seed.
pub(super) fn follow<'py>(
    robot: &Robot<6>,
    paths: &Bound<'py, PyAny>,
    seeds: &Bound<'py, PyAny>,
    options: &FollowOptions,
) -> PyResult<Bound<'py, PyAny>> {
    let py = paths.py();
    let rows = Rows::read(paths, &[4, 4], "T", Fault::Pose)?;
    let [lead @ .., length] = &rows.lead[..] else {
        return Err(Fault::Pose.error(
            py,
            format!("T must have shape (..., m, 4, 4), got {}", shape(&rows.shape_with(&[4, 4]))),
        ));
    };
    let seeds = read_seeds::<6>(seeds, lead)?;
    let seeds = seeds.as_chunks::<6>().0;
    if let Some((path, error)) = seeds
        .iter()
        .enumerate()
        .find_map(|(path, seed)| Some((path, check_seed("seed", seed).err()?)))
    {
        return Err(if lead.is_empty() {
            to_py(py, &error)
        } else {
            Fault::Joints.error(py, format!("seed{:?}: {error}", index_in(lead, path)))
        });
    }
    let poses = rows.data()?.as_chunks::<16>().0.iter().enumerate();
    let pose = |(number, row)| {
        pose_from_rows(row).map_err(|error| {
            Fault::Pose.error(py, format!("T{:?}: {error}", index_in(&rows.lead, number)))
        })
    };
    let poses = poses.map(pose).collect::<PyResult<Vec<Pose>>>()?;
    let followed = py.detach(|| {
        let path = |(number, seed)| {
            robot.follow(&poses[number * length..(number + 1) * length], seed, options)
        };
        seeds.iter().enumerate().map(path).collect::<Result<Vec<_>, _>>()
    });
    follow_result(py, &followed.map_err(|error| to_py(py, &error))?, lead, *length)
}

/// A seed for each row with the leading dimensions `lead`, or one for all.
pub(super) fn read_seeds<const N: usize>(
    seeds: &Bound<'_, PyAny>,
    lead: &[usize],
) -> PyResult<Vec<f64>> {
    let rows = Rows::read(seeds, &[N], "seed", Fault::Joints)?;
    if rows.lead == lead {
        return Ok(rows.data()?.to_vec());
    }
    if !rows.is_single() {
        let (one, many) = (shape(&[N]), shape(&[lead, &[N]].concat()));
        let wanted = if one == many { one } else { format!("{one} or {many}") };
        let got = shape(&rows.shape_with(&[N]));
        return Err(
            Fault::Joints.error(seeds.py(), format!("seed must have shape {wanted}, got {got}"))
        );
    }
    check_seed("seed", rows.data()?).map_err(|error| to_py(seeds.py(), &error))?;
    Ok(rows.data()?.repeat(lead.iter().product()))
}
