//! A target taught in a work object, for a tool, as in a robot program.

use irbkin::{Error, Pose, Robot, pose};

const HOME: [f64; 6] = [0.0, 0.0, 0.0, 0.0, 30.0, 0.0];

fn show(what: &str, q: &[f64; 6]) {
    println!("{what:26} {}", q.map(|angle| format!("{:7.2}", angle.to_degrees())).join(" "));
}

fn turned(xyz: [f64; 3], zyx_deg: [f64; 3]) -> Result<Pose, Error> {
    pose::from_euler_zyx(xyz, zyx_deg.map(f64::to_radians))
}

fn main() -> Result<(), Error> {
    let (home, weights) = (HOME.map(f64::to_radians), [1.0; 6]);
    let arm: Robot<6> = Robot::named("IRB 2600-12/1.65")?;
    // A gripper whose center point is 180 mm in front of the flange and tilted by 30 deg.
    let t_flange_tool = turned([0.040, 0.0, 0.180], [0.0, 30.0, 0.0])?;
    // A pallet rotated by 15 deg, and a part on it.
    let t_base_pallet = turned([0.700, -0.500, 0.350], [15.0, 0.0, 0.0])?;
    let t_pallet_target = pose::from_wxyz([0.200, 0.150, 0.060], [0.0, 0.0, 1.0, 0.0])?;

    // Frames cancel from left to right; poses of a robot with a tool are poses of the tool's center
    // point.
    let gripper = arm.clone().with_tool(&t_flange_tool)?;
    let q = gripper.ik_nearest(&(t_base_pallet * t_pallet_target), &home, &weights)?.q;
    show("through the pallet", &q);

    // Or once for all: the base relative to the pallet. Then targets are used as taught.
    let on_pallet = gripper.clone().with_base(&t_base_pallet.inverse())?;
    show("with_base", &on_pallet.ik_nearest(&t_pallet_target, &home, &weights)?.q);

    // Forward kinematics returns poses in the frame of the pallet, too.
    let (xyz, _) = pose::to_wxyz(&on_pallet.fk(&q));
    println!("tool in the pallet's frame  {} mm", xyz.map(|v| format!("{:.1}", 1e3 * v)).join(" "));
    println!(
        "flange in the base          {:.1} mm above the floor\n",
        1e3 * arm.fk(&q).translation.z
    );

    // The pallet was measured again: the program stays, the joints change.
    let t_base_pallet = turned([0.712, -0.488, 0.351], [16.5, 0.0, 0.0])?;
    let moved = gripper.clone().with_base(&t_base_pallet.inverse())?;
    show("pallet moved", &moved.ik_nearest(&t_pallet_target, &q, &weights)?.q);

    // Robots are immutable: with_ returns a new one. Robots compare by value.
    let equal = arm.with_tool(&t_flange_tool)? == gripper;
    println!(
        "\nthe same tool on the same arm is an equal robot: {}",
        if equal { "yes" } else { "no" }
    );
    Ok(())
}
