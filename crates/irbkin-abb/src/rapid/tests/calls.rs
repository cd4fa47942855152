//! Findings of moves below calls: where they are, each once. Lines too short for their speed.

use std::format;
use std::string::String;
use std::vec::Vec;

use crate::rapid::{CheckOptions, Code, Finding, Severity, check, parse};
use irbkin_motion::Arm;

const DATA: &str = "PERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    CONST robtarget a:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget b:=[[900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget out:=[[2900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    PROC go(robtarget p) MoveJ p,v100,fine,t; ENDPROC
    PROC near(robtarget p,num h) go Offs(p,0,0,h); ENDPROC
    PROC pick(num h) go Offs(a,0,0,h); ENDPROC
    PROC at(num x) MoveJ [[x,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;
    ENDPROC";

/// A routine that names a target that is out of reach.
const STATION: &str = "PROC station(num n) go out; ENDPROC";

/// The findings of statements in `main`, which begins on line 1, with routines above it.
fn found(statements: &str) -> Vec<Finding> {
    let station = if statements.contains("station") { STATION } else { "" };
    let text = format!("MODULE M PROC main()\n{statements}\nENDPROC\n{DATA} {station} ENDMODULE");
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let module = parse(&text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    check(&robot, &[(&module, &text)], &CheckOptions::default()).unwrap().findings
}

/// The targets out of reach.
fn out_of_reach(statements: &str) -> Vec<Finding> {
    found(statements).into_iter().filter(|it| it.code == Code::OutOfReach).collect()
}

#[test]
fn a_finding_below_calls_is_where_its_target_is_written() {
    for (statements, wanted) in [
        ("go out;", 1),
        ("go a;\ngo Offs(out,0,0,1);", 2),
        ("near a,0;\nnear out,0;", 2),
        ("near a,9000;", 1),
        // Numbers alone are where they are passed on, a target with a number is where it is named.
        ("at 800;\nat 2900;", 2),
        ("pick 9000;", 0),
        ("station 1;", 0),
    ] {
        let last = statements.lines().count();
        let line = |it: &Finding| Some(it.line - 1).filter(|line| *line <= last).unwrap_or(0);
        let found: Vec<usize> = out_of_reach(statements).iter().map(line).collect();
        assert_eq!(found, [wanted], "{statements}");
    }
}

#[test]
fn one_target_through_many_calls_is_one_finding_with_their_places() {
    let calls: Vec<String> = (0..20).map(|n| format!("station {n};")).collect();
    let all = out_of_reach(&calls.join("\n"));
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(
        all[0].message.ends_with(" (called from 2:1, 3:1, 4:1, 5:1, 6:1 and 15 more)"),
        "{:?}",
        all[0]
    );
    assert_eq!(all[0].related, (2..22).map(|line| (0, line, 1)).collect::<Vec<_>>());

    let all = out_of_reach("go out;\ngo a;\ngo out;\ngo out;");
    assert_eq!(all.len(), 1, "{all:?}");
    assert!(all[0].message.ends_with("beyond reach (and 2 more calls)"), "{:?}", all[0]);
    assert_eq!(all[0].related, [(0, 4, 1), (0, 5, 1)]);
}

#[test]
fn a_finding_of_some_calls_names_them_and_their_number() {
    let words = |statements: &str| {
        let all = out_of_reach(statements);
        assert_eq!(all.len(), 1, "{all:?}");
        all[0].message.clone()
    };
    let some = words("pick 0;\npick 3000;\npick 9000;");
    assert!(some.ends_with(" (2 of 3 calls) (called from 3:1, 4:1)"), "{some}");
    let looped = "FOR i FROM 0 TO 9 DO pick 1000*i; ENDFOR\npick 0;";
    let some = words(looped);
    assert!(some.contains(" of 11 passes) (called from 2:22)"), "{some}");
}

#[test]
fn a_joint_is_too_fast_only_at_a_speed_that_the_length_of_its_line_allows() {
    let near = |length: f64| format!("MoveL Offs(a,0,{length},0),v7000,fine,t;");
    let speeds = |moves: &str| {
        let is_speed = |it: &Finding| it.code == Code::JointTooFast;
        found(moves).into_iter().filter(is_speed).collect::<Vec<_>>()
    };
    let [long] = &speeds(&format!("MoveJ a,v100,fine,t;\n{}", near(600.0)))[..] else {
        panic!("a long line is too fast")
    };
    assert!(long.message.contains("at the speed that its length allows"), "{long}");
    // From rest to rest no line of this length is faster than this, at 50 m/s^2.
    let most = (50.0_f64 * 0.6).sqrt();
    let reached = long.message.rsplit(' ').nth(1).unwrap().parse::<f64>().unwrap() / 1e3;
    assert!(reached <= most * (1.0 + 1e-3), "{reached} {most}");
    assert_eq!(speeds(&format!("MoveJ a,v100,fine,t;\n{}", near(40.0))), []);
    // Where it does not stop at either end, it may have any speed.
    let passed = "MoveJ a,v100,z5,t;\nMoveL Offs(a,0,40,0),v7000,z5,t;\nMoveL b,v100,fine,t;";
    assert_eq!(speeds(passed).len(), 1);
    // The duration of \T is kept with any acceleration.
    let timed = "MoveJ a,v100,fine,t;\nMoveL Offs(a,0,40,0),v100\\T:=0.005,fine,t;";
    assert_eq!(speeds(timed).len(), 1);
}

#[test]
fn zones_before_waits_are_one_finding_and_a_note_at_the_end_of_main() {
    let waits =
        "MoveJ a,v100,z5,t; WaitTime 1;\nMoveJ b,v100,z5,t; WaitDI d,1;\nMoveJ a,v100,z5,t;";
    let all: Vec<_> = found(waits).into_iter().filter(|it| it.code == Code::CornerPath).collect();
    let severities: Vec<_> = all.iter().map(|it| (it.line, it.severity())).collect();
    assert_eq!(severities, [(2, Severity::Warning), (4, Severity::Note)]);
    assert!(all[0].message.ends_with(" (and 1 more move)"), "{}", all[0]);
    assert!(all[1].message.ends_with(" (with the run mode single cycle)"), "{}", all[1]);
}
