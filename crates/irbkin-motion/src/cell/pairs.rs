//! The pairs that are compared at a posture, and how far apart they are.

use alloc::vec::Vec;

use super::checker::{Checker, Standing};
use crate::body::Separation;

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
    /// All that is compared.
    pub(super) fn pairs(&self) -> impl Iterator<Item = Pair> {
        let outline = self.outline;
        let of_links = outline.pairs.iter().map(|places| {
            let [link, other] = places.map(|group| outline.groups[group].number);
            Pair { link, other: Other::Link(other), places: *places }
        });
        let around = (0..self.cell.obstacles().len()).flat_map(move |at| {
            let groups = outline.groups.iter().enumerate();
            let groups = groups.filter(move |(_, group)| self.cell.compares(at, group.number));
            groups.map(move |(place, group)| {
                let (link, other) = (group.number, Other::Obstacle(at));
                Pair { link, other, places: [place, at] }
            })
        });
        of_links.chain(around)
    }

    /// How far the capsules of a pair are apart.
    fn coarse(&self, pair: &Pair, at: &Standing<'_, N>) -> Separation {
        let [own, other] = pair.places;
        let each = at.capsules_of(own).iter().flat_map(|one| {
            let (links, obstacle) = match pair.other {
                Other::Link(_) => (at.capsules_of(other), None),
                Other::Obstacle(at) => (&[][..], Some(&self.cell.obstacles()[at].1)),
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
            Other::Obstacle(at) => own.separation_of(&pose, &self.cell.obstacles()[at].1),
        };
        let touch = apart.points[0] == apart.points[1];
        if touch || apart.distance < coarse.distance { coarse } else { apart }
    }

    /// How far a pair is apart.
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

    /// Less than the distance of a pair [m], by the balls around the two; nothing if these touch.
    fn bound(&self, pair: &Pair, at: &Standing<'_, N>) -> f64 {
        let (center, radius) = at.balls[pair.places[0]];
        let apart = match pair.other {
            Other::Link(_) => Some(at.balls[pair.places[1]]),
            Other::Obstacle(at) => self.cell.obstacles()[at].1.ball(),
        };
        let apart = apart.map_or(0.0, |(other, more)| (other - center).norm() - radius - more);
        if apart > BELOW { apart - BELOW } else { f64::NEG_INFINITY }
    }

    /// The pair of which some measure of its distance is least, by bounds first. Of several that
    /// are, the one whose capsules are nearest.
    pub(super) fn least(
        &self,
        q: &[f64; N],
        measure: impl Fn(Other, &Separation) -> f64,
    ) -> Option<(Pair, Separation)> {
        let at = self.at(q);
        let bounded = self.pairs().enumerate().map(|(place, pair)| {
            let apart = Separation { distance: self.bound(&pair, &at), ..Separation::NOTHING };
            (measure(pair.other, &apart), place, pair)
        });
        let mut bounded: Vec<_> = bounded.collect();
        bounded.sort_unstable_by(|(one, ..), (two, ..)| one.total_cmp(two));
        let (mut least, mut best) = ((f64::INFINITY, f64::INFINITY, usize::MAX), None);
        for (bound, place, pair) in bounded {
            if bound > least.0 {
                break;
            }
            let apart = self.coarse(&pair, &at);
            let coarse = measure(pair.other, &apart);
            if coarse > least.0 {
                continue;
            }
            let apart = self.fine(&pair, &at, apart);
            let own = (measure(pair.other, &apart), coarse, place);
            if own < least {
                (least, best) = (own, Some((pair, apart)));
            }
        }
        best
    }

    /// The pair that is deepest in each other or in the margin; if nothing touches, the pair that is
    /// next to it.
    pub(super) fn deepest(&self, q: &[f64; N]) -> Option<(Pair, Separation)> {
        self.least(q, |other, apart| -self.depth(other, apart))
    }
}
