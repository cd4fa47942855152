//! Choose a solution: limits, 2 pi equivalents, nearest, least motion, your own test.

use std::f64::consts::FRAC_PI_2;

use irbkin::{Error, JointLimits, Robot, Solution, Solutions, pose};

fn show(what: &str, Solution { q, slot, .. }: Solution<6>) {
    println!(
        "{what:28} slot {slot}  {}",
        q.map(|angle| format!("{:7.1}", angle.to_degrees())).join(" ")
    );
}

fn slots(solutions: &Solutions<6>) -> Vec<u8> {
    solutions.iter().map(|solution| solution.slot.into()).collect()
}

fn radians(degrees: [f64; 6]) -> [f64; 6] {
    degrees.map(f64::to_radians)
}

fn main() -> Result<(), Error> {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
    let pose = pose::from_wxyz([0.850, 0.320, 0.640], [0.258_819_0, 0.0, 0.965_925_8, 0.0])?;
    let solutions = robot.ik(&pose)?;
    println!("{}; with 2 pi equivalents: {}\n", solutions.explain(), solutions.turns().count());

    // The current joints, halfway between two wrist configurations.
    let seed = radians([20.0, 0.0, 40.0, 55.0, -25.0, 127.0]);
    show("nearest (root of squares)", solutions.nearest(&seed, &[1.0; 6])?);
    show("least motion (sum)", solutions.least_motion(&seed, &[1.0; 6])?);
    show("nearest, J5 weighted 9", solutions.nearest(&seed, &[1.0, 1.0, 1.0, 1.0, 9.0, 1.0])?);

    // J6 is wound back by most of a turn; the answer stays near it.
    let wound = radians([20.0, 0.0, 40.0, -30.0, 25.0, -300.0]);
    show("nearest to J6 = -300", solutions.nearest(&wound, &[1.0; 6])?);

    // Your own test, for a cable that must not twist or for collisions.
    let untwisted = solutions.within_limits().filter(|solution| solution.q[3].abs() < FRAC_PI_2);
    println!("\ninside the limits with |J4| < 90: slots {:?}", slots(&untwisted));

    // Frame 2 of the first six is the frame of joint 3: its origin is the elbow.
    let low = solutions.filter(|solution| robot.link_frames(&solution.q).0[2].translation.z < 0.3);
    println!("elbow below 300 mm: slots {:?}", slots(&low));
    println!("and of those inside the limits: {}", low.within_limits().explain());

    // With tighter limits, the message names the joint that exceeds them.
    let mut limits = robot.limits().to_array();
    limits[0] = [-90.0_f64, 90.0].map(f64::to_radians);
    limits[4] = [-20.0_f64, 20.0].map(f64::to_radians);
    match robot.with_limits(JointLimits::new(limits)?).ik_nearest(&pose, &seed, &[1.0; 6]) {
        Err(error @ Error::Unreachable(_)) => println!("with J1 in +-90 and J5 in +-20: {error}"),
        other => show("with J1 in +-90 and J5 in +-20", other?),
    }
    Ok(())
}
