//! Corners of a solid mesh that rounding has parted are one again.
//!
//! A file writes a corner once for every triangle, often with different roundings. A mesh that is
//! closed stays as it is. Else corners within the least distance that closes it are made one.

use alloc::collections::BTreeMap;

use nalgebra::Vector3;

use super::surface::opening;
use super::tree::Bounds;
use super::triangle::Triangle;
use crate::error::Error;
use crate::prelude::*;
use irbkin::internal::lanes::whole_below;
use irbkin::{Interrupt, Interrupted};

/// How far apart two corners of a solid mesh may be and be one [m], and as a part of a mesh that is
/// larger than a meter [1]. A motion counts what is a hundred times as far apart as touching.
pub(super) const SAME_CORNER: f64 = 1e-6;

/// The parts of [`SAME_CORNER`] that are tried, one after another [1].
const PARTS: [f64; 4] = [1e-3, 1e-2, 1e-1, 1.0];

/// The triangles of a solid, closed.
pub(super) fn closed(
    triangles: Vec<Triangle>,
    interrupt: Interrupt<'_>,
) -> Result<Vec<Triangle>, Error> {
    let Some(mut open) = opening(&triangles, interrupt)? else { return Ok(triangles) };
    let Bounds { low, high } = Bounds::of(triangles.as_flattened());
    let most = SAME_CORNER * (high - low).max().max(1.0);
    for part in PARTS {
        let welded = welded(&triangles, part * most, interrupt)?;
        match opening(&welded, interrupt)? {
            Some(left) => open = left,
            None => return Ok(welded),
        }
    }
    Err(open.into())
}

/// The triangles with each corner at the first one that is within a distance [m]. They are looked up
/// in cells four times as large, so that no cell has more than some hundred.
fn welded(
    triangles: &[Triangle],
    within: f64,
    interrupt: Interrupt<'_>,
) -> Result<Vec<Triangle>, Interrupted> {
    let mut known: BTreeMap<[i64; 3], Vec<Vector3<f64>>> = BTreeMap::new();
    #[expect(clippy::cast_possible_truncation, reason = "corners are within 100 m")]
    let cell = |point: Vector3<f64>| -> [i64; 3] {
        point.map(|value| whole_below(value / (4.0 * within)) as i64).into()
    };
    let mut weld = |corner: Vector3<f64>| {
        let beside = |bits| [1, 2, 4].map(|bit| if bits & bit == 0 { -within } else { within });
        let cells = (0..8).map(|bits| cell(corner + Vector3::from(beside(bits))));
        let mut near = cells.filter_map(|cell| known.get(&cell)).flatten().copied();
        let first = near.find(|known| (known - corner).norm() <= within);
        first.unwrap_or_else(|| {
            known.entry(cell(corner)).or_default().push(corner);
            corner
        })
    };
    let rows = triangles.iter().enumerate();
    rows.map(|(row, corners)| interrupt.check(row).map(|()| corners.map(&mut weld))).collect()
}
