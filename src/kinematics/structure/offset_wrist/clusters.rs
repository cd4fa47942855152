//! Clusters of roots: the zeros of each branch in an interval of joint 6, counted where that is
//! certain.
//!
//! Docs: offset_wrist.md, section 5.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::branch::{Look, SIDES};
use super::search::Search;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::Configuration;
use crate::kinematics::structure::trigonometric::Root;
use crate::lanes::{LANES, run_vectors};

/// Distance of the angles at which the branches are examined in a cluster of roots [rad], and the
/// most of them; four more are always examined.
const SPACING: f64 = 5e-3;
const MOST_ANGLES: usize = 64;

/// Curvature of z4 . z5 along joint 6 that no branch exceeds in a cluster [1].
const MOST_CURVATURE: f64 = 100.0;

/// Most clusters of roots: each holds two.
const MOST_CLUSTERS: usize = 8;

/// How far the angle of a solution may be from the interval of its root [rad].
const ROOT_ERROR: f64 = 1e-6;

/// Angles at which the branches are examined if the roots are not understood.
const ALL_ANGLES: usize = 360;

/// A cluster of roots.
#[derive(Clone, Copy, Default)]
struct Cluster {
    low: f64,
    high: f64,
    /// Number of solutions in it; `None` if the branches do not show it.
    zeros: Option<usize>,
    /// Most solutions that can be in it.
    most: usize,
}

impl Cluster {
    /// Whether so many solutions are all that it has.
    fn holds(&self, count: usize) -> bool {
        self.zeros == Some(count) || self.most == count
    }
}

/// The clusters of a pose.
pub(super) struct Clusters {
    all: [Cluster; MOST_CLUSTERS],
    count: usize,
    is_complete: bool,
}

impl Clusters {
    pub(super) const NONE: Self = Self {
        all: [Cluster { low: 0.0, high: 0.0, zeros: None, most: 0 }; MOST_CLUSTERS],
        count: 0,
        is_complete: true,
    };

    /// Whether there are as many solutions as the roots announce: in each cluster the zeros of the
    /// branches, and one for each simple root beside them.
    pub(super) fn agree(&self, solutions: &[Configuration], simple: usize) -> bool {
        let clusters = &self.all[..self.count];
        let mut in_cluster = [0; MOST_CLUSTERS];
        let mut at_simple = 0;
        for one in solutions {
            let holds = |cluster: &Cluster| {
                let Cluster { low, high, .. } = *cluster;
                wrap(one.theta[5] - 0.5 * (low + high)).abs() <= 0.5 * (high - low)
            };
            match clusters.iter().position(holds) {
                Some(index) => in_cluster[index] += one.multiplicity(),
                None => at_simple += one.multiplicity(),
            }
        }
        self.is_complete
            && at_simple == simple
            && clusters.iter().zip(in_cluster).all(|(cluster, count)| cluster.holds(count))
    }

    /// Examine a cluster of roots.
    #[cold]
    pub(super) fn examine(&mut self, root: &Root, search: &mut Search<'_>) {
        let (low, high) = (root.low - ROOT_ERROR, root.high + ROOT_ERROR);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few")]
        let count = ((high - low) / SPACING) as usize;
        let zeros = search.zeros([low, high], count.min(MOST_ANGLES));
        match self.all.get_mut(self.count) {
            Some(place) => {
                let per_root = if search.arm.lengths.is_square { 2 } else { 1 };
                *place = Cluster { low, high, zeros, most: per_root * root.most };
                self.count += 1;
            }
            None => self.is_complete = false,
        }
        search.at_degenerate(root.angle());
    }
}

impl Search<'_> {
    /// Examine all angles of joint 6.
    #[cold]
    pub(super) fn everywhere(&mut self) {
        self.zeros([-PI, PI], ALL_ANGLES);
    }

    /// Candidates where a branch changes its sign in an interval, and where it may touch zero.
    /// Returns the number of zeros, if it is certain.
    fn zeros(&mut self, [low, high]: [f64; 2], inner: usize) -> Option<usize> {
        let steps = inner + 4;
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let (step, at) = ((high - low) / steps as f64, |number: usize| number as f64);
        let bounds = Bounds::of(step);
        let mut scans = [Scan { zeros: 0, is_certain: true, before: None, best: None }; 4];
        for first in (0..=steps).step_by(LANES) {
            let angles = core::array::from_fn(|lane| low + step * at(first + lane));
            let (lengths, hand) = (&self.arm.lengths, &self.hand);
            let seen = run_vectors(Look { lengths, hand, angles: &angles });
            let lanes = LANES.min(steps + 1 - first);
            for (scan, (seen, sides)) in scans.iter_mut().zip(seen.iter().zip(SIDES)) {
                for lane in 0..lanes {
                    let here = View { off: seen.off[lane], room: seen.room[lane] };
                    if let Some(back) = scan.pass(here, angles[lane], &bounds) {
                        self.put_at(sides, angles[lane] - back * step);
                    }
                }
            }
        }
        for (scan, sides) in scans.iter().zip(SIDES) {
            if !scan.is_certain
                && scan.zeros == 0
                && let Some((angle, _)) = scan.best
            {
                self.put_at(sides, angle);
            }
        }
        scans.iter().map(|scan| scan.is_certain.then_some(scan.zeros)).sum()
    }
}

/// A branch at an angle of joint 6.
#[derive(Clone, Copy)]
struct View {
    /// z4 . z5 - cos alpha_4 [1]; infinite out of reach.
    off: f64,
    /// Out of reach: by how much [1], negative.
    room: f64,
}

impl View {
    fn is_reached(self) -> bool {
        self.off < f64::INFINITY
    }
}

/// A branch along joint 6.
#[derive(Clone, Copy)]
struct Scan {
    /// Changes of sign.
    zeros: usize,
    /// Whether these are all zeros.
    is_certain: bool,
    before: Option<View>,
    /// The angle where the branch is nearest to a solution, and how near.
    best: Option<(f64, f64)>,
}

impl Scan {
    /// Pass an angle. Returns how many steps ago the branch had a zero, if it changed its sign.
    fn pass(&mut self, here: View, angle: f64, bounds: &Bounds) -> Option<f64> {
        if here.is_reached() && self.best.is_none_or(|(_, best)| here.off.abs() < best) {
            self.best = Some((angle, here.off.abs()));
        }
        let before = self.before.replace(here)?;
        self.is_certain &= bounds.are_clear(before, here);
        let is_zero =
            before.is_reached() && here.is_reached() && (before.off < 0.0) != (here.off < 0.0);
        self.zeros += usize::from(is_zero);
        is_zero.then(|| here.off / (here.off - before.off))
    }
}

/// What a branch may do between two angles.
struct Bounds {
    /// Its change from which on it is monotone, and its size from which on it has no zero.
    bend: f64,
    /// Its size from which on it has no zero before it ends.
    end: f64,
}

impl Bounds {
    fn of(step: f64) -> Self {
        Self { bend: MOST_CURVATURE * step * step, end: MOST_CURVATURE * step.sqrt() }
    }

    /// Whether the zeros between two angles are those that the values there show (eq. 133).
    fn are_clear(&self, one: View, other: View) -> bool {
        match [one, other].map(View::is_reached) {
            [true, true] => {
                let (a, b) = (one.off, other.off);
                let has_none = (a < 0.0) == (b < 0.0) && a.abs().min(b.abs()) > self.bend;
                has_none || (b - a).abs() > self.bend
            }
            [true, false] => one.off.abs() > self.end,
            [false, true] => other.off.abs() > self.end,
            [false, false] => one.room.max(other.room) < -self.bend,
        }
    }
}
