//! Shorter paths: waypoints left out, corners cut.

use super::samples::Halton;
use super::search::{Space, between};
use crate::prelude::*;
use crate::trajectory::distance;

/// Corners that are tried to be cut.
const CUTS: usize = 40;

impl<const N: usize> Space<'_, N> {
    /// A shorter path with the same ends, of even motions that are free.
    pub(super) fn shortened(&mut self, path: &[[f64; N]], seed: u64) -> Vec<[f64; N]> {
        let mut path = self.without_detours(path);
        let mut places = Halton::<2>::new(seed);
        for _ in 0..CUTS {
            if path.len() == 2 {
                return path;
            }
            let lengths = lengths(&path);
            let whole = lengths[lengths.len() - 1];
            let [a, b] = places.next().map(|place| place * whole);
            let [(first, from), (last, to)] =
                [a.min(b), a.max(b)].map(|at| point(&path, &lengths, at));
            if first < last && self.is_free(&from, &to) {
                path.splice(first + 1..=last, [from, to]);
            }
        }
        self.without_detours(&path)
    }

    /// From each waypoint on straight to the last one that is free from there.
    fn without_detours(&mut self, path: &[[f64; N]]) -> Vec<[f64; N]> {
        let mut kept = Vec::from([path[0]]);
        let mut at = 0;
        while at + 1 < path.len() {
            let farther = (at + 2..path.len()).rev();
            let next = farther.into_iter().find(|to| self.is_free(&path[at], &path[*to]));
            at = next.unwrap_or(at + 1);
            kept.push(path[at]);
        }
        kept
    }
}

/// The length of a path up to each waypoint [rad].
fn lengths<const N: usize>(path: &[[f64; N]]) -> Vec<f64> {
    let mut lengths = Vec::from([0.0]);
    for ends in path.windows(2) {
        lengths.push(lengths[lengths.len() - 1] + distance(&ends[0], &ends[1]));
    }
    lengths
}

/// The joint vector at a length, and the waypoint before it.
fn point<const N: usize>(path: &[[f64; N]], lengths: &[f64], at: f64) -> (usize, [f64; N]) {
    let side = lengths[1..lengths.len() - 1].partition_point(|length| *length <= at);
    let [from, to] = [&path[side], &path[side + 1]];
    let part = (at - lengths[side]) / (lengths[side + 1] - lengths[side]);
    (side, between(from, to, part))
}
