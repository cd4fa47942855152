//! Places where two or more solutions merge, to rounding.
//!
//! The closure along the curve is a polynomial there, whose lowest power tells how many.
//! Docs: general.md, eq. 102c.

#[cfg(not(feature = "std"))]
use nalgebra::ComplexField as _;

use super::chain::{Closure, Target};
use super::configuration::{Configuration, Kind, MERGED};
use super::curve::{Curve, Point};
use super::powers::{Powers, SPAN, shifted};
use crate::kinematics::pose::angles::wrap;

/// Most solutions that merge in one place.
const MOST_MULTIPLICITY: u8 = 6;

/// How far from the start the place may be, and how far from it the lowest power is the greatest at
/// least, as parts of the sampled way.
const FARTHEST_PLACE: f64 = 0.5;
const DOMINANT_PART: f64 = 0.5;

/// How far from the place what is below the lowest power may move a solution, as a part of the
/// sampled way.
const NEAR: f64 = 0.06;

/// Steps to the place about which the power before the lowest vanishes.
const MOST_STEPS: usize = 6;

/// How far beyond it the curve is looked at [rad], and how far its closure may be there from what
/// the lowest power makes it [1].
const BEYOND: [f64; 4] = [0.05, 0.1, 0.15, 0.2];
const LIKE: [f64; 2] = [0.5, 2.0];

/// How much the curve may bend [1/rad].
const MOST_BEND: f64 = 4.0;

/// A place where solutions have merged.
#[derive(Clone, Copy, Debug)]
pub(super) struct Merged {
    pub(super) at: Configuration,
    /// Direction of the curve, and how far along it no other solution is [rad].
    direction: [f64; 6],
    extent: f64,
}

impl Merged {
    pub(super) const NONE: Self =
        Self { at: Configuration::NONE, direction: [0.0; 6], extent: -1.0 };

    /// Whether a configuration is on the part of the curve that this place explains.
    pub(super) fn explains(&self, theta: &[f64; 6]) -> bool {
        let apart: [f64; 6] = core::array::from_fn(|i| wrap(theta[i] - self.at.theta[i]));
        let s = (0..6).map(|i| apart[i] * self.direction[i]).sum::<f64>();
        let off = (0..6).map(|i| (apart[i] - s * self.direction[i]).abs()).fold(0.0, f64::max);
        s.abs() <= self.extent && off <= MOST_BEND * s * s + self.at.radius(0.0)
    }
}

impl Closure {
    /// The place on a curve, near its start, where solutions have merged, if they are no farther
    /// apart than rounding.
    pub(super) fn merged(&self, target: &Target, curve: &Curve) -> Option<Merged> {
        let noise = [MERGED * self.rounding, self.accepts()];
        let Lowest { power, size, place } = Lowest::of(&self.powers(target, curve)?, noise)?;
        let s = place * SPAN;
        let beyond = |at: usize| [s, s - BEYOND[at / 2], s + BEYOND[at / 2]][1 + at % 2];
        let [point] = self.points(target, &[Some(curve.straight_ahead(s))]);
        let at = self.accepted(target, point?.theta, 0.0, Kind::Merged(power))?;
        let wanted = core::array::from_fn(|at| Some(curve.straight_ahead(beyond(at))));
        let points: [_; 2 * BEYOND.len()] = self.points(target, &wanted);
        let is_like = |point: &Option<Point>| {
            let like = |one: &Point| one.left / (size * ((one.s - s) / SPAN).powi(power.into()));
            point.as_ref().map(like).is_some_and(|like| LIKE[0] < like && like < LIKE[1])
        };
        let far = points.chunks(2).take_while(|pair| pair.iter().all(is_like)).count();
        let extent = if far > 0 { BEYOND[far - 1] } else { DOMINANT_PART * SPAN };
        let through = self.curve(target, &at.theta);
        let direction = *through.as_ref().unwrap_or(curve).direction();
        Some(Merged { at, direction, extent })
    }
}

/// The lowest power of a polynomial, to a noise, about the place where it is that.
struct Lowest {
    power: u8,
    /// Its coefficient.
    size: f64,
    place: f64,
}

impl Lowest {
    /// The noise is that of the closure, and of its powers.
    fn of(powers: &Powers, noise: [f64; 2]) -> Option<Self> {
        (2..=MOST_MULTIPLICITY).find_map(|power| Self::if_lowest(powers, power, noise))
    }

    fn if_lowest(powers: &Powers, power: u8, [rounding, noise]: [f64; 2]) -> Option<Self> {
        let (index, order) = (usize::from(power), f64::from(power));
        let (mut about, mut place) = (*powers, 0.0);
        for _ in 0..MOST_STEPS {
            let step = -about[index - 1] / (order * about[index]);
            about = shifted(&about, step);
            place += step;
        }
        let size = about[index];
        // What is below it moves no root far.
        let mut most = size.abs() * NEAR.powi(power.into());
        let mut is_lowest = about[0].abs() <= rounding;
        for below in &about[..index] {
            is_lowest &= below.abs() <= noise.min(most);
            most /= NEAR;
        }
        // It is greater than all others together: by Rouche's theorem, so many roots are there.
        let (mut others, mut scale) = (order * noise / DOMINANT_PART.powi(power.into()), 1.0);
        for above in &about[index + 1..] {
            scale *= DOMINANT_PART;
            others += above.abs() * scale;
        }
        let is_found = is_lowest && place.abs() <= FARTHEST_PLACE && size.abs() > 2.0 * others;
        is_found.then_some(Self { power, size, place })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::structure::closure::powers::{SAMPLES, interpolated};
    use crate::lanes::LANES;

    /// The powers of `(x - place)^power (1 + x / 4)`, through its values at the samples.
    fn of_root(power: i32, place: f64, size: f64) -> Powers {
        interpolated(SAMPLES.map(|x| size * (x - place).powi(power) * (1.0 + 0.25 * x)))
    }

    #[test]
    fn a_multiple_root_is_found_where_it_is_with_its_multiplicity() {
        for power in 2..=5 {
            for place in [-0.4, -0.1, 0.0, 0.3, 0.49] {
                let lowest = Lowest::of(&of_root(power, place, 1e-3), [4e-15, 4e-14]).unwrap();
                assert_eq!(i32::from(lowest.power), power);
                assert!((lowest.place - place).abs() < 1e-10, "{power} {place} {}", lowest.place);
            }
        }
    }

    #[test]
    fn roots_that_are_apart_or_no_roots_have_not_merged() {
        let noise = [4e-15, 4e-14];
        let apart = |x: f64| 1e-3 * (x - 0.1).powi(2) * (x - 0.15).powi(2);
        assert!(Lowest::of(&interpolated(SAMPLES.map(apart)), noise).is_none());
        let beside = |x: f64| 1e-3 * (x - 0.1).powi(4) + 1e-11;
        assert!(Lowest::of(&interpolated(SAMPLES.map(beside)), noise).is_none());
        // Apart, though the closure hardly tells.
        let flat = |x: f64| 1.2e-12 * (x - 0.26) * (x + 0.06);
        assert!(Lowest::of(&interpolated(SAMPLES.map(flat)), noise).is_none());
        let near = |x: f64| 1e-4 * x.powi(2) - 5e-15;
        assert!(Lowest::of(&interpolated(SAMPLES.map(near)), noise).is_none());
        // One root, none, and what is zero everywhere.
        for values in [SAMPLES, [1.0; LANES], [0.0; LANES], [1e-13; LANES]] {
            assert!(Lowest::of(&interpolated(values), noise).is_none(), "{values:?}");
        }
        // Farther away than is looked.
        assert!(Lowest::of(&of_root(3, 0.7, 1e-3), noise).is_none());
    }
}
