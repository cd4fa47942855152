//! The least singular value and the manipulability against a full decomposition of the Jacobian.

use irbkin::{DhRow, JacobianFrame, Joints, Mdh, Pose, Robot};
use nalgebra::DMatrix;
use std::array;

use crate::common::Rng;
use crate::common::coupled_arm::unlimited;

/// Joint vectors of each kind.
const POSES: usize = 300;

/// Distances from a quarter turn [rad]; the square of the least is no number any more.
const OFF: [f64; 8] = [0.0, 1e-170, 1e-145, 1e-17, 1e-12, 1e-9, 1e-7, 1e-4];

/// Either decomposition is exact for a matrix that is off by a few roundings of the largest
/// singular value.
fn hold<const N: usize>(robot: &Robot<N>, q: &[f64; N]) {
    let jacobian = robot.jacobian(q, JacobianFrame::Base);
    let values = DMatrix::from_column_slice(6, N, jacobian.as_slice()).singular_values();
    let least = values[values.len() - 1];
    let found = robot.singularity(q);
    let rounding = 8.0 * f64::EPSILON * values[0];
    assert!(
        (found.min_singular_value - least).abs() <= rounding,
        "{}, {q:?}: {} and {}",
        robot.name(),
        found.min_singular_value,
        least
    );
    let product = values.product();
    let others: f64 = values.iter().rev().skip(1).map(|value| value + rounding).product();
    assert!(
        (found.manipulability - product).abs() <= 2.0 * rounding * others,
        "{}, {q:?}: {} and {product}",
        robot.name(),
        found.manipulability
    );
}

/// Anywhere, with up to three joints next to a quarter turn, and with all of them.
fn hold_near_singularities<const N: usize>(robot: &Robot<N>) {
    let mut rng = Rng::new(1);
    for _ in 0..POSES {
        let anywhere: [f64; N] = rng.angles();
        hold(robot, &anywhere);
        for off in OFF {
            let square = |rng: &mut Rng| rng.half_turn() - rng.half_turn() / 2.0 + off;
            let mut q = anywhere;
            for joint in [rng.bits(), rng.bits(), rng.bits()] {
                q[usize::try_from(joint >> 32).unwrap() % N] = square(&mut rng);
            }
            hold(robot, &q);
            hold(robot, &array::from_fn(|_| square(&mut rng)));
        }
    }
}

/// A chain that bends everywhere.
fn bent<const N: usize>() -> Robot<N>
where
    Robot<N>: Joints<N>,
{
    let mut rng = Rng::new(2);
    let rows = array::from_fn(|_| DhRow::new(rng.angle(), 0.1, 0.2, 0.5));
    Robot::serial_chain(Mdh { base: Pose::identity(), rows, flange: Pose::identity() }).unwrap()
}

#[test]
fn they_are_those_of_a_full_decomposition() {
    for name in ["IRB 2600-12/1.65", "UR5e"] {
        hold_near_singularities(&Robot::<6>::named(name).unwrap());
    }
    hold_near_singularities(&unlimited());
    hold_near_singularities(&Robot::<7>::named("Panda").unwrap());
}

#[test]
fn an_arm_may_have_any_number_of_joints() {
    hold_near_singularities(&bent::<3>());
    hold_near_singularities(&bent::<9>());
    hold_near_singularities(&bent::<5>());
}

#[test]
fn an_arm_whose_joints_share_an_axis_is_singular_everywhere() {
    let rows = [DhRow::new(0.0, 0.0, 0.0, 0.0); 6];
    let still = Mdh { base: Pose::identity(), rows, flange: Pose::identity() };
    let found = Robot::serial_chain(still).unwrap().singularity(&[0.0; 6]);
    assert_eq!([found.min_singular_value, found.manipulability], [0.0; 2]);
}
