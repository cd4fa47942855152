//! One pose of an IRB 2600: forward kinematics, Jacobian, inverse kinematics, singularity; the
//! inverse of a UR3, a Panda and a GoFa; on every instruction set.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use irbkin::{JacobianFrame, Robot};

mod poses;

fn one_pose(criterion: &mut Criterion) {
    let robot = poses::robot();
    let (q, pose, singular) = (poses::Q, robot.fk(&poses::Q), robot.fk(&poses::Q_SINGULAR));
    poses::with_each_set(|set| {
        let mut group = criterion.benchmark_group(format!("one pose, {set}"));
        group.bench_function("fk", |b| b.iter(|| robot.fk(black_box(&q))));
        group.bench_function("jacobian", |b| {
            b.iter(|| robot.jacobian(black_box(&q), JacobianFrame::Base));
        });
        group.bench_function("ik, 8 solutions", |b| b.iter(|| robot.ik(black_box(&pose))));
        group.bench_function("ik, wrist singular", |b| b.iter(|| robot.ik(black_box(&singular))));
        group.bench_function("ik_nearest", |b| {
            b.iter(|| robot.ik_nearest(black_box(&pose), black_box(&q), &[1.0; 6]));
        });
        group.bench_function("singularity", |b| b.iter(|| robot.singularity(black_box(&q))));
        group.finish();
    });
}

fn other_structures(criterion: &mut Criterion) {
    let (ur3, panda) = (Robot::<6>::named("UR3").unwrap(), Robot::<7>::named("Panda").unwrap());
    let (q_ur3, q_panda) = (poses::Q_UR3, poses::Q_PANDA);
    let (pose_ur3, pose_panda, above) =
        (ur3.fk(&q_ur3), panda.fk(&q_panda), panda.fk(&q_panda.map(|angle| angle + 0.01)));
    let singular = ur3.fk(&[0.4, -1.9, 1.5, -0.6, 0.0, 0.3]);
    let gofa = Robot::<6>::named("CRB 15000-5/0.95").unwrap();
    let q_gofa = [0.4, -0.3, 0.5, 0.7, 0.9, 0.3];
    let [pose_gofa, parallel] = [0.7, 0.0].map(|q4| {
        let [q1, q2, q3, _, q5, q6] = q_gofa;
        gofa.fk(&[q1, q2, q3, q4, q5, q6])
    });
    assert_eq!(
        (ur3.ik(&pose_ur3).unwrap().len(), panda.ik(&pose_panda, q_panda[6]).unwrap().len()),
        (8, 8)
    );
    poses::with_each_set(|set| {
        let mut group = criterion.benchmark_group(format!("one pose, other structures, {set}"));
        group.bench_function("UR3: ik, 8 solutions", |b| b.iter(|| ur3.ik(black_box(&pose_ur3))));
        group
            .bench_function("UR3: ik, wrist singular", |b| b.iter(|| ur3.ik(black_box(&singular))));
        group.bench_function("UR3: ik_nearest", |b| {
            b.iter(|| ur3.ik_nearest(black_box(&pose_ur3), black_box(&q_ur3), &[1.0; 6]));
        });
        group.bench_function("Panda: ik, 8 solutions", |b| {
            b.iter(|| panda.ik(black_box(&pose_panda), q_panda[6]));
        });
        group.bench_function("GoFa 5: ik", |b| b.iter(|| gofa.ik(black_box(&pose_gofa))));
        group.bench_function("GoFa 5: ik, q4 = 0", |b| b.iter(|| gofa.ik(black_box(&parallel))));
        group.bench_function("Panda: ik_nearest", |b| {
            b.iter(|| panda.ik_nearest(black_box(&above), black_box(&q_panda), &[1.0; 7]));
        });
        group.finish();
    });
}

criterion_group!(benches, one_pose, other_structures);
criterion_main!(benches);
