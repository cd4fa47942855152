//! Laws of motions in a cell: what is proven free is free at every instant, whatever is tried to
//! refute it, and a contact is where it is said to be.

use crate::common::{Rng, enough};

use irbkin::Pose;
use irbkin_motion::body::{Body, Shape};
use irbkin_motion::cell::{Cell, Contact, Near, RESOLUTION};
use irbkin_motion::trajectory::{SplineKind, spline};
use irbkin_motion::{AnyArm, Arm};
use nalgebra::{IsometryMatrix3, Rotation3, Translation3, Vector3};

/// Arms: open ones, one with coupled axes and rods beside it, one with seven joints.
const ARMS: [&str; 5] = ["IRB 1200-5/0.9", "UR5e", "IRB 2400-12/1.55", "IRB 6700-200/2.6", "Panda"];

/// Postures at which a motion that is called free is looked at.
const INSTANTS: u32 = 400;

fn on_arms(mut work: impl FnMut(&AnyArm, &mut Rng)) {
    for (seed, name) in (71..).zip(ARMS) {
        work(&AnyArm::named(name).unwrap(), &mut Rng::new(seed));
    }
}

fn any_joints<const N: usize>(robot: &Arm<N>, rng: &mut Rng) -> [f64; N] {
    rng.inside(robot.limits())
}

/// How deep the arm is in anything, by the distances of its capsules; only an arm without pairs of
/// links has a margin, for its nearest is an obstacle.
fn depth<const N: usize>(cell: &Cell, robot: &Arm<N>, q: &[f64; N]) -> f64 {
    cell.nearest(robot, q).unwrap().map_or(-1.0, |near| cell.margin() - near.distance)
}

/// Obstacles of all kinds, somewhere near.
fn any_cell<const N: usize>(robot: &Arm<N>, rng: &mut Rng) -> Cell {
    let pose = |rng: &mut Rng| {
        let mut triple = |most: f64| Vector3::from([0; 3].map(|_| rng.between(-most, most)));
        let place = triple(1.0) + Vector3::z() * 0.5;
        let turn = Rotation3::new(triple(3.0));
        Pose::from(IsometryMatrix3::from_parts(Translation3::from(place), turn))
    };
    let size = |rng: &mut Rng| rng.between(0.02, 0.3);
    let mut obstacles = Vec::new();
    for number in 0..3 {
        let (near, end) = (pose(rng), pose(rng).translation.vector);
        let shapes = [
            Shape::cuboid([size(rng), size(rng), size(rng)], &near),
            Shape::cylinder(size(rng), size(rng), &near),
            Shape::sphere(0.5 * size(rng), near.translation.vector.into()),
            Shape::capsule(near.translation.vector.into(), end.into(), 0.2 * size(rng)),
        ];
        for (kind, shape) in shapes.into_iter().enumerate() {
            obstacles.push((format!("{kind} {number}"), shape.unwrap()));
        }
    }
    let floor = Shape::half_space([0.0, 0.1, 1.0], [0.0, 0.0, -0.3]).unwrap();
    obstacles.push(("floor".to_owned(), floor));
    // A part of them, so that some motions are free.
    obstacles.retain(|_| rng.between(0.0, 1.0) < 0.4);
    let margin = if robot.body().unwrap().pairs().is_empty() { 0.02 } else { 0.0 };
    Cell::new(obstacles, margin).unwrap()
}

fn each<const N: usize>(robot: &Arm<N>, rng: &mut Rng) -> [usize; 2] {
    let mut count = [0; 2];
    for _ in 0..60 {
        let cell = any_cell(robot, rng);
        for q in [0; 8].map(|_| any_joints(robot, rng)) {
            let deep = depth(&cell, robot, &q);
            assert_eq!(cell.collides(robot, &q).unwrap(), deep >= -1e-9, "{deep}");
            count[usize::from(deep >= 0.0)] += 1;
        }
    }
    count
}

#[test]
fn a_posture_collides_where_its_distance_says_so() {
    on_arms(|robot, rng| {
        let [free, colliding] = match robot {
            AnyArm::Six(robot) => each(robot, rng),
            AnyArm::Seven(robot) => each(robot, rng),
            AnyArm::Five(robot) => each(robot, rng),
        };
        assert!(enough(free > 40 && colliding > 40), "{free} free, {colliding} not");
    });
}

/// Compare gradients with differences; how many were compared.
fn gradients<const N: usize>(robot: &Arm<N>, rng: &mut Rng) -> usize {
    const STEP: f64 = 1e-6;
    let mut compared = 0;
    for _ in 0..80 {
        let cell = any_cell(robot, rng);
        let q = any_joints(robot, rng);
        let Some(nearest) = cell.nearest(robot, &q).unwrap() else { continue };
        let gradient = nearest.gradient(robot, &q);
        // Not within a step of where another pair, or another point, is the nearest.
        let mut is_smooth = nearest.distance > 1e-3;
        let slopes: [f64; N] = std::array::from_fn(|joint| {
            let at = |step: f64| {
                let mut moved = q;
                moved[joint] += step;
                cell.nearest(robot, &moved).unwrap().unwrap().distance
            };
            let [before, after] = [at(-STEP), at(STEP)];
            is_smooth &= (before + after - 2.0 * nearest.distance).abs() < 1e-9;
            (after - before) / (2.0 * STEP)
        });
        if is_smooth {
            let off = slopes.iter().zip(gradient).map(|(a, b)| (a - b).abs());
            let most = off.fold(0.0, f64::max);
            assert!(most < 1e-3, "{most}: {slopes:?} {gradient:?} {nearest:?}");
            compared += 1;
        }
    }
    compared
}

#[test]
fn a_gradient_is_the_slope_of_the_distance() {
    on_arms(|robot, rng| {
        let compared = match robot {
            AnyArm::Six(robot) => gradients(robot, rng),
            AnyArm::Seven(robot) => gradients(robot, rng),
            AnyArm::Five(robot) => gradients(robot, rng),
        };
        assert!(enough(compared > 20), "{compared} compared");
    });
}

/// Compare an answer with postures along the motion.
fn compare<const N: usize>(
    cell: &Cell,
    robot: &Arm<N>,
    found: Option<&Contact<N>>,
    at: &dyn Fn(f64) -> [f64; N],
    end: f64,
) {
    let until = found.map_or(end, |contact| contact.at);
    if until < 1e-3 {
        assert!(depth(cell, robot, &at(0.0)) > -1e-2);
        return;
    }
    for instant in 0..=INSTANTS {
        let time = until * f64::from(instant) / f64::from(INSTANTS);
        let deep = depth(cell, robot, &at(time));
        let most = if found.is_some() { 2.0 * RESOLUTION } else { 0.0 };
        assert!(deep <= most, "{deep} m deep at {time}, {found:?}");
    }
    if let Some(contact) = found {
        let deep = depth(cell, robot, &contact.q);
        assert!(deep.abs() <= 2.0 * RESOLUTION, "{deep} m at {contact:?}");
        assert!(contact.depth >= deep - 1e-9);
        let own = at(contact.at);
        assert!(own.iter().zip(contact.q).all(|(a, b)| (a - b).abs() < 1e-3));
    }
}

/// Joint paths and trajectories of an arm; how many are free and how many are not.
fn paths<const N: usize>(robot: &Arm<N>, rng: &mut Rng) -> [usize; 2] {
    let mut count = [0; 2];
    for _ in 0..40 {
        let cell = any_cell(robot, rng);
        let from = any_joints(robot, rng);
        let part = rng.between(0.02, 0.5);
        let rows = [0; 3].map(|_| {
            let to = any_joints(robot, rng);
            std::array::from_fn(|joint| from[joint] + part * (to[joint] - from[joint]))
        });
        let found = cell.check_path(robot, &rows).unwrap();
        let at = |time: f64| {
            let piece = usize::from(time > 1.0);
            let part = time - f64::from(u8::from(time > 1.0));
            std::array::from_fn(|joint| {
                rows[piece][joint] + part * (rows[piece + 1][joint] - rows[piece][joint])
            })
        };
        compare(&cell, robot, found.as_ref(), &at, 2.0);
        count[usize::from(found.is_some())] += 1;
        let motion = spline(SplineKind::Cubic, rows.as_flattened(), N, &[0.0, 0.7, 1.5]).unwrap();
        let found = cell.check_trajectory(robot, &motion).unwrap();
        let at = |time: f64| {
            let (mut q, mut rest) = ([0.0; N], [[0.0; N]; 2]);
            let [dq, ddq] = &mut rest;
            motion.sample(&[time], &mut q, dq, ddq).unwrap();
            q
        };
        compare(&cell, robot, found.as_ref(), &at, motion.duration());
        count[usize::from(found.is_some())] += 1;
    }
    count
}

#[test]
fn a_motion_is_free_until_its_contact() {
    on_arms(|robot, rng| {
        let [free, touching] = match robot {
            AnyArm::Six(robot) => paths(robot, rng),
            AnyArm::Seven(robot) => paths(robot, rng),
            AnyArm::Five(robot) => paths(robot, rng),
        };
        assert!(enough(free > 4 && touching > 10), "{free} free, {touching} not");
    });
}

/// A point of a link, and how far all around it belongs to the link: a corner of a hull, which the
/// capsules contain too, or a point of the axis of a capsule.
fn any_point(body: &Body, rng: &mut Rng) -> (usize, Vector3<f64>, f64) {
    let mut any = |count: usize| usize::try_from(rng.bits()).unwrap() % count;
    if !body.hulls().is_empty() {
        let own = &body.hulls()[any(body.hulls().len())];
        let points: Vec<_> = own.hull.points().collect();
        return (own.link, points[any(points.len())].into(), 0.0);
    }
    let own = body.capsules()[any(body.capsules().len())];
    let [a, b] = own.capsule.ends().map(Vector3::from);
    (own.link, a + (b - a) * rng.unit(), own.capsule.radius())
}

/// Put a small ball where a link passes at one instant, and see whether it is found. Half of the
/// motions are of one joint, and their ball is just where the link arrives: no bound below the true
/// motion passes that.
fn refute<const N: usize>(robot: &Arm<N>, rng: &mut Rng) {
    let mut tried = 0;
    while tried < 80 {
        let [from, to] = [any_joints(robot, rng), any_joints(robot, rng)];
        let (mut rows, mut part) = ([from, to], rng.unit());
        let is_single = tried % 2 == 1;
        if is_single {
            let joint = usize::try_from(rng.bits() % 3).unwrap();
            rows[1] = from;
            rows[1][joint] += rng.between(0.01, 0.3);
            part = 1.0;
        }
        if Cell::default().check_path(robot, &rows).unwrap().is_some() {
            continue;
        }
        let (link, point, radius) = any_point(robot.body().unwrap(), rng);
        let Some(link) = link.checked_sub(1) else { continue };
        let place = |part: f64| {
            let q = std::array::from_fn(|at| rows[0][at] + part * (rows[1][at] - rows[0][at]));
            let frame = robot.link_frames(&q).0[link];
            frame.rotation * point + frame.translation.vector
        };
        let way = if is_single {
            place(1.0) - place(0.99)
        } else {
            Vector3::from([0; 3].map(|_| rng.between(-1.0, 1.0)))
        };
        if way.norm() < 1e-6 {
            continue;
        }
        // It reaches into the link by a tenth of its radius.
        let ball = 1e-3;
        let center = place(part) + way.normalize() * (radius + 0.9 * ball);
        let ball = Shape::sphere(ball, center.into()).unwrap();
        let cell = Cell::new(vec![("ball".to_owned(), ball)], 0.0).unwrap();
        let found = cell.check_path(robot, &rows).unwrap();
        assert!(found.is_some(), "missed at {part} of {rows:?} by link {link}: {point}");
        let contact = found.unwrap();
        assert!(contact.at <= part && contact.nearest.near == Near::Obstacle("ball".to_owned()));
        tried += 1;
    }
}

fn without_hulls<const N: usize>(robot: &Arm<N>) -> Arm<N> {
    let body = robot.body().unwrap().clone().with_hulls(Vec::new()).unwrap();
    robot.clone().with_body(Some(body)).unwrap()
}

#[test]
fn a_ball_that_a_link_passes_through_is_found() {
    on_arms(|robot, rng| match robot {
        AnyArm::Six(robot) => {
            refute(robot, rng);
            refute(&without_hulls(robot), rng);
        }
        AnyArm::Seven(robot) => {
            refute(robot, rng);
            refute(&without_hulls(robot), rng);
        }
        AnyArm::Five(robot) => refute(robot, rng),
    });
}
