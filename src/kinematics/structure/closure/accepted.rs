//! The configurations that a solve has accepted: each solution once.

use core::fmt;

use arrayvec::ArrayVec;

use super::chain::{Closure, Target};
use super::configuration::{Configuration, ISOLATED};
use super::newton::Candidates;
use super::self_motion::SelfMotion;
use crate::kinematics::pose::angles::wrap;
use crate::lanes::{Column, LANES};

/// Most solutions of a six-joint chain, apart from self-motions.
/// Reference: Primrose, On the input-output equation of the general 7R-mechanism, 1986.
pub(crate) const MOST: usize = 16;

/// Configurations that there is room for: points of one self-motion are many until it is followed.
const ROOM: usize = 2 * MOST;

/// Residual and least singular value up to which a candidate that is not regular may become a
/// singular solution [1].
const NEARLY: f64 = 1e-3;

/// Least singular value up to which a solution is followed to others [1]: those that are left of a
/// self-motion are farther apart if it is larger, and have roots of their own.
const WEAK: f64 = 1e-3;

/// How near a solution is that was passed on the way [rad].
const PASSED: f64 = 1e-3;

/// How far from a configuration its joints are that Newton's method leads back, as a part of the
/// least singular value [rad]: the theorem has 1/6 in all joints together.
const ATTRACTS: f64 = 0.03;

/// Candidates next to singularities that are examined for a pose, at most.
const MOST_EXAMINED: usize = 48;

/// The configurations of a pose.
pub(crate) struct Accepted {
    all: ArrayVec<Configuration, ROOM>,
    /// Whether there was room for all.
    is_whole: bool,
    /// How many candidates next to a singularity may still be examined.
    left: usize,
    /// Of the candidates next to a singularity that do not close, the one that does best.
    closest: Option<Configuration>,
}

impl fmt::Debug for Accepted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "whole: {}, {:#?}", self.is_whole, self.all)
    }
}

impl Accepted {
    /// Configurations that there is room for: points of one self-motion are many until it is
    /// followed.
    pub(crate) const ROOM: usize = ROOM;

    pub(crate) fn new() -> Self {
        Self { all: ArrayVec::new(), is_whole: true, left: MOST_EXAMINED, closest: None }
    }

    /// Return an empty set that takes regular solutions alone.
    pub(crate) fn regular_only() -> Self {
        Self { left: 0, ..Self::new() }
    }

    pub(crate) fn as_slice(&self) -> &[Configuration] {
        &self.all
    }

    /// Whether the chain can move with its ends at rest.
    pub(crate) fn has_self_motion(&self) -> bool {
        self.all.iter().any(|one| one.moving.is_some())
    }

    /// Whether each configuration is a regular solution, and none was left out.
    pub(crate) fn are_regular(&self) -> bool {
        self.is_whole && !self.all.iter().any(Configuration::is_singular)
    }

    /// Whether each configuration next to a singularity is a fold to rounding.
    pub(crate) fn are_folds(&self) -> bool {
        self.all.iter().all(|one| one.least > WEAK || one.is_fold())
    }

    /// Whether Newton's method leads from the angles in a lane [rad] to a configuration that is
    /// known: by the theorem of Newton and Kantorovich (eq. 98b).
    pub(crate) fn attracts(&self, theta: &[Column; 6], lane: usize) -> bool {
        self.all.iter().any(|one| {
            let near = ATTRACTS * one.least;
            (0..6).all(|joint| wrap(theta[joint][lane] - one.theta[joint]).abs() <= near)
        })
    }

    /// Take the candidates in these lanes, which have converged.
    pub(crate) fn take(
        &mut self,
        closure: &Closure,
        target: &Target,
        candidates: &Candidates,
        lanes: usize,
    ) {
        let mut singular = ArrayVec::<Configuration, LANES>::new();
        for lane in 0..lanes {
            let one = candidates.configuration(lane);
            if candidates.is_regular(closure, lane) {
                self.insert(closure, target, one);
            } else if one.residual.max(one.least) <= NEARLY || one.residual <= closure.accepts() {
                singular.push(one);
            }
        }
        if !singular.is_empty() && self.left > 0 {
            self.examine(closure, target, &singular);
        }
    }

    /// Take candidates next to singular configurations, as far as they close.
    #[cold]
    #[inline(never)]
    fn examine(&mut self, closure: &Closure, target: &Target, all: &[Configuration]) {
        // Newton's method halves the distance from a fold in a step, or less.
        let nearer = closure.converged(target, &columns(all));
        for (lane, before) in all.iter().enumerate() {
            let after = nearer.configuration(lane);
            let one = if after.residual <= before.residual { after } else { *before };
            if one.residual > closure.accepts() {
                if self.closest.is_none_or(|closest| one.residual < closest.residual) {
                    self.closest = Some(one);
                }
                continue;
            }
            if self.left == 0 {
                continue;
            }
            self.left -= 1;
            let is_known = |kept: &Configuration| closure.are_one(target, kept, &one);
            if self.all.iter().any(is_known) {
                continue;
            }
            let may_move = one.least <= ISOLATED;
            let motion = may_move.then(|| SelfMotion::through(closure, target, &one.theta));
            let moving = motion.flatten().map(|_| [true; 6]);
            self.insert(closure, target, Configuration { moving, ..one });
        }
    }

    /// Take what the closest candidate leads to without the directions that are singular, if nothing
    /// else has closed (eq. 104b).
    pub(crate) fn take_closest(&mut self, closure: &Closure, target: &Target) {
        if self.all.is_empty()
            && let Some(one) = self.closest
        {
            self.all.extend(closure.closing(target, &one.theta));
        }
    }

    /// Take a configuration if it is new.
    pub(crate) fn insert(&mut self, closure: &Closure, target: &Target, new: Configuration) {
        let same = |one: &Configuration| closure.are_one(target, one, &new);
        if !self.all.iter().any(same) {
            self.is_whole &= self.all.try_push(new).is_ok();
        }
    }

    /// Keep no more than there can be. Returns whether others were dropped.
    pub(crate) fn cut(&mut self) -> bool {
        let is_cut = self.all.len() > MOST;
        self.all.truncate(MOST);
        is_cut
    }

    /// Follow what is left of self-motions, on which there are several solutions next to a singularity
    /// (eq. 104d), and take these.
    pub(crate) fn follow(&mut self, closure: &Closure, target: &Target) {
        let mut found = ArrayVec::<Configuration, ROOM>::new();
        let is_one = |one: &&Configuration| one.moving.is_none() && one.least <= WEAK;
        let all: ArrayVec<Configuration, ROOM> = self.all.iter().filter(is_one).copied().collect();
        for one in &all {
            // Others are on the way from the first.
            let is_passed = |other: &Configuration| other.distance(&one.theta) < PASSED;
            if found.iter().any(is_passed) {
                continue;
            }
            if let Some(curve) = SelfMotion::near(closure, target, &one.theta) {
                curve.solutions(&mut |theta| {
                    let _ = found.try_push(Configuration { theta, ..*one });
                });
            }
        }
        for block in found.chunks(LANES) {
            let candidates = closure.converged(target, &columns(block));
            self.take(closure, target, &candidates, block.len());
        }
    }

    /// Keep one configuration of each self-motion (eq. 103): where its first joint that moves has
    /// its angle of `near`, if the self-motion passes there.
    pub(crate) fn represent(&mut self, closure: &Closure, target: &Target, near: &[f64; 6]) {
        let mut waiting: ArrayVec<Configuration, ROOM> =
            self.all.iter().copied().filter(|one| one.moving.is_some()).collect();
        self.all.retain(|one| one.moving.is_none());
        while let Some(one) = waiting.pop_at(0) {
            let Some(motion) = SelfMotion::through(closure, target, &one.theta) else {
                self.all.push(Configuration { moving: None, ..one });
                continue;
            };
            let way = motion.followed(near, &mut |ends| {
                let is_met =
                    |other: &Configuration| other.is_singular() && motion.passes(ends, other);
                waiting.retain(|other| !is_met(other));
                self.all.retain(|other| !is_met(other));
            });
            let theta = way.member.unwrap_or(one.theta);
            let residual = closure.residual(target, &theta);
            self.all.push(Configuration { theta, residual, moving: Some(way.moving()), ..one });
        }
    }
}

/// The angles of configurations, lane beside lane; the first is in the lanes that are left.
fn columns(all: &[Configuration]) -> [Column; 6] {
    core::array::from_fn(|joint| {
        core::array::from_fn(|lane| all.get(lane).unwrap_or(&all[0]).theta[joint])
    })
}
