//! Clusters of roots: the zeros of each branch in an interval of joint 6, counted where that is
//! certain.
//!
//! Docs: offset_wrist.md, section 5.

use core::f64::consts::PI;

#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::branch::{Look, SIDES};
use super::geometry::Lengths;
use super::search::Search;
use crate::kinematics::pose::angles::wrap;
use crate::kinematics::structure::closure::Configuration;
use crate::kinematics::structure::trigonometric::Roots;
use crate::lanes::{LANES, run_vectors};

/// Distance of the angles at which the branches are examined in a cluster of roots [rad], and the
/// most of them; four more are always examined.
const SPACING: f64 = 5e-3;
const MOST_ANGLES: usize = 64;

/// Curvature of the shoulder's part of the wrist point up to which the elbow's room has no more
/// than [`MOST_CURVATURE`] [1].
const SMOOTH: f64 = 20.0;

/// How much more a branch may bend between two angles than where it is seen [1].
const MOST_BEND: f64 = 4.0;

/// Differences of changes that show how a branch bends.
const LEAST_BENDS: usize = 2;

/// Rounding of z4 . z5 [1].
const ROUNDING: f64 = 1e-13;

/// Curvature that no branch exceeds where it ends, or is out of reach, if the forearm is as long as
/// the wrist point's distance from axis 6; else as the square of their ratio [1].
const MOST_CURVATURE: f64 = 100.0;

/// Steps that the wrist point would take at least to axis 1, or to axis 2 [1].
const LEAST_STEPS: f64 = 4.0;

/// Most clusters of roots: each holds two.
const MOST_CLUSTERS: usize = 8;

/// How far the angle of a solution may be from the interval of its root [rad].
const ROOT_ERROR: f64 = 1e-6;

/// Most changes of sign that are kept: twice as many as there are solutions.
const MOST_CROSSINGS: usize = 32;

/// Angles at which the branches are examined if the roots are not understood.
const ALL_ANGLES: usize = 360;

/// A cluster of roots.
#[derive(Clone, Copy)]
struct Cluster {
    low: f64,
    high: f64,
    /// Number of solutions in it; `None` if the branches do not show it.
    zeros: Option<usize>,
    /// Most solutions that can be in it.
    most: usize,
}

impl Cluster {
    /// Its angle [rad].
    fn middle(&self) -> f64 {
        0.5 * (self.low + self.high)
    }

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
    /// Those among roots with so many solutions each; none of them is examined yet.
    pub(super) fn of(roots: &Roots, per_root: usize) -> Self {
        let none = Cluster { low: 0.0, high: 0.0, zeros: None, most: 0 };
        let mut clusters = Self { all: [none; MOST_CLUSTERS], count: 0, is_complete: true };
        for root in roots.as_slice().iter().filter(|root| !root.is_simple) {
            let Some(place) = clusters.all.get_mut(clusters.count) else {
                clusters.is_complete = false;
                break;
            };
            let (low, high) = (root.low - ROOT_ERROR, root.high + ROOT_ERROR);
            *place = Cluster { low, high, zeros: None, most: per_root * root.most };
            clusters.count += 1;
        }
        clusters
    }

    /// Whether there are as many solutions as the roots announce: in each cluster the zeros of the
    /// branches, and one for each simple root beside them.
    pub(super) fn agree(&self, solutions: &[Configuration], simple: usize) -> bool {
        let clusters = &self.all[..self.count];
        let mut in_cluster = [0; MOST_CLUSTERS];
        let mut at_simple = 0;
        for one in solutions {
            let holds = |cluster: &Cluster| {
                let Cluster { low, high, .. } = *cluster;
                wrap(one.theta[5] - cluster.middle()).abs() <= 0.5 * (high - low)
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

    /// Examine each of them.
    #[cold]
    pub(super) fn examine(&mut self, search: &mut Search<'_>) {
        for cluster in &mut self.all[..self.count] {
            cluster.zeros = search.zeros_in([cluster.low, cluster.high]);
            search.at_degenerate(cluster.middle());
        }
    }
}

impl Search<'_> {
    /// Examine all angles of joint 6.
    #[cold]
    pub(super) fn everywhere(&mut self) {
        let view = self.view([-PI, PI], ALL_ANGLES);
        self.put_view(&view);
    }

    /// Take what the branches have as zeros in an interval; returns how many, if that is certain.
    fn zeros_in(&mut self, [low, high]: [f64; 2]) -> Option<usize> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few")]
        let count = ((high - low) / SPACING) as usize;
        let few = self.view([low, high], count.min(MOST_ANGLES));
        let view = if few.zeros().is_some() { few } else { self.view([low, high], MOST_ANGLES) };
        self.put_view(&view);
        view.zeros()
    }

    /// View the branches in an interval.
    fn view(&self, [low, high]: [f64; 2], inner: usize) -> View {
        let steps = inner + 4;
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let (step, at) = ((high - low) / steps as f64, |number: usize| number as f64);
        let ends = Ends::of(&self.arm.constants.lengths, step);
        let mut view = View::NONE;
        for first in (0..=steps).step_by(LANES) {
            let angles = core::array::from_fn(|lane| low + step * at(first + lane));
            let (lengths, hand) = (&self.arm.constants.lengths, &self.hand);
            let seen = run_vectors(Look { lengths, hand, angles: &angles, turn: ends.turn });
            let lanes = LANES.min(steps + 1 - first);
            for (side, seen) in seen.iter().enumerate() {
                for lane in 0..lanes {
                    let room = [seen.shoulder[lane], seen.elbow[lane]];
                    let here = Place { off: seen.off[lane], room, is_slow: seen.away[lane] > 0.0 };
                    if let Some(back) = view.scans[side].pass(here, angles[lane], &ends) {
                        view.cross(side, angles[lane] - back * step);
                    }
                }
            }
        }
        view
    }

    /// Candidates where a branch changes its sign, and where it is nearest to that.
    fn put_view(&mut self, view: &View) {
        for (side, angle) in &view.crossings[..view.count] {
            self.put_at(SIDES[*side], *angle);
        }
        for (scan, sides) in view.scans.iter().zip(SIDES) {
            if scan.zeros == 0
                && let Some((angle, _)) = scan.best
            {
                self.put_at(sides, angle);
            }
        }
    }
}

/// The branches in an interval of joint 6.
struct View {
    /// By branch, in the order of [`SIDES`].
    scans: [Scan; 4],
    /// Branches and angles at which they change their sign [rad].
    crossings: [(usize, f64); MOST_CROSSINGS],
    count: usize,
}

impl View {
    const NONE: Self =
        Self { scans: [Scan::NONE; 4], crossings: [(0, 0.0); MOST_CROSSINGS], count: 0 };

    fn cross(&mut self, side: usize, angle: f64) {
        match self.crossings.get_mut(self.count) {
            Some(place) => {
                *place = (side, angle);
                self.count += 1;
            }
            None => self.scans[side].is_clear = false,
        }
    }

    /// The number of zeros, if it is certain.
    fn zeros(&self) -> Option<usize> {
        self.scans.iter().map(|scan| scan.is_certain().then_some(scan.zeros)).sum()
    }
}

/// A branch at an angle of joint 6.
#[derive(Clone, Copy)]
struct Place {
    /// z4 . z5 - cos alpha_4 [1]; infinite out of reach.
    off: f64,
    /// How far shoulder and elbow are inside their reach [1].
    room: [f64; 2],
    /// Whether shoulder and forearm turn little in a step.
    is_slow: bool,
}

impl Place {
    fn is_reached(self) -> bool {
        self.off < f64::INFINITY
    }
}

/// A branch along joint 6.
#[derive(Clone, Copy)]
struct Scan {
    /// Changes of sign.
    zeros: usize,
    /// Whether the branch has no zero where it ends between two angles.
    is_clear: bool,
    /// Of the steps between two angles, the least that speaks for the zeros which the signs show: a
    /// change, or a distance from zero.
    least: f64,
    /// The largest difference of two changes in a row, and how many there are.
    bend: f64,
    bends: usize,
    before: Option<Place>,
    change: Option<f64>,
    /// The angle where the branch is nearest to a solution, and how near.
    best: Option<(f64, f64)>,
}

impl Scan {
    const NONE: Self = Self {
        zeros: 0,
        is_clear: true,
        least: f64::INFINITY,
        bend: 0.0,
        bends: 0,
        before: None,
        change: None,
        best: None,
    };

    /// Whether the branch has no other zeros than its changes of sign (eq. 133).
    fn is_certain(&self) -> bool {
        let is_seen = self.best.is_none() || self.bends >= LEAST_BENDS;
        self.is_clear && is_seen && self.least > MOST_BEND * self.bend + ROUNDING
    }

    /// Pass an angle. Returns how many steps ago the branch had a zero, if it changed its sign.
    fn pass(&mut self, here: Place, angle: f64, ends: &Ends) -> Option<f64> {
        if here.is_reached() && self.best.is_none_or(|(_, best)| here.off.abs() < best) {
            self.best = Some((angle, here.off.abs()));
        }
        self.is_clear &= here.is_slow || !here.is_reached();
        let before = self.before.replace(here)?;
        match [before, here].map(Place::is_reached) {
            [true, true] => return self.step(before.off, here.off),
            [true, false] => self.is_clear &= before.off.abs() > ends.end,
            [false, true] => self.is_clear &= here.off.abs() > ends.end,
            [false, false] => self.is_clear &= ends.are_out_of_reach(before.room, here.room),
        }
        self.change = None;
        None
    }

    /// A step between two angles with a branch.
    fn step(&mut self, a: f64, b: f64) -> Option<f64> {
        let (change, has_zero) = (b - a, (a < 0.0) != (b < 0.0));
        let away = if has_zero { 0.0 } else { a.abs().min(b.abs()) };
        self.least = self.least.min(away.max(change.abs()));
        if let Some(before) = self.change.replace(change) {
            self.bend = self.bend.max((change - before).abs());
            self.bends += 1;
        }
        self.zeros += usize::from(has_zero);
        has_zero.then(|| b / change)
    }
}

/// What a branch may do between two angles where it ends.
struct Ends {
    /// Change of the room of shoulder or elbow by its curvature [1].
    bend: f64,
    /// Change of what has a root at the end [1].
    end: f64,
    /// Squares of the lateral offset and of the wrist point's distance from axis 6 [1].
    squares: [f64; 2],
    /// The square of the angle of a few steps [rad^2]: a shoulder or forearm that could turn round
    /// within it may turn too much in one.
    turn: f64,
}

impl Ends {
    fn of(lengths: &Lengths, step: f64) -> Self {
        let Lengths { upper, forearm, b, circle, .. } = *lengths;
        let unit = upper.abs() + forearm;
        let squares = [b, circle].map(|length| (length / unit) * (length / unit));
        let curvature = MOST_CURVATURE * (circle / forearm).powi(2).max(1.0);
        Self {
            bend: curvature * step * step,
            end: curvature * step.sqrt(),
            squares,
            turn: (LEAST_STEPS * step) * (LEAST_STEPS * step),
        }
    }

    /// Whether there is no branch between two angles at which there is none. The room of the elbow
    /// depends on the square root of that of the shoulder, and bends as it does.
    fn are_out_of_reach(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let [shoulder, elbow] = [a[0].max(b[0]), a[1].max(b[1])];
        let (least, [lateral, circle]) = (a[0].min(b[0]).max(0.0), self.squares);
        let is_smooth = circle * (least + lateral) < SMOOTH * least * least.sqrt();
        shoulder < -self.bend || elbow < -if is_smooth { self.bend } else { self.end }
    }
}
