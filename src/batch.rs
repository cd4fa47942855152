//! Many poses or joint vectors at once, over flat row-major slices.
//!
//! The seam to arrays: a row that is not finite gives a row of NaN, and where the answer has a status, [`Status::INVALID`]. A row's answer
//! does not depend on its neighbours.

use nalgebra::SMatrix;

use crate::error::{Error, ModelFault};
use crate::kinematics::{JacobianFrame, Robot, SLOTS, Singularity, Status, pose_from_rows, pose_to_rows};

/// Forward kinematics: rows of `N` joint angles to rows of 16 pose elements.
pub fn fk<const N: usize>(robot: &Robot<N>, q: &[f64], poses: &mut [f64]) {
    for (q, pose) in q.as_chunks::<N>().0.iter().zip(poses.as_chunks_mut::<16>().0) {
        *pose = if is_finite(q) { pose_to_rows(&robot.fk(q)) } else { [f64::NAN; 16] };
    }
}

/// Link frames: rows of `N` joint angles to `N + 1` times 16 pose elements a row.
pub fn link_frames<const N: usize>(robot: &Robot<N>, q: &[f64], frames: &mut [f64]) {
    for (q, frames) in q.as_chunks::<N>().0.iter().zip(frames.chunks_exact_mut(16 * (N + 1))) {
        let frames = frames.as_chunks_mut::<16>().0;
        if !is_finite(q) {
            frames.fill([f64::NAN; 16]);
            continue;
        }
        let (links, tool) = robot.link_frames(q);
        for (to, from) in frames.iter_mut().zip(links.iter().chain([&tool])) {
            *to = pose_to_rows(from);
        }
    }
}

/// Geometric Jacobians: rows of `N` joint angles to rows of 6 times `N` elements.
pub fn jacobian<const N: usize>(robot: &Robot<N>, q: &[f64], frame: JacobianFrame, jacobians: &mut [f64]) {
    for (q, out) in q.as_chunks::<N>().0.iter().zip(jacobians.chunks_exact_mut(6 * N)) {
        let jacobian = if is_finite(q) { robot.jacobian(q, frame) } else { SMatrix::repeat(f64::NAN) };
        // The transpose in nalgebra's column-major order is the matrix in row-major order.
        out.copy_from_slice(jacobian.transpose().as_slice());
    }
}

/// Distances from the singularities, one record a row of `N` joint angles; `None` for a row that is not finite.
pub fn singularity<'a, const N: usize>(robot: &'a Robot<N>, q: &'a [f64]) -> impl Iterator<Item = Option<Singularity>> + 'a {
    q.as_chunks::<N>().0.iter().map(|q| is_finite(q).then(|| robot.singularity(q)))
}

/// Inverse kinematics: rows of 16 pose elements to eight slots of six joint angles and eight [`Status`] bytes a row, on up to `threads`
/// threads. Empty slots are NaN.
///
/// # Errors
///
/// [`Error::InvalidModel`] when the arm has no closed form.
pub fn ik(robot: &Robot<6>, poses: &[f64], q: &mut [f64], status: &mut [u8], threads: usize) -> Result<(), Error> {
    if let Some(reason) = robot.no_closed_form() {
        return Err(ModelFault::NoClosedForm(reason).into());
    }
    let poses = poses.as_chunks::<16>().0;
    let q = q.as_chunks_mut::<{ SLOTS * 6 }>().0;
    let status = status.as_chunks_mut::<SLOTS>().0;
    let share = poses.len().div_ceil(threads.max(1)).max(1);
    if share >= poses.len() {
        ik_rows(robot, poses, q, status);
        return Ok(());
    }
    std::thread::scope(|scope| {
        for ((poses, q), status) in poses.chunks(share).zip(q.chunks_mut(share)).zip(status.chunks_mut(share)) {
            scope.spawn(|| ik_rows(robot, poses, q, status));
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

fn is_finite(q: &[f64]) -> bool {
    q.iter().all(|angle| angle.is_finite())
}
