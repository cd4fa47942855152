//! Many poses or joint vectors at once, over flat row-major slices.
//!
//! A row that is not finite gives a row of NaN and, if the answer has a status,
//! [`Status::INVALID`]. A row's answer does not depend on its neighbors.

#[cfg(feature = "std")]
use rayon::prelude::*;

use alloc::vec;
use core::num::NonZeroUsize;

use crate::error::{Error, ModelFault};
use crate::kinematics::{
    Arity, Inverse, JacobianFrame, Joints, RedundancyOf, Robot, Rows, Singularity, check_seed,
    check_weights, pose_from_rows, pose_to_rows,
};
use crate::report::Configuration;

/// Forward kinematics: from rows of `N` joint angles [rad] to rows of 16 pose elements.
///
/// # Errors
///
/// [`Error::WrongLength`] when a slice does not have as many rows as `q`.
pub fn fk<const N: usize>(robot: &Robot<N>, q: &[f64], poses: &mut [f64]) -> Result<(), Error>
where
    Joints<N>: Arity<N>,
{
    let q = rows::<N>("q", q)?;
    robot.fk_rows(q, rows_out::<16, f64>("poses", poses, q.len())?);
    Ok(())
}

/// Link frames: from rows of `N` joint angles [rad] to rows of `N + 1` times 16 pose elements.
///
/// # Errors
///
/// As [`fk`].
pub fn link_frames<const N: usize>(
    robot: &Robot<N>,
    q: &[f64],
    frames: &mut [f64],
) -> Result<(), Error>
where
    Joints<N>: Arity<N>,
{
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

/// Geometric Jacobians: from rows of `N` joint angles [rad] to rows of 6 times `N` elements.
///
/// # Errors
///
/// As [`fk`].
pub fn jacobian<const N: usize>(
    robot: &Robot<N>,
    q: &[f64],
    frame: JacobianFrame,
    jacobians: &mut [f64],
) -> Result<(), Error>
where
    Joints<N>: Arity<N>,
{
    let q = rows::<N>("q", q)?;
    let jacobians = rows_out::<N, f64>("jacobians", jacobians, q.len() * 6)?;
    robot.jacobians(q, frame, jacobians.as_chunks_mut::<6>().0);
    Ok(())
}

/// Distances from the singularities, one record for each row of `N` joint angles [rad]; `None` for
/// a row that is not finite.
///
/// # Errors
///
/// As [`fk`].
pub fn singularity<'a, const N: usize>(
    robot: &'a Robot<N>,
    q: &'a [f64],
) -> Result<impl Iterator<Item = Option<Singularity>> + 'a, Error>
where
    Joints<N>: Arity<N>,
{
    Ok(robot.singularities(rows::<N>("q", q)?))
}

/// Inverse kinematics: from rows of 16 pose elements, each with its redundancy parameter (`()` for
/// six joints, the angle of joint 7 [rad] for seven), to rows of [`Robot::slot_count`] slots of `N`
/// joint angles [rad] and as many [`Status`](crate::Status) bytes. Empty slots are NaN.
///
/// Uses up to `threads` threads, at most one per core; without the feature `std`, the caller's.
///
/// # Errors
///
/// [`Error::WrongLength`] when a slice does not have as many rows as `poses`,
/// [`Error::InvalidModel`] when the structure of the arm is unknown.
pub fn ik_with<const N: usize>(
    robot: &Robot<N>,
    poses: &[f64],
    redundancy: &[RedundancyOf<N>],
    q: &mut [f64],
    status: &mut [u8],
    threads: Option<NonZeroUsize>,
) -> Result<(), Error>
where
    Joints<N>: Arity<N>,
{
    check_structure(robot)?;
    let poses = rows::<16>("poses", poses)?;
    check_length("redundancy", redundancy.len(), poses.len())?;
    check_length("q", q.len(), robot.slot_count() * N * poses.len())?;
    check_length("status", status.len(), robot.slot_count() * poses.len())?;
    #[cfg(feature = "std")]
    if let Some(pool) = pool(threads, poses.len()) {
        let slots = robot.slot_count() * PART;
        let answers = q.par_chunks_mut(N * slots).zip(status.par_chunks_mut(slots));
        let asked = poses.par_chunks(PART).zip(redundancy.par_chunks(PART));
        pool.install(|| {
            asked.zip(answers).for_each(|((poses, redundancy), (q, status))| {
                robot.ik_rows(Rows { poses, redundancy, q, status });
            });
        });
        return Ok(());
    }
    #[cfg(not(feature = "std"))]
    let _ = threads;
    robot.ik_rows(Rows { poses, redundancy, q, status });
    Ok(())
}

/// [`ik_with`] for an arm of six joints.
///
/// # Errors
///
/// As [`ik_with`].
pub fn ik(
    robot: &Robot<6>,
    poses: &[f64],
    q: &mut [f64],
    status: &mut [u8],
    threads: Option<NonZeroUsize>,
) -> Result<(), Error> {
    // The parameters `()` take no memory.
    ik_with(robot, poses, &vec![(); poses.len() / 16], q, status, threads)
}

/// Whether the structure of an arm is known.
fn check_structure<const N: usize>(robot: &Robot<N>) -> Result<(), Error>
where
    Joints<N>: Arity<N>,
{
    match robot.unknown_structure() {
        Some(reason) => Err(ModelFault::UnknownStructure(reason).into()),
        None => Ok(()),
    }
}

/// Inverse kinematics near seeds: from rows of 16 pose elements and of joint angles [rad] to rows
/// of joint angles, those of [`Robot::ik_nearest`]. A row without a solution, or with an invalid
/// pose or seed, is NaN.
///
/// # Errors
///
/// As [`ik`], and [`Error::InvalidJoints`] for a weight that is negative or not finite.
pub fn ik_nearest<const N: usize>(
    robot: &Robot<N>,
    poses: &[f64],
    seeds: &[f64],
    weights: &[f64; N],
    q: &mut [f64],
) -> Result<(), Error>
where
    Robot<N>: Inverse<N>,
    Joints<N>: Arity<N>,
{
    check_structure(robot)?;
    check_weights(weights)?;
    let poses = rows::<16>("poses", poses)?;
    let seeds = rows_for::<N>("seeds", seeds, poses.len())?;
    for ((pose, seed), q) in poses.iter().zip(seeds).zip(rows_out::<N, f64>("q", q, poses.len())?) {
        let checked = check_seed("seed", seed).and_then(|()| pose_from_rows(pose));
        let nearest = checked.and_then(|pose| robot.nearest_checked(pose, seed, weights));
        *q = nearest.map_or([f64::NAN; N], |nearest| nearest.q);
    }
    Ok(())
}

/// Configurations, one for each row of six joint angles [rad]; an error for a row that is not
/// finite.
///
/// # Errors
///
/// As [`fk`], and [`Error::InvalidModel`] for an arm without a spherical wrist.
pub fn configuration<'a>(
    robot: &'a Robot<6>,
    q: &'a [f64],
) -> Result<impl Iterator<Item = Result<Configuration, Error>> + 'a, Error> {
    robot.counted()?;
    Ok(rows::<6>("q", q)?.iter().map(|q| robot.configuration(q)))
}

/// Inverse kinematics by configurations: from rows of 16 pose elements, each with a configuration,
/// to rows of joint angles, those of [`Robot::ik_configured`] or, with `seeds`, of
/// [`Robot::ik_configured_or_nearest`]. A row without a solution, or with an invalid pose or seed,
/// is NaN.
///
/// # Errors
///
/// As [`ik`], [`Error::InvalidModel`] for an arm without a spherical wrist, and
/// [`Error::InvalidJoints`] for a number that no configuration of the arm has.
pub fn ik_configured(
    robot: &Robot<6>,
    poses: &[f64],
    configurations: &[Configuration],
    seeds: Option<&[f64]>,
    q: &mut [f64],
) -> Result<(), Error> {
    robot.counted()?;
    let poses = rows::<16>("poses", poses)?;
    if configurations.len() != poses.len() {
        return Err(Error::WrongLength {
            field: "configurations",
            found: configurations.len(),
            wanted: poses.len(),
        });
    }
    configurations.iter().try_for_each(|configuration| configuration.check(robot.is_coupled()))?;
    let seeds = match seeds {
        Some(seeds) => Some(rows_for::<6>("seeds", seeds, poses.len())?),
        None => None,
    };
    for (row, q) in rows_out::<6, f64>("q", q, poses.len())?.iter_mut().enumerate() {
        let configured = pose_from_rows(&poses[row]).and_then(|pose| match seeds {
            Some(seeds) => {
                check_seed("seed", &seeds[row])?;
                robot.ik_configured_or_nearest_checked(pose, configurations[row], &seeds[row])
            }
            None => robot.ik_configured_checked(pose, configurations[row]),
        });
        *q = configured.map_or([f64::NAN; 6], |configured| configured.q);
    }
    Ok(())
}

/// Poses that a thread takes at a time.
#[cfg(feature = "std")]
const PART: usize = 1024;

/// Least number of poses for which a second thread pays off: its start takes as long as half a
/// thousand of them.
#[cfg(feature = "std")]
const WORTH_A_THREAD: usize = 8 * PART;

/// Threads for a call: at most the requested number, as many as are worth their start, and not more
/// than there are cores; `None` for the caller's own.
///
/// The pool ends with the call: it leaves nothing behind that a forked process would wait for.
#[cfg(feature = "std")]
fn pool(threads: Option<NonZeroUsize>, poses: usize) -> Option<rayon::ThreadPool> {
    let threads = threads.map_or(1, NonZeroUsize::get);
    if threads <= 1 || poses < WORTH_A_THREAD {
        return None;
    }
    let threads = threads
        .min(2 * poses / WORTH_A_THREAD)
        .min(std::thread::available_parallelism().map_or(1, usize::from));
    if threads <= 1 {
        None
    } else {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().ok()
    }
}

/// The whole rows of an input.
fn rows<'a, const R: usize>(
    field: &'static str,
    numbers: &'a [f64],
) -> Result<&'a [[f64; R]], Error> {
    match numbers.as_chunks::<R>() {
        (rows, []) => Ok(rows),
        _ => Err(Error::WrongLength {
            field,
            found: numbers.len(),
            wanted: numbers.len().div_ceil(R) * R,
        }),
    }
}

/// The rows of an input of which there must be `count`.
fn rows_for<'a, const R: usize>(
    field: &'static str,
    numbers: &'a [f64],
    count: usize,
) -> Result<&'a [[f64; R]], Error> {
    check_length(field, numbers.len(), count * R)?;
    Ok(numbers.as_chunks::<R>().0)
}

/// The rows of an output for `count` answers.
fn rows_out<'a, const R: usize, T>(
    field: &'static str,
    out: &'a mut [T],
    count: usize,
) -> Result<&'a mut [[T; R]], Error> {
    check_length(field, out.len(), count * R)?;
    Ok(out.as_chunks_mut::<R>().0)
}

fn check_length(field: &'static str, found: usize, wanted: usize) -> Result<(), Error> {
    if found == wanted { Ok(()) } else { Err(Error::WrongLength { field, found, wanted }) }
}

fn is_finite(q: &[f64]) -> bool {
    q.iter().all(|angle| angle.is_finite())
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;

    #[test]
    fn a_large_batch_gets_a_pool_if_cores_are_available() {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let size = |threads, poses| {
            pool(NonZeroUsize::new(threads), poses).map_or(1, |pool| pool.current_num_threads())
        };
        assert_eq!(size(2, 17_001), 2.min(cores));
        assert_eq!(size(4, 17_001), 4.min(cores));
        assert_eq!([size(1, 17_001), size(0, 17_001), size(4, WORTH_A_THREAD - 1)], [1; 3]);
    }
}
