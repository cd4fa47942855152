//! The part of a pose that its candidates need.

use fearless_simd::prelude::*;

use super::annihilator::Second;
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::{LANES, Number, Vector, transposed};

/// The link of a loop that is the pose, or one in each lane.
#[derive(Clone, Copy)]
pub(super) struct PoseLink<T = f64> {
    pub(super) link: Frame<T>,
    pub(super) inverse: Frame<T>,
    pub(super) second: Second<T>,
}

impl PoseLink {
    pub(super) const NONE: Self = Self {
        link: Frame::IDENTITY,
        inverse: Frame::IDENTITY,
        second: Second { along: [0.0; 6], weights: [[0.0; 6]; 2] },
    };

    /// Broadcast to the lanes of a number.
    #[inline(always)]
    pub(super) fn in_lanes<T: Number>(&self, like: T) -> PoseLink<T> {
        let Second { along, weights } = &self.second;
        let mut second = Second { along: [like; 6], weights: [[like; 6]; 2] };
        for k in 0..6 {
            second.along[k] = like.like(along[k]);
            second.weights[0][k] = like.like(weights[0][k]);
            second.weights[1][k] = like.like(weights[1][k]);
        }
        PoseLink { link: self.link.in_lanes(like), inverse: self.inverse.in_lanes(like), second }
    }
}

impl<S: Simd> PoseLink<Vector<S>> {
    /// Gather eight poses, one in each lane.
    #[inline(always)]
    pub(super) fn of_each(simd: S, each: &[&PoseLink; LANES]) -> Self {
        let [mut links, mut inverses] = [[&each[0].link; LANES]; 2];
        let mut along = [&each[0].second.along; LANES];
        let [mut cos, mut sin] = [[&each[0].second.weights[0]; LANES]; 2];
        for lane in 0..LANES {
            let PoseLink { link, inverse, second } = each[lane];
            (links[lane], inverses[lane], along[lane]) = (link, inverse, &second.along);
            [cos[lane], sin[lane]] = [&second.weights[0], &second.weights[1]];
        }
        Self {
            link: Frame::of_each(simd, &links),
            inverse: Frame::of_each(simd, &inverses),
            second: Second {
                along: transposed(simd, &along),
                weights: [transposed(simd, &cos), transposed(simd, &sin)],
            },
        }
    }
}
