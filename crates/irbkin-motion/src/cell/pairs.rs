//! The pairs that are compared at a posture, and how far apart they are.

use super::checker::{Checker, Standing};
use crate::body::{Bounds, Separation};
use crate::prelude::*;

/// By how much distances are below the true ones at most, and more [m].
const BELOW: f64 = 1e-6;

/// A link and what it is compared with.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) link: usize,
    pub(super) other: Other,
    /// The places of the link's group and of the other's, or of the obstacle.
    places: [usize; 2],
}

/// What a link is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Other {
    /// A link of the arm, by its number.
    Link(usize),
    /// An obstacle, by its place in the cell.
    Obstacle(usize),
}

impl<const N: usize> Checker<'_, N> {
    fn of_links(&self) -> impl Iterator<Item = Pair> {
        self.outline.pairs.iter().map(|places| {
            let [link, other] = places.map(|group| self.outline.groups[group].number);
            Pair { link, other: Other::Link(other), places: *places }
        })
    }

    /// A group and a part of an obstacle, if they are compared.
    fn of_part(&self, group: usize, part: usize) -> Option<Pair> {
        let (link, other) = (self.outline.groups[group].number, self.cell.obstacle_of(part));
        let pair = Pair { link, other: Other::Obstacle(other), places: [group, part] };
        self.cell.compares(part, link).then_some(pair)
    }

    /// All pairs of a pair's link and other.
    pub(super) fn like(&self, one: &Pair) -> Vec<Pair> {
        let of_parts = (0..self.cell.part_count())
            .filter(|part| one.other == Other::Obstacle(self.cell.obstacle_of(*part)))
            .flat_map(|part| (0..self.outline.groups.len()).map(move |group| [group, part]))
            .filter_map(|[group, part]| self.of_part(group, part));
        let all = self.of_links().chain(of_parts);
        all.filter(|pair| pair.link == one.link && pair.other == one.other).collect()
    }

    /// How far the capsules of a pair are apart.
    fn coarse(&self, pair: &Pair, at: &Standing<'_, N>) -> Separation {
        let [own, other] = pair.places;
        let each = at.capsules_of(own).iter().flat_map(|one| {
            let (links, obstacle) = match pair.other {
                Other::Link(_) => (at.capsules_of(other), None),
                Other::Obstacle(_) => (&[][..], Some(self.cell.part(other))),
            };
            let links = links.iter().map(|two| one.separation(two));
            links.chain(obstacle.map(|shape| shape.separation(one)))
        });
        let least = each.min_by(|a, b| a.distance.total_cmp(&b.distance));
        least.unwrap_or(Separation::NOTHING)
    }

    /// How far a pair is apart, whose capsules are so far: as far as their hulls or the capsules, if
    /// either are farther. Where hulls touch without their radii, as far as the capsules are in each
    /// other.
    fn fine(&self, pair: &Pair, at: &Standing<'_, N>, coarse: Separation) -> Separation {
        let groups = &self.outline.groups;
        let (own, pose) = (&groups[pair.places[0]], at.pose(&groups[pair.places[0]]));
        let apart = match pair.other {
            Other::Link(_) => {
                let other = &groups[pair.places[1]];
                if !own.has_hulls && !other.has_hulls {
                    return coarse;
                }
                own.separation(&pose, (other, &at.pose(other)))
            }
            Other::Obstacle(_) if !own.has_hulls => return coarse,
            Other::Obstacle(_) => own.separation_of(&pose, self.cell.part(pair.places[1])),
        };
        let touch = apart.points[0] == apart.points[1];
        if touch || apart.distance < coarse.distance { coarse } else { apart }
    }

    pub(super) fn separation(&self, pair: &Pair, at: &Standing<'_, N>) -> Separation {
        self.fine(pair, at, self.coarse(pair, at))
    }

    /// How deep two are in each other or, with an obstacle, in the margin [m].
    pub(super) fn depth(&self, other: Other, apart: &Separation) -> f64 {
        match other {
            Other::Link(_) => -apart.distance,
            Other::Obstacle(_) => self.cell.margin() - apart.distance,
        }
    }

    /// The pair that is nearest, where an obstacle counts as nearer than it is by a margin [m]: by
    /// bounds first. Of several that are, the one whose capsules are nearest.
    pub(super) fn nearest_pair(&self, q: &[f64; N], margin: f64) -> Option<(Pair, Separation)> {
        let at = self.at(q);
        let mut best = Best { least: (f64::INFINITY, f64::INFINITY, [usize::MAX; 2]), found: None };
        let bounded = self.of_links().map(|pair| {
            let [one, other] = pair.places.map(|group| at.balls[group]);
            (below((one.0 - other.0).norm() - one.1 - other.1), pair)
        });
        let mut bounded: Vec<_> = bounded.collect();
        bounded.sort_by(|(one, _), (two, _)| one.total_cmp(two));
        for (bound, pair) in bounded {
            if bound <= best.least.0 {
                self.take(&mut best, pair, &at, 0.0);
            }
        }
        for (group, (center, radius)) in at.balls.iter().enumerate() {
            if self.outline.groups[group].number == 0 {
                continue;
            }
            let mut take = |part: usize| {
                if let Some(pair) = self.of_part(group, part) {
                    self.take(&mut best, pair, &at, margin);
                }
                // Others that are as near are looked at, too.
                best.least.0.next_up()
            };
            let most = self.cell.endless().fold(f64::INFINITY, |_, part| take(part));
            let bound = |bounds: &Bounds| below(bounds.distance(center) - radius) - margin;
            self.cell.tree().search(most, bound, take);
        }
        best.found
    }

    /// Take a pair if it is nearer than the best.
    fn take(&self, best: &mut Best, pair: Pair, at: &Standing<'_, N>, margin: f64) {
        let apart = self.coarse(&pair, at);
        let coarse = apart.distance - margin;
        if coarse > best.least.0 {
            return;
        }
        let apart = self.fine(&pair, at, apart);
        let [group, other] = pair.places;
        let own = (apart.distance - margin, coarse, [other, group]);
        if own < best.least {
            *best = Best { least: own, found: Some((pair, apart)) };
        }
    }

    /// The pair that is deepest in each other or in the margin; if nothing touches, the pair that is
    /// next to it.
    pub(super) fn deepest(&self, q: &[f64; N]) -> Option<(Pair, Separation)> {
        self.nearest_pair(q, self.cell.margin())
    }
}

/// The nearest pair so far: its distance, that of its capsules, and its place.
struct Best {
    least: (f64, f64, [usize; 2]),
    found: Option<(Pair, Separation)>,
}

/// Less than a distance of balls [m]; nothing if they touch.
fn below(distance: f64) -> f64 {
    if distance > BELOW { distance - BELOW } else { f64::NEG_INFINITY }
}
