//! The configurations that a solve has accepted: each solution once.

use core::fmt;

use super::chain::{Closure, Target};
use super::configuration::{Configuration, EXTENT, ISOLATED, Kind, Missed, SAME};
use super::fold::Settled;
use super::merged::Merged;
use super::newton::Candidates;
use crate::lanes::{Column, LANES};

/// Most solutions of a six-joint chain, apart from self-motions.
/// Reference: Primrose, On the input-output equation of the general 7R-mechanism, 1986.
pub(crate) const MOST: usize = 16;

/// Configurations that there is room for: members of a self-motion are many until it is walked
/// along.
pub(super) const ROOM: usize = 2 * MOST;

/// Residual, in roundings, up to which a configuration closes [1]: near a fold the last step is
/// the root of rounding.
const CLOSES: f64 = 20.0;

/// Places where more than two solutions have merged, at most.
const MERGED_PLACES: usize = MOST / 3;

/// How far a candidate may be from closing and still be examined [1].
const EXAMINED: f64 = 0.05;

/// Least singular value, or residual, up to which a candidate that does not close is examined [1].
const NEARLY_SINGULAR: f64 = 1e-3;

/// Candidates that are examined in an attempt, at most.
const MOST_EXAMINED: usize = 24;

/// The configurations of a pose.
#[derive(Clone, Copy)]
pub(crate) struct Accepted {
    all: [Configuration; ROOM],
    count: usize,
    /// Whether what was tried is understood: nothing was left out, and no candidate near a
    /// singularity remained without a decision.
    is_certain: bool,
    /// Where two solutions were looked for that are not: the pose misses their fold.
    missed: [Missed; MOST / 2],
    missed_count: usize,
    /// Where more than two solutions have merged.
    merged: [Merged; MERGED_PLACES],
    merged_count: usize,
    /// How many candidates next to a singularity may still be examined.
    left: usize,
    /// Of the candidates next to a singularity that could not be decided, the one that closes best.
    undecided: Option<Configuration>,
}

impl fmt::Debug for Accepted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "certain: {}, {:#?}", self.is_certain, self.as_slice())
    }
}

impl Closure {
    /// Residual up to which a configuration closes [1].
    pub(crate) fn accepts(&self) -> f64 {
        CLOSES * self.rounding
    }
}

impl Accepted {
    pub(crate) const NONE: Self = Self {
        all: [Configuration::NONE; ROOM],
        count: 0,
        is_certain: true,
        missed: [Missed::NONE; MOST / 2],
        missed_count: 0,
        merged: [Merged::NONE; MERGED_PLACES],
        merged_count: 0,
        left: MOST_EXAMINED,
        undecided: None,
    };

    pub(crate) fn as_slice(&self) -> &[Configuration] {
        &self.all[..self.count]
    }

    /// Remove the configurations; returns them.
    pub(super) fn emptied(&mut self) -> Self {
        let all = *self;
        self.count = 0;
        all
    }

    /// Solutions with their multiplicity: those that polynomials have as roots, if no self-motion
    /// is among them.
    pub(crate) fn root_count(&self) -> usize {
        self.as_slice().iter().map(Configuration::multiplicity).sum()
    }

    /// No configurations yet, and none that are singular will be examined.
    pub(crate) const REGULAR_ONLY: Self = Self { left: 0, ..Self::NONE };

    /// Begin another attempt: what is uncertain about an earlier one no longer counts.
    pub(crate) fn begin(&mut self) {
        (self.is_certain, self.left) = (true, MOST_EXAMINED);
    }

    /// Whether everything that was tried is understood, and the place of each configuration known.
    pub(crate) fn is_certain(&self) -> bool {
        self.is_certain && self.as_slice().iter().all(|one| one.is_placed)
    }

    /// Where two solutions were looked for that the pose misses for certain.
    pub(crate) fn missed(&self) -> &[Missed] {
        &self.missed[..self.missed_count]
    }

    /// Whether they are so many solutions, with their multiplicity, and all of it is certain.
    pub(crate) fn are_certain(&self, roots: usize) -> bool {
        self.is_certain() && !self.has_self_motion() && self.root_count() == roots
    }

    fn merged(&self) -> &[Merged] {
        &self.merged[..self.merged_count]
    }

    /// Whether the chain can move with its ends standing still.
    pub(crate) fn has_self_motion(&self) -> bool {
        self.as_slice().iter().any(Configuration::is_free)
    }

    /// Whether a configuration is next to a singularity.
    pub(crate) fn has_singular(&self) -> bool {
        self.as_slice().iter().any(Configuration::is_singular)
    }

    /// Take what the candidates in these lanes, which have converged, lead to.
    pub(crate) fn take(
        &mut self,
        closure: &Closure,
        target: &Target,
        candidates: &Candidates,
        lanes: usize,
    ) {
        let (mut singular, mut count) = ([Configuration::NONE; LANES], 0);
        for lane in 0..lanes {
            let one = candidates.configuration(lane);
            let is_near = one.residual < EXAMINED;
            if !is_near {
                continue;
            }
            if candidates.is_regular(closure, lane) {
                self.insert(closure, one);
            } else if one.least.min(one.residual) <= NEARLY_SINGULAR {
                singular[count] = one;
                count += 1;
            }
        }
        if count > 0 {
            self.examine(closure, target, &mut singular[..count]);
        }
    }

    /// Take what is at candidates next to singular configurations.
    #[cold]
    #[inline(never)]
    fn examine(&mut self, closure: &Closure, target: &Target, all: &mut [Configuration]) {
        let closes = |one: &Configuration| one.residual <= closure.accepts();
        if !all.iter().all(closes) {
            // The more solutions merge, the slower Newton's method nears them.
            let nearer = closure.converged(target, &columns(all));
            for (lane, one) in all.iter_mut().enumerate().filter(|(_, one)| !closes(one)) {
                one.theta = nearer.theta(lane);
                (one.residual, one.least) = (nearer.residual[lane], nearer.least[lane]);
            }
        }
        let (mut new, mut places, mut count) = ([[0.0; 6]; LANES], [None; LANES], 0);
        for (one, place) in all.iter().zip(&mut places) {
            if !self.explains(&one.theta) {
                *place = Some(count);
                new[count] = one.theta;
                count += 1;
            }
        }
        let mut settled = [Settled::default(); LANES];
        if count > 0 && self.left > 0 {
            settled = closure.settle(target, &new[..count]);
        }
        let settled = places.map(|place| place.map(|place: usize| settled[place]));
        let certain = settled.each_ref().map(|one| one.is_some_and(|one| one.is_certain));
        let mut again = None;
        // What is certain explains some of the rest.
        let lanes = [true, false].map(|is| (0..all.len()).filter(move |lane| certain[*lane] == is));
        for lane in lanes.into_iter().flatten() {
            let candidate = &all[lane];
            let closes = closes(candidate);
            let is_isolated = closes && candidate.least > ISOLATED;
            let mut is_told = true;
            if let Some(settled) = &settled[lane]
                && !self.explains(&candidate.theta)
            {
                is_told = self.left > 0 && self.settle(closure, target, settled);
                self.is_certain &= is_told || is_isolated;
            }
            // It is a solution, whatever could be told about what is next to it.
            if is_isolated || !is_told && closes && candidate.least * SAME > closure.accepts() {
                let again = again.get_or_insert_with(|| closure.converged(target, &columns(all)));
                let one = again.configuration(lane);
                // It may have come to a self-motion.
                self.is_certain &= !is_isolated || one.least > ISOLATED;
                self.insert(closure, one);
            } else if !is_told {
                let closest = self.undecided.get_or_insert(*candidate);
                if candidate.residual < closest.residual {
                    *closest = *candidate;
                }
            }
        }
    }

    /// Take what the candidate that could not be decided leads to, if that closes and nothing else
    /// explains it. More than one might be points of one continuum.
    pub(crate) fn take_undecided(&mut self, closure: &Closure, target: &Target) {
        if self.has_self_motion() {
            return;
        }
        let undecided = self.undecided.take();
        let closing = undecided.and_then(|one| closure.closing(target, &one.theta));
        if let Some(one) = closing.filter(|one| !self.explains(&one.theta)) {
            self.insert(closure, Configuration { is_placed: false, ..one });
        }
    }

    /// Whether what was examined next to a configuration has told everything about it.
    fn explains(&self, theta: &[f64; 6]) -> bool {
        let is = |one: &Configuration| one.is_singular() && one.distance(theta) < EXTENT;
        self.as_slice().iter().any(is) || self.merged().iter().any(|one| one.explains(theta))
    }

    /// Take the solutions next to a configuration. Returns whether these are certain to be all.
    fn settle(&mut self, closure: &Closure, target: &Target, settled: &Settled) -> bool {
        self.left -= 1;
        if let Some(missed) = settled.missed.filter(|_| settled.is_certain)
            && !self.missed().iter().any(|one| one.is(&missed))
            && let Some(place) = self.missed.get_mut(self.missed_count)
        {
            *place = missed;
            self.missed_count += 1;
        }
        if let Some(merged) = settled.merged
            && !self.merged().iter().any(|one| one.explains(&merged.at.theta))
            && let Some(place) = self.merged.get_mut(self.merged_count)
        {
            *place = merged;
            self.merged_count += 1;
        }
        // A self-motion has filled the room.
        let new = settled.all.iter().flatten().count();
        if self.count + new > ROOM && self.has_self_motion() {
            self.thin(closure, target);
        }
        for one in settled.all.into_iter().flatten() {
            // A later attempt finds it explained, and would not ask again.
            let is_placed = one.is_placed && settled.is_certain;
            self.insert(closure, Configuration { is_placed, ..one });
        }
        settled.is_certain
    }

    /// Take a configuration if it is new.
    pub(crate) fn insert(&mut self, closure: &Closure, new: Configuration) {
        let rounding = closure.rounding;
        let new_radius = new.radius(rounding);
        for one in &mut self.all[..self.count] {
            if one.is_within(one.radius(rounding).max(new_radius), &new.theta) {
                // Of two findings, the one that knows more.
                if one.kind == Kind::Regular && new.kind != Kind::Regular {
                    *one = new;
                }
                return;
            }
        }
        match self.all.get_mut(self.count) {
            Some(place) => {
                *place = new;
                self.count += 1;
            }
            None => self.is_certain = false,
        }
    }

    /// Keep no more than there can be. Returns whether others were dropped.
    pub(crate) fn cut(&mut self) -> bool {
        let is_cut = self.count > MOST;
        self.count = self.count.min(MOST);
        is_cut
    }

    /// Put another configuration in the place of one.
    pub(super) fn replace(&mut self, index: usize, with: Configuration) {
        self.all[index] = with;
    }

    /// Remove a configuration.
    pub(crate) fn remove(&mut self, index: usize) {
        self.all.copy_within(index + 1..self.count, index);
        self.count -= 1;
    }
}

/// The angles of configurations, lane beside lane; the first is in the lanes that are left.
fn columns(all: &[Configuration]) -> [Column; 6] {
    core::array::from_fn(|joint| {
        core::array::from_fn(|lane| all.get(lane).unwrap_or(&all[0]).theta[joint])
    })
}
