//! Convex hulls of the links of the catalog's arms, of the same meshes as their capsules.
//!
//! `hulls.bin` is written by `tests/write_hulls.py`. Of each body: the length of its name and the name,
//! then the number of its hulls; of each hull: the link, the numbers of points and of faces as
//! bytes; in hundredths of a millimeter its radius, in tenths the ends and the radius of a capsule
//! inside of its points, as two bytes each, the lower one first; the coordinates of the points in
//! tenths of a millimeter, axis by axis the lower bytes, then the higher ones; the first corners of
//! the faces, the second ones and the third ones. Points and faces are sorted. So it is compressed
//! to 109 kB, and to 130 kB point by point.

use nalgebra::Vector3;

use super::UNIT;
use crate::body::links::LinkHull;
use crate::body::shape::{Capsule, RoundedHull};
use crate::prelude::*;

const HULLS: &[u8] = include_bytes!("hulls.bin");

/// Meters of a hundredth of a millimeter [m].
const RADIUS: f64 = 1e-5;

/// The hulls of the body of arms, one of which names them.
pub(super) fn of(names: &[&str]) -> Vec<LinkHull> {
    let mut rest = Rest(HULLS);
    while let Some(length) = rest.byte() {
        let own = rest.take(usize::from(length));
        let is_wanted = names.iter().any(|name| name.as_bytes() == own);
        let count = rest.byte().unwrap_or_default();
        let mut hulls = Vec::new();
        for _ in 0..count {
            let [link, points, faces] = core::array::from_fn(|_| rest.byte().unwrap_or_default());
            let radius = f64::from(rest.pair().cast_unsigned()) * RADIUS;
            let ends = [rest.point(), rest.point()];
            let core = Capsule::known(ends[0], ends[1], f64::from(rest.pair()) * UNIT + radius);
            let [points, faces] = [points, faces].map(usize::from);
            let (bytes, corners) = (rest.take(6 * points), rest.take(3 * faces));
            if is_wanted {
                let points: Vec<_> = (0..points).map(|at| point(bytes, points, at)).collect();
                let face = |at| core::array::from_fn(|corner| corners[corner * faces + at]);
                let faces = (0..faces).map(face).collect();
                let hull = RoundedHull::known(&points, faces, radius, Some(core));
                hulls.push(LinkHull { link: usize::from(link), hull });
            }
        }
        if is_wanted {
            return hulls;
        }
    }
    Vec::new()
}

/// A point of so many, in columns of bytes [m].
fn point(bytes: &[u8], count: usize, at: usize) -> Vector3<f64> {
    let byte = |column: usize| bytes[column * count + at];
    Vector3::from_fn(|axis, _| {
        f64::from(i16::from_le_bytes([byte(2 * axis), byte(2 * axis + 1)])) * UNIT
    })
}

/// Bytes that are not read yet.
struct Rest(&'static [u8]);

impl Rest {
    fn take(&mut self, count: usize) -> &'static [u8] {
        let (taken, rest) = self.0.split_at(count.min(self.0.len()));
        self.0 = rest;
        taken
    }

    fn byte(&mut self) -> Option<u8> {
        self.take(1).first().copied()
    }

    fn pair(&mut self) -> i16 {
        self.take(2).try_into().map_or(0, i16::from_le_bytes)
    }

    fn point(&mut self) -> [f64; 3] {
        core::array::from_fn(|_| f64::from(self.pair()) * UNIT)
    }
}
