//! The pairs that are compared at a posture, and how far apart they are.

use super::obstacles::Cell;
use super::placed::Placed;
use crate::body::{Capsule, Separation};

/// A capsule of a link and what it is compared with.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) link: usize,
    pub(super) other: Other,
    /// The places of the link's capsule and of the other's, or of the obstacle.
    places: [usize; 2],
}

/// The other of a pair: a link, or an obstacle by its place.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Other {
    Link(usize),
    Obstacle(usize),
}

impl Cell {
    /// All that is compared.
    pub(super) fn pairs<const N: usize>(
        &self,
        placed: &Placed<'_, N>,
    ) -> impl Iterator<Item = Pair> {
        let outline = placed.outline;
        let of_links = outline.pairs.iter().flat_map(|pair| {
            let [one, other] = pair.map(|group| &outline.groups[group]);
            let both = one.capsules.clone();
            let both = both.flat_map(|a| other.capsules.clone().map(move |b| [a, b]));
            both.map(|places| Pair { link: one.number, other: Other::Link(other.number), places })
        });
        let around = (0..self.obstacles().len()).flat_map(move |at| {
            let groups = outline.groups.iter().filter(move |group| self.compares(at, group.number));
            groups.flat_map(move |group| {
                let (link, other) = (group.number, Other::Obstacle(at));
                group.capsules.clone().map(move |own| Pair { link, other, places: [own, at] })
            })
        });
        of_links.chain(around)
    }

    /// How far a pair is apart, by the capsules at a posture.
    pub(super) fn separation(&self, pair: &Pair, capsules: &[Capsule]) -> Separation {
        let [own, at] = pair.places;
        match pair.other {
            Other::Link(_) => capsules[own].separation(&capsules[at]),
            Other::Obstacle(_) => self.obstacles()[at].1.separation(&capsules[own]),
        }
    }

    /// How deep two are in each other or, with an obstacle, in the margin [m].
    pub(super) fn depth(&self, other: Other, apart: &Separation) -> f64 {
        match other {
            Other::Link(_) => -apart.distance,
            Other::Obstacle(_) => self.margin() - apart.distance,
        }
    }

    /// The pair that is deepest in each other or in the margin; if nothing touches, the pair that is
    /// next to it.
    pub(super) fn deepest<const N: usize>(
        &self,
        placed: &Placed<'_, N>,
        q: &[f64; N],
    ) -> Option<(Pair, Separation)> {
        let capsules = placed.capsules(q);
        let measured = self.pairs(placed).map(|pair| (pair, self.separation(&pair, &capsules)));
        let depth = |(pair, apart): &(Pair, Separation)| self.depth(pair.other, apart);
        measured.max_by(|a, b| depth(a).total_cmp(&depth(b)))
    }
}
