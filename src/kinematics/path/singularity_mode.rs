//! Singularity modes: how a path crosses the wrist singularity, named as ABB names them.

use crate::error::{Error, JointFault, ModelFault};
use crate::interrupt::Interrupt;
use crate::kinematics::answer::status::SingularityKind;
use crate::kinematics::path::follow::{BreakReason, Followed, Follower, largest_step};
use crate::kinematics::path::walk::Walk;
use crate::kinematics::pose::{Pose, checked_pose};
use crate::kinematics::robot::Robot;
use crate::kinematics::structure::inverse::Inverse;
use crate::kinematics::structure::self_motions::LockedWrist;
use crate::kinematics::thresholds::{JUMP_BLIND, WRIST_ZONE};

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
        self.follow_until(path, seed, options, Interrupt::none())
    }

    /// [`Robot::follow`] until it is interrupted. The rest of the path is not met.
    #[doc(hidden)]
    pub fn follow_until(
        &self,
        path: &[Pose],
        seed: &[f64; 6],
        options: &FollowOptions,
        interrupt: Interrupt<'_>,
    ) -> Result<Followed, Error> {
        let how = (options.singularity_mode, options.zone);
        self.follow_in_mode(path, [seed, &options.weights], how, interrupt)
    }
}

macro_rules! follow_by_weights {
    ($($joints:literal)+) => {
        $(impl Robot<$joints> {
            /// Follow `path` with one continuous joint path inside the limits, starting from the
            /// joints nearest to `seed` [rad] that reach the first pose. Of seven joints each step
            /// is the smallest along the self-motion of its pose, by `weights`, and a joint of
            /// [`Robot::locked`] stays at its angle; five reach each pose within
            /// [`Robot::heading_tolerance`].
            ///
            /// # Errors
            ///
            /// As [`Robot::ik_nearest`]; a pose that cannot be reached is a break, not an error.
            pub fn follow(
                &self,
                path: &[Pose],
                seed: &[f64; $joints],
                weights: &[f64; $joints],
            ) -> Result<Followed<$joints>, Error> {
                self.follow_through(path, seed, weights, Interrupt::none())
            }
        })+
    };
}
follow_by_weights!(5 7);

impl<const N: usize> Robot<N> {
    /// [`Robot::<7>::follow`] until it is interrupted, of any number of joints.
    #[doc(hidden)]
    pub fn follow_through(
        &self,
        path: &[Pose],
        seed: &[f64; N],
        weights: &[f64; N],
        interrupt: Interrupt<'_>,
    ) -> Result<Followed<N>, Error> {
        let how = (SingularityMode::Through, WRIST_ZONE);
        self.follow_in_mode(path, [seed, weights], how, interrupt)
    }

    /// Follow a path from a seed by weights, in a singularity mode with its zone.
    pub(super) fn follow_in_mode(
        &self,
        path: &[Pose],
        [seed, weights]: [&[f64; N]; 2],
        (mode, zone): (SingularityMode, f64),
        interrupt: Interrupt<'_>,
    ) -> Result<Followed<N>, Error> {
        if !(0.0..=1.0).contains(&zone) {
            return Err(JointFault::Zone { value: zone }.into());
        }
        if matches!(mode, SingularityMode::Wrist | SingularityMode::LockAxis4)
            && self.singular_wrist().is_none()
        {
            return Err(ModelFault::NoSphericalWrist.into());
        }
        let follower = Follower::new(self, seed, weights)?;
        let walk = Walk::new(self, path, follower, interrupt);
        let mut walk = Modes { walk, weights, mode, zone };
        match mode {
            SingularityMode::Through | SingularityMode::Error => walk.through()?,
            SingularityMode::Wrist => walk.wrist()?,
            SingularityMode::LockAxis4 => walk.lock_axis_4()?,
        }
        Ok(walk.walk.finish())
    }
}

/// A path that is followed in one of the modes.
struct Modes<'a, const N: usize> {
    walk: Walk<'a, N>,
    weights: &'a [f64; N],
    mode: SingularityMode,
    zone: f64,
}

impl<const N: usize> Modes<'_, N> {
    fn in_zone(&self, q: &[f64; N]) -> bool {
        self.walk.robot.sin_5(q).is_some_and(|sin_5| sin_5.abs() < self.zone)
    }

    /// Pose by pose; with [`SingularityMode::Error`] up to the zone or a jump.
    fn through(&mut self) -> Result<(), Error> {
        for pose in self.walk.path {
            if !self.walk.goes_on() {
                return Ok(());
            }
            let (solution, broken) = self.walk.follower.step(pose)?;
            let q = solution.map(|solution| solution.q);
            if self.mode == SingularityMode::Error {
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
        entered: [f64; N],
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
        let left =
            match self.walk.robot.ik_nearest(&self.walk.path[behind - 1], &entered, self.weights) {
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
                self.solve_locked(&self.walk.path[index], &wanted, LockedWrist::Axes4And5)?
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
        let mut previous: Option<[f64; N]> = None;
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
            let locked = self.solve_locked(pose, &from, LockedWrist::Axis4)?;
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
    fn locked(&self, mut q: [f64; N]) -> [f64; N] {
        if let Some(arm) = self.walk.robot.singular_wrist() {
            q[3] = arm.axis_4_in_plane(&q);
        }
        q
    }

    /// The joint vector for a pose with the wrist locked as in `q`.
    fn solve_locked(
        &self,
        pose: &Pose,
        q: &[f64; N],
        how: LockedWrist,
    ) -> Result<Option<[f64; N]>, Error> {
        let (robot, pose) = (self.walk.robot, checked_pose(pose)?);
        let end_frames = robot.inverse().and_then(Inverse::end_frames);
        Ok(robot.singular_wrist().zip(end_frames).and_then(|(wrist, end_frames)| {
            wrist.with_locked_wrist(end_frames, robot.limits(), &pose, q, how)
        }))
    }
}

impl<const N: usize> Robot<N> {
    /// Joints along a path whose wrist axes go evenly to those of `to` [rad] while the tool keeps its
    /// positions, not its orientations: as `SingArea \Wrist` does where the wrist turns over.
    #[doc(hidden)]
    pub fn with_even_wrist(
        &self,
        path: &[Pose],
        [from, to]: [&[f64; N]; 2],
        interrupt: Interrupt<'_>,
    ) -> Option<alloc::vec::Vec<[f64; N]>> {
        let wrist = self.singular_wrist()?;
        let end_frames = self.inverse().and_then(Inverse::end_frames)?;
        let mut q = *from;
        let steps = path.len().saturating_sub(1).max(1);
        let pass = |(index, pose): (usize, &Pose)| {
            #[expect(clippy::cast_precision_loss, reason = "a part of the way")]
            let part = index as f64 / steps as f64;
            if interrupt.ends(index) {
                return None;
            }
            let mut wanted = q;
            for joint in N - 3..N {
                wanted[joint] = from[joint] + (to[joint] - from[joint]) * part;
            }
            let (limits, locked) = (self.limits(), LockedWrist::All);
            let found = wrist.with_locked_wrist(end_frames, limits, pose, &wanted, locked)?;
            let before = core::mem::replace(&mut q, found);
            jump(&before, &found).is_none().then_some(found)
        };
        path.iter().enumerate().map(pass).collect()
    }
}

/// A step of the locked arm that is too large to belong to the path.
fn jump<const N: usize>(from: &[f64; N], to: &[f64; N]) -> Option<BreakReason> {
    let (joint, by) = largest_step(from, to);
    (by.abs() > JUMP_BLIND).then_some(BreakReason::Jump {
        joint,
        by,
        kinds: SingularityKind::empty(),
    })
}
