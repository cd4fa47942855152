//! What is compared with what at a posture, and how far apart it is.

use alloc::string::String;

use super::placed::Placed;
use crate::body::{Separation, Shape};

/// A link and something else, with their nearest points.
#[derive(Clone, Copy)]
pub(super) struct Pair {
    pub(super) link: usize,
    pub(super) other: Other,
    pub(super) apart: Separation,
}

/// What a link is compared with: a link, or an obstacle by its place.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Other {
    Link(usize),
    Obstacle(usize),
}

/// The links and obstacles that are compared, with their nearest points.
pub(super) fn pairs<const N: usize>(
    placed: &Placed<'_, N>,
    obstacles: &[(String, Shape)],
    q: &[f64; N],
) -> impl Iterator<Item = Pair> {
    let (outline, capsules) = (&placed.outline, placed.capsules(q));
    let of_links = outline.pairs.iter().flat_map(|[one, other]| {
        let [one, other] = [&outline.groups[*one], &outline.groups[*other]];
        let both = one.capsules.clone().flat_map(|a| other.capsules.clone().map(move |b| [a, b]));
        both.map(|pair| (one.link, Other::Link(other.link), pair))
    });
    let moving = outline.groups.iter().filter(|group| group.link > 0);
    let around = moving.flat_map(move |group| {
        let own = group.capsules.clone();
        own.flat_map(move |a| {
            (0..obstacles.len()).map(move |at| (group.link, Other::Obstacle(at), [a, at]))
        })
    });
    of_links.chain(around).map(move |(link, other, [own, at])| {
        let apart = match other {
            Other::Link(_) => capsules[own].separation(&capsules[at]),
            Other::Obstacle(_) => obstacles[at].1.separation(&capsules[own]),
        };
        Pair { link, other, apart }
    })
}
