//! Values without names and operators are read directly; as expressions they are the same.

use std::format;
use std::string::String;
use std::vec::Vec;

use super::*;
use crate::Error;
use crate::rapid::text::fault::RapidFaultKind;

/// The types with the shapes of their values: `n` a number, `w` a whole one, `b` a truth value, `s`
/// a string.
const SHAPES: [(&str, &str); 12] = [
    ("robtarget", "[[n,n,n],[n,n,n,n],[w,w,w,w],[n,n,n,n,n,n]]"),
    ("jointtarget", "[[n,n,n,n,n,n],[n,n,n,n,n,n]]"),
    ("tooldata", "[b,[[n,n,n],[n,n,n,n]],[n,[n,n,n],[n,n,n,n],n,n,n]]"),
    ("wobjdata", "[b,b,s,[[n,n,n],[n,n,n,n]],[[n,n,n],[n,n,n,n]]]"),
    ("pose", "[[n,n,n],[n,n,n,n]]"),
    ("pos", "[n,n,n]"),
    ("orient", "[n,n,n,n]"),
    ("confdata", "[w,w,w,w]"),
    ("extjoint", "[n,n,n,n,n,n]"),
    ("loaddata", "[n,[n,n,n],[n,n,n,n],n,n,n]"),
    ("num", "n"),
    ("dnum", "n"),
];

/// Valid and invalid texts in the place of a component.
const LITERALS: [&str; 58] = [
    "0",
    "-0",
    "+0",
    "7",
    "-7",
    " 7 ",
    "- 7",
    "--7",
    "9E9",
    "9E+09",
    "1e-3",
    "1E-05",
    ".5",
    "-.5",
    "5.",
    "5.E1",
    "0x1F",
    "0b101",
    "0o17",
    "1.5.2",
    "12abc",
    "1E",
    "1E+",
    "1e400",
    "1e5.",
    "1_",
    "1\u{e9}",
    "\u{a0}6",
    "123456789012345",
    "1234567890123456",
    "0.1234567890123456789",
    "1e22",
    "1e23",
    "9007199254740993",
    "2147483647",
    "2147483648",
    "-2147483648",
    "0.5",
    "TRUE",
    "false",
    "TRUEX",
    "\"\"",
    "\"STN1\"",
    "\"a\"\"b\\41\"",
    "\"a",
    "x",
    "tool0",
    "-x",
    "1+1",
    "(1)",
    "! c\n5",
    "<EXP>",
    "*",
    "[1]",
    "1,2",
    "",
    ".",
    "\0",
];

/// The error for a text, or the content of its only datum and why it is not read.
fn outcome(text: &str) -> Result<(Vec<Value>, Vec<String>), RapidFaultKind> {
    let module = match parse(text, &[]) {
        Ok(module) => module,
        Err(Error::Rapid(fault)) => return Err(fault.kind),
        Err(other) => panic!("{other}"),
    };
    let values = match module.data().first().map(|datum| &datum.content) {
        Some(Content::Single(value)) => Vec::from([value.clone()]),
        Some(Content::Array { values, .. }) => values.clone(),
        _ => Vec::new(),
    };
    Ok((values, module.skipped().iter().map(|skipped| skipped.what()).collect()))
}

#[test]
fn direct_reading_and_expressions_give_the_same_values() {
    let (mut read, mut skipped, mut broken) = (0, 0, 0);
    for (type_name, shape) in SHAPES {
        let places: Vec<_> = shape.match_indices(['n', 'w', 'b', 's']).collect();
        for (literal, (place, _)) in
            LITERALS.iter().flat_map(|it| places.iter().map(move |at| (it, at)))
        {
            // By themselves these are not values; between brackets they are two and none.
            if shape == "n" && ["1,2", ""].contains(literal) {
                continue;
            }
            let usual = |part: &str| {
                part.replace('n', "1.25")
                    .replace('w', "-1")
                    .replace('b', "TRUE")
                    .replace('s', "\"\"")
            };
            let value = usual(&shape[..*place]) + literal + &usual(&shape[place + 1..]);
            let alone = outcome(&format!("CONST {type_name} p:={value};"));
            // An element of an array is read as an expression.
            let element = outcome(&format!("CONST {type_name} p{{1}}:=[{value}];"));
            assert_eq!(format!("{alone:?}"), format!("{element:?}"), "{type_name} {value}");
            match alone {
                Ok((values, _)) if values.is_empty() => skipped += 1,
                Ok(_) => read += 1,
                Err(_) => broken += 1,
            }
        }
    }
    assert!(read > 1000 && skipped > 500 && broken > 1000, "{read} {skipped} {broken}");
}

#[test]
fn blanks_and_comments_are_anywhere_in_a_value() {
    let value = "[[1,2,3],[1,0,0,0],[0,-1,0,1],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let expected = single(&read(&format!("CONST robtarget p:={value};")), "p");
    for blank in [" ", "\t\r\n", "\u{a0}", "! note ] ; \"\n", "\u{b}\u{c}"] {
        let text: String = value
            .chars()
            .map(|character| match character {
                '[' | ']' | ',' => format!("{blank}{character}{blank}"),
                other => other.into(),
            })
            .collect();
        let module = read(&format!("CONST robtarget p:={text};"));
        assert_eq!(single(&module, "p"), expected, "{text:?}");
    }
}

#[test]
fn targets_of_moves_are_read_as_their_expressions() {
    let (mut read, mut broken) = (0, 0);
    for (name, (_, shape)) in ["MoveL", "MoveAbsJ"].into_iter().zip(SHAPES) {
        let usual = |part: &str| part.replace('n', "1.25").replace('w', "-1");
        for (place, _) in shape.match_indices(['n', 'w']) {
            for literal in LITERALS {
                let value = usual(&shape[..place]) + literal + &usual(&shape[place + 1..]);
                let target = |text: &str| match parse(&format!("{name} {text},v5,fine,tool0;"), &[])
                {
                    Ok(module) => Ok(module.moves().first().map(|it| it.target.value.clone())),
                    Err(Error::Rapid(fault)) => Err(fault.kind),
                    Err(other) => panic!("{other}"),
                };
                // In parentheses it is read as an expression.
                let (direct, expression) = (target(&value), target(&format!("({value})")));
                assert_eq!(format!("{direct:?}"), format!("{expression:?}"), "{name} {value}");
                *(if direct.is_ok() { &mut read } else { &mut broken }) += 1;
            }
        }
    }
    assert!(read > 500 && broken > 500, "{read} {broken}");
}
