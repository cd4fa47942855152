//! RAPID texts that nobody would write: none makes the reader panic, and what it reads it writes
//! and reads again.
//!
//! `IRBKIN_INPUTS` is the number of inputs of each kind; `make fuzz INPUTS=1000000` reads a million.
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]

use std::time::{Duration, Instant};

use crate::common::Rng;
use irbkin_abb::rapid::{
    Content, Module, MotionOptions, Move, NewValue, Value, decode, parse, read, rewrite,
};

const CORPUS: [&[u8]; 3] = [
    include_bytes!("data/rapid/weld.mod"),
    include_bytes!("data/rapid/tools.sys"),
    include_bytes!("data/rapid/pendant.prg"),
];

/// Pieces of RAPID, and of other text.
const PIECES: &[&str] = &[
    "MODULE M",
    "ENDMODULE",
    "PROC p()",
    "ENDPROC",
    "FUNC num f(num a)",
    "ENDFUNC",
    "TRAP t",
    "ENDTRAP",
    "RECORD r",
    "ENDRECORD",
    "LOCAL ",
    "TASK ",
    "CONST ",
    "PERS ",
    "VAR ",
    "CONST num a:=",
    "VAR pos b:=",
    "PERS robtarget p:=",
    "CONST num c{2}:=",
    "VAR bool d;",
    "num ",
    "pos ",
    "robtarget ",
    "tooldata ",
    "wobjdata ",
    "bool ",
    "a",
    "b",
    "p",
    "c{1}",
    "c{",
    "[1,2,3]",
    "[1,0,0,0]",
    "[0,0,0,0]",
    "[9E9,9E9,9E9,9E9,9E9,9E9]",
    "[",
    "]",
    "(",
    ")",
    "{",
    "}",
    ",",
    ";",
    ";\n",
    ":=",
    ":",
    ".",
    ".x",
    "\\",
    "\\WObj:=",
    "\\Conc",
    "*",
    "+",
    "-",
    "/",
    "<",
    ">",
    "=",
    "%",
    "?",
    "1",
    "0",
    "-2.5",
    "9E9",
    "1e999",
    ".5",
    "5.",
    "0x1F",
    "12ab",
    "\"x\"",
    "\"",
    "\"\"",
    "TRUE",
    "FALSE",
    "NOT ",
    "AND ",
    "DIV ",
    "IF ",
    "THEN ",
    "ELSE ",
    "ENDIF ",
    "FOR i FROM 1 TO 2 DO ",
    "ENDFOR ",
    "WHILE ",
    "DO ",
    "ENDWHILE ",
    "TEST ",
    "CASE ",
    "ENDTEST ",
    "ERROR ",
    "RETURN ",
    "MoveL ",
    "MoveJ p,v1,z1,tool0;",
    "MoveC p,p,v1,z1,tool0;",
    "MoveAbsJ ",
    "MoveL Offs(p,0,0,1),v1,z1,tool0\\WObj:=wobj0;",
    "v100,",
    "z10,",
    "tool0",
    "wobj0",
    "load0",
    "Offs(",
    "RelTool(",
    "! note\n",
    "\n",
    " ",
    "\t",
    "%%%",
    "<SMT>",
    "é",
    "\u{a0}",
    "#",
    "_",
    "i",
    "x y;",
    "x:=1;",
    "a:=1;",
    "p.trans.x:=1;",
    "Incr a;",
    "Add a,1;",
    "SearchL\\Stop,d,p,p,v1,tool0;",
    "SearchL ",
    "PDispOn p,tool0;",
    "PDispOff;",
    "EOffsSet ",
    "MoveLDO p,",
    ",\\ID:=1,",
    "ToPoint:=",
    "Offs(Point:=p,XOffset:=",
    "<EXP>",
    "<ID>",
    "<TYP> ",
    "<VAR>:=",
    "<B",
    "C>",
    "PROC <ID>()",
    "MODULE <ID>",
    "ALIAS num l;",
    "ALIAS ",
    "\n<<<<<<< HEAD\n",
    "\n=======\n",
    "\n>>>>>>> a\n",
    "\nPROC q()\n",
    "ArcL p,v1,s,w,z1,tool0;",
    "PoseMult(",
    "OrientZYX(1,2,3)",
    " DIV ",
    " MOD ",
    "CONST dnum e:=",
    "r x:=[p,1];",
    "x.p",
    "\0",
    "\u{1a}",
];

fn inputs() -> usize {
    std::env::var("IRBKIN_INPUTS").ok().map_or(2000, |count| count.parse().unwrap())
}

fn below(rng: &mut Rng, count: usize) -> usize {
    (rng.between(0.0, count as f64) as usize).min(count.saturating_sub(1))
}

fn random_bytes(rng: &mut Rng) -> Vec<u8> {
    (0..below(rng, 200)).map(|_| below(rng, 256) as u8).collect()
}

fn token_soup(rng: &mut Rng) -> Vec<u8> {
    (0..below(rng, 40)).flat_map(|_| PIECES[below(rng, PIECES.len())].bytes()).collect()
}

/// Declarations and moves, most of them valid, in any order.
fn statements(rng: &mut Rng) -> Vec<u8> {
    let mut text = String::new();
    for _ in 0..below(rng, 12) {
        let name = ["a", "b", "c", "p", "q", "r"][below(rng, 6)];
        let other =
            ["a", "b", "c", "p", "q", "r", "tool0", "1", "p.trans.x", "c{2}"][below(rng, 10)];
        let statement = match below(rng, 21) {
            0 => format!("CONST num {name}:=-({other}+2)*.5;\n"),
            1 => format!("VAR num {name}{{2}}:=[{other},7];\n"),
            2 => format!(
                "PERS robtarget {name}:=[[1,{other},3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,\
                 9E9]];\n"
            ),
            3 => format!("CONST robtarget {name}:=RelTool({other},1,2,3\\Rz:=30);\n"),
            4 => format!("MoveL {other},v1,z1,tool0\\WObj:=wobj0;\n"),
            5 => format!("PROC {name}(num {other}) ! note\n"),
            6 => "ENDPROC\n".into(),
            7 => format!("IF {name}>{other} THEN ENDIF FOR {name} FROM 1 TO {other} DO ENDFOR\n"),
            8 => format!("{name}:=1; Incr {other};\n"),
            9 => format!("PDispOn {name},tool0; SearchL d,{name},{other},v1,tool0;\n"),
            10 => format!(
                "MoveL ToPoint:=Offs(Point:={name},0,0,{other}),\\ID:=1,v1,Zone:=z1,tool0,\
                 \\WObj:=wobj0;\n"
            ),
            11 => format!("VAR <TYP> {name}; IF <EXP> <SMT> {other}:=<EXP>; VAR num <ID>;\n"),
            12 => format!("PERS robtarget {name}:={other};\n"),
            13 => format!("VAR string {name}; {other}:={name};\n"),
            14 => format!("CONST num n:=2; VAR dnum {name}{{n}}:=[{other},n]; {name}{{1}}:=5;\n"),
            15 => format!("LOCAL PERS tooldata {name}:={other}; {name}.tload.mass:={other};\n"),
            16 => {
                format!("RECORD {name} robtarget p; num n; ENDRECORD VAR {name} x:=[{other},3];\n")
            }
            17 => {
                format!("ALIAS robtarget {name}; CONST {name} y:={other}; MoveJ y,v1,z1,tool0;\n")
            }
            18 => format!("CONST pos {name}:=[1,2,3]*{other}-{name}; VAR num z{{1+1}};\n"),
            19 => format!("TRAP {name} ArcL {other},v1,sm,wd\\Weave:={name},z1,tool0; ENDTRAP\n"),
            _ => format!("IF {name} MoveJ Offs({name},0,{other},0),v1,z1,{other};\n"),
        };
        text.push_str(&statement);
    }
    text.into_bytes()
}

/// A module with bytes changed, omitted, doubled, or with pieces inserted.
fn mutation(rng: &mut Rng) -> Vec<u8> {
    let mut text = CORPUS[below(rng, CORPUS.len())].to_vec();
    for _ in 0..=below(rng, 3) {
        let at = below(rng, text.len());
        let until = (at + below(rng, 30)).min(text.len());
        match below(rng, 5) {
            0 => text[at] = below(rng, 256) as u8,
            1 => drop(text.drain(at..until)),
            2 => {
                let doubled = text[at..until].to_vec();
                text.splice(at..at, doubled);
            }
            3 => drop(text.splice(at..at, PIECES[below(rng, PIECES.len())].bytes())),
            _ => drop(text.splice(at..until, PIECES[below(rng, PIECES.len())].bytes())),
        }
        if text.is_empty() {
            break;
        }
    }
    text
}

/// Writes a module, reads it again, and puts its own values back into its text.
fn check(text: &str, module: &Module) {
    let written = module.to_string();
    let again = parse(&written, &[])
        .unwrap_or_else(|error| panic!("{error}\n--- from\n{text}\n--- written\n{written}"));
    assert!(
        again.without_positions() == module.clone().without_positions(),
        "\n--- from\n{text}\n--- written\n{written}"
    );
    let own: Vec<_> = module
        .data()
        .iter()
        .enumerate()
        .flat_map(|(datum, it)| own_values(datum, &it.content))
        .collect();
    let rewritten = rewrite(text, module, &own).unwrap();
    // A datum that referred to an assigned one is now independent: what was unknown in a move is
    // evaluated, and may be invalid.
    let unknown = |step: &Move| {
        let via = step.via.as_ref().and_then(|via| via.value.as_ref().err());
        let wobj = step.wobj.as_ref().and_then(|wobj| wobj.value.as_ref().err());
        let reasons = [via, step.target.value.as_ref().err(), step.tool.value.as_ref().err(), wobj];
        reasons.into_iter().flatten().any(|reason| reason.to_string().contains("which depends on "))
    };
    if module.moves().iter().any(unknown) {
        return;
    }
    let same = parse(&rewritten, &[])
        .unwrap_or_else(|error| panic!("{error}\n--- from\n{text}\n--- rewritten\n{rewritten}"));
    assert!(
        same.data().iter().zip(module.data()).all(|(a, b)| a.content == b.content),
        "\n--- from\n{text}"
    );
    check_motion(module);
}

/// A module that is read in spite of its faults names them in order, and is read again from what it
/// writes.
fn check_in_spite(text: &str, module: &Module) {
    let places: Vec<_> = module.faults().iter().map(|fault| (fault.line, fault.column)).collect();
    assert!(!places.is_empty() && places.is_sorted() && places[0].0 > 0, "{text}");
    let again = read(&module.to_string(), &[]);
    assert!(again.faults().iter().all(|fault| !fault.to_string().is_empty()));
    check_motion(module);
}

/// Its moves are a motion with findings, or an error says why not.
fn check_motion(module: &Module) {
    let robot = irbkin::Robot::<6>::named("IRB 2600-12/1.65").unwrap();
    match irbkin_abb::rapid::motion(&robot, &[module], None, &MotionOptions::default()) {
        Ok(motion) => {
            assert!(motion.t.iter().all(|time| time.is_finite()) && motion.t.is_sorted());
            assert!(motion.q.as_flattened().iter().all(|angle| angle.is_finite()));
            assert!(motion.findings.iter().all(|finding| !finding.to_string().is_empty()));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

fn own_values(datum: usize, content: &Content) -> Vec<NewValue> {
    let value = |element, value: &Value| NewValue { datum, element, value: value.clone() };
    match content {
        Content::Uninitialized { .. } => Vec::new(),
        Content::Single(single) => vec![value(None, single)],
        Content::Array { values, .. } => {
            values.iter().enumerate().map(|(element, it)| value(Some(element), it)).collect()
        }
    }
}

/// Reads inputs of a kind: the number that is refused, and the longest time per byte.
fn read_all(kind: &str, make: fn(&mut Rng) -> Vec<u8>) -> usize {
    let count = inputs();
    let mut rng = Rng::new(kind.len() as u64);
    let (mut refused, mut bytes, mut longest) = (0, 0, Duration::ZERO);
    for _ in 0..count {
        let input = make(&mut rng);
        let text = decode(&input);
        let start = Instant::now();
        let module = parse(&text, &[]);
        let in_spite = read(&text, &[]);
        // A text of a few bytes takes the time of one call.
        longest = longest.max(start.elapsed() / text.len().max(100) as u32);
        bytes += text.len();
        match module {
            Ok(module) => {
                assert!(in_spite == module, "{text}");
                check(&text, &module);
            }
            Err(error) => {
                assert!(!error.to_string().is_empty());
                check_in_spite(&text, &in_spite);
                refused += 1;
            }
        }
    }
    println!(
        "{kind}: {count} inputs of {bytes} bytes, {refused} refused, at most {longest:?} a byte"
    );
    count - refused
}

#[test]
fn random_bytes_do_not_panic() {
    read_all("random bytes", random_bytes);
}

#[test]
fn token_soups_do_not_panic() {
    assert!(read_all("token soups", token_soup) > 0);
}

#[test]
fn statements_in_any_order_do_not_panic() {
    assert!(read_all("statements in any order", statements) > 0);
}

#[test]
fn mutations_do_not_panic() {
    assert!(read_all("mutations", mutation) > 0);
}

/// Texts that grow with their size in one way each.
fn pathological(size: usize) -> Vec<(&'static str, String)> {
    let target = "[[1,2,3],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    let lines = |line: &dyn Fn(usize) -> String| (0..size).map(line).collect::<Vec<_>>().concat();
    let chain = |i: usize| format!("CONST num p{i}:=p{};", i + 1);
    vec![
        ("open brackets", format!("CONST num a:={}", "[".repeat(size))),
        ("open brackets that are skipped", format!("foo {}", "[(".repeat(size))),
        ("brackets that are skipped", format!("foo {}{};", "[".repeat(size), "]".repeat(size))),
        ("forward references", lines(&chain) + &format!("CONST num p{size}:=1;")),
        ("forward references to what is unknown", lines(&chain)),
        ("a circle of references", lines(&chain) + &format!("CONST num p{size}:=p0;")),
        ("duplicate names", lines(&|i| format!("VAR num a{};", if i + 1 == size { 0 } else { i }))),
        (
            "names in different routines",
            lines(&|i| format!("PROC r{i}()VAR num a:=1;VAR num b:=a;ENDPROC ")),
        ),
        ("an unclosed string", format!("foo \"{}", "a".repeat(10 * size))),
        ("quotes", "\"\"".repeat(5 * size)),
        ("comments", "! foo\n".repeat(size)),
        ("a long name", format!("VAR num {}:=1;", "a".repeat(10 * size))),
        ("a long number", format!("VAR num a:={};", "1".repeat(10 * size))),
        ("a long sum", format!("CONST num a:=0{};", "+1".repeat(5 * size))),
        ("signs", format!("CONST num a:={}1;", "-".repeat(10 * size))),
        ("components", format!("CONST num a:=b{};", ".x".repeat(5 * size))),
        ("moves on one line", lines(&|_| "MoveL p,v1,z1,tool0;".into())),
        ("declarations on one line", lines(&|i| format!("VAR pos p{i}:=[1,2,3];"))),
        ("an array", format!("CONST num a{{{size}}}:=[{}1];", "1,".repeat(size - 1))),
        (
            "references to one array",
            format!("CONST robtarget a{{2}}:=[{target},{target}];")
                + &lines(&|i| format!("CONST num b{i}:=a{{2}}.trans.z;")),
        ),
        (
            "loops in loops",
            lines(&|i| {
                if i % 64 < 32 {
                    "FOR i FROM 1 TO 2 DO MoveL p,v,z,tool0; ".into()
                } else {
                    "ENDFOR ".into()
                }
            }),
        ),
        ("statements without an end", "foo ".repeat(size)),
        (
            "assigned data",
            lines(&|i| format!("VAR num a{i}:=1; a{i}:=2; MoveL Offs(p,a{i},0,0),v,z,tool0;")),
        ),
        (
            "references to what is assigned",
            lines(&chain)
                + &format!("VAR num p{size}:=1; p{size}:=2; MoveL Offs(p0,p0,p0,p0),v,z,tool0;"),
        ),
        ("arguments that are written", format!("SearchL {};", "\\a,".repeat(size))),
        ("placeholders", "<SMT>".repeat(size)),
        ("routines without names", "PROC <ID>() <SMT> ENDPROC ".repeat(size)),
        ("ends of files", "\0\u{1a} ".repeat(size)),
        ("invalid statements", "foo 12ab; ".repeat(size)),
        ("invalid lines", "foo 12ab\n".repeat(size)),
        ("lines with open brackets", "foo (\n".repeat(size)),
        ("data with open brackets", "CONST num a:=[[\n".repeat(size)),
        ("open strings", "x:=\"a\n".repeat(size)),
        ("lines of a conflict", "<<<<<<< HEAD\n=======\n>>>>>>> a\n".repeat(size)),
        ("routines in routines", "PROC a()\nIF b THEN\n".repeat(size)),
        ("ends of blocks", "ENDIF ENDFOR ENDPROC ENDMODULE\n".repeat(size)),
        ("modules in modules", "MODULE M ".repeat(size)),
        ("records without an end", "RECORD a\n".repeat(size)),
        ("doubled names", "VAR num a:=1;\n".repeat(size)),
        ("invalid data", lines(&|i| format!("CONST pos p{i}:=[1,p{}];", i + 1))),
        ("invalid moves", "MoveL 1,v1,z1,tool0;\n".repeat(size)),
        ("circles", lines(&|i| format!("CONST pos p{i}:=[p0,p{},p{}];", i + 1, i + 2))),
        (
            "assigned components",
            lines(&|i| format!("VAR pos p{i}; p{i}.x:=1; p{i}.y:=2; p0.z{i}:=1; p0.x:=2;")),
        ),
        ("processes", "ArcL p,v1,s,w,z1,tool0; SpotL p,v1,s,tool0;\n".repeat(size)),
        ("unfinished lines", "foo\n".repeat(size)),
        ("unfinished arguments", "foo a,\n! a note\n".repeat(size)),
        ("unfinished calls", "x:=f(1,\n".repeat(size)),
        ("calls", lines(&|i| format!("foo{i} f{i}(g{i}(1)\\h:=2)\\i;"))),
        ("options", format!("foo {};", "\\a".repeat(size))),
        ("operators", format!("x:=a{};", " AND NOT b<=c".repeat(size))),
        ("vectors", format!("CONST pos a:=[1,2,3]{};", "*[1,2,3]".repeat(size))),
    ]
}

/// The time of reading a text in spite of its faults, which is as long as any, the least of three.
fn time(text: &str) -> f64 {
    let once = || {
        let start = Instant::now();
        let _ = std::hint::black_box(read(std::hint::black_box(text), &[]));
        start.elapsed().as_secs_f64()
    };
    (0..3).map(|_| once()).fold(f64::INFINITY, f64::min)
}

/// Twice the text takes about twice the time. Ratios are printed and, with enough inputs to be
/// reliable, a quadratic reader, whose ratio of sixteen sizes is 256, fails.
#[test]
fn reading_time_is_linear() {
    let is_long = inputs() > 100_000;
    let size = if is_long { 20_480 } else { 2048 };
    let texts = [1, 2, 4, 16].map(|times| pathological(times * size));
    for i in 0..texts[0].len() {
        let [one, two, four, sixteen] = [0, 1, 2, 3].map(|times: usize| time(&texts[times][i].1));
        println!(
            "{}: {:.1} ms, ratios {:.1} {:.1} {:.1}",
            texts[0][i].0,
            1e3 * one,
            two / one,
            four / one,
            sixteen / one
        );
        // Below a tenth of a millisecond a ratio has no meaning.
        assert!(
            !is_long || sixteen / one.max(1e-4) < 64.0,
            "{}: {:.1}",
            texts[0][i].0,
            sixteen / one
        );
    }
}

/// A program of 50,000 targets and as many moves.
#[test]
fn large_modules_are_read_at_once() {
    let count = if inputs() > 100_000 { 50_000 } else { 1000 };
    let target: fn(usize) -> String = |i| {
        format!(
            "  CONST robtarget p{i}:=[[{i}.125,-20.5,300.75],[0.5,0.5,-0.5,0.5],[0,-1,0,1],[9E+09,\
             9E+09,9E+09,9E+09,9E+09,9E+09]];\n"
        )
    };
    let step: fn(usize) -> String =
        |i| format!("    MoveL p{i},v100,z10,tGripper\\WObj:=wTable;\n");
    let [targets, steps] =
        [target, step].map(|line| (0..count).map(line).collect::<Vec<_>>().concat());
    let tool =
        "PERS tooldata tGripper:=[TRUE,[[0,0,100],[1,0,0,0]],load0];PERS wobjdata wTable:=wobj0;";
    let text =
        format!("MODULE Large\n{tool}\n{targets}  PROC main()\n{steps}  ENDPROC\nENDMODULE\n");
    let seconds = time(&text);
    let module = parse(&text, &[]).unwrap();
    assert_eq!((module.data().len(), module.moves().len()), (count + 2, count));
    assert!(
        module
            .moves()
            .iter()
            .all(|step| step.target.value.is_ok() && step.wobj.as_ref().unwrap().value.is_ok())
    );
    println!("{count} targets and {count} moves, {} bytes: {:.0} ms", text.len(), 1e3 * seconds);
}
