//! The capsules of a body in groups that move together, with a capsule around each group.

use core::ops::Range;

use nalgebra::Vector3;

use super::links::{Body, LinkCapsule, LinkHull};
use super::shape::{Capsule, DistanceQuery, RoundedHull, Separation, Shape};
use crate::prelude::*;
use irbkin::Pose;

/// Cores of a group, at most.
const CORES: usize = 2;

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
    /// Whether its hulls are other than its capsules, which then do not decide alone.
    pub(crate) has_hulls: bool,
    /// Convex hulls that contain what the capsules do; none in a body without hulls.
    pub(crate) hulls: Vec<RoundedHull>,
    /// The places of capsules inside of its hulls, behind its own: where two of these cores touch,
    /// the hulls do.
    pub(crate) cores: Range<usize>,
    /// How far points of the hulls are beyond the spread at most [m].
    pub(crate) beyond: f64,
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
    /// How far any axis of a capsule or point of a hull is from the origin of its link at most [m].
    pub(crate) reach: f64,
}

impl Outline {
    /// The outline of a body on an arm whose last link has the flange at a pose.
    pub(crate) fn of(body: &Body, last: usize, t_last_flange: &Pose) -> Self {
        let mut outline = Self::default();
        outline.take(body.capsules(), body.hulls(), last, t_last_flange);
        let of_links = outline.groups.len();
        outline.take(body.parts(), &[], last, t_last_flange);
        let group = |link| outline.groups[..of_links].iter().position(|own| own.number == link);
        let ordered = |pair: &[usize; 2]| [pair[0].min(pair[1]), pair[0].max(pair[1])];
        outline.pairs = body
            .pairs()
            .iter()
            .map(ordered)
            .filter_map(|[one, other]| Some([group(one)?, group(other)?]))
            .collect();
        let far = |own: &Group| own.around.center.norm() + own.spread + own.beyond;
        outline.reach = outline.groups.iter().map(far).fold(0.0, f64::max);
        outline
    }

    /// Add a group for each link.
    fn take(
        &mut self,
        capsules: &[LinkCapsule],
        hulls: &[LinkHull],
        last: usize,
        t_last_flange: &Pose,
    ) {
        for number in 0..=last + 1 {
            let first = self.capsules.len();
            let pose = (number > last).then_some(t_last_flange);
            let own = capsules.iter().filter(|own| own.link == number);
            let own: Vec<_> =
                own.map(|own| pose.map_or(own.capsule, |pose| own.capsule.moved(pose))).collect();
            if own.is_empty() {
                continue;
            }
            let of_link = hulls.iter().filter(|own| own.link == number);
            let of_link: Vec<_> = of_link
                .map(|own| pose.map_or_else(|| own.hull.clone(), |pose| own.hull.moved(pose)))
                .collect();
            self.capsules.extend(own.iter().map(Centered::of));
            let behind = self.capsules.len();
            let mut cores: Vec<_> = of_link.iter().filter_map(RoundedHull::core).collect();
            cores.sort_by(|one, two| two.volume().total_cmp(&one.volume()));
            self.capsules.extend(cores.into_iter().take(CORES).map(Centered::of));
            let (range, cores) = (first..behind, behind..self.capsules.len());
            let mut group = Group::new(number, last, range, &own, (of_link, cores));
            if !hulls.is_empty() && !group.has_hulls {
                // For the hulls of other links.
                group.hulls = own.iter().map(RoundedHull::of_capsule).collect();
            }
            self.groups.push(group);
        }
    }
}

impl Group {
    fn new(
        number: usize,
        last: usize,
        range: Range<usize>,
        own: &[Capsule],
        (hulls, cores): (Vec<RoundedHull>, Range<usize>),
    ) -> Self {
        let around = Centered::of(&around(own));
        let far = |capsule: &Capsule| capsule.ends.map(|end| (end - around.center).norm());
        let spread = own.iter().flat_map(far).fold(0.0, f64::max);
        let has_hulls = !hulls.is_empty();
        let points = hulls.iter().flat_map(RoundedHull::points).map(Vector3::from);
        let farthest = points.map(|point| (point - around.center).norm()).fold(0.0, f64::max);
        let beyond = (farthest - spread).max(0.0);
        let link = number.min(last);
        Self { link, number, capsules: range, around, spread, has_hulls, hulls, cores, beyond }
    }

    /// How far its hulls are from another group's, each at the pose of its link.
    pub(crate) fn separation(&self, pose: &Pose, (other, to): (&Self, &Pose)) -> Separation {
        let pairs = self.hulls.iter().flat_map(|one| other.hulls.iter().map(move |two| (one, two)));
        least(pairs, |(one, two), asked| one.separation(pose, (two, to), asked, &mut None))
    }

    /// How far its hulls are from a shape, at the pose of its link.
    pub(crate) fn separation_of(&self, pose: &Pose, shape: &Shape) -> Separation {
        least(self.hulls.iter(), |hull, asked| {
            shape.separation_of_hull(hull, pose, asked, &mut None)
        })
    }
}

/// The least of some separations.
fn least<T>(
    items: impl Iterator<Item = T>,
    separation: impl Fn(T, DistanceQuery) -> Separation,
) -> Separation {
    items.fold(Separation::NOTHING, |nearest, item| {
        let own =
            separation(item, DistanceQuery { far: nearest.distance, ..DistanceQuery::DISTANCE });
        if own.distance < nearest.distance { own } else { nearest }
    })
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
    let least = least.min_by(|one, two| one.volume().total_cmp(&two.volume()));
    least.unwrap_or(capsules[0])
}
