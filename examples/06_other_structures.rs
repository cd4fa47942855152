//! Other arms than ABB's: three parallel axes, seven axes, and tables and URDFs that are
//! recognized.

use irbkin::{DhRow, Pose, Robot, Sdh, Solution};
use irbkin_motion::{Arm, Error};

const URDF: &str = include_str!("../tests/data/ur5e.urdf");
const SLOT: [[&str; 2]; 3] = [["left", "right"], ["q3 >= 0", "q3 < 0"], ["q5 >= 0", "q5 < 0"]];

fn degrees<const N: usize>(solution: &Solution<N>) -> String {
    // Adding zero turns -0.0 into 0.0.
    solution
        .q
        .map(|angle| format!("{:8.2}", (100.0 * angle.to_degrees()).round() / 100.0 + 0.0))
        .join(" ")
}

fn three_parallel_axes() -> Result<(), Error> {
    let robot: Robot<6> = Robot::named("UR3")?;
    let pose = robot.fk(&[25.0, -105.0, 85.0, -35.0, 65.0, 15.0].map(f64::to_radians));
    let solutions = robot.ik(&pose)?;
    println!("{}: {}, {}", robot.name(), robot.structure(), solutions.explain());
    for solution in &solutions {
        let words: Vec<_> = SLOT
            .iter()
            .zip([4, 2, 1])
            .map(|(word, bit)| word[usize::from(solution.slot.index() & bit != 0)])
            .collect();
        println!("  {} {}   {}", solution.slot, degrees(solution), words.join(", "));
    }

    // Axis 6 parallel to axes 2, 3 and 4: joint 6 is free.
    let pose = robot.fk(&[25.0, -80.0, 75.0, -45.0, 0.0, 40.0].map(f64::to_radians));
    let solutions = robot.ik(&pose)?;
    let self_motions =
        solutions.iter().find_map(|solution| solution.free_joint.map(|free| (solution, free)));
    if let Some((singular, free)) = self_motions {
        println!("  with q5 = 0: J{} is free, {} stay fixed", free.joint(), free.fixed());
        println!("  {} {}", singular.slot, degrees(singular));
        if let Some(moved) = robot.with_free_joint(&pose, singular, 40.0_f64.to_radians())? {
            println!("  {} {}\n", moved.slot, degrees(&moved));
        }
    }
    Ok(())
}

fn seven_axes() -> Result<(), Error> {
    let robot: Robot<7> = Robot::named("Panda")?;
    let here = [5.0, -40.0, 10.0, -130.0, 5.0, 95.0, 35.0].map(f64::to_radians);
    let mut pose = robot.fk(&here);
    let solutions = robot.ik(&pose, here[6])?;
    println!("{}: {}, q7 = 35 deg: {}", robot.name(), robot.structure(), solutions.explain());
    for solution in &solutions {
        println!(
            "  {} {}   {}",
            solution.slot,
            degrees(solution),
            if solution.is_within_limits() { "inside" } else { "outside" }
        );
    }
    pose.translation.z += 0.050;
    println!("  50 mm higher, q7 chosen too:");
    println!("    {}\n", degrees(&robot.ik_nearest(&pose, &here, &[1.0; 7])?));
    Ok(())
}

fn recognized() -> Result<(), Error> {
    let robot: Arm<6> = Arm::from_urdf(URDF, None, Some("tool0"))?;
    println!("ur5e.urdf: {}", robot.structure());
    // An IRB 2600 in standard form, with unusual frames and zero pose.
    let rows = [
        [90.0, 0.150, 0.445, 0.0],
        [0.0, 0.700, 0.0, 60.0],
        [90.0, 0.115, 0.0, 20.0],
        [-90.0, 0.0, 0.795, 0.0],
        [90.0, 0.0, 0.0, 45.0],
        [0.0, 0.0, 0.085, 0.0_f64],
    ];
    let rows =
        rows.map(|[alpha, a, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta.to_radians()));
    let table = Sdh { base: Pose::identity(), rows, flange: Pose::identity() };
    let robot = Robot::from_sdh(table.clone())?;
    let solutions =
        robot.ik(&robot.fk(&[10.0, 20.0, 30.0, 40.0, 50.0, 60.0].map(f64::to_radians)))?;
    println!(
        "a standard table with unusual frames: {}, {} solutions",
        robot.structure(),
        solutions.len()
    );

    let mut tilted = table;
    tilted.rows[1].alpha += 0.2_f64.to_radians();
    tilted.rows[4].a = 0.002;
    if let Err(error) = Robot::from_sdh(tilted) {
        println!("the same with errors:\n  {error}");
    }
    Ok(())
}

fn main() -> Result<(), Error> {
    three_parallel_axes()?;
    seven_axes()?;
    recognized()
}
