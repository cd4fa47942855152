//! Names: references, components, elements, scopes, other modules.

use std::format;
use std::string::ToString;
use std::vec::Vec;

use super::*;

#[test]
fn names_are_resolved_before_and_after_their_declarations() {
    let module = read(
        "CONST num a:=b+1; CONST num b:=2*(3-1)/8; CONST pos p:=[a,-b,q.z]; CONST pos q:=[0,0,-a];",
    );
    assert_eq!((number(&module, "a"), number(&module, "b")), (1.5, 0.5));
    assert_eq!(single(&module, "p"), Value::Pos([1.5, -0.5, -1.5]));
}

#[test]
fn components_and_elements_are_values() {
    let module = read(
        "CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,-1,0,7],[9E9,9E9,9E9,9E9,9E9,9E9]];
         CONST robtarget r:=[p.trans,P.ROT,p.robconf,p.extax]; CONST num x:=p.trans.y+p.robconf.cfx;
         CONST pos pts{2,2}:=[[[1,1,1],[1,2,0]],[[2,1,0],[2,2,5]]]; CONST num i:=2; CONST num \
             z:=pts{2,i}.z;
         CONST robtarget s:=[pts{1,2},tool0.tframe.rot,[z,0,0,0],p.extax];
         CONST wobjdata w:=[FALSE,wobj0.ufprog,wobj0.ufmec,wobj0.uframe,[pts{1,1},[1,0,0,0]]]; \
             CONST jointtarget j:=[[1,2,3,4,5,6],p.extax];
         CONST num j2:=j.robax.rax_2; CONST tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],load0]; CONST \
             wobjdata w2:=w;",
    );
    assert!(module.skipped().is_empty(), "{:?}", module.skipped());
    assert_eq!(single(&module, "p"), single(&module, "r"));
    assert_eq!(
        (number(&module, "x"), number(&module, "z"), number(&module, "j2")),
        (9.0, 5.0, 2.0)
    );
    assert!(single(&module, "s").to_string().starts_with("[[1,2,0],[1,0,0,0],[5,0,0,0],"));
    assert_eq!(single(&module, "w"), single(&module, "w2"));
    again(&module, &[]);
}

#[test]
fn long_chains_of_names_are_read_from_both_ends() {
    let count = 50_000;
    let line = |i: usize| format!("CONST num p{i}:=p{};", i + 1);
    let forward = (0..count).map(line).collect::<Vec<_>>().join("\n");
    let backward = (0..count).rev().map(line).collect::<Vec<_>>().join("\n");
    for text in
        [format!("{forward}CONST num p{count}:=7;"), format!("CONST num p{count}:=7;{backward}")]
    {
        assert_eq!(number(&read(&text), "p0"), 7.0);
    }
    let circle = format!("{forward}CONST num p{count}:=p3;");
    let words = fault(&circle);
    assert!(
        words.starts_with("line 4, column 1: values refer to one another in a circle: p3, p4, p5,"),
        "{words}"
    );
    assert!(words.ends_with("and 49987 more"), "{words}");
}

#[test]
fn unknown_values_report_the_reason() {
    let why = |text: &str| not_read(&read(text)).pop().unwrap();
    assert_eq!(why("CONST num a:=b;"), "a: refers to b, which is not in this module");
    assert_eq!(why("VAR num b; CONST num a:=b;"), "a: refers to b, whose declaration has no value");
    assert_eq!(
        why("CONST num b:=f(1); CONST num a:=b;"),
        "a: refers to b, whose value is not known"
    );
    assert_eq!(
        why("VAR bool b; CONST num a:=b;"),
        "a: refers to b, of type bool, which is not read"
    );
    assert_eq!(
        why("CONST num b{2}:=[1,2]; CONST num a{2}:=b;"),
        "a: refers to b, and arrays are not copied"
    );
    assert_eq!(
        why("CONST num b{2}:=[1,2]; CONST num a:=b;"),
        "a: refers to b, which is a whole array"
    );
    assert_eq!(
        why("VAR num i:=1; CONST num b{2}:=[1,2]; CONST num a:=b{i};"),
        "a: refers to i, which can change"
    );
    assert_eq!(why("VAR num n:=2; CONST num b{n}:=[1,2];"), "b: refers to n, which can change");
    assert_eq!(why("CONST num a:=1 XOR 2;"), "a: this operator is not evaluated");
    assert_eq!(
        why("CONST pose a:=-[[1,2,3],[1,0,0,0]];"),
        "a: arithmetic of pose is not evaluated"
    );
    assert_eq!(why("CONST num a:=NOT TRUE;"), "a: NOT is not evaluated");
    assert_eq!(why("CONST num b{2}:=1+1;"), "b: the value of the array is not an aggregate");
    assert_eq!(
        why("CONST pos b{1}:=[*];"),
        "b: * is taught on the controller, its value is not in the text"
    );
}

#[test]
fn names_of_a_routine_hide_those_of_the_module() {
    let module = read(
        "MODULE M CONST num a:=1; CONST num b:=10;
         PROC one() VAR num a:=2; VAR num c:=a+b; ENDPROC
         PROC two(num a, \\switch b | num d) VAR num c:=a; VAR num e:=b; VAR num f:=d; ENDPROC
         ENDMODULE",
    );
    let in_one: Vec<_> =
        module.data().iter().filter(|datum| datum.routine.as_deref() == Some("one")).collect();
    assert_eq!(in_one[1].content, Content::Single(Value::Num(12.0)));
    assert_eq!(number(&module, "a"), 1.0);
    assert_eq!(
        not_read(&module),
        [
            "c: refers to a, a parameter of two",
            "e: refers to b, a parameter of two",
            "f: refers to d, a parameter of two"
        ]
    );
    again(&module, &[]);
}

#[test]
fn names_are_found_in_other_modules() {
    let tools = read(
        "MODULE Tools PERS num x:=1; LOCAL PERS num y:=2; PROC p() VAR num z:=3; ENDPROC ENDMODULE",
    );
    let more = read("PERS num x:=5; PERS num y:=6;");
    let text =
        "CONST num a:=x; CONST num b:=y; CONST num c:=z; CONST num d{1}:=[1]; CONST num e:=d{x};";
    let module = parse(text, &[&tools, &more]).unwrap();
    assert_eq!((number(&module, "a"), number(&module, "b")), (1.0, 6.0));
    assert_eq!(
        not_read(&module),
        ["c: refers to z, which is not in this module", "e: refers to x, which can change"]
    );
    again(&module, &[&tools, &more]);
}

#[test]
fn modules_are_equal_to_what_they_write() {
    for text in [
        "CONST num n:=2; VAR num a{n}:=[1,2]; PROC b() a{1}:=5; ENDPROC",
        "CONST num n:=2; VAR num x:=1; VAR num a{n}:=[x,2]; PROC b() x:=5; ENDPROC",
        "CONST dnum n:=2; VAR dnum a{n,1+1}; CONST dnum b:=4294967295; LOCAL PERS dnum c:=-b;",
        "PROC b() foo; VAR num a:=1; MoveL *,v1,z1,tool0; CONST num c{1}:=[a]; ENDPROC",
        "MODULE M(NOSTEPIN) TASK PERS tooldata t:=tool0; ALIAS num l; VAR l k; ENDMODULE",
    ] {
        again(&read(text), &[]);
    }
    let module = read("VAR DNUM d:=0x1F; CONST num e:=d;");
    let (Value::Dnum(d), Value::Num(e)) = (single(&module, "d"), single(&module, "e")) else {
        panic!()
    };
    assert_eq!((d, e), (31.0, 31.0));
    assert!(module.to_string().starts_with("VAR dnum d:=31;\n"));
}
