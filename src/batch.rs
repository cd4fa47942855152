//! Many poses or joint vectors at once, over flat row-major slices.
//!
//! The seam to arrays: a row that is not finite gives a row of NaN, and where the answer has a status, [`Status::INVALID`]. A row's answer
//! does not depend on its neighbours.

use nalgebra::SMatrix;

use crate::error::{Error, ModelFault};
use crate::kinematics::{JacobianFrame, Robot, SLOTS, Singularity, Status, pose_from_rows, pose_to_rows};

/// Forward kinematics: rows of `N` joint angles to rows of 16 pose elements.
///
/// # Errors
///
/// [`Error::WrongLength`] when a slice does not hold as many rows as `q`.
pub fn fk<const N: usize>(robot: &Robot<N>, q: &[f64], poses: &mut [f64]) -> Result<(), Error> {
    let q = rows::<N>("q", q)?;
    for (q, pose) in q.iter().zip(rows_out::<16, f64>("poses", poses, q.len())?) {
        *pose = if is_finite(q) { pose_to_rows(&robot.fk(q)) } else { [f64::NAN; 16] };
    }
    Ok(())
}

/// Link frames: rows of `N` joint angles to `N + 1` times 16 pose elements a row.
///
/// # Errors
///
/// As [`fk`].
pub fn link_frames<const N: usize>(robot: &Robot<N>, q: &[f64], frames: &mut [f64]) -> Result<(), Error> {
    let q = rows::<N>("q", q)?;
    let frames = rows_out::<16, f64>("frames", frames, q.len() * (N + 1))?;
    for (q, frames) in q.iter().zip(frames.chunks_exact_mut(N + 1)) {
        if !is_finite(q) {
            frames.fill([f64::NAN; 16]);
            continue;
        }
        let (links, tool) = robot.link_frames(q);
        for (to, from) in frames.iter_mut().zip(links.iter().chain([&tool])) {
            *to = pose_to_rows(from);
        }
    }
    Ok(())
}

/// Geometric Jacobians: rows of `N` joint angles to rows of 6 times `N` elements.
///
/// # Errors
///
/// As [`fk`].
pub fn jacobian<const N: usize>(robot: &Robot<N>, q: &[f64], frame: JacobianFrame, jacobians: &mut [f64]) -> Result<(), Error> {
    let q = rows::<N>("q", q)?;
    let jacobians = rows_out::<N, f64>("jacobians", jacobians, q.len() * 6)?;
    for (q, out) in q.iter().zip(jacobians.chunks_exact_mut(6)) {
        let jacobian = if is_finite(q) { robot.jacobian(q, frame) } else { SMatrix::repeat(f64::NAN) };
        for (to, from) in out.iter_mut().zip(jacobian.row_iter()) {
            *to = core::array::from_fn(|joint| from[joint]);
        }
    }
    Ok(())
}

/// Distances from the singularities, one record a row of `N` joint angles; `None` for a row that is not finite.
///
/// # Errors
///
/// As [`fk`].
pub fn singularity<'a, const N: usize>(robot: &'a Robot<N>, q: &'a [f64]) -> Result<impl Iterator<Item = Option<Singularity>> + 'a, Error> {
    Ok(rows::<N>("q", q)?.iter().map(|q| is_finite(q).then(|| robot.singularity(q))))
}

/// Inverse kinematics: rows of 16 pose elements to eight slots of six joint angles and eight [`Status`] bytes a row, on up to `threads`
/// threads, but no more than there are cores. Empty slots are NaN.
///
/// # Errors
///
/// [`Error::WrongLength`] when a slice does not hold as many rows as `poses`, [`Error::InvalidModel`] when the arm has no closed form.
pub fn ik(robot: &Robot<6>, poses: &[f64], q: &mut [f64], status: &mut [u8], threads: usize) -> Result<(), Error> {
    if let Some(reason) = robot.no_closed_form() {
        return Err(ModelFault::NoClosedForm(reason).into());
    }
    let poses = rows::<16>("poses", poses)?;
    let q = rows_out::<{ SLOTS * 6 }, f64>("q", q, poses.len())?;
    let status = rows_out::<SLOTS, u8>("status", status, poses.len())?;
    let threads = threads.clamp(1, std::thread::available_parallelism().map_or(1, usize::from));
    let share = poses.len().div_ceil(threads).max(1);
    std::thread::scope(|scope| {
        let mut parts = poses.chunks(share).zip(q.chunks_mut(share)).zip(status.chunks_mut(share));
        let own = parts.next();
        for ((poses, q), status) in parts {
            scope.spawn(|| ik_rows(robot, poses, q, status));
        }
        if let Some(((poses, q), status)) = own {
            ik_rows(robot, poses, q, status);
        }
    });
    Ok(())
}

fn ik_rows(robot: &Robot<6>, poses: &[[f64; 16]], q: &mut [[f64; SLOTS * 6]], status: &mut [[u8; SLOTS]]) {
    for ((rows, q), status) in poses.iter().zip(q).zip(status) {
        q.fill(f64::NAN);
        let Ok(solutions) = pose_from_rows(rows).and_then(|pose| robot.ik_checked(pose)) else {
            status.fill(Status::INVALID.bits());
            continue;
        };
        *status = solutions.status().map(|status| status.bits());
        for solution in &solutions {
            q.as_chunks_mut::<6>().0[usize::from(solution.slot)] = solution.q;
        }
    }
}

/// The whole rows of an input.
fn rows<'a, const R: usize>(field: &'static str, numbers: &'a [f64]) -> Result<&'a [[f64; R]], Error> {
    match numbers.as_chunks::<R>() {
        (rows, []) => Ok(rows),
        _ => Err(Error::WrongLength { field, found: numbers.len(), wanted: numbers.len().div_ceil(R) * R }),
    }
}

/// The rows of an output for `count` answers.
fn rows_out<'a, const R: usize, T>(field: &'static str, out: &'a mut [T], count: usize) -> Result<&'a mut [[T; R]], Error> {
    if out.len() != count * R {
        return Err(Error::WrongLength { field, found: out.len(), wanted: count * R });
    }
    Ok(out.as_chunks_mut::<R>().0)
}

fn is_finite(q: &[f64]) -> bool {
    q.iter().all(|angle| angle.is_finite())
}
