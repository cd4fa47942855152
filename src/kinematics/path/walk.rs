//! A path that is followed pose by pose, until the caller interrupts it.

use alloc::vec::Vec;

use crate::interrupt::Interrupt;
use crate::kinematics::path::follow::{Break, BreakReason, Followed, Follower};
use crate::kinematics::pose::{Pose, PoseDifference};
use crate::kinematics::robot::Robot;

/// The state of following a path.
pub(super) struct Walk<'a, const N: usize> {
    pub(super) robot: &'a Robot<N>,
    pub(super) path: &'a [Pose],
    pub(super) follower: Follower<'a, N>,
    followed: Followed<N>,
    interrupt: Interrupt<'a>,
    steps: usize,
    is_stopped: bool,
}

impl<'a, const N: usize> Walk<'a, N> {
    pub(super) fn new(
        robot: &'a Robot<N>,
        path: &'a [Pose],
        follower: Follower<'a, N>,
        interrupt: Interrupt<'a>,
    ) -> Self {
        let followed = Followed {
            q: Vec::with_capacity(path.len()),
            orientation_error: Vec::with_capacity(path.len()),
            breaks: Vec::new(),
        };
        Self { robot, path, follower, followed, interrupt, steps: 0, is_stopped: false }
    }

    /// Whether to take another step.
    pub(super) fn goes_on(&mut self) -> bool {
        self.steps += 1;
        self.is_stopped |= self.interrupt.ends(self.steps);
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
