//! Values that users store are written and read back unchanged.

use std::fmt::Debug;

use irbkin::follow::{FollowOptions, SingularityMode};
use irbkin::{
    AnyRobot, Configuration, Corrections, JointLimits, Joints, Mdh, OpwParameters, Robot, Sdh,
    Solution, Status, catalog, pose,
};
use irbkin_motion::{AnyArm, Arm};
use serde::Serialize;
use serde::de::DeserializeOwned;

fn round_trips<T: Serialize + DeserializeOwned + PartialEq + Debug>(kept: &T) {
    let text = serde_json::to_string(kept).unwrap();
    assert_eq!(&serde_json::from_str::<T>(&text).unwrap(), kept, "{text}");
}

#[test]
fn models_round_trip() {
    round_trips(&OpwParameters::abb(0.1, -0.135, 0.615, 0.705, 0.755, 0.085));
    let panda: Robot<7> = Robot::named("Panda").unwrap();
    round_trips::<Mdh<7>>(panda.mdh());
    let Mdh { base, rows, flange } = panda.mdh().clone();
    round_trips(&Sdh { base, rows, flange });
}

fn round_trips_with_settings<const N: usize>(robot: &Robot<N>)
where
    Robot<N>: Joints<N>,
{
    round_trips(robot);
    let base = pose::from_euler_zyx([0.1, -2.0, 0.3], [0.4, 0.5, -0.6]).unwrap();
    let tool = pose::from_euler_zyx([0.0, 0.02, 0.11], [0.1, 0.0, 3.0]).unwrap();
    let mut limits = [[-1.25, 2.5]; N];
    limits[0] = [f64::NEG_INFINITY, f64::INFINITY];
    limits[1] = [f64::NEG_INFINITY, 1.5];
    let changed = robot.clone().with_base(&base).unwrap().with_tool(&tool).unwrap();
    let changed = changed.with_limits(JointLimits::new(limits).unwrap()).with_name("cell 3");
    let mut velocity = [2.0; N];
    velocity[2] = f64::INFINITY;
    round_trips(&changed.with_max_velocity(Some(velocity)).unwrap());
}

#[test]
fn robots_round_trip() {
    for arm in catalog() {
        round_trips(&AnyRobot::from_catalog(&arm).unwrap());
        round_trips(&AnyArm::from_catalog(&arm).unwrap());
        match arm.dof() {
            5 => {
                let robot = Robot::<5>::from_catalog(&arm).unwrap();
                round_trips_with_settings(&robot.with_heading_tolerance(0.5).unwrap());
            }
            6 => round_trips_with_settings(&Robot::<6>::from_catalog(&arm).unwrap()),
            _ => round_trips_with_settings(&Robot::<7>::from_catalog(&arm).unwrap()),
        }
    }
    let coupled: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap().coupled().unwrap();
    round_trips_with_settings(&coupled);
    let opposed: Robot<6> = Robot::named("CRX-10iA").unwrap();
    round_trips_with_settings(&opposed.coupled().unwrap());
    let panda: Robot<7> = Robot::named("Panda").unwrap();
    round_trips_with_settings(&panda.locked(3, 0.2).unwrap());
    let nominal: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let mut corrections = Corrections::NONE;
    corrections.rows[2] = [1e-4, 2e-4, 3e-4, 4e-4, 5e-4];
    let calibrated = nominal.with_corrections(&corrections).unwrap();
    let refined = calibrated.with_nominal(&nominal).unwrap();
    round_trips_with_settings(&refined.clone().coupled().unwrap());
    round_trips_with_settings(&refined);
    round_trips(&coupled.clone().with_linkage_limits(None).unwrap());
    round_trips(&coupled.with_linkage_limits(Some([-1.0, f64::INFINITY])).unwrap());
}

#[test]
fn an_arm_on_a_rail_round_trips_and_is_checked() {
    let rail = "<link name='floor'/><joint name='rail' type='prismatic'><parent link='floor'/>\
                <child link='base_link'/><axis xyz='1 2 3'/><limit lower='0' upper='2'/></joint>";
    let text = include_str!("data/ur5e.urdf").replace("</robot>", &format!("{rail}</robot>"));
    let arm = Arm::<6>::from_urdf(&text, None, Some("tool0")).unwrap().at(0.3).unwrap();
    round_trips(&arm);
    let written = serde_json::to_string(&arm).unwrap();
    let broken = written.replace("[0.0,2.0],1.0,0.3]", "[0.0,2.0],1.0,2.3]");
    assert_ne!(written, broken);
    let words = serde_json::from_str::<Arm<6>>(&broken).unwrap_err().to_string();
    assert!(words.contains("position is 2.3 m, it must be 0 to 2 m"), "{words}");
}

#[test]
fn joint_limits_round_trip() {
    let limits = JointLimits::new([[-1.0, 2.0], [f64::NEG_INFINITY, 0.5]]).unwrap();
    round_trips(&limits);
    round_trips(&JointLimits::<7>::UNLIMITED);
    assert_eq!(
        serde_json::to_string(&limits).unwrap(),
        r#"{"joints":[[-1.0,2.0],[null,0.5]],"linkage":null,"is_opposed":false}"#
    );
}

/// The error for a robot as text with one part replaced.
fn error_with(old: &str, new: &str) -> String {
    let robot: Robot<6> = Robot::named("UR5e").unwrap().with_max_velocity(Some([3.0; 6])).unwrap();
    let text = serde_json::to_string(&robot).unwrap();
    assert!(text.contains(old), "{text}");
    serde_json::from_str::<Robot<6>>(&text.replacen(old, new, 1)).unwrap_err().to_string()
}

#[test]
fn a_robot_is_checked_when_it_is_read() {
    let velocity = error_with(r#""max_velocity":["#, r#""max_velocity":[-1.0,"#);
    assert!(velocity.contains('6') && velocity.contains('7'), "{velocity}");
    let panda = serde_json::to_string(&Robot::<7>::named("Panda").unwrap()).unwrap();
    let coupled = panda.replacen(r#""coupled":false"#, r#""coupled":true"#, 1);
    let coupled = serde_json::from_str::<Robot<7>>(&coupled).unwrap_err().to_string();
    assert!(coupled.contains("90.0 deg off parallel"), "{coupled}");
    let limits = error_with(r#""joints":[[-6.28"#, r#""joints":[[16.28"#);
    assert!(limits.contains("joint 1 limit is empty"), "{limits}");
    let tool = error_with(r#""tool":{"rotation":[1.0"#, r#""tool":{"rotation":[2.0"#);
    assert!(tool.contains("rotation"), "{tool}");
    let limit = serde_json::from_str::<JointLimits<1>>(r#"{"joints":[[2.0,1.0]],"linkage":null}"#);
    let words = limit.unwrap_err().to_string();
    assert!(words.contains("joint 1 limit is empty"), "{words}");
}

#[test]
fn answers_round_trip() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let straight = [0.3, 0.2, 0.1, 0.4, 0.0, -0.7];
    let solutions = robot.ik(&robot.fk(&straight)).unwrap();
    assert!(solutions.iter().any(|solution| solution.free_joint.is_some()));
    for solution in &solutions {
        round_trips::<Solution<6>>(solution);
    }
    for status in &*solutions.status() {
        round_trips::<Status>(status);
    }
    round_trips(&solutions);
    round_trips(&solutions.filter(|_| false));
    let mut far = robot.fk(&straight);
    far.translation.x += 9.0;
    round_trips(&robot.ik(&far).unwrap());
    round_trips::<Configuration>(&robot.configuration(&straight).unwrap());
    round_trips(&robot.singularity(&straight));
    round_trips(&robot.residual(&straight, &robot.fk(&[0.0; 6])));
}

#[test]
fn options_round_trip() {
    round_trips(&FollowOptions {
        singularity_mode: SingularityMode::LockAxis4,
        ..FollowOptions::default()
    });
}

#[test]
fn a_table_with_too_many_rows_is_refused() {
    let panda: Robot<7> = Robot::named("Panda").unwrap();
    let text = serde_json::to_string(panda.mdh()).unwrap();
    assert!(serde_json::from_str::<Mdh<6>>(&text).is_err());
}
