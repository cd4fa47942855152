//! Texts: headers, comments, numbers, strings, modules and bare declarations.

use std::borrow::Cow;
use std::format;
use std::string::ToString;
use std::vec;
use std::vec::Vec;

use super::*;
use crate::rapid::{
    DataType, NewValue, RapidPose, RobTarget, Scope, Storage, ToolData, WobjData, decode, rewrite,
};

const TARGET: &str = "[[600.5,-0,8E2],[0.5,0.5,-0.5,0.5],[-1,0,1,4],[9E9,9E+09,0,9E9,9E9,9E9]]";

#[test]
fn a_target_is_read_as_it_is_written() {
    let module = read(&format!("CONST robtarget p10:={TARGET};"));
    let Value::RobTarget(RobTarget { trans_mm, rot, robconf, extax }) = single(&module, "P10")
    else {
        panic!()
    };
    assert_eq!((trans_mm, rot), ([600.5, 0.0, 800.0], [0.5, 0.5, -0.5, 0.5]));
    assert!(trans_mm[1].is_sign_positive());
    assert_eq!(robconf.to_string(), "[-1, 0, 1, 4]");
    assert_eq!(extax, [9e9, 9e9, 0.0, 9e9, 9e9, 9e9]);
    assert_eq!(module.name(), None);
    again(&module, &[]);
}

#[test]
fn headers_cases_and_comments_do_not_matter() {
    let text = "\u{feff}%%%\n  VERSION:1\n  LANGUAGE:ENGLISH\n%%%\n\nmodule Main(sysmodule, \
        NoStepIn) ! a remark with \"\n\
                local CONST NUM a:=1;!\n pErS Dnum b := 2 ; task var num C;\r\nEndModule";
    let module = read(text);
    assert_eq!(module.name(), Some("Main"));
    assert_eq!(module.attributes(), ["sysmodule", "NoStepIn"]);
    let kept: Vec<_> = module
        .data()
        .iter()
        .map(|d| (d.name.as_str(), d.scope, d.storage, d.line, d.column))
        .collect();
    assert_eq!(
        kept,
        [
            ("a", Scope::Local, Storage::Const, 7, 1),
            ("b", Scope::Global, Storage::Pers, 8, 2),
            ("C", Scope::Task, Storage::Var, 8, 21)
        ]
    );
    assert_eq!(module.find("c").unwrap().content, Content::Uninitialized { sizes: vec![] });
    assert_eq!(module.find("c").unwrap().data_type, DataType::Num);
    again(&module, &[]);
}

#[test]
fn numbers_are_those_of_rapid() {
    let written = [
        "-1.5E+09", "9E9", ".5", "5.", "1e10", "+3", "5.E-1", "0x1F", "0b101", "0o17", "--2",
        "-(-4)",
    ];
    let meant = [-1.5e9, 9e9, 0.5, 5.0, 1e10, 3.0, 0.5, 31.0, 5.0, 15.0, 2.0, 4.0];
    for (written, meant) in written.into_iter().zip(meant) {
        assert_eq!(number(&read(&format!("VAR num a:={written};")), "a"), meant, "{written}");
    }
}

#[test]
fn numbers_are_written_as_rapid_reads_them() {
    let written = |number: f64| Value::Num(number).to_string();
    let numbers = [
        9e9,
        -1.5e9,
        1e7,
        9_999_999.5,
        0.0001,
        0.000_099,
        -1e-12,
        0.1 + 0.2,
        -0.0,
        1e-300,
        f64::MAX,
    ];
    let texts = [
        "9E+09",
        "-1.5E+09",
        "1E+07",
        "9999999.5",
        "0.0001",
        "9.9E-05",
        "-1E-12",
        "0.30000000000000004",
        "0",
        "1E-300",
    ];
    for (number, text) in numbers.into_iter().zip(texts) {
        assert_eq!(written(number), text);
    }
    for number in numbers {
        assert_eq!(super::number(&read(&format!("VAR num a:={};", written(number))), "a"), number);
    }
}

#[test]
fn records_are_written_without_blanks() {
    assert_eq!(
        ToolData::TOOL0.to_string(),
        "[TRUE,[[0,0,0],[1,0,0,0]],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]]"
    );
    assert_eq!(
        WobjData::WOBJ0.to_string(),
        "[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]]"
    );
    assert_eq!(RapidPose::IDENTITY.to_string(), "[[0,0,0],[1,0,0,0]]");
    let module = read(&format!("CONST robtarget p10:={TARGET};"));
    let written = "[[600.5,0,800],[0.5,0.5,-0.5,0.5],[-1,0,1,4],[9E+09,9E+09,0,9E+09,9E+09,9E+09]]";
    assert_eq!(single(&module, "p10").to_string(), written);
}

#[test]
fn strings_keep_quotes_backslashes_and_codes() {
    let frames = "[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]";
    let text = format!(r#"PERS wobjdata w:=[FALSE,FALSE,"a""b\\c\07d; [é",{frames}];"#);
    let module = read(&text);
    let Value::WobjData(wobj) = single(&module, "w") else { panic!() };
    assert_eq!(wobj.ufmec, "a\"b\\c\u{7}d; [é");
    again(&module, &[]);
}

#[test]
fn bytes_are_utf_8_or_latin_1() {
    assert_eq!(decode(b"\xef\xbb\xbfa"), "a");
    assert!(matches!(decode("é".as_bytes()), Cow::Borrowed("é")));
    assert_eq!(decode(b"\xe9"), "é");
    assert_eq!(decode(b"\xff\xfea\x00\xe9\x00\x3d\xd8\x00\xde"), "aé😀");
    assert_eq!(decode(b"\xfe\xff\x00a\x00\xe9"), "aé");
    assert_eq!(decode(b"\xff\xfea\x00\x00\xd8b"), "a\u{fffd}\u{fffd}");
}

#[test]
fn trailing_end_of_file_characters_are_ignored() {
    for end in ["\0", "\u{1a}", "\r\n\u{1a}\n\0\0 \u{1a}"] {
        let text = format!("MODULE M\nVAR num a:=1;\nENDMODULE{end}");
        let module = read(&text);
        assert_eq!(rewrite(&text, &module, &[]).unwrap(), text);
        again(&module, &[]);
        read(&format!("VAR num a; ! note{end}"));
    }
    assert_eq!(
        fault("VAR num\u{1a} a;"),
        "line 1, column 8: '\\u{1a}' has no place outside a string or a comment"
    );
    assert_eq!(
        fault("VAR num a\0"),
        "line 1, column 11: expected a semicolon, found the end of the text"
    );
}

#[test]
fn names_of_types_do_not_hide_names_of_data() {
    let module = read(
        "ALIAS num length; LOCAL ALIAS num width; TASK ALIAS num depth; VAR num length:=1; CONST \
         num a:=length;",
    );
    assert_eq!(
        not_read(&module),
        ["ALIAS length is not read", "ALIAS width is not read", "ALIAS depth is not read"]
    );
    assert_eq!(number(&module, "a"), 1.0);
    again(&module, &[]);
}

#[test]
fn arrays_keep_their_shape_and_the_places_of_their_elements() {
    let text = "CONST pos pts{2,3}:=[[[1,2,3],[4,5,6],[7,8,9]],\n [[1,0,0],[2,0,0],[3,0,0]]]; VAR \
        num free{4,5};";
    let module = read(text);
    let datum = module.find("pts").unwrap();
    let Content::Array { sizes, values } = &datum.content else { panic!() };
    assert_eq!((sizes.as_slice(), values.len()), ([2, 3].as_slice(), 6));
    assert_eq!(values[4], Value::Pos([2.0, 0.0, 0.0]));
    assert_eq!(&text[datum.element_spans[4].clone()], "[2,0,0]");
    assert_eq!(module.find("free").unwrap().content, Content::Uninitialized { sizes: vec![4, 5] });
    assert_eq!(
        module.data()[0].to_string(),
        "CONST pos pts{2,3}:=[[[1,2,3],[4,5,6],[7,8,9]],[[1,0,0],[2,0,0],[3,0,0]]];"
    );
    again(&module, &[]);
}

#[test]
fn rewriting_values_changes_nothing_else() {
    let text = "MODULE M ! é\n PERS num a := 1 ; ! one\n VAR pos b{2}:=[ [1,2,3], [4,5,6] ];\n \
        VAR num c ; ENDMODULE\n";
    let module = read(text);
    let new = |datum, element, value| NewValue { datum, element, value };
    let values = [
        new(2, None, Value::Num(3.0)),
        new(1, Some(1), Value::Pos([0.0, 1e9, 0.0])),
        new(0, None, Value::Num(-2.5)),
    ];
    let expected = "MODULE M ! é\n PERS num a := -2.5 ; ! one\n VAR pos b{2}:=[ [1,2,3], [0,1E+09,\
        0] ];\n VAR num c := 3 ; ENDMODULE\n";
    assert_eq!(rewrite(text, &module, &values).unwrap(), expected);
    assert_eq!(rewrite(text, &module, &[]).unwrap(), text);
    let words = |values: &[NewValue]| rewrite(text, &module, values).unwrap_err().to_string();
    assert_eq!(words(&[new(3, None, Value::Num(1.0))]), "there is no datum 3, the module has 3");
    assert_eq!(
        words(&[new(0, None, Value::Pos([0.0; 3]))]),
        "line 2, column 2: num a is pos, it must be num"
    );
    assert_eq!(
        words(&[new(0, None, Value::Num(f64::NAN))]),
        "line 2, column 2: NaN is not finite, every number must be"
    );
    assert_eq!(
        words(&[new(1, Some(2), Value::Pos([0.0; 3]))]),
        "line 3, column 2: there is no element 2 of pos b"
    );
    assert_eq!(
        words(&[new(1, None, Value::Pos([0.0; 3]))]),
        "line 3, column 2: there is no single value in the array pos b"
    );
    let twice = [new(2, None, Value::Num(3.0)), new(2, None, Value::Num(4.0))];
    assert_eq!(words(&twice), "num c is given two values, it must get one");
    let shorter = rewrite("", &module, &[]).unwrap_err().to_string();
    assert_eq!(
        shorter,
        format!("this is not the text of the module: it has 0 bytes, it must have {}", text.len())
    );
}

#[test]
fn unknown_statements_are_skipped_and_listed() {
    let text = "MODULE M\n RECORD r\n  num a; pos b;\n ENDRECORD\n ALIAS num length;\n VAR bool \
        b:=(1>2) AND TRUE;\n CONST robtarget p:=CRobT(\\Tool:=t);\n\
                \x20PROC p1()\n  b:=FALSE; a{1}:=2;\n  IF b THEN\n  ELSEIF NOT b OR a=1 THEN\n  \
                ELSE\n  ENDIF\n  FOR i FROM 1 TO 3 STEP 2 DO ENDFOR\n  WHILE b DO ENDWHILE\n\
                \x20 TEST a CASE 1,2: b:=TRUE; DEFAULT: ENDTEST\n  again: GOTO again; %\"p2\"%; \
                <SMT>\n  WaitTime\\InPos, 0.5;\n ERROR (1) RETRY;\n ENDPROC\n\
                \x20FUNC bool f(num x) RETURN x>1; ENDFUNC\n TRAP t ENDTRAP\nENDMODULE";
    let module = read(text);
    let expected = [
        "RECORD r is not read",
        "ALIAS length is not read",
        "b: type bool is not read",
        "p: refers to t, a routine",
        "b is assigned a value, which is not followed",
        "a is assigned a value, which is not followed",
        "IF is not executed",
        "ELSEIF is not executed",
        "ELSE is not executed",
        "ENDIF is not executed",
        "FOR is not executed",
        "ENDFOR is not executed",
        "WHILE is not executed",
        "ENDWHILE is not executed",
        "TEST is not executed",
        "CASE is not executed",
        "b is assigned a value, which is not followed",
        "DEFAULT is not executed",
        "ENDTEST is not executed",
        "label again is not read",
        "GOTO is not an instruction that is read",
        "% is not an instruction that is read",
        "<SMT> is not finished",
        "WaitTime is not an instruction that is read",
        "ERROR is not executed",
        "RETRY is not an instruction that is read",
        "RETURN is not an instruction that is read",
    ];
    assert_eq!(not_read(&module), expected);
    let first = &module.skipped()[3];
    assert_eq!((first.line, first.column, first.routine.as_deref()), (7, 2, None));
    assert_eq!(first.text, "CONST robtarget p:=CRobT(\\Tool:=t);");
    assert_eq!(module.skipped()[4].routine.as_deref(), Some("p1"));
    let headers: Vec<_> = module.routines().iter().map(|routine| routine.header.as_str()).collect();
    assert_eq!(headers, ["PROC p1()", "FUNC bool f(num x)", "TRAP t"]);
    again(&module, &[]);
}

#[test]
fn names_and_strings_have_a_maximum_length() {
    let name = |length: usize| std::format!("VAR num {}:=1;", "a".repeat(length));
    assert_eq!(read(&name(256)).data().len(), 1);
    assert_eq!(
        fault(&name(257)),
        "line 1, column 9: a name has 257 bytes, it must have at most 256"
    );
    let text =
        |length: usize| std::format!("PROC main() TPWrite \"{}\"; ENDPROC", "a".repeat(length));
    assert_eq!(read(&text(2046)).skipped().len(), 1);
    assert_eq!(
        fault(&text(2047)),
        "line 1, column 21: a string has 2049 bytes, it must have at most 2048"
    );
}

#[test]
fn the_type_of_a_single_record_follows_from_its_shape() {
    let record = |text: &str| {
        crate::rapid::parse_record(text)
            .map(|value| value.type_name())
            .map_err(|error| error.to_string())
    };
    assert_eq!(record(" [[1,2,3],[1,0,0,0]] "), Ok("pose"));
    assert_eq!(record("[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]]"), Ok("jointtarget"));
    assert_eq!(record("[TRUE,[[0,0,1],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]]"), Ok("tooldata"));
    let none = "[1,2,3] is not a robtarget, jointtarget, tooldata, wobjdata, pose or loaddata";
    assert_eq!(record("[1,2,3]"), Err(none.to_string()));
    assert_eq!(
        record("[[1,2,3],\n[1,0,0,0]"),
        Err("line 2, column 10: expected a comma or ], found the end of the line".to_string())
    );
    for more in [
        "[[1,2,3],[1,0,0,0]]; VAR num y:=5",
        "[[1,2,3],[1,0,0,0]]; MoveL p,v,z,t",
        "[[n,2,3],[1,0,0,0]]; CONST num n:=7",
    ] {
        assert!(record(more).is_err(), "{more}");
    }
}
