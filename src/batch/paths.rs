//! Many paths, followed or planned.

use alloc::vec::Vec;
use core::cell::RefCell;

use super::pace::Batch;
use crate::error::Error;
use crate::kinematics::{FollowOptions, Followed, Pose, Robot};
use crate::plan::{Caller, Plan, PlanError, PlanOptions, Watch};

/// A path and what is asked of its plan.
pub(crate) struct PlanJob {
    pub(crate) path: Vec<Pose>,
    pub(crate) options: PlanOptions,
}

/// A caller's own test of joint vectors that several threads may ask at once: whether each is
/// accepted, or nothing to stop.
pub(crate) type SharedAccept<'a> = dyn Fn(&[[f64; 6]]) -> Option<Vec<bool>> + Sync + 'a;

impl Batch<'_> {
    /// [`Robot::follow`] of paths of `length` poses each, one behind the other, from a seed each.
    pub(crate) fn follow(
        &mut self,
        robot: &Robot<6>,
        poses: &[Pose],
        length: usize,
        seeds: &[[f64; 6]],
        options: &FollowOptions,
    ) -> Result<Vec<Followed>, Error> {
        let mut answers: Vec<_> = seeds.iter().map(|_| None).collect();
        // One path is one part.
        let rows = if seeds.len() > 1 { poses.len() } else { 0 };
        let parts = seeds.iter().zip(&mut answers).enumerate();
        self.run(rows, parts, |(number, (seed, answer)), go_on| {
            let path = &poses[number * length..(number + 1) * length];
            *answer = Some(robot.follow_while(path, seed, options, go_on));
        });
        answers.into_iter().flatten().collect()
    }

    /// [`Robot::plan`] of each path, in their order. One that was stopped, or not begun, is
    /// [`PlanError::Stopped`].
    pub(crate) fn plan(
        &mut self,
        robot: &Robot<6>,
        jobs: &[PlanJob],
        accept: Option<&SharedAccept<'_>>,
    ) -> Vec<Result<Plan, PlanError>> {
        let mut answers: Vec<_> = jobs.iter().map(|_| Err(PlanError::Stopped)).collect();
        // One path is one part.
        let angles = |job: &PlanJob| job.options.rotation.map_or(1, |rotation| rotation.steps());
        let rows = jobs.iter().map(|job| job.path.len() * angles(job)).sum();
        let rows = if jobs.len() > 1 { rows } else { 0 };
        self.run(rows, jobs.iter().zip(&mut answers), |(job, answer), go_on| {
            let mut ask = |q: &[[f64; 6]]| accept.and_then(|accept| accept(q));
            let go_on = RefCell::new(&mut *go_on);
            let goes_on = || go_on.borrow_mut()();
            let mut caller = Caller { accept: None, watch: Watch(Some(&goes_on)) };
            if accept.is_some() {
                caller.accept = Some(&mut ask);
            }
            *answer = robot.planned(&job.path, &job.options, &mut caller);
        });
        answers
    }
}
