//! Types that a program defines: aliases, and records that hold targets.

use std::format;
use std::string::String;

use super::*;
use crate::rapid::Target;

const TYPES: &str = "RECORD station robtarget p; num n; string label; tooldata t; ENDRECORD
    RECORD line station first; station last; ENDRECORD ALIAS robtarget place; ALIAS place spot;";

fn target(x: u32) -> String {
    format!("[[{x},2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]")
}

fn station(x: u32) -> String {
    format!("[{},{x},\"a,b\",[TRUE,[[0,0,{x}],[1,0,0,0]],load0]]", target(x))
}

/// The x of the target and the z of the tool of the last move, or why they are not known.
fn last(text: &str, context: &[&Module]) -> (Result<f64, String>, Result<f64, String>) {
    let module = parse(text, context).unwrap_or_else(|error| panic!("{error}\n{text}"));
    again(&module, context);
    let step = module.moves().last().unwrap().clone();
    let x = step.target.value.map(|target| match target {
        Target::RobTarget(target) => target.trans_mm[0],
        Target::JointTarget(_) => panic!(),
    });
    let z = step.tool.value.clone().map(|tool| tool.tframe.trans_mm[2]);
    (x.map_err(|reason| reason.to_string()), z.map_err(|reason| reason.to_string()))
}

fn moved(data: &str, statements: &str) -> (Result<f64, String>, Result<f64, String>) {
    last(&format!("MODULE M {TYPES}\n{data}\nPROC main()\n{statements}\nENDPROC ENDMODULE"), &[])
}

#[test]
fn targets_and_tools_in_records_are_read() {
    let data = format!(
        "VAR station s:={}; CONST station a{{2}}:=[{},{}]; CONST line l:=[{},{}];
         CONST robtarget q:=a{{2}}.p;",
        station(1),
        station(2),
        station(3),
        station(4),
        station(5)
    );
    for (arguments, x, z) in [
        ("s.p,v5,fine,s.t", 1.0, 1.0),
        ("Offs(S.P,s.n,0,0),v5,fine,tool0", 2.0, 0.0),
        ("a{2}.p,v5,fine,a{1}.t", 3.0, 2.0),
        ("l.last.p,v5,fine,l.first.t", 5.0, 4.0),
        ("Offs(l.first.p,l.first.p.trans.x,0,0),v5,fine,tool0", 8.0, 0.0),
        ("q,v5,fine,tool0", 3.0, 0.0),
    ] {
        assert_eq!(moved(&data, &format!("MoveL {arguments};")), (Ok(x), Ok(z)), "{arguments}");
    }
    let refers = |why: &str| (Err(String::from(why)), Ok(0.0));
    let step = |target: &str| format!("MoveL {target},v5,fine,tool0;");
    assert_eq!(
        moved("VAR station s;", &step("s.p")),
        refers("refers to s.p, whose declaration has no value")
    );
    let unread = "refers to s, of type station, which is not read";
    assert_eq!(moved("VAR station s:=other;", &step("s.p")), refers(unread));
    assert_eq!(moved(&data, &step("s")), refers(unread));
    assert_eq!(moved(&data, &step("s.label")), refers(unread));
}

#[test]
fn assigned_components_of_records_have_no_value() {
    let data = format!("VAR station s:={}; CONST line l:=[{},{1}];", station(1), station(4));
    let step = "MoveL s.p,v5,fine,s.t;";
    let by = "which depends on s, which line 5 assigns";
    let (p, t) = (format!("refers to s.p, {by}"), format!("refers to s.t, {by}"));
    assert_eq!(moved(&data, &format!("s.p:=x; {step}")), (Err(p.clone()), Ok(1.0)));
    assert_eq!(moved(&data, &format!("s.t.tframe.trans.z:=1; {step}")), (Ok(1.0), Err(t.clone())));
    assert_eq!(moved(&data, &format!("s.n:=1; s.t.tload.mass:=1; {step}")), (Ok(1.0), Ok(1.0)));
    assert_eq!(moved(&data, &format!("s:=x; {step}")), (Err(p), Err(t)));
    assert_eq!(moved(&data, "l:=x; MoveL l.last.p,v5,fine,tool0;"), (Ok(4.0), Ok(0.0)));
}

#[test]
fn records_of_other_modules_are_read() {
    let types = read(&format!("MODULE Types {TYPES} ENDMODULE"));
    let data = format!("MODULE Data VAR station s:={}; ENDMODULE", station(7));
    let data = parse(&data, &[&types]).unwrap();
    let step = "MoveL s.p,v5,fine,s.t;";
    assert_eq!(last(step, &[&types, &data]), (Ok(7.0), Ok(7.0)));
    let writes = read("MODULE Writes PROC a() s.p:=x; ENDPROC ENDMODULE");
    let (x, _) = last(step, &[&types, &data, &writes]);
    assert!(x.unwrap_err().contains("which module Writes assigns"));
    let hidden = read("MODULE Types LOCAL RECORD station robtarget p; ENDRECORD ENDMODULE");
    let data = format!("VAR station s:=[{}]; {step}", target(1));
    assert_eq!(
        last(&data, &[&hidden]).0.unwrap_err(),
        "refers to s, of type station, which is not read"
    );
}

#[test]
fn aliases_are_the_types_that_they_name() {
    let data = format!("CONST spot p:={}; LOCAL VAR place many{{2}}:=[p,p];", target(6));
    assert_eq!(moved(&data, "MoveL p,v5,fine,tool0;"), (Ok(6.0), Ok(0.0)));
    assert_eq!(moved(&data, "MoveL many{2},v5,fine,tool0;"), (Ok(6.0), Ok(0.0)));
    let circle = read(
        "ALIAS a b; ALIAS b a; VAR a x; CONST b y:=1; RECORD r r inner; num n; \
        ENDRECORD CONST r z:=[[],2];",
    );
    assert_eq!((circle.data().len(), circle.skipped().len()), (0, 6));
}
