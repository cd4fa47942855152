//! Offs and RelTool.

use std::format;

use super::*;
use crate::rapid::RobTarget;

const ZEROS: &str = "[0,0,0,0],[0,0,0,0,0,0]";

fn target(rot: &str, value: &str) -> RobTarget {
    let module =
        read(&format!("CONST robtarget p:=[[1,2,3],{rot},{ZEROS}]; CONST robtarget r:={value};"));
    let Value::RobTarget(target) = single(&module, "r") else { panic!() };
    target
}

fn near<const N: usize>(a: [f64; N], b: [f64; N]) -> bool {
    a.into_iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-14)
}

#[test]
fn offs_shifts_in_the_work_object() {
    let shifted = target("[0,1,0,0]", "Offs(p,10,-20,p.trans.x)");
    assert_eq!((shifted.trans_mm, shifted.rot), ([11.0, -18.0, 4.0], [0.0, 1.0, 0.0, 0.0]));
    assert_eq!(target("[0,1,0,0]", "OFFS(Offs(p,1,0,0),1,0,0)").trans_mm, [3.0, 2.0, 3.0]);
}

#[test]
fn reltool_shifts_and_turns_in_the_tool() {
    // Upside down: the tool's z points down.
    let shifted = target("[0,1,0,0]", "RelTool(p,1,2,10)");
    assert_eq!((shifted.trans_mm, shifted.rot), ([2.0, 0.0, -7.0], [0.0, 1.0, 0.0, 0.0]));
    let half = 0.5_f64.sqrt();
    assert!(near(target("[1,0,0,0]", "RelTool(p,0,0,0\\Rz:=90)").rot, [half, 0.0, 0.0, half]));
    // About x, then about the new y, which is the old z, then about the new z, which is the old x.
    let turned = target("[1,0,0,0]", "RelTool(p,0,0,0\\Rx:=90\\Ry:=90\\Rz:=90)").rot;
    assert!(near(turned, [0.0, half, 0.0, half]), "{turned:?}");
    assert_eq!(turned, target("[1,0,0,0]", "RelTool(p,0,0,0,\\Rz:=90 \\Rx:=90 \\Ry:=90)").rot);
    // A norm other than one stays, and does not lengthen the shift.
    let long = target("[2,0,0,0]", "RelTool(p,1,0,0)");
    assert_eq!((long.trans_mm, long.rot), ([2.0, 2.0, 3.0], [2.0, 0.0, 0.0, 0.0]));
}

#[test]
fn unsupported_functions_are_reported() {
    let p = format!("CONST robtarget p:=[[1,2,3],[0,0,0,0],{ZEROS}]; ");
    let fault = |rest: &str| super::fault(&format!("{p}\n{rest}"));
    let why = |rest: &str| not_read(&read(&format!("{p}{rest}")))[0].clone();
    assert_eq!(
        fault("CONST robtarget r:=Offs(p,1,2);"),
        "line 2, column 20: Offs has 3 arguments, it must have 4"
    );
    assert_eq!(
        fault("CONST pos r:=Offs(p,1,2,3);"),
        "line 2, column 14: pos r is Offs, of type robtarget, it must be pos"
    );
    let words = "line 2, column 20: RelTool(p,1,0,0) is not finite, every number must be";
    assert_eq!(fault("CONST robtarget r:=RelTool(p,1,0,0);"), words);
    assert_eq!(why("CONST robtarget r:=Offs(p,0,0,f(2));"), "r: f is not evaluated");
    assert_eq!(
        why("CONST robtarget r:=RelTool(p,0,0,0\\Rq:=1);"),
        "r: RelTool with Rq is not evaluated"
    );
    let own = "FUNC robtarget Offs(robtarget p) ENDFUNC CONST robtarget r:=Offs(p,0,0,1);";
    assert_eq!(why(own), "r: Offs is declared in this module, it is not evaluated");
}
