//! The capsules of a body in groups that move together, with a ball around each group.

use alloc::vec::Vec;
use core::ops::Range;

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::links::{Body, LinkCapsule};
use super::shape::Capsule;

/// Capsules that move together, inside a ball.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// The link with which they move.
    pub(crate) link: usize,
    /// Their places in the outline.
    pub(crate) capsules: Range<usize>,
    /// The center of the ball, in the link's frame [m].
    pub(crate) center: Vector3<f64>,
    /// How far the ends of their axes are from the center at most [m].
    pub(crate) spread: f64,
    /// The radius of the ball [m].
    pub(crate) radius: f64,
}

/// A capsule by the middle of its axis.
#[derive(Clone, Debug)]
pub(crate) struct Middle {
    /// The middle of the axis [m].
    pub(crate) middle: Vector3<f64>,
    /// From the middle to an end [m].
    pub(crate) half: Vector3<f64>,
    /// The square of the length of this [m^2].
    pub(crate) square: f64,
    /// The radius [m].
    pub(crate) radius: f64,
    /// The radius of the ball around it [m].
    pub(crate) ball: f64,
}

impl Middle {
    pub(crate) fn of(capsule: &Capsule) -> Self {
        let [a, b] = capsule.ends;
        let half = 0.5 * (b - a);
        let square = half.norm_squared();
        let radius = capsule.radius;
        Self { middle: 0.5 * (a + b), half, square, radius, ball: square.sqrt() + radius }
    }

    /// The capsule with its axis elsewhere.
    pub(crate) fn at(&self, middle: Vector3<f64>, half: Vector3<f64>) -> Capsule {
        Capsule { ends: [middle - half, middle + half], radius: self.radius }
    }
}

/// The capsules of a body, group by group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    pub(crate) capsules: Vec<Capsule>,
    /// In the same order.
    pub(crate) middles: Vec<Middle>,
    /// Of the links, then of the parts beside them.
    pub(crate) groups: Vec<Group>,
    /// The groups that are kept apart from each other; the first is of the lower link.
    pub(crate) pairs: Vec<[usize; 2]>,
}

impl Outline {
    pub(crate) fn of(body: &Body) -> Self {
        let mut outline = Self::default();
        outline.take(body.capsules());
        let of_links = outline.groups.len();
        outline.take(body.parts());
        let group = |link| outline.groups[..of_links].iter().position(|own| own.link == link);
        let ordered = |pair: &[usize; 2]| [pair[0].min(pair[1]), pair[0].max(pair[1])];
        outline.middles = outline.capsules.iter().map(Middle::of).collect();
        outline.pairs = body
            .pairs()
            .iter()
            .map(ordered)
            .filter_map(|[one, other]| Some([group(one)?, group(other)?]))
            .collect();
        outline
    }

    /// Add a group for each link.
    fn take(&mut self, capsules: &[LinkCapsule]) {
        let most = capsules.iter().map(|own| own.link).max();
        for link in 0..=most.unwrap_or(0) {
            let first = self.capsules.len();
            self.capsules
                .extend(capsules.iter().filter(|own| own.link == link).map(|own| own.capsule));
            if self.capsules.len() > first {
                self.groups.push(Group::around(link, first..self.capsules.len(), &self.capsules));
            }
        }
    }
}

impl Group {
    fn around(link: usize, range: Range<usize>, capsules: &[Capsule]) -> Self {
        let own = &capsules[range.clone()];
        let ends = || own.iter().flat_map(|capsule| capsule.ends.map(|end| (end, capsule.radius)));
        let first = own[0].ends[0];
        let (low, high) = ends().fold((first, first), |(low, high), (end, radius)| {
            let size = Vector3::repeat(radius);
            (low.inf(&(end - size)), high.sup(&(end + size)))
        });
        let center = 0.5 * (low + high);
        let (spread, radius) =
            ends().fold((0.0, 0.0), |(spread, most): (f64, f64), (end, radius)| {
                let far = (end - center).norm();
                (spread.max(far), most.max(far + radius))
            });
        Self { link, capsules: range, center, spread, radius }
    }
}
