//! Robots and solutions as text.

use irbkin::{Pose, Robot};

#[test]
fn a_robot_names_its_structure_and_settings() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    assert_eq!(robot.to_string(), "IRB 2600-12/1.65 (6 joints, spherical wrist structure)");
    let tool = Pose::translation(0.0, 0.0, 0.1);
    let changed = robot.with_tool(&tool).unwrap().coupled().unwrap().with_name("");
    assert_eq!(
        changed.to_string(),
        "unnamed robot (6 joints, spherical wrist structure, axes 2 and 3 coupled, with tool)"
    );
}

#[test]
fn solutions_are_a_table_with_a_line_each() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let regular = robot.ik(&robot.fk(&[0.1, 0.2, 0.3, 0.4, 0.5, 0.6])).unwrap();
    let table = regular.to_string();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 2 + regular.len(), "{table}");
    assert_eq!(lines[0], regular.explain().to_string());
    assert_eq!(lines[1], "slot       J1       J2       J3       J4       J5       J6  [deg]");
    assert!(table.contains("    5.73    11.46    17.19    22.92    28.65    34.38  inside limits"));
}

#[test]
fn a_solution_names_its_singularity_and_its_free_joint() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let solutions = robot.ik(&robot.fk(&[0.0; 6])).unwrap();
    let line = solutions.slot(0).unwrap().to_string();
    assert_eq!(
        line,
        "   0     0.00     0.00     0.00     0.00     0.00     0.00  inside limits, wrist \
         singularity, J4 undetermined"
    );
}

#[test]
fn an_answer_without_solutions_is_its_explanation() {
    let robot: Robot<6> = Robot::named("IRB 2600-12/1.65").unwrap();
    let solutions = robot.ik(&Pose::translation(9.0, 0.0, 0.0)).unwrap();
    assert_eq!(solutions.to_string(), solutions.explain().to_string());
}
