//! Where the robot is in a program: read, calculated, and forgotten.

use std::format;
use std::string::String;
use std::vec::Vec;

use super::program::{FAR, data, of, outcome};
use crate::rapid::{Code, MotionOptions, motion, read};
use irbkin_motion::Arm;

const GO: &str = "VAR robtarget p; VAR jointtarget j; MoveJ a,v100,fine,t; ";
/// A target 2 m beside where the robot is: out of reach if that is known.
const BESIDE: &str = "MoveL Offs(p,0,2000,0),v100,fine,t;";

/// The codes of a body behind a move to `a`, and how many of its moves are checked.
fn behind(body: &str) -> (Vec<Code>, usize) {
    let (codes, known, _) = outcome(&format!("{GO}{body}"));
    (codes, known)
}

/// The message of the only finding behind a move to `a`.
fn message(body: &str) -> String {
    let found = of(&format!("{GO}{body}")).findings;
    let messages: Vec<_> = found.into_iter().map(|it| it.message).collect();
    assert_eq!(messages.len(), 1, "{body}: {messages:?}");
    messages[0].clone()
}

/// The joints of the last move of a body [rad].
fn last(body: &str) -> [f64; 6] {
    let found = of(body);
    found.moves.last().and_then(|it| it.q).unwrap_or_else(|| panic!("{body}: {found:?}"))
}

fn assert_near(a: [f64; 6], b: [f64; 6], bound: f64) {
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < bound), "{a:?} {b:?}");
}

#[test]
fn behind_a_fine_move_the_robot_is_at_its_target() {
    let reach = (Vec::from([Code::OutOfReach]), 2);
    for read in ["CRobT()", "CRobT(\\Tool:=t\\WObj:=wobj0)", "CRobT(\\Tool:=u)"] {
        assert_eq!(behind(&format!("p:={read}; {BESIDE}")), reach, "{read}");
    }
    assert_eq!(behind("MoveL Offs(CRobT(),0,2000,0),v100,fine,t;"), reach);
    assert_eq!(behind("p:=a; p.trans:=CPos(); p.trans.y:=2000; MoveL p,v100,fine,t;"), reach);
    let own = "p:=CRobT(); MoveJ a,v100,z10,t; MoveJ p,v100,fine,t;";
    assert_eq!(last(&format!("{GO}{own}")), last(GO));
    // Its confdata is taken as it is written, external axes as they are.
    assert_eq!(behind(&format!("ConfJ\\Off; p:=CRobT(); {BESIDE}")), reach);
    let beyond = message("MoveJ f,v100,fine,t; MoveJ CRobT(),v100,fine,t;");
    assert!(beyond.contains("eax_a is at 2000"), "{beyond}");
    // Through a call and back, a stop point, a line that waits, both parts of a branch.
    for body in [
        "stay; ENDPROC PROC stay() MoveL Offs(CRobT(),0,2000,0),v100,fine,t;",
        "MoveJ a,v100,z10\\Inpos:=inpos50,t; p:=CRobT(); MoveL Offs(p,0,2000,0),v100,fine,t;",
        "WaitTime 1; TPErase; IF x THEN TPWrite \"\"; ENDIF p:=CRobT(); MoveL Offs(p,0,2000,0),v100,fine,t;",
    ] {
        assert_eq!(behind(body).0, [Code::OutOfReach], "{body}");
    }
}

#[test]
fn where_the_robot_may_be_elsewhere_its_position_is_not_known() {
    for (before, why) in [
        ("MoveJ a,v100,z10,t;", "the move before it has a zone"),
        ("MoveJ \\Conc,a,v100,fine,t;", "may end elsewhere"),
        ("SearchL d,p,a,v100,t;", "may end elsewhere"),
        ("ArcLStart a,v100,s,w,fine,t;", "may end elsewhere"),
        ("IF x THEN MoveJ b,v100,fine,t; ENDIF", "a branch, a loop or a label"),
        ("WHILE x DO MoveJ b,v100,fine,t; ENDWHILE", "a branch, a loop or a label"),
        ("again:", "a branch, a loop or a label"),
        ("jog;", "moved by hand or by a call"),
        ("BrakeCheck;", "moved by hand or by a call"),
        ("Stop;", "moved by hand or by a call"),
        ("SetLeadThrough \\On;", "moved by hand or by a call"),
        ("look; ENDPROC PROC look() jog; ENDPROC PROC no()", "moved by hand or by a call"),
        ("PDispSet [[0,0,9],[1,0,0,0]];", "targets are displaced"),
        ("MoveExtJ [[0,0,0,0,0,0],[9,9,9,9,9,9]],v100,fine;", "external axes move"),
    ] {
        let (main, rest) = before.split_once(" ENDPROC").unwrap_or((before, ""));
        let rest = if rest.is_empty() { String::new() } else { format!(" ENDPROC{rest}") };
        let body = format!("{GO}{main} MoveL Offs(CRobT(),0,2000,0),v100,fine,t;{rest}");
        let found = of(&body).findings;
        let of_robot = found.iter().filter(|it| it.message.contains("CRobT: "));
        let messages: Vec<_> = of_robot.map(|it| (it.code, &*it.message)).collect();
        let [(code, message)] = messages[..] else { panic!("{body}: {found:?}") };
        assert!(code == Code::UnknownValue && message.contains(why), "{message}");
    }
    assert!(outcome(&format!("VAR robtarget p; p:=CRobT(); {BESIDE}")).0 == [Code::UnknownValue]);
    assert!(behind("%name%; p:=CRobT(); MoveL Offs(p,0,2000,0),v100,fine,t;").1 == 1);
    // A loop that moves is where its last pass ends.
    let twice = "WHILE x DO p:=CRobT(); MoveL Offs(p,0,2000,0),v100,fine,t; ENDWHILE";
    assert_eq!(behind(twice), (Vec::from([Code::UnknownValue]), 1));
    assert!(message("MoveL CRobT(\\TaskName:=\"T\"),v100,fine,t;").ends_with("is not evaluated"));
}

#[test]
fn another_tool_and_work_object_see_the_same_robot() {
    let other = "VAR tooldata g:=[TRUE,[[10,20,90],[0.8,0,0.6,0]],[2,[0,0,50],[1,0,0,0],0,0,0]]; \
        VAR wobjdata o:=[FALSE,TRUE,\"\",[[500,9,0],[0.6,0,0,0.8]],[[0,7,0],[1,0,0,0]]]; ";
    let seen = "p:=CRobT(\\Tool:=g\\WObj:=o); MoveJ p,v100,fine,g\\WObj:=o;";
    assert_near(last(&format!("{other}{GO}{seen}")), last(GO), 1e-9);
    let back = "MoveL CRobT(\\Tool:=t\\WObj:=wobj0),v100,fine,t;";
    assert_near(last(&format!("{other}{GO}{seen}{back}")), last(GO), 1e-9);
    // The robot stays, so its confdata does.
    assert_eq!(outcome(&format!("{other}{GO}{seen}{back}")), (Vec::new(), 3, 3));
}

#[test]
fn joints_are_read_and_calculated() {
    let joints = format!("[[10,20,30,40,50,60],{FAR}]");
    let go = format!("VAR robtarget p; VAR jointtarget j; MoveAbsJ {joints},v100,fine,t; ");
    let degrees = [10.0_f64, 20.0, 30.0, 40.0, 50.0, 60.0].map(f64::to_radians);
    assert_near(last(&format!("{go}MoveAbsJ CJointT(),v100,fine,t;")), degrees, 1e-15);
    // By forward kinematics, and back by the confdata.
    let position = format!("{go}p:=CRobT(); MoveJ p,v100,fine,t;");
    assert_near(last(&position), degrees, 1e-9);
    let calculated = format!("j:=CalcJointT(CalcRobT({joints},t),t); MoveAbsJ j,v100,fine,t;");
    assert_near(last(&format!("VAR jointtarget j; {calculated}")), degrees, 1e-9);
    assert_near(last(&format!("{GO}j:=CJointT(); MoveAbsJ j,v100,fine,t;")), last(GO), 1e-12);
    let off = "ConfJ\\Off; MoveAbsJ CJointT(),v100,fine,t;";
    assert!(message(off).ends_with("CJointT: ConfL or ConfJ is off"));
    // External axes pass through: one that no unit is known of shows.
    let on_unit = "MoveJ CalcRobT([[10,20,30,40,50,60],[7,9E9,9E9,9E9,9E9,9E9]],t),v100,fine,t;";
    assert!(message(on_unit).contains("eax_a"), "{}", message(on_unit));
}

#[test]
fn a_target_that_calcjointt_cannot_reach_is_an_error_once() {
    let far = message("MoveAbsJ CalcJointT(out,t),v100,fine,t;");
    assert!(far.contains("CalcJointT: ERR_OUTSIDE_REACH: "), "{far}");
    let found = outcome(
        "MoveAbsJ CalcJointT(Offs(a,0,50,0),t),v100,fine,t; \
        MoveAbsJ CalcJointT(out,t),v100,fine,t;",
    );
    assert_eq!(found, (Vec::from([Code::OutOfReach]), 2, 2));
    // Where it is assigned, once for all calls; the move that uses it is not checked.
    let found = of("go; go; ENDPROC PROC go() VAR jointtarget j; \n j:=CalcJointT(out,t); \
        MoveAbsJ j,v100,fine,t;");
    let reach: Vec<_> = found.findings.iter().filter(|it| it.code == Code::OutOfReach).collect();
    assert_eq!(reach.len(), 1);
    assert_eq!(reach[0].line, data().lines().count() + 4);
    // A confdata that no solution has is not decided.
    let other = format!("[[900,-300,500],[0,0,1,0],[3,-1,0,1],{FAR}]");
    let other = message(&format!("MoveAbsJ CalcJointT({other},t),v100,fine,t;"));
    assert!(other.contains("CalcJointT: "), "{other}");
}

#[test]
fn displacements_begin_where_the_robot_is() {
    let displaced = "PDispOn b,t; MoveJ b,v100,fine,t;";
    assert_near(
        last(&format!("{GO}{displaced}")),
        last(&format!("{GO}PDispOn \\ExeP:=a,b,t; MoveJ b,v100,fine,t;")),
        1e-12,
    );
    let turned =
        "PDispOn \\Rot,RelTool(a,0,0,0\\Rz:=10),t; MoveJ RelTool(a,0,0,0\\Rz:=10),v100,fine,t;";
    assert_near(last(&format!("{GO}{turned}")), last(GO), 1e-9);
    assert_eq!(behind("MoveJ a,v100,z10,t; PDispOn b,t; MoveJ b,v100,fine,t;").1, 2);
    // External axes are offset by what the robot's differ in.
    let go = "MoveJ e,v100,fine,t; EOffsOn e; MoveJ e,v100,fine,t;";
    assert_eq!(outcome(go), (Vec::new(), 2, 2));
    assert_eq!(outcome(&go.replace("EOffsOn e", "EOffsOn f")).1, 1);
}

#[test]
fn a_motion_goes_on_from_where_its_robot_is() {
    let go = format!("{GO}p:=CRobT(); MoveL Offs(p,0,50,0),v100,fine,t;");
    let text = format!("MODULE M\n{}PROC main()\n{go}\nENDPROC\nENDMODULE", data());
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let found = motion(&robot, &[&read(&text, &[])], None, &MotionOptions::default()).unwrap();
    assert_eq!(found.moves.len(), 2);
    assert!((found.moves[1].length - 0.05).abs() < 1e-9, "{:?}", found.moves[1]);
}
