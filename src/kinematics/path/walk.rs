//! A path that is followed pose by pose, for as long as the caller wants.

use alloc::vec::Vec;

use crate::error::Error;
use crate::kinematics::path::follow::{Break, BreakReason, Followed, Follower};
use crate::kinematics::pose::{Pose, PoseDifference};
use crate::kinematics::robot::Robot;

/// Steps between two questions whether to go on.
const ASKED_EVERY: usize = 32;

/// The state of following a path.
pub(super) struct Walk<'a, const N: usize> {
    pub(super) robot: &'a Robot<N>,
    pub(super) path: &'a [Pose],
    pub(super) follower: Follower<'a, N>,
    followed: Followed<N>,
    go_on: &'a mut dyn FnMut() -> bool,
    steps: usize,
    is_stopped: bool,
}

impl<'a, const N: usize> Walk<'a, N> {
    pub(super) fn new(
        robot: &'a Robot<N>,
        path: &'a [Pose],
        follower: Follower<'a, N>,
        go_on: &'a mut dyn FnMut() -> bool,
    ) -> Self {
        let followed = Followed {
            q: Vec::with_capacity(path.len()),
            orientation_error: Vec::with_capacity(path.len()),
            breaks: Vec::new(),
        };
        Self { robot, path, follower, followed, go_on, steps: 0, is_stopped: false }
    }

    /// Whether to take another step.
    pub(super) fn goes_on(&mut self) -> bool {
        self.steps += 1;
        if self.steps.is_multiple_of(ASKED_EVERY) {
            self.is_stopped |= !(self.go_on)();
        }
        !self.is_stopped
    }

    pub(super) fn record(&mut self, q: Option<[f64; N]>, broken: Option<BreakReason>) {
        let pose_index = self.followed.q.len();
        self.followed.q.push(q);
        self.followed.breaks.extend(broken.map(|reason| Break { pose_index, reason }));
    }

    /// Measure the orientation error at every pose.
    pub(super) fn finish(mut self) -> Followed<N> {
        for (index, pose) in self.path.iter().enumerate().take(self.followed.q.len()) {
            if !self.goes_on() {
                break;
            }
            let error = |q: [f64; N]| PoseDifference::between(&self.robot.fk(&q), pose).rotation;
            self.followed.orientation_error.push(self.followed.q[index].map(error));
        }
        // The rest of the path after it stopped.
        self.followed.q.resize(self.path.len(), None);
        self.followed.orientation_error.resize(self.path.len(), None);
        self.followed
    }
}

impl Robot<7> {
    /// Follow `path` with one continuous joint path inside the limits, starting from the joints
    /// nearest to `seed` [rad] that reach the first pose. Each step is the smallest along the
    /// self-motion of its pose, by `weights`; a joint of [`Robot::locked`] stays at its angle.
    ///
    /// # Errors
    ///
    /// As [`Robot::ik_nearest`]; a pose that cannot be reached is a break, not an error.
    pub fn follow(
        &self,
        path: &[Pose],
        seed: &[f64; 7],
        weights: &[f64; 7],
    ) -> Result<Followed<7>, Error> {
        self.follow_while(path, seed, weights, &mut || true)
    }

    /// [`Robot::<7>::follow`] for as long as `go_on` says so; it is asked now and then.
    pub(crate) fn follow_while(
        &self,
        path: &[Pose],
        seed: &[f64; 7],
        weights: &[f64; 7],
        go_on: &mut dyn FnMut() -> bool,
    ) -> Result<Followed<7>, Error> {
        let mut walk = Walk::new(self, path, Follower::new(self, seed, weights)?, go_on);
        for pose in path {
            if !walk.goes_on() {
                break;
            }
            let (solution, broken) = walk.follower.step(pose)?;
            walk.record(solution.map(|solution| solution.q), broken);
        }
        Ok(walk.finish())
    }
}
