//! Singularity modes: how a path crosses the wrist singularity, named as ABB names them.

use nalgebra::Vector3;

use crate::error::{Error, JointFault, ModelFault};
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::path::follow::{BreakReason, Followed, Follower};
use crate::kinematics::path::step::largest_step;
use crate::kinematics::path::walk::Walk;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::solver::Solver;
use crate::kinematics::structure::spherical_wrist::SphericalWrist;
use crate::kinematics::thresholds::{JUMP_BLIND, LOCKED_CONVERGED, WRIST_ZONE};

/// How a path passes the wrist singularity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum SingularityMode {
    /// Reach every pose exactly, however fast axes 4 and 6 must turn.
    #[default]
    Through,
    /// Stop where joint 5 enters the zone, or where a joint must jump. As `SingArea \Off`.
    Error,
    /// Inside the zone, axes 4 and 5 move straight from its first pose to its last. The tool's
    /// position stays exact; its orientation deviates by at most two zones. As `SingArea \Wrist`.
    Wrist,
    /// Axis 4 stays at 0 or +-180 deg. The tool's position stays exact; its orientation is met if
    /// the pose can be reached with axis 4 there. As `SingArea \LockAxis4`.
    LockAxis4,
}

/// Options of [`Robot::follow`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FollowOptions {
    /// Cost of moving each joint, for the choice among solutions.
    pub weights: [f64; 6],
    /// How the path passes the wrist singularity.
    pub singularity_mode: SingularityMode,
    /// Absolute value of sin q5 below which joint 5 is in the zone of `singularity_mode`, 0 to 1
    /// [1].
    pub zone: f64,
}

impl Default for FollowOptions {
    fn default() -> Self {
        Self { weights: [1.0; 6], singularity_mode: SingularityMode::Through, zone: WRIST_ZONE }
    }
}

/// How often the arm and a wrist with axis 4 held are solved in turn: each round shrinks the error
/// by the tool's length over the arm's.
const ROUNDS: usize = 60;

impl Robot<6> {
    /// Follow `path` with one continuous joint path inside the limits, starting from the solution
    /// nearest to `seed` [rad] among all 2 pi equivalents.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`]; a pose that cannot be reached is a break, not an error.
    /// [`Error::InvalidModel`] if [`SingularityMode::Wrist`] or [`SingularityMode::LockAxis4`] is
    /// requested for an arm without a spherical wrist.
    pub fn follow(
        &self,
        path: &[Pose],
        seed: &[f64; 6],
        options: &FollowOptions,
    ) -> Result<Followed, Error> {
        self.follow_while(path, seed, options, &mut || true)
    }

    /// [`Robot::follow`] for as long as `go_on` says so; it is asked now and then. The rest of the
    /// path is not met.
    pub(crate) fn follow_while(
        &self,
        path: &[Pose],
        seed: &[f64; 6],
        options: &FollowOptions,
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Followed, Error> {
        if !(0.0..=1.0).contains(&options.zone) {
            return Err(JointFault::Zone { value: options.zone }.into());
        }
        if matches!(options.singularity_mode, SingularityMode::Wrist | SingularityMode::LockAxis4)
            && self.spherical_wrist().is_none()
        {
            return Err(ModelFault::NoSphericalWrist.into());
        }
        let follower = Follower::new(self, seed, &options.weights)?;
        let mut walk = Modes { walk: Walk::new(self, path, follower, go_on), options };
        match options.singularity_mode {
            SingularityMode::Through | SingularityMode::Error => walk.through()?,
            SingularityMode::Wrist => walk.wrist()?,
            SingularityMode::LockAxis4 => walk.lock_axis_4()?,
        }
        Ok(walk.walk.finish())
    }
}

/// Which part of the wrist is locked; the rest comes as near to the pose as possible.
#[derive(Clone, Copy)]
enum Locked {
    Axis4,
    Axes4And5,
}

/// A path that is followed in one of the modes.
struct Modes<'a> {
    walk: Walk<'a, 6>,
    options: &'a FollowOptions,
}

impl Modes<'_> {
    fn in_zone(&self, q: &[f64; 6]) -> bool {
        self.walk.robot.sin_5(q).is_some_and(|sin_5| sin_5.abs() < self.options.zone)
    }

    /// Pose by pose; with [`SingularityMode::Error`] up to the zone or a jump.
    fn through(&mut self) -> Result<(), Error> {
        for pose in self.walk.path {
            if !self.walk.goes_on() {
                return Ok(());
            }
            let (solution, broken) = self.walk.follower.step(pose)?;
            let q = solution.map(|solution| solution.q);
            if self.options.singularity_mode == SingularityMode::Error {
                let stopped =
                    q.filter(|q| self.in_zone(q)).map(|q| BreakReason::Stopped { q5: q[4] });
                if let Some(reason) = stopped.or(broken) {
                    self.walk.record(None, Some(reason));
                    return Ok(());
                }
            }
            self.walk.record(q, broken);
        }
        Ok(())
    }

    /// The wrist moves straight through the zone; the other three axes keep the position.
    fn wrist(&mut self) -> Result<(), Error> {
        let mut index = 0;
        while index < self.walk.path.len() && self.walk.goes_on() {
            let (solution, broken) = self.walk.follower.step(&self.walk.path[index])?;
            let q = solution.map(|solution| solution.q);
            match q.filter(|q| self.in_zone(q)) {
                None => {
                    self.walk.record(q, broken);
                    index += 1;
                }
                Some(entered) => index = self.cross(index, entered, broken)?,
            }
        }
        Ok(())
    }

    /// Record the poses of one zone, starting at `first`; return the index of the first pose after
    /// it.
    ///
    /// The first and the last pose of the zone are met exactly. Between them axes 4 and 5 move
    /// straight, and axis 6 turns the tool as near to the pose as it can: both q5 and the tilt of
    /// the pose stay in the zone, so the tool deviates by at most two zones.
    fn cross(
        &mut self,
        first: usize,
        entered: [f64; 6],
        broken: Option<BreakReason>,
    ) -> Result<usize, Error> {
        // The end of the zone, on either wrist branch:
        //
        // sin q5
        //
        // is the same on both.
        let mut behind = first + 1;
        while behind < self.walk.path.len() && self.walk.goes_on() {
            match self.walk.follower.step(&self.walk.path[behind])?.0 {
                Some(solution) if self.in_zone(&solution.q) => behind += 1,
                _ => break,
            }
        }
        self.walk.record(Some(entered), broken);
        let left = match self.walk.robot.ik_nearest(
            &self.walk.path[behind - 1],
            &entered,
            &self.options.weights,
        ) {
            Ok(solution) => solution.q,
            Err(Error::Unreachable(_)) => entered,
            Err(error) => return Err(error),
        };
        let mut q = entered;
        for index in first + 1..behind {
            if !self.walk.goes_on() {
                break;
            }
            #[expect(clippy::cast_precision_loss, reason = "a part of the way")]
            let part = (index - first) as f64 / (behind - 1 - first) as f64;
            let mut wanted = q;
            (wanted[3], wanted[4]) = (
                entered[3] + (left[3] - entered[3]) * part,
                entered[4] + (left[4] - entered[4]) * part,
            );
            let found = if index + 1 == behind {
                Some(left)
            } else {
                self.solve_locked(&self.walk.path[index], &wanted, Locked::Axes4And5)?
            };
            let broken = found.map_or(Some(BreakReason::Locked), |found| jump(&q, &found));
            q = found.unwrap_or(q);
            self.walk.record(found, broken);
        }
        self.walk.follower.continue_from(&self.walk.path[behind - 1], q);
        Ok(behind)
    }

    /// Axis 4 at whichever of 0 and +-180 deg is nearest, for the whole path.
    fn lock_axis_4(&mut self) -> Result<(), Error> {
        let mut previous: Option<[f64; 6]> = None;
        for pose in self.walk.path {
            if !self.walk.goes_on() {
                return Ok(());
            }
            let from = match previous {
                Some(q) => q,
                // Before the first pose that is reached, the path is at the seed.
                None => match self.walk.follower.step(pose)? {
                    (Some(start), _) => self.locked(start.q),
                    (None, broken) => {
                        self.walk.record(None, broken);
                        continue;
                    }
                },
            };
            let locked = self.solve_locked(pose, &from, Locked::Axis4)?;
            let broken = match (locked, previous) {
                (None, _) => Some(BreakReason::Locked),
                (Some(q), Some(before)) => jump(&before, &q),
                (Some(_), None) => None,
            };
            previous = locked.or(previous);
            self.walk.record(locked, broken);
        }
        Ok(())
    }

    /// `q` with axis 4 locked in the plane of the arm.
    fn locked(&self, mut q: [f64; 6]) -> [f64; 6] {
        if let Some(arm) = self.walk.robot.spherical_wrist() {
            q[3] = arm.axis_4_in_plane(&q);
        }
        q
    }

    /// The joint vector for a pose with the wrist locked as in `q`: arm and wrist are solved in
    /// turn until both converge.
    fn solve_locked(
        &self,
        pose: &Pose,
        q: &[f64; 6],
        how: Locked,
    ) -> Result<Option<[f64; 6]>, Error> {
        let pose = checked_pose(pose)?;
        let Some(Solver { structure: arm, end_frames, .. }) = self.walk.robot.wrist_solver() else {
            return Ok(None);
        };
        let rotation = end_frames.wrist_pose(&pose).rotation;
        let (point, lever) = end_frames.tool_point(&pose);
        let mut locked = *q;
        for _ in 0..ROUNDS {
            let m = arm.rotation_in_forearm(rotation.matrix(), &locked);
            let wrist = match how {
                Locked::Axis4 => arm.with_axis_4_locked(&m, &locked),
                Locked::Axes4And5 => arm.with_axes_4_and_5_locked(&m, &locked),
            };
            let wrist = self.walk.robot.limits().wrapped_near(&wrist, &locked);
            let Some(next) = wrist.and_then(|wrist| self.to_point(arm, &point, &lever, &wrist))
            else {
                return Ok(None);
            };
            let moved = next.iter().zip(&locked).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            locked = next;
            if moved < LOCKED_CONVERGED {
                break;
            }
        }
        Ok(Some(locked))
    }

    /// The joint vector inside the limits, nearest to `q`, that brings `lever`, in the wrist frame,
    /// to `point` with the wrist of `q`.
    fn to_point(
        &self,
        arm: &SphericalWrist,
        point: &Vector3<f64>,
        lever: &Vector3<f64>,
        q: &[f64; 6],
    ) -> Option<[f64; 6]> {
        let distance =
            |found: &[f64; 6]| found.iter().zip(q).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
        let found = arm
            .to_point(point, lever, q)
            .filter_map(|found| self.walk.robot.limits().wrapped_near(&found, q));
        found.min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }
}

/// A step of the locked arm that is too large to belong to the path.
fn jump(from: &[f64; 6], to: &[f64; 6]) -> Option<BreakReason> {
    let (joint, by) = largest_step(from, to);
    (by.abs() > JUMP_BLIND).then_some(BreakReason::Jump {
        joint,
        by,
        kinds: SingularityKind::empty(),
    })
}
