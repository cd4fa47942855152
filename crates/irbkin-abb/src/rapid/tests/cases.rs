//! Data with one of several known values: each is checked, and named.

use std::format;
use std::string::String;
use std::vec::Vec;

use super::program::of;
use crate::rapid::Code;

const W: &str = "PERS wobjdata w1:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    PERS wobjdata w2:=[FALSE,TRUE,\"\",[[0,9000,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    PERS wobjdata o:=[FALSE,TRUE,\"\",[[3900,0,300],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
    CONST robtarget a2:=[[900,-9300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR robtarget x;";

/// The codes and messages of a body, and how many of its moves are checked.
fn outcome(body: &str) -> (Vec<(Code, String)>, usize, usize) {
    let found = of(&format!("{body}\nENDPROC {W} PROC nothing()"));
    let known = found.moves.iter().filter(|it| it.unchecked.is_none()).count();
    let findings = found.findings.into_iter().map(|it| (it.code, it.message));
    (findings.collect(), known, found.moves.len())
}

/// The only finding, with every move checked.
fn only(body: &str) -> (Code, String) {
    let (mut found, known, moves) = outcome(body);
    assert_eq!((found.len(), known), (1, moves), "{body}: {found:?}");
    found.remove(0)
}

#[test]
fn each_value_of_a_datum_is_checked_and_a_finding_names_it() {
    let branch = "IF g=1 THEN o:=w1; ELSE o:=w2; ENDIF ";
    let (code, message) = only(&format!("{branch} MoveJ a,v100,fine,t\\WObj:=o;"));
    assert_eq!(code, Code::OutOfReach);
    assert!(message.ends_with("(if o is w2; 1 of 2 cases)"), "{message}");
    // Of an offset in a called routine, too.
    let go =
        "go o; ENDPROC PROC go(PERS wobjdata own) MoveJ Offs(a,0,0,10),v100,fine,t\\WObj:=own;";
    assert!(only(&format!("{branch}{go}")).1.ends_with("(if o is w2; 1 of 2 cases)"));
    // What is unchanged in one part is a value as well.
    let (_, message) = only("x:=a; IF g=1 x:=out; MoveJ x,v100,fine,t;");
    assert!(message.ends_with("(if x is out; 1 of 2 cases)"), "{message}");
    let (_, message) =
        only("x:=a; TEST g CASE 1: x:=b; CASE 2: x:=out; ENDTEST MoveJ x,v100,fine,t;");
    assert!(message.ends_with("(if x is out; 1 of 3 cases)"), "{message}");
}

#[test]
fn values_of_one_branch_go_together() {
    let branch = "IF g=1 THEN o:=w1; x:=a; ELSE o:=w2; x:=a2; ENDIF ";
    let go = "MoveJ x,v100,fine,t\\WObj:=o; MoveL Offs(x,0,10,0),v100,fine,t\\WObj:=o;";
    assert_eq!(outcome(&format!("{branch}{go}")), (Vec::new(), 2, 2));
    // The same question has the same answer, until something in it is assigned.
    let again = "VAR num g; g:=gi1; IF g=1 THEN o:=w1; ELSE o:=w2; ENDIF ";
    let then = "IF g=1 THEN x:=a; ELSE x:=a2; ENDIF MoveJ x,v100,fine,t\\WObj:=o;";
    assert_eq!(outcome(&format!("{again}{then}")).0, []);
    assert_eq!(only(&format!("{again} g:=g+1; {then}")).0, Code::OutOfReach);
    let inside =
        "IF g=1 THEN MoveJ a,v100,fine,t\\WObj:=o; ELSE MoveJ a2,v100,fine,t\\WObj:=o; ENDIF";
    assert_eq!(outcome(&format!("{again}{inside}")), (Vec::new(), 2, 2));
    // A condition with the variable of a loop is asked anew in each pass.
    let set = "IF i=1 AND g=1 THEN x:=a2; o:=w2; ELSE x:=a; o:=w1; ENDIF ";
    let use_it =
        "IF i=1 AND g=1 THEN o:=w2; ELSE o:=w1; ENDIF MoveJ Offs(x,0,0,i),v100,fine,t\\WObj:=o; ";
    let inside = format!("VAR num g; g:=gi1; FOR i FROM 1 TO 2 DO {set} {use_it} ENDFOR");
    assert_eq!(outcome(&inside), (Vec::new(), 1, 1));
    let across = format!("VAR num g; g:=gi1; FOR i FROM 1 TO 2 DO {use_it} {set} ENDFOR");
    assert_eq!(outcome(&format!("x:=a; {across}")).0[0].0, Code::OutOfReach);
    // A signal may change between.
    assert_eq!(
        only(&format!("{} {then}", again.replace("VAR num g; g:=gi1;", ""))).0,
        Code::OutOfReach
    );
}

#[test]
fn an_index_that_is_not_known_is_each_one() {
    let (code, message) = only("VAR num n; n:=giPart; MoveL c{n},v100,fine,t;");
    assert_eq!(code, Code::OutOfReach);
    assert!(message.ends_with("(if n is 3; 1 of 3 cases)"), "{message}");
    // Two elements with one index go together; the line between them is checked in each case.
    assert_eq!(
        only("VAR num n; n:=giPart; MoveJ Offs(c{n},0,0,9),v100,fine,t;").0,
        Code::OutOfReach
    );
    let both = "VAR num n; n:=giPart; IF n<3 THEN x:=c{n}; ELSE x:=a; ENDIF MoveJ x,v100,fine,t;";
    assert_eq!(only(both).0, Code::OutOfReach);
    // One that is known must be one of them.
    let loop_from = |from| format!("FOR i FROM {from} TO 2 DO MoveJ c{{i}},v100,fine,t; ENDFOR");
    assert_eq!(codes(&loop_from(1)), []);
    assert_eq!(codes(&loop_from(0)), [Code::NoSuchElement]);
    assert_eq!(outcome("FOR i FROM 1 TO n DO MoveJ c{i},v100,fine,t; ENDFOR").1, 0);
}

#[test]
fn conditions_on_known_values_decide() {
    let go = "go 1; ENDPROC PROC go(num n) ";
    let test = "TEST n CASE 1,2: MoveJ a,v100,fine,t; CASE 3: MoveJ out,v100,fine,t; ENDTEST";
    assert_eq!(codes(&format!("{go}{test}")), [Code::NeverRun]);
    let test = "IF n=1 THEN x:=a; ELSEIF n>2 THEN x:=b; ELSE x:=out; ENDIF MoveJ x,v100,fine,t;";
    assert_eq!(codes(&format!("{go}{test}")), []);
    assert_eq!(codes(&format!("go 2; go 3; {}{test}", &go["go 1; ".len()..])), [Code::OutOfReach]);
    // What is only declared may be another value when the program starts.
    let body = "IF mode=1 THEN MoveJ a,v100,fine,t; ELSE MoveJ out,v100,fine,t; ENDIF ENDPROC \
        PERS num mode:=1; PROC no()";
    assert_eq!(codes(body), [Code::OutOfReach]);
    assert_eq!(codes(&body.replace("PERS", "CONST")), [Code::NeverRun]);
    // Another task may assign a PERS.
    let set = |storage| format!("mode:=1; WaitUntil go; {}", body.replace("PERS", storage));
    assert_eq!(codes(&set("VAR")), [Code::NeverRun]);
    assert_eq!(codes(&set("PERS")), [Code::OutOfReach]);
}

#[test]
fn passes_of_a_while_with_a_known_condition_are_followed() {
    let pass = "MoveJ Offs(a,100*k,0,0),v100,fine,t; k:=k+1;";
    let (code, message) = only(&format!("VAR num k; k:=1; WHILE k<=30 DO {pass} ENDWHILE"));
    assert_eq!(code, Code::OutOfReach);
    assert!(message.ends_with("(first at pass 7; 24 of 30 passes)"), "{message}");
    let (code, message) = only("FOR k FROM 1 TO 30 DO MoveJ Offs(a,100*k,0,0),v100,fine,t; ENDFOR");
    assert_eq!(code, Code::OutOfReach);
    assert!(message.ends_with("(first at k = 7; 24 of 30 passes)"), "{message}");
    let body = "WHILE TRUE DO MoveJ a,v100,fine,t; ENDWHILE MoveJ a,v100,fine,t;";
    assert_eq!(codes(body), [Code::NeverRun]);
}

#[test]
fn too_many_values_are_not_known() {
    let more = |count: usize| {
        let of = |k: usize| format!("CASE {k}: x:=Offs(a,0,0,{k});");
        let cases: String = (1..=count).map(of).collect();
        outcome(&format!("x:=a; TEST g {cases} ENDTEST MoveJ x,v100,fine,t;")).1
    };
    assert_eq!((more(63), more(64)), (1, 0));
}

fn codes(body: &str) -> Vec<Code> {
    outcome(body).0.into_iter().map(|(code, _)| code).collect()
}

#[test]
fn instructions_that_count_assign() {
    // A number of a routine without a value is 0.
    let body = "VAR num n; Incr n; Add n,8; Decr n; MoveL c{n},v100,fine,t;";
    assert_eq!(codes(body), [Code::NoSuchElement]);
    let (_, message) = only("VAR num n; Incr n; IF g=1 Add n,2; MoveL c{n},v100,fine,t;");
    assert!(message.ends_with("(if n is counted by Add n,2; 1 of 2 cases)"), "{message}");
}

#[test]
fn a_condition_on_several_values_decides_in_each_case() {
    let set = "VAR num n; IF g=1 THEN n:=1; x:=a; ELSE n:=2; x:=out; ENDIF ";
    let go = "MoveJ x,v100,fine,t;";
    assert_eq!(outcome(&format!("{set} IF n=1 THEN {go} ENDIF")), (Vec::new(), 1, 1));
    let (code, message) = only(&format!("{set} TEST n CASE 3: x:=b; CASE 2: {go} ENDTEST"));
    assert_eq!((code, message.contains("case")), (Code::OutOfReach, false), "{message}");
    // What is assigned there goes on with its case.
    let back = "IF n=2 THEN x:=a; ENDIF";
    assert_eq!(outcome(&format!("{set} {back} {go}")).0, []);
}

#[test]
fn a_short_loop_without_its_counter_in_a_move_is_followed() {
    let row = "VAR num y; FOR i FROM 1 TO 30 DO MoveJ Offs(a,y,0,0),v100,fine,t; y:=y+100; ENDFOR";
    assert!(only(row).1.ends_with("(first at i = 8; 23 of 30 passes)"));
}
