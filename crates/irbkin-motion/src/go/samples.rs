//! Joint vectors all over the range of the joints: a Halton sequence.

use crate::prelude::*;
use core::array;
use core::f64::consts::PI;

use irbkin::Robot;

/// The bases of the sequence, one for each joint.
const BASES: [u32; 7] = [2, 3, 5, 7, 11, 13, 17];

/// The places of a Halton sequence, moved by an offset that a seed determines: from 0 to 1 each.
pub(super) struct Halton<const N: usize> {
    index: u32,
    offset: [f64; N],
}

impl<const N: usize> Halton<N> {
    pub(super) fn new(seed: u64) -> Self {
        let mut state = seed;
        let offset = array::from_fn(|_| unit(&mut state));
        Self { index: 0, offset }
    }

    pub(super) fn next(&mut self) -> [f64; N] {
        self.index = self.index.wrapping_add(1);
        array::from_fn(|joint| {
            let place = self.offset[joint] + inverse(self.index, BASES[joint % BASES.len()]);
            if place < 1.0 { place } else { place - 1.0 }
        })
    }
}

/// The digits of a number in a base, mirrored at the point.
fn inverse(mut index: u32, base: u32) -> f64 {
    let (mut place, mut sum) = (1.0, 0.0);
    while index > 0 {
        place /= f64::from(base);
        sum += place * f64::from(index % base);
        index /= base;
    }
    sum
}

/// A number from 0 to 1 (splitmix64).
fn unit(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mixed = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    let high = u32::try_from((mixed ^ (mixed >> 31)) >> 32).unwrap_or_default();
    f64::from(high) / (f64::from(u32::MAX) + 1.0)
}

/// Joint vectors inside the limits, each joint at most half a turn beyond the ends of a motion.
pub(super) struct Samples<const N: usize> {
    halton: Halton<N>,
    low: [f64; N],
    high: [f64; N],
}

impl<const N: usize> Samples<N> {
    pub(super) fn new(robot: &Robot<N>, ends: &[Vec<[f64; N]>; 2], seed: u64) -> Self {
        let limits = robot.free_ranges();
        let all = |joint: usize| ends.iter().flatten().map(move |q| q[joint]);
        let low = |joint: usize| all(joint).fold(f64::INFINITY, f64::min) - PI;
        let high = |joint: usize| all(joint).fold(f64::NEG_INFINITY, f64::max) + PI;
        Self {
            halton: Halton::new(seed),
            low: array::from_fn(|joint| limits[joint][0].max(low(joint))),
            high: array::from_fn(|joint| limits[joint][1].min(high(joint))),
        }
    }

    pub(super) fn next(&mut self) -> [f64; N] {
        let place = self.halton.next();
        array::from_fn(|joint| {
            self.low[joint] + place[joint] * (self.high[joint] - self.low[joint])
        })
    }
}
