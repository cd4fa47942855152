//! Every solution of a pose takes less than a microsecond: IRB 1600, IRB 2600, UR3 and Panda (joint
//! 7 given), over poses spread inside the limits. Criterion measures; above the bound this fails.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use criterion::Criterion;
use irbkin::{Joints, Pose, Robot};

mod poses;

/// Poses of each arm.
const POSES: u32 = 1000;

/// Longest median of a solve [ns].
const MOST: f64 = 1000.0;

/// Calls of one pose that are timed together: a clock ticks in tens of nanoseconds.
const CALLS: u32 = 50;

const GROUP: &str = "every solution of a pose";

/// An arm of the table: its name, and a solve of the pose with a number.
struct Subject {
    name: &'static str,
    solve: Box<dyn Fn(usize) -> usize>,
}

fn six(name: &'static str) -> Subject {
    let robot = Robot::<6>::named(name).unwrap();
    let poses = spread(&robot);
    let solve = move |i: usize| {
        let (_, pose) = &poses[i % poses.len()];
        robot.ik(black_box(pose)).unwrap().len()
    };
    Subject { name, solve: Box::new(solve) }
}

fn panda() -> Subject {
    let robot = Robot::<7>::named("Panda").unwrap();
    let poses = spread(&robot);
    let solve = move |i: usize| {
        let (q, pose) = &poses[i % poses.len()];
        robot.ik(black_box(pose), q[6]).unwrap().len()
    };
    Subject { name: "Panda", solve: Box::new(solve) }
}

/// Joint vectors spread inside the limits, with their poses.
fn spread<const N: usize>(robot: &Robot<N>) -> Vec<([f64; N], Pose)>
where
    Robot<N>: Joints<N>,
{
    let with_pose = |q: &[f64]| {
        let q: [f64; N] = q.try_into().unwrap();
        (q, robot.fk(&q))
    };
    poses::joints(robot, POSES).chunks_exact(N).map(with_pose).collect()
}

/// The median that criterion measured [ns].
fn median(folder: &Path) -> f64 {
    let estimates = std::fs::read_to_string(folder.join("new/estimates.json")).unwrap();
    let estimates: serde_json::Value = serde_json::from_str(&estimates).unwrap();
    estimates["median"]["point_estimate"].as_f64().unwrap()
}

/// The time of a call [ns]: of five turns the least, which no other process disturbs.
fn time_of(call: impl Fn() -> usize) -> f64 {
    let turn = || {
        let start = Instant::now();
        for _ in 0..CALLS {
            black_box(call());
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
    };
    (0..5).map(|_| turn()).fold(f64::INFINITY, f64::min)
}

fn main() {
    let subjects = [six("IRB 1600-6/1.45"), six("IRB 2600-12/1.65"), six("UR3"), panda()];
    let home = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/criterion");
    let mut criterion = Criterion::default().output_directory(&home).configure_from_args();
    let mut group = criterion.benchmark_group(GROUP);
    for Subject { name, solve } in &subjects {
        let mut number = 0;
        group.bench_function(name.replace('/', "_"), |bencher| {
            bencher.iter(|| {
                number += 1;
                solve(number)
            });
        });
    }
    group.finish();
    criterion.final_summary();
    if std::env::args().any(|argument| argument == "--test") {
        return;
    }
    println!("{:20}{:>12}{:>12}{:>12}", "[ns]", "criterion", "p50", "most");
    let mut slow = Vec::new();
    for Subject { name, solve } in &subjects {
        let median = median(&home.join(GROUP).join(name.replace('/', "_")));
        let mut times = (0..POSES as usize).map(|i| time_of(|| solve(i))).collect::<Vec<_>>();
        times.sort_by(f64::total_cmp);
        let (p50, most) = (times[times.len() / 2], times[times.len() - 1]);
        println!("{name:20}{median:12.0}{p50:12.0}{most:12.0}");
        if median > MOST {
            slow.push(*name);
        }
    }
    assert!(slow.is_empty(), "above {MOST} ns: {slow:?}");
}
