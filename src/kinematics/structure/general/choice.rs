//! The choice of splits for an arm: those that find every solution of poses that are drawn, random
//! ones and structured ones.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use alloc::sync::Arc;
use alloc::vec::Vec;

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::at_roots::AtSplit;
use super::geometry::{General, RootKind};
use super::split::{SPLITS, Split};
use crate::kinematics::structure::by_roots::{
    ByRoots as _, NOISE_OF_SIZE, certifies, quasi_random, regular_of, size_of,
};
use crate::kinematics::structure::closure::{Accepted, Closure};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::thresholds::FORM_TOLERANCE;

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

/// The splits of an arm, the best first, and how their roots are; the searched joints of the kept
/// ones differ.
pub(super) fn chosen(
    links: &[Frame; 5],
    closure: &Closure,
    offsets: &[f64; 6],
) -> (Arc<Vec<Split>>, RootKind) {
    let poses: Vec<(Frame, [f64; 6])> =
        drawn(offsets).into_iter().map(|theta| (closure.last_frame(&theta), theta)).collect();
    let (first, rest) = poses.split_at(FIRST);
    // Of a split whose roots have two solutions each, a count would prove nothing.
    let all = (0..SPLITS).map(|number| Split::new(links, number)).filter(Split::is_single);
    let mut all = Arc::new(all.collect::<Vec<_>>());
    let is_parallel = |link: &Frame| 1.0 - link.rotation[2][2].abs() <= FORM_TOLERANCE;
    let are_three_parallel = links.windows(2).any(|pair| pair.iter().all(is_parallel));
    let has_pairs = all.len() < SPLITS && !are_three_parallel;
    let sizes: Vec<_> =
        (0..all.len()).map(|number| size_of(&AtSplit::new(closure, &all, number))).collect();
    for (split, size) in Arc::make_mut(&mut all).iter_mut().zip(sizes) {
        split.least_noise = NOISE_OF_SIZE * size;
    }
    let total = |number: usize, poses: &[_]| {
        let method = AtSplit::new(closure, &all, number);
        poses.iter().map(|pose| score(&method, pose)).sum::<usize>()
    };
    let mut scores: Vec<(usize, usize)> =
        (0..all.len()).map(|number| (total(number, first), number)).collect();
    sort(&mut scores);
    for (score, number) in scores.iter_mut().take(TRIED) {
        // A split that finds next to nothing is not tried further.
        if *score > FIRST {
            *score += total(*number, rest);
        }
    }
    sort(&mut scores);
    let best = scores.first().map_or(0, |(score, _)| *score);
    let mut kept: Vec<Split> = Vec::new();
    for (score, number) in scores {
        let split = &all[number];
        // One whose determinant vanishes for the arm is of no use.
        let is_good = kept.is_empty() || 2 * score >= best;
        if is_good
            && kept.len() < KEPT
            && kept.iter().all(|other| other.searched() != split.searched())
        {
            kept.push(split.clone());
        }
    }
    let kept = Arc::new(kept);
    let roots = match is_mostly_regular(&AtSplit::new(closure, &kept, 0), RANDOM) {
        _ if has_pairs => {
            let first: Vec<_> = first.iter().map(|(last, _)| *last).collect();
            RootKind::Pairs(certifying(&kept, closure, &first).take(2).count().max(1))
        }
        true => RootKind::Regular,
        false => RootKind::Irregular,
    };
    (kept, roots)
}

/// The splits that certify one of some poses, at least, by number.
fn certifying<'a>(
    splits: &'a Arc<Vec<Split>>,
    closure: &'a Closure,
    poses: &'a [Frame],
) -> impl Iterator<Item = usize> + 'a {
    (0..splits.len()).filter(move |number| {
        let method = AtSplit::new(closure, splits, *number);
        poses.iter().any(|last| certifies(&method, last, &mut Accepted::regular_only()))
    })
}

/// The splits of another arm for this one, if each proves a count and they serve it as they serve
/// the other: as many certify a random pose, or most poses are regular in the first.
pub(super) fn taken(
    other: &General,
    links: &[Frame; 5],
    closure: &Closure,
) -> Option<(Arc<Vec<Split>>, RootKind)> {
    let splits: Vec<_> = other.splits.iter().map(|split| split.of(links)).collect();
    let splits = splits.iter().all(Split::is_single).then(|| Arc::new(splits))?;
    let (serves, roots) = if let RootKind::Pairs(wanted) = other.roots {
        let poses = random_poses(closure, OF_ANOTHER);
        let found = certifying(&splits, closure, &poses).take(wanted).count();
        (found == wanted, other.roots)
    } else {
        (is_mostly_regular(&AtSplit::new(closure, &splits, 0), OF_ANOTHER), RootKind::Regular)
    };
    serves.then_some((splits, roots))
}

fn random_poses(closure: &Closure, count: usize) -> Vec<Frame> {
    (0..count).map(|index| closure.last_frame(&quasi_random(index))).collect()
}

/// Whether most of so many random poses are regular in the first split. Of an arm next
/// to one with a spherical wrist they are not: their roots are pairs.
fn is_mostly_regular(method: &AtSplit, poses: usize) -> bool {
    2 * regular_of(method, &random_poses(method.closure(), poses)) > poses
}

fn sort(scores: &mut [(usize, usize)]) {
    scores.sort_by_key(|(score, _)| core::cmp::Reverse(*score));
}

/// Points of a split for a pose: two if it finds the joints that made it, one if it certifies them.
fn score(method: &AtSplit, (last, theta): &(Frame, [f64; 6])) -> usize {
    let mut accepted = Accepted::regular_only();
    let is_certified = certifies(method, last, &mut accepted);
    let is_found = accepted.as_slice().iter().any(|one| one.distance(theta) < 1e-6);
    2 * usize::from(is_found) + usize::from(is_certified)
}
