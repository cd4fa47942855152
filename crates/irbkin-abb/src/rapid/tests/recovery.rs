//! Texts that are read in spite of their faults.

use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use super::*;
use crate::rapid::read as read_on;

const TARGET: &str = "[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

/// The module of statements of a routine, from line 3 on.
fn routine(statements: &str) -> Module {
    let text = format!(
        "MODULE M CONST robtarget p:={TARGET};\nPROC main()\n{statements}\nENDPROC\nPROC last()\n\
         MoveJ p,v1,fine,tool0;\nENDPROC\nENDMODULE"
    );
    let module = read_on(&text, &[]);
    assert_eq!(parse(&text, &[]).is_ok(), module.faults().is_empty(), "{text}");
    let last = module.moves().last().unwrap_or_else(|| panic!("{module:?}"));
    assert_eq!(last.routine.as_deref(), Some("last"), "{text}");
    module
}

fn faults(module: &Module) -> Vec<String> {
    module.faults().iter().map(ToString::to_string).collect()
}

/// The speeds of the moves.
fn speeds(module: &Module) -> Vec<&str> {
    module.moves().iter().map(|step| &*step.speed.text).collect()
}

#[test]
fn a_text_without_faults_is_read_as_ever() {
    let module = routine("MoveL p,v5,z1,tool0; IF a THEN foo; ENDIF");
    assert_eq!((faults(&module), speeds(&module)), (Vec::new(), ["v5", "v1"].into()));
    let text = "MODULE M PROC a() MoveL *,v5,z1,tool0; ENDPROC ENDMODULE";
    assert_eq!(read_on(text, &[]), parse(text, &[]).unwrap());
}

#[test]
fn an_invalid_statement_is_skipped_and_the_rest_is_read() {
    let module = routine(
        "MoveL p,v5,z1,tool0;
         MoveL p,v10 z1,tool0; MoveL p,v20,z1,tool0;
         x := \"open;
         MoveL p,v30,z1,tool0
         MoveL p,
             v40,z1,tool0;
         MoveL [[1,2,3],
             [1,0,0,0,
             [0,0,0,0]],v50,z1,tool0;
         foo 12ab; MoveL p,v60,z1,tool0;",
    );
    assert_eq!(
        faults(&module),
        [
            "line 4, column 22: expected an operator, a comma or the end of the expression, found z1",
            "line 5, column 15: the string has no closing quote on its line",
            "line 6, column 30: expected a comma or a semicolon, found the end of the line",
            "line 11, column 37: expected a comma or ], found ;",
            "line 12, column 14: 12ab is not a number",
        ]
    );
    assert_eq!(speeds(&module), ["v5", "v20", "v30", "v40", "v60", "v1"]);
    let invalid: Vec<_> = not_read(&module);
    assert_eq!(
        invalid[0],
        "MoveL is invalid: expected an operator, a comma or the end of the expression, found z1"
    );
    assert_eq!(module.skipped()[0].text, "MoveL p,v10 z1,tool0;");
}

#[test]
fn data_and_moves_with_invalid_values_are_skipped() {
    let module = routine(
        "CONST num a := [1]; CONST num a2:=a; CONST num a2:=7;
         CONST num b := 1e999; CONST pos c := [1,2]; CONST num d := e; CONST num e := d;
         PERS wobjdata w := [FALSE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
         MoveL p,p,z1,tool0; MoveL p,v5,z1,tool0; MoveL p,v6,tool0;",
    );
    assert_eq!(
        faults(&module),
        [
            "line 3, column 16: num a is an aggregate, it must be a number",
            "line 3, column 38: a2 is declared twice in main",
            "line 4, column 25: 1e999 is not finite, every number must be",
            "line 4, column 47: pos c has 2 components, it must have 3",
            "line 4, column 54: values refer to one another in a circle: d, e, d",
            "line 5, column 29: wobjdata w has 4 components, it must have 5: ufprog is missing",
            "line 6, column 18: MoveL speed is p, of type robtarget, it must be speeddata",
            "line 6, column 51: MoveL has 3 arguments, it must have 4",
        ]
    );
    assert_eq!(speeds(&module), ["v5", "v1"]);
    let reasons = not_read(&module);
    assert_eq!(reasons[0], "a: num a is an aggregate, it must be a number");
    assert_eq!(reasons[1], "a2: refers to a, whose value is not known");
}

#[test]
fn missing_ends_are_supplied() {
    let flow = |statements: &str| {
        let module = routine(statements);
        let words = module.skipped().iter().map(|it| it.text.as_str()).collect::<Vec<_>>();
        let written = module.to_string();
        parse(&written, &[]).unwrap_or_else(|error| panic!("{error}\n{written}"));
        (faults(&module), words.join(" "))
    };
    let none = Vec::<String>::new();
    assert_eq!(flow("IF a THEN ENDIF"), (none, "IF a THEN ENDIF".into()));
    let missing = |line: usize, end: &str, found: &str| {
        Vec::from([format!("line {line}, column 1: expected {end}, found {found}")])
    };
    assert_eq!(
        flow("IF a THEN MoveL p,v5,z1,tool0;"),
        (missing(4, "ENDIF", "ENDPROC"), "IF a THEN ENDIF".into())
    );
    assert_eq!(
        flow("IF a THEN FOR i FROM 1 TO 2 DO\nENDIF"),
        (missing(4, "ENDFOR", "ENDIF"), "IF a THEN FOR i FROM 1 TO 2 DO ENDFOR ENDIF".into())
    );
    let stray = "a declaration or an instruction (no such block is open)";
    assert_eq!(flow("ENDWHILE"), (missing(3, stray, "ENDWHILE"), String::new()));
    let module = routine("MoveL p,v5,z1,tool0;\nPROC other()\nMoveL p,v6,z1,tool0;");
    assert_eq!(faults(&module), missing(4, "ENDPROC", "PROC"));
    let routines: Vec<_> = module.moves().iter().map(|it| it.routine.as_deref().unwrap()).collect();
    assert_eq!(routines, ["main", "other", "last"]);
    let open = routine("IF (a=1 THEN\nMoveL p,v5,z1,tool0;\nENDIF");
    assert_eq!(faults(&open), ["line 3, column 4: ( is not closed"]);
    assert_eq!(not_read(&open), ["IF is not executed", "ENDIF is not executed"]);
    let ended = read_on("MODULE M PROC a()\nMoveL *,v1,z1,tool0;\nIF b THEN", &[]);
    let end = "line 3, column 10: the text ends inside IF: ENDIF is missing";
    assert_eq!((faults(&ended), ended.moves().len()), (Vec::from([end.to_string()]), 1));
}

#[test]
fn a_git_conflict_is_reported_line_by_line() {
    let conflict = "MoveL p,v4,z1,tool0;\n<<<<<<< HEAD\nMoveL p,v5,z1,tool0;\n=======\n\
        MoveL p,v6,z1,tool0;\n>>>>>>> a1b2c3 (it's \"mine\")\nMoveL p,v7,z1,tool0;";
    let module = routine(conflict);
    let words = "a git conflict is not resolved: the text has both sides";
    let wanted: Vec<_> = [4, 6, 8].map(|line| format!("line {line}, column 1: {words}")).into();
    assert_eq!((faults(&module), speeds(&module)), (wanted, ["v4", "v5", "v6", "v7", "v1"].into()));
}

#[test]
fn text_around_a_module_is_read_too() {
    let module = read_on(
        "VAR num a:=1;\nMODULE M\nENDMODULE\nPROC b()\nENDPROC\nMODULE N\nVAR num c;\nENDMODULE",
        &[],
    );
    assert_eq!(
        faults(&module),
        [
            "line 2, column 1: expected a declaration or an instruction (MODULE begins a text), \
             found MODULE",
            "line 4, column 1: expected the end of the text, found PROC",
            "line 6, column 1: expected a declaration or an instruction (MODULE begins a text), \
             found MODULE",
        ]
    );
    assert_eq!((module.name(), module.data().len(), module.routines().len()), (Some("M"), 2, 1));
}

#[test]
fn an_encoded_module_is_named_as_such() {
    let words = "line 1, column 1: an encoded module, which is not text, is not read";
    for bytes in [b"\xfc\x80\xe0\x26\x00\x01a\n".as_slice(), b"\xfc\xa8\xc74\x08\x01H\x03\x1bJ"] {
        let text = crate::rapid::decode(bytes);
        assert_eq!(fault(&text), words);
        let module = read_on(&text, &[]);
        assert_eq!((faults(&module), module.skipped().len()), (Vec::from([words.to_string()]), 0));
    }
    for text in [
        "! \u{93}quoted\u{94}\nVAR num a;",
        "VAR num a;!\u{84}",
        "\u{feff}  VAR num a;\u{1a}",
        "\r\n\t",
        "\0\0",
    ] {
        assert!(read_on(text, &[]).faults().is_empty(), "{text:?}");
    }
}

#[test]
fn no_more_than_a_hundred_faults_are_kept() {
    let module = read_on(&"foo 12ab;\n".repeat(200), &[]);
    assert_eq!((module.faults().len(), module.skipped().len()), (100, 200));
}
