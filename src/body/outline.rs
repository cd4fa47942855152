//! The capsules of a body in groups that move together, with a capsule around each group.

use alloc::vec::Vec;
use core::ops::Range;

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::links::{Body, LinkCapsule};
use super::shape::Capsule;
use crate::kinematics::Pose;

/// Axes of different length that are tried for the capsule around others.
const AXES: u32 = 16;

/// Capsules that move together, inside another one.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    /// The link with which they move.
    pub(crate) link: usize,
    /// The link whose they are: of what the flange carries, one more.
    pub(crate) number: usize,
    /// Their places in the outline.
    pub(crate) capsules: Range<usize>,
    /// A capsule around them, in the link's frame.
    pub(crate) around: Centered,
    /// How far the ends of their axes are from its middle at most [m].
    pub(crate) spread: f64,
}

/// A capsule by the center of its axis.
#[derive(Clone, Debug)]
pub(crate) struct Centered {
    /// The middle of the axis [m].
    pub(crate) center: Vector3<f64>,
    /// From the middle to an end [m].
    pub(crate) half: Vector3<f64>,
    /// The square of the length of this [m^2].
    pub(crate) square: f64,
    /// The radius [m].
    pub(crate) radius: f64,
    /// The radius of the ball around it [m].
    pub(crate) ball: f64,
}

impl Centered {
    pub(crate) fn of(capsule: &Capsule) -> Self {
        let ([a, b], radius) = (capsule.ends, capsule.radius);
        let half = 0.5 * (b - a);
        let square = half.norm_squared();
        Self { center: 0.5 * (a + b), half, square, radius, ball: square.sqrt() + radius }
    }

    /// The capsule with its axis elsewhere.
    pub(crate) fn at(&self, center: Vector3<f64>, half: Vector3<f64>) -> Capsule {
        Capsule { ends: [center - half, center + half], radius: self.radius }
    }
}

/// The capsules of a body, group by group.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outline {
    pub(crate) capsules: Vec<Centered>,
    /// Of the links, then of the parts beside them.
    pub(crate) groups: Vec<Group>,
    /// The groups that are kept apart from each other; the first is of the lower link.
    pub(crate) pairs: Vec<[usize; 2]>,
}

impl Outline {
    /// The outline of a body on an arm whose last link has the flange at a pose.
    pub(crate) fn of(body: &Body, last: usize, t_last_flange: &Pose) -> Self {
        let mut outline = Self::default();
        outline.take(body.capsules(), last, t_last_flange);
        let of_links = outline.groups.len();
        outline.take(body.parts(), last, t_last_flange);
        let group = |link| outline.groups[..of_links].iter().position(|own| own.number == link);
        let ordered = |pair: &[usize; 2]| [pair[0].min(pair[1]), pair[0].max(pair[1])];
        outline.pairs = body
            .pairs()
            .iter()
            .map(ordered)
            .filter_map(|[one, other]| Some([group(one)?, group(other)?]))
            .collect();
        outline
    }

    /// Add a group for each link.
    fn take(&mut self, capsules: &[LinkCapsule], last: usize, t_last_flange: &Pose) {
        for number in 0..=last + 1 {
            let first = self.capsules.len();
            let own = capsules.iter().filter(|own| own.link == number).map(|own| own.capsule);
            let own: Vec<_> = if number > last {
                own.map(|capsule| capsule.moved(t_last_flange)).collect()
            } else {
                own.collect()
            };
            if !own.is_empty() {
                self.capsules.extend(own.iter().map(Centered::of));
                let range = first..self.capsules.len();
                self.groups.push(Group::new(number, last, range, &own));
            }
        }
    }
}

impl Group {
    fn new(number: usize, last: usize, range: Range<usize>, own: &[Capsule]) -> Self {
        let around = Centered::of(&around(own));
        let far = |capsule: &Capsule| capsule.ends.map(|end| (end - around.center).norm());
        let spread = own.iter().flat_map(far).fold(0.0, f64::max);
        Self { link: number.min(last), number, capsules: range, around, spread }
    }
}

/// A capsule around capsules: its axis is on the line between the two ends that are farthest apart,
/// as long as makes it least.
fn around(capsules: &[Capsule]) -> Capsule {
    let ends = || capsules.iter().flat_map(|own| own.ends.map(|end| (end, own.radius)));
    let pairs = ends().flat_map(|(a, _)| ends().map(move |(b, _)| [a, b]));
    let length = |[a, b]: &[Vector3<f64>; 2]| (b - a).norm();
    let [a, b] = pairs.max_by(|one, two| length(one).total_cmp(&length(two))).unwrap_or_default();
    let least = (0..=AXES).map(|step| {
        let part = 0.5 * f64::from(step) / f64::from(AXES);
        let axis = [a + (b - a) * part, b + (a - b) * part];
        let thin = Capsule { ends: axis, radius: 0.0 };
        let far = |(end, radius): (Vector3<f64>, f64)| thin.axis_distance(&end) + radius;
        Capsule { radius: ends().map(far).fold(0.0, f64::max), ..thin }
    });
    // By volume, without the factor of pi.
    let size =
        |own: &Capsule| own.radius * own.radius * (length(&own.ends) + 4.0 / 3.0 * own.radius);
    least.min_by(|one, two| size(one).total_cmp(&size(two))).unwrap_or(capsules[0])
}
