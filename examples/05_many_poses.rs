//! Many poses in one call: slices in, slices out, a status for every slot.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Instant;

use irbkin::batch::Batch;
use irbkin::{Error, Robot, Status, pose};

const POSES: usize = 20_000;

/// The best of five runs.
fn seconds(mut task: impl FnMut()) -> f64 {
    let mut once = || {
        let start = Instant::now();
        task();
        start.elapsed().as_secs_f64()
    };
    (0..5).map(|_| once()).fold(f64::INFINITY, f64::min)
}

/// Largest difference of two joint vectors, modulo 2 pi.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b - TAU * ((a - b) / TAU).round()).abs()).fold(0.0, f64::max)
}

#[expect(clippy::cast_precision_loss, reason = "counts far below 2^53")]
fn main() -> Result<(), Error> {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
    // Joint vectors spread evenly over the limits: fractional parts of multiples of square roots.
    let limits = robot.limits().to_array();
    let vector = |row: usize| {
        core::array::from_fn(|joint| {
            let step = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0][joint].sqrt();
            limits[joint][0] + (limits[joint][1] - limits[joint][0]) * (row as f64 * step).fract()
        })
    };
    let q: Vec<[f64; 6]> = (1..=POSES).map(vector).collect();
    let q = q.as_flattened();
    let slots = robot.slot_count();
    let (mut poses, mut solved, mut status) =
        (vec![0.0; POSES * 16], vec![0.0; POSES * slots * 6], vec![0; POSES * slots]);
    Batch::new(None).fk(&robot, q, &mut poses)?;
    Batch::new(None).ik(&robot, &poses, &mut solved, &mut status)?;
    println!(
        "q ({POSES}, 6) -> T ({POSES}, 4, 4) -> q ({POSES}, {slots}, 6), status ({POSES}, {slots})"
    );

    let count = |flag: Status| status.iter().filter(|status| **status & flag.bits() != 0).count();
    let (found, inside) = (count(Status::FOUND), count(Status::WITHIN_LIMITS));
    println!(
        "solutions: {found}, {:.2} a pose; inside the limits: {inside}",
        found as f64 / POSES as f64
    );

    // The joints that made each pose are among its solutions, modulo 2 pi; empty slots are NaN.
    let own = |q: &[f64], slots: &[f64]| {
        slots.chunks(6).any(|slot| !slot[0].is_nan() && apart(slot, q) < 1e-7)
    };
    let missing =
        q.chunks(6).zip(solved.chunks(slots * 6)).filter(|(q, slots)| !own(q, slots)).count();
    println!("poses whose own joints are missing: {missing}");

    // An invalid row, and one out of reach, do not affect the others.
    let mut broken = poses.clone();
    broken[16] = f64::NAN;
    broken[2 * 16 + 3] += 9.0;
    Batch::new(NonZeroUsize::new(2)).ik(&robot, &broken, &mut solved, &mut status)?;
    for row in 0..4 {
        let status = &status[row * slots..(row + 1) * slots];
        let solutions = status.iter().filter(|status| **status & Status::FOUND.bits() != 0).count();
        let invalid = status.iter().any(|status| status & Status::INVALID.bits() != 0);
        println!("row {row}: {solutions} solutions, {}", if invalid { "invalid" } else { "valid" });
    }

    let one_call =
        seconds(|| drop(black_box(Batch::new(None).ik(&robot, &poses, &mut solved, &mut status))));
    let one_by_one = seconds(|| {
        for rows in poses.as_chunks::<16>().0 {
            let _ = black_box(pose::from_rows(rows).and_then(|pose| robot.ik(&pose)));
        }
    });
    let mut again = vec![0.0; POSES * 16];
    let forward = seconds(|| drop(black_box(Batch::new(None).fk(&robot, q, &mut again))));
    println!("\na batch takes {:.2} of the time of single calls,", one_call / one_by_one);
    println!("eight solutions take {:.1} times as long as forward kinematics", one_call / forward);
    Ok(())
}
