//! An arm with axes 2 and 3 coupled by a parallelogram linkage.

use irbkin::{JointLimits, OpwParameters, Robot};

/// The figures of an IRB 2400-10/1.55.
pub fn opw() -> OpwParameters {
    OpwParameters::abb(0.1, -0.135, 0.615, 0.705, 0.755, 0.085)
}

pub fn unlimited() -> Robot<6> {
    Robot::from_opw(opw()).unwrap().coupled().unwrap()
}

/// With the controller's limits.
pub fn limited() -> Robot<6> {
    let degrees = [
        [-180.0, 180.0],
        [-100.0, 110.0],
        [-60.0, 65.0],
        [-200.0, 200.0],
        [-120.0, 120.0],
        [-400.0, 400.0],
    ];
    unlimited()
        .with_limits(JointLimits::new(degrees.map(|limit| limit.map(f64::to_radians))).unwrap())
}

/// An arm with signs, offsets and a lateral offset.
pub fn odd() -> Robot<6> {
    let odd = OpwParameters {
        b: 0.04,
        offsets: [0.1, -0.7, 2.0, 0.3, -0.2, 0.5],
        signs: [-1, -1, -1, 1, -1, 1],
        ..opw()
    };
    Robot::from_opw(odd).unwrap().coupled().unwrap()
}

pub fn with_linkage() -> Robot<6> {
    limited().with_linkage_limits(Some([-100.0_f64.to_radians(), 40.0_f64.to_radians()])).unwrap()
}
