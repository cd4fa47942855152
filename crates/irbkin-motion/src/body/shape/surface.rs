//! Surfaces of solids: whether triangles enclose a volume, and which of them a ray goes through.

use alloc::collections::BTreeMap;

use nalgebra::Vector3;

use super::checks::LEAST;
use super::triangle::{Triangle, edges};
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::prelude::*;
use irbkin::{Interrupt, Interrupted};

/// Bound of the rounding of a product of three vectors, relative to the product of their lengths
/// [1]: more than 10 roundings.
const ROUNDING: f64 = 4e-15;

/// Where triangles are open: an edge that is not used in one sense as often as in the other. If
/// there is no such edge, every ray leaves the surface as often as it enters it.
pub(super) fn opening(
    triangles: &[Triangle],
    interrupt: Interrupt<'_>,
) -> Result<Option<BodyFault>, Interrupted> {
    let mut numbers = BTreeMap::new();
    let mut senses: BTreeMap<[usize; 2], [u32; 2]> = BTreeMap::new();
    let mut places = Vec::new();
    for (index, triangle) in triangles.iter().enumerate() {
        interrupt.check(index)?;
        let corners = triangle.map(|corner| {
            // 0.0 is -0.0.
            let bits: [u64; 3] = corner.map(|value| (value + 0.0).to_bits()).into();
            *numbers.entry(bits).or_insert_with(|| {
                places.push(corner);
                places.len() - 1
            })
        });
        for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|edge| edge.map(|at| corners[at])) {
            if a != b {
                senses.entry([a.min(b), a.max(b)]).or_default()[usize::from(a > b)] += 1;
            }
        }
    }
    let mut open = senses.iter().filter(|(_, [along, back])| along != back);
    let Some((edge, [along, back])) = open.next() else { return Ok(None) };
    let edge = edge.map(|at| places[at].into());
    Ok(Some(BodyFault::Open { edge, senses: [*along, *back], count: 1 + open.count() }))
}

pub(super) fn check_volume(triangles: &[Triangle]) -> Result<(), Error> {
    let middle = triangles[0][0];
    let (mut volume, mut area) = (0.0, 0.0);
    for [a, b, c] in triangles {
        let normal = (b - a).cross(&(c - a));
        volume += normal.dot(&(a - middle)) / 6.0;
        area += normal.norm() / 2.0;
    }
    // A plate is as thick as its volume over half of its area.
    let thickness = if area > 0.0 { 2.0 * volume.abs() / area } else { 0.0 };
    if thickness < LEAST {
        return Err(BodyFault::NoVolume { thickness, least: LEAST }.into());
    }
    Ok(())
}

/// Whether a ray goes through a triangle: 1 or -1 by the sense of its corners, else 0; `None` if
/// rounding decides.
pub(super) fn crossings(
    triangle: &Triangle,
    point: &Vector3<f64>,
    way: &Vector3<f64>,
) -> Option<i32> {
    let corners = triangle.map(|corner| corner - point);
    let sides = edges(&corners).map(|[a, b]| {
        let side = way.dot(&a.cross(&b));
        (side, sign(side, a.norm() * b.norm() * way.norm()))
    });
    let signs = sides.map(|(_, sign)| sign);
    if signs.contains(&1) && signs.contains(&-1) {
        return Some(0);
    }
    let [a, b, c] = corners;
    let height = a.dot(&b.cross(&c));
    let towards = sign(height, a.norm() * b.norm() * c.norm());
    if signs.contains(&0) {
        return None;
    }
    match towards {
        0 => None,
        towards if towards == signs[0] => Some(towards),
        _ => Some(0),
    }
}

/// The sign of a product of vectors, by the product of their lengths; 0 if rounding decides.
fn sign(product: f64, lengths: f64) -> i32 {
    let most = ROUNDING * lengths;
    i32::from(product > most) - i32::from(product < -most)
}
