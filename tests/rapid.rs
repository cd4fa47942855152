//! RAPID modules: what is written reads back unchanged, and invalid text is reported with an exact
//! message.

use std::fmt::Write;

use irbkin::Configuration;
use irbkin_abb::Error;
use irbkin_abb::rapid::{
    Content, JointTarget, LoadData, Module, RapidPose, RobTarget, ToolData, Value, WobjData,
    decode, parse,
};
use proptest::prelude::*;
use proptest::test_runner::Config as ProptestConfig;

const WELD: &str = include_str!("data/rapid/weld.mod");
const TOOLS: &[u8] = include_bytes!("data/rapid/tools.sys");
const PENDANT: &str = include_str!("data/rapid/pendant.prg");

/// Any finite number, numbers with many digits, and numbers as in modules.
fn numbers() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("finite", |number| number.is_finite()),
        -3000.0..3000.0,
        (-3_000_000..3_000_000_i32).prop_map(|thousandths| f64::from(thousandths) / 1000.0),
        Just(9e9),
        Just(0.0),
    ]
    .prop_map(|number| number + 0.0)
}

fn triples() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(numbers())
}

fn quaternions() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(numbers())
}

fn poses() -> impl Strategy<Value = RapidPose> {
    (triples(), quaternions()).prop_map(|(trans_mm, rot)| RapidPose { trans_mm, rot })
}

fn configurations() -> impl Strategy<Value = Configuration> {
    prop::array::uniform4(any::<i32>()).prop_map(|[cf1, cf4, cf6, cfx]| Configuration {
        cf1,
        cf4,
        cf6,
        cfx,
    })
}

fn robtargets() -> impl Strategy<Value = RobTarget> {
    let parts = (triples(), quaternions(), configurations(), prop::array::uniform6(numbers()));
    parts.prop_map(|(trans_mm, rot, robconf, extax)| RobTarget { trans_mm, rot, robconf, extax })
}

fn loads() -> impl Strategy<Value = LoadData> {
    let parts = (numbers(), triples(), quaternions(), triples());
    parts.prop_map(|(mass_kg, cog_mm, aom, inertia)| LoadData { mass_kg, cog_mm, aom, inertia })
}

fn wobjs() -> impl Strategy<Value = WobjData> {
    let parts = (any::<bool>(), any::<bool>(), any::<String>(), poses(), poses());
    parts.prop_map(|(robhold, ufprog, ufmec, uframe, oframe)| WobjData {
        robhold,
        ufprog,
        ufmec,
        uframe,
        oframe,
    })
}

fn values() -> impl Strategy<Value = Value> {
    let six = || prop::array::uniform6(numbers());
    prop_oneof![
        robtargets().prop_map(Value::RobTarget),
        (six(), six())
            .prop_map(|(robax_deg, extax)| Value::JointTarget(JointTarget { robax_deg, extax })),
        (any::<bool>(), poses(), loads()).prop_map(|(robhold, tframe, tload)| Value::ToolData(
            ToolData { robhold, tframe, tload }
        )),
        wobjs().prop_map(Value::WobjData),
        poses().prop_map(Value::Pose),
        triples().prop_map(Value::Pos),
        quaternions().prop_map(Value::Orient),
        configurations().prop_map(Value::ConfData),
        six().prop_map(Value::ExtJoint),
        loads().prop_map(Value::LoadData),
        numbers().prop_map(Value::Num),
    ]
}

/// The module written and read again, which must be equal.
fn holds(module: &Module, context: &[&Module]) -> Module {
    let text = module.to_string();
    let again = parse(&text, context).unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(again.clone().without_positions(), module.clone().without_positions(), "{text}");
    again
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn every_value_reads_back_bit_for_bit(value in values()) {
        let module = parse(&format!("CONST {} it:={value};", value.type_name()), &[]).unwrap();
        prop_assert_eq!(&module.find("IT").unwrap().content, &Content::Single(value));
        holds(&module, &[]);
    }

    #[test]
    fn arrays_read_back_as_they_are(
        columns in 1..4_usize,
        targets in prop::collection::vec(robtargets(), 1..12),
    ) {
        let row = |row: &[RobTarget]| {
            row.iter().map(RobTarget::to_string).collect::<Vec<_>>().join(",")
        };
        let rows: Vec<_> = targets.chunks_exact(columns).map(row).collect();
        prop_assume!(!rows.is_empty());
        let (count, written) = (rows.len(), rows.join("],["));
        let text = format!("PERS robtarget pts{{{count},{columns}}}:=[[{written}]];");
        let module = parse(&text, &[]).unwrap();
        let Content::Array { sizes, values } = &module.data()[0].content else { panic!() };
        prop_assert_eq!(sizes, &[rows.len(), columns]);
        let wanted = targets[..values.len()].iter().copied().map(Value::RobTarget);
        prop_assert_eq!(values, &wanted.collect::<Vec<_>>());
        holds(&module, &[]);
    }
}

#[test]
fn real_looking_modules_are_read() {
    let tools = parse(&decode(TOOLS), &[]).unwrap();
    assert_eq!(
        (tools.name(), tools.attributes().len(), tools.data().len()),
        (Some("CalibData"), 1, 5)
    );
    let alone = parse(WELD, &[]).unwrap();
    assert!(alone.moves().iter().all(|step| step.tool.value.is_err()));
    let weld = parse(WELD, &[&tools]).unwrap();
    assert_eq!((weld.data().len(), weld.moves().len()), (11, 9));
    for step in weld.moves() {
        assert!(
            step.target.value.is_ok() && step.tool.value.is_ok(),
            "{step}: {:?}",
            step.target.value
        );
    }
    let pendant = parse(PENDANT, &[]).unwrap();
    assert_eq!(
        (
            pendant.moves().len(),
            pendant.moves().iter().filter(|step| step.target.value.is_err()).count()
        ),
        (5, 2)
    );
    for module in [&tools, &alone, &pendant] {
        holds(module, &[]);
    }
    holds(&weld, &[&tools]);
}

/// An error in a text, with its message.
const BROKEN: &[(&str, &str)] = &[
    (
        "MODULE M\n  CONST string s:=\"abc;\nENDMODULE",
        "line 2, column 19: the string has no closing quote on its line",
    ),
    ("CONST num a:=12abc;", "line 1, column 14: 12abc is not a number"),
    ("CONST num a:=1.2.3;", "line 1, column 14: 1.2.3 is not a number"),
    ("CONST num a:=1e;", "line 1, column 14: 1e is not a number"),
    ("CONST num a:=0xZZ;", "line 1, column 14: 0xZZ is not a number"),
    ("CONST num a:=1E999;", "line 1, column 14: 1E999 is not finite, every number must be"),
    ("CONST num a:=1+1/0;", "line 1, column 16: 1/0 is not finite, every number must be"),
    (
        "CONST num b:=-9E300*9E300;",
        "line 1, column 14: -9E300*9E300 is not finite, every number must be",
    ),
    ("é := 1;\n\n  # foo;", "line 3, column 3: '#' has no place outside a string or a comment"),
    ("CONST pos p:=[1,2,3;", "line 1, column 14: [ is not closed"),
    ("CONST num p:=(1+2;", "line 1, column 14: ( is not closed"),
    ("CONST num p{2:=[1,2];", "line 1, column 14: expected a comma or }, found :="),
    ("CONST num p{2;", "line 1, column 12: { is not closed"),
    ("é; foo (1,[2};", "line 1, column 10: expected an operator or ), found ,"),
    ("foo (1,[2;", "line 1, column 7: expected an operator or ), found ,"),
    ("foo 1);", "line 1, column 6: expected a comma or a semicolon, found )"),
    ("CONST pos p:=[1,2,3);", "line 1, column 20: expected a comma or ], found )"),
    ("CONST num a:=;", "line 1, column 14: expected a value, found ;"),
    (
        "CONST num a:=1 2;",
        "line 1, column 16: expected an operator, a comma or the end of the expression, found 2",
    ),
    ("CONST num a:=1", "line 1, column 15: expected a semicolon, found the end of the text"),
    ("CONST num if:=1;", "line 1, column 11: expected a name, found if"),
    ("LOCAL p:=1;", "line 1, column 7: expected CONST, PERS, VAR, PROC, FUNC or TRAP, found p"),
    (
        "foo\nMoveL p,v1,z1,tool0;",
        "line 1, column 4: expected a comma or a semicolon, found the end of the line",
    ),
    ("]", "line 1, column 1: expected a declaration or an instruction, found ]"),
    (
        "MODULE M\nVAR num a;",
        "line 2, column 11: the text ends inside MODULE M: ENDMODULE is missing",
    ),
    ("MODULE M\nPROC a()\nENDMODULE", "line 3, column 1: expected ENDPROC, found ENDMODULE"),
    ("PROC a()\nfoo;", "line 2, column 5: the text ends inside PROC a: ENDPROC is missing"),
    ("PROC a()\nENDFUNC", "line 2, column 1: expected ENDPROC, found ENDFUNC"),
    ("PROC a()\nPROC b()", "line 2, column 1: expected ENDPROC, found PROC"),
    ("PROC a()\nIF x THEN\nENDPROC", "line 3, column 1: expected ENDIF, found ENDPROC"),
    ("WHILE x DO", "line 1, column 11: the text ends inside WHILE: ENDWHILE is missing"),
    (
        "ENDIF",
        "line 1, column 1: expected a declaration or an instruction (no such block is open), found ENDIF",
    ),
    ("FOR i FROM 1 TO 2 DO\nENDWHILE", "line 2, column 1: expected ENDFOR, found ENDWHILE"),
    ("FOR i FROM 1 TO 2;", "line 1, column 18: expected DO, found ;"),
    ("TEST x; CASE 1: ENDTEST", "line 1, column 7: expected CASE, found ;"),
    ("IF x VAR num a;", "line 1, column 6: expected THEN or an instruction, found VAR"),
    (
        "ENDPROC",
        "line 1, column 1: expected a declaration or an instruction (no routine is open), found ENDPROC",
    ),
    ("RECORD r\nnum a;", "line 2, column 7: the text ends inside RECORD r: ENDRECORD is missing"),
    ("%%% VERSION:1", "line 1, column 1: the text ends inside the header: %%% is missing"),
    ("x;\n%%% VERSION:1 %%%", "line 2, column 2: expected the name of a procedure, found %"),
    (
        "MODULE A ENDMODULE\nMODULE B ENDMODULE",
        "line 2, column 1: a second module begins, a text must hold one",
    ),
    ("MODULE A\n MODULE B", "line 2, column 2: a second module begins, a text must hold one"),
    ("MODULE A ENDMODULE x;", "line 1, column 20: expected the end of the text, found x"),
    (
        "x; MODULE A",
        "line 1, column 4: expected a declaration or an instruction (MODULE begins a text), found MODULE",
    ),
    (
        "CONST robtarget p10:=[[0,0,0],[1,0,0,0],[0,0,0],[0,0,0,0,0,0]];",
        "line 1, column 41: robtarget p10: robconf has 3 components, it must have 4",
    ),
    ("CONST pos p:=[1];", "line 1, column 14: pos p has 1 component, it must have 3"),
    (
        "CONST tooldata t:=[TRUE,5,load0];",
        "line 1, column 25: tooldata t: tframe is a number, it must be pose",
    ),
    (
        "CONST tooldata t:=[TRUE,[[0,0,\"a\"],[1,0,0,0]],load0];",
        "line 1, column 31: tooldata t: tframe.trans.z is a string, it must be a number",
    ),
    ("CONST num a:=TRUE;", "line 1, column 14: num a is TRUE, it must be a number"),
    ("CONST num a:=[1];", "line 1, column 14: num a is an aggregate, it must be a number"),
    (
        "CONST num a:=tool0;",
        "line 1, column 14: num a is tool0, of type tooldata, it must be a number",
    ),
    (
        "CONST wobjdata w:=[1,TRUE,\"\",tool0.tframe,tool0.tframe];",
        "line 1, column 20: wobjdata w: robhold is a number, it must be TRUE or FALSE",
    ),
    (
        "CONST num a:=tool0.trans.x;",
        "line 1, column 14: tool0.trans.x: tooldata has no component trans",
    ),
    (
        "CONST num a:=tool0.tframe.trans.w;",
        "line 1, column 14: tool0.tframe.trans.w: pos has no component w",
    ),
    (
        "CONST confdata c:=[0,0.5,0,0];",
        "line 1, column 22: confdata c: cf4 is 0.5, it must be a whole number",
    ),
    (
        "CONST confdata c:=[0,0,9E9,0];",
        "line 1, column 24: confdata c: cf6 is 9000000000, it must be a whole number",
    ),
    (
        "CONST num a{2}:=[1,2,3];",
        "line 1, column 17: num a: dimension 1 has 3 elements, it must have 2",
    ),
    (
        "CONST num a{1,2}:=[[1]];",
        "line 1, column 20: num a: dimension 2 has 1 element, it must have 2",
    ),
    ("CONST num a{2}:=5;", "line 1, column 17: num a is a number, it must be an array"),
    (
        "CONST num a{0}:=[];",
        "line 1, column 13: num a: size of dimension 1 is 0, it must be a positive whole number",
    ),
    (
        "CONST num a{1,1.5}:=[[1]];",
        "line 1, column 15: num a: size of dimension 2 is 1.5, it must be a positive whole number",
    ),
    (
        "VAR num a{-1};",
        "line 1, column 11: num a: size of dimension 1 is -1, it must be a positive whole number",
    ),
    ("VAR num a{};", "line 1, column 10: expected a size, found {}"),
    ("VAR num a{1,1,1,1};", "line 1, column 17: num a has 4 dimensions, it must have at most 3"),
    (
        "CONST num a{2}:=[1,2];CONST num b:=a{3};",
        "line 1, column 38: a{3}: index 3 must be a whole number from 1 to 2",
    ),
    (
        "CONST num a{2}:=[1,2];CONST num b:=a{0};",
        "line 1, column 38: a{0}: index 0 must be a whole number from 1 to 2",
    ),
    (
        "CONST num a{2}:=[1,2];CONST num b:=a{1,1};",
        "line 1, column 36: a{1,1} has 2 indices, it must have 1",
    ),
    (
        "CONST num a:=1;CONST num b:=a{1};",
        "line 1, column 29: a{1} has 1 index, but it is not an array",
    ),
    ("VAR num a;\nVAR pos A;", "line 2, column 1: A is declared twice in the module"),
    ("PROC p(num a)\nVAR bool A;\nENDPROC", "line 2, column 1: A is declared twice in p"),
    (
        "CONST num a:=b; CONST num b:=a+1;",
        "line 1, column 1: values refer to one another in a circle: a, b, a",
    ),
    (
        "CONST num a{2}:=[1,a{1}];",
        "line 1, column 1: values refer to one another in a circle: a, a",
    ),
    ("MoveL p, v1, z1;", "line 1, column 1: MoveL has 3 arguments, it must have 4"),
    ("MoveC p, v1, z1, tool0;", "line 1, column 1: MoveC has 4 arguments, it must have 5"),
    (
        "MoveL load0, v1, z1, tool0;",
        "line 1, column 7: MoveL target is load0, of type loaddata, it must be robtarget",
    ),
    (
        "MoveL *, v1, z1, wobj0;",
        "line 1, column 18: MoveL tool is wobj0, of type wobjdata, it must be tooldata",
    ),
    (
        "MoveL *, v1, z1, tool0\\WObj:=tool0;",
        "line 1, column 30: MoveL work object is tool0, of type tooldata, it must be wobjdata",
    ),
    (
        "MoveAbsJ [[1,2,3],[0,0,0,0,0,0]], v1, z1, tool0;",
        "line 1, column 11: MoveAbsJ target: robax has 3 components, it must have 6",
    ),
    (
        "MoveL p, v1, z1, tool0",
        "line 1, column 23: expected a comma or a semicolon, found the end of the text",
    ),
    (
        "MoveL p, v1, z1, tool0\\;",
        "line 1, column 24: expected the name of an optional argument, found ;",
    ),
];

#[test]
fn invalid_input_is_reported() {
    for (text, words) in BROKEN {
        match parse(text, &[]) {
            Err(Error::Rapid(fault)) => assert_eq!(fault.to_string(), *words, "{text}"),
            other => panic!("{text}: {other:?}"),
        }
    }
}

#[test]
fn nesting_is_bounded() {
    let nested =
        |depth: usize| format!("CONST num a:={}1{};", "(".repeat(depth), ")".repeat(depth));
    assert!(parse(&nested(64), &[]).is_ok());
    let words = "line 1, column 78: nested deeper than 64, the deepest that is read";
    assert_eq!(parse(&nested(65), &[]).unwrap_err().to_string(), words);
    for open in ["[", "(", "{", "f(", "a{"] {
        let text = format!("CONST num a:={}", open.repeat(100_000));
        assert!(parse(&text, &[]).is_err());
        assert!(parse(&format!("foo {}", open.repeat(100_000)), &[]).is_err());
    }
    let blocks = |depth: usize| format!("{}{}", "IF x THEN ".repeat(depth), "ENDIF ".repeat(depth));
    assert!(parse(&blocks(64), &[]).is_ok());
    assert!(parse(&blocks(65), &[]).is_err());
    let mut long = String::from("CONST num a:=0");
    (0..100_000).for_each(|_| write!(long, "+-1*1").unwrap());
    let sum = parse(&format!("{long};"), &[]).unwrap();
    assert_eq!(sum.find("a").unwrap().content, Content::Single(Value::Num(-100_000.0)));
}
