//! One pose of an IRB 2600: forward kinematics, Jacobian, inverse kinematics, singularity, on every instruction set.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use irbkin::JacobianFrame;

mod poses;

fn one_pose(criterion: &mut Criterion) {
    let robot = poses::robot();
    let (q, pose, singular) = (poses::Q, robot.fk(&poses::Q), robot.fk(&poses::Q_SINGULAR));
    poses::with_each_set(|set| {
        let mut group = criterion.benchmark_group(format!("one pose, {set}"));
        group.bench_function("fk", |b| b.iter(|| robot.fk(black_box(&q))));
        group.bench_function("jacobian", |b| b.iter(|| robot.jacobian(black_box(&q), JacobianFrame::Base)));
        group.bench_function("ik, 8 solutions", |b| b.iter(|| robot.ik(black_box(&pose))));
        group.bench_function("ik, wrist singular", |b| b.iter(|| robot.ik(black_box(&singular))));
        group.bench_function("ik_nearest", |b| b.iter(|| robot.ik_nearest(black_box(&pose), black_box(&q), &[1.0; 6])));
        group.bench_function("singularity", |b| b.iter(|| robot.singularity(black_box(&q))));
        group.finish();
    });
}

criterion_group!(benches, one_pose);
criterion_main!(benches);
