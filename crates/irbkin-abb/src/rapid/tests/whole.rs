//! Every statement is read: what no controller loads is named at its place.

use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use super::*;
use crate::rapid::{CheckOptions, Code, Finding, Severity, check, read as read_on};
use irbkin_motion::Arm;

/// The lines, the columns and the words of the faults of a routine's statements, whose first line
/// is 1.
fn faults(statements: &str) -> Vec<(usize, usize, String)> {
    let text = format!("MODULE M PROC main()\n{statements}\nENDPROC ENDMODULE");
    let module = read_on(&text, &[]);
    assert_eq!(parse(&text, &[]).is_ok(), module.faults().is_empty(), "{text}");
    let fault = |it: &crate::rapid::RapidFault| (it.line - 1, it.column, it.kind.to_string());
    module.faults().iter().map(fault).collect()
}

#[test]
fn a_statement_that_no_controller_loads_is_named_where_it_stops_to_make_sense() {
    for (statement, column) in [
        ("foo bar baz;", 9),
        ("x:=y z;", 6),
        ("x:=;", 4),
        ("x:=1+;", 6),
        ("x:=NOT;", 7),
        ("x:=AND y;", 4),
        ("x:=1 y:=2;", 6),
        ("x=1;", 2),
        ("Set do1,,do2;", 9),
        ("Set ,do2;", 5),
        ("Set do1,;", 9),
        ("TPWrite \"a\" \"b\";", 13),
        ("WaitUntil x=1 y=2;", 15),
        ("RETURN 5 6;", 10),
        ("GOTO;", 5),
        ("CONNECT i1 WITH;", 16),
        ("CONNECT i1;", 11),
        ("then;", 1),
        ("FOR i FROM 1 DO ENDFOR", 14),
        ("FOR i TO 2 DO ENDFOR", 7),
        ("WHILE x< DO ENDWHILE", 10),
        ("IF a b c THEN", 10),
        ("TEST x CASE 1,: ENDTEST", 15),
        ("x{1,}:=2;", 5),
        ("x{1}.:=2;", 6),
        ("x.a 2;", 5),
        ("x:=f(1,2;", 5),
        ("x:=f(1 2);", 8),
        ("foo \\;", 6),
        ("foo \\a:=,1;", 9),
        ("%\"foo\" 1;", 8),
        ("VAR dionum d 1;", 14),
    ] {
        let found = faults(statement);
        assert_eq!(
            found.first().map(|it| (it.0, it.1)),
            Some((1, column)),
            "{statement} {found:?}"
        );
    }
}

/// A statement with the sound ones behind it: of an unfinished one the fault is at the end of its
/// line, and the others keep their meaning.
#[test]
fn a_line_that_begins_a_statement_ends_the_one_before_it() {
    let lines = [
        "rGrip",
        "SetDO do1,1",
        "Mov",
        "WaitTime(1)",
        "x:=(5*a)/2",
        "RETURN",
        "MoveL *,v5,z1,tool0",
        "MoveL *,v5,z1,",
        "x:=",
        "x:=Offs(p,1,",
        "VAR dionum d",
        "VAR num n:=1",
        "IF a>1 foo",
        "foo\\b",
        "foo\\",
        "MoveL *,v5,z1,tool0\\",
    ];
    let next = [
        "ArcL *,v7,sm1,wd1,fine,tool0;",
        "TriggL *,v7,tr1,fine,tool0;",
        "rOpen 1;",
        "y:=3;",
        "IF a THEN ENDIF",
        "TPWrite \"a\";",
        "a{1}:=2;",
        "rOpen;",
        "WaitRob\\InPos;",
        "VAR num z;",
    ];
    for first in lines {
        for second in next {
            // A value, or the name of an option, may be in the next line.
            let may_go_on = ["a{1}:=2;", "rOpen;", "y:=3;", "WaitRob\\InPos;"].contains(&second);
            if first.ends_with(['=', ',', '\\']) && may_go_on {
                continue;
            }
            let text = format!("    {first}\n    ! a note\n\n    {second}");
            let found = faults(&text);
            let whole = read_on(&format!("PROC a() {second} ENDPROC"), &[]);
            let at = (1, first.len() + 5);
            let is_bracket = first.contains('(') && first.ends_with(',');
            let place = found.iter().map(|it| (it.0, it.1)).next();
            assert_eq!(found.len(), 1, "{text} {found:?}");
            assert!(
                place == Some(at) || is_bracket && place.is_some_and(|it| it.0 == 1),
                "{text} {found:?}"
            );
            let module = read_on(&format!("PROC a()\n{text}\nENDPROC"), &[]);
            let last = |it: &Module| it.skipped().last().map(|it| it.text.clone());
            let moves = |it: &Module| {
                it.moves().iter().map(|it| it.instruction.clone()).collect::<Vec<_>>()
            };
            let (all, own) = (moves(&module), moves(&whole));
            let is_move = first.starts_with("MoveL") && all.len() > own.len();
            assert_eq!(all[usize::from(is_move)..], own[..], "{text}");
            assert!(whole.skipped().is_empty() || last(&module) == last(&whole), "{text}");
        }
    }
}

#[test]
fn text_that_controllers_load_has_no_fault() {
    for statements in [
        "WaitTime(1); rUnload(i); rBoren_Dubbel-1202.5,27.5,0,shift; %\"rGo\"% 1; %sName+\"x\"% a\\b;",
        "r_Meas 1,\\Start; r_Meas 1,\\name:=\"a\"+NumToStr(i,0),\\Stop; rPulse\\keepon,\\nInterval:=2;",
        "Load\\Dynamic,f; StartLoad\\Dynamic,f,ld; WaitLoad\\UnloadPath:=f,ld; PulseDO\\High\\PLength:=0.5,do1;",
        "CheckAx tempJnt\\Armonly?ArmOnly; WaitUntil a=1 AND NOT b OR (c<>d)=(e>=f) XOR g<=h;",
        "IF di_1 = 1 SetDO do_1,1; IF (a>0 AND a<=9)=FALSE RETURN stEmpty; IF Present(t) n:=n+1;",
        "IF a OR\n  b foo; WHILE TRUE do ENDWHILE FOR i FROM -1 TO 5*n STEP -2 DO ENDFOR",
        "TEST a+b CASE 1,2,C_X: foo; CASE -3: DEFAULT: ENDTEST CONNECT i1 WITH tr1; GOTO l1; l1:",
        "r:=UIMessageBox(\\Header:=\"a\"\n  \\MsgArray:=[\"\",\"\"]\\BtnArray:=[\"b\"]);",
        "MoveAbsj [[0,0,0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]\\NoEOffs,v10,z50,t; stop; Movej *, v5,\n z1\n ,t;",
        "x{1,i+1}.a.b:=-(-3)+f{2}.c*g(1).d DIV 2 MOD 3; RAISE; RAISE 1; RETURN; EXIT; <SMT> foo <ARG>;",
        "VAR intnum i:=0; VAR tasks t{2}:=[[\"T_ROB1\"],[\"T_ROB2\"]]; VAR btnres b; CONST string s:=\"a\"+\"b\";",
        "foo\n    a,\n    b\n  ; x:=\n y; TPWrite\n  \"a\";",
    ] {
        assert_eq!(faults(statements), [], "{statements}");
    }
}

/// A program without a fault, with what RAPID has of everything.
const PROGRAM: &str = "MODULE Station
    PERS tooldata tGun:=[TRUE,[[0,0,180],[1,0,0,0]],[2,[0,0,50],[1,0,0,0],0,0,0]];
    CONST robtarget pNear:=[[900,-300,500],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    VAR num nCount:=0;
    PROC main()
        rStart;
        MoveJ pNear,v500,fine,tGun;
        FOR i FROM 1 TO 3 DO
            rPick Offs(pNear,0,10*i,0),2*i\\Slow;
            nCount:=nCount+Abs(i);
        ENDFOR
        IF nCount>3 AND diReady=1 THEN
            TPWrite \"count \"\\Num:=nCount;
            SetDO doLamp,1;
        ENDIF
        TEST nCount
        CASE 1,2:
            WaitTime 0.5;
        DEFAULT:
            Incr nCount;
        ENDTEST
        WHILE fSum(nCount,1)<5 DO
            PulseDO\\PLength:=0.2,doLamp;
            WaitDI diReady,1\\MaxTime:=5;
        ENDWHILE
        AccSet 50,100;
        VelSet 100,1000;
        rStop;
    ENDPROC
    PROC rStart()
        ConfL\\Off;
        Reset doLamp;
    ENDPROC
    PROC rPick(robtarget pAt,num nDepth\\switch Slow)
        MoveL Offs(pAt,0,0,nDepth),v200,fine,tGun;
        WaitUntil diReady=1;
    ENDPROC
    PROC rStop()
        Set doLamp;
        StopMove;
    ENDPROC
    FUNC num fSum(num a,num b)
        RETURN a+b;
    ENDFUNC
ENDMODULE
";

/// The lines of what is wrong with a text, and its findings on calls.
fn wrong(text: &str) -> (Vec<usize>, Vec<Finding>) {
    let robot = Arm::<6>::named("IRB 2600-12/1.65").unwrap();
    let module = read_on(text, &[]);
    let found = check(&robot, &[(&module, text)], &CheckOptions::default()).unwrap().findings;
    let errors = found.iter().filter(|it| it.code.severity() == Severity::Error);
    let lines = module.faults().iter().map(|it| it.line).chain(errors.map(|it| it.line));
    let lines = lines.collect();
    let own = [Code::UnknownRoutine, Code::WrongArguments, Code::MissingRoutines];
    (lines, found.into_iter().filter(|it| own.contains(&it.code)).collect())
}

/// The bytes of `text` at which a mutation takes something away, with how many.
fn mutations(text: &str) -> Vec<(&'static str, usize, usize)> {
    let (bytes, mut all) = (text.as_bytes(), Vec::new());
    for (at, byte) in bytes.iter().enumerate() {
        let end_of = |from: usize| {
            let mut depth = 0;
            bytes[from..].iter().position(|byte| {
                depth += i32::from(b"[(".contains(byte)) - i32::from(b"])".contains(byte));
                depth < 0 || depth == 0 && b",;\\:".contains(byte)
            })
        };
        match byte {
            b';' => all.push(("semicolon", at, 1)),
            b'[' | b']' | b'(' | b')' => all.push(("bracket", at, 1)),
            b',' => all.extend(end_of(at + 1).map(|length| ("argument", at, length + 1))),
            _ => {}
        }
    }
    // The first word of each line that is none of RAPID's own, and the names of functions.
    for line in text.lines() {
        let word = line.trim_start();
        let begin = word.as_ptr() as usize - text.as_ptr() as usize;
        let length = word.find(|it: char| !it.is_alphanumeric()).unwrap_or(word.len());
        let is_own =
            word[..length] == word[..length].to_uppercase() || word[length..].starts_with(":=");
        if !is_own {
            all.extend((0..length).map(|letter| ("letter", begin + letter, 1)));
        }
    }
    all
}

#[test]
fn what_is_taken_away_is_named_on_its_line_or_the_next() {
    assert_eq!(wrong(PROGRAM), (Vec::new(), Vec::new()));
    let (mut named, mut missed) = (0, Vec::new());
    for (kind, at, length) in mutations(PROGRAM) {
        let mut text = PROGRAM.to_string();
        text.replace_range(at..at + length, "");
        let line = 1 + PROGRAM[..at].matches('\n').count();
        if wrong(&text).0.iter().any(|it| (line..=line + 1).contains(it)) {
            named += 1;
        } else {
            missed.push((kind, line, text.lines().nth(line - 1).unwrap_or_default().to_string()));
        }
    }
    assert!(named > 200, "{named}");
    assert!(missed.len() * 50 <= named, "{named} {missed:?}");
}

fn findings(statements: &str) -> Vec<(Code, usize, String)> {
    let text = format!(
        "MODULE M\nPROC main()\n{statements}\nENDPROC\nPROC rOpen(num a\\switch b|num c)\nENDPROC\nVAR num x; VAR string f; ENDMODULE"
    );
    let found = wrong(&text).1.into_iter();
    found.map(|it| (it.code, it.line, it.message)).collect()
}

#[test]
fn a_call_that_nothing_declares_is_an_error_and_a_note_if_modules_are_missing() {
    let only = |statements: &str| {
        let found = findings(statements);
        assert_eq!(found.len(), 1, "{found:?}");
        found.into_iter().next().unwrap()
    };
    let unknown = (Code::UnknownRoutine, 3, "rOpne 1: nothing declares it".to_string());
    assert_eq!(only("rOpne 1;"), unknown);
    let twice = (Code::UnknownRoutine, 3, "MovL 1,2: nothing declares it (2 calls)".to_string());
    assert_eq!(only("MovL 1,2;\nMovL 3;"), twice);
    assert_eq!(only("x:=1+fOne(2);").2, "fOne: nothing declares it");
    let note = (
        Code::MissingRoutines,
        3,
        "no module that is here declares rOpne, fOne: modules are missing".to_string(),
    );
    assert_eq!(only("rOpne 1; x:=fOne(2); Load f;"), note);
    assert_eq!(only("rOpne 1; x:=fOne(2);\nCallByVar \"a\",1;").0, Code::MissingRoutines);
    assert_eq!(
        findings("rOpen 1; ROPEN 2\\b; %\"rOpen\"% 3\\c:=4; ArcRefresh 1; ArcLNew 1; g_init;"),
        []
    );
}

#[test]
fn a_routine_that_may_be_elsewhere_is_a_note() {
    let late = "no module that is here declares it: it is looked for when the call is made";
    assert_eq!(
        findings("%\"rOther\"% 1;\n% \"Part:rOther\" %;\nrOthar;"),
        [
            (Code::MissingRoutines, 3, format!("%\"rOther\"% 1: {late} (2 calls)")),
            (Code::UnknownRoutine, 5, "rOthar: nothing declares it".to_string()),
        ]
    );
    assert_eq!(findings("%\"Part:rOpen\"% 1;"), []);
    for (attributes, wanted) in [
        ("", Code::UnknownRoutine),
        ("(NOSTEPIN)", Code::UnknownRoutine),
        ("(SYSMODULE)", Code::MissingRoutines),
        ("(NoView,NOSTEPIN)", Code::MissingRoutines),
        ("(VIEWONLY)", Code::MissingRoutines),
    ] {
        let text = format!("MODULE M{attributes}\nPROC main()\nrOther;\nENDPROC\nENDMODULE");
        let found: Vec<Code> = wrong(&text).1.iter().map(|it| it.code).collect();
        assert_eq!(found, [wanted], "{attributes}");
    }
}

#[test]
fn other_arguments_than_a_routine_has_are_an_error() {
    for (statement, words) in [
        ("SetDO do1;", "1 required argument, it must have 2: SetDO "),
        ("WaitTime;", "0 required arguments, it must have 1: WaitTime "),
        ("ConfL On;", "1 required argument, it must have 0: ConfL "),
        ("ConfL\\Onn;", "it has no argument \\Onn: ConfL "),
        ("WaitDI di1\\MaxTime:=1;", "1 required argument, it must have 2: WaitDI "),
        ("MoveL *,v5,z1,tool0\\WObjj:=wobj0;", "it has no argument \\WObjj: MoveL "),
        ("x:=Offs(p,1,2);", "3 required arguments, it must have 4: Offs "),
        ("rOpen;", "0 required arguments, it must have 1: rOpen num a"),
        ("rOpen 1\\d;", "it has no argument \\d: rOpen "),
        ("rOpen 1\\b\\c:=1;", "\\c is given twice, or with an alternative of it"),
        ("rOpen 1\\c;", "\\c has no value, it must be \\c:=.."),
        ("%\"rOpen\"%;", "0 required arguments, it must have 1: rOpen num a"),
    ] {
        let found = findings(statement);
        let mut wrong = found.iter().filter(|it| it.0 == Code::WrongArguments);
        let (first, more) = (wrong.next(), wrong.next());
        assert!(first.is_some_and(|it| it.1 == 3 && it.2.contains(words)), "{statement} {found:?}");
        assert_eq!(more, None, "{statement}");
    }
}

#[test]
fn calls_that_controllers_load_have_no_finding() {
    let routines =
        "PROC rMsg(string s\\string arr{*}\\num two{*,*}) ENDPROC PROC rLog(string s) ENDPROC";
    let data = "VAR num x; VAR iodev io1; VAR bool bReady; VAR string t; VAR socketdev s1;
        VAR string addr; VAR num port; VAR egmident egm1; VAR num y; VAR num z{2,2};";
    for statements in [
        "rMsg \"a\"\\arr:=x; rMsg \"a\"\\arr?y\\two:=z;",
        "rLog\"done;\"; rLog\"\";",
        "WaitUntil\n    bReady\\MaxTime:=5; x:=ReadBin(\nio1\\Time:=1);",
        "MoveL\n    *\\ID:=10,v100,fine,tool0;",
        "SocketReceiveFrom s1\\Str:=t,addr,port; EGMWaitCond egm1;",
        "%\"rLog\"% \"a\";%\"rLog\"% \"b\";",
    ] {
        let text =
            format!("MODULE M {data}\nPROC main()\n{statements}\nENDPROC {routines}\nENDMODULE");
        assert_eq!(wrong(&text), (Vec::new(), Vec::new()), "{text}");
    }
    // 65 optional arguments and more are told apart as far as a bit for each goes.
    let many = (0..70).map(|it| format!("\\switch s{it}")).collect::<Vec<_>>().concat();
    let text = format!(
        "MODULE M\nPROC main()\nrAny\\s0\\s64;\nENDPROC PROC rAny({many}) ENDPROC\nENDMODULE"
    );
    assert_eq!(wrong(&text).1, []);
}

#[test]
fn a_calculated_name_that_begins_with_a_text_may_lead_anywhere() {
    let found = findings("rOther 1; %\"Path_\"+NumToStr(n,0)%;");
    assert!(found.iter().any(|it| it.0 == Code::MissingRoutines), "{found:?}");
    assert!(findings("rOther 1; %\"rOpen\"% 1;").iter().any(|it| it.0 == Code::UnknownRoutine));
}

#[test]
fn a_call_by_a_constant_name_is_the_instruction() {
    let module = read("PROC a() %\"MoveL\"% *,v5,z1,tool0; %\"Offs\"%; ENDPROC");
    assert_eq!(module.moves().len(), 1);
    assert_eq!(not_read(&module), ["% is not an instruction that is read"]);
}
