//! Rows of a batch, alone and in the company of others.

use irbkin::batch::Batch;
use irbkin::{Robot, Status, pose};

use super::rng::drawn;

/// Rows of a batch: random ones, one with axis 4 at zero, one out of reach, one that is no pose, and
/// one that repeats the row before.
fn rows_of_every_kind(robot: &Robot<6>, count: usize) -> Vec<[f64; 16]> {
    let mut rows: Vec<[f64; 16]> = Vec::new();
    for (number, mut q) in drawn(6, count).enumerate() {
        let kind = number % 8;
        q[3] *= f64::from(u8::from(kind != 2));
        let mut row = pose::to_rows(&robot.fk(&q));
        match (kind, rows.last()) {
            (3, _) => row[3] = 30.0,
            (4, _) => row[5] = f64::NAN,
            (5 | 6, Some(before)) => row = *before,
            _ => {}
        }
        rows.push(row);
    }
    rows
}

/// Check that each row of a batch has the bits that its pose has alone, among rows that are bad,
/// repeated, out of reach or singular.
pub fn check_rows(robot: &Robot<6>) {
    for count in [0, 1, 7, 8, 9, 35] {
        let rows = rows_of_every_kind(robot, count);
        let (mut q, mut status) = (vec![0.0; count * 16 * 6], vec![0; count * 16]);
        Batch::new(None).ik(robot, rows.as_flattened(), &mut q, &mut status).unwrap();
        let seeds: Vec<[f64; 6]> = drawn(8, count).collect();
        let mut nearest = vec![0.0; count * 6];
        let (poses, flat) = (rows.as_flattened(), seeds.as_flattened());
        Batch::new(None).ik_nearest(robot, poses, flat, &[1.0; 6], &mut nearest).unwrap();
        for (row, elements) in rows.iter().enumerate() {
            let (q, status) = (&q[96 * row..][..96], &status[16 * row..][..16]);
            let nearest = &nearest[6 * row..][..6];
            let Ok(pose) = pose::from_rows(elements) else {
                assert!(status.iter().all(|flags| *flags == Status::INVALID.bits()));
                assert!(q.iter().chain(nearest).all(|angle| angle.is_nan()));
                continue;
            };
            let alone = robot.ik(&pose).unwrap();
            for slot in 0..16 {
                assert_eq!(status[slot], alone.status()[slot].bits());
                let there = &q[6 * slot..][..6];
                match alone.slot(slot) {
                    Some(solution) => assert_eq!(there, solution.q),
                    None => assert!(there.iter().all(|angle| angle.is_nan())),
                }
            }
            match robot.ik_nearest(&pose, &seeds[row], &[1.0; 6]) {
                Ok(solution) => assert_eq!(nearest, solution.q),
                Err(_) => assert!(nearest.iter().all(|angle| angle.is_nan())),
            }
        }
    }
}
