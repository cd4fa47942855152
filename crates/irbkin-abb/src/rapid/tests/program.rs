//! Programs followed: calls with arguments, assignments, loops, displacements, units.

use std::collections::BTreeMap;
use std::format;
use std::string::{String, ToString};
use std::vec;
use std::vec::Vec;

use crate::rapid::data::module::Parameter;
use crate::rapid::{
    CheckOptions, Checked, Code, DataType, Finding, Module, RapidPose, Severity, ToolData, Unit,
    UnitAxis, Units, check, parse, read,
};
use irbkin::Pose;
use irbkin_motion::Arm;

pub(super) const FAR: &str = "[9E9,9E9,9E9,9E9,9E9,9E9]";

pub(super) fn data() -> String {
    format!(
        "PERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
        PERS tooldata u:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
        CONST robtarget a:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}];
        CONST robtarget b:=[[900,300,500],[0,0,1,0],[0,0,0,0],{FAR}];
        CONST robtarget out:=[[2900,300,500],[0,0,1,0],[0,0,0,0],{FAR}];
        CONST robtarget c{{3}}:=[[[900,-300,500],[0,0,1,0],[-1,0,-1,0],{FAR}],
            [[900,300,500],[0,0,1,0],[0,0,0,0],{FAR}],[[2900,300,500],[0,0,1,0],[0,0,0,0],{FAR}]];
        CONST robtarget e:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[0,9E9,9E9,9E9,9E9,9E9]];
        CONST robtarget f:=[[2900,-300,500],[0,0,1,0],[-1,0,-1,0],[2000,9E9,9E9,9E9,9E9,9E9]];
        PERS wobjdata w:=[FALSE,FALSE,\"STN\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
        PERS tooldata v:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];\n"
    )
}

/// The findings in modules that know each other, but for edges of quarters and for signals.
fn checked(texts: &[&str], options: &CheckOptions<'_>) -> Checked {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let alone: Vec<Module> = texts.iter().map(|text| read(text, &[])).collect();
    let all: Vec<&Module> = alone.iter().collect();
    let modules: Vec<Module> = texts.iter().map(|text| read(text, &all)).collect();
    let pairs: Vec<_> = modules.iter().zip(texts.iter().copied()).collect();
    let mut found = check(&robot, &pairs, options).unwrap();
    found.findings.retain(|it| ![Code::ConfdataEdge, Code::UnknownSignal].contains(&it.code));
    found
}

fn text(body: &str) -> String {
    format!("MODULE M\n{}PROC main()\n{body}\nENDPROC\nENDMODULE", data())
}

pub(super) fn of(body: &str) -> Checked {
    checked(&[&text(body)], &CheckOptions::default())
}

pub(super) fn codes(found: &[Finding]) -> Vec<Code> {
    found.iter().map(|it| it.code).collect()
}

/// The codes of a body, and how many of its places are checked.
pub(super) fn outcome(body: &str) -> (Vec<Code>, usize, usize) {
    let found = of(body);
    let known = found.moves.iter().filter(|it| it.unchecked.is_none()).count();
    (codes(&found.findings), known, found.moves.len())
}

#[test]
fn a_call_is_followed_with_its_arguments_and_is_where_its_target_is_wrong() {
    let own = "ENDPROC PROC go(robtarget p,speeddata s,zonedata z,PERS tooldata own \
        \\PERS wobjdata wobj) MoveL p,s,z,own\\WObj?wobj;";
    let found = of(&format!("go a,v100,fine,t\\WObj:=wobj0;\ngo out,v100,fine,t;\n{own}"));
    assert_eq!(codes(&found.findings), [Code::OutOfReach]);
    let finding = &found.findings[0];
    let line = data().lines().count() + 4;
    assert_eq!((finding.line, finding.column), (line, 1));
    assert!(finding.message.starts_with("go out: "), "{}", finding.message);
    assert_eq!(found.moves.len(), 2);
    // Without a call its target, its speed and its zone are parameters.
    assert_eq!(outcome(own), (Vec::from([Code::UnknownValue; 3]), 0, 1));
    // Calls that are not finished, circular, or of a calculated name are named.
    assert_eq!(outcome("again; ENDPROC PROC again() MoveJ a,v100,fine,t; again;").1, 1);
    assert_eq!(codes(&of("%name%;").findings), [Code::NotFollowed]);
    let named = "%\"r\"%; ENDPROC PROC r() MoveJ out,v100,fine,t;";
    assert_eq!(codes(&of(named).findings), [Code::OutOfReach]);
}

#[test]
fn confdata_that_a_call_passes_on_is_corrected_where_it_is_written() {
    let text = text(&format!(
        "go [[900,-250,500],[0,0,1,0],[1,0,1,0],{FAR}]; ENDPROC PROC go(robtarget p) \
         MoveJ p,v100,fine,t;"
    ));
    let found = checked(&[&text], &CheckOptions::default());
    assert_eq!(codes(&found.findings), [Code::WrongConfdata]);
    let edits = &found.findings[0].edits;
    assert_eq!(edits.iter().map(|it| &text[it.span.clone()]).collect::<Vec<_>>(), ["1", "1"]);
    // The datum of another module, too.
    let main = "MODULE N\nPROC main()\ngo2 near;\nENDPROC\nENDMODULE";
    let other = format!(
        "MODULE M\n{}CONST robtarget near:=[[900,-250,500],[0,0,1,0],[1,0,1,0],{FAR}];\n\
         PROC go2(robtarget p)\nMoveJ p,v100,fine,t;\nENDPROC\nENDMODULE",
        data()
    );
    let found = checked(&[main, &other], &CheckOptions::default());
    assert_eq!(codes(&found.findings), [Code::WrongConfdata]);
    assert_eq!((found.findings[0].module, found.findings[0].edits[0].module), (0, 1));
}

#[test]
fn assigned_values_are_known_behind_their_assignments() {
    for (body, wanted) in [
        ("VAR robtarget x; x:=a; x.trans.z:=400; MoveJ x,v100,fine,t;", 1),
        ("VAR robtarget x; x:=out; x:=Offs(a,0,0,10); MoveJ x,v100,fine,t;", 1),
        ("VAR robtarget x; x:=a; IF go THEN x:=b; ENDIF MoveJ x,v100,fine,t;", 1),
        ("VAR robtarget x; x:=a; IF go THEN x:=b; ELSE x:=b; ENDIF MoveJ x,v100,fine,t;", 1),
        ("VAR robtarget x; IF go THEN x:=a; RETURN; ENDIF x:=b; MoveJ x,v100,fine,t;", 1),
        ("VAR robtarget x; x:=a; WHILE go DO MoveJ x,v100,fine,t; x:=b; ENDWHILE", 0),
        (
            "VAR robtarget x; set x; MoveJ x,v100,fine,t; \
          ENDPROC PROC set(INOUT robtarget y) y:=a;",
            1,
        ),
        (
            "VAR robtarget x; VAR num n; x:=a; Incr n; read x; MoveJ x,v100,fine,t; \
          ENDPROC PROC read(INOUT robtarget y) y:=CRobT();",
            0,
        ),
        ("VAR num n; n:=5; TPReadNum n,\"n\"; MoveJ Offs(a,n,0,0),v100,fine,t;", 0),
        // A component of a tool that nothing else assigns, and its load.
        ("v.tframe:=PoseMult(u.tframe,u.tframe); MoveJ Offs(a,0,0,-180),v100,fine,v;", 1),
        ("v.tload.mass:=5; MoveJ a,v100,fine,v;", 1),
        ("MoveJ a,v100,fine,v; v:=u;", 0),
    ] {
        let (codes, known, moves) = outcome(body);
        assert_eq!((known, moves), (wanted, 1), "{body}: {codes:?}");
        assert!(codes.iter().all(|code| *code == Code::UnknownValue), "{body}: {codes:?}");
    }
}

/// The codes of two modules, in each order as in one text: `go` is a routine of the first.
fn split(step: &str, main: &str) -> Vec<Code> {
    let part = format!(
        "{}VAR robtarget p:=a; VAR robtarget q:=p; PERS num dx:=0;
        PERS wobjdata o:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
        VAR robtarget s{{2}}:=[a,a]; PROC go() {step},v100,fine,t; ENDPROC\n",
        data()
    );
    let main = format!("PROC main() {main} ENDPROC\n");
    let module = |name: &str, body: &str| format!("MODULE {name}\n{body}ENDMODULE");
    let outcome = |texts: &[&str]| {
        let found = checked(texts, &CheckOptions::default());
        let mut codes = codes(&found.findings);
        codes.sort_unstable();
        let known = found.moves.iter().filter(|it| it.unchecked.is_none()).count();
        (codes, known, found.moves.len())
    };
    let whole = outcome(&[&module("One", &format!("{part}{main}"))]);
    let [part, main] = [module("Part", &part), module("Main", &main)];
    assert_eq!(outcome(&[&part, &main]), whole, "{part}\n{main}");
    assert_eq!(outcome(&[&main, &part]), whole, "{main}\n{part}");
    whole.0
}

#[test]
fn data_that_another_module_assigns_are_as_in_one_text() {
    let (reach, unknown) = (Code::OutOfReach, Code::UnknownValue);
    for (step, main, wanted) in [
        ("MoveJ p", "p:=out; go;", vec![reach]),
        ("MoveJ p", "p:=out; p:=a; go;", vec![]),
        ("MoveJ p", "go; p:=out;", vec![unknown]),
        ("MoveJ p", "p:=a; IF dx=2 p:=out; go;", vec![reach]),
        ("MoveJ p", "p.trans.x:=3000; go;", vec![reach]),
        ("MoveJ p", "set p; go; ENDPROC PROC set(INOUT robtarget x) x:=out;", vec![reach]),
        ("MoveJ p", "set; go; ENDPROC PROC set() p:=out;", vec![reach]),
        ("MoveJ p", "p:=a; go; ENDPROC TRAP stir p:=out; ENDTRAP PROC no()", vec![unknown]),
        ("MoveJ p", "p:=a; go; ENDPROC PROC no() ERROR p:=out; RETRY;", vec![unknown]),
        ("MoveJ p", "p:=a; %name%; go;", vec![unknown, Code::NotFollowed]),
        ("MoveJ q", "p:=out; go;", vec![unknown]),
        ("MoveJ Offs(a,p.trans.x-900,0,0)", "p.trans.y:=9000; go;", vec![]),
        ("MoveJ Offs(a,p.trans.x-900,0,0)", "p.trans.x:=9000; go;", vec![reach]),
        ("MoveJ Offs(a,dx,0,0)", "dx:=2000; go;", vec![reach]),
        ("MoveJ Offs(a,dx,0,0)", "Incr dx; go;", vec![unknown]),
        ("MoveJ s{1}", "s{1}:=out; go;", vec![unknown]),
        ("MoveJ s{1}", "s{dx}:=out; go;", vec![unknown]),
        ("MoveJ RelTool(a,0,0,0)\\WObj:=o", "o.uframe.trans.x:=3000; go;", vec![reach]),
        ("MoveJ a,v100,fine,v;  MoveJ a", "v.tframe.trans.z:=3000; go;", vec![reach]),
        ("MoveJ a,v100,fine,v;  MoveJ a", "v:=u; v.tload.mass:=1; go;", vec![]),
    ] {
        let step = step.replace(")\\WObj:=o", "),v100,fine,t\\WObj:=o; MoveJ a");
        assert_eq!(split(&step, main), wanted, "{step}: {main}");
    }
}

#[test]
fn the_place_of_an_assignment_in_another_module_is_named() {
    let part = "MODULE Part VAR robtarget p:=a; PROC go() MoveJ p,v100,fine,tool0; ENDPROC \
        ENDMODULE";
    let data = format!("MODULE Data\n{}ENDMODULE", data());
    let main = "MODULE Main\nPROC main()\ngo;\np:=out;\nENDPROC\nENDMODULE";
    let found = checked(&[part, main, &data], &CheckOptions::default());
    assert_eq!(codes(&found.findings), [Code::UnknownValue]);
    let message = &found.findings[0].message;
    assert!(message.contains("refers to p, which line 4 of module Main assigns"), "{message}");
}

#[test]
fn the_first_of_several_assignments_is_named() {
    let main = "PROC main()\ngo;\np:=out;\nENDPROC\n";
    let set = "PROC set()\np:=out;\nENDPROC\n";
    let go = "PROC go()\nMoveJ p,v100,fine,t;\nENDPROC\n";
    let declared = format!("{}VAR robtarget p:=a;\n", data());
    // The order of the text decides, not the names of routines.
    for (routines, line) in [(format!("{set}{main}"), 3), (format!("{main}{set}"), 4)] {
        let main = format!("MODULE Main\n{routines}ENDMODULE");
        let part = format!("MODULE Part\n{go}ENDMODULE");
        let data = format!("MODULE Data\n{declared}ENDMODULE");
        let one = format!("MODULE One\n{routines}{go}{declared}ENDMODULE");
        let of_main = format!("p, which line {line} of module Main assigns");
        let of_one = format!("p, which line {line} assigns");
        for (texts, named) in [(&[&*part, &main, &data][..], of_main), (&[&one], of_one)] {
            let found = checked(texts, &CheckOptions::default());
            assert_eq!(codes(&found.findings), [Code::UnknownValue]);
            assert!(found.findings[0].message.contains(&named), "{}", found.findings[0].message);
        }
    }
}

#[test]
fn confdata_of_an_assigned_target_is_not_corrected_in_its_declaration() {
    let turned = format!("[[900,-250,500],[0,0,1,0],[1,0,1,0],{FAR}]");
    let found = of(&format!(
        "p:={turned}; MoveJ p,v100,fine,t; ENDPROC PROC no() ENDPROC VAR robtarget p:=a; PROC x()"
    ));
    assert_eq!(codes(&found.findings), [Code::WrongConfdata]);
    assert_eq!(found.findings[0].edits, []);
}

#[test]
fn components_of_records_are_passed_on() {
    let record = "RECORD station robtarget p; num n; ENDRECORD\n\
        CONST station s:=[[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]],3];";
    let text = text("go s.p; ENDPROC PROC go(robtarget x) MoveJ x,v100,fine,t;");
    let found = checked(
        &[&text.replacen("MODULE M\n", &format!("MODULE M\n{record}\n"), 1)],
        &CheckOptions::default(),
    );
    assert_eq!((codes(&found.findings), found.moves[0].unchecked), (Vec::new(), None));
}

#[test]
fn what_is_found_with_the_saved_value_of_a_pers_is_a_note() {
    let options = CheckOptions { takes_last: true, ..CheckOptions::default() };
    for (body, wanted, is_assumed) in [
        ("MoveJ a,v100,fine,v; v:=u;", vec![], true),
        ("MoveJ s,v100,fine,t; s:=a;", vec![(Code::OutOfReach, "s")], true),
        ("s:=a; MoveJ s,v100,fine,t;", vec![], false),
        // Below calls, also where a call passes on what it was given.
        (
            "s:=a; far s; read s; far s; ENDPROC PROC far(robtarget p) MoveJ p,v100,fine,t; ENDPROC \
          PROC read(INOUT robtarget p) p:=CRobT(\\TaskName:=\"T2\");",
            vec![(Code::OutOfReach, "s")],
            true,
        ),
        (
            "up s; s:=a; ENDPROC PROC up(robtarget p) far p; ENDPROC PROC far(robtarget q) \
          MoveL Offs(q,0,0,9),v100,fine,t;",
            vec![(Code::OutOfReach, "s")],
            true,
        ),
        // What is calculated of it before the move, too.
        (
            "VAR robtarget x; x:=Offs(s,0,0,9); MoveJ x,v100,fine,t; s:=a;",
            vec![(Code::OutOfReach, "s")],
            true,
        ),
        (
            "go s; s:=a; ENDPROC PROC go(robtarget p) p:=CRobT(); MoveJ p,v100,fine,t;",
            vec![],
            false,
        ),
        // The load of a tool, its use with joint angles, and speeds matter nothing.
        ("MoveJ out,v100,fine,v; v.tload.mass:=5;", vec![(Code::OutOfReach, "")], false),
        (
            "MoveAbsJ [[999,0,0,0,30,0],%],v100,fine,v; v:=u;",
            vec![(Code::OutsideLimits, "")],
            false,
        ),
        ("MoveJ out,vs,fine,t; vs:=v50;", vec![(Code::OutOfReach, "")], false),
        // A tool that nothing declares is an error with them, too.
        ("MoveJ s,v100,fine,no; s:=a;", vec![(Code::UnknownTool, "")], false),
    ] {
        let data = format!(
            "PERS robtarget s:=[[2900,300,500],[0,0,1,0],[0,0,0,0],{FAR}];
            PERS speeddata vs:=[50,500,5000,1000];\n"
        );
        let body =
            text(&body.replace('%', FAR)).replacen("MODULE M\n", &format!("MODULE M\n{data}"), 1);
        let found = checked(&[&body], &options);
        let own: Vec<_> =
            found.findings.iter().filter(|it| it.code != Code::UnknownValue).collect();
        assert_eq!(own.len(), wanted.len(), "{body}: {own:?}");
        for (finding, (code, name)) in own.iter().zip(wanted) {
            let words = format!("(with the saved value of {name})");
            let severity = if name.is_empty() { Severity::Error } else { Severity::Note };
            assert_eq!((finding.code, finding.severity()), (code, severity), "{body}");
            assert_eq!(finding.message.ends_with(&words), !name.is_empty(), "{}", finding.message);
        }
        assert_eq!(found.moves.iter().any(|it| it.assumed), is_assumed, "{body}");
    }
}

#[test]
fn an_error_without_a_saved_value_stays() {
    let options = CheckOptions { takes_last: true, ..CheckOptions::default() };
    let far = format!("[[2900,300,500],[0,0,1,0],[0,0,0,0],{FAR}]");
    let side = format!("[[900,300,500],[0,0,1,0],[0,0,0,0],{FAR}]");
    let behind = format!("[[-900,-200,500],[0,0,1,0],[-2,0,-2,0],{FAR}]");
    for (declared, body, wanted) in [
        // At one place a call has the value and another one does not.
        (&far, "go; s:=out; go; ENDPROC PROC go() MoveJ s,v100,fine,t;", Severity::Error),
        // The way from the value is as uncertain as it is, also behind a branch.
        (&side, "MoveJ s,v100,fine,t; MoveL %,v100,fine,t; s:=a;", Severity::Note),
        (&side, "MoveJ s,v100,fine,t; IF go THEN MoveL %,v100,fine,t; ENDIF s:=a;", Severity::Note),
        (&side, "s:=b; MoveJ s,v100,fine,t; MoveL %,v100,fine,t;", Severity::Error),
    ] {
        let data = format!("MODULE M\nPERS robtarget s:={declared};\n");
        let text = text(&body.replace('%', &behind)).replacen("MODULE M\n", &data, 1);
        let found = checked(&[&text], &options);
        let severities: Vec<_> = found.findings.iter().map(Finding::severity).collect();
        assert_eq!(severities, [wanted], "{body}: {:?}", found.findings);
        assert_eq!(found.moves[0].assumed, !body.starts_with("s:="), "{body}");
    }
}

#[test]
fn a_given_tool_stands_for_one_that_nothing_declares() {
    let long = ToolData {
        tframe: RapidPose { trans_mm: [0.0, 0.0, 9e3], ..RapidPose::IDENTITY },
        ..ToolData::TOOL0
    };
    let tools = BTreeMap::from([(None, ToolData::TOOL0), (Some("tlong".to_string()), long)]);
    let options = CheckOptions { tools: Some(&tools), ..CheckOptions::default() };
    for (body, wanted, is_assumed) in [
        ("MoveJ a,v100,fine,no;", vec![], true),
        ("MoveJ a,v100,fine,tLong;", vec![Severity::Note], true),
        (
            "go tLong; ENDPROC PROC go(PERS tooldata own) MoveJ a,v100,fine,own;",
            vec![Severity::Note],
            true,
        ),
        ("MoveJ out,v100,fine,t;", vec![Severity::Error], false),
        // A tool that is assigned is declared, and joint angles hold without one.
        (
            "v:=u; read v; MoveJ a,v100,fine,v; ENDPROC PROC read(INOUT tooldata x) x:=CTool();",
            vec![],
            false,
        ),
        ("MoveAbsJ [[0,0,0,0,30,0],%],v100,fine,tLong;", vec![], false),
    ] {
        let found = checked(&[&text(&body.replace('%', FAR))], &options);
        let own = found.findings.iter().filter(|it| it.code != Code::UnknownValue);
        let severities: Vec<_> = own.clone().map(Finding::severity).collect();
        assert_eq!(severities, wanted, "{body}: {:?}", found.findings);
        let is_said = |it: &Finding| it.message.ends_with("(with the tool of --tool)");
        assert!(own.clone().all(|it| is_said(it) == is_assumed), "{body}");
        assert_eq!(found.moves[0].assumed, is_assumed, "{body}");
    }
    assert_eq!(codes(&of("MoveJ a,v100,fine,tLong;").findings), [Code::UnknownTool]);
}

#[test]
fn loops_with_known_bounds_are_followed_in_each_pass() {
    let found = of("FOR i FROM 1 TO 3 DO MoveJ c{i},v100,fine,t; ENDFOR");
    assert_eq!((codes(&found.findings), found.moves.len()), (Vec::from([Code::OutOfReach]), 1));
    assert_eq!(outcome("FOR i FROM 2 TO 1 STEP -1 DO MoveJ c{i},v100,fine,t; ENDFOR").0, []);
    assert_eq!(outcome("FOR i FROM 1 TO n DO MoveJ c{i},v100,fine,t; ENDFOR").1, 0);
    // Too many passes are one whose variable is not known.
    assert_eq!(outcome("FOR i FROM 1 TO 1000000 DO MoveJ Offs(a,i,0,0),v100,fine,t; ENDFOR").1, 0);
}

#[test]
fn displacements_reach_into_called_routines_and_end() {
    let go = "ENDPROC PROC go() MoveJ a,v100,fine,t;";
    let up = "PDispSet [[0,0,2500],[1,0,0,0]];";
    assert_eq!(outcome(&format!("{up} go; {go}")).0, [Code::OutOfReach]);
    let message = of(&format!("{up} go; {go}")).findings.remove(0).message;
    let line = data().lines().count() + 3;
    assert!(message.ends_with(&format!("(displaced on line {line})")), "{message}");
    assert_eq!(outcome(&format!("{up} PDispOff; go; {go}")).0, []);
    assert_eq!(outcome(&format!("PDispOn \\ExeP:=b, a, t; go; {go}")).0, [Code::NearConfdata]);
    assert_eq!(outcome(&format!("PDispOn \\Rot \\ExeP:=x, a, t; go; {go}")).1, 0);
    assert_eq!(outcome(&format!("PDispSet x; go; {go}")).1, 0);
    assert_eq!(outcome(&format!("PDispAdd [[0,0,2500],[1,0,0,0]]; go; {go}")).1, 0);
    assert_eq!(outcome(&format!("{up} IF q PDispOff; go; {go}")).1, 0);
    // Joint angles are not displaced.
    let joints = format!("{up} MoveAbsJ [[0,0,0,0,30,0],{FAR}],v100,fine,t;");
    assert_eq!(outcome(&joints), (Vec::new(), 1, 1));
}

fn track() -> Units {
    let frame = Pose::identity();
    let axes = Vec::from([UnitAxis { external: 0, frame, is_rotation: false }]);
    let name = "TRACK".to_string();
    Units(Vec::from([Unit { name, axes, is_carrier: true, is_determined: true }]))
}

#[test]
fn external_axes_are_not_checked_unless_their_units_are_known() {
    assert_eq!(outcome("MoveJ f,v100,fine,t;"), (Vec::from([Code::UnknownUnit]), 0, 1));
    // At zero nothing is displaced, unless an offset is added.
    assert_eq!(outcome("MoveJ e,v100,fine,t;"), (Vec::new(), 1, 1));
    assert_eq!(outcome("EOffsSet [1500,0,0,0,0,0]; MoveJ e,v100,fine,t;").1, 0);
    assert_eq!(outcome("EOffsOn \\ExeP:=f, e; MoveJ e,v100,fine,t;").1, 0);
    assert_eq!(outcome("EOffsOn \\ExeP:=a, e; MoveJ e,v100,fine,t;").1, 0);
    assert_eq!(outcome("EOffsOn \\ExeP:=f, e; EOffsOff; MoveJ e,v100,fine,t;").1, 1);
    // On a track each target has its own base.
    let (units, both) = (track(), text("MoveJ e,v100,fine,t; MoveL f,v100,fine,t;"));
    let options = CheckOptions { units: Some(&units), ..CheckOptions::default() };
    let found = checked(&[&both], &options);
    assert_eq!(codes(&found.findings), []);
    let [first, second] = [0, 1].map(|it: usize| found.moves[it].q.unwrap());
    assert!(first.iter().zip(second).all(|(a, b)| (a - b).abs() < 1e-9));
    // A unit is named once, and what a positioner turns is known with it.
    let moved = "MoveJ a,v100,fine,t\\WObj:=w; MoveJ b,v100,fine,t\\WObj:=w;";
    assert_eq!(outcome(moved), (Vec::from([Code::UnknownUnit]), 0, 2));
    let mut units = track();
    units.0[0] = Unit { name: "stn".into(), is_carrier: false, ..units.0[0].clone() };
    let options = CheckOptions { units: Some(&units), ..CheckOptions::default() };
    let found = checked(&[&text("MoveJ e,v100,fine,t\\WObj:=w;")], &options);
    assert_eq!((codes(&found.findings), found.moves[0].unchecked), (Vec::new(), None));
}

#[test]
fn a_branch_that_asks_for_an_argument_is_followed_if_the_call_has_it() {
    let routine = "ENDPROC PROC Go(robtarget p\\num up\\switch fast)
        IF Present(up) THEN MoveL Offs(p,0,0,up),v5,fine,t; ELSE MoveL p,v5,fine,t; ENDIF
        IF NOT Present(fast) MoveL Offs(p,0,0,10),v5,fine,t;
        ";
    let far = "ENDPROC PROC Far(robtarget p\\num up) Go p\\up?up\\fast;";
    for (calls, found, known) in [
        ("Go a;", vec![Code::NeverRun], 2),
        ("Go a\\up:=20;", vec![Code::NeverRun], 2),
        ("Go a\\up:=5000;", vec![Code::OutOfReach, Code::NeverRun], 2),
        ("Go a\\up:=20\\fast;", vec![Code::NeverRun; 2], 1),
        ("Far a;", vec![Code::NeverRun; 2], 1),
        ("Far a\\up:=20;", vec![Code::NeverRun; 2], 1),
        ("Go a; Go a\\up:=20;", vec![], 4),
    ] {
        // A routine that nothing calls is followed with arguments that are not known.
        let far = if calls.starts_with("Far") { far } else { "" };
        let (mut codes, checked, _) = outcome(&format!("{calls} {routine} {far}"));
        codes.retain(|code| [Code::NeverRun, Code::OutOfReach].contains(code));
        assert_eq!((codes, checked), (found, known), "{calls}");
    }
}

#[test]
fn what_is_never_executed_is_named_and_not_checked() {
    let found = of("IF FALSE THEN MoveJ out,v100,fine,t; ENDIF MoveJ a,v100,fine,t; RETURN; \
        MoveJ out,v100,fine,t;");
    assert_eq!(codes(&found.findings)[..2], [Code::NeverRun, Code::OutOfReach]);
    assert_eq!(found.moves.len(), 2);
}

#[test]
fn a_zone_before_a_wait_and_targets_next_to_each_other_are_found() {
    assert_eq!(
        outcome("MoveJ a,v100,z20,t; WaitDI d,1; MoveJ b,v100,fine,t;").0,
        [Code::CornerPath]
    );
    assert_eq!(outcome("MoveJ a,v100,fine,t; WaitDI d,1; MoveJ b,v100,fine,t;").0, []);
    let close = "MoveJ a,v100,z5,t; MoveL Offs(a,0,0,0.02),v100,fine,t;";
    assert!(outcome(close).0.contains(&Code::CornerPath));
    // The wait of a branch does not hide where the robot is.
    let wait = "MoveJ a,v100,fine,t; IF q THEN WaitTime 1; ENDIF MoveL b,v7000,fine,t;";
    assert_eq!(outcome(wait).0, [Code::JointTooFast]);
}

#[test]
fn an_external_axis_in_one_of_two_targets_and_bad_circles_are_found() {
    assert_eq!(outcome("MoveJ a,v100,fine,t; MoveL e,v100,fine,t;").0, [Code::ExternalAxes]);
    let circle =
        |via: &str, to: &str| format!("MoveJ a,v100,fine,t; MoveC {via},{to},v100,fine,t;");
    let long = circle("Offs(a,100,100,0)", "Offs(a,100,-100,0)");
    assert!(outcome(&long).0.contains(&Code::UncertainCircle));
    let near = circle("Offs(a,0,0.05,0)", "Offs(a,100,0,0)");
    assert!(outcome(&near).0.contains(&Code::UncertainCircle));
}

#[test]
fn parameters_have_types_modes_and_alternatives() {
    let of = |header: &str, end: &str| {
        let module = parse(&format!("MODULE M\n{header}\n{end}\nENDMODULE"), &[]).unwrap();
        module.routines()[0].parameters.clone()
    };
    let found = of(
        "PROC GoL(robtarget p,INOUT speeddata v{*} \\ zonedata Z | switch Fine, PERS tooldata t \
         \\PERS wobjdata WObj)",
        "ENDPROC",
    );
    let names: Vec<&str> = found.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["p", "v", "z", "fine", "t", "wobj"]);
    let are = |of: fn(&Parameter) -> bool| found.iter().map(of).collect::<Vec<bool>>();
    assert_eq!(are(|it| it.is_optional), [false, false, true, true, false, true]);
    assert_eq!(are(|it| it.is_reference), [false, true, false, false, true, true]);
    assert_eq!(are(|it| it.is_alternative), [false, false, false, true, false, false]);
    assert_eq!(found[3].data_type, None);
    assert_eq!(found[4].data_type, Some(DataType::ToolData));
    assert!(of("PROC main()", "ENDPROC").is_empty() && of("TRAP t", "ENDTRAP").is_empty());
}
