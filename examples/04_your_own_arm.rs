//! An arm that is not in the catalog: from a table, from parameters, and what is rejected.

use std::f64::consts::FRAC_PI_2;

use irbkin::{DhRow, Error, JointLimits, Mdh, OpwParameters, Pose, Robot, pose};

/// The name that the Python package gives the error, and its message.
fn refused<T>(what: &str, result: Result<T, Error>) {
    let Err(error) = result else { return println!("{what}: accepted") };
    let kind = match error {
        Error::InvalidPose(_) => "InvalidPoseError",
        Error::InvalidModel(_) => "InvalidModelError",
        Error::UnknownRobot(_) => "UnknownRobotError",
        _ => "IrbkinError",
    };
    println!("{what}\n  {kind}: {error}");
}

fn main() -> Result<(), Error> {
    // alpha, a, d, theta offset of each joint, after Craig; degrees and meters here.
    let table = [
        [0.0, 0.0, 0.445, 0.0],
        [-90.0, 0.150, 0.0, -90.0],
        [0.0, 0.700, 0.0, 0.0],
        [-90.0, 0.115, 0.795, 0.0],
        [90.0, 0.0, 0.0, 0.0],
        [-90.0, 0.0, 0.085, 180.0_f64],
    ];
    let rows =
        table.map(|[alpha, a, d, theta]| DhRow::new(alpha.to_radians(), a, d, theta.to_radians()));
    let mdh = Mdh { base: Pose::identity(), rows, flange: Pose::identity() };
    let arm = Robot::from_mdh(mdh.clone())?.with_name("from a table");
    let pose = pose::from_wxyz([0.850, 0.320, 0.640], [0.258_819_0, 0.0, 0.965_925_8, 0.0])?;
    println!("{}: {}, {}", arm.name(), arm.structure(), arm.ik(&pose)?.explain());

    // OPW parameters [m]; this maker counts axes 1, 4 and 6 in the opposite sense.
    let kuka = Robot::from_opw(OpwParameters {
        a1: 0.025,
        a2: -0.035,
        b: 0.0,
        c1: 0.400,
        c2: 0.315,
        c3: 0.365,
        c4: 0.080,
        offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
        signs: [-1, 1, 1, -1, 1, -1],
    })?
    .with_name("KR 6 R700");
    let q = [0.0, -90.0, 90.0, 0.0, 30.0, 0.0].map(f64::to_radians);
    println!("{}: {}, {}\n", kuka.name(), kuka.structure(), kuka.ik(&kuka.fk(&q))?.explain());

    // A wrist whose axes 5 and 6 are 80 mm apart has no closed form: polynomials solve it.
    let mut offset_wrist = mdh;
    offset_wrist.rows[5].a = 0.080;
    let arm = Robot::from_mdh(offset_wrist)?;
    let q = [10.0, 20.0, 30.0, 40.0, 50.0, 60.0].map(f64::to_radians);
    let solutions = arm.ik(&arm.fk(&q))?;
    let certainty = if solutions.is_certified() { "certified" } else { "not certified" };
    println!("axes 5 and 6 apart: {}, {} solutions, {certainty}", arm.structure(), solutions.len());
    if let Some(missing) = arm.missing_form() {
        println!("  {missing}\n");
    }

    let mut mirrored = [0.0; 16];
    (mirrored[0], mirrored[5], mirrored[10], mirrored[15]) = (1.0, 1.0, -1.0, 1.0);
    refused("a left-handed pose", pose::from_rows(&mirrored));
    refused(
        "exchanged limits",
        JointLimits::new([
            [-3.0, 3.0],
            [0.5, -2.0],
            [-3.0, 3.0],
            [-3.0, 3.0],
            [-2.0, 2.0],
            [-6.0, 6.0],
        ]),
    );
    refused("a misspelled name", Robot::<6>::named("IRB 2600-12/1.56"));
    Ok(())
}
