//! Bodies of the arms of the catalog: capsules that contain the public collision meshes, link by
//! link. Every triangle of a mesh is inside one capsule, or its pieces are, after halving it; so no
//! point of the mesh is outside. Cables, hoses and tools are on no mesh. Most meshes are the convex
//! hulls of the links.

mod abb_from_6600;
mod abb_to_1600;
mod abb_to_4600;
mod others;
mod universal_robots;

use alloc::vec::Vec;

use super::links::{Body, LinkCapsule};
use super::shape::Capsule;

/// The body of an arm, lengths in tenths of a millimeter.
struct BodyOfArm {
    /// Arms of the catalog with the same table; that their castings are the same is not known.
    names: &'static [&'static str],
    /// Repository, commit, file and license of the meshes.
    source: &'static str,
    /// How far 95 % of the surface of each link's capsules are outside its mesh at most [mm].
    excess: &'static [u8],
    /// The capsules of links: both ends of the axis in the link's frame, then the radius.
    links: &'static [(u8, &'static [[i16; 7]])],
    /// Those of cylinders, pistons and rods that move beside a link, wherever they may be.
    parts: &'static [(u8, &'static [[i16; 7]])],
    /// Pairs of links that may touch: neighbors do by construction, and of the others the meshes
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
    let capsules = |rows: &[(u8, &[[i16; 7]])]| -> Vec<LinkCapsule> {
        let of_link = |(link, rows): &(u8, &[[i16; 7]])| {
            let link = usize::from(*link);
            let of_row = move |row: &[i16; 7]| {
                let [ax, ay, az, bx, by, bz, radius] = row.map(|value| f64::from(value) * UNIT);
                LinkCapsule { link, capsule: Capsule::known([ax, ay, az], [bx, by, bz], radius) }
            };
            rows.iter().map(of_row).collect::<Vec<_>>()
        };
        rows.iter().flat_map(of_link).collect()
    };
    Some(Body {
        arm: Some(name),
        links: capsules(arm.links),
        parts: capsules(arm.parts),
        pairs: arm.checked.iter().map(|pair| pair.map(usize::from)).collect(),
        source: arm.source,
        excess: arm.excess.iter().map(|excess| f64::from(*excess) * 1e-3).collect(),
    })
}
