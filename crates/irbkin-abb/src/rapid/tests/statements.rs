//! Each statement is read once, with its expressions, into one list in the order of the text.

use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use super::*;
use crate::rapid::data::expression::{Expression, Relation};
use crate::rapid::data::statement::{Condition, Flow, Instruction, Statement, StatementKind};
use crate::rapid::read;

/// A routine of some statements, each on a line of its own, from line 2.
fn module_of(statements: &str) -> Module {
    let module = read(&format!("MODULE M PROC main()\n{statements}\nENDPROC ENDMODULE"), &[]);
    assert_eq!(module.faults(), [], "{statements}");
    module
}

/// The text of an expression of a statement.
fn written<'s>(statement: &'s Statement, expression: &Expression<'_>) -> &'s str {
    &statement.text[expression.start..expression.end]
}

/// The only instruction of a text.
fn instruction_of(text: &str) -> Instruction {
    let module = module_of(text);
    let [statement] = module.statements.as_slice() else { panic!("{text}") };
    let StatementKind::Instruction(instruction) = &statement.kind else { panic!("{text}") };
    Instruction::clone(instruction)
}

/// The condition of the first line of a text.
fn condition_of(text: &str) -> Condition {
    let module = module_of(text);
    match &module.statements[0].kind {
        StatementKind::Flow { flow: Flow::If { condition, .. }, .. }
        | StatementKind::Flow { flow: Flow::Loop { condition, .. }, .. } => condition.clone(),
        other => panic!("{other}"),
    }
}

#[test]
fn statements_are_in_the_order_of_the_text() {
    let text = "ConfL\\Off;
VAR egmident e;
MoveJ [[600,0,800],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
n:=n+1;
l1:
IF n=1 GOTO l1;
VAR robtarget r:=unknown;
rGo n;
MoveL *,v100,fine,tool0;
ConfL\\On;";
    let module = module_of(text);
    let kinds = module.statements.iter().map(|it| match &it.kind {
        StatementKind::Move(index) => format!("move {index}"),
        StatementKind::Setting(it) => format!("setting {}", it.word),
        kind => kind.to_string(),
    });
    let words = [
        "setting ConfL",
        "e: type egmident is not read",
        "move 0",
        "n is assigned a value, which is not followed",
        "label l1 is not read",
        "IF is not executed",
        "GOTO is not an instruction that is read",
        "r: refers to unknown, which is not in this module",
        "rGo is not an instruction that is read",
        "move 1",
        "setting ConfL",
    ];
    assert_eq!(kinds.collect::<Vec<String>>(), words);
    let lines = module.statements.iter().map(|it| it.line);
    assert_eq!(lines.collect::<Vec<_>>(), [2, 3, 4, 5, 6, 7, 7, 8, 9, 10, 11]);
    assert!(module.statements.iter().all(|it| it.routine.as_deref() == Some("main")));
    let skipped: Vec<String> = module.skipped().into_iter().map(Statement::what).collect();
    assert_eq!(skipped, [&words[1..2], &words[3..9]].concat());
}

#[test]
fn bytes_of_expressions_count_from_the_beginning_of_their_statement() {
    let module =
        module_of("rGo   1+2*n, \\Z:=a{1,k}.b\\S?s, [f(x\\o),-2];\n  p{i}.trans . x := (a+b)*3;");
    let [call, assignment] = module.statements.as_slice() else { panic!() };
    let StatementKind::Instruction(own) = &call.kind else { panic!() };
    let required = own.arguments.required.iter().map(|it| written(call, it));
    assert_eq!(required.collect::<Vec<_>>(), ["1+2*n", "[f(x\\o),-2]"]);
    let optional = own.arguments.optional.iter();
    let optional =
        optional.map(|it| (&*it.name, it.after, it.value.as_ref().map(|it| written(call, it))));
    assert_eq!(optional.collect::<Vec<_>>(), [("Z", 1, Some("a{1,k}.b")), ("S", 1, Some("?s"))]);
    let (_, indices, components) = own.arguments.value("z").unwrap().reference().unwrap();
    assert_eq!((written(call, &indices[1]), &*components[0]), ("k", "b"));
    let StatementKind::Assignment(own) = &assignment.kind else { panic!() };
    assert_eq!(own.to, ("p".to_string(), "trans.x".to_string()));
    assert_eq!(written(assignment, &own.target), "p{i}.trans . x");
    assert_eq!(written(assignment, &own.value), "(a+b)*3");
}

#[test]
fn calls_have_the_name_of_a_procedure_unless_it_is_calculated() {
    for (text, name) in [
        ("RGo;", Some("rgo")),
        ("%\"rGo\"% 1;", Some("rgo")),
        ("%\"Part: rGo\"%;", Some("rgo")),
        ("%\"r\"+n% 1;", None),
        ("RETURN 1=2;", Some("return")),
    ] {
        assert_eq!(instruction_of(text).name.as_deref(), name, "{text}");
    }
    assert_eq!(instruction_of("Incr a.b;").written, Some(("a".into(), "b".into())));
    assert_eq!(instruction_of("CONNECT i1 WITH tr;").arguments.required.len(), 2);
    assert!(instruction_of("ArcMoveX p,v10,fine,t;").written.is_none());
}

#[test]
fn conditions_are_read_as_far_as_they_are_evaluated() {
    assert_eq!(condition_of("IF TRUE THEN\nENDIF"), Condition::Always);
    assert_eq!(condition_of("WHILE (TRUE) DO\nENDWHILE"), Condition::Always);
    assert!(matches!(condition_of("IF (a=1) THEN\nENDIF"), Condition::Compared(..)));
    assert_eq!(condition_of("WHILE FALSE DO\nENDWHILE"), Condition::Never);
    let present = |wanted| Condition::Present("x".into(), wanted);
    assert_eq!(condition_of("IF Present(X) RETURN;"), present(true));
    assert_eq!(condition_of("IF NOT present ( x ) THEN\nENDIF"), present(false));
    for (sign, relation) in [
        ("=", Relation::Equal),
        ("<>", Relation::Unequal),
        ("<", Relation::Less),
        ("<=", Relation::AtMost),
        (">", Relation::Greater),
        (">=", Relation::AtLeast),
    ] {
        let found = condition_of(&format!("WHILE a+1{sign}-b DO\nENDWHILE"));
        assert!(matches!(found, Condition::Compared(_, own) if own == relation), "{sign}");
        let holds = [(1.0, 2.0), (2.0, 2.0), (3.0, 2.0)].map(|(a, b)| relation.holds(a, b));
        let wanted = match sign {
            "=" => [false, true, false],
            "<>" => [true, false, true],
            "<" => [true, false, false],
            "<=" => [true, true, false],
            ">" => [false, false, true],
            _ => [false, true, true],
        };
        assert_eq!(holds, wanted, "{sign}");
    }
    for open in ["a=1 AND b=2", "NOT a=1", "a", "a=b=c", "NOT TRUE", "TRUE OR a", "Present(x)=a"] {
        let found = condition_of(&format!("IF {open} THEN\nENDIF"));
        let is_other = matches!(found, Condition::Other(Some(_)));
        let is_compared = matches!(found, Condition::Compared(..));
        assert!(if open.starts_with('P') { is_compared } else { is_other }, "{open}");
    }
    let module = module_of("FOR I FROM 1 TO n+1 STEP 2 DO\nENDFOR TEST n CASE 1,-2: ENDTEST");
    let [head, _, test, case, _] = module.statements.as_slice() else { panic!() };
    let StatementKind::Flow { flow: Flow::Loop { counter: Some(counter), .. }, .. } = &head.kind
    else {
        panic!()
    };
    let [from, to] = counter.bounds.each_ref().map(|it| written(head, it));
    let step = counter.step.as_ref().map(|it| written(head, it));
    assert_eq!((&*counter.variable, from, to, step), ("i", "1", "n+1", Some("2")));
    let StatementKind::Flow { flow: Flow::Test(Some(tested)), .. } = &test.kind else { panic!() };
    assert_eq!(written(test, tested), "n");
    let StatementKind::Flow { flow: Flow::Part(Condition::Case(values)), .. } = &case.kind else {
        panic!()
    };
    assert_eq!(values.iter().map(|it| written(case, it)).collect::<Vec<_>>(), ["1", "-2"]);
}

#[test]
fn prefixes_without_end_are_read_in_a_loop() {
    for prefix in ["NOT ", "-", "+", "-NOT "] {
        let value = format!("{}a", prefix.repeat(100_000));
        let module = module_of(&format!("x:={value};"));
        let StatementKind::Assignment(own) = &module.statements[0].kind else { panic!() };
        assert_eq!(written(&module.statements[0], &own.value), value);
    }
}
