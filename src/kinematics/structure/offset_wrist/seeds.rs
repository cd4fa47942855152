//! Joint vectors near the solutions, from the roots of the resultant.
//!
//! Docs: offset_wrist.md, section 5.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::branch::{Branch, Plane, SIDES, branch_at, room_at};
use super::geometry::OffsetWrist;
use super::resultant::{Hand, samples};
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::{Accepted, Kind};
use crate::kinematics::structure::end_frames::Frame;
use crate::kinematics::structure::trigonometric::{Root, TrigonometricPolynomial};

/// Most seeds of a pose.
const MOST_SEEDS: usize = 128;

/// Size of z4 . z5 - cos alpha_4 below which a branch at a root is a seed, in addition to the best
/// one [1].
const SEED_OFF: f64 = 2e-3;

/// How far a branch may be out of reach and still be a seed, relative to the squares of the
/// lengths [1].
const SEED_SLACK: f64 = 1e-3;

/// Distance of the angles at which the branches are examined in a cluster of roots [rad], and the
/// most of them.
const SPACING: f64 = 5e-3;
const MOST_ANGLES: usize = 64;

/// Most clusters of roots: each holds two.
const MOST_CLUSTERS: usize = 8;

/// How far the angle of a solution may be from the interval of its root [rad].
const ROOT_ERROR: f64 = 1e-6;

/// Curvature of z4 . z5 along joint 6 that no arm exceeds in a cluster [1].
const MOST_CURVATURE: f64 = 100.0;

/// Angles at which the branches are examined if nothing is known of the roots.
const ALL_ANGLES: usize = 360;

/// Joint vectors near the solutions, and what the roots say of their number.
pub(super) struct Seeds {
    all: [[f64; 6]; MOST_SEEDS],
    count: usize,
    /// Number of solutions at simple roots.
    simple: usize,
    /// The clusters of roots.
    clusters: [Cluster; MOST_CLUSTERS],
    cluster_count: usize,
    /// Whether a root serves both sides of the shoulder.
    is_square: bool,
    /// Whether nothing was left out.
    is_complete: bool,
}

impl Seeds {
    pub(super) fn as_slice(&self) -> &[[f64; 6]] {
        &self.all[..self.count]
    }

    /// Whether these are as many solutions as the roots announce: one for each simple root, two, or
    /// an even number, in each cluster.
    pub(super) fn agrees(&self, accepted: &Accepted) -> bool {
        if !self.is_complete || !accepted.is_certain || accepted.has_self_motion() {
            return false;
        }
        let clusters = &self.clusters[..self.cluster_count];
        let mut in_cluster = [0; MOST_CLUSTERS];
        let mut at_simple = 0;
        for one in accepted.as_slice() {
            let holds = |cluster: &Cluster| {
                let Cluster { low, high, .. } = *cluster;
                let off = wrap(one.theta[5] - 0.5 * (low + high)).abs();
                off <= 0.5 * (high - low)
            };
            let count = if one.kind == Kind::Fold { 2 } else { 1 };
            match clusters.iter().position(holds) {
                Some(index) => in_cluster[index] += count,
                None => at_simple += count,
            }
        }
        at_simple == self.simple
            && clusters.iter().zip(in_cluster).all(|(cluster, count)| cluster.zeros == Some(count))
    }

    /// Replace the seeds by those of all angles.
    #[cold]
    pub(super) fn examine_all(&mut self, arm: &OffsetWrist, last: &Frame) {
        let pose = Pose { arm, last, hand: Hand::of::<false>(&arm.lengths, last) };
        self.count = 0;
        pose.examine([-PI, PI], ALL_ANGLES, self);
    }

    #[cfg(test)]
    fn show(&self) -> (usize, &[Cluster], std::vec::Vec<f64>, bool) {
        let sixth = self.as_slice().iter().map(|q| q[5]).collect();
        (self.simple, &self.clusters[..self.cluster_count], sixth, self.is_complete)
    }

    fn push(&mut self, seed: [f64; 6]) {
        match self.all.get_mut(self.count) {
            Some(place) => {
                *place = seed;
                self.count += 1;
            }
            None => self.is_complete = false,
        }
    }
}

/// A cluster of roots.
#[derive(Clone, Copy, Debug, Default)]
struct Cluster {
    low: f64,
    high: f64,
    /// Number of solutions in it; `None` if the branches do not show it.
    zeros: Option<usize>,
}

/// An arm and the frame that it is to reach.
struct Pose<'a> {
    arm: &'a OffsetWrist,
    last: &'a Frame,
    hand: Hand,
}

/// The seeds of a frame 6 in the shoulder frame.
pub(super) fn seeds<const FUSED: bool>(arm: &OffsetWrist, last: &Frame) -> Seeds {
    let hand = Hand::of::<FUSED>(&arm.lengths, last);
    let pose = Pose { arm, last, hand };
    let (values, _) = samples::<FUSED>(&arm.lengths, &hand);
    let roots = TrigonometricPolynomial::of_samples::<FUSED>(&values).roots::<FUSED>();
    let mut seeds = Seeds {
        all: [[0.0; 6]; MOST_SEEDS],
        count: 0,
        simple: 0,
        clusters: [Cluster::default(); MOST_CLUSTERS],
        cluster_count: 0,
        is_square: arm.lengths.is_square,
        is_complete: roots.is_complete,
    };
    for root in roots.as_slice() {
        if root.is_simple {
            pose.at_root(root, &mut seeds);
        } else {
            pose.in_cluster(root, &mut seeds);
        }
    }
    if !roots.is_complete {
        pose.examine([-PI, PI], ALL_ANGLES, &mut seeds);
    }
    seeds
}

impl Pose<'_> {
    fn branch(&self, sides: [f64; 2], angle: f64, slack: f64) -> Option<Branch> {
        branch_at(&self.arm.lengths, &self.hand, sides, sin_cos(angle), slack)
    }

    fn put(&self, branch: &Branch, angle: f64, seeds: &mut Seeds) {
        let joints =
            branch.joints::<false>(&self.arm.lengths, self.last, sin_cos(angle), &self.arm.twists);
        let mut seed = joints.map(|[sin, cos]| sin.atan2(cos));
        seed[5] = angle;
        if seed.iter().all(|angle| angle.is_finite()) {
            seeds.push(seed);
        }
    }

    /// The seeds of a simple root: the branch that is nearest to a solution, one on each side of
    /// the shoulder if a root serves both.
    fn at_root(&self, root: &Root, seeds: &mut Seeds) {
        let angle = root.angle();
        let branches = SIDES.map(|sides| self.branch(sides, angle, SEED_SLACK));
        let off = |branch: &Option<Branch>| branch.map_or(f64::INFINITY, |found| found.off.abs());
        let offs = branches.each_ref().map(off);
        let both = self.arm.lengths.is_square;
        seeds.simple += if both { 2 } else { 1 };
        let least = |of: &[f64]| of.iter().copied().fold(f64::INFINITY, f64::min);
        let best = if both { [least(&offs[..2]), least(&offs[2..])] } else { [least(&offs); 2] };
        for (index, branch) in branches.iter().enumerate() {
            let is_best = offs[index] <= best[index / 2];
            if let Some(branch) = branch
                && (is_best || offs[index] < SEED_OFF)
            {
                self.put(branch, angle, seeds);
            }
        }
    }

    /// The seeds of a cluster of roots.
    fn in_cluster(&self, root: &Root, seeds: &mut Seeds) {
        let Root { low, high, .. } = *root;
        let (low, high) = (low - ROOT_ERROR, high + ROOT_ERROR);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few")]
        let count = ((high - low) / SPACING) as usize;
        let zeros = self.examine([low, high], count.min(MOST_ANGLES), seeds);
        match seeds.clusters.get_mut(seeds.cluster_count) {
            Some(place) => {
                *place = Cluster { low, high, zeros };
                seeds.cluster_count += 1;
            }
            None => seeds.is_complete = false,
        }
        self.degenerate(root.angle(), seeds);
    }

    /// Examines the branches at angles of joint 6 in a range: seeds are where one changes its sign,
    /// and where one is near zero without a change. Returns the number of zeros, if it is certain.
    fn examine(&self, [low, high]: [f64; 2], inner: usize, seeds: &mut Seeds) -> Option<usize> {
        let count = inner + 4;
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let step = (high - low) / count as f64;
        // Between two angles whose values differ by more than this the branch is monotone, and it
        // has no zero where both are larger. Where it ends between them it changes by a root.
        let (bend, end) = (MOST_CURVATURE * step * step, MOST_CURVATURE * step.sqrt());
        let (mut zeros, mut is_certain) = (0, true);
        for sides in SIDES {
            let mut before: Option<(f64, f64)> = None;
            let mut best: Option<(f64, f64)> = None;
            let mut has_changed = false;
            let mut room = f64::NEG_INFINITY;
            for number in 0..=count {
                #[expect(clippy::cast_precision_loss, reason = "few")]
                let angle = low + step * number as f64;
                let here = self.branch(sides, angle, 0.0).map(|branch| (angle, branch.off));
                if let Some((angle, off)) = here
                    && best.is_none_or(|(_, least)| off.abs() < least)
                {
                    best = Some((angle, off.abs()));
                }
                match (before, here) {
                    (Some((at, was)), Some((_, off))) => {
                        let changes = (was < 0.0) != (off < 0.0);
                        let is_clear = !changes && was.abs().min(off.abs()) > bend;
                        is_certain &= is_clear || (off - was).abs() > bend;
                        if changes {
                            has_changed = true;
                            zeros += 1;
                            let zero = at + (angle - at) * was / (was - off);
                            if let Some(branch) = self.branch(sides, zero, SEED_SLACK) {
                                self.put(&branch, zero, seeds);
                            }
                        }
                    }
                    (Some((_, off)), None) => is_certain &= off.abs() > end,
                    (None, Some((_, off))) if number > 0 => {
                        is_certain &= off.abs() > end;
                    }
                    _ => {}
                }
                // Where the arm is out of reach at both ends, it must be so between them.
                room = if here.is_none() {
                    let next = room_at(&self.arm.lengths, &self.hand, sides[0], sin_cos(angle));
                    is_certain &= next.max(room) < -bend;
                    next
                } else {
                    f64::NEG_INFINITY
                };
                before = here;
            }
            if let Some((angle, off)) = best
                && !has_changed
                && off < 0.1
                && let Some(branch) = self.branch(sides, angle, SEED_SLACK)
            {
                self.put(&branch, angle, seeds);
            }
        }
        is_certain.then_some(zeros)
    }

    /// The seeds with the wrist point on axis 1 or at the end of the upper arm's reach: there the
    /// condition of axis 5 determines joint 1 or the forearm.
    fn degenerate(&self, angle: f64, seeds: &mut Seeds) {
        let lengths = &self.arm.lengths;
        let (point, axis_5) = self.hand.at::<false>(sin_cos(angle));
        for shoulder in [1.0, -1.0] {
            let plane = Plane::of::<false>(lengths, (point, axis_5), shoulder);
            for side in [1.0, -1.0] {
                if let Some(branch) = plane.with_axis_5::<false>(lengths, side, SEED_SLACK)
                    && branch.misses(lengths) < 1e-3 * self.arm.extent
                {
                    self.put(&branch, angle, seeds);
                }
            }
        }
        if point[0].hypot(point[1]) > 1e-3 * self.arm.extent || lengths.b != 0.0 {
            return;
        }
        for elbow in [1.0, -1.0] {
            let off = |theta_1: f64| {
                let (sin, cos) = theta_1.sin_cos();
                let plane =
                    Plane::facing::<false>(lengths, [cos, sin], [0.0, point[2]], axis_5, 0.0);
                plane.with_elbow::<false>(lengths, elbow, SEED_SLACK)
            };
            let [Some(zero), Some(quarter), Some(half)] = [0.0, 0.5 * PI, PI].map(&off) else {
                continue;
            };
            // middle + radius cos(theta_1 - at) by three values.
            let middle = 0.5 * (zero.off + half.off);
            let (x, y) = (0.5 * (zero.off - half.off), quarter.off - middle);
            let (radius, at) = (x.hypot(y), y.atan2(x));
            let turn = (-middle / radius).clamp(-1.0, 1.0).acos();
            for theta_1 in [at + turn, at - turn] {
                if let Some(branch) = off(theta_1) {
                    self.put(&branch, angle, seeds);
                }
            }
        }
    }
}

fn sin_cos(angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [sin, cos]
}

#[cfg(test)]
impl core::fmt::Debug for Seeds {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        self.show().fmt(f)
    }
}
