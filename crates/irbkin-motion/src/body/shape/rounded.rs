//! Convex hulls with a radius: what moves with a link, finer than its capsules.

use alloc::sync::Arc;

use fearless_simd::prelude::*;
use nalgebra::Vector3;

use super::capsule::{Capsule, Separation};
use super::checks::{check_length, check_points};
use super::gjk::{Convex, DistanceQuery, Framed, SeparatingDirection, nearest, placed};
use super::tree::Bounds;
use crate::body::fault::BodyFault;
use crate::error::Error;
use crate::prelude::*;
use irbkin::Pose;
use irbkin::internal::lanes::{Column, LANES, Number as _, Vector, VectorKernel, run_vectors};

/// Rounding of distances, relative to lengths [1].
pub(super) const ROUNDING: f64 = 1e-12;

/// Lengths of a capsule inside of a hull that are tried.
const LENGTHS: u32 = 8;

/// Points of a hull, at most: numbers of corners are bytes.
const MOST_POINTS: usize = 256;

/// All points within a radius of the convex hull of points.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(try_from = "Stored", into = "Stored")
)]
pub struct RoundedHull(Arc<RoundedHullData>);

#[derive(Debug, PartialEq)]
struct RoundedHullData {
    /// The points, lane beside lane; the last one fills the rest.
    columns: Vec<[Column; 3]>,
    count: usize,
    faces: Vec<[u8; 3]>,
    radius: f64,
    center: Vector3<f64>,
    /// How far the points are from the center at most [m].
    spread: f64,
    /// A capsule inside of it, the radius included.
    core: Option<Capsule>,
}

/// A hull as serde reads and writes it: points, faces, radius, the capsule inside.
type Stored = (Vec<[f64; 3]>, Vec<[u8; 3]>, f64, Option<Capsule>);

impl From<RoundedHull> for Stored {
    fn from(hull: RoundedHull) -> Self {
        (hull.points().collect(), hull.faces().to_vec(), hull.radius(), hull.core().copied())
    }
}

impl TryFrom<Stored> for RoundedHull {
    type Error = Error;

    fn try_from((points, faces, radius, core): Stored) -> Result<Self, Error> {
        // Frames of calibrated arms may be far away.
        let points: Vec<_> = points.into_iter().map(Vector3::from).collect();
        check_faces(&faces, points.len())?;
        Ok(Self::known(&points, faces, radius, core))
    }
}

/// Check the numbers of points and of corners.
fn check_faces(faces: &[[u8; 3]], count: usize) -> Result<(), BodyFault> {
    if count > MOST_POINTS {
        return Err(BodyFault::HullPoints { found: count, most: MOST_POINTS });
    }
    match faces.iter().flatten().find(|at| usize::from(**at) >= count) {
        Some(face) => Err(BodyFault::HullFace { face: *face, count }),
        None => Ok(()),
    }
}

impl RoundedHull {
    /// The hull of 1 to 256 points [m], and all that is within a radius of it [m]. `faces` are the
    /// triangles of its surface, by the numbers of their corners, counterclockwise seen from
    /// outside: for pictures, and to see sooner that something is inside; there may be none.
    ///
    /// # Errors
    ///
    /// [`Error::InvalidBody`] for points that are not finite or more than 100 m away, more than 256
    /// of them, a face of a point that there is not, a point outside of a face, and a radius that is
    /// negative or not finite.
    pub fn new(points: &[[f64; 3]], faces: Vec<[u8; 3]>, radius: f64) -> Result<Self, Error> {
        check_length("radius of a hull", radius, 0.0)?;
        let checked = check_points("hull", "points", points, 1)?;
        check_faces(&faces, points.len())?;
        let hull = Self::known(&checked, faces, radius, None);
        let most = 1e-6 * (1.0 + hull.0.spread);
        let beyond = hull.planes().map(|(normal, offset)| hull.farthest(&normal) - offset);
        if let Some(height) = beyond.into_iter().find(|height| *height > most) {
            return Err(BodyFault::HullBeyond { height }.into());
        }
        let core = hull.inscribed();
        Ok(Self::known(&checked, hull.faces().to_vec(), radius, core))
    }

    /// A hull by what is known of it.
    pub(crate) fn known(
        points: &[Vector3<f64>],
        faces: Vec<[u8; 3]>,
        radius: f64,
        core: Option<Capsule>,
    ) -> Self {
        let center = Bounds::of(points).center();
        let spread = points.iter().map(|point| (point - center).norm()).fold(0.0, f64::max);
        let last = points.last().copied().unwrap_or_default();
        let columns = points.chunks(LANES).map(|chunk| {
            let point = |lane: usize| chunk.get(lane).unwrap_or(&last);
            core::array::from_fn(|axis| core::array::from_fn(|lane| point(lane)[axis]))
        });
        let (columns, count) = (columns.collect(), points.len());
        Self(Arc::new(RoundedHullData { columns, count, faces, radius, center, spread, core }))
    }

    pub(crate) fn of_capsule(capsule: &Capsule) -> Self {
        Self::known(&capsule.ends, Vec::new(), capsule.radius, Some(*capsule))
    }

    /// The points [m].
    pub fn points(&self) -> impl Iterator<Item = [f64; 3]> {
        (0..self.0.count).map(|number| self.point(number).into())
    }

    pub(super) fn point(&self, number: usize) -> Vector3<f64> {
        self.0.columns[number / LANES].map(|column| column[number % LANES]).into()
    }

    /// The triangles of the surface of the points' hull, by the numbers of their corners.
    #[must_use]
    pub fn faces(&self) -> &[[u8; 3]] {
        &self.0.faces
    }

    /// The radius [m].
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.0.radius
    }

    /// The radius of the ball around it [m].
    pub(crate) fn ball(&self) -> f64 {
        self.0.spread + self.0.radius
    }

    pub(crate) fn moved(&self, pose: &Pose) -> Self {
        let points: Vec<_> = self.points().map(|point| placed(pose, &point.into())).collect();
        let core = self.core().map(|core| core.moved(pose));
        Self::known(&points, self.faces().to_vec(), self.radius(), core)
    }

    /// The planes of the faces, by their normals and how far these are from the origin.
    fn planes(&self) -> impl Iterator<Item = (Vector3<f64>, f64)> {
        self.faces().iter().filter_map(|face| {
            let [a, b, c] = face.map(|at| self.point(usize::from(at)));
            let normal = (b - a).cross(&(c - a));
            let length = normal.norm();
            (length > 0.0).then(|| (normal / length, normal.dot(&a) / length))
        })
    }

    /// How far the hull reaches along a direction.
    fn farthest(&self, direction: &Vector3<f64>) -> f64 {
        direction.dot(&self.support(direction, None))
    }

    /// A capsule inside of it, if one is known.
    #[doc(hidden)]
    pub fn core(&self) -> Option<&Capsule> {
        self.0.core.as_ref()
    }

    /// A capsule inside of the faces, along the two points that are farthest apart.
    fn inscribed(&self) -> Option<Capsule> {
        let mut middle = Vector3::zeros();
        for (before, point) in (0_u16..).zip(self.points()) {
            middle += (Vector3::from(point) - middle) / f64::from(before + 1);
        }
        let far = |from: &Vector3<f64>| {
            let apart = |point: &Vector3<f64>| (point - from).norm_squared();
            let points = self.points().map(Vector3::from);
            points.max_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(*from)
        };
        let one = far(&middle);
        let along = 0.5 * (far(&one) - one);
        let capsules = (0..LENGTHS).filter_map(|step| {
            let half = along * (f64::from(step) / f64::from(LENGTHS));
            let depth = |(normal, offset): (Vector3<f64>, f64)| {
                offset - normal.dot(&middle) - normal.dot(&half).abs()
            };
            let depth = self.planes().map(depth).reduce(f64::min)? - ROUNDING;
            let ends = [middle - half, middle + half];
            (depth > 0.0).then_some(Capsule { ends, radius: depth + self.radius() })
        });
        capsules.max_by(|one, two| one.volume().total_cmp(&two.volume()))
    }

    /// How far it is in a frame from a convex shape of a radius around a point, by a known way.
    pub(super) fn separation_of(
        &self,
        pose: &Pose,
        (shape, radius, middle): (&dyn Convex, f64, Vector3<f64>),
        asked: DistanceQuery,
        way: &mut SeparatingDirection,
    ) -> Separation {
        let radii = [self.radius(), radius];
        let way = way.get_or_insert_with(|| self.center_in(pose) - middle);
        let own = Framed { shape: self, pose: *pose };
        let asked = asked.without(radii[0] + radii[1]);
        let (distance, points) = nearest(&own as &dyn Convex, shape, way, asked);
        Separation::of_rounded(distance, points, radii)
    }

    /// How far it is from another one, each in a frame, by a way that is known in its own.
    pub(crate) fn separation(
        &self,
        pose: &Pose,
        (other, to): (&Self, &Pose),
        asked: DistanceQuery,
        way: &mut SeparatingDirection,
    ) -> Separation {
        let between = self.center_in(pose) - other.center_in(to);
        let distance = between.norm() * (1.0 - ROUNDING) - self.ball() - other.ball();
        if distance > asked.far {
            return Separation { distance, ..Separation::NOTHING };
        }
        let (inverse, radii) = (pose.inverse(), [self.radius(), other.radius()]);
        let (distance, points) = run_vectors(Between {
            hulls: [self, other],
            pose: inverse * *to,
            way: way.get_or_insert_with(|| inverse.rotation * between),
            asked: asked.without(radii[0] + radii[1]),
        });
        Separation::of_rounded(distance, points, radii).moved(pose)
    }

    /// How far its points reach along directions, times their lengths.
    #[inline(always)]
    pub(crate) fn reach<S: Simd>(&self, simd: S, way: &[Vector<S>; 3]) -> Vector<S> {
        let mut most = Vector::splat(simd, f64::NEG_INFINITY);
        for [x, y, z] in &self.0.columns {
            for at in 0..LANES {
                let along = way[1].scaled_plus(y[at], way[2] * z[at]);
                most = most.max(way[0].scaled_plus(x[at], along));
            }
        }
        most
    }

    /// The middle of its points [m].
    pub(crate) fn center(&self) -> &Vector3<f64> {
        &self.0.center
    }

    /// Its middle where its frame is.
    pub(crate) fn center_in(&self, pose: &Pose) -> Vector3<f64> {
        placed(pose, &self.0.center)
    }
}

impl Convex for RoundedHull {
    fn support(&self, direction: &Vector3<f64>, _: Option<&Vector3<f64>>) -> Vector3<f64> {
        run_vectors(Farthest { hull: self, direction })
    }
}

/// The farthest point of a hull along a direction.
struct Farthest<'a> {
    hull: &'a RoundedHull,
    direction: &'a Vector3<f64>,
}

impl VectorKernel for Farthest<'_> {
    type Answer = Vector3<f64>;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Vector3<f64> {
        InLanes { simd, hull: self.hull }.support(self.direction, None)
    }
}

/// How far the second of two hulls is from the first, in whose frame it has a pose.
struct Between<'a> {
    hulls: [&'a RoundedHull; 2],
    pose: Pose,
    way: &'a mut Vector3<f64>,
    asked: DistanceQuery,
}

impl VectorKernel for Between<'_> {
    type Answer = (f64, [Vector3<f64>; 2]);

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Self::Answer {
        let [one, other] = self.hulls.map(|hull| InLanes { simd, hull });
        nearest(&one, &Framed { shape: other, pose: self.pose }, self.way, self.asked)
    }
}

/// A hull of which eight points are looked at at once.
struct InLanes<'a, S> {
    simd: S,
    hull: &'a RoundedHull,
}

impl<S: Simd> Convex for InLanes<'_, S> {
    #[inline(always)]
    fn support(&self, direction: &Vector3<f64>, _: Option<&Vector3<f64>>) -> Vector3<f64> {
        let (simd, columns) = (self.simd, &self.hull.0.columns);
        let mut most = Vector::splat(simd, f64::NEG_INFINITY);
        let mut place = Vector::splat(simd, 0.0);
        let mut at = place;
        for [x, y, z] in columns {
            let along = Vector::load_array_ref(simd, z) * direction.z;
            let along = Vector::load_array_ref(simd, y).scaled_plus(direction.y, along);
            let along = Vector::load_array_ref(simd, x).scaled_plus(direction.x, along);
            place = along.if_above(most, at, place);
            most = most.max(along);
            at += 1.0;
        }
        let (most, place) = (most.as_array(), place.as_array());
        let mut best = 0;
        for lane in 1..LANES {
            if most[lane] > most[best] {
                best = lane;
            }
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place")]
        let [x, y, z] = &columns[place[best] as usize];
        Vector3::new(x[best], y[best], z[best])
    }
}
