//! The samples of a motion: joints, and the way of the tool from one to the next.

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use alloc::vec::Vec;
use core::ops::Range;

use crate::kinematics::Pose;

/// The way of the tool between two samples: a length [m] and an angle [rad].
pub(in crate::rapid) type Way = [f64; 2];

/// Samples in order, grouped by moves.
#[derive(Default)]
pub(in crate::rapid) struct Samples {
    pub(in crate::rapid) q: Vec<[f64; 6]>,
    /// The way from the sample before.
    pub(in crate::rapid) ways: Vec<Way>,
    /// How many samples there are after each move.
    pub(in crate::rapid) ends: Vec<usize>,
    /// How many there are before the first move: 1 if a start is given.
    pub(in crate::rapid) first: usize,
}

impl Samples {
    pub(in crate::rapid) fn push(&mut self, q: [f64; 6], way: Way) {
        self.q.push(q);
        self.ways.push(way);
    }

    /// The samples of a move.
    pub(in crate::rapid) fn own(&self, index: usize) -> Range<usize> {
        let begin = index.checked_sub(1).map_or(self.first, |before| self.ends[before]);
        begin..self.ends[index]
    }

    /// The intervals of a move, by the samples that they end at.
    pub(in crate::rapid) fn intervals(&self, index: usize) -> Range<usize> {
        let own = self.own(index);
        own.start.max(1).min(own.end)..own.end
    }
}

/// The joints of a move after those that it begins with, and the way of the tool to each.
#[derive(Default)]
pub(in crate::rapid) struct Path {
    pub(in crate::rapid) q: Vec<[f64; 6]>,
    pub(in crate::rapid) ways: Vec<Way>,
}

impl Path {
    pub(in crate::rapid) fn push(&mut self, q: [f64; 6], way: Way) {
        self.q.push(q);
        self.ways.push(way);
    }

    /// The length of the tool's way [m].
    pub(in crate::rapid) fn length(&self) -> f64 {
        self.ways.iter().map(|way| way[0]).sum()
    }
}

/// The way of the tool from one pose to another.
pub(in crate::rapid) fn way(from: &Pose, to: &Pose) -> Way {
    let length = (to.translation.vector - from.translation.vector).norm();
    // |R1 - R0| in the Frobenius norm is 2 sqrt(2) sin(angle / 2).
    let apart = (to.rotation.matrix() - from.rotation.matrix()).norm();
    let half_sin = apart / (2.0 * core::f64::consts::SQRT_2);
    [length, 2.0 * half_sin.min(1.0).asin()]
}

/// The joint (from 1) that takes longest between two samples at its limit, and how long [s].
pub(in crate::rapid) fn slowest(
    from: &[f64; 6],
    to: &[f64; 6],
    max_velocity: &[f64; 6],
) -> (usize, f64) {
    let time = |joint: usize| (to[joint] - from[joint]).abs() / max_velocity[joint];
    let (mut slowest, mut longest) = (0, time(0));
    for joint in 1..6 {
        if time(joint) > longest {
            (slowest, longest) = (joint, time(joint));
        }
    }
    (slowest + 1, longest)
}
