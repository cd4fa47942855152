//! What users keep is written and read back as it was.
#![allow(clippy::unwrap_used)]

use std::fmt::Debug;

use irbkin::{
    Configuration, FollowOptions, Mdh, OpwParameters, Robot, Sdh, SingularityMode, Solution, Status,
};
use serde::Serialize;
use serde::de::DeserializeOwned;

fn comes_back<T: Serialize + DeserializeOwned + PartialEq + Debug>(kept: &T) {
    let text = serde_json::to_string(kept).unwrap();
    assert_eq!(&serde_json::from_str::<T>(&text).unwrap(), kept, "{text}");
}

#[test]
fn models_round_trip() {
    comes_back(&OpwParameters::abb(0.1, -0.135, 0.615, 0.705, 0.755, 0.085));
    let panda: Robot<7> = Robot::named("Panda").unwrap();
    comes_back::<Mdh<7>>(panda.mdh());
    let Mdh { base, rows, flange } = panda.mdh().clone();
    comes_back(&Sdh { base, rows, flange });
}

#[test]
fn answers_round_trip() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let straight = [0.3, 0.2, 0.1, 0.4, 0.0, -0.7];
    let solutions = robot.ik(&robot.fk(&straight)).unwrap();
    assert!(solutions.iter().any(|solution| solution.free_joint.is_some()));
    for solution in &solutions {
        comes_back::<Solution<6>>(solution);
    }
    for status in &*solutions.status() {
        comes_back::<Status>(status);
    }
    comes_back::<Configuration>(&robot.configuration(&straight).unwrap());
    comes_back(&robot.singularity(&straight));
    comes_back(&robot.residual(&straight, &robot.fk(&[0.0; 6])));
}

#[test]
fn options_round_trip() {
    comes_back(&FollowOptions {
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
