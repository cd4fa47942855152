//! Scenes for free motions: a table with boxes on it, a shelf with boards; and problems in them.

use irbkin::{Pose, pose};
use irbkin_motion::Arm;
use irbkin_motion::body::Shape;
use irbkin_motion::cell::Cell;
use irbkin_motion::go::End;

use super::rng::Rng;

/// The size of a scene [m]: of the UR5e's, and of the IRB 2600's.
pub const ARMS: [(&str, f64); 2] = [("UR5e", 1.0), ("IRB 2600-12/1.65", 1.8)];

fn boxes(size: f64, boxes: &[(&str, [f64; 3], [f64; 3])]) -> Vec<(String, Shape)> {
    let shapes = boxes.iter().map(|(name, edges, center)| {
        let place = pose::from_wxyz(center.map(|x| x * size), [1.0, 0.0, 0.0, 0.0]).unwrap();
        ((*name).to_owned(), Shape::cuboid(edges.map(|x| x * size), &place).unwrap())
    });
    shapes.collect()
}

/// On a floor, with a margin of 5 mm.
fn with_floor(mut obstacles: Vec<(String, Shape)>) -> Cell {
    let floor = Shape::half_space([0.0, 0.0, 1.0], [0.0, 0.0, -0.02]).unwrap();
    obstacles.push(("floor".to_owned(), floor));
    Cell::new(obstacles, 0.005).unwrap()
}

/// A table in front of the arm with a box and a post on it.
pub fn table(size: f64) -> Cell {
    let scene = [
        ("table", [0.8, 1.6, 0.04], [0.65, 0.0, 0.0]),
        ("box", [0.2, 0.2, 0.3], [0.5, 0.0, 0.17]),
        ("post", [0.06, 0.06, 0.6], [0.6, 0.35, 0.32]),
    ];
    with_floor(boxes(size, &scene))
}

/// A shelf in front of the arm: three boards between two sides, and a back.
pub fn shelf(size: f64) -> Cell {
    let scene = [
        ("left", [0.35, 0.02, 1.0], [0.72, 0.4, 0.5]),
        ("right", [0.35, 0.02, 1.0], [0.72, -0.4, 0.5]),
        ("back", [0.02, 0.8, 1.0], [0.9, 0.0, 0.5]),
        ("lower", [0.35, 0.8, 0.02], [0.72, 0.0, 0.1]),
        ("middle", [0.35, 0.8, 0.02], [0.72, 0.0, 0.45]),
        ("upper", [0.35, 0.8, 0.02], [0.72, 0.0, 0.8]),
    ];
    with_floor(boxes(size, &scene))
}

/// A pose above the table, with the tool down.
pub fn on_table(size: f64, rng: &mut Rng) -> Pose {
    let place = [rng.between(0.35, 0.7), rng.between(-0.5, 0.5), rng.between(0.08, 0.25)];
    let turn = rng.between(-1.5, 1.5);
    pose::from_euler_zyx(place.map(|x| x * size), [turn, 0.0, std::f64::consts::PI]).unwrap()
}

/// A pose in the shelf, with the tool towards its back.
pub fn in_shelf(size: f64, rng: &mut Rng) -> Pose {
    let board = if rng.unit() < 0.5 { 0.1 } else { 0.45 };
    let place = [rng.between(0.5, 0.65), rng.between(-0.25, 0.25), board + rng.between(0.14, 0.22)];
    let turn = std::f64::consts::FRAC_PI_2;
    pose::from_euler_zyx(place.map(|x| x * size), [rng.between(-0.3, 0.3), turn, 0.0]).unwrap()
}

/// Problems in a scene whose ends are free: a third from joints to a pose, the others from pose to
/// pose, of which a half name the joints.
pub fn problems(
    robot: &Arm<6>,
    cell: &Cell,
    rng: &mut Rng,
    pose: &dyn Fn(&mut Rng) -> Pose,
    count: usize,
) -> Vec<[End<6>; 2]> {
    let free = |rng: &mut Rng| loop {
        let pose = pose(rng);
        let solutions = robot.ik(&pose).unwrap().within_limits();
        let is_free = |q: &[f64; 6]| !cell.collides(robot, q).unwrap();
        if let Some(solution) = solutions.iter().find(|solution| is_free(&solution.q)) {
            return (pose, solution.q);
        }
    };
    let mut all = Vec::new();
    for number in 0..count {
        let (goal, _) = free(rng);
        let start = match number % 3 {
            0 => loop {
                let q = rng.inside(robot.limits()).map(|angle| angle.clamp(-3.0, 3.0));
                if !cell.collides(robot, &q).unwrap() {
                    break End::Joints(q);
                }
            },
            1 => End::Joints(free(rng).1),
            _ => End::Pose(free(rng).0),
        };
        all.push([start, End::Pose(goal)]);
    }
    all
}
