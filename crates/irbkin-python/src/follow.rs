//! `Robot.follow`: one joint path along a path of poses.

use std::num::NonZeroUsize;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arguments::{SINGULARITY_MODES, one_of, read_threads, thread_count};
use super::arm::SharedArm;
use super::arrays::{Rows, together};
use super::errors::{Fault, exception, index_in};
use super::follower::break_record;
use super::outputs::{Output, pair};
use super::records::FollowResult;
use super::robot::PyRobot;
use super::signals::detached;
use super::targets::{checked_joints, read_path, read_weights, single_seed};
use irbkin::follow::{FollowOptions, Followed, SingularityMode};
use irbkin::thresholds::WRIST_ZONE;
use irbkin::{Error, Interrupt, Pose};

#[pymethods]
impl PyRobot {
    /// One continuous joint path along a path of poses: inside the limits, turns considered,
    /// through singularities without a jump where there is a way. Of seven joints each step is the
    /// smallest along the self-motion of its pose.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (m, 4, 4), or several paths, shape (..., m, 4, 4),
    ///         translation [m].
    ///     seed: Joint vectors from which the paths start [rad], shape (..., n). T and seed are
    ///         broadcast: one seed for many paths, one path from many seeds.
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///     singularity_mode: What to do at the wrist singularity. "through": meet every pose,
    ///         however fast axes 4 and 6 turn. "error": stop where joint 5 comes into the zone, and
    ///         where a joint must jump, as SingArea \Off. "wrist": inside the zone axes 4, 5, 6 go
    ///         straight from where they enter to where they leave, position exact, as SingArea
    ///         \Wrist. "lock_axis4": axis 4 stays at 0 or +-180 deg all along, position exact,
    ///         orientation where it can be, as SingArea \LockAxis4.
    ///     zone: |sin q5| below which `singularity_mode` acts; 0.0175, that is one degree, when not
    ///         given.
    ///     out: Where to write: arrays (..., m, n) and (..., m), float64, of the joints and of the
    ///         orientation error.
    ///     threads: Number of threads, for several paths; 0 for one a core.
    ///
    /// Returns:
    ///     FollowResult: joints [rad], shape (..., m, n), NaN where a pose is not met; orientation
    ///         error [rad], shape (..., m); the breaks.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape or holds an invalid pose; the message has its
    ///         index.
    ///     InvalidJointsError: A seed or weight that is not finite, or a zone that is not 0 to 1.
    ///     InvalidModelError: "wrist" or "lock_axis4" for an arm without a spherical wrist, or
    ///         another mode than "through" for seven joints.
    ///     ValueError: Another `singularity_mode`.
    #[pyo3(signature = (T, seed, weights=None, *, singularity_mode="through", zone=None, out=None, threads=1))]
    fn follow<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: &Bound<'py, PyAny>,
        weights: Option<&Bound<'py, PyAny>>,
        singularity_mode: &str,
        zone: Option<f64>,
        out: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
    ) -> PyResult<FollowResult> {
        let mode = one_of("singularity_mode", singularity_mode, &SINGULARITY_MODES)?;
        let zone = zone.unwrap_or(WRIST_ZONE);
        let options = |weights| FollowOptions { weights, singularity_mode: mode, zone };
        let threads = thread_count(threads)?;
        match self.arm() {
            SharedArm::Six(robot) => {
                let options = options(read_weights(weights)?);
                follow(T, seed, out, threads, |path, seed, interrupt| {
                    robot.follow_until(path, seed, &options, interrupt)
                })
            }
            SharedArm::Five(robot) => {
                let weights = read_weights(weights)?;
                check_through(mode, singularity_mode)?;
                follow(T, seed, out, threads, |path, seed, interrupt| {
                    robot.follow_through(path, seed, &weights, interrupt)
                })
            }
            SharedArm::Seven(robot) => {
                let weights = read_weights(weights)?;
                let Some(six) = robot.six_turned().map_err(exception)? else {
                    check_through(mode, singularity_mode)?;
                    return follow(T, seed, out, threads, |path, seed, interrupt| {
                        robot.follow_through(path, seed, &weights, interrupt)
                    });
                };
                let options = options(robot.others(&weights));
                follow(T, seed, out, threads, |path, seed: &[f64; 7], interrupt| {
                    let six = six.follow_until(path, &robot.others(seed), &options, interrupt)?;
                    let q = six.q.iter().map(|q| q.map(|q| robot.with_others(&q))).collect();
                    let Followed { orientation_error, breaks, .. } = six;
                    Ok(Followed { q, orientation_error, breaks })
                })
            }
        }
    }
}

/// Check that five or seven joints are asked for no mode of a wrist's.
fn check_through(mode: SingularityMode, name: &str) -> PyResult<()> {
    if mode == SingularityMode::Through {
        return Ok(());
    }
    Err(Fault::Model.error(format_args!(
        "singularity_mode {name:?} is for arms of six joints: seven pass a wrist singularity with \
         \"through\"; lock one of them, as locked({{3: 0.2}}), for another mode"
    )))
}

/// Follow paths of poses, shape (..., m, 4, 4), each from its seed by a function.
fn follow<const N: usize>(
    T: &Bound<'_, PyAny>,
    seeds: &Bound<'_, PyAny>,
    out: Option<&Bound<'_, PyAny>>,
    threads: Option<NonZeroUsize>,
    follow: impl Fn(&[Pose], &[f64; N], Interrupt<'_>) -> Result<Followed<N>, Error> + Sync + Send,
) -> PyResult<FollowResult> {
    let py = T.py();
    let has_length = |shape: &[usize]| matches!(shape, [.., _, 4, 4]);
    let mut rows = Rows::shaped(T, || "(..., m, 4, 4)", "T", Fault::Pose, has_length)?;
    rows.lead.truncate(rows.lead.len() - 3);
    let mut seeds = Rows::read(seeds, &[N], "seed", Fault::Joints)?;
    single_seed::<N>(&seeds)?;
    together(&mut [&mut rows, &mut seeds])?;
    let shape = rows.shape()[..=rows.lead.len()].to_vec();
    let (q_out, errors_out) = match out {
        Some(out) => pair(out)?.ok_or_else(|| {
            PyTypeError::new_err("out must be a tuple of two arrays: (q, orientation_error)")
        })?,
        None => (None, None),
    };
    let mut memory = vec![rows.addresses(), seeds.addresses()];
    let mut q = Output::new(py, q_out.as_ref(), &[&shape[..], &[N]].concat(), &memory)?;
    memory.push(q.addresses());
    let mut errors = Output::new(py, errors_out.as_ref(), &shape, &memory)?;
    let poses = read_path(py, &rows, &shape)?;
    let starts = checked_joints::<N>("seed", &seeds)?;
    let length = shape.last().copied().unwrap_or_default();
    let followed = detached(py, threads, |batch| batch.follow(&poses, length, starts, follow))?;
    let found = followed.iter().flat_map(|path| &path.q);
    for (to, found) in q.slice()?.as_chunks_mut::<N>().0.iter_mut().zip(found) {
        *to = found.unwrap_or([f64::NAN; N]);
    }
    let found = followed.iter().flat_map(|path| &path.orientation_error);
    for (to, error) in errors.slice()?.iter_mut().zip(found) {
        *to = error.unwrap_or(f64::NAN);
    }
    let breaks = breaks(py, &rows.lead, &followed)?.unbind();
    Ok(FollowResult { q: q.array(), orientation_error: errors.array(), breaks })
}

/// The breaks of paths with the leading dimensions `lead`.
fn breaks<'py, const N: usize>(
    py: Python<'py>,
    lead: &[usize],
    followed: &[Followed<N>],
) -> PyResult<Bound<'py, PyTuple>> {
    let mut breaks = Vec::new();
    for (path, followed) in followed.iter().enumerate() {
        for broken in &followed.breaks {
            breaks.push(break_record(py, broken, PyTuple::new(py, index_in(lead, path))?)?);
        }
    }
    PyTuple::new(py, breaks)
}
