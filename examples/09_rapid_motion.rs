//! The moves of a RAPID routine as one motion: times, findings, and the joints written back.

use irbkin::Robot;
use irbkin_abb::rapid::{self, MotionOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
    let module = rapid::parse(include_str!("pick_and_place.mod"), &[])?;
    let motion = rapid::motion(&robot, &[&module], None, &MotionOptions::default())?;
    println!("at least {:.3} s, {} samples", motion.trajectory.duration(), motion.t.len());
    for step in &motion.moves {
        let made = if step.as_programmed { "" } else { "  not made as programmed" };
        println!(
            "  line {}  {:8} {:7.3} s to {:7.3} s {:8.1} mm{made}",
            step.line,
            step.kind.name(),
            step.start,
            step.end,
            step.length * 1e3
        );
    }
    for finding in &motion.findings {
        println!("  {} {finding}", finding.code.id());
    }
    let options = MotionOptions { max_acceleration: Some([10.0; 6]), ..MotionOptions::default() };
    let timed = rapid::motion(&robot, &[&module], None, &options)?;
    println!("with accelerations of at most 10 rad/s^2: {:.3} s", timed.trajectory.duration());
    println!("{}", motion.to_module("PickAndPlaceJoints")?);
    Ok(())
}
