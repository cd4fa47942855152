//! One pose of an IRB 2600: forward kinematics, Jacobian, inverse kinematics, singularity.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use irbkin::{JacobianFrame, Robot};

fn one_pose(criterion: &mut Criterion) {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7];
    let pose = robot.fk(&q);
    let mut group = criterion.benchmark_group("IRB 2600, one pose");
    group.bench_function("fk", |b| b.iter(|| robot.fk(black_box(&q))));
    group.bench_function("jacobian", |b| b.iter(|| robot.jacobian(black_box(&q), JacobianFrame::Base)));
    group.bench_function("ik, 8 solutions", |b| b.iter(|| robot.ik(black_box(&pose))));
    group.bench_function("ik_nearest", |b| b.iter(|| robot.ik_nearest(black_box(&pose), black_box(&q), &[1.0; 6])));
    group.bench_function("singularity", |b| b.iter(|| robot.singularity(black_box(&q))));
    group.finish();
}

criterion_group!(benches, one_pose);
criterion_main!(benches);
