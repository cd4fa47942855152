//! Laws of bodies and cells: what they call free is free of the public meshes, and distances are
//! the least over all points of a capsule's axis.

use std::collections::BTreeMap;

use crate::common::{Rng, enough};

use irbkin::Pose;
use irbkin::catalog::find;
use irbkin_motion::body::{Body, Capsule, LinkCapsule, Shape};
use irbkin_motion::cell::{Cell, Near};
use irbkin_motion::{AnyArm, Arm, Error};
use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Vector3};

/// Mesh against mesh: `tests/data/collisions.csv`.
const COLLISIONS: &str = include_str!("data/collisions.csv");

/// How much farther than the meshes a capsule may be from the last digit of the file [m].
const PRINTED: f64 = 2e-6;

/// The scene of the file: sizes and places as parts of the reach, roll, pitch and yaw.
pub(crate) fn scene(reach: f64) -> Cell {
    let pose = |xyz: [f64; 3], [roll, pitch, yaw]: [f64; 3]| {
        let place = xyz.map(|part| (part * reach * 1e4).round() / 1e4);
        let turn = Rotation3::from_euler_angles(roll, pitch, yaw);
        IsometryMatrix3::from_parts(Translation3::from(Vector3::from(place)), turn)
    };
    let size = |size: [f64; 3]| size.map(|part: f64| (part * reach * 1e4).round() / 1e4);
    let boxes = [
        ("table", [0.5, 1.0, 0.04], [0.70, 0.0, 0.10], [0.0; 3]),
        ("box1", [0.2, 0.2, 0.3], [0.60, 0.35, 0.27], [0.0; 3]),
        ("box2", [0.15, 0.3, 0.2], [0.55, -0.40, 0.22], [0.0, 0.0, 0.5]),
        ("beam", [0.1, 1.2, 0.1], [0.35, 0.0, 1.20], [0.3, 0.0, 0.2]),
    ];
    let mut obstacles: Vec<(String, Shape)> = boxes
        .into_iter()
        .map(|(name, edges, xyz, turns)| {
            (name.to_owned(), Shape::cuboid(size(edges), &pose(xyz, turns)).unwrap())
        })
        .collect();
    let [radius, length, _] = size([0.08, 1.0, 0.0]);
    let post = Shape::cylinder(radius, length, &pose([-0.50, 0.45, 0.5], [0.0; 3])).unwrap();
    obstacles.push(("post".to_owned(), post));
    Cell::new(obstacles, 0.0).unwrap()
}

/// Collision and least distance of joint angles in a cell.
fn asked(cell: &Cell, robot: &AnyArm, q: &[f64]) -> (bool, f64) {
    fn of<const N: usize>(cell: &Cell, robot: &Arm<N>, q: &[f64]) -> (bool, f64) {
        let q = &q[..N].try_into().unwrap();
        let nearest = cell.nearest(robot, q).unwrap().unwrap();
        (cell.collides(robot, q).unwrap(), nearest.distance)
    }
    match robot {
        AnyArm::Six(robot) => of(cell, robot, q),
        AnyArm::Seven(robot) => of(cell, robot, q),
        AnyArm::Five(robot) => of(cell, robot, q),
    }
}

#[test]
fn two_obstacles_of_one_name_and_names_of_none_are_refused() {
    let ball = || Shape::sphere(0.1, [0.0; 3]).unwrap();
    let named = |names: &[&str]| {
        Cell::new(names.iter().map(|name| ((*name).to_owned(), ball())).collect(), 0.0)
    };
    let twice = named(&["a", "b", "c", "b", "a"]).unwrap_err().to_string();
    assert_eq!(twice, "obstacle 3 has the name of another one: each must have its own");
    let cell = named(&["a", "b"]).unwrap();
    let pairs = [("b", 2), ("a", 1), ("b", 7)];
    let both = cell.clone().with_may_touch(&pairs).unwrap();
    assert_eq!(both.may_touch().collect::<Vec<_>>(), [("a", 1), ("b", 2), ("b", 7)]);
    assert_eq!(cell.clone().with_may_touch::<&str>(&[]).unwrap(), cell);
    let none = cell.with_may_touch(&[("c", 1)]).unwrap_err().to_string();
    assert!(none.contains("no obstacle has the name \"c\", there are: \"a\", \"b\""), "{none}");
}

#[test]
fn no_collision_of_the_meshes_is_missed() {
    let mut counts: BTreeMap<&str, [usize; 4]> = BTreeMap::new();
    for line in COLLISIONS.lines().filter(|line| !line.starts_with('#')).skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let robot = AnyArm::named(fields[0]).unwrap();
        let q: Vec<f64> = fields[1..8].iter().filter_map(|q| q.parse().ok()).collect();
        let number = |at: usize| fields[at].parse::<f64>().unwrap();
        let alone = asked(&Cell::default(), &robot, &q);
        let reach = find(fields[0]).unwrap().reach.unwrap();
        let around = asked(&scene(reach), &robot, &q);
        let [itself, with_scene] =
            [[8, 9], [11, 12]].map(|[hit, apart]| (number(hit) > 0.0, number(apart)));
        let least = itself.1.min(with_scene.1);
        for ((is_hit, apart), (meshes_hit, meshes)) in
            [(alone, itself), (around, (itself.0 || with_scene.0, least))]
        {
            assert!(is_hit || !meshes_hit, "missed: {line}");
            assert!(apart <= meshes + PRINTED, "{apart} m, the meshes {meshes} m: {line}");
        }
        let count = counts.entry(fields[0]).or_default();
        count[0] += 1;
        count[1] += usize::from(itself.0 || with_scene.0);
        count[2] += usize::from(around.0);
        count[3] += usize::from(around.0 && least > 0.025);
    }
    for (name, [all, meshes, capsules, far]) in &counts {
        println!(
            "{name}: {all} postures, meshes touch in {meshes}, capsules in {capsules}, {far} of these more than 25 mm apart"
        );
        assert!(*meshes > 20 && *far * 200 <= *all, "{name}: {far} of {all} false alarms");
    }
    assert_eq!(counts.len(), 6);
}

/// A pose anywhere near.
fn pose(rng: &mut Rng) -> Pose {
    let mut triple =
        || Vector3::new(rng.between(-1.0, 1.0), rng.between(-1.0, 1.0), rng.between(-1.0, 1.0));
    IsometryMatrix3::from_parts(Translation3::from(triple()), Rotation3::new(3.0 * triple()))
}

/// The signed distance of a point outside of a shape, or 0.
fn outside(shape: &Shape, point: &Vector3<f64>) -> f64 {
    let ball = Capsule::new((*point).into(), (*point).into(), 1e-6).unwrap();
    let robot = probe(ball);
    let cell = Cell::new(vec![("shape".to_owned(), shape.clone())], 0.0).unwrap();
    cell.nearest(&robot, &[0.0; 6]).unwrap().unwrap().distance + 1e-6
}

/// An arm whose only capsule is of link 1, in the frame of the world.
fn probe(capsule: Capsule) -> Arm<6> {
    let robot = Arm::<6>::named("UR5e").unwrap();
    let frame = robot.link_frames(&[0.0; 6]).0[0].inverse();
    let ends = capsule.ends().map(|end| {
        <[f64; 3]>::from(frame.rotation * Vector3::from(end) + frame.translation.vector)
    });
    let capsule = Capsule::new(ends[0], ends[1], capsule.radius()).unwrap();
    robot
        .with_body(Some(Body::new(vec![LinkCapsule { link: 1, capsule }], Vec::new()).unwrap()))
        .unwrap()
}

#[test]
fn a_distance_is_the_least_along_the_axis() {
    let mut rng = Rng::new(61);
    for case in 0..120 {
        let near = pose(&mut rng);
        let shape = match case % 4 {
            0 => Shape::cuboid([0.3, 0.5, 0.2], &near),
            1 => Shape::cylinder(0.2, 0.6, &near),
            2 => Shape::half_space([0.3, -0.2, 0.9], near.translation.vector.into()),
            _ => Shape::capsule([0.1, 0.2, 0.3], near.translation.vector.into(), 0.1),
        }
        .unwrap();
        let [a, b] = [pose(&mut rng), pose(&mut rng)].map(|end| end.translation.vector);
        let radius = 0.05;
        let capsule = Capsule::new(a.into(), b.into(), radius).unwrap();
        let cell = Cell::new(vec![("shape".to_owned(), shape.clone())], 0.0).unwrap();
        let found = cell.nearest(&probe(capsule), &[0.0; 6]).unwrap().unwrap();
        let parts = (0..=400).map(|part| f64::from(part) / 400.0);
        let least =
            parts.map(|part| outside(&shape, &(a + (b - a) * part))).fold(f64::INFINITY, f64::min);
        let off = least - radius - found.distance;
        assert!((-1e-6..5e-3).contains(&off), "case {case}: off by {off}");
        assert_eq!((found.link, &found.near), (1, &Near::Obstacle("shape".to_owned())));
        if found.distance > 1e-3 {
            let [from, to] = found.points.map(Vector3::from);
            assert!(((from - to).norm() - found.distance).abs() < 1e-6, "case {case}");
        }
    }
}

#[test]
fn margins_move_the_answer_and_bad_shapes_are_named() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let q = [0.0; 6];
    let floor = |margin: f64| {
        let floor = Shape::half_space([0.0, 0.0, 1.0], [0.0, 0.0, -0.5]).unwrap();
        Cell::new(vec![("floor".to_owned(), floor)], margin).unwrap()
    };
    let free = floor(0.0).nearest(&robot, &q).unwrap().unwrap();
    assert!(!floor(0.0).collides(&robot, &q).unwrap());
    let mut margins = (0..60).map(|step| f64::from(step) * 0.02);
    let first = margins.find(|margin| floor(*margin).collides(&robot, &q).unwrap());
    assert!(first.is_some_and(|margin| margin >= free.distance));
    let message = |error: Error| error.to_string();
    assert!(message(Shape::sphere(0.0, [0.0; 3]).unwrap_err()).contains("radius is 0"));
    assert!(message(Shape::half_space([0.0; 3], [0.0; 3]).unwrap_err()).contains("normal"));
    assert!(
        message(Shape::cuboid([1.0, f64::NAN, 1.0], &Pose::identity()).unwrap_err())
            .contains("size is NaN")
    );
    let bare = robot.clone().with_body(None).unwrap();
    assert!(message(floor(0.0).collides(&bare, &q).unwrap_err()).contains("with_body"));
    assert!(message(floor(0.0).collides(&robot, &[f64::NAN; 6]).unwrap_err()).contains('q'));
    let capsule = Capsule::new([0.0; 3], [0.0, 0.0, 1.0], 0.1).unwrap();
    let of_link = |link| Body::new(vec![LinkCapsule { link, capsule }], Vec::new()).unwrap();
    assert!(message(bare.with_body(Some(of_link(8))).unwrap_err()).contains("link 8"));
    let pair = Body::new(vec![LinkCapsule { link: 1, capsule }], vec![[1, 2]]);
    assert!(message(pair.unwrap_err()).contains("links 1 and 2"));
}

#[test]
fn standing_arms_and_pairs_that_may_touch_are_kept() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let beside = IsometryMatrix3::from_parts(
        Translation3::new(0.0, 1.2, 0.0),
        Rotation3::from_euler_angles(0.0, 0.0, -1.5),
    );
    let left = Arm::<6>::named("UR5e").unwrap();
    let left = left.map(|robot| robot.with_base(&beside)).unwrap();
    let corners = [[0.0; 3], [0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0, 0.0, 0.3]];
    let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]].map(|face| face.map(|at| corners[at]));
    let place = Pose::translation(0.6, -0.3, 0.4);
    let obstacles = vec![
        ("hull".to_owned(), Shape::convex(&corners, &place).unwrap()),
        ("mesh".to_owned(), Shape::mesh(&faces, true, &place).unwrap()),
        ("scan".to_owned(), Shape::points(&corners, 0.05, &place).unwrap()),
    ];
    let cell = Cell::new(obstacles, 0.01).unwrap();
    let cell = cell.with_may_touch(&[("mesh", 6)]).unwrap();
    let cell = cell.with_robot("left", &left, &[0.1, -1.2, 1.4, 0.2, 0.3, 0.0]).unwrap();
    let cell = cell.with_may_touch(&[("left, link 6", 4)]).unwrap();
    let pairs: Vec<_> = cell.may_touch().collect();
    assert_eq!(pairs, [("mesh", 6), ("left, link 6", 4)]);
    let again: Cell = serde_json::from_str(&serde_json::to_string(&cell).unwrap()).unwrap();
    assert_eq!(again, cell);
    let mut rng = Rng::new(62);
    let (mut seen, mut hits) = (BTreeMap::new(), 0);
    for _ in 0..1500 {
        let q = rng.inside(robot.limits());
        let nearest = cell.nearest(&robot, &q).unwrap().unwrap();
        assert_eq!(again.nearest(&robot, &q).unwrap().unwrap(), nearest);
        let collides = cell.collides(&robot, &q).unwrap();
        let alone = Cell::default().collides(&robot, &q).unwrap();
        if let Near::Obstacle(name) = nearest.near {
            assert_eq!(collides, alone || nearest.distance <= 0.01 + 1e-9, "{q:?}");
            assert!((&*name, nearest.link) != ("mesh", 6));
            *seen.entry(name).or_insert(0) += 1;
        }
        hits += usize::from(collides && !alone);
    }
    assert!(enough(hits > 100 && seen.len() > 6), "{hits} hits, {seen:?}");
    let message = |pairs| cell.clone().with_may_touch(&[pairs]).unwrap_err().to_string();
    assert!(
        message(("mseh", 6)).contains("no obstacle has the name \"mseh\", there are: \"hull\"")
    );
    assert!(message(("mesh", 0)).contains("no link 0"));
    let twice = cell.with_robot("left", &left, &[0.0; 6]).unwrap_err().to_string();
    assert!(twice.contains("name of another"), "{twice}");
}

/// Obstacles of each kind at random places, more than a meter away mostly.
fn crowd(rng: &mut Rng, count: usize) -> Vec<(String, Shape)> {
    let shape = |number: usize, rng: &mut Rng| {
        let mut pose = pose(rng);
        pose.translation.vector *= 2.0;
        match number % 4 {
            0 => Shape::cuboid([0.02, 0.03, 0.2], &pose),
            1 => Shape::cylinder(0.01, 0.1, &pose),
            2 => Shape::sphere(0.02, pose.translation.vector.into()),
            _ => Shape::points(&[[0.0; 3], [0.1, 0.0, 0.0]], 0.01, &pose),
        }
        .unwrap()
    };
    let mut all: Vec<_> =
        (0..count).map(|number| (number.to_string(), shape(number, rng))).collect();
    // Every tenth is a part of a union.
    let parts = all.iter().step_by(10).map(|(_, shape)| shape.clone()).collect();
    all.push(("union".to_owned(), Shape::union(parts).unwrap()));
    all.push(("floor".to_owned(), Shape::half_space([0.0, 0.0, 1.0], [0.0, 0.0, -1.2]).unwrap()));
    all
}

/// The law of a tree over obstacles: a cell of thousands answers as its obstacles by fours.
#[test]
fn a_crowded_cell_answers_as_its_obstacles_few_by_few() {
    let mut rng = Rng::new(72);
    let arm = Arm::<6>::named("UR5e").unwrap();
    for count in [50, 400, 10_000] {
        let obstacles = crowd(&mut rng, count);
        let crowded = Cell::new(obstacles.clone(), 0.003).unwrap();
        let few: Vec<_> =
            obstacles.chunks(3).map(|some| Cell::new(some.to_vec(), 0.003).unwrap()).collect();
        let (mut touching, mut nears) = (0, 0);
        for _ in 0..24 {
            let q = rng.angles::<6>();
            let touches = few.iter().any(|cell| cell.collides(&arm, &q).unwrap());
            assert_eq!(crowded.collides(&arm, &q).unwrap(), touches, "{count}: {q:?}");
            let rows = [q, q.map(|angle| angle + 0.01), q].concat();
            let mut collides = [false; 3];
            let batch = &mut irbkin::batch::Batch::new(None);
            crowded.collides_batch(batch, &arm, &rows, &mut collides).unwrap();
            assert_eq!([collides[0], collides[2]], [touches; 2], "{count}: {q:?}");
            let way = [q, q.map(|angle| angle + 0.02)];
            let is_free = crowded.check_path(&arm, &way).unwrap().is_none();
            let each = few.iter().all(|cell| cell.check_path(&arm, &way).unwrap().is_none());
            assert_eq!(is_free, each, "{count}: {q:?}");
            let found = crowded.nearest(&arm, &q).unwrap().unwrap();
            let least = few
                .iter()
                .map(|cell| cell.nearest(&arm, &q).unwrap().unwrap().distance)
                .fold(f64::INFINITY, f64::min);
            assert!((found.distance - least).abs() < 1e-12, "{count}: {found:?} {least}");
            touching += usize::from(touches);
            nears += usize::from(matches!(found.near, Near::Obstacle(_)));
        }
        println!("{count}: {touching} touch, {nears} are nearest to an obstacle");
        assert!(nears > 0, "{count}");
    }
}
