//! How a group of capsules moves along a part of a motion, to first order, and what it stays apart
//! from (docs/theory/cell.md, eq. 9 and 10).

use fearless_simd::prelude::*;

use super::distance_bounds::{Axis, Plane, Point, minus, plane_to};
use crate::body::Shape;
use irbkin::internal::lanes::{Number as _, Vector, cross, dot};

/// The way of a group from the middle of a part to its end, seen from a link.
pub(super) struct Drift<S: Simd> {
    /// The point to which the velocity belongs.
    center: Point<S>,
    velocity: Point<S>,
    spin: Point<S>,
    /// How far the ends of its axes, or points of its hulls, are from where these lead at most [m].
    pub(super) bent: Vector<S>,
    /// How far the points of its hulls are from the center at most [m].
    pub(super) extent: f64,
}

impl<S: Simd> Drift<S> {
    #[inline(always)]
    pub(super) fn none(center: Point<S>) -> Self {
        let none = [center[0].like(0.0); 3];
        Self { center, velocity: none, spin: none, bent: none[0], extent: 0.0 }
    }

    /// Turn it around an axis through a point besides.
    #[inline(always)]
    pub(super) fn turn(&mut self, axis: Point<S>, point: Point<S>, turn: Vector<S>) {
        let around = cross(axis, minus(self.center, point));
        for index in 0..3 {
            self.velocity[index] = around[index].times_plus(turn, self.velocity[index]);
            self.spin[index] = axis[index].times_plus(turn, self.spin[index]);
        }
    }

    /// The lanes in which an axis of the group stays farther beyond a plane than a limit [m].
    #[inline(always)]
    pub(super) fn stays_beyond(&self, plane: &Plane<S>, axis: &Axis<S>, limit: f64) -> u64 {
        let way = plane.way;
        let least = dot(way, axis.middle) - dot(way, axis.half).size() - plane.reach;
        // way . (spin x r) = (way x spin) . r
        let turned = cross(way, self.spin);
        let middle = dot(way, self.velocity) + dot(turned, minus(axis.middle, self.center));
        let moved = middle.size() + dot(turned, axis.half).size();
        plane.is_below(least - moved, self.bent + limit)
    }

    /// The lanes in which hulls of the group with a gap to a plane, times the length of its way, stay
    /// farther than a limit [m].
    #[inline(always)]
    pub(super) fn leaves(&self, plane: &Plane<S>, gap: Vector<S>, limit: f64) -> u64 {
        let turned = cross(plane.way, self.spin);
        let moved = dot(plane.way, self.velocity).size() + dot(turned, turned).root() * self.extent;
        plane.is_below(gap - moved, self.bent + limit)
    }

    /// The lanes in which an axis of the group stays farther from a shape than a limit [m].
    #[inline(always)]
    pub(super) fn stays_off(&self, shape: &Shape, axis: &Axis<S>, limit: f64) -> u64 {
        match plane_to(shape, axis) {
            Some(plane) => self.stays_beyond(&plane, axis, limit),
            None => 0,
        }
    }
}

#[cfg(test)]
mod tests {
    use core::array;
    use core::f64::consts::PI;

    use super::super::block::Query;
    use super::super::checker::Checker;
    use super::super::obstacles::Cell;
    use super::super::path::Range;
    use super::*;
    use crate::arm::Arm;
    use irbkin::Pose;

    /// A number from -1 to 1.
    fn random(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        f64::from((*state >> 33) as u32) / f64::from(1_u32 << 30) - 1.0
    }

    #[test]
    fn nothing_touches_in_a_range_that_is_proven_free() {
        let (mut state, mut proven, mut near, mut by_lines) = (1, 0, 0, 0);
        // The second one has a linkage.
        for (name, size) in [("UR5", 1.0), ("IRB 2400-12/1.55", 1.6), ("IRB 2600-12/1.65", 1.8)] {
            let arm = Arm::<6>::named(name).unwrap();
            let at = |z: f64| Pose::translation(0.5 * size, 0.0, z * size);
            let cell = Cell::new(
                vec![
                    ("box".into(), Shape::cuboid([0.2 * size; 3], &at(0.3)).unwrap()),
                    ("can".into(), Shape::cylinder(0.1, 0.4, &at(0.7)).unwrap()),
                    ("floor".into(), Shape::half_space([0.0, 0.0, 1.0], [0.0; 3]).unwrap()),
                ],
                0.01,
            )
            .unwrap();
            let mut checker = cell.checker(&arm).unwrap();
            for case in 0..6000 {
                let scale = [0.02, 0.1, 0.4][case % 3];
                let range = Range::<6> {
                    middle: array::from_fn(|_| PI * random(&mut state)),
                    turns: array::from_fn(|_| scale * random(&mut state)),
                    beside: array::from_fn(|_| 0.02 * scale * random(&mut state).abs()),
                };
                let is_open = |checker: &mut Checker<'_, 6>, range: Range<6>| {
                    checker.touching(&[range.middle], Query::Swept(&[range])) != 0
                };
                if is_open(&mut checker, range) {
                    continue;
                }
                proven += 1;
                let wide = Range { turns: [0.0; 6], beside: range.spans(), ..range };
                by_lines += usize::from(is_open(&mut checker, wide));
                for sample in 0..24 {
                    let along = if sample < 2 { [-1.0, 1.0][sample] } else { random(&mut state) };
                    let q = array::from_fn(|joint| {
                        let beside = if sample % 2 == 0 { 1.0 } else { random(&mut state) };
                        range.middle[joint]
                            + along * range.turns[joint]
                            + beside.copysign(random(&mut state)) * range.beside[joint]
                    });
                    assert!(!checker.touches(&q), "{name} {range:?} {q:?}");
                }
                let farther =
                    array::from_fn(|joint| range.middle[joint] + 4.0 * range.turns[joint]);
                near += usize::from(checker.touches(&farther));
            }
        }
        // Many are proven by the line alone, and contacts are not far.
        assert!(proven > 4000 && by_lines > 300 && near > 30, "{proven} {by_lines} {near}");
    }
}
