//! The choice of splits for an arm: those that find every solution of poses that are drawn, random
//! ones and structured ones.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use alloc::sync::Arc;
use alloc::vec::Vec;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::at_roots::FirstSplit;
use super::attempt::Attempt;
use super::split::{SPLITS, Split};
use crate::kinematics::structure::by_roots::{ByRoots as _, InCluster, regular_of};
use crate::kinematics::structure::closure::{Accepted, Closure, Target};
use crate::kinematics::structure::end_frames::Frame;
use crate::lanes::run_vectors;

/// Splits that an arm keeps: one that is tried first, and others where its count is not certain.
pub(super) const KEPT: usize = 4;

/// Random joint vectors, on the first of which all splits are scored, and structured ones of each
/// kind.
const RANDOM: usize = 16;
const FIRST: usize = 6;
const STRUCTURED: usize = 3;

/// Random joint vectors on which the splits of another arm are tried.
const OF_ANOTHER: usize = 3;

/// Splits that are scored on the rest.
const TRIED: usize = 6;

/// Angles of a quasi-random sequence: multiples of powers of the inverse of the root of
/// x^7 = x + 1. Reference: Roberts, The unreasonable effectiveness of quasirandom sequences, 2018.
pub(crate) fn quasi_random(index: usize) -> [f64; 6] {
    let root = 1.112_775_684_278_705_5_f64;
    let mut step = 1.0;
    core::array::from_fn(|_| {
        step /= root;
        #[expect(clippy::cast_precision_loss, reason = "a small number")]
        let part = 0.5 + step * (index + 1) as f64;
        let whole = crate::lanes::whole_below(part);
        PI * (2.0 * (part - whole) - 1.0)
    })
}

/// The joint vectors on which splits are scored: in general position; with joint 4 or 5, or both,
/// at zero or a half turn; and at multiples of 90 and 45 deg.
fn drawn(offsets: &[f64; 6]) -> Vec<[f64; 6]> {
    let mut all: Vec<_> = (0..RANDOM).map(quasi_random).collect();
    let mut index = RANDOM;
    let mut next = || {
        index += 1;
        quasi_random(index)
    };
    let rounded = |q: f64, step: f64| step * (q / step).round();
    for _ in 0..STRUCTURED {
        for joints in [&[3][..], &[4], &[3, 4], &[2], &[1]] {
            let mut q = next();
            for joint in joints {
                q[*joint] = 0.0;
            }
            all.push(q);
        }
        all.push(next().map(|q| rounded(q, FRAC_PI_2)));
        all.push(next().map(|q| rounded(q, FRAC_PI_4)));
    }
    // Joint angles are zero where the table's theta is its constant.
    for q in &mut all {
        for (q, offset) in q.iter_mut().zip(offsets) {
            *q -= offset;
        }
    }
    all
}

/// The splits of an arm, the best first, and whether most poses are regular in it; the searched
/// joints of the kept ones differ.
pub(super) fn chosen(
    links: &[Frame; 5],
    closure: &Closure,
    offsets: &[f64; 6],
) -> (Arc<Vec<Split>>, bool) {
    let poses: Vec<(Target, [f64; 6])> =
        drawn(offsets).into_iter().map(|theta| (closure.reached(&theta), theta)).collect();
    let (first, rest) = poses.split_at(FIRST);
    let total = |split: &Split, poses: &[_]| {
        poses.iter().map(|pose| score(split, closure, pose)).sum::<usize>()
    };
    // Of a split whose roots have two solutions each, a count would prove nothing.
    let new = |number| {
        let split = Split::new(links, number);
        split.is_single().then(|| (total(&split, first), split))
    };
    let mut splits: Vec<(usize, Split)> = (0..SPLITS).filter_map(new).collect();
    sort(&mut splits);
    for (score, split) in splits.iter_mut().take(TRIED) {
        // A split that finds next to nothing is not tried further.
        if *score > FIRST {
            *score += total(split, rest);
        }
    }
    sort(&mut splits);
    let best = splits.first().map_or(0, |(score, _)| *score);
    let mut kept: Vec<Split> = Vec::new();
    for (score, split) in splits {
        // One whose determinant vanishes for the arm is of no use.
        let is_good = kept.is_empty() || 2 * score >= best;
        if is_good
            && kept.len() < KEPT
            && kept.iter().all(|other| other.searched() != split.searched())
        {
            kept.push(split);
        }
    }
    let kept = Arc::new(kept);
    let is_mostly_regular = is_mostly_regular(&FirstSplit::new(closure, &kept), RANDOM);
    (kept, is_mostly_regular)
}

/// The splits of another arm for this one, if each proves a count and most poses are regular in the
/// first.
pub(super) fn taken(
    others: &[Split],
    links: &[Frame; 5],
    closure: &Closure,
) -> Option<Arc<Vec<Split>>> {
    let splits: Vec<_> = others.iter().map(|split| split.of(links)).collect();
    let splits = splits.iter().all(Split::is_single).then(|| Arc::new(splits))?;
    is_mostly_regular(&FirstSplit::new(closure, &splits), OF_ANOTHER).then_some(splits)
}

/// Whether most of so many random poses are regular in the first split. Those of an arm that is next
/// to one with a spherical wrist are not: their roots are pairs.
fn is_mostly_regular(method: &FirstSplit, poses: usize) -> bool {
    let closure = method.closure();
    let all: Vec<Frame> = (0..poses).map(|i| closure.last_frame(&quasi_random(i))).collect();
    2 * regular_of(method, &all) > poses
}

fn sort(splits: &mut [(usize, Split)]) {
    splits.sort_by_key(|(score, _)| core::cmp::Reverse(*score));
}

/// Points of a split for a pose: two if it finds the joints that made it, one if it is certain.
fn score(split: &Split, closure: &Closure, (target, theta): &(Target, [f64; 6])) -> usize {
    let mut accepted = Accepted::REGULAR_ONLY;
    let in_cluster = InCluster::Everywhere;
    let attempt = Attempt { split, closure, target, in_cluster, accepted: &mut accepted };
    let is_certain = run_vectors(attempt);
    let is_found = accepted.as_slice().iter().any(|one| one.distance(theta) < 1e-6);
    2 * usize::from(is_found) + usize::from(is_certain)
}
