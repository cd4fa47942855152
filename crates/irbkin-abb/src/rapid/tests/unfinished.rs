//! Placeholders of unfinished programs.

use std::format;
use std::string::String;
use std::vec::Vec;

use super::*;

/// The reports for the statements of a routine.
fn skipped(statements: &str) -> Vec<String> {
    let module = read(&format!("MODULE M\nPROC main()\n{statements}\nENDPROC\nENDMODULE"));
    again(&module, &[]);
    not_read(&module)
}

#[test]
fn unfinished_statements_are_skipped() {
    assert_eq!(skipped("<SMT>"), ["<SMT> is not finished"]);
    assert_eq!(
        skipped("<SMT>; <SMT>\nfoo;"),
        [
            "<SMT> is not finished",
            "<SMT> is not finished",
            "foo is not an instruction that is read"
        ]
    );
    assert_eq!(skipped("<VAR>:=<EXP>;"), ["<VAR> is not finished"]);
    assert_eq!(skipped("a:=<EXP>;"), ["a is not finished"]);
    assert_eq!(skipped("foo <ARG>;"), ["foo is not finished"]);
    assert_eq!(skipped("IF TRUE <SMT>"), ["IF is not executed", "<SMT> is not finished"]);
    assert_eq!(skipped("IF <EXP> <SMT>"), ["IF is not finished", "<SMT> is not finished"]);
    let block = ["IF is not finished", "<SMT> is not finished", "ENDIF is not executed"];
    assert_eq!(skipped("IF <EXP> THEN <SMT> ENDIF"), block);
    let words = ["FOR is not finished", "<SMT> is not finished", "ENDFOR is not executed"];
    assert_eq!(skipped("FOR <ID> FROM <EXP> TO <EXP> DO <SMT> ENDFOR"), words);
    assert_eq!(
        skipped("WHILE <EXP> DO ENDWHILE"),
        ["WHILE is not finished", "ENDWHILE is not executed"]
    );
    let words = [
        "TEST is not finished",
        "CASE is not finished",
        "<CSE> is not finished",
        "ENDTEST is not executed",
    ];
    assert_eq!(skipped("TEST <EXP> CASE <EXP>: <CSE> ENDTEST"), words);
    assert_eq!(
        skipped("MoveL <ARG>; MoveJ p,v1,<EXP>,tool0;"),
        ["MoveL is not finished", "MoveJ is not finished"]
    );
}

#[test]
fn unfinished_declarations_are_skipped() {
    let module = read(
        "MODULE <ID>(<ATR>) <DDN> VAR num <ID>; VAR num <ID>; VAR <TYP> x; CONST num y:=<EXP>; \
         VAR num a{<DIM>}; CONST pos b:=[<EXP>];
         ALIAS <TYP> <ID>; RECORD <ID> <CDN> ENDRECORD CONST num z:=y;
         LOCAL PROC <ID>(<PAR>) VAR num q; MoveL q; ENDPROC FUNC <TYP> <ID>() ENDFUNC FUNC <TYP> \
             f(num <ID>) ENDFUNC PROC main(<PAR>) ENDPROC
         ENDMODULE",
    );
    assert_eq!(module.name(), Some("<ID>"));
    let words = ["<DDN>", "VAR", "VAR", "VAR", "CONST", "VAR", "CONST", "ALIAS", "RECORD"]
        .map(|what| format!("{what} is not finished"));
    let rest = [
        "z: refers to y, whose declaration is not finished",
        "LOCAL is not finished",
        "FUNC is not finished",
    ]
    .map(String::from);
    assert_eq!(not_read(&module), words.into_iter().chain(rest).collect::<Vec<_>>());
    let headers: Vec<_> = module.routines().iter().map(|routine| routine.header.as_str()).collect();
    assert_eq!(headers, ["FUNC <TYP> f(num <ID>)", "PROC main(<PAR>)"]);
    again(&module, &[]);
    assert_eq!(
        fault("PROC <ID>() <SMT>"),
        "line 1, column 18: the text ends inside PROC <ID>: ENDPROC is missing"
    );
}

#[test]
fn comparisons_are_not_placeholders() {
    assert_eq!(
        skipped("IF a<B AND C>d foo;"),
        ["IF is not executed", "foo is not an instruction that is read"]
    );
    assert_eq!(skipped("IF a<B THEN ELSEIF C>d THEN ENDIF").len(), 3);
    assert_eq!(skipped("IF a <> B AND (c<D) OR (E>f) foo;").len(), 2);
    assert_eq!(
        skipped("b:=a<B; c:=(A<B)=(C>D);"),
        [
            "b is assigned a value, which is not followed",
            "c is assigned a value, which is not followed"
        ]
    );
}
