//! Bodies of the arms of the catalog: capsules that contain the public collision meshes, link by
//! link. Every triangle of a mesh is inside one capsule, or its pieces are, after halving it; so no
//! point of the mesh is outside. Cables, hoses and tools are on no mesh. Most meshes are the convex
//! hulls of the links.

mod abb_from_6600;
mod abb_to_1600;
mod abb_to_4600;
mod hulls;
mod others;
mod universal_robots;

use alloc::borrow::Cow;

use super::links::{Body, LinkCapsule};
use super::shape::Capsule;

/// A capsule, lengths in tenths of a millimeter.
type Row = [i16; 7];

/// The body of an arm, lengths in tenths of a millimeter.
struct BodyOfArm {
    /// Arms of the catalog with these capsules: their meshes are equal or, if one is not known,
    /// their tables.
    names: &'static [&'static str],
    /// Repository, commit, file and license of the meshes.
    source: &'static str,
    /// How far 95 % of the surface of each link's capsules are outside its mesh at most [mm].
    excess: &'static [u8],
    /// The capsules of each link from the base on: both ends of the axis in the link's frame, then
    /// the radius.
    links: &'static [&'static [Row]],
    /// The capsules of cylinders, pistons and rods beside a link, wherever they may be.
    parts: &'static [(usize, Row)],
    /// Pairs of links that are kept apart. Neighbors touch by construction; the meshes of others
    /// never did, or always, in 100,000 samples inside the limits.
    checked: &'static [[u8; 2]],
}

/// Meters of a tenth of a millimeter [m].
const UNIT: f64 = 1e-4;

/// The body of an arm of the catalog, if there is a free public mesh of it.
pub(crate) fn body_of(name: &str) -> Option<Body> {
    let groups = [
        abb_to_1600::BODIES,
        abb_to_4600::BODIES,
        abb_from_6600::BODIES,
        universal_robots::BODIES,
        others::BODIES,
    ];
    let named = |arm: &'static BodyOfArm| Some((arm, *arm.names.iter().find(|own| **own == name)?));
    let (arm, name) = groups.into_iter().flatten().find_map(named)?;
    let links = arm.links.iter().enumerate();
    let links = links.flat_map(|(link, rows)| rows.iter().map(move |row| capsule(link, row)));
    let parts = arm.parts.iter().map(|(link, row)| capsule(*link, row));
    Some(Body {
        arm: Some(name),
        links: links.collect(),
        parts: parts.collect(),
        hulls: hulls::of(arm.names),
        pairs: arm.checked.iter().map(|pair| pair.map(usize::from)).collect(),
        source: Cow::Borrowed(arm.source),
        is_approximate: false,
        excess: arm.excess.iter().map(|excess| f64::from(*excess) * 1e-3).collect(),
    })
}

fn capsule(link: usize, row: &Row) -> LinkCapsule {
    let [ax, ay, az, bx, by, bz, radius] = row.map(|value| f64::from(value) * UNIT);
    LinkCapsule { link, capsule: Capsule::known([ax, ay, az], [bx, by, bz], radius) }
}
