//! `CalcJointT`, `CalcRobT` and the tables of whole modules.

use crate::common::{Rng, apart};
use irbkin::{Configuration, Error as RobotError, Pose, Robot, pose};
use irbkin_abb::Error;
use irbkin_abb::rapid::{
    Code, Fallback, JointTarget, LoadData, RapidPose, RobTarget, TableRow, ToolData, WobjData,
    calc_joint_t, calc_joint_t_or, calc_moves, calc_rob_t, calc_targets, error_name, parse,
};

const EXTAX: [f64; 6] = [12.5, 9e9, 9e9, 9e9, 9e9, 9e9];

fn frame(trans_mm: [f64; 3], rot: [f64; 4]) -> RapidPose {
    RapidPose { trans_mm, rot }
}

fn gun(robhold: bool) -> ToolData {
    let half = 0.5_f64.sqrt();
    ToolData {
        robhold,
        tframe: frame([30.0, -20.0, 250.0], [half, 0.0, half, 0.0]),
        tload: LoadData::LOAD0,
    }
}

fn fixture(robhold: bool) -> WobjData {
    let (uframe, oframe) = (
        frame([900.0, -200.0, 400.0], [0.8, 0.0, 0.0, 0.6]),
        frame([10.0, 20.0, 30.0], [0.0, 0.6, 0.8, 0.0]),
    );
    WobjData { robhold, ufprog: true, ufmec: String::new(), uframe, oframe }
}

/// What is wrong with a target, without the instruction; empty if nothing is.
fn words(row: &TableRow) -> &str {
    let message = row.finding.as_ref().map_or("", |finding| finding.message.as_str());
    message.split_once(": ").map_or("", |(_, words)| words)
}

fn pose(frame: &RapidPose) -> Pose {
    pose::from_wxyz(frame.trans_mm.map(|mm| mm / 1e3), frame.rot).unwrap()
}

fn arms() -> [Robot<6>; 3] {
    let standing = Robot::named("IRB 2600-12/1.65").unwrap();
    let hanging = standing
        .clone()
        .with_base(&pose(&frame([100.0, 200.0, 3000.0], [0.0, 1.0, 0.0, 0.0])))
        .unwrap();
    [standing, hanging, Robot::named("IRB 2400-10/1.55").unwrap()]
}

/// Carried by the robot, the tool is at the target in the work object, both in the world frame;
/// with a stationary tool, they swap roles.
#[test]
fn tool_and_work_object_are_combined_in_the_world_frame() {
    let mut rng = Rng::new(21);
    for robot in arms() {
        for (tool, wobj) in [(gun(true), fixture(false)), (gun(false), fixture(true))] {
            for _ in 0..200 {
                let q = rng.inside(robot.limits());
                let joints = JointTarget { robax_deg: q.map(f64::to_degrees), extax: EXTAX };
                let target = calc_rob_t(&robot, &joints, Some(&tool), Some(&wobj)).unwrap();
                let (t_tool, t_wobj) =
                    (pose(&tool.tframe), pose(&wobj.uframe) * pose(&wobj.oframe));
                let t_world_flange = robot.fk(&q);
                let (t_world_tool, t_world_wobj) = if tool.robhold {
                    (t_world_flange * t_tool, t_wobj)
                } else {
                    (t_tool, t_world_flange * t_wobj)
                };
                let seen = t_world_wobj * pose(&frame(target.trans_mm, target.rot));
                assert!((seen.translation.vector - t_world_tool.translation.vector).norm() < 1e-14);
                assert!((seen.rotation.matrix() - t_world_tool.rotation.matrix()).amax() < 1e-14);
                assert_eq!(target.extax, EXTAX);
            }
        }
    }
}

#[test]
fn joint_angles_round_trip_through_their_robtarget() {
    let mut rng = Rng::new(22);
    for robot in arms() {
        for (tool, wobj) in [(gun(true), fixture(false)), (gun(false), fixture(true))] {
            let mut kept = 0;
            for _ in 0..300 {
                let q = rng.inside(robot.limits());
                if robot.singularity(&q).min_singular_value < 0.01 {
                    continue;
                }
                let joints = JointTarget { robax_deg: q.map(f64::to_degrees), extax: EXTAX };
                let target = calc_rob_t(&robot, &joints, Some(&tool), Some(&wobj)).unwrap();
                let back = calc_joint_t(&robot, &target, Some(&tool), Some(&wobj)).unwrap();
                let off = back
                    .robax_deg
                    .iter()
                    .zip(joints.robax_deg)
                    .map(|(a, b)| (a - b).abs())
                    .fold(0.0, f64::max);
                // Behind the elbow the configuration of a coupled arm names another posture.
                if !(robot.is_coupled() && off > 1.0) {
                    assert!(off < 1e-9, "{off} deg");
                    kept += 1;
                }
                assert_eq!(back.extax, EXTAX);
            }
            assert!(kept > 150, "{kept}");
        }
    }
}

#[test]
fn without_tool_and_work_object_those_of_the_robot_are_used() {
    let tool = pose(&gun(true).tframe);
    let robot = arms()[1].clone().with_tool(&tool).unwrap();
    let joints = JointTarget { robax_deg: [10.0, 20.0, 30.0, 40.0, 50.0, 60.0], extax: EXTAX };
    let target = calc_rob_t(&robot, &joints, None, None).unwrap();
    let seen = pose(&frame(target.trans_mm, target.rot));
    let q = joints.robax_deg.map(f64::to_radians);
    assert!((seen.translation.vector - robot.fk(&q).translation.vector).norm() < 1e-15);
    assert_eq!(
        calc_rob_t(&robot, &joints, Some(&ToolData::TOOL0), Some(&WobjData::WOBJ0)),
        calc_rob_t(&arms()[1], &joints, None, None)
    );
}

#[test]
fn errors_have_the_names_of_rapid() {
    let robot = &arms()[0];
    let target = |trans_mm, cfx| RobTarget {
        trans_mm,
        rot: [0.0, 0.0, 1.0, 0.0],
        robconf: Configuration { cf1: 0, cf4: 0, cf6: 0, cfx },
        extax: EXTAX,
    };
    let refused = |target: &RobTarget| calc_joint_t(robot, target, None, None).unwrap_err();
    assert_eq!(error_name(&refused(&target([3000.0, 0.0, 0.0], 0))), Some("ERR_OUTSIDE_REACH"));
    let unmet = refused(&target([900.0, 200.0, 600.0], 7));
    assert!(matches!(unmet, Error::Robot(RobotError::NoConfiguration(_))));
    assert_eq!(error_name(&unmet), Some("ERR_ROBLIMIT"));
    assert_eq!(error_name(&refused(&target([900.0, 200.0, 600.0], 8))), None);
    let seed = [0.2, 0.0, 0.0, 0.0, 0.5, 0.0];
    let nearest = calc_joint_t_or(
        robot,
        &target([900.0, 200.0, 600.0], 7),
        None,
        None,
        Fallback::Nearest(seed),
    )
    .unwrap();
    let q = nearest.robax_deg.map(f64::to_radians);
    assert!(apart(&q, &robot.ik_nearest(&robot.fk(&q), &seed, &[1.0; 6]).unwrap().q) < 1e-12);
}

#[test]
fn frames_that_cannot_be_combined_are_refused() {
    let robot = &arms()[0];
    let joints = JointTarget { robax_deg: [0.0; 6], extax: EXTAX };
    let message = |tool: &ToolData, wobj: &WobjData| {
        calc_rob_t(robot, &joints, Some(tool), Some(wobj)).unwrap_err().to_string()
    };
    assert_eq!(
        message(&gun(true), &fixture(true)),
        "the robot holds the tool and the work object: robhold must be TRUE for one of them"
    );
    assert_eq!(
        message(&gun(false), &fixture(false)),
        "the robot holds neither the tool nor the work object: robhold must be TRUE for one of them"
    );
    let moved = WobjData { ufprog: false, ufmec: "STN_1".to_string(), ..fixture(false) };
    assert!(
        message(&gun(true), &moved)
            .contains("moved (ufprog FALSE) by the mechanical unit \"STN_1\"")
    );
    let skew = WobjData { oframe: frame([0.0; 3], [0.5, 0.0, 0.0, 0.0]), ..fixture(false) };
    assert_eq!(
        message(&gun(true), &skew),
        "oframe: quaternion norm is 0.500000, it must be 1 within 2e-3 (order is w, x, y, z)"
    );
}

const PROGRAM: &str = r#"
MODULE Table
    PERS tooldata tGun:=[TRUE,[[0,0,110],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
    PERS wobjdata wFix:=[FALSE,TRUE,"",[[300,-175,1],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    CONST robtarget p10:=[[425,325,308],[0,-0.707106781,0.707106781,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget pZero:=[[325,50,323],[0,-0.707106781,0.707106781,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget row{2}:=[p10,pZero];
    CONST robtarget pFar:=[[4000,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC main()
        MoveJ p10,v100,fine,tGun\WObj:=wFix;
        MoveC pZero,p10,v100,z10,tGun\WObj:=wFix;
        MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
        MoveL pFar,v100,fine,tGun;
        MoveL p10,v100,fine,tElsewhere;
        MoveAbsJ [[0,0,99,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
    ENDPROC
ENDMODULE
"#;

#[test]
fn a_table_has_a_row_for_each_target_of_the_moves() {
    let robot: Robot<6> = Robot::named("IRB 140-6/0.81").unwrap();
    let module = parse(PROGRAM, &[]).unwrap();
    let rows = calc_moves(&robot, &module, Fallback::None).unwrap();
    let said: Vec<_> =
        rows.iter().map(|row| (row.kind, row.text.as_str(), row.line, row.q.is_some())).collect();
    let absolute = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    assert_eq!(
        said,
        [
            ("MoveJ", "p10", 10, true),
            ("MoveC", "pZero", 11, false),
            ("MoveC", "p10", 11, true),
            ("MoveAbsJ", absolute, 12, true),
            ("MoveL", "pFar", 13, false),
            ("MoveL", "p10", 14, false),
            ("MoveAbsJ", "[[0,0,99,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]", 15, true),
        ]
    );
    let problem = |row: usize| words(&rows[row]);
    assert!(problem(1).starts_with(
        "ERR_ROBLIMIT: no solution inside the limits has the \
            configuration [0, 0, 0, 0]; there are [-1, 0, -2, 0]"
    ));
    assert!(problem(4).starts_with("ERR_OUTSIDE_REACH: wrist center"));
    assert!(problem(5).starts_with("tool tElsewhere: "), "{}", problem(5));
    assert_eq!(problem(6), "ERR_ROBLIMIT: J3 is outside its limits by 49.0 deg");
    for row in &rows {
        let Some(q) = row.q else { continue };
        assert_eq!(row.configuration, robot.configuration(&q).unwrap());
        assert_eq!(row.distances, robot.singularity(&q).distances);
    }
    // As on the controller.
    let degrees = rows[0].q.unwrap().map(f64::to_degrees);
    for (found, derived) in
        degrees.into_iter().zip([11.6894, 55.6175, -44.8034, 0.0, 79.1858, -78.3106])
    {
        assert!((found - derived).abs() < 1e-4);
    }
}

#[test]
fn a_configuration_without_solution_can_fall_back_to_the_nearest_joints() {
    let robot: Robot<6> = Robot::named("IRB 140-6/0.81").unwrap();
    let module = parse(PROGRAM, &[]).unwrap();
    let rows = calc_moves(&robot, &module, Fallback::Nearest([0.0; 6])).unwrap();
    let (before, row) = (rows[0].q.unwrap(), &rows[1]);
    let flange = robot.fk(&row.q.unwrap());
    assert!(
        apart(&row.q.unwrap(), &robot.ik_nearest(&flange, &before, &[1.0; 6]).unwrap().q) < 1e-12
    );
    assert!(words(row).ends_with("; the nearest to the joints before is taken"));
    assert_eq!(row.finding.as_ref().map(|it| it.code), Some(Code::WrongConfdata));
    assert!(rows[4].q.is_none(), "out of reach stays so");
}

#[test]
fn declared_targets_have_a_row_each_by_their_names() {
    let robot: Robot<6> = Robot::named("IRB 140-6/0.81").unwrap();
    let module = parse(PROGRAM, &[]).unwrap();
    let gun =
        ToolData { tframe: frame([0.0, 0.0, 110.0], [1.0, 0.0, 0.0, 0.0]), ..ToolData::TOOL0 };
    let wobj =
        WobjData { uframe: frame([300.0, -175.0, 1.0], [1.0, 0.0, 0.0, 0.0]), ..WobjData::WOBJ0 };
    let rows = calc_targets(&robot, &module, Some(&gun), Some(&wobj), Fallback::None).unwrap();
    let said: Vec<_> =
        rows.iter().map(|row| (row.text.as_str(), row.line, row.q.is_some())).collect();
    assert_eq!(
        said,
        [
            ("p10", 5, true),
            ("pZero", 6, false),
            ("row{1}", 7, true),
            ("row{2}", 7, false),
            ("pFar", 8, false)
        ]
    );
    assert!(matches!(
        calc_targets(&Robot::<6>::named("UR3").unwrap(), &module, None, None, Fallback::None),
        Err(Error::Robot(RobotError::InvalidModel(_)))
    ));
}

#[test]
fn displaced_moves_and_absent_axes_have_no_joint_angles() {
    let robot: Robot<6> = Robot::named("IRB 140-6/0.81").unwrap();
    let text = "CONST jointtarget j:=[[0,0,9E9,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
        MoveAbsJ j,v100,fine,tool0;
        MoveAbsJ [[0,0,0,0,-2E6,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
        VAR robtarget p:=[[500,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
        MoveL p,v100,fine,tool0;
        PDispSet x;
        MoveC p,p,v100,fine,tool0;
        PDispOff;
        MoveL q,v100,fine,tool0;
        VAR robtarget q:=p; q:=CRobT();";
    let rows = calc_moves(&robot, &parse(text, &[]).unwrap(), Fallback::None).unwrap();
    let problems: Vec<_> = rows.iter().map(words).collect();
    assert_eq!(problems[0], "axis 3 is 9E9: it is not there");
    assert_eq!(problems[1], "axis 5 is -2000000: it is not there");
    assert_eq!(problems[3..5], ["line 6 displaces it, which is not followed"; 2]);
    assert_eq!(problems[5], "refers to q, which line 10 assigns");
    let has_joints: Vec<_> = rows.iter().map(|row| row.q.is_some()).collect();
    assert_eq!(has_joints, [false, false, true, false, false, false]);
}
