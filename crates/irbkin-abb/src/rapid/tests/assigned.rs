//! Data that a program assigns, and displacements: unknown in moves.

use std::format;
use std::string::String;
use std::string::ToString;
use std::vec::Vec;

use super::*;

const TARGET: &str = "[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";

/// The module of data, each on a line from 2 on, and of statements of a routine.
fn module(data: &str, statements: &str) -> Module {
    let module = read(&format!(
        "MODULE M CONST robtarget c:={TARGET};\n{data}\nPROC \
         main()\n{statements}\nENDPROC\nENDMODULE"
    ));
    again(&module, &[]);
    module
}

/// Why the last move has no target; empty if it has one.
fn why(data: &str, statements: &str) -> String {
    words(&module(data, statements).moves().last().unwrap().target.value)
}

fn line_4(statement: &str) -> String {
    why(
        &format!("PERS num x:=0; VAR robtarget p:={TARGET}; VAR num a{{2}}:=[1,2];"),
        &format!("{statement} MoveL Offs(p,x,a{{1}},0),v,z,tool0;"),
    )
}

#[test]
fn assigned_data_have_no_value_in_moves() {
    assert_eq!(line_4("x:=-100;"), "refers to x, which line 4 assigns");
    assert_eq!(line_4("P.trans.z:=1000;"), "refers to p, which line 4 assigns");
    assert_eq!(line_4("p.nothing:=1000;"), "refers to p, which line 4 assigns");
    assert_eq!(line_4("a{2}:=1;"), "refers to a, which line 4 assigns");
    assert_eq!(line_4("p:=CRobT();"), "refers to p, which line 4 assigns");
    assert_eq!(line_4("IF TRUE x:=x+1;"), "refers to x, which line 4 assigns");
    for instruction in
        ["Incr x;", "Decr x;", "Add x,5;", "Clear x;", "Incr Name:=x;", "TPReadNum x,\"?\";"]
    {
        assert_eq!(line_4(instruction), "refers to x, which line 4 assigns", "{instruction}");
    }
    for instruction in [
        "SearchL\\SStop,di1,p,c,v,tool0;",
        "SearchC di1\\Flanks, p, c, c, v, tool0;",
        "SearchExtJ \\Stop, di(1,2), p, c, v;",
    ] {
        assert_eq!(line_4(instruction), "refers to p, which line 4 assigns", "{instruction}");
    }
    assert_eq!(line_4("SearchL di1,q,p,v,tool0; Add y,x; foo x; WHILE x=p DO ENDWHILE"), "");
    let declared = module("PERS num x:=5;", "x:=1;");
    assert_eq!(number(&declared, "x"), 5.0);
}

#[test]
fn assignments_anywhere_in_the_module_count() {
    let text = format!(
        "PERS robtarget p:={TARGET};\nPROC a() MoveL p,v,z,tool0; ENDPROC\n\n! note\nPROC b() \
         p:=p; ENDPROC"
    );
    let module = read(&text);
    assert_eq!(words(&module.moves()[0].target.value), "refers to p, which line 5 assigns");
    again(&module, &[]);
    // A local one there is another datum.
    let local = format!(
        "PERS robtarget p:={TARGET};\nPROC a() MoveL p,v,z,tool0; ENDPROC\nPROC b() VAR robtarget \
         p; p:=x; ENDPROC"
    );
    assert!(read(&local).moves()[0].target.value.is_ok());
    let parameter = format!(
        "PERS robtarget p:={TARGET};\nPROC a() MoveL p,v,z,tool0; ENDPROC\nPROC b(INOUT robtarget \
         p) p:=x; ENDPROC"
    );
    assert!(read(&parameter).moves()[0].target.value.is_ok());
}

#[test]
fn data_that_refer_to_assigned_data_have_no_value() {
    assert_eq!(why("VAR robtarget q:=c;", "MoveL q,v,z,tool0;"), "");
    let data = format!("VAR robtarget p:={TARGET}; VAR robtarget q:=p; VAR robtarget r:=q;");
    assert_eq!(
        why(&data, "p:=c; MoveL r,v,z,tool0;"),
        "refers to r, which depends on p, which line 4 assigns"
    );
    let data = format!("VAR robtarget r:=q; VAR robtarget q:=p; VAR robtarget p:={TARGET};");
    assert_eq!(
        why(&data, "p:=c; MoveL r,v,z,tool0;"),
        "refers to r, which depends on p, which line 4 assigns"
    );
    let kept = module(
        "VAR num x:=1; VAR num a{2}:=[ x, 2 ]; CONST num n:=x; VAR num b{n}:=[4];",
        "x:=2; MoveL Offs(c,a{2},0,b{1}),v,z,tool0;",
    );
    assert!(
        kept.to_string().contains(
            "VAR num x:=1;\n    VAR num a{2}:=[ x, 2 ];\n    CONST num \
        n:=x;\n    VAR num b{1}:=[4];"
        ),
        "{kept}"
    );
    assert_eq!(
        words(&kept.moves()[0].target.value),
        "refers to a, which depends on x, which line 4 assigns"
    );
    assert!(module("PERS tooldata t:=tool0;", "MoveL c,v,z,t;").moves()[0].tool.value.is_ok());
    let moved = module(
        "PERS tooldata t:=tool0; PERS wobjdata w:=wobj0;",
        "t.tframe.trans.z:=5; w:=x; MoveL c,v,z,t\\WObj:=w;",
    );
    assert_eq!(words(&moved.moves()[0].tool.value), "refers to t, which line 4 assigns");
    assert_eq!(
        words(&moved.moves()[0].wobj.as_ref().unwrap().value),
        "refers to w, which line 4 assigns"
    );
}

#[test]
fn other_modules_assign_too() {
    let data = format!(
        "MODULE Data PERS robtarget p:={TARGET}; PERS robtarget q:=p; PERS robtarget r:={TARGET};"
    );
    let still = read(&format!("{data} ENDMODULE"));
    let moving = read(&format!("{data} PROC a() VAR num r; p:=x; r:=1; ENDPROC ENDMODULE"));
    let why = |text: &str, context: &[&Module]| {
        let module = parse(text, context).unwrap();
        again(&module, context);
        words(&module.moves()[0].target.value)
    };
    assert_eq!(why("MoveL p,v,z,tool0;", &[&still]), "");
    assert_eq!(why("MoveL r,v,z,tool0;", &[&moving]), "");
    assert_eq!(why("MoveL p,v,z,tool0;", &[&moving]), "refers to p, which module Data assigns");
    assert_eq!(why("MoveL q,v,z,tool0;", &[&moving]), "refers to q, which module Data assigns");
    assert_eq!(why("MoveL p,v,z,tool0;\np:=x;", &[&still]), "refers to p, which line 2 assigns");
    let own = "VAR robtarget s:=p; MoveL s,v,z,tool0;\np.trans.x:=1;";
    assert_eq!(why(own, &[&still]), "refers to s, which depends on p, which line 2 assigns");
    let third = read("MODULE Third PROC b() p:=x; ENDPROC ENDMODULE");
    assert_eq!(
        why("MoveL p,v,z,tool0;", &[&still, &third]),
        "refers to p, which module Third assigns"
    );
}

#[test]
fn displaced_moves_report_the_line() {
    let step = "MoveL c,v,z,tool0;";
    let joints = "MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v,z,tool0;";
    let text = format!(
        "{step}\nPDispOn \\ExeP:=c, c, tool0;\n{step}\n{step} EOffsSet x;\n{joints} {step} \
         PDispOff;\n{step}"
    );
    let module = module("", &text);
    let lines: Vec<_> = module.moves().iter().map(|step| step.displaced).collect();
    assert_eq!(lines, [None, Some(5), Some(5), None, Some(5), None]);
    let two = read(&format!(
        "PROC a() PDispSet x; {step} ENDPROC PROC b() {step} ENDPROC PROC d() PDispOn c; {step} \
         ENDPROC"
    ));
    assert_eq!(
        two.moves().iter().map(|step| step.displaced).collect::<Vec<_>>(),
        [Some(1), None, Some(1)]
    );
    again(&two, &[]);
}

#[test]
fn only_the_components_that_are_assigned_have_no_value() {
    let data = format!(
        "PERS tooldata t:=[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]; \
        PERS tooldata t2:=t; VAR robtarget p:={TARGET}; VAR robtarget a{{2}}:=[p,p];"
    );
    let tool = |statements: &str, tool: &str| {
        let module = module(&data, &format!("{statements} MoveL c,v,z,{tool};"));
        words(&module.moves()[0].tool.value)
    };
    for statement in ["t.tload.mass:=5;", "T.TLOAD := load0;", "t.tload.cog.x:=1;"] {
        assert_eq!(tool(statement, "t") + &tool(statement, "t2"), "", "{statement}");
    }
    for statement in ["t:=tool0;", "t.tframe.trans.z:=5;", "t.robhold:=FALSE;", "t.tframe:=x;"] {
        assert_eq!(tool(statement, "t"), "refers to t, which line 4 assigns", "{statement}");
        let through = "refers to t2, which depends on t, which line 4 assigns";
        assert_eq!(tool(statement, "t2"), through, "{statement}");
    }
    let target = |statement: &str, target: &str| {
        why(&data, &format!("{statement} MoveL {target},v,z,tool0;"))
    };
    assert_eq!(target("p.trans.z:=5;", "Offs(c,p.trans.x,p.rot.q1,p.trans.y)"), "");
    assert_eq!(
        target("p.trans.z:=5;", "Offs(c,0,0,p.trans.z)"),
        "refers to p, which line 4 assigns"
    );
    assert_eq!(target("p.extax:=x;", "p"), "refers to p, which line 4 assigns");
    assert_eq!(target("a{1}.trans.z:=5;", "Offs(c,a{2}.trans.x,0,0)"), "");
    assert_eq!(target("a{1}.trans.z:=5;", "a{2}"), "refers to a, which line 4 assigns");
    let other = read("MODULE Other PROC b() t.tload:=load0; ENDPROC ENDMODULE");
    let own = parse(&format!("{} MoveL c,v,z,t;", data.replace(TARGET, "*")), &[&other]).unwrap();
    assert_eq!(words(&own.moves()[0].tool.value), "");
}
