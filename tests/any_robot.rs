//! `AnyRobot` is the robot of five, six or seven joints that the name or the file says.

use irbkin::{AnyRobot, Robot, catalog};
use irbkin_motion::{AnyArm, Error};

#[test]
fn each_arm_of_the_catalog_has_its_own_number_of_joints() {
    let mut counts = [0; 3];
    for arm in catalog() {
        let any = AnyRobot::named(arm.name).unwrap();
        let same = match arm.dof() {
            5 => AnyRobot::from(Robot::<5>::named(arm.name).unwrap()),
            7 => AnyRobot::from(Robot::<7>::named(arm.name).unwrap()),
            _ => AnyRobot::from(Robot::<6>::named(arm.name).unwrap()),
        };
        assert_eq!(any, same);
        assert_eq!((any.dof(), any.name()), (arm.dof(), arm.name));
        counts[any.dof() - 5] += 1;
    }
    assert!(counts[0] > 1 && counts[1] > 100 && counts[2] > 0, "{counts:?}");
    assert!(matches!(AnyRobot::named("IRB 9999"), Err(irbkin::Error::UnknownRobot(_))));
}

#[test]
fn the_pose_is_that_of_the_robot_and_wrong_angles_are_refused() {
    let six: Robot<6> = Robot::named("IRB 1200-5/0.9").unwrap();
    let seven: Robot<7> = Robot::named("Panda").unwrap();
    let q = [0.3, -0.2, 0.4, 0.5, -0.6, 0.7, 0.8];
    let any = AnyRobot::from(six.clone());
    assert_eq!(any.fk(&q[..6]).unwrap(), six.fk(q[..6].try_into().unwrap()));
    assert_eq!(AnyRobot::from(seven.clone()).fk(&q).unwrap(), seven.fk(&q));
    assert_eq!(any.fk(&q).unwrap_err().to_string(), "q has 7 elements, it must have 6");
    let wrong = [0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0];
    assert!(any.fk(&wrong).unwrap_err().to_string().starts_with("q: joint 2 is NaN"));
}

#[test]
fn a_urdf_says_how_many_joints() {
    for (text, tip, dof) in [
        (include_str!("data/irb2600.urdf"), None, 6),
        (include_str!("data/iiwa14.urdf"), None, 7),
        (include_str!("data/panda_hand.urdf"), Some("panda_link8"), 7),
    ] {
        assert_eq!(AnyArm::from_urdf(text, None, tip).unwrap().dof(), dof);
    }
    assert!(matches!(AnyArm::from_urdf("<robot/>", None, None), Err(Error::InvalidUrdf(_))));
}
