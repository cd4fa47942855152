//! Move instructions.

use std::format;
use std::string::String;
use std::string::ToString;
use std::sync::Arc;
use std::vec::Vec;

use super::*;
use crate::rapid::{MoveKind, MoveOption, Target, ToolData, WobjData};

const DATA: &str = "CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
    CONST jointtarget j:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]; CONST robtarget pts{1}:=[p]; \
        PERS wobjdata w:=wobj0;";

fn module(steps: &str) -> Module {
    read(&format!("MODULE M\n{DATA}\nPROC main()\n{steps}\nENDPROC\nENDMODULE"))
}

#[test]
fn moves_are_read_with_all_their_arguments() {
    let module = module(
        "MoveJ \\Conc, p\\ID:=10, v100 \\V:=500,z10\\Z:=5\\Inpos:=inpos20, tool0\\Corr\\wobj:= w \
         \\TLoad:=load0;
         movel Offs(p,0,0,50), v100, fine, tool0;
         MoveC p, pts{1}, vmax, z1, tool0\\WObj:=wobj0;
         MoveAbsJ j\\NoEOffs, v1000\\T:=5, z50, tool0;
         MoveAbsJ [[1,2,3,4,5,6], [9E9,9E9,9E9,9E9,9E9,9E9]], v5, fine, tool0;",
    );
    let [first, second, circle, joints, inline] = module.moves() else { panic!() };
    assert_eq!(
        (first.kind, first.line, first.column, first.routine.as_deref()),
        (MoveKind::MoveJ, 5, 1, Some("main"))
    );
    assert_eq!((&*first.target.text, &*first.speed.text, &*first.zone.text), ("p", "v100", "z10"));
    assert_eq!(first.tool.value, Ok(ToolData::TOOL0));
    assert_eq!(first.wobj.as_ref().unwrap().value, Ok(WobjData::WOBJ0));
    let option = |after, name: &str, text: Option<&str>| MoveOption {
        after,
        name: name.into(),
        text: text.map(String::from),
    };
    assert_eq!(
        first.options,
        [
            option(0, "Conc", None),
            option(1, "ID", Some("10")),
            option(2, "V", Some("500")),
            option(3, "Z", Some("5")),
            option(3, "Inpos", Some("inpos20")),
            option(4, "Corr", None),
            option(4, "TLoad", Some("load0")),
        ]
    );
    let written = "MoveJ \\Conc, p\\ID:=10,v100\\V:=500,z10\\Z:=5\\Inpos:=inpos20,\
        tool0\\WObj:=w\\Corr\\TLoad:=load0;";
    assert_eq!(first.to_string(), written);
    let Ok(Target::RobTarget(target)) = &second.target.value else { panic!() };
    assert_eq!((target.trans_mm, second.wobj.is_none()), ([1.0, 2.0, 53.0], true));
    assert_eq!((&*circle.via.as_ref().unwrap().text, &*circle.target.text), ("p", "pts{1}"));
    assert!(circle.via.as_ref().unwrap().value.is_ok());
    let Ok(Target::JointTarget(target)) = &joints.target.value else { panic!() };
    assert_eq!(target.robax_deg[4], 30.0);
    assert_eq!(&*inline.target.text, "[[1,2,3,4,5,6], [9E9,9E9,9E9,9E9,9E9,9E9]]");
    again(&module, &[]);
}

#[test]
fn a_comma_may_precede_an_optional_argument() {
    let module = module(
        "MoveAbsJ j, v100, \\T:=5, fine, tool0; MoveL p, v1, fine, tool0, \\WObj:=w; MoveL p, \
         \\ID:=10, v1, fine, tool0, \\WObj:=w, \\Corr;
         MoveJ \\Conc, \\NoX, p, v1, fine, tool0;",
    );
    let written = module.moves().iter().map(ToString::to_string).collect::<Vec<_>>();
    let expected = [
        "MoveAbsJ j,v100\\T:=5,fine,tool0;",
        "MoveL p,v1,fine,tool0\\WObj:=w;",
        "MoveL p\\ID:=10,v1,fine,tool0\\WObj:=w\\Corr;",
        "MoveJ \\Conc\\NoX, p,v1,fine,tool0;",
    ];
    assert_eq!(written, expected);
    again(&module, &[]);
    assert_eq!(fault("MoveL p,v1,z1,tool0,;"), "line 1, column 21: expected a value, found ;");
}

#[test]
fn required_arguments_may_be_named() {
    let module = module(
        "MoveL ToPoint:=p, Speed := v100, Zone:=z1, Tool:=tool0 \\WObj:=w;
         MoveC CirPoint:=p, ToPoint:=RelTool(Point:=p,Dx:=1,Dy:=0,Dz:=0\\Rz:=0), Speed:=v1, \
             Zone:=fine, Tool:=tool0;
         MoveAbsJ ToJointPos:=j\\NoEOffs, Speed:=v1, Zone:=fine, Tool:=tool0;
         MoveL Offs(Point:=p, XOffset:=0, YOffset:=0, ZOffset:=5), v1, fine, tool0;",
    );
    assert!(module.moves().iter().all(|step| step.target.value.is_ok() && step.tool.value.is_ok()));
    assert_eq!(module.moves()[0].to_string(), "MoveL p,v100,z1,tool0\\WObj:=w;");
    assert_eq!(&*module.moves()[1].via.as_ref().unwrap().text, "p");
    let Ok(Target::RobTarget(shifted)) = module.moves()[3].target.value else { panic!() };
    assert_eq!(shifted.trans_mm, [1.0, 2.0, 8.0]);
    again(&module, &[]);
}

#[test]
fn moves_in_branches_and_loops_are_listed_in_order() {
    let module = module(
        "VAR num i:=1;
         IF a=1 OR NOT b MoveL p, v1, fine, tool0;
         IF a THEN MoveJ p, v2, fine, tool0; ELSE MoveJ p, v3, fine, tool0; ENDIF
         FOR i FROM 1 TO 1 DO MoveL pts{i}, v4, fine, tool0; ENDFOR
         MoveL Offs(p,i,0,0), v5, fine, tool0;
         ERROR MoveL p, v6, fine, tool0;",
    );
    let speeds: Vec<_> = module.moves().iter().map(|step| &*step.speed.text).collect();
    assert_eq!(speeds, ["v1", "v2", "v3", "v4", "v5", "v6"]);
    assert_eq!(words(&module.moves()[3].target.value), "refers to i, the variable of a loop");
    assert!(module.moves()[4].target.value.is_ok());
    again(&module, &[]);
}

#[test]
fn moves_that_cannot_be_resolved_report_the_reason() {
    let module = read(
        "MODULE M VAR robtarget q; PROC go(robtarget r, \\num T)
         MoveL *, v100, z10, tGripper\\WObj:=wTable;
         MoveL r, v100\\T?T, z10, tool0; MoveL q, v100, z10, tool0\\WObj ?w; ArcRepL 5, q, v1; \
             ENDPROC ENDMODULE",
    );
    let [taught, parameter, empty] = module.moves() else { panic!() };
    assert_eq!(
        words(&taught.target.value),
        "* is taught on the controller, its value is not in the text"
    );
    assert_eq!(words(&taught.tool.value), "refers to tGripper, which is not in this module");
    assert_eq!(
        words(&taught.wobj.as_ref().unwrap().value),
        "refers to wTable, which is not in this module"
    );
    assert_eq!(words(&parameter.target.value), "refers to r, a parameter of go");
    assert_eq!(parameter.to_string(), "MoveL r,v100\\T?T,z10,tool0;");
    assert_eq!(words(&empty.target.value), "refers to q, whose declaration has no value");
    assert_eq!(
        words(&empty.wobj.as_ref().unwrap().value),
        "it depends on whether an optional argument is there"
    );
    assert_eq!(not_read(&module), ["ArcRepL moves the robot, but is not read"]);
    again(&module, &[]);
}

#[test]
fn moves_without_a_module_are_read() {
    let module = read("MoveL [[1,2,3],[1,0,0,0],[0,0,0,0],[0,0,0,0,0,0]], v100, z10, tool0;");
    assert_eq!(module.moves()[0].routine, None);
    assert!(module.moves()[0].target.value.is_ok());
    again(&module, &[]);
}

#[test]
fn moves_with_a_process_are_read() {
    let steps = [
        r"MoveLDO p,v100,z10,tool0\WObj:=w,do1,1;",
        r"movejao \Conc, p,v100,z10,tool0,ao1,2.5;",
        r"TriggL p,v100,trigg\T2:=trigg,z10,tool0\WObj:=w;",
        r"SearchL \Stop, di1\PosFlank,found,p,v100,tool0\WObj:=w;",
        r"SearchC di1,found,p,p,v100,tool0;",
        r"ArcLStart p,v100,sm,wd\Weave:=wv,fine,tool0\WObj:=w;",
        r"ArcC p,p,v100,sm,wd,z1,tool0;",
        r"SpotL p,vmax,gun1,spot1,tool0;",
        r"SpotL p,vmax,gun1,spot1,z1,tool0;",
        r"EGMMoveL egm,p,v10,fine,tool0\WObj:=w;",
        r"FCPress1LStart p,v50\Fz:=20,15,z5,tool0\WObj:=w;",
        r"MoveExtJ j,v100,fine;",
        r"TriggLIOs p,v100\TriggData1:=ios,z50,tool0;",
    ];
    let data = "VAR triggdata trigg; PERS seamdata sm:=[1]; VAR robtarget found;";
    let module = module(&format!("{data} {}", steps.concat()));
    assert_eq!(
        not_read(&module),
        ["trigg: type triggdata is not read", "sm: type seamdata is not read"]
    );
    let written = module.moves().iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(written, steps);
    let kinds: Vec<_> = module.moves().iter().map(|it| it.kind.name()).collect();
    assert_eq!(kinds.join(" ").replace("Move", ""), "L J L L C L C L L L L ExtJ L");
    for step in module.moves() {
        assert_eq!(words(&step.target.value) + &words(&step.tool.value), "", "{step}");
        assert_eq!(words(&step.speed.value) + &words(&step.zone.value), "", "{step}");
    }
    let finish = |index: usize| module.moves()[index].zone.value.as_ref().unwrap().finep;
    assert!([3, 4, 7].into_iter().all(finish) && ![0, 8].into_iter().any(finish));
    let search = &module.moves()[3];
    let extra: Vec<_> = search.extra.iter().map(|it| (it.place, it.text.as_str())).collect();
    assert_eq!((&*search.instruction, extra), ("SearchL", [(0, "di1"), (1, "found")].into()));
    again(&module, &[]);
}

#[test]
fn routines_with_the_name_of_an_instruction_are_called() {
    let own = "MODULE M PROC main() ArcL p,v1,z1; ArcRepL 1; SearchL 1; ENDPROC
         PROC arcl(robtarget a,speeddata b,zonedata c) ENDPROC PROC ArcRepL(num n) ENDPROC ENDMODULE";
    let expected = [
        "ArcL is not an instruction that is read",
        "ArcRepL is not an instruction that is read",
        "SearchL moves the robot, but is not read",
    ];
    assert_eq!(not_read(&again(&read(own), &[])), expected);
    let other =
        read("MODULE N PROC SpotL(num a) ENDPROC LOCAL PROC SpotJ(num a) ENDPROC ENDMODULE");
    let module = parse("SpotL 1; SpotJ 1;", &[&other]).unwrap();
    assert_eq!(
        not_read(&module),
        ["SpotL is not an instruction that is read", "SpotJ moves the robot, but is not read"]
    );
    let labels = read("PROC a() ArcL: PaintL:=1; DispL{2}:=1; ENDPROC");
    assert_eq!(labels.skipped().len(), 3);
}

#[test]
fn what_is_written_the_same_is_shared() {
    let module = module(
        "MoveL p,v100,z10,tool0\\WObj:=w; MoveL p,v100,z10,tool0\\WObj:=w;
         MoveL p,v100\\V:=5,z10\\Z:=3,tool0;",
    );
    let [first, second, other] = module.moves() else { panic!() };
    assert!(Arc::ptr_eq(&first.speed, &second.speed) && Arc::ptr_eq(&first.zone, &second.zone));
    assert!(Arc::ptr_eq(&first.tool, &second.tool) && Arc::ptr_eq(&first.tool, &other.tool));
    assert!(Arc::ptr_eq(first.wobj.as_ref().unwrap(), second.wobj.as_ref().unwrap()));
    assert_eq!(&*other.speed.text, "v100");
    assert_eq!(other.speed.value.as_ref().unwrap().v_tcp_mm_s, 5.0);
    assert_eq!(other.zone.value.as_ref().unwrap().pzone_tcp_mm, 3.0);
    assert_eq!(first.speed.value.as_ref().unwrap().v_tcp_mm_s, 100.0);
}
