//! Laws of hulls: distances from them are those of their points, and what is inside of them touches
//! what they touch.

use crate::common::Rng;
use irbkin::{Pose, catalog};
use irbkin_motion::Arm;
use irbkin_motion::body::{Body, Capsule, LinkCapsule, LinkHull, RoundedHull, Shape};
use irbkin_motion::cell::Cell;
use nalgebra::{IsometryMatrix3, Point3, Rotation3, Translation3, Vector3};

/// A pose anywhere near.
fn pose(rng: &mut Rng) -> Pose {
    let mut triple = || Vector3::from([0; 3].map(|_| rng.between(-1.0, 1.0)));
    IsometryMatrix3::from_parts(Translation3::from(triple()), Rotation3::new(3.0 * triple()))
}

/// A tetrahedron around the origin, with a radius.
fn hull(rng: &mut Rng) -> RoundedHull {
    let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let points = corners.map(|corner| corner.map(|value| value * rng.between(0.1, 0.4)));
    let faces = vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
    RoundedHull::new(&points, faces, rng.between(0.0, 0.05)).unwrap()
}

/// An arm whose link 1 alone has a body, which is at a pose in the world: a hull, and a ball around
/// it.
fn probe(hull: &RoundedHull, pose: &Pose) -> Arm<6> {
    let robot = Arm::<6>::named("UR5e").unwrap();
    let moved = robot.link_frames(&[0.0; 6]).0[0].inverse() * pose;
    let points: Vec<[f64; 3]> =
        hull.points().map(|point| (moved * Point3::from(point)).coords.into()).collect();
    let hull = RoundedHull::new(&points, hull.faces().to_vec(), hull.radius()).unwrap();
    let center = moved.translation.vector.into();
    let capsule = Capsule::new(center, center, 0.9).unwrap();
    let body = Body::new(vec![LinkCapsule { link: 1, capsule }], Vec::new()).unwrap();
    robot.with_body(Some(body.with_hulls(vec![LinkHull { link: 1, hull }]).unwrap())).unwrap()
}

/// Points of the faces of a tetrahedron.
fn surface(hull: &RoundedHull, pose: &Pose) -> Vec<Vector3<f64>> {
    const STEPS: u32 = 24;
    let corners: Vec<Vector3<f64>> =
        hull.points().map(|point| (pose * Point3::from(point)).coords).collect();
    let mut points = Vec::new();
    for face in hull.faces() {
        let [a, b, c] = face.map(|at| corners[usize::from(at)]);
        for i in 0..=STEPS {
            for j in 0..=STEPS - i {
                let [i, j] = [i, j].map(|step| f64::from(step) / f64::from(STEPS));
                points.push(a + (b - a) * i + (c - a) * j);
            }
        }
    }
    points
}

fn alone(shape: &Shape) -> Cell {
    Cell::new(vec![("shape".to_owned(), shape.clone())], 0.0).unwrap()
}

/// How far a point is outside of a shape, by the distance of a small ball.
fn outside(shape: &Shape, point: &Vector3<f64>) -> f64 {
    let robot = Arm::<6>::named("UR5e").unwrap();
    let own = robot.link_frames(&[0.0; 6]).0[0].inverse() * Point3::from(*point);
    let capsule = Capsule::new(own.coords.into(), own.coords.into(), 1e-6).unwrap();
    let body = Body::new(vec![LinkCapsule { link: 1, capsule }], Vec::new()).unwrap();
    let robot = robot.with_body(Some(body)).unwrap();
    alone(shape).nearest(&robot, &[0.0; 6]).unwrap().unwrap().distance + 1e-6
}

#[test]
fn a_distance_from_a_hull_is_the_least_from_its_points() {
    let mut rng = Rng::new(81);
    let mut apart = 0;
    for case in 0..160 {
        let (own, near, far) = (hull(&mut rng), pose(&mut rng), pose(&mut rng));
        let box_at = |size: [f64; 3]| Shape::cuboid(size, &far);
        let corners =
            [[0.0; 3], [0.3, 0.0, 0.0], [0.0, 0.4, 0.0], [0.0, 0.0, 0.2], [0.2, 0.2, 0.3]];
        let mesh =
            [[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]].map(|face| face.map(|at| corners[at]));
        let shape = match case % 8 {
            0 => box_at([0.3, 0.5, 0.2]),
            1 => Shape::cylinder(0.2, 0.6, &far),
            2 => Shape::half_space([0.3, -0.2, 0.9], far.translation.vector.into()),
            3 => Shape::convex(&corners, &far),
            4 => Shape::mesh(&mesh, true, &far),
            5 => Shape::points(&corners, rng.between(0.05, 1.5), &far),
            6 => {
                Shape::union(vec![box_at([0.1; 3]).unwrap(), Shape::sphere(0.2, [0.0; 3]).unwrap()])
            }
            _ => Shape::capsule([0.1, 0.2, 0.3], far.translation.vector.into(), 0.1),
        }
        .unwrap();
        let robot = probe(&own, &near);
        let found = alone(&shape).nearest(&robot, &[0.0; 6]).unwrap().unwrap();
        let points = surface(&own, &near);
        let least = points.iter().map(|point| outside(&shape, point)).fold(f64::INFINITY, f64::min);
        let collides = alone(&shape).collides(&robot, &[0.0; 6]).unwrap();
        assert_eq!(collides, found.distance <= 1e-9, "case {case}: {}", found.distance);
        if found.distance <= 0.0 {
            // A corner may be inside although no point of the faces is.
            continue;
        }
        apart += 1;
        let off = least - own.radius() - found.distance;
        assert!((-1e-6..0.02).contains(&off), "case {case}: off by {off}");
        let [from, to] = found.points.map(Vector3::from);
        assert!(((from - to).norm() - found.distance).abs() < 1e-6, "case {case}");
    }
    assert!(apart > 60, "{apart}");
}

#[test]
fn two_hulls_are_as_far_apart_as_one_from_the_points_of_the_other() {
    let mut rng = Rng::new(82);
    let robot = Arm::<6>::named("UR5e").unwrap();
    let mut apart = 0;
    for _ in 0..200 {
        let hulls = [hull(&mut rng), hull(&mut rng)];
        let q = rng.inside(robot.limits());
        let frames = robot.link_frames(&q).0;
        let capsule = Capsule::new([0.0; 3], [0.0; 3], 2.0).unwrap();
        let links = [1, 4].map(|link| LinkCapsule { link, capsule }).to_vec();
        let both = [1, 4].into_iter().zip(hulls.clone());
        let both = both.map(|(link, hull)| LinkHull { link, hull }).collect();
        let body = Body::new(links, vec![[1, 4]]).unwrap().with_hulls(both).unwrap();
        let own = robot.clone().with_body(Some(body)).unwrap();
        let found = Cell::default().nearest(&own, &q).unwrap().unwrap();
        let other = Shape::convex(&hulls[1].points().collect::<Vec<_>>(), &frames[3]).unwrap();
        let alone =
            alone(&other).nearest(&probe(&hulls[0], &frames[0]), &[0.0; 6]).unwrap().unwrap();
        let touches = Cell::default().collides(&own, &q).unwrap();
        assert_eq!(touches, found.distance <= 1e-9, "{}", found.distance);
        if !touches {
            let off = alone.distance - hulls[1].radius() - found.distance;
            assert!(off.abs() < 1e-9, "{off}");
            apart += 1;
        }
    }
    assert!(apart > 30, "{apart}");
}

/// The hulls of the catalog have a capsule inside: else it would call free postures colliding.
#[test]
fn the_core_of_a_hull_of_the_catalog_is_inside_of_it() {
    let mut count = 0;
    for arm in catalog() {
        let robot = irbkin_motion::AnyArm::from_catalog(&arm).unwrap();
        let body = match &robot {
            irbkin_motion::AnyArm::Six(robot) => robot.body().unwrap(),
            irbkin_motion::AnyArm::Seven(robot) => robot.body().unwrap(),
            irbkin_motion::AnyArm::Five(robot) => robot.body().unwrap(),
        };
        assert_eq!(body.hulls().is_empty(), body.is_approximate(), "{}", arm.name);
        for own in body.hulls() {
            let points: Vec<Vector3<f64>> = own.hull.points().map(Vector3::from).collect();
            let core = own.hull.core().unwrap();
            let mut depth = f64::INFINITY;
            for face in own.hull.faces() {
                let [a, b, c] = face.map(|at| points[usize::from(at)]);
                let normal = (b - a).cross(&(c - a)).normalize();
                let beyond = points.iter().map(|point| normal.dot(&(point - a)));
                assert!(beyond.fold(f64::NEG_INFINITY, f64::max) < 1e-9, "{} is no hull", arm.name);
                let ends = core.ends().map(|end| -normal.dot(&(Vector3::from(end) - a)));
                depth = depth.min(ends[0]).min(ends[1]);
            }
            let room = depth + own.hull.radius() - core.radius();
            assert!(room > -1e-9, "{} link {}: {room} m", arm.name, own.link);
            count += 1;
        }
    }
    assert!(count > 300, "{count}");
}

#[test]
fn hulls_that_are_none_are_refused() {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let outward = vec![[0, 2, 1], [0, 3, 2], [0, 1, 3], [1, 2, 3]];
    let new = |faces: Vec<[u8; 3]>, radius| {
        RoundedHull::new(&corners, faces, radius).map_err(|error| error.to_string())
    };
    new(outward.clone(), 0.1).unwrap();
    assert!(new(vec![[0, 1, 2]], 0.1).unwrap_err().contains("counterclockwise"));
    assert!(new(vec![[0, 1, 9]], 0.1).unwrap_err().contains("corner 9"));
    assert!(new(outward, -1.0).unwrap_err().contains("radius"));
    let many = vec![[0.0; 3]; 257];
    let error = RoundedHull::new(&many, Vec::new(), 0.1).unwrap_err().to_string();
    assert!(error.contains("257 points"), "{error}");
    let hull = RoundedHull::new(&corners, Vec::new(), 0.1).unwrap();
    let body = Body::new(Vec::new(), Vec::new()).unwrap();
    let error = body.with_hulls(vec![LinkHull { link: 2, hull }]).unwrap_err().to_string();
    assert!(error.contains("link 2, which has no capsules"), "{error}");
}
