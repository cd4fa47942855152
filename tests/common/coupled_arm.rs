//! An arm with axes 2 and 3 coupled by a parallelogram linkage.

use irbkin::{Corrections, JointLimits, OpwParameters, Robot};

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

/// Fanuc's senses: axis 3 turns against axis 2. The figures of an LR Mate 200iD, with limits.
pub fn opposed() -> Robot<6> {
    let fanuc = OpwParameters {
        a1: 0.05,
        a2: -0.035,
        b: 0.0,
        c1: 0.33,
        c2: 0.33,
        c3: 0.335,
        c4: 0.08,
        offsets: [0.0, 0.0, -std::f64::consts::FRAC_PI_2, 0.0, 0.0, 0.0],
        signs: [1, 1, -1, -1, -1, -1],
    };
    let degrees = [
        [-170.0, 170.0],
        [-100.0, 145.0],
        [-70.0, 205.0],
        [-190.0, 190.0],
        [-125.0, 125.0],
        [-360.0, 360.0],
    ];
    let limits = JointLimits::new(degrees.map(|limit| limit.map(f64::to_radians))).unwrap();
    Robot::from_opw(fanuc).unwrap().with_limits(limits).coupled().unwrap()
}

/// Arms of other structures: an offset wrist in opposite senses, three parallel axes, and crooked
/// axes, all with limits of joint 3 and of the linkage.
pub fn others() -> [Robot<6>; 3] {
    let [crx, ur] = ["CRX-10iA", "UR5e"].map(|name| Robot::<6>::named(name).unwrap());
    let mut corrections = Corrections::NONE;
    for (i, value) in (0_u8..).zip(corrections.rows.as_flattened_mut()) {
        *value = 1e-3 * f64::from(i).sin();
    }
    let crooked = opposed().uncoupled().with_corrections(&corrections).unwrap();
    [crx, ur, crooked].map(|robot| {
        let linkage = Some([-2.0, 1.5]);
        let robot = robot.coupled().unwrap().with_linkage_limits(linkage).unwrap();
        let mut limits = robot.limits().to_array();
        limits[2] = [-2.5, 3.0];
        robot.with_limits(JointLimits::new(limits).unwrap())
    })
}

/// The joints of the serial chain: q2 is taken from q3, in the sense of axes 2 and 3.
pub fn serial(robot: &Robot<6>, mut q: [f64; 6]) -> [f64; 6] {
    let (frames, _) = robot.link_frames(&[0.0; 6]);
    let [second, third] = [1, 2].map(|i: usize| frames[i].rotation * nalgebra::Vector3::z());
    q[2] -= second.dot(&third).signum() * q[1];
    q
}

pub fn with_linkage() -> Robot<6> {
    limited().with_linkage_limits(Some([-100.0_f64.to_radians(), 40.0_f64.to_radians()])).unwrap()
}
