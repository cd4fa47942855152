//! Laws of shapes: no distance is above the true one, trees answer as all items do, what is inside
//! a solid touches it.

use alloc::string::ToString;
use alloc::vec::Vec;

use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Vector3};

use super::capsule::Capsule;
use super::mesh::Mesh;
use super::segment::{NOWHERE, Nearest, Segment, at, between, nearer, part_near};
use super::solid::Shape;
use super::triangle::{Triangle, segment_and};
use crate::rng::Rng;
use irbkin::{Interrupt, Pose};

/// How far above the true one a distance may be [m].
const ABOVE: f64 = 1e-9;

fn triple(rng: &mut Rng, size: f64) -> Vector3<f64> {
    Vector3::from([0; 3].map(|_| rng.between(-size, size)))
}

fn pose(rng: &mut Rng) -> Pose {
    let turn = Rotation3::new(triple(rng, 3.0));
    IsometryMatrix3::from_parts(Translation3::from(triple(rng, 0.5)), turn)
}

fn capsule(rng: &mut Rng, size: f64, radius: f64) -> Capsule {
    Capsule::new(triple(rng, size).into(), triple(rng, size).into(), radius).unwrap()
}

/// The least value of a convex function of a number from 0 to 1.
fn least(of: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..70 {
        let [one, two] = [1.0, 2.0].map(|thirds| low + (high - low) * thirds / 3.0);
        if of(one) < of(two) { high = two } else { low = one }
    }
    of(0.5 * (low + high)).min(of(0.0)).min(of(1.0))
}

/// The distance of a segment and a triangle by search, not by cases.
fn searched([a, b, c]: &Triangle, segment: &Segment) -> f64 {
    least(|along| {
        let from = at(segment, along);
        least(|part| {
            let (left, right) = (a + (b - a) * part, a + (c - a) * part);
            let across = [left, right];
            (from - at(&across, part_near(&across, &from))).norm()
        })
    })
}

#[test]
fn a_triangle_is_as_near_as_a_search_finds_it() {
    let mut rng = Rng::new(1);
    for case in 0..400 {
        let [a, b] = [triple(&mut rng, 1.0), triple(&mut rng, 1.0)];
        let mut c = triple(&mut rng, 1.0);
        let mut ends = [triple(&mut rng, 1.0), triple(&mut rng, 1.0)];
        match case % 8 {
            // Nearly a line, along a direction or to one of the corners.
            1 => c = a + (b - a) * 0.4 + triple(&mut rng, 10.0_f64.powi(-(case % 11))),
            2 => c = b + triple(&mut rng, 10.0_f64.powi(-(case % 13))),
            3 => c = b,
            // A segment nearly along an edge, through it, or in the plane.
            4 => ends = [a, b].map(|end| end + triple(&mut rng, 10.0_f64.powi(-(case % 13)))),
            5 => ends[0] = a + (b - a) * 0.3,
            6 => ends = [0.3, -0.8].map(|part| a + (b - a) * part + (c - a) * 0.4),
            7 => ends[1] = ends[0],
            _ => {}
        }
        let (square, [from, to]) = segment_and(&[a, b, c], &ends);
        let true_one = searched(&[a, b, c], &ends);
        let off = square.sqrt() - true_one;
        assert!(off.abs() <= ABOVE, "case {case}: {square} is off by {off}");
        assert!((from - at(&ends, part_near(&ends, &from))).norm() < 1e-12);
        assert!(searched(&[a, b, c], &[to, to]) < ABOVE, "case {case}: not on the triangle");
    }
}

#[test]
fn nearly_parallel_segments_are_as_near_as_they_are() {
    let mut rng = Rng::new(2);
    for case in 0..300 {
        let [a, b] = [triple(&mut rng, 1.0), triple(&mut rng, 1.0)];
        // They cross in their middles, at a small angle.
        let middle = 0.5 * (a + b);
        let turned = (b - a) + triple(&mut rng, 10.0_f64.powi(-(case % 12)));
        let other = [middle - turned * 0.4, middle + turned * 0.5];
        let (square, _) = between(&[a, b], &other);
        assert!(square.sqrt() < 1e-14, "case {case}: {}", square.sqrt());
    }
}

/// The faces of a box around the origin, seen from outside counterclockwise.
fn box_mesh(half: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let corner = |index: usize| {
        [0, 1, 2].map(|axis| if index >> axis & 1 == 1 { half[axis] } else { -half[axis] })
    };
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
    quads.into_iter().flat_map(halves).map(|corners| corners.map(corner)).collect()
}

/// A torus around z, of radii 0.5 and 0.2.
fn torus(steps: u32) -> Vec<[[f64; 3]; 3]> {
    let place = |i: u32, j: u32| {
        let [a, b] =
            [i, j].map(|at| core::f64::consts::TAU * f64::from(at % steps) / f64::from(steps));
        let out = 0.5 + 0.2 * b.cos();
        [out * a.cos(), out * a.sin(), 0.2 * b.sin()]
    };
    let mut triangles = Vec::new();
    for (i, j) in (0..steps).flat_map(|i| (0..steps).map(move |j| (i, j))) {
        let [a, b, c, d] = [place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    triangles
}

fn moved(triangles: &[[[f64; 3]; 3]], by: [f64; 3]) -> Vec<[[f64; 3]; 3]> {
    let by = Vector3::from(by);
    let all = triangles.iter();
    all.map(|corners| corners.map(|corner| (Vector3::from(corner) + by).into())).collect()
}

fn distance(shape: &Shape, capsule: &Capsule) -> f64 {
    shape.separation(capsule).distance
}

fn ball(center: [f64; 3]) -> Capsule {
    Capsule::new(center, center, 1e-3).unwrap()
}

#[test]
fn a_mesh_and_a_cloud_are_as_near_as_all_their_items() {
    let mut rng = Rng::new(3);
    let triangles = torus(40);
    let mesh = Mesh::new(&triangles, false, Interrupt::none()).unwrap();
    let points: Vec<[f64; 3]> = (0..3000).map(|_| triple(&mut rng, 1.0).into()).collect();
    let cloud = super::cloud::Cloud::new(&points, 0.01, Interrupt::none()).unwrap();
    for _ in 0..300 {
        let own = capsule(&mut rng, 1.0, 0.05);
        let all =
            triangles.iter().map(|corners| segment_and(&corners.map(Vector3::from), &own.ends));
        let least = all.map(|(square, _)| square).fold(f64::INFINITY, f64::min);
        assert_eq!(mesh.separation(&own).distance.to_bits(), (least.sqrt() - 0.05).to_bits());
        let nearest: Nearest = points.iter().fold(NOWHERE, |nearest, point| {
            let point = Vector3::from(*point);
            nearer(nearest, at(&own.ends, part_near(&own.ends, &point)), point)
        });
        let found = cloud.separation(&own).distance;
        assert_eq!(found.to_bits(), (nearest.0.sqrt() - 0.05 - 0.01).to_bits());
        for limit in [found, found - 1e-15, found + 1e-15] {
            assert_eq!(cloud.is_within(&own, limit), found <= limit);
        }
        let found = mesh.separation(&own).distance;
        for limit in [found, found - 1e-15, found + 1e-15] {
            assert_eq!(mesh.is_within(&own, limit), found <= limit);
        }
    }
}

/// The faces of the hull of a few points: triangles with all points on one side.
fn hull_faces(points: &[Vector3<f64>]) -> Vec<(Triangle, Vector3<f64>)> {
    let mut faces = Vec::new();
    for (i, a) in points.iter().enumerate() {
        for (j, b) in points.iter().enumerate().skip(i + 1) {
            for c in points.iter().skip(j + 1) {
                let normal = (b - a).cross(&(c - a)).normalize();
                let sides = points.iter().map(|point| normal.dot(&(point - a)));
                let [low, high] =
                    sides.fold([0.0_f64; 2], |[low, high], side| [low.min(side), high.max(side)]);
                if high < 1e-12 || low > -1e-12 {
                    let out = if high < 1e-12 { normal } else { -normal };
                    faces.push(([*a, *b, *c], out));
                }
            }
        }
    }
    faces
}

#[test]
fn a_hull_is_as_near_as_its_faces() {
    let mut rng = Rng::new(4);
    let (mut touching, mut free) = (0, 0);
    for case in 0..1500 {
        let count = 4 + case % 9;
        // Thick ones, flat ones, and such with points on a grid, of which many are in one plane.
        let points: Vec<Vector3<f64>> = (0..count)
            .map(|_| {
                let mut point = triple(&mut rng, 0.5);
                match case % 3 {
                    1 => point.z *= 10.0_f64.powi(-(case % 5)),
                    2 => point = (point * 4.0).map(f64::round) * 0.25,
                    _ => {}
                }
                point
            })
            .collect();
        let rows: Vec<[f64; 3]> = points.iter().map(|point| (*point).into()).collect();
        let Ok(shape) = Shape::convex(&rows, &Pose::identity()) else { continue };
        let mut own = capsule(&mut rng, 0.7, 0.01);
        if case % 6 == 5 {
            own.ends = own.ends.map(|end| (end * 4.0).map(f64::round) * 0.25);
        }
        let faces = hull_faces(&points);
        let inside = faces.iter().all(|([a, ..], out)| out.dot(&(own.ends[0] - a)) <= 0.0);
        let surface = faces.iter().map(|(face, _)| segment_and(face, &own.ends).0);
        let true_one = if inside { 0.0 } else { surface.fold(f64::INFINITY, f64::min).sqrt() };
        let found = shape.separation(&own);
        let off = found.distance + 0.01 - true_one;
        assert!((-1e-9..=ABOVE).contains(&off), "case {case}: {true_one} m, off by {off}");
        if true_one > 1e-9 {
            let [from, to] = found.points;
            assert!(((from - to).norm() - found.distance.abs()).abs() < 1e-7, "case {case}");
            free += 1;
        } else {
            touching += 1;
        }
    }
    assert!(touching > 200 && free > 200, "{touching} touch, {free} are free");
}

#[test]
fn boxes_hulls_and_meshes_of_boxes_agree() {
    let mut rng = Rng::new(5);
    for case in 0..600 {
        let half = [0; 3].map(|_| rng.between(0.01, 0.5));
        let place = pose(&mut rng);
        let triangles = box_mesh(half);
        let solid = Shape::mesh(&triangles, true, &place).unwrap();
        let hull = Shape::convex(triangles.as_flattened(), &place).unwrap();
        let cuboid = Shape::cuboid(half.map(|half| 2.0 * half), &place).unwrap();
        let own = capsule(&mut rng, if case % 2 == 0 { 1.0 } else { 0.4 }, 0.02);
        let [one, two, three] = [&solid, &hull, &cuboid].map(|shape| distance(shape, &own));
        assert!((one - two).abs() < ABOVE, "case {case}: mesh {one}, hull {two}");
        assert!((one - three).abs() < 1.1e-7, "case {case}: mesh {one}, box {three}");
        let back = pose(&mut rng);
        for shape in [&solid, &hull, &cuboid] {
            let there = distance(&shape.moved(&back).unwrap(), &own.moved(&back));
            assert!((there - distance(shape, &own)).abs() < 1.1e-7, "case {case}");
            for limit in [0.0, 0.1, 0.2] {
                let is_near = distance(shape, &own) <= limit;
                assert_eq!(shape.is_within(&own, limit), is_near, "case {case}");
            }
        }
        let both = Shape::union(vec![solid, Shape::sphere(0.1, [0.3; 3]).unwrap()]).unwrap();
        let ball = Shape::sphere(0.1, [0.3; 3]).unwrap();
        assert_eq!(distance(&both, &own), one.min(distance(&ball, &own)));
    }
}

#[test]
fn what_is_wholly_inside_a_solid_touches_it() {
    let mut rng = Rng::new(6);
    let ring = Shape::mesh(&torus(30), true, &Pose::identity()).unwrap();
    let surface = Shape::mesh(&torus(30), false, &Pose::identity()).unwrap();
    // 30 chords of a circle of 0.7 m and of 0.2 m are less than 5 mm inside of it together.
    let mut counts = [0; 2];
    for _ in 0..4000 {
        let point = triple(&mut rng, 0.75).component_mul(&Vector3::new(1.0, 1.0, 0.4));
        let from_ring = (point.x.hypot(point.y) - 0.5).hypot(point.z);
        let found = distance(&ring, &ball(point.into()));
        if from_ring > 0.2 {
            assert!(found > 0.0 || from_ring < 0.202, "{point} touches");
            counts[0] += 1;
        } else if from_ring < 0.195 {
            assert_eq!(found, -1e-3, "{point} is free");
            assert!(from_ring > 0.19 || distance(&surface, &ball(point.into())) > 0.0);
            counts[1] += 1;
        }
    }
    assert!(counts.iter().all(|count| *count > 500), "{counts:?}");
}

#[test]
fn points_behind_corners_and_edges_are_inside_or_outside_too() {
    let solid = Shape::mesh(&box_mesh([0.5; 3]), true, &Pose::identity()).unwrap();
    let ways = [[0.531, 0.283, 0.798], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]];
    for way in ways.map(Vector3::from) {
        for corner in box_mesh([0.5; 3]).as_flattened() {
            let corner = Vector3::from(*corner);
            for back in [-0.7, -0.31, 0.31, 0.7] {
                let point = corner + way * back;
                let is_inside = point.amax() <= 0.5;
                let found = distance(&solid, &ball(point.into()));
                assert_eq!(found < 0.0, is_inside || point.amax() < 0.501, "{point}");
            }
        }
    }
}

#[test]
fn overlapping_solids_are_full_and_rooms_are_empty() {
    let cube = box_mesh([0.5; 3]);
    let two = [cube.clone(), moved(&cube, [0.3, 0.2, 0.1])].concat();
    let overlap = Shape::mesh(&two, true, &Pose::identity()).unwrap();
    for center in [[0.2, 0.1, 0.0], [-0.3, 0.0, 0.0], [0.6, 0.5, 0.4]] {
        assert_eq!(distance(&overlap, &ball(center)), -1e-3);
    }
    let mut wall = box_mesh([0.4; 3]);
    for corners in &mut wall {
        corners.swap(1, 2);
    }
    let room = Shape::mesh(&[cube, wall].concat(), true, &Pose::identity()).unwrap();
    assert!((distance(&room, &ball([0.0; 3])) - 0.399).abs() < ABOVE);
    assert_eq!(distance(&room, &ball([0.45, 0.0, 0.0])), -1e-3);
}

/// Triangles each of whose corners is off by up to `by` [m].
fn parted(triangles: &[[[f64; 3]; 3]], by: f64, rng: &mut Rng) -> Vec<[[f64; 3]; 3]> {
    let off = |rng: &mut Rng| triple(rng, 1.0).normalize() * (by * rng.between(0.0, 1.0));
    let all = triangles.iter();
    let mut corner = |own: [f64; 3]| (Vector3::from(own) + off(rng)).into();
    all.map(|corners| corners.map(&mut corner)).collect()
}

#[test]
fn corners_within_a_micrometer_are_one() {
    let mut rng = Rng::new(7);
    let ring = torus(30);
    let whole = Shape::mesh(&ring, true, &Pose::identity()).unwrap();
    for (size, by) in [(1.0, 1e-15), (1.0, 2e-9), (1.0, 4.9e-7), (20.0, 6e-6)] {
        let scale = |corners: &[[f64; 3]; 3]| corners.map(|corner| corner.map(|it| size * it));
        let parted = parted(&ring.iter().map(scale).collect::<Vec<_>>(), by, &mut rng);
        let mesh = Mesh::new(&parted, true, Interrupt::none()).unwrap();
        let again = Mesh::new(&mesh.triangles().collect::<Vec<_>>(), true, Interrupt::none());
        assert_eq!(again.unwrap(), mesh);
        for (kept, given) in mesh.triangles().zip(&parted) {
            for (kept, given) in kept.iter().zip(given) {
                assert!((Vector3::from(*kept) - Vector3::from(*given)).norm() <= 2.0 * by);
            }
        }
        for _ in 0..300 {
            let own = capsule(&mut rng, 0.9, 0.05);
            let [a, b] = own.ends.map(|end| (end * size).into());
            let large = Capsule::new(a, b, 0.05 * size).unwrap();
            let (one, other) = (mesh.separation(&large).distance, distance(&whole, &own) * size);
            // A corner is off by itself and by the weld.
            assert!(
                (one - other).abs() <= 3.0 * by + ABOVE,
                "size {size}, by {by}: {one}, {other}"
            );
        }
    }
    let fault = Shape::mesh(&parted(&ring, 4e-6, &mut rng), true, &Pose::identity()).unwrap_err();
    assert!(fault.to_string().contains("open, by more than a micrometer"), "{fault}");
}

#[test]
fn a_closed_mesh_keeps_its_corners() {
    // Its edges are shorter than what makes corners one.
    let small: Vec<_> =
        torus(30).iter().map(|row| row.map(|point| point.map(|it| 2e-5 * it))).collect();
    let mesh = Mesh::new(&small, true, Interrupt::none()).unwrap();
    assert!(mesh.triangles().zip(small).all(|(kept, given)| kept == given));
}

#[test]
fn shapes_that_cannot_be_are_named() {
    let none = Pose::identity();
    let cube = box_mesh([0.5; 3]);
    let mut flipped = cube.clone();
    flipped[3].swap(0, 1);
    let sheet = [
        [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    ];
    let large = moved(&cube, [400.0, 0.0, 0.0]);
    let corners = |rows: &[[[f64; 3]; 3]]| rows.as_flattened().to_vec();
    let flat: Vec<_> = corners(&cube).iter().map(|[x, y, _]| [*x, *y, 0.25]).collect();
    let cases = [
        (Shape::mesh(&cube[1..], true, &none), "belongs to one triangle only"),
        (Shape::mesh(&cube[1..], true, &none), "solid=False"),
        (Shape::mesh(&flipped, true, &none), "face opposite sides"),
        (Shape::mesh(&[&cube[..], &cube[..1]].concat(), true, &none), "3 triangles"),
        (Shape::mesh(&sheet, true, &none), "no volume"),
        (Shape::mesh(&[], false, &none), "triangles has 0 points, it must have 3"),
        (Shape::mesh(&[&cube[..], &large].concat(), true, &none), "in millimeters"),
        (Shape::mesh(&[[[f64::NAN; 3]; 3]], false, &none), "point 0 has the coordinate NaN"),
        (Shape::convex(&flat, &none), "in a plane"),
        (Shape::convex(&[[1.0; 3]; 9], &none), "in a plane"),
        (Shape::convex(&[[0.0; 3]; 3], &none), "3 points, it must have 4"),
        (Shape::points(&[], 0.1, &none), "0 points"),
        (Shape::points(&[[0.0; 3]], 0.0, &none), "radius is 0"),
        (Shape::points(&[[2e6; 3]], 0.1, &none), "meters?"),
        (Shape::union(vec![]), "no shape"),
    ];
    for (shape, words) in cases {
        let message = shape.unwrap_err().to_string();
        assert!(message.contains(words), "{message} has not: {words}");
    }
}
