//! The joint path of a weld seam: fixed torch, then free to turn about its own axis.

use std::f64::consts::{PI, TAU};

use irbkin::{Error, Pose, pose};
use irbkin_motion::Arm;
use irbkin_motion::plan::{Plan, PlanError, PlanOptions, ToolRotation};

const POSES: u32 = 501;

/// A spiral of two and a half turns, the torch 30 degrees off the vertical, turning with it.
fn seam() -> Result<Vec<Pose>, Error> {
    let angles = (0..POSES).map(|index| 5.0 * PI * f64::from(index) / f64::from(POSES - 1));
    angles
        .map(|angle| {
            let xyz = [1.0 + 0.01 * angle * angle.cos(), 0.01 * angle * angle.sin(), 0.5];
            pose::from_euler_zyx(xyz, [angle.rem_euclid(TAU), 150_f64.to_radians(), 0.0])
        })
        .collect()
}

fn show(name: &str, plan: &Plan) {
    let degrees = plan.tool_angle.iter().map(|angle| angle.to_degrees());
    let (least, most) = (degrees.clone().reduce(f64::min), degrees.reduce(f64::max));
    let slot = plan.slot[0].unwrap_or_default();
    println!("{name}: slot {slot}, certified, at least {:.2} s", plan.bottleneck);
    // Adding zero turns -0.0 into 0.0.
    let [least, most] =
        [least, most].map(|angle| (10.0 * angle.unwrap_or_default()).round() / 10.0 + 0.0);
    println!("  torch turned by {least:.1} to {most:.1} deg");
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let tool = pose::from_euler_zyx([0.05, 0.0, 0.35], [0.0; 3])?;
    let robot = Arm::<6>::named("IRB 2600-12/1.65")?;
    let robot = robot.map(|robot| robot.with_tool(&tool))?;
    let mut path = seam()?;
    let fixed = PlanOptions::default();
    if let Err(PlanError::NoPlan(gap)) = robot.plan(&path, &fixed) {
        let mut ends = gap.ends.iter();
        let last = ends.clone().map(|end| end.pose_index).max();
        if let Some(end) = ends.find(|end| Some(end.pose_index) == last) {
            println!("fixed torch: no plan reaches pose {}: {}", gap.pose_index, end.reason);
        }
    }
    let free = PlanOptions { rotation: Some(ToolRotation::full(36)?), ..fixed };
    show("free torch", &robot.plan(&path, &free)?);

    path[120].translation.z += 2.0;
    if let Err(PlanError::NoPlan(gap)) = robot.plan(&path, &free) {
        let broken = gap.plan.breaks[0];
        println!(
            "pose {} moved away: leave at {}, enter at {}",
            gap.pose_index,
            broken.leave.unwrap_or_default(),
            broken.enter.unwrap_or_default()
        );
    }
    Ok(())
}
