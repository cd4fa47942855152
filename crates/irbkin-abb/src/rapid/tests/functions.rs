//! RAPID's functions and operators, by the laws that they have to keep.

use std::format;
use std::string::ToString;
use std::vec::Vec;

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

const POSES: &str = "CONST pose a:=[[10,-20,30],[0.5,0.5,-0.5,0.5]];
    CONST pose b:=[[1,2,3],[0.8,0,0.6,0]]; CONST pose c:=[[-7,5,0],[0,0.6,0,0.8]]; CONST pos v:=[4,5,6];";

/// The numbers of a value, of any type.
fn numbers(data_type: &str, value: &str) -> Vec<f64> {
    let text = format!("{POSES} CONST {data_type} r:={value};");
    match single(&read(&text), "r") {
        Value::Num(number) => std::vec![number],
        Value::Pos(vector) => vector.into(),
        Value::Orient(rot) => rot.into(),
        Value::Pose(pose) => [&pose.trans_mm[..], &pose.rot].concat(),
        Value::RobTarget(target) => [&target.trans_mm[..], &target.rot].concat(),
        other => panic!("{other}"),
    }
}

/// Whether expressions have the same value, to rounding; rotations up to the sign.
fn same(data_type: &str, one: &str, other: &str) {
    let (a, b) = (numbers(data_type, one), numbers(data_type, other));
    let of_rot = if a.len() >= 4 { a.len() - 4 } else { a.len() };
    let dot: f64 = a[of_rot..].iter().zip(&b[of_rot..]).map(|(a, b)| a * b).sum();
    let sign = if dot < 0.0 { -1.0 } else { 1.0 };
    for (place, (a, b)) in a.iter().zip(&b).enumerate() {
        let b = if place >= of_rot { b * sign } else { *b };
        assert!((a - b).abs() <= 1e-12 * a.abs().max(100.0), "{one} and {other}: {a} and {b}");
    }
}

#[test]
fn poses_are_a_group() {
    same("pose", "PoseMult(PoseMult(a,b),c)", "PoseMult(a,PoseMult(b,c))");
    same("pose", "PoseMult(a,PoseInv(a))", "[[0,0,0],[1,0,0,0]]");
    same("pose", "PoseInv(PoseMult(a,b))", "PoseMult(PoseInv(b),PoseInv(a))");
    same("pos", "PoseVect(a,PoseVect(b,v))", "PoseVect(PoseMult(a,b),v)");
    same("pos", "PoseVect(a,[0,0,0])", "a.trans");
    same("pos", "PoseMult(a,b).trans", "PoseVect(a,b.trans)");
    same("orient", "PoseMult(a,b).rot", "a.rot*b.rot");
    // A quarter turn about z maps x to y.
    same("pos", "PoseVect([[1,0,0],OrientZYX(90,0,0)],[5,0,0])", "[1,5,0]");
}

#[test]
fn euler_angles_are_about_z_then_y_then_x() {
    for (z, y, x) in [(10.0, 20.0, 30.0), (-170.0, -80.0, 100.0), (0.0, 0.0, 180.0)] {
        let rot = format!("OrientZYX({z},{y},{x})");
        for (switch, angle) in [("\\Z", z), ("\\Y", y), ("\\X", x)] {
            same("num", &format!("EulerZYX({switch},{rot})"), &angle.to_string());
        }
        same("orient", &rot, &format!("OrientZYX({z},0,0)*OrientZYX(0,{y},0)*OrientZYX(0,0,{x})"));
    }
    // In gimbal lock the angle about z is 0.
    same("num", "EulerZYX(\\Z,OrientZYX(30,90,10))", "0");
    same("num", "EulerZYX(\\X,OrientZYX(30,90,10))", "-20");
    same("orient", "NOrient([3,0,4,0])", "[0.6,0,0.8,0]");
}

#[test]
fn vectors_keep_their_laws() {
    same("pos", "v+[1,1,1]*2-(-v)", "2*[5,6,7]");
    same("pos", "v*[1,2,3]", "CrossProd(v,[1,2,3])");
    same("num", "DotProd(v*[1,2,3],v)", "0");
    same("num", "VectMagn(v)", "Sqrt(DotProd(v,v))");
    same("num", "Distance(v,a.trans)", "VectMagn(v-a.trans)");
    same("num", "Pow(DotProd(v,[1,2,3]),2)+Pow(VectMagn(v*[1,2,3]),2)", "DotProd(v,v)*14");
    same("pos", "[0,0,0]", "-[0,0,0]");
}

#[test]
fn numbers_keep_their_laws() {
    same("num", "14 DIV 4", "3");
    same("num", "14 MOD 4", "2");
    same("num", "7 DIV 2*2+7 MOD 2", "7");
    for (one, other) in [
        ("Sin(30)", "0.5"),
        ("Cos(90)", "0"),
        ("Tan(45)", "1"),
        ("ASin(0.5)", "30"),
        ("ACos(-1)", "180"),
        ("ATan(-1)", "-45"),
        ("ATan2(1,-1)", "135"),
        ("Abs(-2)", "2"),
        ("Round(-2.5)", "-3"),
        ("Round(1.2345\\Dec:=3)", "1.235"),
        ("Trunc(-1.29\\Dec:=1)", "-1.2"),
        ("Max(1,2)+Min(1,2)", "3"),
        ("Exp(0)", "1"),
        ("2*pi", "6.283185307179586"),
        ("AbsDnum(-1)", "DnumToNum(1\\Integer)"),
    ] {
        same("num", one, other);
    }
}

#[test]
fn frames_of_points_and_mirrors_are_by_the_manual() {
    let target = |trans: &str| format!("[{trans},[1,0,0,0],{ZEROS}]");
    let points = [target("[1,1,0]"), target("[5,1,0]"), target("[3,4,0]")].join(",");
    same("pose", &format!("DefFrame({points})"), "[[1,1,0],[1,0,0,0]]");
    same("pose", &format!("DefFrame({points}\\Origin:=2)"), "[[5,1,0],[1,0,0,0]]");
    same("pose", &format!("DefFrame({points}\\Origin:=3)"), "[[3,1,0],[1,0,0,0]]");
    let upright = [target("[0,0,0]"), target("[0,2,0]"), target("[0,0,3]")].join(",");
    same("pos", &format!("PoseVect(DefFrame({upright}),[1,2,3])"), "[3,1,2]");
    let robtarget = |trans: &str, rot: &str| format!("[{trans},{rot},{ZEROS}]");
    let (p, wobj) = (robtarget("[1,2,3]", "[1,0,0,0]"), |frame: &str| {
        format!("[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],{frame}]")
    });
    // The plane of x and y: z and with it the z axis turn round, x stays.
    let plane = wobj("[[0,0,1],[1,0,0,0]]");
    same("robtarget", &format!("MirPos({p},{plane})"), &robtarget("[1,2,-1]", "[0,1,0,0]"));
    same("robtarget", &format!("MirPos({p},{plane}\\MirY)"), &robtarget("[1,2,-1]", "[0,0,1,0]"));
    let tilted = wobj("[[1,2,3],[0.8,0,0.6,0]]");
    let other = wobj("[[5,0,0],[0,0.6,0,0.8]]");
    let once = format!("MirPos({p},{tilted}\\WObj:={other})");
    same("robtarget", &format!("MirPos({once},{tilted}\\WObj:={other})"), &p);
}

#[test]
fn operators_and_functions_of_other_types_are_refused() {
    let fault = |text: &str| super::fault(&format!("{POSES} CONST {text};"));
    let why = |text: &str| not_read(&read(&format!("{POSES} CONST {text};")))[0].clone();
    assert_eq!(why("pos r:=v*a.rot"), "r: arithmetic of orient is not evaluated");
    assert_eq!(why("orient r:=a.rot+a.rot"), "r: arithmetic of orient is not evaluated");
    assert_eq!(why("pose r:=a*b"), "r: arithmetic of pose is not evaluated");
    assert_eq!(why("pos r:=v/2"), "r: arithmetic of pos is not evaluated");
    assert_eq!(why("num r:=-7 MOD 2"), "r: this operator is not evaluated");
    assert_eq!(why("robtarget r:=CRobT()"), "r: CRobT is not evaluated");
    assert_eq!(why("pos r:=CRobT().trans"), "r: CRobT is not evaluated");
    assert!(fault("num r:=1.5 DIV 2").ends_with("num r is 1.5, it must be a whole number"));
    assert!(fault("num r:=Sqrt(-1)").ends_with("Sqrt(-1) is not finite, every number must be"));
    assert!(fault("num r:=EulerZYX(a.rot)").ends_with("is not finite, every number must be"));
    assert_eq!(why("pos r:=v+1"), "r: arithmetic of pos is not evaluated");
    assert!(fault("pose r:=PoseMult(a)").ends_with("PoseMult has 1 argument, it must have 2"));
    assert!(fault("pose r:=PoseMult(a,v)").ends_with("v, of type pos, it must be pose"));
    assert!(fault("num r:=PoseMult(a,b).trans").ends_with("of type pos, it must be a number"));
    assert_eq!(numbers("num", "PoseMult(a,b).trans.z - PoseVect(a,b.trans).z"), [0.0]);
}
