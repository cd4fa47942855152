//! A module checked: codes, places, branches, corrections.

use std::format;
use std::string::{String, ToString};
use std::vec;
use std::vec::Vec;

use crate::Error;
use crate::rapid::{CheckOptions, Checked, Code, Finding, MotionOptions, Severity, check, parse};
use irbkin_motion::Arm;

const DATA: &str = "PERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    CONST robtarget a:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget b:=[[900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget out:=[[2900,300,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST robtarget c{2}:=[[[900,-250,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],
        [[900,-200,500],[0,0,1,0],[ 2, 0 , 2,0 ],[9E9,9E9,9E9,9E9,9E9,9E9]]];";

fn text(moves: &str) -> String {
    format!("MODULE M\n{DATA}\nPROC main()\n{moves}\nENDPROC\nENDMODULE")
}

/// The findings of a check, without the edges of quarters: these targets have axis 4 at zero; and
/// without names that are taken for signals.
fn checked(text: &str) -> Vec<Finding> {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let module = parse(text, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let mut found = check(&robot, &[(&module, text)], &CheckOptions::default()).unwrap().findings;
    found.retain(|it| ![Code::ConfdataEdge, Code::UnknownSignal].contains(&it.code));
    found
}

fn codes(moves: &str) -> Vec<Code> {
    checked(&text(moves)).iter().map(|it| it.code).collect()
}

/// A text with the corrections of its findings.
fn corrected(text: &str) -> String {
    let mut edits: Vec<_> = checked(text).into_iter().flat_map(|it| it.edits).collect();
    edits.sort_by_key(|edit| edit.span.start);
    edits.dedup();
    let mut corrected = text.to_string();
    for edit in edits.iter().rev() {
        corrected.replace_range(edit.span.clone(), &edit.text);
    }
    corrected
}

#[test]
fn a_module_without_faults_has_none() {
    assert_eq!(codes("MoveJ a,v1000,z20,t; MoveL b,v100,fine,t; MoveJ c{1},v500,fine,t;"), []);
}

#[test]
fn every_code_has_an_id_and_a_name_of_its_own() {
    let mut ids: Vec<_> = Code::ALL.iter().map(|code| code.id()).collect();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), Code::ALL.len());
    let mut names: Vec<_> = Code::ALL.iter().map(|code| code.name()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), Code::ALL.len());
}

#[test]
fn a_group_has_one_severity() {
    for code in Code::ALL {
        let wanted = match (code, code.id().chars().next()) {
            (_, Some('U')) | (Code::NearConfdata, _) => Severity::Note,
            (_, Some('S' | 'V' | 'Z')) | (Code::AmbiguousConfdata | Code::ExternalAxes, _) => {
                Severity::Warning
            }
            _ => Severity::Error,
        };
        assert_eq!(code.severity(), wanted, "{}", code.id());
        let is_shown = code.is_default() || code == Code::ZoneTooLarge;
        assert!(is_shown || wanted == Severity::Note, "{}", code.id());
    }
}

#[test]
fn each_fault_has_its_code() {
    for (moves, wanted) in [
        ("MoveJ out,v100,fine,t;", Code::OutOfReach),
        ("MoveAbsJ [[190,0,0,0,9,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v9,fine,t;", Code::OutsideLimits),
        ("MoveAbsJ [[9E9,0,0,0,9,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v5,fine,t;", Code::AbsentAxis),
        ("MoveJ c{2},v100,fine,t;", Code::WrongConfdata),
        ("MoveJ c{1},v100,fine,t; MoveL c{2},v100,fine,t;", Code::OtherConfiguration),
        ("MoveJ a,v100,fine,t; MoveL b,v7000,fine,t;", Code::JointTooFast),
        ("MoveJ a,v100,fine,t; MoveL c{1},v100,z50,t; MoveL a,v100,fine,t;", Code::ZoneTooLarge),
        ("MoveJ nowhere,v100,fine,t;", Code::UnknownTarget),
        ("MoveJ a,v100,fine,tt;", Code::UnknownTool),
        ("MoveJ a,v100,fine,t\\WObj:=w;", Code::UnknownWorkObject),
        ("MoveJ a,fast,fine,t;", Code::UnknownSpeed),
        ("MoveJ a,v100,zz,t;", Code::UnknownZone),
        ("MoveJ [[900,0,500],[0,0,2,0],[0,0,0,0],[0,0,0,0,0,0]],v5,fine,t;", Code::InvalidFrame),
        ("MoveJ a,[0,500,1,1],fine,t;", Code::InvalidNumber),
        ("MoveJ *,v100,fine,t;", Code::UnknownValue),
        ("MoveJ a,v100,fine,t; ArcRepL b,v100,x,fine,t;", Code::NotFollowed),
    ] {
        let moves = moves.replace("v9,", "v100,");
        assert_eq!(codes(&moves), [wanted], "{moves}");
    }
}

#[test]
fn a_singular_target_is_ambiguous_and_a_singular_line_is_found() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let target = |degrees: [f64; 6]| {
        let joints = crate::rapid::JointTarget { robax_deg: degrees, extax: [9e9; 6] };
        crate::rapid::calc_rob_t(&robot, &joints, None, None).unwrap()
    };
    let at = target([5.0, 10.0, 20.0, 30.0, 0.0, 40.0]);
    assert_eq!(codes(&format!("MoveJ {at},v100,fine,tool0;")), [Code::AmbiguousConfdata]);
    let [from, to] = [1.0, -1.0].map(|side| target([0.0, 10.0, 20.0, 0.0, 20.0 * side, 0.0]));
    let line = format!("MoveJ {from},v100,fine,tool0; MoveL {to},v100,fine,tool0;");
    assert!(codes(&line).contains(&Code::WristSingularity), "{:?}", codes(&line));
}

#[test]
fn the_wrist_turns_over_to_the_programmed_configuration_under_sing_area_wrist() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let target = |degrees: [f64; 6]| {
        let joints = crate::rapid::JointTarget { robax_deg: degrees, extax: [9e9; 6] };
        crate::rapid::calc_rob_t(&robot, &joints, None, None).unwrap()
    };
    let from = target([9.0, 10.0, 20.0, 15.0, 40.0, 20.0]);
    let to = target([12.0, 4.0, 26.0, -8.0, -15.0, 60.0]);
    let line = format!("MoveJ {from},v100,fine,tool0; MoveL {to},v100,fine,tool0;");
    assert_eq!(codes(&format!("SingArea\\Wrist; {line}")), []);
    assert_ne!(codes(&line), []);
    let text = text(&format!("SingArea\\Wrist; {line}"));
    let module = parse(&text, &[]).unwrap();
    let options = MotionOptions::default();
    let found = crate::rapid::motion(&robot, &[&module], None, &options).unwrap();
    // The tool stays on the line, and the joints arrive as programmed.
    let ends = [from, to].map(|it| nalgebra::Vector3::from(it.trans_mm) / 1e3);
    let way = ends[1] - ends[0];
    for q in &found.q {
        let off = robot.fk(q).translation.vector - ends[0];
        assert!(off.cross(&way).norm() / way.norm() < 1e-9, "{q:?}");
    }
    let last = found.q.last().unwrap();
    let wanted = [12.0, 4.0, 26.0, -8.0, -15.0, 60.0_f64].map(f64::to_radians);
    assert!(last.iter().zip(wanted).all(|(a, b)| (a - b).abs() < 1e-9), "{last:?}");
}

#[test]
fn a_branch_is_checked_from_where_the_robot_is_before_it() {
    let branch = "MoveJ a,v100,fine,t;
        IF go THEN MoveL b,v7000,fine,t; ELSE MoveL b,v100,fine,t; ENDIF";
    assert_eq!(codes(branch), [Code::JointTooFast]);
    // Behind a branch that moves nothing is known: the line is not checked, its target is.
    let behind = format!("{} MoveL a,v7000,fine,t;", branch.replace("v7000", "v100"));
    assert_eq!(codes(&behind), []);
    let behind = behind.replace("MoveL a", "MoveL c{2}");
    assert_eq!(codes(&behind), [Code::WrongConfdata]);
    for quiet in [
        "IF go THEN Set do1; ENDIF",
        "IF go RETURN;",
        "IF go THEN MoveL a,v100,fine,t; \
        RETURN; ENDIF",
        "FOR i FROM 1 TO 3 DO Set do1; ENDFOR",
    ] {
        let moves = format!("MoveJ a,v100,fine,t; {quiet} MoveL b,v7000,fine,t;");
        assert_eq!(codes(&moves), [Code::JointTooFast], "{quiet}");
    }
    for unknown in [
        "IF go MoveL a,v100,fine,t;",
        "again:",
        "WHILE go DO MoveL a,v100,fine,t; \
        ENDWHILE",
        "GOTO away; away:",
        "ENDPROC PROC other()",
        "ERROR",
    ] {
        let moves = format!("MoveJ a,v100,fine,t; {unknown} MoveL b,v7000,fine,t;");
        assert_eq!(codes(&moves), [], "{unknown}");
    }
}

#[test]
fn corrections_change_numbers_of_confdata_and_nothing_else() {
    let before = text("MoveJ c{1},v100,fine,t; MoveL c{2},v100,fine,t;");
    let after = corrected(&before);
    assert_eq!(after, before.replace("[ 2, 0 , 2,0 ]", "[ -1, 0 , -1,0 ]"));
    assert_eq!(checked(&after), []);
}

#[test]
fn confdata_of_inline_targets_locals_and_references_is_found() {
    let inline = "[[900,-250,500],[0,0,1,0],[1,0,1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    for (moves, from, to) in [
        (format!("MoveJ {inline},v100,fine,t;"), "[1,0,1,0],[9E9", "[-1,0,-1,0],[9E9"),
        (
            format!("VAR robtarget l:={inline}; CONST robtarget k:=l; MoveJ k,v100,fine,t;"),
            "[1,0,1,0],[9E9",
            "[-1,0,-1,0],[9E9",
        ),
        (
            format!(
                "CONST confdata q:=[1,0,1,0]; VAR robtarget l:={}; MoveJ Offs(l,0,0,9),v100,fine,t;",
                inline.replace("[1,0,1,0]", "q")
            ),
            ",q,",
            ",[-1,0,-1,0],",
        ),
    ] {
        let before = text(&moves);
        let (head, tail) = before.split_at(before.find("PROC").unwrap());
        assert_eq!(corrected(&before), format!("{head}{}", tail.replace(from, to)));
        assert_eq!(checked(&corrected(&before)), [], "{moves}");
    }
}

#[test]
fn a_target_is_met_up_to_a_quarter_beside_its_own() {
    for (moves, wanted) in [
        // Axes 1 and 6 are at -15.5 deg: in the quarter -1.
        ("MoveJ at,v100,fine,t;", Code::NearConfdata),
        ("MoveJ c{1},v100,fine,t; MoveL at,v100,fine,t;", Code::NearConfdata),
        ("MoveJ at,v100,fine,t; MoveL Offs(at,0,9,0),v100,fine,t;", Code::NearConfdata),
    ] {
        let near = "[[900,-250,500],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
        let moves = moves.replace("at", near);
        assert!(codes(&moves).iter().all(|it| *it == wanted), "{moves}: {:?}", codes(&moves));
        for (of, far) in [("[0,0,-1,0]", "[2,0,-1,0]"), ("[0,0,-1,0]", "[0,0,-1,1]")] {
            let found = codes(&moves.replace(of, far));
            let is_wrong = |it: &Code| matches!(it, Code::WrongConfdata | Code::OtherConfiguration);
            assert!(found.first().is_some_and(is_wrong), "{moves}: {found:?}");
        }
    }
}

#[test]
fn a_line_may_arrive_up_to_110_deg_over_a_quarter_unless_its_wrist_is_another() {
    // Axis 1 is at -9.5 deg and at -20.6 deg: 99.5 and 110.6 deg over the quarter 1.
    for (y, confdata, wanted) in [
        (-150, "[1,0,-1,0]", Code::NearConfdata),
        (-338, "[1,0,-1,0]", Code::OtherConfiguration),
        (-150, "[1,0,-1,1]", Code::OtherConfiguration),
    ] {
        let to = format!("[[900,{y},500],[0,0,1,0],{confdata},[9E9,9E9,9E9,9E9,9E9,9E9]]");
        assert_eq!(
            codes(&format!("MoveJ a,v100,fine,t; MoveL {to},v100,fine,t;")),
            [wanted],
            "{to}"
        );
    }
}

#[test]
fn findings_of_one_cause_are_one_with_the_places_of_the_others() {
    let near = "[[900,-250,500],[0,0,1,0],[0,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let each = format!("MoveJ {near},v100,fine,t;");
    let found = checked(&text(&format!("{each}\n{each}\n{each}")));
    let line = found[0].line;
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].related, [(0, line + 1, 1), (0, line + 2, 1)]);
    assert!(found[0].message.ends_with(" (and 2 more moves)"), "{}", found[0].message);
    // Passes of a loop are at one place.
    let passes = format!("FOR i FROM 1 TO 9 DO MoveL Offs({near},0,3*i,0),v100,fine,t; ENDFOR");
    let found = checked(&text(&passes));
    assert!(!found.is_empty() && found.iter().all(|it| it.related.is_empty()), "{found:?}");
}

#[test]
fn a_target_that_moves_need_differently_is_not_corrected() {
    // The first move asks for another configuration than the line that comes back arrives with.
    let moves = "MoveJ a,v100,fine,t; MoveL b,v100,fine,t;
        MoveJ [[900,-300,500],[0,0,1,0],[-1,2,-3,1],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;
        MoveL b,v100,fine,t;";
    let found = checked(&text(moves));
    assert_eq!(found.iter().map(|it| it.code).collect::<Vec<_>>(), [Code::OtherConfiguration]);
    assert_eq!(found[0].edits, []);
}

#[test]
fn settings_hold_across_calls() {
    let weld = "ENDPROC PROC weld() MoveJ a,v100,fine,t; MoveL c{2},v100,fine,t;";
    let settings = "ENDPROC PROC settings() ConfL\\Off; SingArea\\Wrist;";
    for (main, wanted) in [
        ("weld;", vec![Code::OtherConfiguration]),
        ("ConfL\\Off; weld;", vec![]),
        ("ConfL\\Off; ConfL\\On; weld;", vec![Code::OtherConfiguration]),
        ("settings; weld;", vec![]),
        ("weld; settings;", vec![Code::OtherConfiguration]),
        // Each call has its own.
        ("weld; settings; weld;", vec![Code::OtherConfiguration]),
    ] {
        assert_eq!(codes(&format!("{main} {weld} {settings}")), wanted, "{main}");
    }
    let own = weld.replace("MoveJ a", "ConfL\\On; MoveJ a");
    let found = codes(&format!("ConfL\\Off; weld; {own}"));
    assert_eq!(found, [Code::OtherConfiguration]);
}

#[test]
fn what_cannot_be_checked_is_an_error() {
    let (module, options) = (parse(&text(""), &[]).unwrap(), CheckOptions::default());
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    assert_eq!(check(&robot, &[(&module, &text(""))], &options).unwrap(), Checked::default());
    let other = check(&robot, &[(&module, "MODULE")], &options).unwrap_err();
    assert!(matches!(other, Error::Rapid(_)), "{other}");
    let motion = MotionOptions { step: 0.0, ..MotionOptions::default() };
    let no_step = CheckOptions { motion, ..options };
    let no_step = check(&robot, &[(&module, &text(""))], &no_step).unwrap_err();
    assert!(no_step.to_string().starts_with("step is 0"), "{no_step}");
    let other_arm = Arm::named("UR5e").unwrap();
    let other_arm = check(&other_arm, &[(&module, &text(""))], &options).unwrap_err();
    assert!(matches!(other_arm, Error::Robot(irbkin::Error::InvalidModel(_))), "{other_arm}");
}

#[test]
fn calls_that_double_at_each_level_are_bounded_and_each_finding_is_there_once() {
    let routine = |level: usize| {
        let next = format!("r{};\n", level + 1);
        format!("PROC r{level}()\n{next}{next}MoveJ out,v5,fine,t;\nENDPROC\n")
    };
    let routines: String = (0..25).map(routine).collect();
    let text = format!(
        "MODULE M\n{DATA}\nPROC main()\nr0;\nENDPROC\n{routines}PROC r25()\nENDPROC\nENDMODULE"
    );
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let module = parse(&text, &[]).unwrap();
    let options = CheckOptions::default();
    let Checked { findings, moves } = check(&robot, &[(&module, &text)], &options).unwrap();
    let of = |code| findings.iter().filter(|it| it.code == code).count();
    assert_eq!(of(Code::OutOfReach), 25);
    assert!((1..=50).contains(&of(Code::NotFollowed)), "{}", of(Code::NotFollowed));
    assert_eq!(moves.iter().filter(|it| it.unchecked.is_none()).count(), 25);
}

#[test]
fn wanted_codes_are_those_of_all_findings() {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let text = text(
        "MoveJ a,v1000,z100,t; MoveL c{1},v100,z100,t; MoveL out,v100,fine,t; MoveL c{2},v5,z5,t;",
    );
    let module = parse(&text, &[]).unwrap();
    let found = |codes: Option<&[Code]>| {
        let options = CheckOptions { codes, ..CheckOptions::default() };
        check(&robot, &[(&module, &text)], &options).unwrap().findings
    };
    let all = found(None);
    let mut kinds: Vec<Code> = all.iter().map(|it| it.code).collect();
    kinds.dedup();
    assert!(kinds.contains(&Code::OutOfReach) && kinds.contains(&Code::ZoneTooLarge), "{kinds:?}");
    assert!(kinds.contains(&Code::ConfdataEdge), "{kinds:?}");
    for code in Code::ALL.into_iter().filter(|code| *code != Code::Unused) {
        let own: Vec<Finding> = all.iter().filter(|it| it.code == code).cloned().collect();
        assert_eq!(found(Some(&[code])), own, "{code:?}");
    }
    assert_ne!(found(Some(&[Code::Unused])), []);
}
