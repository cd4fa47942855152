//! Methods of `irbkin.Robot` that take poses.

use std::sync::Arc;

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyFloat;

use super::arguments::{read_singularity_mode, thread_count};
use super::arm::{Arm, on};
use super::batches;
use super::configured::{self, Options};
use super::errors::{of_seed, to_py};
use super::found::{Found, read_weights};
use super::locked::{self, locked, read_pair, released};
use super::nearest::{self, Seeded, read_seeded};
use super::outputs::answer_row;
use super::paths;
use super::poses::{read_ik_pose, read_single_pose};
use super::records::{FollowResult, IkBatch, IkMargin, PoseCheck};
use super::redundancy::{needed_q7, no_q7, no_q7_beside_given, one_angle};
use super::robot::PyRobot;
use super::solutions::PySolutions;
use crate::kinematics::FollowOptions;
use crate::kinematics::thresholds::WRIST_ZONE;

#[pymethods]
#[expect(non_snake_case, reason = "T is the name that users pass")]
impl PyRobot {
    /// Every joint vector that brings the tool to a pose.
    ///
    /// Args:
    ///     T: Pose of the tool, shape (4, 4), translation [m].
    ///     q7: Angle of joint 7 [rad], of an arm of seven joints.
    ///     given: In place of q7, another joint of seven with its angle, as {3: 0.2}: joints count
    ///         from 1. `robot.ik(T, given={3: 0.2})` is `robot.locked({3: 0.2}).ik(T)`.
    ///
    /// Returns:
    ///     Solutions, each in its slot, limits not regarded; empty with `reach` and `shortfall`
    ///     when out of reach.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape, is not finite or not a rigid transform.
    ///     InvalidJointsError: q7 is not finite, or the joint does not exist.
    ///     InvalidModelError: The other six joints do not move the tool in six independent ways.
    ///     TypeError, ValueError: q7 is missing, or the arm has six joints and it is not; given
    ///         does not map one joint, or stands beside q7.
    #[pyo3(signature = (T, q7=None, *, given=None))]
    fn ik<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        given: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PySolutions>> {
        let py = T.py();
        if let Some(given) = given {
            no_q7_beside_given(q7)?;
            return match read_pair(self.arm(), given)? {
                // An arm of seven joints has joint 7 locked for each pose.
                (7, q7) => self.ik(T, Some(&q7), None),
                (joint, angle) => {
                    PyRobot::from(Arm::from(locked(self, joint, &angle)?)).ik(T, None, None)
                }
            };
        }
        match self.arm() {
            Arm::Six(robot) => {
                no_q7(q7.is_some())?;
                let mut found = Found::new(Arc::clone(robot), robot.unsolved(read_ik_pose(T)?));
                robot.ik_into(&mut found.solutions, f64::NAN).map_err(|error| to_py(py, &error))?;
                Bound::new(py, PySolutions::from(found))
            }
            Arm::Seven(robot) => {
                let angle = match (robot.locked_joint(), q7) {
                    (Some((_, angle)), None) => angle,
                    (Some(_), Some(_)) => return released(self).ik(T, q7, None),
                    (None, q7) => one_angle(needed_q7(py, robot, q7)?, "q7")?,
                };
                let mut found = Found::new(Arc::clone(robot), robot.unsolved(read_ik_pose(T)?));
                robot
                    .check_locked(angle)
                    .and_then(|()| robot.ik_into(&mut found.solutions, angle))
                    .map_err(|error| to_py(py, &error))?;
                let q7 = q7.is_some().then_some(angle);
                Bound::new(py, PySolutions::from(Found { q7, ..found }))
            }
        }
    }

    /// Every joint vector of many poses.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     q7: Angles of joint 7 [rad] of an arm of seven joints, of a shape that goes with (...):
    ///         T and q7 are broadcast.
    ///     given: In place of q7, another joint of seven with its angle, as {3: 0.2}. The angles of
    ///         the first and the last joint may be an array that goes with (...).
    ///     out: Where to write: an IkBatch or tuple of arrays (..., slots, n) float64 and (...,
    ///         slots) uint8, or the first of them alone.
    ///     threads: Number of threads; 0 for one a core.
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
    #[pyo3(signature = (T, q7=None, *, given=None, out=None, threads=1))]
    fn ik_batch<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        given: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<IkBatch> {
        let threads = thread_count(threads)?;
        let Some(given) = given else {
            return batches::ik(self.arm(), T, ("q7", q7), out, threads);
        };
        no_q7_beside_given(q7)?;
        let (joint, angles) = read_pair(self.arm(), given)?;
        match joint {
            7 => batches::ik(released(self).arm(), T, ("q7", Some(&angles)), out, threads),
            1 => {
                let zero = PyFloat::new(T.py(), 0.0);
                let arm = Arm::from(locked(self, 1, &zero)?);
                batches::ik(&arm, T, ("given", Some(&angles)), out, threads)
            }
            joint => {
                let arm = Arm::from(locked(self, joint, &angles)?);
                batches::ik(&arm, T, ("given", None), out, threads)
            }
        }
    }

    /// How much room the solutions of poses leave to limits and singularities: `ik_batch` and
    /// `margin` in one call, which keeps the best of each pose.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     q7: Angle of joint 7 [rad], shape (...), of an arm of seven joints.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     IkMargin: the largest margin of the solutions inside the limits, their largest distance
    ///     from singularities, and their number, arrays of shape (...).
    ///
    /// Raises:
    ///     InvalidPoseError: A wrong shape. An invalid pose has no solution.
    ///     InvalidModelError: The first six joints do not move the tool in six independent ways.
    ///     TypeError: `q7` of an arm of six joints, or none of one of seven.
    #[pyo3(signature = (T, q7=None, *, threads=1))]
    fn ik_margin<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        q7: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<IkMargin> {
        batches::ik_margin(self.arm(), T, q7, thread_count(threads)?)
    }

    /// The solution inside the limits that is nearest to `seed`, turns considered.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     seed: Joint vectors [rad], shape (..., n). T and seed are broadcast: one seed for many
    ///         poses, one pose for many seeds. Of joints that the pose leaves free, the nearest
    ///         angles are taken.
    ///     weights: Cost of moving each joint, shape (n,); ones when not given.
    ///     out: Array to write to, shape (..., n), float64, C-contiguous; it is returned.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (..., n). In a batch, a row without a solution, or whose pose
    ///     or seed is invalid, is NaN.
    ///
    /// Raises:
    ///     UnreachableError: A single pose has no solution inside the limits; the message says what
    ///         is missing.
    ///     InvalidPoseError, InvalidJointsError, InvalidModelError: As `ik`; a seed or weight that
    ///         is not finite; a single pose or seed for a whole batch that is invalid.
    #[pyo3(signature = (T, seed, weights=None, *, out=None, threads=1))]
    fn ik_nearest<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: &Bound<'py, PyAny>,
        weights: Option<&Bound<'py, PyAny>>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (py, threads) = (T.py(), thread_count(threads)?);
        on!(self.arm(), robot => {
            let (pose, seed) = match read_seeded(T, seed)? {
                Seeded::One(pose, seed) => (pose, seed),
                Seeded::Many(poses, seeds) => {
                    return nearest::many(py, robot, &poses, &seeds, weights, out, threads);
                }
            };
            let nearest = robot
                .nearest_checked(pose, &seed, &read_weights(weights)?)
                .map_err(|error| of_seed(py, &error, &seed))?;
            answer_row(T, out, &nearest.q)
        })
    }

    /// One continuous joint path along a path of poses: inside the limits, turns considered,
    /// through singularities without a jump where there is a way.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (m, 4, 4), or several paths, shape (..., m, 4, 4),
    ///         translation [m].
    ///     seed: Joint vectors from which the paths start [rad], shape (..., 6). T and seed are
    ///         broadcast: one seed for many paths, one path from many seeds.
    ///     weights: Cost of moving each joint, shape (6,); ones when not given.
    ///     singularity_mode: What to do at the wrist singularity. "through": meet every pose,
    ///         however fast axes 4 and 6 turn. "error": stop where joint 5 comes into the zone, and
    ///         where a joint must jump, as SingArea \Off. "wrist": inside the zone axes 4, 5, 6 go
    ///         straight from where they enter to where they leave, position exact, as SingArea
    ///         \Wrist. "lock_axis4": axis 4 stays at 0 or +-180 deg all along, position exact,
    ///         orientation where it can be, as SingArea \LockAxis4.
    ///     zone: |sin q5| below which `singularity_mode` acts; 0.0175, that is one degree, when not
    ///         given.
    ///     out: Where to write: arrays (..., m, 6) and (..., m), float64, of the joints and of the
    ///         orientation error.
    ///     threads: Number of threads, for several paths; 0 for one a core.
    ///
    /// Returns:
    ///     FollowResult: joints [rad], shape (..., m, 6), NaN where a pose is not met; orientation
    ///         error [rad], shape (..., m); the breaks.
    ///
    /// Raises:
    ///     InvalidPoseError: T has a wrong shape or holds an invalid pose; the message has its
    ///         index.
    ///     InvalidJointsError: A seed or weight that is not finite, or a zone that is not 0 to 1.
    ///     InvalidModelError: The arm has seven joints; "wrist" or "lock_axis4" for an arm without
    ///         a spherical wrist.
    ///     ValueError: Another `singularity_mode`.
    #[pyo3(signature = (T, seed, weights=None, *, singularity_mode="through", zone=None, out=None, threads=1))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn follow<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        seed: &Bound<'py, PyAny>,
        weights: Option<&Bound<'py, PyAny>>,
        singularity_mode: &str,
        zone: Option<f64>,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<FollowResult> {
        let threads = thread_count(threads)?;
        let options = |weights| -> PyResult<FollowOptions> {
            let singularity_mode = read_singularity_mode(singularity_mode)?;
            Ok(FollowOptions { weights, singularity_mode, zone: zone.unwrap_or(WRIST_ZONE) })
        };
        if let Arm::Seven(robot) = self.arm()
            && let Some(six) = robot.six_turned().map_err(|error| to_py(T.py(), &error))?
        {
            let options = options(robot.others(&read_weights(weights)?))?;
            return locked::follow(robot, &six, T, seed, &options, out, threads);
        }
        let robot = self.arm().follower(T.py())?;
        paths::follow(robot, T, seed, &options(read_weights(weights)?)?, out, threads)
    }

    /// The solution inside the limits that has a configuration, which chooses the turns of axes 1,
    /// 4 and 6, too.
    ///
    /// An angle within 0.01 deg of the edge of a quarter turn is taken for either side of it. A
    /// GoFa may have two solutions with one configuration: `every` returns both. Its joints, and a
    /// YuMi's, may be up to 1.5 deg beyond the limits where none is inside.
    ///
    /// Args:
    ///     T: Poses of the tool, shape (..., 4, 4), translation [m].
    ///     configuration: (cf1, cf4, cf6, cfx): an `irbkin.Configuration`, or whole numbers of
    ///         shape (..., 4). T, configuration, arm_angle and seed are broadcast. None with
    ///         `every` and an arm_angle: any configuration, inside the limits or not.
    ///     arm_angle: Arm angles [rad] of a YuMi, shape (...): eax_a of its robtargets.
    ///     fallback: With "nearest", the solution nearest to `seed` where none has the
    ///         configuration: many programs write [0, 0, 0, 0] without having calculated it.
    ///     seed: Joint vectors [rad], shape (..., n): of the fallback, and those to which the
    ///         solution of a GoFa or YuMi is the nearest; angles of zero when not given.
    ///     every: Whether to return every such solution of one pose, the nearest to `seed` first.
    ///         For an arm angle alone, self-motions are searched that turn the first or the last
    ///         joint by a degree or more; one joint vector represents those that differ in two
    ///         axes of one line.
    ///     out: Array to write to, shape (..., n), float64, C-contiguous; it is returned.
    ///     threads: Number of threads; 0 for one a core.
    ///
    /// Returns:
    ///     Joint vectors [rad], shape (..., n); with `every` shape (k, n). In a batch, a row
    ///     without such a solution, or whose pose, seed or configuration (that which
    ///     `configuration` gives an invalid row) is invalid, is NaN.
    ///
    /// Raises:
    ///     UnreachableError: A single pose has no solution inside the limits with that
    ///         configuration; the message, and its attribute `configurations`, have those that
    ///         exist.
    ///     InvalidPoseError, InvalidJointsError: A wrong shape, an invalid pose, a number of the
    ///         configuration that is not whole or that the arm does not have, a YuMi without
    ///         arm_angle.
    ///     InvalidModelError: As `configuration`; arm_angle of another arm than a YuMi.
    ///     TypeError, ValueError: Another fallback, or one without a seed; a seed alone where the
    ///         configuration names one solution.
    #[pyo3(signature = (T, configuration, *, arm_angle=None, fallback=None, seed=None, every=false, out=None, threads=1))]
    #[expect(clippy::too_many_arguments, reason = "keywords in Python")]
    fn ik_configured<'py>(
        &self,
        T: &Bound<'py, PyAny>,
        configuration: Option<&Bound<'py, PyAny>>,
        arm_angle: Option<&Bound<'py, PyAny>>,
        fallback: Option<&str>,
        seed: Option<&Bound<'py, PyAny>>,
        every: bool,
        out: Option<&Bound<'py, PyAny>>,
        threads: isize,
    ) -> PyResult<Bound<'py, PyAny>> {
        let (options, threads) = (Options { arm_angle, fallback, seed }, thread_count(threads)?);
        match (configuration, arm_angle) {
            (Some(configuration), _) if every => {
                configured::all(self.arm(), T, configuration, &options)
            }
            (Some(configuration), _) => {
                configured::ik(self.arm(), T, configuration, &options, out, threads)
            }
            (None, Some(arm_angle)) if every => configured::at_arm_angle(self.arm(), T, arm_angle),
            (None, _) => {
                Err(PyTypeError::new_err("give a configuration, or an arm_angle with every=True"))
            }
        }
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
        let explanation = on!(self.arm(), robot => robot.explain(&pose))
            .map_err(|error| to_py(T.py(), &error))?;
        Ok(PoseCheck::from(&explanation))
    }
}
