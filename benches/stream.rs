//! A step of a guard beside a box, a cylinder and a floor, in "brake" and "limit": the median, rare
//! steps and the longest of STEPS (100,000), by the least of three runs of each.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;
use std::time::{Duration, Instant};

use irbkin::body::Shape;
use irbkin::cell::Cell;
use irbkin::stream::{Guard, GuardOptions, OnViolation, Step};
use irbkin::trajectory::{AxisLimits, Profile, Synchronization, Trajectory, joint_within};
use irbkin::{JointLimits, Joints, Pose, Robot};

const CYCLE: f64 = 0.004;
const LIMITS: AxisLimits = AxisLimits { velocity: 1.8, acceleration: 8.0, jerk: 60.0 };

/// Runs of each step: what interrupts one of them seldom interrupts all.
const RUNS: usize = 3;

/// Random numbers: splitmix64.
struct Rng(u64);

impl Rng {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        (bits ^ bits >> 31) as f64 / u64::MAX as f64
    }

    fn inside<const N: usize>(&mut self, limits: &JointLimits<N>) -> [f64; N] {
        limits.to_array().map(|[low, high]| {
            let (low, high) = (low.max(-3.1), high.min(3.1));
            low + (high - low) * self.unit()
        })
    }
}

/// A reference of one cycle.
#[derive(Clone, Copy)]
enum Reference<const N: usize> {
    Missing,
    Joints([f64; N]),
    Pose(Pose),
}

fn step<const N: usize>(guard: &mut Guard<N>, reference: &Reference<N>) -> Step<N> {
    match reference {
        Reference::Missing => guard.step_none(),
        Reference::Joints(q) => guard.step(q),
        Reference::Pose(pose) => guard.step_pose(pose),
    }
}

fn cell_of<const N: usize>(robot: &Robot<N>) -> Cell {
    let reach: f64 = robot.mdh().rows.iter().map(|row| row.a.abs() + row.d.abs()).sum();
    let at = |x: f64, y: f64, z: f64| Pose::translation(reach * x, reach * y, reach * z);
    let boxed = Shape::cuboid([0.2 * reach; 3], &at(0.5, 0.2, 0.15)).unwrap();
    let post = Shape::cylinder(0.04 * reach, reach, &at(-0.1, 0.5, 0.0)).unwrap();
    let floor = Shape::half_space([0.0, 0.0, 1.0], [0.0, 0.0, -0.01]).unwrap();
    let obstacles = [("box", boxed), ("post", post), ("floor", floor)];
    Cell::new(obstacles.map(|(name, shape)| (name.into(), shape)).into(), 0.005).unwrap()
}

/// References of one kind for up to a second: missing, broken, a goal, a motion as joints or poses,
/// also through the wrist singularity.
fn references<const N: usize>(
    robot: &Robot<N>,
    here: [f64; N],
    rng: &mut Rng,
) -> Vec<Reference<N>> {
    let kind = (6.0 * rng.unit()) as usize;
    let count = 1 + (249.0 * rng.unit()) as usize;
    let (far, part) = (rng.inside(robot.limits()), rng.unit());
    let mut goal: [f64; N] = std::array::from_fn(|i| here[i] + part * (far[i] - here[i]));
    if kind == 5 {
        (goal, goal[4]) = (here, -here[4]);
    }
    let limits = [LIMITS; N];
    let motion: Trajectory =
        joint_within(Profile::SCurve, &here, &goal, &limits, Synchronization::Time).unwrap();
    let cycles = (motion.duration() / CYCLE) as usize + 2;
    let sampled = (0..cycles).map(|cycle| {
        let mut q = [0.0; N];
        let time = (cycle as f64 * CYCLE).min(motion.duration());
        motion.sample(&[time], &mut q, &mut [0.0; N], &mut [0.0; N]).unwrap();
        q
    });
    match kind {
        0 => vec![Reference::Missing; count],
        1 => vec![Reference::Joints([1e9; N]); count],
        2 => vec![Reference::Joints(goal); count],
        3 => sampled.map(Reference::Joints).collect(),
        _ => sampled.map(|q| Reference::Pose(robot.fk(&q))).collect(),
    }
}

fn times<const N: usize>(name: &str, on_violation: OnViolation, steps: usize) -> Vec<Duration>
where
    Robot<N>: Joints<N>,
{
    let (robot, mut rng): (Robot<N>, Rng) = (Robot::named(name).unwrap(), Rng(1));
    let cell = cell_of(&robot);
    let start = loop {
        let q = rng.inside(robot.limits());
        if !cell.collides(&robot, &q).unwrap() {
            break q;
        }
    };
    let options = GuardOptions {
        max_velocity: Some([LIMITS.velocity; N]),
        max_jerk: Some([LIMITS.jerk; N]),
        on_violation,
        ..GuardOptions::new(CYCLE, [LIMITS.acceleration; N])
    };
    let mut guard = Guard::new(&robot, &start, Some(&cell), &options).unwrap();
    let mut taken = Vec::with_capacity(steps);
    while taken.len() < steps {
        for reference in references(&robot, guard.q(), &mut rng) {
            let runs = [(); RUNS].map(|()| {
                let mut own = guard.clone();
                let begun = Instant::now();
                black_box(step(&mut own, black_box(&reference)));
                begun.elapsed()
            });
            taken.push(runs.into_iter().min().unwrap());
            step(&mut guard, &reference);
        }
    }
    taken.sort();
    taken
}

fn row(name: &str, on_violation: OnViolation, taken: &[Duration]) {
    let at = |part: f64| taken[(part * (taken.len() - 1) as f64) as usize].as_nanos() as f64 / 1e3;
    let name = format!("{name}, {on_violation:?}");
    print!("{name:28}");
    for part in [0.5, 0.99, 0.999, 0.9999, 1.0] {
        print!("{:8.1}", at(part));
    }
    println!();
}

fn main() {
    let is_test = std::env::args().any(|argument| argument == "--test");
    let asked = std::env::var("STEPS").ok().and_then(|steps| steps.parse().ok());
    let steps = asked.unwrap_or(if is_test { 1000 } else { 100_000 });
    println!("us, of {steps} steps               50 %    99 %  99.9 % 99.99 %    most");
    for mode in [OnViolation::Brake, OnViolation::Limit] {
        for name in ["IRB 2600-12/1.65", "UR5e", "GoFa 5"] {
            row(name, mode, &times::<6>(name, mode, steps));
        }
        row("Panda", mode, &times::<7>("Panda", mode, steps));
    }
}
