//! What a controller refuses when it loads a program.

use alloc::collections::BTreeSet;
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use crate::rapid::{CheckOptions, Code, Finding, Module, Severity, check, read};
use irbkin_motion::Arm;

/// The findings of modules with options, without edges of quarters.
fn checked(texts: &[&str], options: &CheckOptions<'_>) -> Vec<Finding> {
    let arm = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let modules: Vec<Module> = texts.iter().map(|text| read(text, &[])).collect();
    let pairs: Vec<_> = modules.iter().zip(texts.iter().copied()).collect();
    let mut found = check(&arm, &pairs, options).unwrap().findings;
    found.retain(|it| it.code != Code::ConfdataEdge);
    found
}

const DATA: &str = "CONST num k:=1; VAR num n; VAR string s; VAR bool b; VAR robtarget p;
    PERS tooldata t:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]]; VAR num many{3};
    RECORD part num count; string name; ENDRECORD VAR part own; VAR signaldo do1; VAR clock c1;
    FUNC num twice(num x) RETURN 2*x; ENDFUNC PROC give(INOUT num x\\string why) ENDPROC
    TRAP tStop ENDTRAP VAR intnum i1;";

fn program(body: &str) -> String {
    format!("MODULE M {DATA}\nPROC main()\n{body}\nENDPROC ENDMODULE")
}

/// The codes and the messages of statements in `main`.
fn found(body: &str) -> Vec<(Code, String)> {
    let all = checked(&[&program(body)], &CheckOptions::default());
    all.into_iter().map(|it| (it.code, it.message)).collect()
}

#[test]
fn what_a_controller_loads_has_no_finding() {
    for body in [
        "n:=k+twice(n); s:=\"a\"+s; b:=n>k; b:=NOT b; b:=n=1 AND b; own.count:=n; own.name:=s;",
        "FOR i FROM 1 TO 3 DO many{i}:=i; FOR j FROM i TO 1 STEP -1 DO n:=j; ENDFOR ENDFOR",
        "p.trans.x:=n; p:=Offs(p,n,0,k); p.trans:=[n,n,n]; n:=p.trans.z; t.tload.mass:=3;",
        "give n; give n\\why:=s; WaitTime n; WaitTime\\InPos,0.5; TPWrite s\\Num:=n; ClkStart c1;",
        "CONNECT i1 WITH tStop; ISignalDI do1,1,i1; IDelete i1; GOTO next; next: n:=1;",
        "TEST n CASE 1,k: n:=2; DEFAULT: n:=3; ENDTEST WHILE b DO n:=n+1; ENDWHILE",
        "IF n=pi b:=TRUE; IF OpMode()=OP_AUTO RETURN; ERROR IF ERRNO=ERR_WAIT_MAXTIME RETRY;",
        "ActUnit STN1; reg1:=clock1; AccSet 50,50; VelSet 100,vmax.v_tcp; s:=NumToStr(n,0);",
        "n:=do1; b:=do1; Set do1; AliasIO s,do1; n:=DOutput(do1); SetDO do1,high;",
    ] {
        assert_eq!(found(body), [], "{body}");
    }
}

#[test]
fn what_a_controller_refuses_is_found() {
    for (body, code, words) in [
        ("cnt:=1;", Code::UnknownName, "cnt:=1: nothing declares cnt"),
        ("n:=twice(cnt); n:=cnt;", Code::UnknownName, "nothing declares cnt (2 times)"),
        ("IF cnt>3 n:=1;", Code::UnknownName, "nothing declares cnt"),
        ("many{cnt}:=1;", Code::UnknownName, "nothing declares cnt"),
        ("FOR i FROM 1 TO 2 DO ENDFOR n:=i+1;", Code::UnknownName, "nothing declares i"),
        ("WaitTime cnt*2;", Code::UnknownName, "nothing declares cnt"),
        ("give n\\why:=cnt;", Code::UnknownName, "nothing declares cnt"),
        ("n:=\"text\";", Code::WrongType, "n is a num, \"text\" a string"),
        ("n:=s;", Code::WrongType, "n is a num, s a string"),
        ("b:=1;", Code::WrongType, "b is a bool, 1 a num"),
        ("p.trans.x:=s;", Code::WrongType, "p.trans.x is a num, s a string"),
        ("p:=p.trans;", Code::WrongType, "p is a robtarget, p.trans a pos"),
        ("n:=p;", Code::WrongType, "n is a num, p a robtarget"),
        ("WaitTime \"2\";", Code::WrongType, "Time is a num, \"2\" a string"),
        ("TPWrite n;", Code::WrongType, "String is a string, n a num"),
        ("n:=twice(s);", Code::WrongType, "x is a num, s a string"),
        ("give s;", Code::WrongType, "x is a num, s a string"),
        ("give n\\why:=n;", Code::WrongType, "why is a string, n a num"),
        ("SetDO do1,TRUE;", Code::WrongType, "Value is a num, TRUE a bool"),
        ("Set n;", Code::WrongType, "Signal is a signal, n a num"),
        ("k:=2;", Code::ReadOnly, "k is a constant"),
        ("Incr k;", Code::ReadOnly, "k is a constant"),
        ("FOR i FROM 1 TO 3 DO IF b THEN i:=2; ENDIF ENDFOR", Code::ReadOnly, "i is the counter"),
        ("ENDPROC FUNC num f() n:=1; ENDFUNC PROC g()", Code::NoReturn, "FUNC f: no RETURN"),
    ] {
        let [(own, message)] = &found(body)[..] else { panic!("{body}: {:?}", found(body)) };
        assert!(*own == code && message.contains(words), "{body}: {own:?} {message}");
    }
    // A function may end by an error, or return in a statement that is not read.
    assert_eq!(found("ENDPROC FUNC num f() RAISE ERR_ARGVALERR; ENDFUNC PROC g()"), []);
    let broken = found("ENDPROC FUNC num f() RETURN 1 2; ENDFUNC PROC g()");
    assert!(broken.iter().all(|it| it.0 == Code::NotFollowed), "{broken:?}");
}

#[test]
fn names_that_may_be_signals_are_one_note_unless_the_signals_are_known() {
    let body = "Set doA; IF diB=1 n:=1; WaitUntil C>2; IF C<5 OR NOT D n:=I_giE*2;";
    let text = program(body);
    let [(code, message)] = &found(body)[..] else { panic!("{:?}", found(body)) };
    let note = "doA, diB, C, D, I_giE not declared, taken for signals";
    assert_eq!((*code, &**message), (Code::UnknownSignal, note));
    let signals: BTreeSet<String> = ["doa", "dib", "c", "d"].map(ToString::to_string).into();
    let known = CheckOptions { signals: Some(&signals), ..CheckOptions::default() };
    let [finding] = &checked(&[&text], &known)[..] else { panic!() };
    assert_eq!((finding.code, finding.unknown.as_deref()), (Code::UnknownName, Some("I_giE")));
}

#[test]
fn data_of_a_part_of_a_program_may_be_in_another() {
    let part = "MODULE P PROC go() x:=1; y:=x; ENDPROC ENDMODULE";
    let codes = |texts: &[&str], is_whole| {
        let found = checked(texts, &CheckOptions { is_whole, ..CheckOptions::default() });
        found.into_iter().map(|it| (it.code, it.severity())).collect::<Vec<_>>()
    };
    assert_eq!(codes(&[part], None), [(Code::MissingRoutines, Severity::Note)]);
    assert_eq!(codes(&[part], Some(true)), [(Code::UnknownName, Severity::Error); 2]);
    let system = part.replace("MODULE P", "MODULE P(SYSMODULE)");
    assert_eq!(codes(&[&system], Some(true)), []);
}

#[test]
fn what_two_other_modules_declare_is_judged_by_neither() {
    let main =
        "MODULE Main PROC main() r 3; n:=\"a\"; n:=f(); m:=f(); ENDPROC VAR num m; ENDMODULE";
    let one = "MODULE One CONST num n:=1; PROC r() ENDPROC FUNC pos f() RETURN [1,2,3]; ENDFUNC";
    let two = "VAR pos n; PROC r(num x) ENDPROC FUNC num f() RETURN 1; ENDFUNC ENDMODULE";
    let (one, two) = (&*format!("{one} ENDMODULE"), &*format!("MODULE Two {two}"));
    let codes = |texts: &[&str]| {
        let found = checked(texts, &CheckOptions::default());
        found.into_iter().map(|it| it.code).collect::<Vec<_>>()
    };
    assert_eq!(codes(&[main, one, two]), [Code::NameTwice]);
    assert_eq!(codes(&[main, two, one]), [Code::NameTwice]);
    assert!(codes(&[main, one]).contains(&Code::WrongArguments));
    // What a module declares itself counts there.
    let own = &*two.replace("ENDMODULE", "PROC go() r; n:=1; ENDPROC ENDMODULE");
    let wanted = [Code::NameTwice, Code::WrongArguments, Code::WrongType];
    assert_eq!(codes(&[one, own]), wanted);
}

#[test]
fn a_global_name_in_two_modules_is_one_finding_for_two_modules() {
    let one = "MODULE One VAR num a; LOCAL VAR num b; PROC main() a:=1; ENDPROC ENDMODULE";
    let two = "MODULE Two VAR num A; VAR num b; PROC Main() a:=1; ENDPROC ENDMODULE";
    let wanted = [(None, Severity::Warning), (Some(true), Severity::Error)];
    for (is_whole, severity) in wanted {
        let options = CheckOptions { is_whole, ..CheckOptions::default() };
        let all = checked(&[one, two], &options);
        let [found] = &all[..] else { panic!("{all:?}") };
        assert_eq!((found.code, found.severity()), (Code::NameTwice, severity));
        assert_eq!((found.module, found.related.len()), (1, 1));
        assert!(found.message.starts_with("A: One declares it, too, on line 1"), "{found}");
        assert!(found.message.ends_with(" (and 1 more name)"), "{found}");
    }
    assert_eq!(
        checked(&[one, "MODULE Two LOCAL VAR num a; ENDMODULE"], &CheckOptions::default()),
        []
    );
}

#[test]
fn world_zones_that_stop_the_robot_are_obstacles() {
    let target =
        |x: f64| format!("[[{x},-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]]");
    let run = |define: &str, rest: &str, moves: &str| {
        let text = format!(
            "MODULE M {DATA} CONST robtarget a:={}; CONST robtarget e:={};
            VAR wzstationary z; VAR shapedata v; CONST jointtarget jl:=[[9E9,-20,9E9,9E9,9E9,9E9],\
            [9E9,9E9,9E9,9E9,9E9,9E9]]; CONST jointtarget jh:=[[9E9,10,9E9,9E9,9E9,9E9],\
            [9E9,9E9,9E9,9E9,9E9,9E9]];
            PROC zones() CONST pos low:=[950,-350,400]; {define} WZLimSup\\Stat,z,v; {rest} ENDPROC
            PROC main()\nMoveJ a,v100,fine,t;\n{moves}\nENDPROC ENDMODULE",
            target(900.0),
            target(1000.0),
        );
        let all = checked(&[&text], &CheckOptions::default());
        all.into_iter().map(|it| (it.code, it.line, it.message)).collect::<Vec<_>>()
    };
    let entered = |define: &str| run(define, "", "MoveL e,v100,fine,t;\nMoveL a,v100,fine,t;");
    for (define, is_in) in [
        ("WZBoxDef\\Inside,v,low,[1100,-250,600];", true),
        ("WZBoxDef\\Inside,v,[1100,-250,600],low;", true),
        ("WZBoxDef\\Inside,v,low,[1100,-250,450];", false),
        ("WZSphDef\\Inside,v,[1000,-300,500],20;", true),
        ("WZSphDef\\Inside,v,[1000,-300,530],20;", false),
        ("WZCylDef\\Inside,v,[1000,-300,0],20,600;", true),
        ("WZCylDef\\Inside,v,[1000,-300,700],20,-250;", true),
        ("WZCylDef\\Inside,v,[1000,-300,700],20,-150;", false),
        ("WZSphDef\\Outside,v,[900,-300,500],50;", true),
        ("WZSphDef\\Outside,v,[950,-300,500],60;", false),
        ("WZLimJointDef\\Outside,v,jl,jh;", true),
        ("WZLimJointDef\\Inside,v,jl,jl;", false),
    ] {
        let found = entered(define);
        let codes: Vec<_> = found.iter().map(|it| it.0).collect();
        assert!(codes.iter().all(|it| *it == Code::WorldZone), "{define}: {found:?}");
        assert_eq!(codes.len(), usize::from(is_in), "{define}: {found:?}");
    }
    let [(_, line, message)] = &entered("WZSphDef\\Inside,v,[1000,-300,500],20;")[..] else {
        panic!()
    };
    let words = "MoveL e: the TCP is inside the world zone v of line ";
    assert!(message.starts_with(words) && message.ends_with(" (and 1 more move)"), "{message}");
    assert!(*line > 1);
    // Switched off by a statement, not constant, or without an extent.
    let near = "WZSphDef\\Inside,v,[1000,-300,500],20;";
    assert_eq!(run(near, "WZDisable z;", "MoveL e,v100,fine,t;"), []);
    assert_eq!(run(&near.replace("20", "n"), "n:=5;", "MoveL e,v100,fine,t;"), []);
    let [(code, _, message)] = &run("WZBoxDef\\Inside,v,low,[1100,-250,405];", "", "")[..] else {
        panic!()
    };
    assert!(*code == Code::WorldZone && message.contains("less than 10 mm apart"), "{message}");
}
