//! Laws of free motions: free at every instant, from end to end, within the limits; what cannot be
//! is refused as that.

use crate::common::scenes::{ARMS, in_shelf, on_table, problems, shelf, table};
use crate::common::{Rng, enough};

use irbkin::{Interrupt, Pose, pose};
use irbkin_motion::body::Shape;
use irbkin_motion::cell::Cell;
use irbkin_motion::go::{End, GoOptions};
use irbkin_motion::trajectory::Trajectory;
use irbkin_motion::{Arm, Error};

/// Instants at which a motion is looked at.
const INSTANTS: usize = 300;

/// Samples that a search may take.
const SAMPLES: usize = 3000;

fn go<const N: usize>(
    robot: &Arm<N>,
    [start, goal]: &[End<N>; 2],
    cell: &Cell,
    seed: u64,
) -> Result<Trajectory, Error> {
    let samples = core::cell::Cell::new(0);
    let is_enough = || samples.replace(samples.get() + 1) >= SAMPLES;
    let options = GoOptions { seed, ..GoOptions::default() };
    robot.go(start, goal, cell, &options, Interrupt::when(&is_enough))
}

fn meets<const N: usize>(robot: &Arm<N>, q: &[f64; N], end: &End<N>) -> bool {
    match end {
        End::Joints(wanted) => q.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9),
        End::Pose(pose) => robot.residual(q, pose).largest() < 1e-8,
    }
}

fn check<const N: usize>(robot: &Arm<N>, ends: &[End<N>; 2], cell: &Cell, motion: &Trajectory) {
    assert_eq!(cell.check_trajectory(robot, motion).unwrap(), None);
    let times = motion.times(INSTANTS).unwrap();
    let [mut q, mut dq, mut ddq] = [(); 3].map(|()| vec![[0.0; N]; INSTANTS]);
    let rows = [&mut q, &mut dq, &mut ddq].map(|rows| rows.as_flattened_mut());
    let [q_rows, dq_rows, ddq_rows] = rows;
    motion.sample(&times, q_rows, dq_rows, ddq_rows).unwrap();
    for q in &q {
        assert!(!cell.collides(robot, q).unwrap() && robot.limits().contains(q), "{q:?}");
    }
    assert!(meets(robot, &q[0], &ends[0]) && meets(robot, &q[INSTANTS - 1], &ends[1]));
    for rest in [dq[0], dq[INSTANTS - 1]] {
        assert!(rest.iter().all(|rate| rate.abs() < 1e-9), "{rest:?}");
    }
    let velocity = robot.max_velocity().copied().unwrap_or([1.0; N]);
    for (joint, peaks) in motion.peaks().iter().enumerate() {
        assert!(peaks.velocity <= velocity[joint] * (1.0 + 1e-9), "{peaks:?}");
        assert!(peaks.acceleration <= 2.0 * velocity[joint] * (1.0 + 1e-9), "{peaks:?}");
    }
}

/// Solve problems of a scene; how many motions were found, and how many of these go straight.
fn scene(
    robot: &Arm<6>,
    cell: &Cell,
    pose: &dyn Fn(&mut Rng) -> Pose,
    [seed, count]: [usize; 2],
) -> [usize; 2] {
    let mut rng = Rng::new(u64::try_from(seed).unwrap());
    let mut counts = [0; 2];
    for ends in problems(robot, cell, &mut rng, pose, count) {
        let found = go(robot, &ends, cell, 3);
        assert_eq!(found, go(robot, &ends, cell, 3));
        let again = |_: &Error| (4..12).find_map(|seed| go(robot, &ends, cell, seed).ok());
        match found.or_else(|error| again(&error).ok_or(error)) {
            Ok(motion) => {
                check(robot, &ends, cell, &motion);
                counts[0] += 1;
                counts[1] += usize::from(motion.knots().len() <= 4);
            }
            Err(error) => assert!(error.to_string().contains("does not prove"), "{error}"),
        }
    }
    counts
}

#[test]
fn motions_round_a_table_and_a_shelf_are_free_from_end_to_end() {
    for (name, size) in ARMS {
        let robot: Arm<6> = Arm::named(name).unwrap();
        let [found, straight] = scene(&robot, &table(size), &|rng| on_table(size, rng), [5, 60]);
        assert!(enough(found == 60 && straight < 57), "{name}: {found}, {straight}");
        let [found, straight] = scene(&robot, &shelf(size), &|rng| in_shelf(size, rng), [6, 60]);
        assert!(enough(found == 60 && straight < 57), "{name}: {found}, {straight}");
    }
}

#[test]
fn seven_joints_go_round_a_post_and_a_locked_one_stays() {
    let robot: Arm<7> = Arm::named("Panda").unwrap();
    let place = pose::from_wxyz([0.5, 0.0, 0.4], [1.0, 0.0, 0.0, 0.0]).unwrap();
    let post = Shape::cuboid([0.1, 0.1, 0.9], &place).unwrap();
    let cell = Cell::new(vec![("post".to_owned(), post)], 0.01).unwrap();
    let angle = 0.2;
    let [start, goal] = [-0.8, 0.8].map(|q1| [q1, 0.4, angle, -1.9, 0.1, 2.3, 0.7]);
    let locked = robot.clone().map(|robot| robot.locked(3, angle)).unwrap();
    let mut motions = 0;
    for (robot, is_locked) in [(&robot, false), (&locked, true)] {
        for end in [End::Joints(goal), End::Pose(robot.fk(&goal))] {
            let ends = [End::Joints(start), end];
            let motion = go(robot, &ends, &cell, 0).unwrap();
            check(robot, &ends, &cell, &motion);
            motions += usize::from(motion.knots().len() > 4);
            let [low, high] = motion.range()[2];
            assert!(!is_locked || high - low < 1e-12);
        }
    }
    assert!(enough(motions > 0));
    let moved = End::Joints([0.0, 0.4, 0.5, -1.9, 0.1, 2.3, 0.7]);
    let refused = go(&locked, &[End::Joints(start), moved], &cell, 0).unwrap_err().to_string();
    assert!(refused.contains("goal: joint 3 is 0.500000 rad"), "{refused}");
}

#[test]
fn what_cannot_be_is_refused_as_that() {
    let (name, size) = ARMS[1];
    let robot: Arm<6> = Arm::named(name).unwrap();
    let cell = table(size);
    let free = [0.0, -0.3, 0.2, 0.0, 0.8, 0.0];
    let refused = |ends: [End<6>; 2]| {
        let found = go(&robot, &ends, &cell, 0).map(|motion| motion.duration());
        found.unwrap_err().to_string()
    };
    let to = |goal: End<6>| refused([End::Joints(free), goal]);
    let at = |x: f64, y: f64, z: f64| {
        End::Pose(pose::from_euler_zyx([x, y, z], [0.0, 0.0, std::f64::consts::PI]).unwrap())
    };
    let inside = at(0.5 * size, 0.0, 0.1 * size);
    let words = to(inside);
    assert!(words.starts_with("goal collides: each of "), "{words}");
    assert!(words.contains(" with box, ") || words.contains(" with table, "), "{words}");
    assert!(words.contains(" mm deep (proven impossible): take another goal"), "{words}");
    let words = refused([inside, End::Joints(free)]);
    assert!(words.starts_with("start collides: "), "{words}");
    let low = [0.0, 1.6, 0.5, 0.0, 0.0, 0.0];
    let words = refused([End::Joints(low), End::Joints(free)]);
    assert!(words.starts_with("start collides: link "), "{words}");
    assert!(to(at(9.0, 0.0, 0.0)).starts_with("goal is not reached: wrist center "));
    let outside = [0.0, 3.0, 0.0, 0.0, 0.0, 0.0];
    assert!(to(End::Joints(outside)).starts_with("goal: joint 2 is 3.000000 rad, its limits are "));
    let words = to(End::Joints(outside));
    assert!(words.contains(" rad, exceeded by ") && words.ends_with(" rad"), "{words}");
    let upper = robot.limits().to_array()[1][1];
    let words = to(End::Joints([0.0, upper + 1.2e-6, 0.0, 0.0, 0.0, 0.0]));
    assert!(words.ends_with(" rad, exceeded by 1.2e-6 rad"), "{words}");
    assert!(to(End::Joints([f64::NAN; 6])).contains("finite"));
    let limits = GoOptions { max_velocity: Some([0.0; 6]), ..GoOptions::default() };
    let ends = [End::Joints(free); 2];
    let refused = robot.go(&ends[0], &ends[1], &cell, &limits, Interrupt::none()).unwrap_err();
    assert!(matches!(refused, Error::InvalidMotion(_)), "{refused}");
    // A wall between the two, which ends nowhere near.
    let place = pose::from_wxyz([0.0; 3], [1.0, 0.0, 0.0, 0.0]).unwrap();
    let walls = [[6.0, 0.02, 6.0], [0.02, 6.0, 6.0]].map(|size| Shape::cuboid(size, &place));
    let walls = walls.into_iter().map(Result::unwrap).zip(["one", "other"]);
    let walls = Cell::new(walls.map(|(wall, name)| (name.to_owned(), wall)).collect(), 0.0);
    let robot = robot.with_body(Some(body_of_tip())).unwrap();
    let ends = [0.7, 2.3].map(|q1| End::Joints([q1, 0.5, 0.0, 0.0, 0.5, 0.0]));
    let refused = go(&robot, &ends, &walls.unwrap(), 0).map(|motion| motion.duration());
    let words = refused.unwrap_err().to_string();
    assert!(words.starts_with("no free motion was found with 3000 samples"), "{words}");
}

/// A ball at the flange.
fn body_of_tip() -> irbkin_motion::body::Body {
    let point = [0.0, 0.0, 0.0];
    let capsule = irbkin_motion::body::Capsule::new(point, point, 0.05).unwrap();
    irbkin_motion::body::Body::new(
        vec![irbkin_motion::body::LinkCapsule { link: 6, capsule }],
        vec![],
    )
    .unwrap()
}

#[test]
fn a_motion_to_where_the_arm_is_takes_no_time() {
    let robot: Arm<6> = Arm::named(ARMS[0].0).unwrap();
    let q = [0.3, -1.2, 1.0, -1.2, -1.4, 0.2];
    let ends = [End::Joints(q), End::Joints(q)];
    let motion = go(&robot, &ends, &Cell::default(), 0).unwrap();
    assert!(motion.duration() <= 0.0);
    assert!(meets(&robot, &motion.ends()[1].clone().try_into().unwrap(), &ends[1]));
}
