//! Many poses of an IRB 2600, a UR3 and a Panda on one thread, on every instruction set, a pose at
//! a time, against filling the answers with zeros.
//!
//! 512 poses and their answers stay in the second-level cache; 100,000 do not.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;
use std::time::Duration;

use criterion::{
    BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime,
};
use irbkin::batch::Batch;
use irbkin::{JacobianFrame, Robot};

mod poses;

/// Times `calculate` on every instruction set, and the filling of its `answers`.
fn measure(
    mut group: BenchmarkGroup<'_, WallTime>,
    count: u32,
    answers: &mut [f64],
    mut calculate: impl FnMut(&mut [f64]),
) {
    group.throughput(Throughput::Elements(u64::from(count)));
    group.bench_function("fill", |b| b.iter(|| black_box(&mut *answers).fill(0.0)));
    poses::with_each_set(|set| {
        group.bench_function(set, |b| b.iter(|| calculate(black_box(&mut *answers))));
    });
    group.finish();
}

fn many_poses(criterion: &mut Criterion) {
    let robot = poses::robot();
    for count in [512, 100_000] {
        let rows = usize::try_from(count).unwrap();
        let q = poses::joints(&robot, count);
        let poses = poses::poses(&robot, &q);
        let mut status = vec![0; rows * 8];
        let mut answers = vec![0.0; rows * 48];

        let group = criterion.benchmark_group(format!("ik, {count} poses"));
        measure(group, count, &mut answers, |q| {
            Batch::new(None).ik(&robot, &poses, q, &mut status).unwrap();
        });
        let group = criterion.benchmark_group(format!("fk, {count} poses"));
        measure(group, count, &mut answers[..rows * 16], |poses| {
            Batch::new(None).fk(&robot, &q, poses).unwrap();
        });
        let group = criterion.benchmark_group(format!("jacobian, {count} poses"));
        measure(group, count, &mut answers[..rows * 36], |rows| {
            Batch::new(None).jacobian(&robot, &q, JacobianFrame::Base, rows).unwrap();
        });
    }
}

fn other_structures(criterion: &mut Criterion) {
    let (ur3, panda) = (Robot::<6>::named("UR3").unwrap(), Robot::<7>::named("Panda").unwrap());
    for count in [512, 100_000] {
        let rows = usize::try_from(count).unwrap();
        let mut status = vec![0; rows * 8];
        let poses_ur3 = poses::poses(&ur3, &poses::joints(&ur3, count));
        let group = criterion.benchmark_group(format!("UR3: ik, {count} poses"));
        measure(group, count, &mut vec![0.0; rows * 48], |q| {
            Batch::new(None).ik(&ur3, &poses_ur3, q, &mut status).unwrap();
        });
        let q = poses::joints(&panda, count);
        let (poses_panda, q7): (_, Vec<f64>) =
            (poses::poses(&panda, &q), q.iter().skip(6).step_by(7).copied().collect());
        let group = criterion.benchmark_group(format!("Panda: ik, {count} poses"));
        measure(group, count, &mut vec![0.0; rows * 56], |q| {
            Batch::new(None).ik_with(&panda, &poses_panda, &q7, q, &mut status).unwrap();
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(50)
        .warm_up_time(Duration::from_millis(500))
        .measurement_time(Duration::from_secs(2));
    targets = many_poses, other_structures
}
criterion_main!(benches);
