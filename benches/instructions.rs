//! The calls that the suites `instructions` and `stages` of `make evidence` count and sample:
//! `instructions WHAT SET TIMES` does one thing that many times.
//!
//! `instructions sets` lists the instruction sets of this processor. Without arguments it does
//! everything once on each: a proof that it runs.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use irbkin::batch::Batch;
use irbkin::{InstructionSet, JacobianFrame, Robot};

mod poses;

/// Poses of a batch.
const POSES: u32 = 512;

const ALL: [&str; 12] = [
    "fk",
    "jacobian",
    "ik, 8 solutions",
    "ik, wrist singular",
    "UR3: ik, 8 solutions",
    "Panda: ik, 8 solutions",
    "ik_nearest",
    "singularity",
    "batch fk",
    "batch jacobian",
    "batch ik",
    "batch singularity",
];

fn main() {
    let robot = poses::robot();
    let arguments: Vec<String> =
        std::env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    match &arguments[..] {
        [what, set, times] => {
            InstructionSet::available()
                .find(|available| available.name() == set)
                .unwrap()
                .force()
                .unwrap();
            repeat(&robot, what, times.parse().unwrap());
        }
        [sets] if sets == "sets" => {
            InstructionSet::available().for_each(|set| println!("{}", set.name()));
        }
        _ => poses::with_each_set(|_| ALL.iter().for_each(|what| repeat(&robot, what, 1))),
    }
}

/// Does `what` so many times.
fn repeat(robot: &Robot<6>, what: &str, times: u32) {
    let (q, pose, singular) = (poses::Q, robot.fk(&poses::Q), robot.fk(&poses::Q_SINGULAR));
    match what {
        "fk" => again(times, || robot.fk(black_box(&q))),
        "jacobian" => again(times, || robot.jacobian(black_box(&q), JacobianFrame::Base)),
        "ik, 8 solutions" => again(times, || robot.ik(black_box(&pose))),
        "ik, wrist singular" => again(times, || robot.ik(black_box(&singular))),
        "ik_nearest" => {
            again(times, || robot.ik_nearest(black_box(&pose), black_box(&q), &[1.0; 6]));
        }
        "singularity" => again(times, || robot.singularity(black_box(&q))),
        "UR3: ik, 8 solutions" => {
            let robot = Robot::<6>::named("UR3").unwrap();
            let pose = robot.fk(&poses::Q_UR3);
            again(times, || robot.ik(black_box(&pose)));
        }
        "Panda: ik, 8 solutions" => {
            let robot = Robot::<7>::named("Panda").unwrap();
            let pose = robot.fk(&poses::Q_PANDA);
            again(times, || robot.ik(black_box(&pose), poses::Q_PANDA[6]));
        }
        _ => repeat_batch(robot, what, times),
    }
}

fn repeat_batch(robot: &Robot<6>, what: &str, times: u32) {
    let rows = usize::try_from(POSES).unwrap();
    let q = poses::joints(robot, POSES);
    let poses = poses::poses(robot, &q);
    let (mut answers, mut status) = (vec![0.0; rows * 48], vec![0; rows * 8]);
    match what {
        "batch fk" => {
            again(times, || {
                Batch::new(None).fk(robot, &q, black_box(&mut answers[..rows * 16])).unwrap();
            });
        }
        "batch jacobian" => {
            again(times, || {
                Batch::new(None)
                    .jacobian(robot, &q, JacobianFrame::Base, black_box(&mut answers[..rows * 36]))
                    .unwrap();
            });
        }
        "batch ik" => again(times, || {
            Batch::new(None).ik(robot, &poses, black_box(&mut answers), &mut status).unwrap();
        }),
        "batch singularity" => again(times, || {
            let mut records = vec![None; rows];
            Batch::new(None).singularity(robot, black_box(&q), &mut records).unwrap();
            black_box(records);
        }),
        _ => eprintln!("{what} is none of {ALL:?}"),
    }
}

fn again<T>(times: u32, mut call: impl FnMut() -> T) {
    for _ in 0..times {
        black_box(call());
    }
}
