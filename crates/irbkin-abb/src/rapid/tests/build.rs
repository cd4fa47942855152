//! Modules from data that were not read from a text.

use std::string::String;
use std::string::ToString;
use std::vec;
use std::vec::Vec;

use super::*;
use crate::rapid::{Datum, Storage, ToolData};

fn datum(name: &str, value: Value) -> Datum {
    Datum::single(String::from(name), Storage::Const, value)
}

#[test]
fn modules_are_made_of_data_and_moves() {
    let text = "CONST robtarget p:=[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC \
        main()\nMoveL p,v1,fine,t;\nENDPROC";
    let read = read(text);
    let mut data = read.data().to_vec();
    data.push(datum("t", Value::ToolData(ToolData::TOOL0)));
    let made = Module::new(Some("M".into()), data, read.moves().to_vec(), &[]).unwrap();
    assert_eq!(made.moves()[0].tool.value, Ok(ToolData::TOOL0));
    assert_eq!(made.moves()[0].target.value, read.moves()[0].target.value);
    assert!(made.to_string().starts_with("MODULE M\n    CONST robtarget p:=[[1,2,3],"));
    assert!(
        made.to_string()
            .ends_with("    PROC main()\n        MoveL p,v1,fine,t;\n    ENDPROC\nENDMODULE\n")
    );
    again(&made, &[]);
}

#[test]
fn modules_that_cannot_be_read_back_are_refused() {
    let words = |name: &str, data: Vec<Datum>| {
        Module::new(Some(name.into()), data, vec![], &[]).unwrap_err().to_string()
    };
    let one = || datum("a", Value::Num(1.0));
    assert_eq!(
        words("if", vec![]),
        "\"if\" is not a RAPID identifier (a letter, then letters, digits, _)"
    );
    assert_eq!(
        words("M", vec![datum("a b", Value::Num(1.0))]),
        "\"a b\" is not a RAPID identifier (a letter, then letters, digits, _)"
    );
    assert_eq!(
        words("M", vec![one(), one()]),
        "line 3, column 5: a is declared twice in the module"
    );
    let infinite = datum("a", Value::Pos([0.0, f64::INFINITY, 0.0]));
    assert_eq!(words("M", vec![infinite]), "pos a [0,inf,0] is not finite, every number must be");
    let short = Datum {
        content: Content::Array { sizes: vec![2], values: vec![Value::Num(1.0)] },
        ..one()
    };
    assert_eq!(words("M", vec![short]), "num a: dimension 1 has 1 element, it must have 2");
    let mixed = Datum { content: Content::Single(Value::Pos([0.0; 3])), ..one() };
    assert_eq!(words("M", vec![mixed]), "num a is pos, it must be num");
}
