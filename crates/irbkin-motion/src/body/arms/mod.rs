//! Bodies of the arms of the catalog: capsules that contain the public collision meshes, link by
//! link. Every triangle of a mesh is inside one capsule, or its pieces are, after halving it; so no
//! point of the mesh is outside. Cables, hoses and tools are on no mesh. Most meshes are the convex
//! hulls of the links.
//!
//! In `arms.txt` an arm is a paragraph of lines, each with a keyword:
//!
//! - names: the arms with these capsules: their meshes are equal or, if one is not known, their
//!   tables;
//! - source: repository, commit, file and license of the meshes;
//! - excess: how far 95 % of the surface of each link's capsules are outside its mesh at most [mm];
//! - apart: pairs of links that are kept apart. Neighbors touch by construction; the meshes of
//!   others never did, or always, in 100,000 samples inside the limits;
//! - link: the capsules of a link, counted from the base: both ends of the axis in the link's frame,
//!   then the radius, in tenths of a millimeter;
//! - part: a capsule of a cylinder, piston or rod beside a link, wherever it may be;
//! - note: what else is known.

mod hulls;

use alloc::borrow::Cow;

use super::links::{Body, LinkCapsule};
use super::shape::Capsule;
use crate::prelude::*;

const ARMS: &str = include_str!("arms.txt");

/// Meters of a tenth of a millimeter [m].
const UNIT: f64 = 1e-4;

/// The body of an arm of the catalog, if there is a free public mesh of it.
pub(crate) fn body_of(name: &str) -> Option<Body> {
    ARMS.split("\n\n").find_map(|lines| body(lines, name))
}

/// The body of the lines of an arm, if it has a name.
fn body(lines: &'static str, name: &str) -> Option<Body> {
    let (names, lines) = lines.strip_prefix("names ")?.split_once('\n')?;
    let names: Vec<&'static str> = names.split(", ").collect();
    let mut body = Body {
        arm: Some(*names.iter().find(|own| **own == name)?),
        links: Vec::new(),
        parts: Vec::new(),
        hulls: hulls::of(&names),
        pairs: Vec::new(),
        source: Cow::Borrowed(""),
        is_approximate: false,
        excess: Vec::new(),
    };
    for line in lines.lines() {
        let (keyword, rest) = line.split_once(' ')?;
        match keyword {
            "source" => body.source = Cow::Borrowed(rest),
            "excess" => body.excess = numbers(rest).map(|excess| excess * 1e-3).collect(),
            "apart" => body.pairs = rest.split(' ').filter_map(pair).collect(),
            "link" => body.links.extend(capsules(rest)),
            "part" => body.parts.extend(capsules(rest)),
            _ => {}
        }
    }
    Some(body)
}

fn numbers(text: &str) -> impl Iterator<Item = f64> {
    text.split(' ').filter_map(|number| number.parse().ok())
}

fn pair(text: &str) -> Option<[usize; 2]> {
    let (one, other) = text.split_once('-')?;
    Some([one.parse().ok()?, other.parse().ok()?])
}

/// The capsules of a link, behind its number.
fn capsules(text: &str) -> impl Iterator<Item = LinkCapsule> {
    let (link, capsules) = text.split_once(' ').unwrap_or_default();
    let link = link.parse().unwrap_or_default();
    capsules.split(", ").map(move |capsule| {
        let mut values = numbers(capsule).map(|value| value * UNIT);
        let [ax, ay, az, bx, by, bz, radius] =
            core::array::from_fn(|_| values.next().unwrap_or_default());
        LinkCapsule { link, capsule: Capsule::known([ax, ay, az], [bx, by, bz], radius) }
    })
}
