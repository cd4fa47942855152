//! Laws of arms with a spherical wrist alone.

use std::f64::consts::{FRAC_PI_2, PI};

use irbkin::{OpwParameters, Robot, pose};

use crate::rng::Rng;

#[test]
fn shortfall_is_the_distance_missing_to_reach() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    // Stretched upwards: theta_3 makes upper arm and forearm one line.
    let stretched = [0.4, 0.3, (0.115_f64).atan2(0.795) - FRAC_PI_2, 0.0, 0.5, 0.0];
    let mut pose = robot.fk(&stretched);
    let outward = nalgebra::Vector3::new(
        0.3_f64.sin() * 0.4_f64.cos(),
        0.3_f64.sin() * 0.4_f64.sin(),
        0.3_f64.cos(),
    );
    pose.translation.vector += outward * 0.012;
    let solutions = robot.ik(&pose).unwrap();
    assert!(solutions.is_empty());
    assert!((solutions.reach().shortfall() - 0.012).abs() < 1e-15);
    assert_eq!(solutions.explain().to_string(), "wrist center 12.0 mm beyond reach");
}

#[test]
fn a_lateral_offset_as_small_as_rounding_counts_as_zero() {
    let mut mdh = Robot::<6>::named("IRB 1200-5/0.9").unwrap().mdh().clone();
    (mdh.rows[1].d, mdh.rows[2].d) = (0.1 + 0.2, -0.3);
    let from_table = Robot::from_mdh(mdh).unwrap();
    let from_opw = Robot::from_opw(OpwParameters {
        b: 1e-12,
        ..OpwParameters::abb(0.0, -0.042, 0.3991, 0.448, 0.451, 0.082)
    })
    .unwrap();
    let over_the_base = pose::from_euler_zyx([0.0, 0.0, 1.2], [0.0; 3]).unwrap();
    for robot in [from_table, from_opw] {
        let solutions = robot.ik(&over_the_base).unwrap();
        assert!(!solutions.is_empty());
        for solution in &solutions {
            assert!(robot.residual(&solution.q, &over_the_base).largest() < 1e-14);
        }
    }
}

#[test]
fn a_short_forearm_and_far_offsets_cost_no_digit() {
    let short =
        OpwParameters { a2: 0.0, c3: 1e-3, ..OpwParameters::abb(0.0, 0.0, 0.3, 1.0, 0.0, 0.1) };
    let turned = OpwParameters {
        offsets: [100.0, -50.0, 1e4, 7.0, -7.0, 1e5],
        ..OpwParameters::abb(0.15, -0.11, 0.45, 0.7, 0.8, 0.1)
    };
    for opw in [short, turned] {
        let robot = Robot::from_opw(opw).unwrap();
        let mut rng = Rng::new(7);
        for _ in 0..2000 {
            let pose = robot.fk(&std::array::from_fn(|_| rng.between(-PI, PI)));
            let solutions = robot.ik(&pose).unwrap();
            assert!(!solutions.is_empty());
            for solution in &solutions {
                let residual = robot.residual(&solution.q, &pose);
                assert!(
                    residual.position <= 3e-15 * (1.0 + crate::common::reach_of(&robot)),
                    "{residual:?}"
                );
                assert!(residual.rotation <= 1e-14, "{residual:?}");
            }
        }
    }
}
