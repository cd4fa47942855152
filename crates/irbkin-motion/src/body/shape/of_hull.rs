//! How far a hull of a link is from a shape.

use nalgebra::Vector3;
#[cfg(not(feature = "std"))]
use nalgebra::{ComplexField as _, RealField as _};

use super::capsule::Separation;
use super::cloud::Cloud;
use super::gjk::{Convex, DistanceQuery, Framed, SeparatingDirection, placed};
use super::mesh::Mesh;
use super::rounded::{ROUNDING, RoundedHull};
use super::solid::Shape;
use super::tree::{Bounds, Tree};
use irbkin::Pose;

/// A box around the origin, by half of its edges.
struct Cuboid(Vector3<f64>);

impl Convex for Cuboid {
    fn support(&self, direction: &Vector3<f64>, _: Option<&Vector3<f64>>) -> Vector3<f64> {
        self.0.zip_map(direction, f64::copysign)
    }
}

/// A cylinder around the origin along z, by its radius and half of its length.
struct Cylinder(f64, f64);

impl Convex for Cylinder {
    fn support(&self, direction: &Vector3<f64>, _: Option<&Vector3<f64>>) -> Vector3<f64> {
        let across = direction.x.hypot(direction.y);
        let scale = if across > 0.0 { self.0 / across } else { 0.0 };
        let end = self.1.copysign(direction.z);
        Vector3::new(scale * direction.x, scale * direction.y, end)
    }
}

impl Shape {
    pub(crate) fn separation_of_hull(
        &self,
        hull: &RoundedHull,
        pose: &Pose,
        asked: DistanceQuery,
        way: &mut SeparatingDirection,
    ) -> Separation {
        let (middle, radius) = (hull.center_in(pose), hull.ball());
        if let Some((center, own)) = self.ball() {
            let distance = (center - middle).norm() * (1.0 - ROUNDING) - radius - own;
            if distance > asked.far {
                return Separation { distance, ..Separation::NOTHING };
            }
        }
        let framed = |frame: &Pose, shape: &dyn Convex, way| {
            let center = frame.translation.vector;
            let shape = Framed { shape, pose: *frame };
            hull.separation_of(pose, (&shape, 0.0, center), asked, way)
        };
        let within = |frame: &Pose, look: &dyn Fn(&Pose) -> Separation| {
            look(&(frame.inverse() * *pose)).moved(frame)
        };
        match self {
            Self::Capsule(own) => {
                let shape = (&own.ends as &dyn Convex, own.radius, own.ball().0);
                hull.separation_of(pose, shape, asked, way)
            }
            Self::HalfSpace { normal, offset } => {
                let lowest = Framed { shape: hull, pose: *pose }.support(&-normal, None);
                let distance = normal.dot(&lowest) - offset - hull.radius();
                let from = lowest - normal * hull.radius();
                Separation { distance, points: [from, from - normal * distance] }
            }
            Self::Box { pose: frame, half } => framed(frame, &Cuboid(*half), way),
            Self::Cylinder { pose: frame, radius, half } => {
                framed(frame, &Cylinder(*radius, *half), way)
            }
            Self::Convex { pose: frame, hull: own } => framed(frame, own, way),
            Self::Mesh { pose: frame, mesh } => {
                within(frame, &|pose| mesh.separation_of_hull(hull, pose, asked))
            }
            Self::Points { pose: frame, cloud } => {
                within(frame, &|pose| cloud.separation_of_hull(hull, pose, asked))
            }
            Self::Union(parts) => {
                let each =
                    parts.iter().map(|part| part.separation_of_hull(hull, pose, asked, &mut None));
                let least = each.min_by(|a, b| a.distance.total_cmp(&b.distance));
                least.unwrap_or(Separation::NOTHING)
            }
        }
    }
}

/// The least separation of a hull in a frame from the items of a tree, each of which reaches beyond
/// its box by a radius.
fn least(
    (tree, beyond): (&Tree, f64),
    (hull, pose): (&RoundedHull, &Pose),
    asked: DistanceQuery,
    item: impl Fn(usize, DistanceQuery) -> Separation,
) -> Separation {
    let (middle, radius) = (hull.center_in(pose), hull.ball());
    let room = ROUNDING * (1.0 + radius + beyond + middle.norm());
    let away = |bounds: &Bounds| {
        (middle.sup(&bounds.low).inf(&bounds.high) - middle).norm() - radius - beyond - room
    };
    let mut nearest = Separation::NOTHING;
    tree.search(asked.far + room, away, |index| {
        let far = asked.far.min(nearest.distance);
        let own = item(index, DistanceQuery { far, ..asked });
        if own.distance <= far {
            nearest = own;
        }
        if nearest.distance <= asked.near { f64::NEG_INFINITY } else { nearest.distance }
    });
    nearest
}

impl Cloud {
    fn separation_of_hull(
        &self,
        hull: &RoundedHull,
        pose: &Pose,
        asked: DistanceQuery,
    ) -> Separation {
        least((self.tree(), self.radius()), (hull, pose), asked, |index, asked| {
            let point = self.point(index);
            hull.separation_of(pose, (&[point], self.radius(), point), asked, &mut None)
        })
    }
}

impl Mesh {
    fn separation_of_hull(
        &self,
        hull: &RoundedHull,
        pose: &Pose,
        asked: DistanceQuery,
    ) -> Separation {
        // If it is not inside as a whole, it goes through a triangle or is outside.
        let one = placed(pose, &hull.point(0));
        if self.is_solid() && self.holds(&one) {
            return Separation::of_rounded(0.0, [one; 2], [hull.radius(), 0.0]);
        }
        least((self.tree(), 0.0), (hull, pose), asked, |index, asked| {
            let triangle = self.triangle(index);
            let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
            hull.separation_of(pose, (triangle, 0.0, middle), asked, &mut None)
        })
    }
}
