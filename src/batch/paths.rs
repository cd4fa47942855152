//! Many paths, followed.

use alloc::vec::Vec;

use super::pace::Batch;
use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::kinematics::{Followed, Pose};

impl Batch<'_> {
    /// `follow` of paths of `length` poses each, one behind the other, from a seed each.
    #[doc(hidden)]
    pub fn follow<const N: usize>(
        &mut self,
        poses: &[Pose],
        length: usize,
        seeds: &[[f64; N]],
        follow: impl Fn(&[Pose], &[f64; N], Interrupt<'_>) -> Result<Followed<N>, Error> + Sync,
    ) -> Result<Vec<Followed<N>>, Error> {
        let mut answers: Vec<_> = seeds.iter().map(|_| None).collect();
        // One path is one part.
        let rows = if seeds.len() > 1 { poses.len() } else { 0 };
        let parts = seeds.iter().zip(&mut answers).enumerate();
        self.run(rows, parts, |(number, (seed, answer)), interrupt| {
            let path = &poses[number * length..(number + 1) * length];
            *answer = Some(follow(path, seed, interrupt));
        });
        answers.into_iter().flatten().collect()
    }
}
