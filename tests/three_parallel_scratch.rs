//! Scratch.
use irbkin::*;
#[test]
fn scratch() {
    let robot: Robot<6> = Robot::named("UR3").unwrap();
    let mut state = 12345u64;
    let mut rnd = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut worst, mut lost, mut count, mut bad_slot, mut worst_det) = (0.0f64, 0, 0, 0, 0.0f64);
    for _ in 0..100000 {
        let q: [f64; 6] = core::array::from_fn(|_| (rnd() * 2.0 - 1.0) * core::f64::consts::PI);
        let pose = robot.fk(&q);
        let s = robot.ik(&pose).unwrap();
        count += s.len();
        let mut found = false;
        for sol in &s {
            worst = worst.max(robot.residual(&sol.q, &pose).largest());
            if sol.q.iter().zip(&q).all(|(a, b)| {
                let d = (a - b).abs();
                d < 1e-6 || (d - core::f64::consts::TAU).abs() < 1e-6
            }) {
                found = true;
                let slot = 2 * u8::from(q[2] < 0.0) + u8::from(q[4] < 0.0);
                if sol.slot & 3 != slot {
                    bad_slot += 1;
                }
            }
        }
        if !found {
            lost += 1;
        }
        let det = robot.jacobian(&q, JacobianFrame::Base).determinant();
        worst_det = worst_det.max((det - robot.three_parallel().unwrap().jacobian_determinant(&q)).abs());
    }
    println!("worst {worst:e} lost {lost} solutions {count} bad slots {bad_slot} det {worst_det:e}");
    println!("{:?}", robot.ik(&robot.fk(&[0.0; 6])).unwrap().iter().map(|s| (s.slot, s.q, s.status, s.free)).collect::<Vec<_>>());
}
