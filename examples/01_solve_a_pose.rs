//! All solutions that bring the tool of an IRB 2600 to one pose.

use irbkin::{Error, Robot, pose};

const HOME: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 30.0, 0.0];

fn outside(limits: &[[f64; 2]; 6], q: &[f64; 6]) -> String {
    let joints: Vec<_> = (0..6)
        .filter(|&i| !(limits[i][0]..=limits[i][1]).contains(&q[i]))
        .map(|i| format!("J{}", i + 1))
        .collect();
    if joints.is_empty() { "inside".to_owned() } else { format!("outside: {}", joints.join(" ")) }
}

fn main() -> Result<(), Error> {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
    // 850, 320, 640 mm from the base; the tool points forward and down, 60 deg below the horizon.
    let mut pose = pose::from_wxyz([0.850, 0.320, 0.640], [0.258_819_0, 0.0, 0.965_925_8, 0.0])?;
    let (xyz, wxyz) = pose::to_wxyz(&pose);
    let solutions = robot.ik(&pose)?;

    println!("{}: 6 axes, {}", robot.name(), robot.structure());
    println!("pose  xyz  {}            mm", xyz.map(|v| format!("{:9.1}", 1e3 * v)).join(" "));
    println!("      wxyz {}", wxyz.map(|v| format!("{v:9.6}")).join(" "));
    println!("{}\n", solutions.explain());

    println!("slot      J1      J2      J3      J4      J5      J6  residual  limits");
    for solution in &solutions {
        let angles = solution.q.map(|angle| format!("{:7.2}", angle.to_degrees())).join(" ");
        let residual = robot.residual(&solution.q, &pose).largest();
        println!(
            "   {} {angles}     {residual:.0e}  {}",
            solution.slot,
            outside(&robot.limits().to_array(), &solution.q)
        );
    }
    println!(
        "(degrees; the slot is ABB's cfx; the residual is the larger of meters and radians)\n"
    );

    let nearest = solutions.nearest(&HOME.map(f64::to_radians), &[1.0; 6])?;
    println!("nearest to home: slot {}", nearest.slot);
    if let Some(s) = robot.singularity(&nearest.q).distances {
        println!("  from the wrist singularity    {:6.1} deg", s.wrist.to_degrees());
        println!("  from the elbow singularity    {:6.1} deg", s.elbow.to_degrees());
        println!("  from the shoulder singularity {:6.1} mm\n", 1e3 * s.shoulder);
    }

    pose.translation.vector.x += 1.0;
    println!("the same pose one meter farther out: {}", robot.ik(&pose)?.explain());
    Ok(())
}
