//! Many paths, followed.

use alloc::vec::Vec;

use super::pace::Batch;
use crate::error::Error;
use crate::kinematics::{FollowOptions, Followed, Pose, Robot};

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
}
