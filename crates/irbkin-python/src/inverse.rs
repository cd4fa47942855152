//! Methods of `irbkin.Robot` that take poses.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use numpy::PyArray1;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

use super::arguments::{read_threads, thread_count};
use super::arm::{ByJoints, SharedArm, on};
use super::cell::PyCell;
use super::errors::{exception, of_seed};
use super::found::Found;
use super::heading::{nearest_position, turning};
use super::outputs::{Output, Pair, answer_row, pair};
use super::records::{IkBatch, IkMargin, PoseCheck};
use super::redundancy::{needed_q7, no_q7, one_angle, read_poses_with_q7};
use super::robot::PyRobot;
use super::signals::detached;
use super::solutions::PySolutions;
use super::targets::{Seeded, read_ik_pose, read_seeded, read_single_pose, read_weights};
use irbkin::Robot;
use irbkin::batch::Margins;
use irbkin::internal::check_near;
use irbkin_motion::internal::check_most_near;

#[pymethods]
#[expect(non_snake_case, reason = "T is the name that users pass")]
impl PyRobot {
    /// Every joint vector that brings the tool to a pose.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///     q7: Angle of joint 7 [rad], of an arm of seven joints; `robot.locked({3: 0.2}).ik(T)`
    ///         takes another joint.
    ///     heading_tolerance: How far the pose may be turned about axis 1 [rad], 0 to pi, of an arm of
    ///         five axes; the robot's `heading_tolerance`, 1e-5, when not given.
    ///
    /// Returns:
    ///     Solutions, each in its slot, limits not regarded; empty with `reach` and `shortfall`
    ///     when out of reach.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape, is not finite or not a rigid transform.
    ///     InvalidJointsError: q7 is not finite.
    ///     InvalidModelError: The first six joints do not move the tool in six independent ways.
    ///     TypeError: q7 is missing, or the arm has six joints and it is not.
    #[pyo3(signature = (T, q7=None, *, heading_tolerance=None))]
    fn ik<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        heading_tolerance: Option<f64>,
    ) -> PyResult<Bound<'py, PySolutions>> {
        let py = T.py();
        let turning = turning(self.arm(), heading_tolerance)?;
        match turning.as_ref().unwrap_or(self.arm()) {
            SharedArm::Five(robot) => {
                no_q7(self.arm(), q7.is_some())?;
                let mut found = Found::new(Arc::clone(robot), robot.unsolved(read_ik_pose(T)?));
                robot.ik_into(&mut found.solutions, f64::NAN).map_err(exception)?;
                Bound::new(py, PySolutions { found: ByJoints::Five(found) })
            }
            SharedArm::Six(robot) => {
                no_q7(self.arm(), q7.is_some())?;
                let mut found = Found::new(Arc::clone(robot), robot.unsolved(read_ik_pose(T)?));
                robot.ik_into(&mut found.solutions, f64::NAN).map_err(exception)?;
                Bound::new(py, PySolutions { found: ByJoints::Six(found) })
            }
            SharedArm::Seven(robot) => {
                let angle = match (robot.locked_joint(), q7) {
                    (Some((_, angle)), None) => angle,
                    (Some(_), Some(_)) => return Self::from(self.unlocked()?).ik(T, q7, None),
                    (None, q7) => one_angle(needed_q7(robot, q7)?, "q7")?,
                };
                let mut found = Found::new(Arc::clone(robot), robot.unsolved(read_ik_pose(T)?));
                robot.check_locked(angle).map_err(exception)?;
                robot.ik_into(&mut found.solutions, angle).map_err(exception)?;
                let q7 = q7.is_some().then_some(angle);
                Bound::new(py, PySolutions { found: ByJoints::Seven(Found { q7, ..found }) })
            }
        }
    }

    /// Every joint vector of many poses.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     q7: Angles of joint 7 [rad] of an arm of seven joints, of a shape that goes with (...):
    ///         T and q7 are broadcast.
    ///     out: Where to write: an IkBatch or tuple of arrays (..., slots, n) float64 and (...,
    ///         slots) uint8, or the first of them alone.
    ///     threads: Number of threads; 0 for one a core.
    ///     heading_tolerance: How far the pose may be turned about axis 1 [rad], 0 to pi, of an arm of
    ///         five axes; the robot's `heading_tolerance`, 1e-5, when not given.
    ///
    /// Returns:
    ///     IkBatch(q, status): joint angles [rad], shape (..., slots, n), NaN where a slot is
    ///     empty, and `irbkin.Status` of each slot, shape (..., slots), uint8. Slots are 8 or 16,
    ///     as the structure has them. A row whose pose or q7 is invalid has status INVALID; it
    ///     does not affect the others.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape.
    ///     InvalidJointsError: q7 has a wrong shape.
    ///     InvalidModelError: The first six joints do not move the tool in six independent ways.
    ///     TypeError: q7 is missing, or the arm has six joints and it is not.
    #[pyo3(signature = (T, q7=None, *, out=None, threads=1, heading_tolerance=None))]
    fn ik_batch<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
        heading_tolerance: Option<f64>,
    ) -> PyResult<IkBatch> {
        if let Some(turning) = turning(self.arm(), heading_tolerance)? {
            return Self::from(turning).ik_batch(T, q7, out, threads, None);
        }
        let is_locked = on!(self.arm(), robot => robot.locked_joint().is_some());
        if q7.is_some() && is_locked {
            return Self::from(self.unlocked()?).ik_batch(T, q7, out, threads, None);
        }
        let (py, arm, threads) = (T.py(), self.arm(), thread_count(threads)?);
        let (poses, angles) = read_poses_with_q7(arm, T, q7)?;
        let (q_out, status_out) = outputs(out)?;
        let slots = on!(arm, robot => robot.slot_count());
        let q_shape = poses.shape_with(&[slots, arm.dof()]);
        let mut q = Output::new(py, q_out.as_ref(), &q_shape, &[poses.addresses()])?;
        let inputs = [poses.addresses(), q.addresses()];
        let status_shape = poses.shape_with(&[slots]);
        let mut status = Output::new(py, status_out.as_ref(), &status_shape, &inputs)?;
        let (data, to_q, to_status) = (poses.data()?, q.slice()?, status.slice()?);
        on!(arm, robot => {
            detached(py, threads, |batch| batch.ik_with(robot, data, &angles, to_q, to_status))?;
        });
        Ok(IkBatch { q: q.array(), status: status.array() })
    }

    /// How much room the solutions of poses leave to limits and singularities: `ik_batch` and
    /// `margin` in one call, which keeps the best of each pose.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     q7: Angle of joint 7 [rad], shape (...), of an arm of seven joints.
    ///     threads: Number of threads; 0 for one a core.
    ///     cell: Only solutions that do not collide in an `irbkin.Cell`.
    ///
    /// Returns:
    ///     IkMargin: the largest margin of the solutions inside the limits, their largest distance
    ///     from singularities, and their number, arrays of shape (...).
    ///
    /// Raises:
    ///     InvalidPoseError: A wrong shape. An invalid pose has no solution.
    ///     InvalidModelError: The first six joints do not move the tool in six independent ways;
    ///         with `cell`, the robot has no body.
    ///     TypeError: `q7` of an arm of six joints, or none of one of seven.
    #[pyo3(signature = (T, q7=None, *, threads=1, cell=None))]
    fn ik_margin<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
        cell: Option<&Bound<'py, PyCell>>,
    ) -> PyResult<IkMargin> {
        let cell = cell.map(|cell| &*cell.get().cell);
        let (py, arm, threads) = (T.py(), self.arm(), thread_count(threads)?);
        let (poses, angles) = read_poses_with_q7(arm, T, q7)?;
        let mut margin = Output::new(py, None, &poses.lead, &[])?;
        let mut singularities = Output::new(py, None, &poses.lead, &[])?;
        let mut solutions = Output::new(py, None, &poses.lead, &[])?;
        let data = poses.data()?;
        let answers = Margins {
            margin: margin.slice()?,
            singularities: singularities.slice()?,
            solutions: solutions.slice()?,
        };
        on!(arm, arm => detached(py, threads, |batch| match cell {
            None => Ok(batch.ik_margin(arm, data, &angles, answers)?),
            Some(cell) => cell.ik_margin_batch(batch, arm, data, &angles, answers),
        }))?;
        let [margin, singularities] = [margin, singularities].map(Output::array);
        Ok(IkMargin { margin, singularities, solutions: solutions.array() })
    }

    /// The solution inside the limits that is nearest to `seed`, turns considered; without a seed
    /// nearest to the middle of the limits.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     seed: Joint vectors [rad], shape (..., n). T and seed are broadcast: one seed for many
    ///         poses, one pose for many seeds. Of joints that the pose leaves free, the nearest
    ///         angles are taken. When not given, the middle of the limits; 0 for a joint without
    ///         a limit, or that turns by more than 720 deg.
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///     out: Array to write to, shape (..., n), float64, C-contiguous; it is returned.
    ///     threads: Number of threads; 0 for one a core.
    ///     cell: Only solutions that do not collide in an `irbkin.Cell`; with seven joints, of
    ///         those that the search passes.
    ///     heading_tolerance: How far the pose may be turned about axis 1 [rad], 0 to pi, of an arm of
    ///         five axes; pi when not given.
    ///     position_only: Of an arm of five axes, only the position of T, which may be of shape (3,):
    ///         the roll stays as in `seed`, and the elevation as far as the arm reaches with it.
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (..., n). In a batch, a row without a solution, or whose pose
    ///     or seed is invalid, is NaN.
    ///
    /// Raises:
    ///     UnreachableError: A single pose has no solution inside the limits, or all collide; the
    ///         message says what is missing, or what collides.
    ///     InvalidPoseError, InvalidJointsError, InvalidModelError: As `ik`; a seed or weight that
    ///         is not finite; a seed, or most of many, more than four turns outside the limits; a
    ///         single pose or seed for a whole batch that is invalid.
    #[pyo3(signature = (T, seed=None, weights=None, *, out=None, threads=1, cell=None,
        heading_tolerance=None, position_only=false))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn ik_nearest<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: Option<&Bound<'py, PyAny>>,
        weights: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        #[pyo3(from_py_with = read_threads)] threads: isize,
        cell: Option<&Bound<'py, PyCell>>,
        heading_tolerance: Option<f64>,
        position_only: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, threads) = (T.py(), thread_count(threads)?);
        let cell = cell.map(|cell| &cell.get().cell);
        let middle = |py| on!(self.arm(), robot => PyArray1::from_slice(py, &middle(robot)));
        let seed = seed.map_or_else(|| middle(py).into_any(), Bound::clone);
        if position_only {
            let given = cell.is_some() || heading_tolerance.is_some();
            let q = nearest_position(self.arm(), T, &seed, weights, given)?;
            return answer_row(T, out, &q);
        }
        let default = matches!(self.arm(), SharedArm::Five(_)).then_some(PI);
        let turning = turning(self.arm(), heading_tolerance.or(default))?;
        on!(turning.as_ref().unwrap_or(self.arm()), robot => match read_seeded(T, &seed)? {
            Seeded::One(pose, seed) => {
                let weights = read_weights(weights)?;
                check_near("seed", &seed, robot.limits(), &weights).map_err(exception)?;
                let nearest = match cell {
                    None => robot.nearest_checked(pose, &seed, &weights).map_err(Into::into),
                    Some(cell) => cell.ik_nearest(robot, &pose, &seed, &weights),
                };
                answer_row(T, out, &nearest.map_err(|error| of_seed(error, &seed))?.q)
            }
            Seeded::Many(poses, seeds) => {
                let (weights, shape) = (read_weights(weights)?, poses.shape_with(&[self.arm().dof()]));
                check_most_near("seed", seeds.chunks()?, robot.limits(), &weights)
                    .map_err(exception)?;
                let inputs = [poses.addresses(), seeds.addresses()];
                let mut answer = Output::new(py, out, &shape, &inputs)?;
                let (poses, seeds, q) = (poses.data()?, seeds.data()?, answer.slice()?);
                detached(py, threads, |batch| match cell {
                    None => Ok(batch.ik_nearest(robot, poses, seeds, &weights, q)?),
                    Some(cell) => cell.ik_nearest_batch(batch, robot, poses, seeds, &weights, q),
                })?;
                Ok(answer.bound())
            }
        })
    }

    /// Whether a pose can be reached, inside the limits or not, and why not; with seven joints,
    /// with any angle of joint 7 inside its limits.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///
    /// Returns:
    ///     PoseCheck(reachable, within_limits, reason).
    ///
    /// Raises:
    ///     InvalidPoseError, InvalidModelError: As `ik`.
    fn check_pose(&self, T: &Bound<'_, PyAny>) -> PyResult<PoseCheck> {
        let pose = read_single_pose(T, "check_pose")?;
        let explanation = on!(self.arm(), robot => robot.explain(&pose)).map_err(exception)?;
        Ok(PoseCheck::from(&explanation))
    }
}

/// The seed that is taken without one [rad].
fn middle<const N: usize>(robot: &Robot<N>) -> [f64; N] {
    robot.free_ranges().map(|[lower, upper]| {
        // Of a joint that turns more often than that, the zero is where a user expects it.
        if upper - lower <= 2.0 * TAU { 0.5 * (lower + upper) } else { 0.0 }
    })
}

/// The arrays of an `IkBatch` or of a tuple, or the first of them alone.
fn outputs<'py>(out: Option<&Bound<'py, PyAny>>) -> PyResult<Pair<'py>> {
    let Some(out) = out else { return Ok((None, None)) };
    if let Ok(record) = out.cast::<IkBatch>() {
        let IkBatch { q, status } = record.get();
        return Ok((Some(q.bind(out.py()).clone()), Some(status.bind(out.py()).clone())));
    }
    match out.cast::<PyTuple>() {
        Ok(arrays) => pair(out)?.ok_or_else(|| {
            let message = format!("out must be (q, status), got a tuple of {}", arrays.len());
            PyTypeError::new_err(message)
        }),
        Err(_) => Ok((Some(out.clone()), None)),
    }
}
