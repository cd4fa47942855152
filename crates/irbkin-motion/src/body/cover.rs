//! Capsules that contain a shape.
//!
//! *Box.* A face is divided into cells of half sides `u <= v`, along each of which one capsule
//! lies. The corners of a cell are `rho = hypot(u, v)` from its axis. A capsule whose axis ends `s`
//! before the ends of the cell contains them if its radius is `R = hypot(rho, s)`, and so the whole
//! cell, since both are convex. A point of the capsule is at most `R - u` beyond a side of the box,
//! and `R - s` beyond an end. The larger of both, the excess, is least where `s = u`, or as near to
//! that as the length of the cell permits:
//!
//! `excess = R - s`, `R = sqrt(u^2 + v^2 + s^2)`, `s = min(u, length / 2)`.
//!
//! *Cylinder, by one capsule along its axis.* The same with `u = radius` and `rho = radius`.
//!
//! *Cylinder, across its axis.* It is divided into strips of width `2 u` across a diameter and `2
//! v` along the axis. A strip is in a cell as long as the chord at its inner side, and so in the
//! capsule of the cell. The ends of its axis are `e` from the axis of the cylinder, so no point of
//! it is farther than `e + R - radius` from the lateral surface, nor than `R - v` from the ends.

use nalgebra::Vector3;

use super::shape::{Capsule, Shape, check_length};
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::prelude::*;

/// Capsules of a cover where no excess is given, at most.
const FEW: usize = 4;

/// Capsules of a cover, at most.
const MOST: usize = 100;

/// Capsules that contain a shape.
pub(crate) struct Cover {
    pub(crate) capsules: Vec<Capsule>,
    /// How far a capsule is outside the shape at most [m].
    pub(crate) excess: f64,
}

impl Shape {
    /// Capsules that contain the shape: the fewest of those known that are nowhere farther outside
    /// than `wanted` [m], or at most four with the least excess.
    pub(crate) fn cover(&self, wanted: Option<f64>) -> Result<Cover, Error> {
        if let Some(excess) = wanted {
            check_length("excess", excess, 0.0)?;
        }
        let most = if wanted.is_some() { MOST } else { FEW };
        let (pose, covers) = match self {
            Self::Capsule(capsule) => {
                return Ok(Cover { capsules: Vec::from([*capsule]), excess: 0.0 });
            }
            Self::Box { pose, half } => (pose, covers_of_box(half, most)),
            Self::Cylinder { pose, radius, half } => {
                (pose, covers_of_cylinder(*radius, *half, most))
            }
            Self::Union(shapes) => {
                let mut all = Cover { capsules: Vec::new(), excess: 0.0 };
                for shape in shapes {
                    let cover = shape.cover(wanted)?;
                    all.capsules.extend(cover.capsules);
                    all.excess = all.excess.max(cover.excess);
                }
                return Ok(all);
            }
            Self::HalfSpace { .. }
            | Self::Convex { .. }
            | Self::Mesh { .. }
            | Self::Points { .. } => return Err(BodyFault::NoCover.into()),
        };
        let best = covers.iter().map(|layout| layout.excess).fold(f64::INFINITY, f64::min);
        let order = |one: &Layout, two: &Layout| {
            let excess = one.excess.total_cmp(&two.excess);
            let count = one.count().cmp(&two.count());
            if wanted.is_some() { count.then(excess) } else { excess.then(count) }
        };
        let meets = |layout: &Layout| wanted.is_none_or(|excess| layout.excess <= excess);
        let found = covers.into_iter().filter(meets);
        let refused = BodyFault::Excess { excess: wanted.unwrap_or(best), least: best, most: MOST };
        let layout = found.min_by(order).ok_or(refused)?;
        let capsules = layout.capsules().map(|capsule| capsule.moved(pose)).collect();
        Ok(Cover { capsules, excess: layout.excess })
    }
}

/// A way to lay capsules into a solid around the origin.
#[derive(Clone, Copy)]
struct Layout {
    /// The coordinate along the capsules, then those across.
    axes: [usize; 3],
    /// Half sides of the solid along these [m].
    half: [f64; 3],
    /// Number of capsules across.
    cells: [usize; 2],
    /// The radius of a cylinder that lies across the capsules, its axis along the last coordinate
    /// [m].
    across: Option<f64>,
    /// Whether the solid is a cylinder along the capsules.
    is_round: bool,
    excess: f64,
}

impl Layout {
    fn new(
        axes: [usize; 3],
        half: [f64; 3],
        cells: [usize; 2],
        across: Option<f64>,
        is_round: bool,
    ) -> Self {
        let mut layout = Self { axes, half, cells, across, is_round, excess: 0.0 };
        let radius = layout.radius();
        let [u, v] = layout.sides();
        let ends = (0..cells[0]).map(|column| {
            let (middle, length) = layout.column(column);
            match across {
                Some(round) => middle.hypot(length - layout.inset(length)) + radius - round,
                None => radius - layout.inset(length),
            }
        });
        let beyond_sides = radius - if across.is_some() || is_round { v } else { u.min(v) };
        layout.excess = ends.fold(beyond_sides, f64::max);
        layout
    }

    fn count(&self) -> usize {
        self.cells[0] * self.cells[1]
    }

    /// Half sides of a cell [m].
    #[expect(clippy::cast_precision_loss, reason = "a few capsules")]
    fn sides(&self) -> [f64; 2] {
        [self.half[1] / self.cells[0] as f64, self.half[2] / self.cells[1] as f64]
    }

    /// How far the ends of a capsule's axis are inside a cell of half length `length` [m].
    fn inset(&self, length: f64) -> f64 {
        let [u, v] = self.sides();
        u.min(v).min(length).min(self.half[0])
    }

    /// The radius of the capsules [m], for the longest inset.
    fn radius(&self) -> f64 {
        let [u, v] = self.sides();
        let corner = if self.is_round { u } else { u.hypot(v) };
        corner.hypot(self.inset(self.half[0]))
    }

    /// The middle of a column of cells, and its half length [m].
    #[expect(clippy::cast_precision_loss, reason = "a few capsules")]
    fn column(&self, column: usize) -> (f64, f64) {
        let side = self.sides()[0];
        let middle = side * (2 * column + 1) as f64 - self.half[1];
        let length = self.across.map_or(self.half[0], |radius| {
            let inner = (middle.abs() - side).max(0.0);
            (radius * radius - inner * inner).max(0.0).sqrt()
        });
        (middle, length)
    }

    fn capsules(self) -> impl Iterator<Item = Capsule> {
        let radius = self.radius();
        (0..self.cells[0]).flat_map(move |column| {
            let (x, length) = self.column(column);
            let end = length - self.inset(length);
            (0..self.cells[1]).map(move |row| {
                #[expect(clippy::cast_precision_loss, reason = "a few capsules")]
                let y = self.sides()[1] * (2 * row + 1) as f64 - self.half[2];
                let at = |along: f64| {
                    let mut point = [0.0; 3];
                    for (axis, value) in self.axes.into_iter().zip([along, x, y]) {
                        point[axis] = value;
                    }
                    point
                };
                Capsule::known(at(-end), at(end), radius)
            })
        })
    }
}

/// Every number of columns and rows of so many capsules at most.
fn cells(most: usize) -> impl Iterator<Item = [usize; 2]> {
    (1..=most).flat_map(move |columns| (1..=most / columns).map(move |rows| [columns, rows]))
}

fn covers_of_box(half: &Vector3<f64>, most: usize) -> Vec<Layout> {
    let axes = [[0, 1, 2], [1, 2, 0], [2, 0, 1]];
    let layouts = axes.into_iter().flat_map(|axes| {
        let half = axes.map(|axis| half[axis]);
        cells(most).map(move |cells| Layout::new(axes, half, cells, None, false))
    });
    layouts.collect()
}

fn covers_of_cylinder(radius: f64, half: f64, most: usize) -> Vec<Layout> {
    let along = Layout::new([2, 0, 1], [half, radius, radius], [1, 1], None, true);
    let across = cells(most)
        .map(|cells| Layout::new([0, 1, 2], [radius, radius, half], cells, Some(radius), false));
    core::iter::once(along).chain(across).collect()
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use nalgebra::Vector3;

    use super::*;
    use crate::rng::Rng;
    use irbkin::Pose;

    /// A pose in general position.
    fn pose() -> Pose {
        Pose::new(Vector3::new(0.3, -0.2, 0.5), Vector3::new(0.4, 1.1, -0.7))
    }

    fn shapes() -> Vec<Shape> {
        let sizes = [[0.3, 0.2, 0.1], [1.0, 1.0, 0.01], [0.05, 0.05, 0.9], [0.2, 0.2, 0.2]];
        let boxes = sizes.map(|size| Shape::cuboid(size, &pose()));
        let rods = [[0.04, 0.3], [0.2, 0.01], [0.1, 0.2], [0.1, 0.1]];
        let rods = rods.map(|[radius, length]| Shape::cylinder(radius, length, &pose()));
        boxes.into_iter().chain(rods).map(Result::unwrap).collect()
    }

    /// How far a point is outside a shape [m], less than zero inside.
    fn outside(shape: &Shape, point: &Vector3<f64>) -> f64 {
        const BALL: f64 = 1e-3;
        shape.separation(&Capsule::known((*point).into(), (*point).into(), BALL)).distance + BALL
    }

    /// A point at the surface of a box that holds a shape, moved into it.
    fn at_the_surface(shape: &Shape, rng: &mut Rng) -> Vector3<f64> {
        let mut far =
            || Vector3::new(rng.between(-2.0, 2.0), rng.between(-2.0, 2.0), rng.between(-2.0, 2.0));
        let point: [f64; 3] = far().into();
        shape.separation(&Capsule::known(point, point, 1e-9)).points[1]
    }

    #[test]
    fn a_cover_contains_the_shape_and_keeps_its_excess() {
        let mut rng = Rng::new(11);
        for shape in shapes() {
            for wanted in [None, Some(0.04), Some(0.025)] {
                let Ok(cover) = shape.cover(wanted) else {
                    assert!(wanted.is_some());
                    continue;
                };
                assert!(wanted.map_or(cover.capsules.len() <= FEW, |most| cover.excess <= most));
                for _ in 0..2000 {
                    let point = at_the_surface(&shape, &mut rng);
                    let ball = Capsule::known(point.into(), point.into(), 0.0);
                    let holds = |own: &Capsule| own.separation(&ball).distance <= 1e-12;
                    assert!(cover.capsules.iter().any(holds), "{shape:?} {point}");
                }
                let mut most = 0.0_f64;
                for own in cover.capsules.iter().flat_map(|own| [own; 200]) {
                    let [a, b] = own.ends().map(Vector3::from);
                    let way = at_the_surface(&Shape::Capsule(*own), &mut rng);
                    let part = rng.between(0.0, 1.0);
                    let way = (way - a).normalize() * own.radius();
                    most = most.max(outside(&shape, &(a + (b - a) * part + way)));
                }
                assert!(most <= cover.excess + 1e-9, "{shape:?}: {most}, {}", cover.excess);
            }
        }
    }

    #[test]
    fn corners_of_a_box_are_inside() {
        for shape in shapes() {
            let Shape::Box { pose, half } = &shape else { continue };
            let cover = shape.cover(None).unwrap();
            for signs in 0..8 {
                let sign = |bit: u32| if signs >> bit & 1 == 0 { 1.0 } else { -1.0 };
                let corner = half.component_mul(&Vector3::new(sign(0), sign(1), sign(2)));
                let corner: [f64; 3] = (pose.rotation * corner + pose.translation.vector).into();
                let ball = Capsule::known(corner, corner, 0.0);
                let holds = |own: &Capsule| own.separation(&ball).distance <= 1e-12;
                assert!(cover.capsules.iter().any(holds));
            }
        }
    }

    #[test]
    fn an_excess_that_few_capsules_do_not_reach_is_refused() {
        let wanted = Shape::cuboid([1.0; 3], &Pose::identity()).unwrap();
        let words = wanted.cover(Some(0.001)).err().unwrap();
        assert!(std::format!("{words}").contains("excess is 0.001 m"), "{words}");
        let half_space = Shape::half_space([0.0, 0.0, 1.0], [0.0; 3]).unwrap();
        assert_eq!(half_space.cover(None).err(), Some(BodyFault::NoCover.into()));
        let sphere = Shape::sphere(0.1, [0.0; 3]).unwrap();
        assert_eq!(sphere.cover(Some(0.0)).unwrap().excess, 0.0);
        assert!(wanted.cover(Some(f64::NAN)).is_err());
    }
}
